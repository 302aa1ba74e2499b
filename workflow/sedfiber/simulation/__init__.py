"""Runs of a scene: integration, settling, checks, audit, and the trajectory file."""
