"""The cost of accuracy: each way to a trajectory, timed and judged."""
