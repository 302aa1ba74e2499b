"""The part of a scene that is a background flow."""

from dataclasses import dataclass

from sedfiber.core.errors import InputError
from sedfiber.core.validation import finite_number, one_of, positive_number, velocity_gradient, yes_or_no
from sedfiber.scene.part import Part, parameter

FLOWS = ("shear", "extension", "rotation", "parabolic")


@dataclass(frozen=True)
class Flow(Part):
    """A background flow: linear by name and rate or by gradient, or parabolic."""

    key, acts_in = "flow", "physics/{linear_flow, parabolic_flow, flow_couple, couple_flow}.py"
    summary = (
        "a background flow: shear u_x = rate·y, extension (x, −y)·rate, rotation (−y, x)·rate, any G·x, or parabolic"
    )
    source = "Jeffery 1922; Faxén 1922"

    name: str | None = parameter("-", f"one of {', '.join(FLOWS)}", None)
    rate: float | None = parameter("U_s/a", "of a named linear flow", None)
    gradient: tuple | None = parameter("U_s/a", "rows of G in u = G·x, instead of name and rate", None)
    peak: float | None = parameter("U_s", "of the parabolic flow u_x = peak (1 − y²/half_width²)", None)
    half_width: float | None = parameter("a", "of the parabolic flow", None)
    couple: bool = parameter("-", "beads turn with the fiber and not freely, so that the flow turns it too", True)

    def __post_init__(self) -> None:
        if self.name is not None:
            self._check(one_of, "name", FLOWS)
        wanted = self._wanted()
        for name in ("name", "gradient", "rate", "peak", "half_width"):
            given = getattr(self, name) is not None
            if given != (name in wanted):
                what = f"{getattr(self, name)!r} does not belong to this flow" if given else "is missing"
                raise InputError(f"flow.{name}: {what}; give {self._form()}, and couple if you like")
        for name, check in (("rate", finite_number), ("peak", finite_number), ("half_width", positive_number),
                            ("gradient", velocity_gradient)):  # fmt: skip
            if name in wanted:
                self._check(check, name)
        self._check(yes_or_no, "couple")

    @property
    def parabola(self) -> tuple[float, float] | None:
        """``peak`` and ``half_width`` of a parabolic flow, None of a linear one."""
        return None if self.peak is None or self.half_width is None else (self.peak, self.half_width)

    @property
    def matrix(self) -> tuple[tuple[float, ...], ...]:
        """G of a linear flow."""
        if self.gradient is not None:
            return self.gradient
        from sedfiber.physics.linear_flow import named_gradient  # compiled: only for those who ask

        assert self.name is not None and self.rate is not None  # or __post_init__ would have refused
        return named_gradient(self.name, self.rate)

    def _wanted(self) -> tuple[str, ...]:
        if self.gradient is not None:
            return ("gradient",)
        return ("name", "peak", "half_width") if self.name == "parabolic" else ("name", "rate")

    def _form(self) -> str:
        """The keys of this flow as a file has them; those of all flows where it is not known which it is."""
        parabolic, gradient = "{name: parabolic, peak: …, half_width: …}", "{gradient: …}"
        if self.gradient is not None:
            return gradient
        if self.name is None:
            return f"{{name: {', '.join(FLOWS[:-1])}, rate: …}}, {parabolic} or {gradient}"
        return parabolic if self.name == "parabolic" else f"{{name: {self.name}, rate: …}}"
