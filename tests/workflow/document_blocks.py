"""What README.md and docs/*.md ask a reader to run or to write, in the order of the page, and the folder to do it in.

A command is a line of an `sh` or `console` block, or inline code that starts with one of PROGRAMS. Python, SQL and
R blocks are scripts; a Python or YAML block whose first line is `# name.py` or `# name.yaml` is a file to be written.
"""

import re
import shutil
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pandas as pd
from workflow_helpers import REPOSITORY

PAGES = [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md"))]
PROGRAMS = ("snakemake", "sedfiber", "make", "pip", "python", "pytest")
KINDS = {"sh", "console", "python", "yaml", "sql", "r", "text"}  # text: nothing to run
# Python for what is no command line: the help of every command, and SQL, which must find something.
SCRIPTS = {
    "sedfiber COMMAND --help": """
from sedfiber.commands.cli import COMMANDS, main
for name in COMMANDS:
    try:
        main([name, "--help"])
    except SystemExit as end:
        assert end.code == 0, name
""",
    "sql": "import duckdb, sys; sys.exit(0 if duckdb.sql(sys.argv[1]).fetchall() else 'no rows')",
}
# What inline code leaves out: a fiber, and where its run goes; and any file for FILE.
FIBER = "--B 1000 --theta0 0.7854"
OUTPUT = "-o fiber.parquet"
ANY_FILE = "traj.parquet"

# `sedfiber advise` reads what `snakemake -j1 cost` measured. Two choices at the ℬ around the one that docs/cost.md
# asks about, and three lengths, so that its words are those of the page; the times mean nothing.
CHOICES = ["family", "name", "tolerance", "batch", "precision", "error_worst", "seconds_median", "preparation_seconds"]
MEASURED = [
    ("forecast", "decoder_d2", 1e-4, 1000, "float32", 4e-2, 3e-4, 600.0),
    ("simulation", "LSODA", 1e-4, 1, "float64", 5e-3, 7e-3, 0.0),
]
LENGTHS = {"n_beads": [11, 31, 301], "shape_from_finest_L": [0.09, 0.04, 0.0]}

FENCED = re.compile(r"^```(?P<kind>.*)\n(?P<body>(?:.*\n)*?)```$", re.MULTILINE)
PART = re.compile(rf"{FENCED.pattern}|`(?P<inline>(?:{'|'.join(PROGRAMS)})\s[^`]+)`|`[^`]+`", re.MULTILINE)
FILE_NAME = re.compile(r"# (\S+\.(?:py|smk|yaml))\n")


@dataclass(frozen=True)
class Step:
    """One command, script or file; ``shown`` is the output that the page shows below a command, if any."""

    page: str
    line: int
    kind: str  # command, file, python, yaml, sql, r
    text: str
    shown: str = ""

    def __str__(self) -> str:
        name = self.text if self.kind == "command" else f"{self.kind} {self.text.splitlines()[0]}"
        return f"{self.page}:{self.line}: {name}"

    @property
    def file(self) -> str:
        """Name of the file to be written."""
        return FILE_NAME.match(self.text)[1]

    @property
    def promised(self) -> list[str]:
        """Files and folders that a command says it makes."""
        targets = re.findall(r" (results/\S+\.\w+)", self.text) if self.text.startswith("snakemake ") else []
        return targets + re.findall(r" (?:-o|--output|--report) ([\w./-]+)", self.text)


def steps_of(page: str, text: str) -> list[Step]:
    """All steps of a page. The same command again is left out, unless it writes a file, which others may have since."""
    steps = {}
    for part in PART.finditer(text):
        line = text.count("\n", 0, part.start()) + 1
        for found in _found(part):
            step = Step(page, line, *found)
            steps.setdefault((*found, line if " -o " in step.text else None), step)
    return list(steps.values())


def _found(part: re.Match) -> Iterator[tuple[str, ...]]:
    """Kind, text and output of what a block or inline code holds."""
    kind, body = part["kind"], part["body"]
    if part["inline"]:
        yield "command", completed(part["inline"])
    elif kind == "sh":
        yield from (("command", line) for line in map(_plain, body.replace("\\\n", " ").splitlines()) if line)
    elif kind == "console":
        for lines in re.split(r"^\$ ", body, flags=re.MULTILINE)[1:]:
            command, _, shown = lines.partition("\n")
            yield "command", _plain(command), shown
    elif kind in ("python", "yaml", "sql", "r"):
        yield "file" if FILE_NAME.match(body) else kind, body


def _plain(line: str) -> str:
    """Without the comment behind it, and with single blanks."""
    return " ".join(re.sub(r"(^|\s)#.*$", "", line).split())


def completed(inline: str) -> str:
    """Inline code may be short; what is run for it: "…" is dropped, FILE is a trajectory, the bare name of a
    sedfiber command asks for its help, and a simulation or forecast gets a fiber and an output if it has none.
    """
    text = re.sub(r"\bFILE\b", ANY_FILE, _plain(inline.replace("…", "")))
    if re.fullmatch(r"sedfiber \w+", text):
        return f"{text} --help"
    if re.match(r"sedfiber (simulate|forecast) (?!--help)", text):
        fiber = "" if re.search(r" --B |\.yaml|\.csv", text) else f" {FIBER}"
        output = "" if " -o " in text else f" {OUTPUT}"
        return text + fiber + output
    return text


def complete(folder: Path) -> None:
    """What a checkout has and the tiny study has not: published tables, measured costs, Makefile and environment."""
    shutil.copytree(folder / "results/tables", folder / "results/published/tables")
    _write_costs(folder / "results/tables")
    for name in ("Makefile", "pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(REPOSITORY / name, folder)
    _link_environment(folder / ".venv")


def _write_costs(tables: Path) -> None:
    """What `sedfiber advise` reads."""
    rows = [(*row, B, 6e-6) for row in MEASURED for B in (400, 700)]
    choices = pd.DataFrame(rows, columns=[*CHOICES, "B", "rhs_unit_s"])
    choices.to_csv(tables / "cost_choices.csv", index=False)
    lengths = pd.DataFrame(LENGTHS).assign(B=1000, hydrodynamics="RPY", status="ok")
    lengths.to_csv(tables / "cost_discretisation.csv", index=False)


def _link_environment(environment: Path) -> None:
    """This environment, which `make` finds ready: its mark is newer than what it is made from."""
    environment.mkdir()
    for path in Path(sys.prefix).iterdir():
        if path.name != ".ready":  # a mark of its own, so that this environment's is left alone
            (environment / path.name).symlink_to(path)
    (environment / ".ready").touch()
