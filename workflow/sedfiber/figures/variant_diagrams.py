"""The four autoencoder variants as small block diagrams: where ℬ enters."""

from matplotlib.axes import Axes

from sedfiber.figures.blocks import BUNDLE, LATENT, LATENT_TERM, PARAMETER, RESIDUAL, Look, Sheet
from sedfiber.figures.style import B_SYMBOL, BLACK

SIZE = (1.7, 0.92)  # inches
_ROW = 0.34
_B, _PLACED_B = (wire._replace(color=BLACK) for wire in (PARAMETER, BUNDLE))  # colours tell the variants here


def draw_variant(axes: Axes, variant: str, color: str) -> None:
    """X̌ to h to X̌, with connection (f) where the encoder sees ℬ and (k) where the decoder does."""
    sheet, look = Sheet.on(axes, *SIZE), Look(color, 1.4, 0.16)
    sheet.trapezoid((0.49, _ROW), 0.34, (0.64, 0.32), "E", look)
    sheet.trapezoid((1.17, _ROW), 0.34, (0.32, 0.64), "D", look)
    for x0, x1 in ((0.17, 0.32), (0.66, 1.0), (1.34, 1.48)):
        sheet.wire((x0, _ROW), (x1, _ROW))
    sheet.text((0.09, _ROW), RESIDUAL)
    sheet.text((0.83, _ROW + 0.1), LATENT)
    sheet.text((1.6, _ROW), f"≈ {RESIDUAL}")
    if variant in ("encoder", "double"):
        sheet.connection("f", _B, (0.37, 0.77), (0.49, 0.88), (0.49, 0.59))
        sheet.text((0.56, 0.79), B_SYMBOL, ha="left")
    if variant in ("decoder", "double"):
        sheet.connection("k", _PLACED_B, (1.05, 0.77), (1.17, 0.88), (1.17, 0.59))
        sheet.text((1.24, 0.79), f"{B_SYMBOL}, {LATENT_TERM}", ha="left")
