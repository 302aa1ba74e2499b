"""What accuracy costs in time: each way to a trajectory, timed and judged."""
