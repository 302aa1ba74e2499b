"""Our training of the neural ODE on a trained, frozen autoencoder.

1. Matching: along the encoded trajectories dh/dt and dc/dt are known (splines through the
   samples); the network is fitted to them relative to the local speed v of h:

       ⟨ |δ(dh/dt, dc/dt)|² / (v² + ε²) ⟩

   each rate in units of its own root mean square. Along a path the error of a rollout
   grows with δ/v per unit of path, hence the weight.
2. Rollouts of segments of growing length (`segments`) from encoded samples, by a fixed-step
   method (`rollout`) and plain back-propagation. The loss is the error measure of the
   forecasts itself,

       E = |ž − z|²/(4N) + |Δc|²/|c(t) − c(0)|²

   where modal coefficients in units of L/2 turn the first term into Σ_beads|ΔX̄|²/(N L²);
   its power mean along a segment, which favours the worst moments, is averaged.
"""

import copy

import torch
from torch import Tensor

from sedfiber.reduced.autoencoder import Autoencoder
from sedfiber.reduced.dataset import Dataset
from sedfiber.reduced.neural_ode import NeuralOde
from sedfiber.reduced.training.node_data import EncodedSamples, encode_samples
from sedfiber.reduced.training.rollout import roll_out
from sedfiber.reduced.training.segments import Segments, draw_segments
from sedfiber.reduced.training.settings import NodeSettings
from sedfiber.reduced.training.training import Descent, Progress, ProgressLine, cosine_rate, silent, soap

ERROR_FLOOR = 1e-9  # keeps the root in the power mean smooth
SPEED_FLOOR = 0.05  # ε, in units of the root-mean-square speed


def train_node(
    training: Dataset,
    autoencoder: Autoencoder,
    seed: int,
    settings: NodeSettings,
    progress: Progress = silent,
) -> NeuralOde:
    """Train F_h and F_c; the same arguments give the same bytes.

    Raises InputError for a trajectory that cannot be learned from, NumericalError when the
    training diverges; both name the trajectory.
    """
    training.require_sound()
    exact = copy.deepcopy(autoencoder).double()
    samples = encode_samples(training, exact, settings.samples_per_trajectory)
    node = new_node(samples, settings.hidden, settings.damping, seed)
    generator = torch.Generator().manual_seed(seed)
    _match(node, samples, settings, training.names, generator, progress)
    decoder = copy.deepcopy(autoencoder).requires_grad_(False)
    _Rollouts(node, decoder, samples, settings, generator).train(training.names, progress)
    return node


def new_node(samples: EncodedSamples, hidden: tuple[int, ...], damping: float, seed: int) -> NeuralOde:
    """An untrained neural ODE, scaled by the encoded training data."""
    h, rates, _ = samples.path_even()
    latent_scale, rate_scale = h.square().mean(0).sqrt(), rates.square().mean(0).sqrt()
    return NeuralOde(hidden, damping, latent_scale, rate_scale, seed)


def _match(
    node: NeuralOde,
    samples: EncodedSamples,
    settings: NodeSettings,
    names: list[str],
    generator: torch.Generator,
    progress: Progress,
) -> None:
    h, rates, context = samples.path_even()
    speed2 = (rates / node.rate_scale)[:, : node.latent_dim].square().mean(1, keepdim=True)
    weight = 1 / (speed2 + SPEED_FLOOR**2)
    name = f"neural ODE, d = {node.latent_dim}, matching"
    descent = Descent(soap(node.parameters()), names, name, progress)
    line = ProgressLine(name, settings.matching_iterations, progress)
    for step in range(settings.matching_iterations):
        rows = torch.randint(len(h), (settings.matching_batch_size,), generator=generator)
        error = node(h[rows], context[rows], node.rest(context[rows])) - rates[rows]
        errors = weight[rows] * (error / node.rate_scale).square()
        rate = cosine_rate(settings.matching_learning_rate, step, settings.matching_iterations)
        line.update(step, descent.step(rate, errors.mean(), errors.amax(1), rows // samples.even.shape[1]))


class _Rollouts:
    """Stage 2: what a batch of rollouts needs."""

    def __init__(
        self,
        node: NeuralOde,
        decoder: Autoencoder,
        samples: EncodedSamples,
        settings: NodeSettings,
        generator: torch.Generator,
    ) -> None:
        self.node, self.decoder, self.samples = node, decoder, samples
        self.settings, self.generator = settings, generator

    def train(self, names: list[str], progress: Progress) -> None:
        """All phases, one schedule of the learning rate over them."""
        settings = self.settings
        phases = zip(settings.rollout_lengths, settings.rollout_iterations, strict=True)
        lengths = [length for length, count in phases for _ in range(count)]
        name = f"neural ODE, d = {self.node.latent_dim}, rollouts"
        descent = Descent(soap(self.node.parameters()), names, name, progress)
        line = ProgressLine(name, len(lengths), progress)
        for step, length in enumerate(lengths):
            rate = cosine_rate(settings.rollout_learning_rate, step, len(lengths))
            segments = self.draw(length)
            error = self.errors(segments) + ERROR_FLOOR
            mean = error.pow(settings.power).mean(dim=0).pow(1 / settings.power)
            line.update(step, descent.step(rate, mean.mean(), mean, segments.which))

    def draw(self, length: int) -> Segments:
        """A batch of segments of ``length`` steps."""
        settings = self.settings
        return draw_segments(
            self.samples,
            max(1, settings.rollout_batch_steps // length),
            length,
            settings.start_share,
            settings.path_step,
            settings.max_stride,
            self.generator,
        )

    def errors(self, segments: Segments) -> Tensor:
        """E after each step, (K, S); zero where there are no data."""
        samples, start, target = self.samples, segments.start, segments.target
        context = samples.context[segments.which]
        h, drift = roll_out(self.node, samples.h[start], context, segments.steps)
        repeated = context.expand(len(target), -1, -1).flatten(0, 1)
        z = self.decoder.decode_modal(h.flatten(0, 1), repeated).unflatten(0, target.shape)
        n_beads = self.decoder.scales.n_beads
        shape = (z - samples.z[target]).square().sum(-1) / (4 * n_beads)
        offset = drift + samples.drift[start] - samples.drift[target]
        position = offset.square().sum(-1) / samples.travelled[target]
        return (shape + position) * segments.stored
