"""The ``sedfiber`` command: one module of ``sedfiber.commands`` per verb."""

import argparse
import os
import re
import sys
import textwrap
import warnings
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import NoReturn

import sedfiber
from sedfiber.commands import steps
from sedfiber.commands.steps._step import add_arguments, call
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
# what the rules of the workflow call: each module is one, described by its first line
STEPS = sorted(one.name for one in iter_modules(steps.__path__) if not one.name.startswith("_"))
COMMANDS = [*TOOLS, *STEPS]
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
        run = _module(args.command).run
        run(args) if args.command in TOOLS else call(run, args)
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
    """Knows every command by name, and the options of ``command``, the only one that is imported."""
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
    for name in COMMANDS:
        sub = verbs.add_parser(name)  # without help: the description above lists them
        if name == command:
            _describe(name, sub)
    return parser


def _describe(command: str, parser: argparse.ArgumentParser) -> None:
    """Options and summary of one command."""
    module = _module(command)
    if command in TOOLS:
        parser.description = TOOLS[command]
        module.add_arguments(parser)
    else:
        parser.description = str(module.__doc__).splitlines()[0].partition(": ")[2]
        add_arguments(module.run, parser)


def _failed(command: str | None, words: str) -> int:
    print(f"sedfiber {command}: {words}", file=sys.stderr)
    return 1


def _listed() -> str:
    """All commands, those that a user calls first."""
    width = max(map(len, TOOLS)) + 2
    tools = [f"  {name:<{width}}{summary}" for name, summary in TOOLS.items()]
    of_workflow = textwrap.wrap(", ".join(STEPS), 100, initial_indent="  ", subsequent_indent="  ")
    words = "Flexible fibers that sink in a viscous fluid. `sedfiber COMMAND --help` lists a command's options."
    return "\n".join([words, "", "commands:", *tools, "", "steps of the workflow, called by its rules:", *of_workflow])
