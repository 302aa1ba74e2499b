"""The reduced model as one HTML page that forecasts in the browser."""
