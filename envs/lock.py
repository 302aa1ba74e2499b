"""Write requirements.lock from pyproject.toml: every package but torch, with checksums."""

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
LOCK = HERE / "requirements.lock"
HEADER = """\
# Everything but torch, with checksums; `make lock` writes this file from pyproject.toml.
# torch has none because CPU and GPU builds of one version differ: its pin is in pyproject.toml.
"""
OPTIONS = [
    "--generate-hashes",
    "--unsafe-package=torch",
    "--extra=train",
    "--extra=workflow",
    "--extra=dev",
    "--strip-extras",
    "--no-annotate",
    "--no-header",
    "--no-emit-index-url",
    "--no-emit-find-links",
    "--no-emit-trusted-host",
    "--no-emit-options",
    "--upgrade",
    "--quiet",
]


def main() -> None:
    """Run pip-compile and put our own header above what it wrote."""
    command = [sys.executable, "-m", "piptools", "compile", *OPTIONS, f"--output-file={LOCK}"]
    subprocess.run([*command, str(HERE.parent / "pyproject.toml")], check=True)
    pins, _, _ = LOCK.read_text(encoding="utf-8").partition("\n# WARNING")
    LOCK.write_text(HEADER + pins.rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
