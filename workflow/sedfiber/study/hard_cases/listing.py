"""All hard cases, in the order of the table; each is measured by the function of its name in its module."""

from sedfiber.core.errors import InputError
from sedfiber.study.hard_cases.case import HardCase

ANOTHER_METHOD = "another method at a tolerance 100 times tighter"

CASES = (
    HardCase(
        "stiffest",
        "stiffness_cases",
        "springs relax a million times faster than the fiber rotates",
        "agrees with another method to 1e-4 L at every sample; the dissipation balance holds",
        ANOTHER_METHOD,
    ),
    HardCase(
        "floppiest_of_the_study",
        "stiffness_cases",
        "the fiber snakes, and neighbouring starts part company",
        "agrees with another method to 1e-4 L at all 23 angles; the dissipation balance holds",
        ANOTHER_METHOD,
    ),
    HardCase(
        "beyond_the_U",
        "stiffness_cases",
        "above B = 63299 there is no terminal U, beads meet, and plain RPY attracts those that overlap",
        "agrees with another method with contact; the audit misses contact; plain RPY refuses by name",
        ANOTHER_METHOD,
    ),
    HardCase(
        "exactly_symmetric",
        "symmetry_cases",
        "the W is unstable to left-right asymmetry, and round-off is asymmetric",
        "symmetric to 1e-9 a to the end; the end is named U or W, and a W is never the terminal U",
        "all beads as unknowns by Radau at 1e-11, while round-off has not grown past 1e-6 a",
    ),
    HardCase(
        "all_but_symmetric",
        "symmetry_cases",
        "a tilt of 1e-4 rad grows on the W by its own rate: errors do as well",
        "three methods at two tolerances tell the same history to 1e-3 L",
        "Radau at 1e-12",
    ),
    HardCase(
        "exactly_vertical",
        "symmetry_cases",
        "the straight vertical fall is a steady state that is always unstable",
        "the exact start falls straight; 1e-8 rad from it the fiber buckles at the predicted rate to 1 %",
        "the spectrum of the vertical state",
    ),
    HardCase(
        "out_of_the_plane",
        "journey_cases",
        "above B = 3699 the terminal U repels what leaves its plane, slowly enough to be overlooked",
        "returns to the plane at B = 3000, leaves it at 10000 at the predicted rate, and is never called settled",
        "the spectrum of the terminal U",
    ),
    HardCase(
        "fall_of_a_million",
        "journey_cases",
        "a shape of size 30 a far from the origin loses digits, and tolerances relative to the place grow",
        "shape after the fall equals shape before to 1e-8 L",
        "the steady state, and the same fall near the origin",
    ),
    HardCase(
        "beads",
        "resolution_cases",
        "three beads are hardly a fiber, and 301 are 30 million times stiffer",
        "an arc converges at order 1 toward 301 beads; the speed grows as slender-body theory says",
        "the finest fiber; slender-body theory",
    ),
    HardCase(
        "overlapping_beads",
        "start_cases",
        "plain RPY is not positive definite for beads far inside each other, and no form has a direction at r = 0",
        "the overlap form integrates; plain RPY refuses where it is indefinite, naming the pair; r = 0 refuses",
        ANOTHER_METHOD,
    ),
    HardCase(
        "crumpled",
        "start_cases",
        "beads start inside each other, with energies a thousand times those of the fall",
        "no NaN, the energy falls at every sample, and all 50 settle to the U",
        "the terminal U; the second law",
    ),
    HardCase(
        "nonsense_starts",
        "start_cases",
        "files and arrays come with NaN, the wrong shape, or nothing in them",
        "an error of one line that names the key",
        "none needed",
    ),
    HardCase(
        "loose_tolerances",
        "tolerance_cases",
        "a solver can report success for a shape that is nowhere near",
        "within ten times the tolerance of the truth, or an error",
        "Radau at 1e-12",
    ),
    HardCase(
        "explicit_on_a_stiff_fiber",
        "tolerance_cases",
        "an explicit method needs thousands of steps a time unit, and its give-up is easily missed",
        "finishes right, or refuses with the reason and the advice to use the default",
        ANOTHER_METHOD,
    ),
    HardCase(
        "forecast_ten_settling_times",
        "forecasting_cases",
        "nothing in a neural ODE keeps it at its fixed point for longer than it was trained",
        "bounded, and at the terminal shape to 1e-3 L after ten settling times, over the whole training range",
        "the steady solver",
        needs_model=True,
    ),
    HardCase(
        "forecast_outside_range",
        "forecasting_cases",
        "networks extrapolate to anything",
        "bounded, at the terminal shape to 1e-3 L, warned of in one line; --strict refuses",
        "the steady solver; the symmetry of the fiber",
        needs_model=True,
    ),
    HardCase(
        "forecast_far_shape",
        "forecasting_cases",
        "the encoder was never shown an arch, an S or a zigzag",
        "bounded, at the terminal shape to 1e-3 L, with a warning of one line; what is no start is an error",
        "the steady solver",
        needs_model=True,
    ),
    HardCase(
        "forecast_single_and_batched",
        "forecasting_cases",
        "a batch shares its time step, and calm members can hide a wild one",
        "each forecast of a batch equals the one alone to 1e-6 L",
        "the forecasts one by one",
        needs_model=True,
    ),
    HardCase(
        "forecast_float32",
        "forecasting_cases",
        "rounding grows on the unstable W as any disturbance does",
        "float32 equals float64 to 1e-4 L, beside the W to the forecasts' own 1e-2, and ends at the terminal shape",
        "the same networks in float64",
        needs_model=True,
    ),
    HardCase(
        "training_nan",
        "training_cases",
        "one NaN spreads through every weight in one step",
        "all trainings stop in one line with the trajectory's name",
        "the name of the trajectory that was spoilt",
    ),
    HardCase(
        "training_constant",
        "training_cases",
        "path length and distance travelled are divided by",
        "all trainings stop in one line with the trajectory's name",
        "the name of the trajectory that was spoilt",
    ),
    HardCase(
        "training_diverging",
        "training_cases",
        "a rollout that blows up poisons the optimiser's averages",
        "a bad step is reported and skipped, too many stop the training by name; no NaN is ever saved",
        "the solution of a linear regression; the files on disk",
    ),
)

NAMES = tuple(case.name for case in CASES)


def case_of(name: str) -> HardCase:
    """The case of that name; raises InputError for an unknown one."""
    for case in CASES:
        if case.name == name:
            return case
    raise InputError(f"case: {name!r} is not allowed; give one of {', '.join(NAMES)}")
