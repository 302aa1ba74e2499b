"""The reduced model: autoencoder, neural ODE, forecasts, and the model that the package ships."""
