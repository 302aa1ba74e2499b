"""Forecasts in compiled code."""
