"""Running a command as a shell would, and what it says when it must fail."""

from sedfiber.commands.cli import OneLineParser, main
from sedfiber.commands.steps._step import add_arguments, call


def status_of(argv):
    """Exit status of a command, whether it returns or the parser exits."""
    try:
        return main([str(word) for word in argv])
    except SystemExit as end:
        return end.code


def complaint(capsys, argv, status=None):
    """The one line on stderr of a command that must fail; nothing goes to stdout."""
    code = status_of(argv)
    said = capsys.readouterr()
    assert code not in (0, None)
    assert status is None or code == status
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert said.err.endswith("\n")
    assert "Traceback" not in said.err
    return said.err


def run_step(step, *words):
    """Run a step of the workflow, its module, as the command does; its errors are raised."""
    parser = OneLineParser()
    add_arguments(step.run, parser)
    call(step.run, parser.parse_args([str(word) for word in words]))
