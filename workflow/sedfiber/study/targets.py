"""The paper's claims and this study's targets, for figures and tables."""

PAPER_BOUND = 0.1  # the paper's claim for the ensemble mean of E(t), any ℬ and any time
PAPER_FALLS = 227
PAPER_LATENT_DIM = 4

ENSEMBLE_TARGETS = {"A": 1e-4, "B": 1e-3}  # of the ensemble mean at any ℬ and any time
WORST_TARGETS = {"A": 5e-4, "B": 5e-3}  # of any trajectory at any time, at the paper's latent dimension
RECONSTRUCTION_TARGET = 1e-4  # of the loss at the paper's latent dimension, lengths in L/2
SIMULATION_TARGET = 1e-4  # of a simulation's own error, over L
