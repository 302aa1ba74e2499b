"""The neural ODE: rates of the latent variables and of the centre bead.

    dh/dt = F_h(h; ℬ) − A h            F_h(0; ℬ) = 0,   A = damping · diag(std h) > 0
    dc/dt = F_c(h; ℬ) = U_term(ℬ) + G_c(h; ℬ),   G_c(0; ℬ) = 0

in a/U_s and L/2. U_term is the steady falling velocity, which the steady solver gives
along with the terminal shape; so the terminal state is an exact solution at every ℬ. F_h
and G_c are one mirror-symmetric network (`networks`) of h, its origin h_term and the scaled
ln ℬ: h + h_term is the latent place of the whole shape (`autoencoder`), in which the
dynamics depend on ℬ through the elastic forces alone. All latent inputs in units of std(h).
Motion stays in the plane of the start, so G_c has an x part (odd) and a y part (even).
"""

import torch
from torch import Tensor, nn

from sedfiber.reduced.autoencoder import latent_signs
from sedfiber.reduced.networks import MirrorNetwork

N_CENTRE = 2


class NeuralOde(nn.Module):
    """Rates; ``latent_scale`` (d,) is std(h), ``rate_scale`` (d + 2,) the size of the rates."""

    latent_scale: Tensor
    rate_scale: Tensor
    damping: Tensor

    def __init__(
        self, hidden: tuple[int, ...], damping: float, latent_scale: Tensor, rate_scale: Tensor, seed: int
    ) -> None:
        super().__init__()
        self.hidden, self.seed = hidden, seed
        generator = torch.Generator().manual_seed(seed)
        signs = latent_signs(len(latent_scale))
        signs_out = torch.cat([signs, torch.tensor([-1.0, 1.0])])
        self.network = MirrorNetwork(signs, signs_out, 1, hidden, generator)
        self.register_buffer("latent_scale", latent_scale)
        self.register_buffer("rate_scale", rate_scale)
        self.register_buffer("damping", damping * latent_scale)

    @property
    def latent_dim(self) -> int:
        """Number of latent variables d."""
        return len(self.latent_scale)

    def rest(self, context: Tensor) -> Tensor:
        """The network at h = 0, (S, d + 2): constant along a trajectory."""
        return self.network.rest(self._scaled(context))

    def forward(self, h: Tensor, context: Tensor, rest: Tensor) -> Tensor:
        """[dh/dt, G_c] for h (S, d) and context [b, h_term] (S, 1 + d); shape (S, d + 2)."""
        rates = self.rate_scale * self.network(h / self.latent_scale, self._scaled(context), rest)
        return rates - nn.functional.pad(self.damping * h, (0, N_CENTRE))

    def _scaled(self, context: Tensor) -> Tensor:
        return torch.cat([context[:, :1], context[:, 1:] / self.latent_scale], dim=1)
