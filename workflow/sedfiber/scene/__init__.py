"""Scenes: a user's description, its checks, and the system of equations made from it."""
