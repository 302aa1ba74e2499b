"""How long `sedfiber forecast` takes from a cold start to a written file; by hand: python tests/workflow/cold_start.py.

The bar is twice the import of NumPy and Arrow, which any program that writes such a file needs, and the
forecast itself. All are timed in turns, in one run, so that a busy machine slows all of them alike.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

START = ("--B", "1000", "--theta0", "0.7854")
IMPORTS = "import numpy, pyarrow.parquet"
ITSELF = """
import os, time
os.environ["OPENBLAS_NUM_THREADS"] = "1"  # as the command does
from sedfiber.reduced.forecaster import load_plain_model
model = load_plain_model()
begin = time.perf_counter()
model.settle(1000, 0.7854)
print(time.perf_counter() - begin)
"""


def measure(python: str | Path, folder: Path, turns: int = 7, env: dict[str, str] | None = None) -> dict[str, float]:
    """Medians in seconds of command, imports and forecast, and ``ratio``: the command over what it may take."""
    command = [python, "-m", "sedfiber", "forecast", *START, "-o", folder / "f.parquet"]
    lines = {"command": command, "imports": [python, "-c", IMPORTS]}
    times: dict[str, list[float]] = {"command": [], "imports": [], "forecast": []}
    for _ in range(turns):
        for name, line in lines.items():
            begin = time.perf_counter()
            subprocess.run(line, cwd=folder, env=env, check=True)
            times[name].append(time.perf_counter() - begin)
        said = subprocess.run([python, "-c", ITSELF], cwd=folder, env=env, capture_output=True, text=True, check=True)
        times["forecast"].append(float(said.stdout))
    found = {name: median(values) for name, values in times.items()}
    return found | {"ratio": found["command"] / (2.0 * found["imports"] + found["forecast"])}


def words(found: dict[str, float]) -> str:
    """The same in one line."""
    return (
        f"cold start {found['command']:.3f} s, imports {found['imports']:.3f} s, forecast {found['forecast']:.3f} s: "
        f"{found['ratio']:.2f} of what it may take"
    )


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        print(words(measure(sys.executable, Path(folder))))
