"""The reduced model as a block diagram: its parts with their sizes, and what passes between them."""

import json
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill

from matplotlib.figure import Figure

from sedfiber.core.errors import InputError
from sedfiber.core.validation import finite_number, one_of, whole_number
from sedfiber.figures.blocks import (
    ABSENT,
    BUNDLE,
    CENTRE,
    FIXED,
    LATENT,
    LATENT_TERM,
    PARAMETER,
    POSITIONS,
    RESIDUAL,
    SHAPE,
    SOLVED,
    STATE,
    STEADY,
    TERMINAL,
    TRAINED,
    Sheet,
    Wire,
    bent,
    place_keys,
)
from sedfiber.figures.style import B_SYMBOL, BLUE, GREEN, PAGE_WIDTH
from sedfiber.reduced.training.settings import VARIANTS

ROW, LANE, BUS = 1.2, 0.28, 2.2  # heights of the shape's row, the centre bead's lane and ℬ's line
NOW, LATER, REST = bent(0.75, 0.35, 0.28), bent(0.4, 0.75, 0.28), bent(0.0, 1.2, 0.28)  # sketches, inches

# the paper's connections in the upper row: place of the letter, corners of the wire
CONNECTIONS = {
    "a": ((0.92, 1.3), (0.7, ROW), (0.995, ROW)),
    "b": ((1.35, 1.1), (1.145, ROW), (1.545, ROW)),
    "c": ((2.72, 0.37), (0.85, ROW), (0.85, LANE), (3.0, LANE)),
    "d": ((1.5, 1.58), (1.62, 1.68), (1.62, 1.275)),
    "e": ((1.86, 1.1), (1.695, ROW), (2.05, ROW)),
    "f": ((2.4, 1.8), (2.3, BUS), (2.3, 1.555)),
    "g": ((2.8, 1.1), (2.6, ROW), (3.0, ROW)),
    "h": ((3.51, 1.8), (2.72, BUS), (3.4, BUS), (3.4, 1.5)),
    "i": ((4.05, 1.1), (3.8, ROW), (4.3, ROW)),
    "j": ((5.45, 0.37), (3.8, LANE), (6.06, LANE), (6.06, 1.125)),
    "k": ((4.69, 1.8), (3.4, BUS), (4.575, BUS), (4.575, 1.54)),
    "l": ((5.1, 1.1), (4.85, ROW), (5.345, ROW)),
    "m": ((5.55, 1.58), (5.42, 1.68), (5.42, 1.275)),
    "n": ((5.74, 1.1), (5.495, ROW), (5.985, ROW)),
    "o": ((6.24, 1.1), (6.135, ROW), (6.35, ROW)),
}
# each sketch of a fiber: the origin, its beads about the centre bead, its colour, the centre bead if not at the origin
SKETCHES = (
    ((0.4, ROW + 0.16), NOW, BLUE, (0.03, -0.16)),
    ((1.35, 0.76), 0.62 * NOW, BLUE),
    ((1.84, 0.76), 0.62 * (NOW - REST), BLUE),
    ((0.85, 1.8), 0.62 * REST, GREEN),
    ((5.1, 0.76), 0.62 * (LATER - REST), BLUE),
    ((5.74, 0.76), 0.62 * LATER, BLUE),
    ((6.64, ROW + 0.16), LATER, BLUE, (0.05, -0.28)),
)


@dataclass(frozen=True)
class Sizes:
    """Sizes of a model's parts, from its card; ``damping`` is A in units of std(h) U_s/a."""

    variant: str
    n_beads: int
    latent_dim: int
    modes_per_parity: int
    encoder_hidden: int
    decoder_hidden: tuple[int, ...]
    node_hidden: tuple[int, ...]
    damping: float

    @property
    def wires(self) -> dict[str, Wire]:
        """Connections that do not carry a state; (f) and (k) as the variant has them."""
        encoder = PARAMETER if self.variant in ("encoder", "double") else ABSENT
        decoder = BUNDLE if self.variant in ("decoder", "double") else ABSENT
        return {"d": STEADY, "f": encoder, "h": BUNDLE, "k": decoder, "m": STEADY}


def _read_sizes(card: Path) -> Sizes:
    """Read the card of a forecast model; raises InputError for anything else."""
    try:
        facts = json.loads(card.read_text(encoding="utf-8"))
        return _sizes(facts["autoencoder"], facts["neural_ode"], facts["notes"]["node_settings"])
    except (OSError, ValueError, LookupError, TypeError) as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"input: {str(card)!r} is not the card.json of a forecast model ({reason})") from None


def _sizes(autoencoder: dict, node: dict, training: dict) -> Sizes:
    settings, n_beads = autoencoder["settings"], _count("n_beads", autoencoder["scales"]["n_beads"], 3)
    return Sizes(
        variant=one_of("variant", autoencoder["variant"], VARIANTS),
        n_beads=n_beads,
        latent_dim=_count("latent_dim", autoencoder["latent_dim"]),
        # a planar shape about its centre bead has N − 1 odd and N − 1 even coordinates, and no more modes
        modes_per_parity=min(_count("modes_per_parity", settings["modes_per_parity"]), n_beads - 1),
        encoder_hidden=_count("encoder_hidden", settings["encoder_hidden"]),
        decoder_hidden=tuple(_count("decoder_hidden", width) for width in settings["decoder_hidden"]),
        node_hidden=tuple(_count("hidden", width) for width in node["hidden"]),
        damping=finite_number("damping", training["damping"]),
    )


def _count(key: str, value: object, least: int = 1) -> int:
    return whole_number(key, value, f"a whole number from {least}", least)


def draw(card: Path) -> Figure:
    """Above: from X̂(t) to X̂(t + τ) with the paper's connections (a) to (o). Below: the three networks opened."""
    sizes, figure = _read_sizes(card), Figure(figsize=(PAGE_WIDTH, 4.75))
    figure.set_layout_engine("none")
    sheet = Sheet.on(figure.add_axes((0.0, 0.0, 1.0, 1.0)), PAGE_WIDTH, 4.75)
    overview = sheet.part(0.0, 2.35, PAGE_WIDTH, 2.4)
    _draw_blocks(overview, sizes)
    _draw_connections(overview, sizes)
    _write_symbols(overview, sizes)
    _open_encoder(sheet.part(0.06, 0.3, 1.84, 1.95), sizes)
    _open_node(sheet.part(1.98, 0.3, 2.72, 1.95), sizes)
    _open_decoder(sheet.part(4.78, 0.3, 2.16, 1.95), sizes)
    place_keys(sheet.axes)
    return figure


def _draw_blocks(sheet: Sheet, sizes: Sizes) -> None:
    shape, latent = 3 * sizes.n_beads, sizes.latent_dim
    sheet.trapezoid((2.325, ROW), 0.55, (0.9, 0.44), f"encoder\n{shape} → {latent}", TRAINED)
    sheet.box((3.4, 0.83), (0.8, 1.34), "neural\nODE\n∫ over τ", TRAINED)
    sheet.trapezoid((4.575, ROW), 0.55, (0.44, 0.9), f"decoder\n{latent} → {shape}", TRAINED)
    sheet.box((1.58, 1.84), (0.96, 0.32), f"steady solve\n{TERMINAL}({B_SYMBOL}), U$_\\mathrm{{term}}$", SOLVED)
    sheet.box((5.42, 1.84), (0.86, 0.32), f"the same\n{TERMINAL}({B_SYMBOL})", SOLVED)
    for x, sign in ((1.07, "−"), (1.62, "−"), (5.42, "+"), (6.06, "+")):
        sheet.junction((x, ROW), sign)
    for sketch in SKETCHES:
        sheet.fiber(*sketch)


def _draw_connections(sheet: Sheet, sizes: Sizes) -> None:
    """The lettered ones, then those by which the paper's are fed."""
    for letter, (beside, *corners) in CONNECTIONS.items():
        sheet.connection(letter, sizes.wires.get(letter, STATE), beside, *corners)
    sheet.wire((1.07, LANE), (1.07, ROW - 0.075))
    sheet.wire((0.5, BUS), (2.72, BUS), wire=PARAMETER, head=False)
    sheet.wire((1.62, BUS), (1.62, 2.0), wire=PARAMETER)
    sheet.wire((1.62, 1.4), (2.05, 1.4), wire=STEADY)
    sheet.wire((2.6, 1.33), (2.72, 1.33), (2.72, BUS), wire=STEADY, head=False)
    for x, y, wire in ((0.85, ROW, STATE), (1.07, LANE, STATE), (1.62, 1.4, STEADY), (2.72, BUS, BUNDLE)):
        sheet.dot((x, y), wire)


def _write_symbols(sheet: Sheet, sizes: Sizes) -> None:
    sheet.text((0.4, 0.8), f"{POSITIONS}(t)")
    sheet.words((0.4, 0.57), f"{sizes.n_beads} beads:\n{3 * sizes.n_beads} coordinates\nin units of L/2")
    for x, symbol in ((1.35, SHAPE), (1.86, RESIDUAL), (2.86, LATENT)):
        sheet.text((x, ROW + 0.1), f"{symbol}(t)")
    for x, symbol in ((4.05, LATENT), (5.1, RESIDUAL), (5.74, SHAPE)):
        sheet.text((x, ROW + 0.1), f"{symbol}(t + τ)")
    for x, time in ((1.5, "t"), (4.2, "t + τ")):
        sheet.text((x, LANE + 0.09), f"centre bead {CENTRE}({time})", ha="left")
    sheet.text((6.64, 0.8), f"{POSITIONS}(t + τ)")
    sheet.text((0.4, BUS), B_SYMBOL, fontsize=9.0)
    sheet.text((2.76, 1.8), LATENT_TERM, ha="left", color=STEADY.color)


def _open_encoder(part: Sheet, sizes: Sizes) -> None:
    """h = (P + Q(b)) Φ X̌, and h_term from X̄_term by the same matrices."""
    d, m, sees_B = sizes.latent_dim, sizes.modes_per_parity, sizes.wires["f"] is not ABSENT
    change = f"Q: network of ln {B_SYMBOL}, 1:{sizes.encoder_hidden}:{2 * m * d}\n" if sees_B else ""
    matrices = f"Φ: {m} odd and {m} even modes\nP: {d} × {2 * m}, linear in the shape\n"
    part.frame("encoder", f"{matrices}{change}odd and even modes kept apart")
    part.trapezoid((0.71, 1.08), 0.42, (0.9, 0.6), "POD\nmodes\nΦ", FIXED)
    part.trapezoid((1.24, 1.08), 0.38, (0.6, 0.4), "P + Q" if sees_B else "P", TRAINED)
    for y, wire, start, end in ((1.18, STATE, RESIDUAL, LATENT), (0.98, STEADY, TERMINAL, LATENT_TERM)):
        part.text((0.35, y), start, color=wire.color, ha="right")
        for x0, x1 in ((0.37, 0.5), (0.92, 1.05), (1.43, 1.55)):
            part.wire((x0, y), (x1, y), wire=wire)
        part.text((1.56, y), end, color=wire.color, ha="left")
    for x, width in ((0.41, 3 * sizes.n_beads), (0.985, 2 * m), (1.49, d)):
        part.count((x, 1.33), width)
    part.wire((1.24, 1.8), (1.24, 1.33), wire=sizes.wires["f"])
    part.text((1.29, 1.64), B_SYMBOL, ha="left", color=sizes.wires["f"].color)


def _open_node(part: Sheet, sizes: Sizes) -> None:
    """dh/dt = F_h − A h and dc/dt = U_term + G_c, integrated over τ."""
    d = sizes.latent_dim
    inputs = f"network of h + {LATENT_TERM} and ln {B_SYMBOL}, mirror symmetric,"
    scaled = "0 at h = 0; its inputs and rates scaled by the training set"
    part.frame("neural ODE", f"{inputs}\n{scaled}\nA = {sizes.damping:g} diag(std h) U$_s$/a")
    part.box((0.76, 1.05), (0.6, 0.66), f"network\n{_layers(d + 1, *sizes.node_hidden, d + 2)}", TRAINED)
    part.box((1.41, 1.49), (0.3, 0.17), "− A", FIXED)
    part.box((2.02, 1.05), (0.3, 0.78), "∫ dt\nover\nτ", FIXED)
    part.wire((2.02, 1.44), (2.02, 1.7), (0.2, 1.7), (0.2, 1.23), (0.46, 1.23))
    part.dot((1.41, 1.7))
    for x, y0, y1 in ((1.41, 1.7, 1.575), (1.41, 1.405, 1.305), (2.02, 0.5, 0.66)):
        part.wire((x, y0), (x, y1))
    part.wire((1.41, 0.65), (1.41, 0.795), wire=STEADY)
    part.wire((0.1, 0.87), (0.46, 0.87), wire=BUNDLE)
    part.text((0.28, 1.13), LATENT)
    part.text((0.05, 0.65), f"{B_SYMBOL}, {LATENT_TERM}", ha="left", color=BUNDLE.color)
    part.text((1.41, 0.57), f"U$_\\mathrm{{term}}$({B_SYMBOL})", color=STEADY.color)
    part.text((2.08, 0.54), f"{LATENT}(t), {CENTRE}(t)", ha="left")
    for y, state, rate, count in ((1.23, LATENT, "F$_h$", d), (0.87, CENTRE, "G$_c$", 2)):
        part.junction((1.41, y))
        for x0, x1 in ((1.06, 1.335), (1.485, 1.87), (2.17, 2.29)):
            part.wire((x0, y), (x1, y))
        part.text((1.18, y + 0.09), rate)
        part.count((1.18, y - 0.09), count)
        part.text((1.66, y + 0.09), f"d{state}/dt")
        part.text((2.3, y), f"{state}(t + τ)", ha="left")


def _open_decoder(part: Sheet, sizes: Sizes) -> None:
    """X̌ = Φᵀ (P₀ᵀ h + σ g(h))."""
    d, n_modes, wire, y = sizes.latent_dim, 2 * sizes.modes_per_parity, sizes.wires["k"], 1.13
    sees_B = wire is not ABSENT
    inputs = f"h + {LATENT_TERM} and ln {B_SYMBOL}" if sees_B else "h"
    words = "mirror symmetric, 0 at h = 0\nσ: size of each mode; P₀: leading modes"
    part.frame("decoder", f"network of {inputs},\n{words}")
    part.box((0.7, 1.05), (0.6, 0.5), f"network\n{_layers(d + sees_B, *sizes.decoder_hidden, n_modes)}", TRAINED)
    part.box((0.71, 1.53), (0.3, 0.18), "P₀ᵀ", FIXED)
    part.box((1.19, y), (0.16, 0.18), "σ", FIXED)
    part.trapezoid((1.77, y), 0.26, (0.55, 0.85), "Φᵀ", FIXED)
    part.junction((1.43, y))
    part.dot((0.27, y))
    part.wire((0.27, y), (0.27, 1.53), (0.56, 1.53))
    part.wire((0.86, 1.53), (1.43, 1.53), (1.43, y + 0.075))
    for x0, x1 in ((0.17, 0.4), (1.0, 1.11), (1.27, 1.355), (1.505, 1.64), (1.9, 2.01)):
        part.wire((x0, y), (x1, y))
    for x, width in ((0.18, d), (1.56, n_modes), (1.99, 3 * sizes.n_beads)):
        part.count((x, y + 0.15), width)
    part.text((0.11, y), LATENT)
    part.text((2.08, y), RESIDUAL)
    part.wire((0.7, 0.56), (0.7, 0.8), wire=wire)
    part.text((0.77, 0.64), f"{B_SYMBOL}, {LATENT_TERM}", ha="left", color=wire.color)


def _layers(*widths: int) -> str:
    """Widths as 5:64:64:24, in lines that a block holds."""
    return fill(" ".join(map(str, widths)), 11).replace("\n", ":\n").replace(" ", ":")
