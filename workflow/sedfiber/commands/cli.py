"""The ``sedfiber`` command: one module of ``sedfiber.commands`` per verb."""

import argparse
import os
import re
import sys
import textwrap
import warnings
from importlib import import_module
from types import ModuleType
from typing import NoReturn

import sedfiber
from sedfiber.core.errors import SedfiberError

# what a user calls
TOOLS = {
    "simulate": "integrate a scene and write its trajectory",
    "effects": "every effect a scene may list: parameters, units, defaults, source",
    "steady": "terminal shape and speed at one elasto-gravitational number",
    "forecast": "forecast one fiber, or every row of a table, with the trained model",
    "plot": "draw any trajectory, simulated or forecast",
    "compare": "E(t) of one trajectory against another",
    "advise": "which method or model reaches an accuracy, and what it takes on this machine",
}
# what the rules of the workflow call
STEPS = {
    "solve_terminal_shapes": "steady shapes of several elasto-gravitational numbers in one table",
    "solve_terminal_curve": "terminal shapes of a whole range of elasto-gravitational numbers as one series",
    "aggregate_dataset": "the trajectories of one split as one data set",
    "tabulate_trajectories": "settling time, cost and checks of every run",
    "check_simulation": "one run again with another method and tighter tolerance",
    "tabulate_checks": "the largest difference of every run from its check",
    "tabulate_audit": "what each run left out, and whether it mattered",
    "compare_third_dimension": "out-of-plane growth at each ℬ, predicted and run; where it turns",
    "trace_states": "steady states against ℬ, their growth rates, and where they gain or lose stability",
    "measure_effects": "cost and influence of every effect on the study's scene",
    "benchmark_parts": "the study's scene against one kernel written for it alone",
    "train_autoencoder": "one autoencoder of one variant and latent dimension",
    "tabulate_reconstruction": "reconstruction loss of every autoencoder, and of POD",
    "train_node": "the neural ODE on a trained autoencoder, together a forecast model",
    "forecast_test_set": "forecast every trajectory of a split from its first sample",
    "forecast_by_lookup": "the baseline without a model: splines through the training runs",
    "tabulate_forecast_errors": "E(t) of all forecasts of both test sets",
    "tabulate_timings": "time of every stage, summed from the benchmark files",
    "write_manifest": "provenance: configuration, versions and a checksum of every output",
    "measure_hard_case": "run one hard case and say what it was measured by",
    "tabulate_hard_cases": "all hard cases in one table, the failing ones among them",
    "measure_integrators": "error and time of every integrator over one fall of the study",
    "measure_trajectories": "error and time of many falls of the study with the default integrator",
    "measure_discretisation": "what beads and hydrodynamics cost and change over one fall of the study",
    "measure_models": "training time, size, error and speed of every variant and latent dimension",
    "measure_choices": "error and time of simulations, forecasts, lookup and POD-Galerkin on the test trajectories",
    "measure_model_growth": "simulation against forecast at another number of beads",
    "tabulate_costs": "the same measurement of several cases as one table",
    "draw": "one figure, from files alone",
    "tabulate_regimes": "how each fall turns and bends, and which regime that is",
    "tabulate_lags": "by how much time each forecast is late, and what error is left without that",
    "tabulate_key_numbers": "this run, the source's claim and the bar, number by number",
    "show_table": "a CSV table as an HTML page, for the report",
    "show_manifest": "where the results come from, as an HTML page, for the report",
    "make_explorer": "the trained model as one HTML page that forecasts in the browser, offline",
    "publish_results": "copy tables, figures and manifest of a full run to where the repository shows them",
    "ship_model": "copy the forecast model of a full run into the package, with a card that says what it is worth",
    "compare_published": "a fresh run's numbers against the published ones, within stated tolerances",
    "film_forecast": "film: a test trajectory, true and forecast, with E(t) running below",
    "film_scene": "film: a scene's run",
}
COMMANDS = TOOLS | STEPS
# what comes with the extra `train` of the package
TRAINING = ("torch", "torchdiffeq", "pytorch_optimizer")
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
REMEDY = "in the checkout: pip install '.[train]', or make environment"


class OneLineParser(argparse.ArgumentParser):
    """An argument parser whose errors are one line, and to which -1e-4 is a number."""

    def __init__(self, *args, **options):
        super().__init__(*args, **options)
        # argparse before Python 3.14 takes an exponent for an option's name
        self._negative_number_matcher = re.compile(r"^-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$|^-inf$|^-nan$")

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}\n")


def main(argv: list[str] | None = None) -> int:
    """Run one command; returns the exit status: 0, 1 for a failure, 2 for bad usage."""
    argv = sys.argv[1:] if argv is None else argv
    if argv == ["--version"]:
        print(f"sedfiber {sedfiber.__version__}")
        return 0
    _ask_for_one_thread()
    command = next((word for word in argv if not word.startswith("-")), None)
    warnings.filterwarnings("ignore", category=UserWarning, module="scipy.integrate")  # they become our errors
    try:
        args = _parser(command, argv).parse_args(argv)
        _module(args.command).run(args)
    except SedfiberError as error:
        return _failed(command, str(error))
    except ModuleNotFoundError as error:
        if error.name not in TRAINING:
            raise
        return _failed(command, f"needs {error.name}, which is not installed; {REMEDY}")
    except KeyboardInterrupt:
        return 130
    return 0


def _module(command: str) -> ModuleType:
    """The module that does the work of a command; it alone is imported."""
    return import_module(f"sedfiber.commands.{command}" if command in TOOLS else f"sedfiber.commands.steps.{command}")


def _ask_for_one_thread() -> None:
    """Unless a user says how many: for matrices as small as here more threads take longer, up to five times on a busy
    machine, and their number changes last bits. NumPy, which looks when it is imported, has not been yet.
    """
    if not any(name in os.environ for name in THREADS):
        os.environ.update(dict.fromkeys(THREADS, "1"))


def _parser(command: str | None, argv: list[str]) -> OneLineParser:
    """Knows every command by name, and the options of the one that is asked for, which alone is imported."""
    parser = OneLineParser(
        prog="sedfiber",
        usage="sedfiber COMMAND [options]",
        description=_listed(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    if command not in COMMANDS and not {"-h", "--help"} & set(argv):
        what = "missing" if command is None else f"{command!r} is not allowed"
        parser.error(f"command: {what}; give {', '.join(TOOLS)}, or a step of the workflow (sedfiber --help)")
    verbs = parser.add_subparsers(
        dest="command",
        prog="sedfiber",
        required=True,
        metavar="COMMAND",
        help=argparse.SUPPRESS,
        parser_class=OneLineParser,
    )
    for name, summary in COMMANDS.items():
        sub = verbs.add_parser(name, description=summary)  # without help: the description above lists them
        if name == command:
            _module(name).add_arguments(sub)
    return parser


def _failed(command: str | None, words: str) -> int:
    print(f"sedfiber {command}: {words}", file=sys.stderr)
    return 1


def _listed() -> str:
    """All commands, those that a user calls first."""
    width = max(map(len, TOOLS)) + 2
    tools = [f"  {name:<{width}}{summary}" for name, summary in TOOLS.items()]
    steps = textwrap.wrap(", ".join(STEPS), 100, initial_indent="  ", subsequent_indent="  ")
    words = "Flexible fibers that sink in a viscous fluid. `sedfiber COMMAND --help` lists a command's options."
    return "\n".join([words, "", "commands:", *tools, "", "steps of the workflow, called by its rules:", *steps])
