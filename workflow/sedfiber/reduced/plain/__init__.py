"""Forecasts in plain NumPy: for one fiber they are written before numba would have been imported."""
