"""Every command, script and file that README.md and docs/*.md show works, as it stands there.

Each page has a folder of its own and is read from top to bottom: a step finds what the steps above it made. What
Snakemake makes is shared, after a run of the tiny study, so that no page repeats another one's Snakemake line.
`document_blocks.py` says what counts as a step.
"""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
import yaml
from document_blocks import FENCED, KINDS, PAGES, PROGRAMS, SCRIPTS, Step, complete, steps_of
from numpy.testing import assert_allclose
from workflow_helpers import REPOSITORY, clean_environment

pytestmark = pytest.mark.slow

STEPS = [step for page in PAGES for step in steps_of(page.name, page.read_text(encoding="utf-8"))]
# Planned here with --dry-run instead of run: why, and what runs it.
ELSEWHERE = {
    "make test": ("it would run itself", ".ci/run::make test"),
    "pip install .": (
        "it would take the place of the package under test",
        "tests/workflow/test_installed.py::test_the_command_forecasts_with_the_model_that_came_along",
    ),
    "pip install '.[train]'": ("the same", "tests/workflow/test_installed.py::test_it_imports_nothing_slow"),
    "make publish": (
        "it needs committed code and overwrites what is published",
        "tests/unit/study/test_published.py::test_tables_drawings_and_manifest_are_copied_and_nothing_else",
    ),
    "snakemake -j2 films": ("15 s", "tests/workflow/test_run.py::test_films_play"),
    "snakemake -j2 scenes": (
        "half a minute",
        "tests/workflow/test_scenes.py::test_every_example_has_a_run_and_a_picture",
    ),
    "snakemake -j2 third_dimension": (
        "a fiber of 7 beads has no U at ℬ = 20000",
        "tests/workflow/test_scenes.py::test_the_third_dimension_turns_where_it_does",
    ),
    "snakemake -j2 effects": (
        "20 s, and it fails where other jobs of the machine disturb its times",
        "tests/unit/study/test_benchmarks.py::test_effects_table_compares_with_the_scene_as_it_is",
    ),
    "snakemake -j2 hard_cases": ("minutes", "tests/physics/test_hard_cases.py::test_hard_case"),
    "snakemake -j1 cost": ("a minute", "tests/workflow/test_run.py::test_costs_are_measured_from_a_finished_study"),
}
ON_A_CLUSTER = "--profile profiles/slurm"  # planned only, as well: jobs would go to Slurm
SLURMS_OWN = re.compile(r"(sbatch|squeue|sacct|scancel|sinfo|srun|salloc)\b")

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
DURATION = re.compile(rf"{NUMBER.pattern} (?:µs|ms|s|min|h)\b")
MADE_BY_SNAKEMAKE = ("results", ".snakemake")


class Reader:
    """Takes the steps of one page in order, in a folder where the study has run, unless they are in ``done``."""

    def __init__(self, folder: Path, page: str, done: dict):
        self.folder, self.done = folder, done
        self.steps = [step for step in STEPS if step.page == page]

    def take(self, wanted: Step) -> subprocess.CompletedProcess | None:
        """What a step said; those before it are taken first, so that one test can be run alone."""
        for step in self.steps[: self.steps.index(wanted) + 1]:
            if key_of(step) not in self.done:
                self.done[key_of(step)] = self._take(step)
        return self.done[key_of(wanted)]

    def _take(self, step: Step) -> subprocess.CompletedProcess | None:
        if step.kind == "file" and not (REPOSITORY / step.file).exists():
            (self.folder / step.file).parent.mkdir(exist_ok=True)
            (self.folder / step.file).write_text(step.text, encoding="utf-8")
        if step.kind in ("file", "yaml") or reason_to_skip(step):
            return None
        if not is_planned_only(step):
            for path in (self.folder / name for name in step.promised):  # only a new one counts
                shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
        return self.run(words_of(step, self.folder))

    def run(self, words: list[str]) -> subprocess.CompletedProcess:
        """Like a terminal: both outputs in one, this environment's programs first."""
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        how = {
            "cwd": self.folder,
            "env": clean_environment() | {"PATH": path},
            "stdin": subprocess.DEVNULL,
        }
        both = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        return subprocess.run(words, **how, **both, text=True, timeout=300, check=False)


def key_of(step: Step) -> Step | str:
    """The same for a Snakemake line on any page; a report is written into the page's own folder."""
    return step.text if re.match("snakemake (?!.*--report)", step.text) else step


def is_planned_only(step: Step) -> bool:
    """Whether a command is not run but planned."""
    return step.kind == "command" and (step.text in ELSEWHERE or ON_A_CLUSTER in step.text)


def words_of(step: Step, folder: Path) -> list[str]:
    """The program and its arguments that a step stands for."""
    if step.text in SCRIPTS:
        return ["python", "-c", SCRIPTS[step.text]]
    if step.kind == "command":
        line = f"{step.text} --dry-run" if is_planned_only(step) else step.text
        return ["bash", "-euo", "pipefail", "-c", line]
    if step.kind == "r":
        (folder / "block.R").write_text(step.text, encoding="utf-8")
        return ["Rscript", "-e", "invisible(parse('block.R'))"] if missing_in_r(step) else ["Rscript", "block.R"]
    return ["python", "-c", *([SCRIPTS["sql"]] if step.kind == "sql" else []), step.text]


@cache
def missing_in_r(step: Step) -> list[str]:
    """Packages of an R block that this R has not."""
    asked = ["Rscript", "-e", "quit(status = !requireNamespace(commandArgs(TRUE), quietly = TRUE))"]
    packages = re.findall(r"\blibrary\((\w+)\)", step.text)
    return [name for name in packages if subprocess.run([*asked, name], capture_output=True).returncode]


def reason_to_skip(step: Step) -> str | None:
    """Why a step is not taken at all on this machine."""
    if step.kind == "r" and not shutil.which("Rscript"):
        return "there is no R to run R blocks with; on Debian: apt-get install r-base-core"
    if step.kind == "command" and SLURMS_OWN.match(step.text):
        return "Slurm's own commands need a cluster: slurm_run.py starts one"
    return None


@pytest.fixture(scope="module")
def reader_of(finished, tmp_path_factory) -> Callable[[str], Reader]:
    """The reader of a page, in a checkout in which `make reproduce` has run."""
    study, done = tmp_path_factory.mktemp("documents") / "study", {}
    shutil.copytree(finished.folder, study)
    complete(study)

    @cache
    def of(page: str) -> Reader:
        folder = study.with_name(page)
        shutil.copytree(study, folder, symlinks=True, ignore=shutil.ignore_patterns(*MADE_BY_SNAKEMAKE))
        for name in MADE_BY_SNAKEMAKE:
            (folder / name).symlink_to(study / name)
        return Reader(folder, page, done)

    return of


@pytest.mark.parametrize("step", STEPS, ids=str)
def test_it_works_as_it_stands_there(step, reader_of):
    """It succeeds, writes the files that it names, and says what the page shows."""
    reader, reason = reader_of(step.page), reason_to_skip(step)
    if reason:
        pytest.fail(reason) if step.kind == "r" and os.environ.get("CI") else pytest.skip(reason)
    done = reader.take(step)
    if step.kind in ("file", "yaml"):
        return check_file(step)
    assert done.returncode == 0, done.stdout[-4000:]
    if not is_planned_only(step):
        assert [name for name in step.promised if not (reader.folder / name).exists()] == []
    if step.shown:
        check_words(step, done.stdout)
    if step.kind == "r" and missing_in_r(step):
        pytest.skip(f"R lacks {', '.join(missing_in_r(step))}: the block was parsed, not run")


def check_file(step: Step) -> None:
    """A file of the repository is shown as it is; YAML can be read."""
    if step.kind == "yaml" or step.file.endswith(".yaml"):
        shown = yaml.safe_load(step.text)
        assert isinstance(shown, dict)
    else:
        shown = step.text
        if step.file.endswith(".py"):
            compile(shown, step.file, "exec")
    if step.kind == "file" and (REPOSITORY / step.file).exists():
        text = (REPOSITORY / step.file).read_text(encoding="utf-8")
        assert shown == (yaml.safe_load(text) if step.file.endswith(".yaml") else text)


def check_words(step: Step, said: str) -> None:
    """The same words; durations are this machine's; other numbers to a percent, or to 1e-6 where they are round-off.
    Of `sedfiber advise` only the words, for its numbers are those of the whole study.
    """
    said, shown = (DURATION.sub("duration", text) for text in (said, step.shown))
    assert NUMBER.sub("#", said).splitlines() == NUMBER.sub("#", shown).splitlines()
    if not step.text.startswith("sedfiber advise "):
        numbers = [[float(number) for number in NUMBER.findall(text)] for text in (said, shown)]
        assert_allclose(*numbers, rtol=0.01, atol=1e-6)


@pytest.mark.parametrize("command", ELSEWHERE)
def test_what_is_only_planned_here_is_run_elsewhere(command):
    """It still stands in a document, and what runs it is still there."""
    assert command in {step.text for step in STEPS}
    path, name = ELSEWHERE[command][1].split("::")
    assert re.search(rf"^(def )?{name}\b", (REPOSITORY / path).read_text(encoding="utf-8"), re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_block_says_what_it_is(page):
    """A fence that is not closed, is indented or has no known kind would hide its commands, and so would a bare
    command in a block of kind text. What is refused may stand there, after "$ ", with the line that says so.
    """
    text = page.read_text(encoding="utf-8")
    blocks = list(FENCED.finditer(text))
    plain = "\n".join(block["body"] for block in blocks if block["kind"] == "text")
    assert text.count("```") == 2 * len(blocks)
    assert {block["kind"] for block in blocks} <= KINDS
    assert all(block["body"].startswith("$ ") for block in blocks if block["kind"] == "console")
    assert not re.findall(rf"^(?:{'|'.join(PROGRAMS)}) (?!\w+: ).*", plain, re.MULTILINE)


PAGE = """
Say `sedfiber plot FILE -o a.png` or `snakemake -n`, not `load_model(…)`; `sedfiber
forecast` or `sedfiber simulate --rtol 1e-4`.

```sh
make test   # takes long
# only a comment
snakemake -n
```

```yaml
# a.yaml
B: 1
```

```console
$ sedfiber simulate a.yaml -o a.parquet
said 1
$ sedfiber simulate a.yaml -o a.parquet
```
"""


def test_commands_are_found_in_text_and_blocks():
    """In order, without comments, completed where inline code is short; a file written twice is written twice."""
    assert [(step.line, step.kind, step.text, step.shown) for step in steps_of("page.md", PAGE)] == [
        (2, "command", "sedfiber plot traj.parquet -o a.png", ""),
        (2, "command", "snakemake -n", ""),
        (2, "command", "sedfiber forecast --help", ""),
        (3, "command", "sedfiber simulate --rtol 1e-4 --B 1000 --theta0 0.7854 -o fiber.parquet", ""),
        (5, "command", "make test", ""),
        (11, "file", "# a.yaml\nB: 1\n", ""),
        (16, "command", "sedfiber simulate a.yaml -o a.parquet", "said 1\n"),
        (16, "command", "sedfiber simulate a.yaml -o a.parquet", ""),
    ]
