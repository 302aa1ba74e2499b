"""Drawings: each module turns one table into one figure and computes nothing that belongs in a table."""
