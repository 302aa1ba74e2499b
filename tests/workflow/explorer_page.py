"""Making an explorer, and asking one that a browser has open for its forecasts."""

import numpy as np

from command_line import run_step
from sedfiber.commands.steps import make_explorer

CLOSE = 1e-5  # of L; the page promises 1e-4


def make(model, *datasets, output) -> None:
    """What the command does."""
    run_step(make_explorer, "--model", model, "--dataset", *datasets, "-o", output)


def forecast(page, B: float, theta0: float, t: np.ndarray) -> np.ndarray:
    """Positions (T, N, 2) that the page computes."""
    flat = page.evaluate("given => Array.from(sedfiber.forecast(...given))", [B, theta0, t.tolist()])
    return np.array(flat).reshape(len(t), -1, 2)


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Largest distance of two beads over L, of positions (T, N, 2)."""
    return np.linalg.norm(one - other, axis=-1).max() / (2 * one.shape[1])
