# make reproduce   the environment, then the whole study
# make quick       lint, types and the fast unit tests, in under two minutes
# make test        the environment, then all tests
# make publish     a full run of committed code, copied to results/published, and its model into the package

PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.PHONY: reproduce quick test publish lint environment lock clean

reproduce: environment
	PATH="$(CURDIR)/$(BIN):$$PATH" snakemake -j2

quick: lint
	PATH="$(CURDIR)/$(BIN):$$PATH" pytest -n 2 --dist loadscope -m "not slow" tests/unit

test: environment
	PATH="$(CURDIR)/$(BIN):$$PATH" pytest -n 2 --dist loadscope

publish: reproduce
	$(BIN)/sedfiber publish_results
	$(BIN)/sedfiber ship_model

lint: environment
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/snakefmt --check Snakefile workflow
	$(BIN)/mypy
	PATH="$(CURDIR)/$(BIN):$$PATH" snakemake --lint

environment: $(READY)

# Everything by checksum from the lock file. torch has no checksum, because its builds for CPU
# and GPU share a version; its pin stands in pyproject.toml.
$(READY): envs/requirements.lock pyproject.toml
	$(PYTHON) -c 'import sys; sys.exit(None if sys.version_info[:2] >= (3, 11) else "sedfiber needs Python 3.11 or newer; try make PYTHON=python3.11")'
	$(PYTHON) -m venv .venv
	$(BIN)/pip install -qq --no-deps --require-hashes -r envs/requirements.lock
	$(BIN)/pip install -qq "$$($(BIN)/python -c 'import tomllib; print(next(d for d in tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["train"] if d.startswith("torch==")))')"
	$(BIN)/pip install -qq --no-deps --no-build-isolation --editable .
	touch $(READY)
	@echo 'The environment is made. To use it: . .venv/bin/activate'

# Writes envs/requirements.lock anew from pyproject.toml: newest versions that fit.
lock: environment
	$(BIN)/python envs/lock.py

clean:
	rm -rf .venv
