"""Our training of the neural ODE on a trained, frozen autoencoder.

1. Matching: along the encoded trajectories dh/dt and dc/dt are known (splines through the
   samples); the network is fitted to them relative to the local speed v of h:

       ⟨ |δ(dh/dt, dc/dt)|² / (v² + ε²) ⟩

   each rate in units of its own root mean square. Along a path the error of a rollout
   grows with δ/v per unit of path, hence the weight.
2. Rollouts of growing length from encoded samples, by a fixed-step method (`rollout`) and
   plain back-propagation. The loss is the error measure of the forecasts itself,

       E = |ž − z|²/(4N) + |Δc|²/|c(t) − c(0)|²

   where modal coefficients in units of L/2 turn the first term into Σ_beads|ΔX̄|²/(N L²).
"""

import copy

import torch
from torch import Tensor

from sedfiber.learning.autoencoder import Autoencoder
from sedfiber.learning.dataset import Dataset
from sedfiber.learning.neural_ode import NeuralOde
from sedfiber.learning.node_data import N_SUBSTEPS, EncodedGrid, encode_grid
from sedfiber.learning.optimiser import Soap
from sedfiber.learning.rollout import roll_out
from sedfiber.learning.settings import NodeSettings
from sedfiber.learning.training import Progress, ProgressLine, cosine_rate, descend, silent

SPEED_FLOOR = 0.05  # ε, in units of the root-mean-square speed


def train_node(
    training: Dataset,
    autoencoder: Autoencoder,
    seed: int,
    settings: NodeSettings,
    progress: Progress = silent,
) -> NeuralOde:
    """Train F_h and F_c; the same arguments give the same bytes.

    Raises NumericalError when the loss is not finite.
    """
    scales = autoencoder.scales
    exact = copy.deepcopy(autoencoder).double()
    grid = encode_grid(training, exact, scales, settings.samples_per_trajectory)
    node = new_node(grid, settings.hidden, settings.damping, seed)
    generator = torch.Generator().manual_seed(seed)
    _match(node, grid, settings, generator, progress)
    decoder = copy.deepcopy(autoencoder).requires_grad_(False)
    _Rollouts(node, decoder, grid, scales.n_beads, settings, generator).train(progress)
    return node


def new_node(grid: EncodedGrid, hidden: tuple[int, ...], damping: float, seed: int) -> NeuralOde:
    """An untrained neural ODE, scaled by the encoded training data."""
    h, rates, _ = grid.samples()
    latent_scale, rate_scale = h.square().mean(0).sqrt(), rates.square().mean(0).sqrt()
    return NeuralOde(hidden, damping, latent_scale, rate_scale, seed)


def _match(
    node: NeuralOde, grid: EncodedGrid, settings: NodeSettings, generator: torch.Generator, progress: Progress
) -> None:
    h, rates, b = grid.samples()
    speed2 = (rates / node.rate_scale)[:, : node.latent_dim].square().mean(1, keepdim=True)
    weight = 1 / (speed2 + SPEED_FLOOR**2)
    optimiser = Soap(node.parameters())
    name = f"neural ODE, d = {node.latent_dim}, matching"
    line = ProgressLine(name, settings.matching_iterations, progress)
    for step in range(settings.matching_iterations):
        rows = torch.randint(len(h), (settings.matching_batch_size,), generator=generator)
        error = node(h[rows], b[rows], node.rest(b[rows])) - rates[rows]
        loss = (weight[rows] * (error / node.rate_scale).square()).mean()
        optimiser.learning_rate = cosine_rate(
            settings.matching_learning_rate, step, settings.matching_iterations
        )
        line.update(step, descend(optimiser, loss, name))


class _Rollouts:
    """Stage 2: what a batch of rollouts needs."""

    def __init__(
        self,
        node: NeuralOde,
        decoder: Autoencoder,
        grid: EncodedGrid,
        n_beads: int,
        settings: NodeSettings,
        generator: torch.Generator,
    ) -> None:
        self.node, self.decoder, self.grid = node, decoder, grid
        self.n_beads, self.settings, self.generator = n_beads, settings, generator

    def train(self, progress: Progress) -> None:
        """All phases, one schedule of the learning rate over them."""
        settings = self.settings
        optimiser = Soap(self.node.parameters())
        lengths = [
            min(length or self.grid.n_steps, self.grid.n_steps)
            for length, count in zip(settings.rollout_lengths, settings.rollout_iterations, strict=True)
            for _ in range(count)
        ]
        name = f"neural ODE, d = {self.node.latent_dim}, rollouts"
        line = ProgressLine(name, len(lengths), progress)
        for step, length in enumerate(lengths):
            optimiser.learning_rate = cosine_rate(settings.rollout_learning_rate, step, len(lengths))
            error = self.errors(*self.draw(length), length).mean(0)
            power = settings.worst_case_power
            loss = error.pow(power).mean().pow(1 / power)
            line.update(step, descend(optimiser, loss, name))

    def draw(self, length: int) -> tuple[Tensor, Tensor]:
        """Trajectories and start points (S,) of a batch; every trajectory from 0 if whole."""
        n = len(self.grid.b)
        if length == self.grid.n_steps:
            return torch.arange(n), torch.zeros(n, dtype=torch.long)
        count = max(1, self.settings.rollout_batch_steps // length)
        which = torch.randint(n, (count,), generator=self.generator)
        last = self.grid.n_steps - length
        start = torch.randint(last + 1, (count,), generator=self.generator)
        return which, torch.where(start <= N_SUBSTEPS, 0, start)

    def errors(self, which: Tensor, start: Tensor, length: int) -> Tensor:
        """E at each step of rollouts, (length, S); zero where there are no data."""
        grid = self.grid
        points = start + torch.arange(length + 1)[:, None]
        steps = grid.t[which, points].diff(dim=0)
        h, drift = roll_out(self.node, grid.h[which, start], grid.b[which], steps)
        points = points[1:]
        b = grid.b[which].expand(length, -1, -1)
        z = self.decoder.decode_modal(h.flatten(0, 1), b.flatten(0, 1)).unflatten(0, h.shape[:2])
        shape = (z - grid.z[which, points]).square().sum(-1) / (4 * self.n_beads)
        offset = drift + grid.drift[which, start] - grid.drift[which, points]
        error = shape + offset.square().sum(-1) / grid.travelled[which, points]
        return error * (points > N_SUBSTEPS)
