"""Batches of trajectory segments for the rollout training.

A segment starts at a stored sample, drawn evenly along the paths, and has K steps of a
common stride: as many sample intervals as keep a step's path short, drawn at random below
that. A share of the segments starts at t = 0 with stride 1, its first sample interval split
into substeps, for there stretching relaxes and E_pos divides by a small displacement.
"""

from dataclasses import dataclass

import torch
from torch import Tensor

from sedfiber.reduced.training.node_data import EncodedSamples

SUBSTEPS = (0.2, 0.5)  # of the first sample interval


@dataclass(frozen=True)
class Segments:
    """S segments of K steps; row numbers into the encoded samples.

    ``which`` (S,) names the trajectory, ``start`` (S,) the first sample, ``target`` (K, S)
    the sample after each step, ``steps`` (K, S) the time steps. ``stored`` (K, S) is False
    after a substep, where there are no data. Past the end of a trajectory the last sample
    repeats, with steps of zero.
    """

    which: Tensor
    start: Tensor
    target: Tensor
    steps: Tensor
    stored: Tensor


def draw_segments(
    samples: EncodedSamples,
    count: int,
    length: int,
    start_share: float,
    path_step: float,
    max_stride: int,
    generator: torch.Generator,
) -> Segments:
    """Draw ``count`` segments of ``length`` > 2 steps."""
    n_trajectories, n_even = samples.even.shape
    which = torch.randint(n_trajectories, (count,), generator=generator)
    place = torch.randint(n_even - 1, (count,), generator=generator)
    from_start = torch.rand(count, generator=generator) < start_share
    start = torch.where(from_start, samples.first[which], samples.even[which, place])
    longest = (path_step / samples.path[start]).floor().clamp(1, max_stride)
    stride = (1 + torch.rand(count, generator=generator) * longest).floor().clamp_max(max_stride)
    even = torch.arange(length)[:, None] * stride
    n_early = len(SUBSTEPS)
    early = torch.tensor(SUBSTEPS)[:, None].expand(-1, count)
    from_zero = torch.cat([early, 1 + even[: length - n_early]])
    return _segments(samples, which, start, torch.where(from_start, from_zero, stride + even))


def _segments(samples: EncodedSamples, which: Tensor, start: Tensor, offset: Tensor) -> Segments:
    """Segments whose steps end ``offset`` (K, S) sample intervals after ``start`` (S,)."""
    whole = offset.floor().long()
    target = torch.minimum(start + whole, samples.last[which])
    following = torch.minimum(start + 1, samples.last[which])
    interval = samples.t[following] - samples.t[start]
    t = samples.t[target] + (offset - whole) * interval
    steps = torch.cat([samples.t[start][None], t]).diff(dim=0)
    return Segments(which, start, target, steps, offset >= 1)
