"""Steady shapes of a falling fiber: their curve over ℬ, spectra, branches and stability."""
