"""The autoencoder of residual shapes.

    z = Φ X̌                          modal coefficients, Φ fixed: POD modes of the training set
    h = (P + Q(b)) z                  encoder,  E(0) = 0
    ž = P₀ᵀ h + σ g(h; h_term, b)     decoder,  D(0; ℬ) = 0
    X̌ ≈ Φᵀ ž

P is trained, Q(b) too and only where the variant gives ℬ to the encoder; both keep odd and
even modes apart. P₀ picks the leading odd and even modes, σ² are the modes' energies, g is a
mirror-symmetric network that vanishes at rest (`networks`). The first ⌈d/2⌉ latent variables
are odd under the mirror, the others even.

Where the variant gives ℬ to the decoder, g has two more inputs: b, the scaled ln ℬ, and
h_term = (P + Q(b)) Φ X̄_term(ℬ), the terminal shape's own place in latent space. h + h_term is
the place of the whole shape: a straight fiber has the same at every ℬ, so that little is left
to interpolate in ℬ. Measured with ℬ = 200 held out of the training, d = 2: reconstruction
loss there 3.8e-5, and 3.8e-2 with b alone.

The encoder is linear in the shape. Measured at d = 3 and 4 with one training ℬ held out: a
nonlinear encoder reconstructs no better, while the paths h(t) bend more, the rates of the
neural ODE are harder to fit, and forecasts at the ℬ held out are 5 to 40 times worse.
"""

import numpy as np
import torch
from torch import Tensor, nn

from sedfiber.core.array_types import Positions
from sedfiber.core.errors import InputError
from sedfiber.reduced.networks import MirrorNetwork, perceptron
from sedfiber.reduced.pod import ModalBasis
from sedfiber.reduced.scaling import Scales
from sedfiber.reduced.training.settings import VARIANTS, AutoencoderSettings


def latent_signs(latent_dim: int) -> Tensor:
    """−1 for odd latent variables, which come first, +1 for even ones; shape (d,)."""
    n_odd = (latent_dim + 1) // 2
    return torch.cat([-torch.ones(n_odd), torch.ones(latent_dim - n_odd)])


class LinearEncoder(nn.Module):
    """h = (P + Q(b)) z; ``start`` (d, r) is the first P, ``allowed`` (d, r) keeps parity.

    Q is a network of b with one hidden layer of ``n_hidden`` units, zero at the start of the
    training; 0 units for an encoder that does not see ℬ.
    """

    allowed: Tensor

    def __init__(self, start: Tensor, allowed: Tensor, n_hidden: int, generator: torch.Generator) -> None:
        super().__init__()
        self.matrix = nn.Parameter(start.clone())
        self.register_buffer("allowed", allowed.to(start))
        self.change = perceptron([1, n_hidden, start.numel()], generator) if n_hidden else None
        if self.change is not None:
            nn.init.zeros_(list(self.change.parameters())[-2])  # the last layer's weights

    def forward(self, z: Tensor, b: Tensor) -> Tensor:
        """(S, r) and (S, 1) give (S, d)."""
        if self.change is None:
            return z @ (self.matrix * self.allowed).T
        matrix = self.matrix + self.change(b).unflatten(1, self.matrix.shape)
        return torch.einsum("sdr,sr->sd", matrix * self.allowed, z)


class Autoencoder(nn.Module):
    """Encoder and decoder of residual shapes X̌ (S, 3N), given their context [b, h_term] (S, 1 + d).

    Raises InputError for an unknown variant.
    """

    modes: Tensor
    scale: Tensor
    pick: Tensor

    def __init__(
        self,
        variant: str,
        latent_dim: int,
        basis: ModalBasis,
        scales: Scales,
        settings: AutoencoderSettings,
        seed: int,
    ) -> None:
        super().__init__()
        if variant not in VARIANTS:
            raise InputError(f"variant {variant!r} is unknown; allowed are {', '.join(VARIANTS)}")
        self.variant, self.latent_dim = variant, latent_dim
        self.scales, self.settings, self.seed = scales, settings, seed
        generator = torch.Generator().manual_seed(seed)
        modal, latent = torch.tensor(basis.signs, dtype=torch.float32), latent_signs(latent_dim)
        self.decoder_sees_B = variant in ("decoder", "double")
        pick = _leading_modes(modal, latent)
        n_hidden = settings.encoder_hidden if variant in ("encoder", "double") else 0
        self.encoder = LinearEncoder(pick, latent[:, None] == modal, n_hidden, generator)
        hidden = settings.decoder_hidden
        self.decoder = MirrorNetwork(latent, modal, int(self.decoder_sees_B), hidden, generator)
        self.register_buffer("modes", torch.tensor(basis.modes.copy()))
        self.register_buffer("scale", torch.tensor(np.sqrt(basis.energies), dtype=torch.float32))
        self.register_buffer("pick", pick)

    def modal(self, residual: Tensor) -> Tensor:
        """z = Φ X̌: (S, 3N) gives (S, r)."""
        return residual @ self.modes.T

    def encode_modal(self, z: Tensor, context: Tensor) -> Tensor:
        """h from modal coefficients: (S, r) gives (S, d)."""
        return self.encoder(z, context[:, :1])

    def decode_modal(self, h: Tensor, context: Tensor) -> Tensor:
        """Modal coefficients from h: (S, d) gives (S, r)."""
        context = context if self.decoder_sees_B else context[:, :0]
        return h @ self.pick + self.scale * self.decoder(h, context, self.decoder.rest(context))

    def context(self, b: Tensor, terminal: Tensor) -> Tensor:
        """[b, h_term] (S, 1 + d) from b (S, 1) and the terminal shapes' modal coefficients (S, r)."""
        return torch.cat([b, self.encoder(terminal, b)], dim=1)

    def context_of(self, B: float, terminal: Positions) -> Tensor:
        """[b, h_term] (1, 1 + d) for one ℬ, terminal shape (N, 3) in ``a``; a model of one dtype throughout."""
        shape = terminal.reshape(1, -1) / self.scales.half_length
        b = torch.tensor([[float(self.scales.log_B(B))]], dtype=self.modes.dtype)
        with torch.no_grad():
            return self.context(b, self.modal(torch.tensor(shape, dtype=self.modes.dtype)))

    def encode(self, residual: Tensor, context: Tensor) -> Tensor:
        """h = E(X̌; ℬ): (S, 3N) gives (S, d)."""
        return self.encode_modal(self.modal(residual), context)

    def decode(self, h: Tensor, context: Tensor) -> Tensor:
        """X̌ = D(h; ℬ): (S, d) gives (S, 3N)."""
        return self.decode_modal(h, context) @ self.modes


def _leading_modes(modal: Tensor, latent: Tensor) -> Tensor:
    """P: one leading mode of the right parity for each latent variable, shape (d, r)."""
    pick = torch.zeros(len(latent), len(modal))
    for sign in (-1.0, 1.0):
        rows, columns = torch.where(latent == sign)[0], torch.where(modal == sign)[0]
        if len(rows) > len(columns):
            raise InputError(f"latent dimension {len(latent)} needs more modes than the data have")
        pick[rows, columns[: len(rows)]] = 1.0
    return pick
