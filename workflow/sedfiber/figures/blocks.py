"""The vocabulary of block diagrams: boxes, trapezoids, junctions, wires, connection letters, small fibers.

A `Sheet` is a blank drawing measured in inches, so that a block has the size that its text needs.
Symbols are those of the paper: X̂ bead positions, X̄ the shape, X̌ the residual shape, h the
latent variables, c the centre bead.
"""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch, Patch, Polygon
from matplotlib.path import Path

from sedfiber.core.array_types import Array
from sedfiber.figures.style import B_SYMBOL, BLACK, BLUE, GREEN, GREY, VERMILION

POSITIONS, SHAPE, RESIDUAL, LATENT, CENTRE = "X̂", "X̄", "X̌", "h", "c"  # mathtext has no caron that fits
TERMINAL, LATENT_TERM = r"$\bar{\mathrm{X}}_\mathrm{term}$", r"h$_\mathrm{term}$"

_SMALL = 6.5  # points
_NODE = 0.075  # inches, radius of a junction
_HEAD = "-|>,head_length=4.5,head_width=2.1"  # points
Point = tuple[float, float]


class Look(NamedTuple):
    """Outline of a block in points, and how opaque its filling is."""

    color: str
    width: float
    tint: float

    @property
    def style(self) -> dict[str, Any]:
        """The options of a matplotlib patch."""
        return {"edgecolor": self.color, "facecolor": to_rgba(self.color, self.tint), "linewidth": self.width}


class Wire(NamedTuple):
    """A connection; ``opacity`` below 1 for one that is absent."""

    color: str
    width: float
    dashes: Any = "-"  # as matplotlib takes it
    opacity: float = 1.0


TRAINED, FIXED, SOLVED = Look(BLUE, 1.4, 0.16), Look(GREY, 0.8, 0.14), Look(GREEN, 1.4, 0.16)
STATE = Wire(BLACK, 0.9)
PARAMETER = Wire(VERMILION, 0.9)
BUNDLE = Wire(VERMILION, 2.0)  # ℬ and the latent place of its terminal shape
STEADY = Wire(GREEN, 0.9)
ABSENT = Wire(GREY, 0.8, (0, (2, 2)), 0.6)


class Sheet:
    """Axes without ticks, ``width`` by ``height`` inches, or a part of it whose origin is elsewhere."""

    def __init__(self, axes: Axes, width: float, height: float, origin: Point = (0.0, 0.0)) -> None:
        self.axes, self.width, self.height, self.origin = axes, width, height, origin

    @classmethod
    def on(cls, axes: Axes, width: float, height: float) -> "Sheet":
        """The whole of ``axes``, made blank."""
        axes.set(xlim=(0.0, width), ylim=(0.0, height), aspect="equal")
        axes.set_axis_off()
        return cls(axes, width, height)

    def part(self, x: float, y: float, width: float, height: float) -> "Sheet":
        """A part with its own origin."""
        return Sheet(self.axes, width, height, self._at((x, y)))

    def box(self, place: Point, size: Point, text: str, look: Look) -> None:
        """A rectangle around its middle ``place``."""
        (x, y), (width, height) = self._at(place), size
        corner = (x - 0.5 * width, y - 0.5 * height)
        rounded = "round,pad=0,rounding_size=0.03"
        self.axes.add_patch(FancyBboxPatch(corner, width, height, boxstyle=rounded, **look.style))
        self.words(place, text)

    def trapezoid(self, place: Point, width: float, heights: Point, text: str, look: Look) -> None:
        """A block that narrows or widens: its ``heights`` are those of its left and right sides."""
        (x, y), (left, right) = self._at(place), 0.5 * np.array(heights)
        x0, x1 = x - 0.5 * width, x + 0.5 * width
        self.axes.add_patch(Polygon([(x0, y - left), (x1, y - right), (x1, y + right), (x0, y + left)], **look.style))
        self.words(place, text)

    def junction(self, place: Point, sign: str = "+") -> None:
        """A circle in which wires are added, or subtracted."""
        self.axes.add_patch(Circle(self._at(place), _NODE, facecolor="white", edgecolor=BLACK, linewidth=0.8, zorder=3))
        self.text(place, sign, fontsize=7.5)

    def dot(self, place: Point, wire: Wire = STATE) -> None:
        """Draw a dot where a wire branches, or two join."""
        self.axes.add_patch(Circle(self._at(place), 0.025, facecolor=wire.color, edgecolor="none", zorder=3))

    def connection(self, letter: str, wire: Wire, beside: Point, *corners: Point) -> None:
        """A wire with the letter by which the paper calls it."""
        self.wire(*corners, wire=wire, label=f"connection {letter}")
        color = GREY if wire == ABSENT else BLACK
        self.text(beside, f"({letter})", fontsize=_SMALL, fontstyle="italic", color=color)

    def wire(self, *corners: Point, wire: Wire = STATE, head: bool = True, label: str = "") -> None:
        """A line through ``corners``, with an arrowhead at its end; ``label`` is what its patch is known by."""
        path = Path([self._at(corner) for corner in corners])
        look: dict[str, Any] = {"color": to_rgba(wire.color, wire.opacity), "linestyle": wire.dashes, "label": label}
        look |= {"arrowstyle": _HEAD if head else "-", "linewidth": wire.width, "joinstyle": "miter", "zorder": 1.5}
        self.axes.add_patch(FancyArrowPatch(path=path, mutation_scale=1.0, **look))

    def frame(self, title: str, words: str) -> None:
        """Outline, title above and words below."""
        middle = (0.5 * self.width, 0.5 * self.height)
        self.box(middle, (self.width, self.height), "", Look(GREY, 0.6, 0.0))
        self.text((0.08, self.height - 0.12), title, ha="left", fontweight="bold")
        self.words((middle[0], 0.27), words)

    def words(self, place: Point, text: str) -> None:
        """Small print."""
        self.text(place, text, fontsize=_SMALL, linespacing=1.3)

    def count(self, place: Point, number: int) -> None:
        """Write how many numbers a wire carries."""
        self.text(place, str(number), fontsize=_SMALL, color=GREY)

    def text(self, place: Point, text: str, **look: Any) -> None:
        """Words around ``place``, unless ``ha`` or ``va`` says otherwise."""
        usual: dict[str, Any] = {"ha": "center", "va": "center", "zorder": 4, "fontsize": 7.5}
        self.axes.text(*self._at(place), text, **usual | look)

    def fiber(self, origin: Point, beads: Array, color: str, centre: Point = (0.0, 0.0)) -> None:
        """A small fiber: beads (N, 2) in inches about the centre bead, a dot, which is at ``centre`` from a cross."""
        line = np.array(self._at(origin)) + beads + np.array(centre)
        cross: dict[str, Any] = {"color": GREY, "marker": "+", "markersize": 7.0, "markeredgewidth": 0.5}
        self.axes.plot(*self._at(origin), **cross, zorder=1.2)
        self.axes.plot(*line.T, color=color, linewidth=1.8, solid_capstyle="round", zorder=2)
        self.axes.plot(*line[len(line) // 2], color=BLACK, marker="o", markersize=2.4, zorder=2.1)

    def _at(self, place: Point) -> Point:
        return self.origin[0] + place[0], self.origin[1] + place[1]


def place_keys(axes: Axes) -> None:
    """Draw a legend of blocks and wires along the lower edge."""
    handles = [
        Patch(label="trained", **TRAINED.style),
        Patch(label="fixed before training", **FIXED.style),
        Patch(label=f"solved at that {B_SYMBOL}, no training", **SOLVED.style),
        Line2D([], [], color=PARAMETER.color, linewidth=PARAMETER.width, label=B_SYMBOL),
        Line2D([], [], color=BUNDLE.color, linewidth=BUNDLE.width, label=f"{B_SYMBOL} and {LATENT_TERM}"),
        Line2D([], [], color=ABSENT.color, linestyle=ABSENT.dashes, label="absent in this model"),
    ]
    axes.legend(handles=handles, loc="lower center", ncols=6, fontsize=_SMALL, borderaxespad=0.2, handlelength=1.8)


def bent(tilt: float, bend: float, half_length: float, n_beads: int = 31) -> Array:
    """A sketched fiber, (N, 2) about its centre bead: its tangent turns by ``bend`` from the middle to an end."""
    s = np.linspace(-1.0, 1.0, n_beads)
    angle = tilt + bend * 0.5 * (s[1:] + s[:-1])
    steps = np.stack([np.cos(angle), np.sin(angle)], axis=1) * half_length * np.diff(s)[:, None]
    beads = np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])
    return beads - beads[n_beads // 2]
