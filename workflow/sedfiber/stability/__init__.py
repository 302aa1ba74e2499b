"""Where the model's own steady states are stable; builds on ``physics.steady_curve`` and ``physics.spectrum``."""
