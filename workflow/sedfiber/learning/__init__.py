"""The reduced-order model: autoencoder, neural ODE, forecasts, baselines and error measures."""
