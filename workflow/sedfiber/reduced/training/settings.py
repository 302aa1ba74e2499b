"""Every hyper-parameter of the reduced-order model: what it does and where it comes from.

The paper gives no widths, activations or optimiser. Papers of the same
group use encoders 512:256 or 500:500, neural ODEs 200:200:200, Adam from 1e-3 to 1e-4 and
a damping 0.1 std(h); `SourceNodeSettings` keeps to those where they apply. "Measured"
means chosen on training data, with ℬ = 400 and 2000 or single even angles held out.
"""

from dataclasses import dataclass

from sedfiber.core.validation import refused

VARIANTS = ("none", "encoder", "decoder", "double")


@dataclass(frozen=True)
class AutoencoderSettings:
    """Autoencoder networks and their training; the same for all variants and dimensions."""

    decoder_hidden: tuple[int, ...] = (64, 64)
    """Widths of the decoder's hidden layers. Measured: with the fixed modal layer outside,
    64:64 trains in 20 s; 32:32 loses 2 to 3 times more, one layer of 128 far more."""
    encoder_hidden: int = 16
    """Hidden units through which ℬ acts on the encoder, where it does."""
    modes_per_parity: int = 12
    """POD modes of each parity in the fixed outer layer. Measured: 12 lose 2e-9 (squared,
    units L/2) of the training shapes, far below the reconstruction loss."""
    samples_per_trajectory: int = 64
    """Samples of a trajectory, even along its path: 0.01 to 0.1 half lengths apart."""
    batch_size: int = 512
    """Samples of one step of the optimiser. Measured: 1500 ends 2 to 4 times worse in the same time."""
    iterations: int = 4500
    """Steps of the optimiser."""
    learning_rate: float = 1.0e-2
    """First learning rate; falls along half a cosine. Measured: 3e-3 is 3 times worse."""


@dataclass(frozen=True)
class NodeSettings:
    """Neural ODE: networks, the two training stages, and the integration of a forecast."""

    hidden: tuple[int, ...] = (64, 64)
    """Widths of the hidden layers of F_h and F_c together; the siblings' 200:200:200 is
    slower by far and not needed."""
    damping: float = 0.1
    """A = damping · std(h), diagonal, per a/U_s: the value of the sibling papers."""
    samples_per_trajectory: int = 64
    """Samples of a trajectory that are matched and that segments start from, even along
    its path."""
    matching_iterations: int = 6000
    """Stage 1, steps of the optimiser."""
    matching_batch_size: int = 512
    """Stage 1, samples of one step."""
    matching_learning_rate: float = 1.0e-2
    """Stage 1, first learning rate; falls along half a cosine."""
    rollout_lengths: tuple[int, ...] = (8, 24, 64)
    """Stage 2, steps of the segments in each phase. The phase of 64 is there
    for the slow escape from the W shape at ℬ = 10000, the worst training trajectories."""
    rollout_iterations: tuple[int, ...] = (500, 300, 300)
    """Stage 2, steps of the optimiser in each phase."""
    rollout_batch_steps: int = 6000
    """Stage 2, steps of all segments of a batch together."""
    rollout_learning_rate: float = 2.0e-3
    """Stage 2, first learning rate; falls along half a cosine over all phases."""
    power: float = 3.0
    """Stage 2, exponent of the power mean of E along a segment, which favours the worst
    moment: a plain mean over 64 steps neglects the first sample after t = 0."""
    start_share: float = 0.25
    """Stage 2, share of the segments that start at t = 0."""
    path_step: float = 0.08
    """Stage 2, longest path of one step at the start of a segment, units of L/2."""
    max_stride: int = 6
    """Stage 2, longest step in sample intervals: 3 a/U_s, above which the Runge–Kutta
    method is unstable for the bending modes at ℬ = 100."""
    rtol: float = 1.0e-9
    """Relative tolerance of dopri5 in a forecast."""
    atol: float = 1.0e-11
    """Absolute tolerance of dopri5 in a forecast, units of h and of L/2."""

    def __post_init__(self) -> None:
        """Raise InputError when the phases of stage 2 do not fit together."""
        if len(self.rollout_lengths) != len(self.rollout_iterations):
            allowed = f"as many numbers as rollout_lengths has, {len(self.rollout_lengths)}"
            raise refused("rollout_iterations", list(self.rollout_iterations), allowed)


@dataclass(frozen=True)
class SourceNodeSettings:
    """The paper's own recipe: one step τ, the loss as written, samples even in time."""

    hidden: tuple[int, ...] = (200, 200)
    """Widths of the hidden layers: sibling papers have 200:200:200."""
    damping: float = 0.1
    """A = damping · std(h): sibling papers."""
    iterations: int = 1800
    """Steps of the optimiser."""
    batch_size: int = 256
    """Pairs (t, t + τ) in one step."""
    learning_rate: float = 1.0e-3
    """Adam, first two thirds: sibling papers."""
    final_learning_rate: float = 1.0e-4
    """Adam, last third: sibling papers."""
    rtol: float = 1.0e-5
    """Relative tolerance of dopri5, in training and in a forecast. torchdiffeq's default of
    1e-7 is below the rounding of the float32 training and only costs rejected steps."""
    atol: float = 1.0e-7
    """Absolute tolerance of dopri5, units of h and of L/2."""
