# What all rules share: the validated configuration, names of files, and what the code of a command means.

import json
import shlex
import subprocess
import sys
from pathlib import Path

from snakemake.iocontainers import Wildcards

BASE = Path(workflow.basedir)
sys.path.insert(0, str(BASE / "workflow"))

from sedfiber.core.errors import InputError
from sedfiber.study.hard_cases.listing import NAMES as HARD_CASES, case_of
from sedfiber.study.code_fingerprint import code_fingerprint
from sedfiber.study.configuration import SCENE_NAME, Study, scene_names


def read_or_exit(read, *words):
    """What a file of the user's says; an error in it ends Snakemake with one line, before any job."""
    try:
        return read(*words)
    except InputError as error:
        sys.exit(str(error))


STUDY = read_or_exit(Study.from_config, config, BASE / "workflow/schemas/config.schema.yaml")


wildcard_constraints:
    B=r"[0-9.e+]+",
    k=r"\d+",
    split="train|A|B",
    variant="none|encoder|decoder|double",
    dim=r"\d+",
    seed=r"\d+",
    model=r"(?!lookup)\w+",
    scene=SCENE_NAME,
    case=r"\w+",


# With --sdm conda each job's own python is meant, otherwise the one that runs this workflow.
USES_CONDA = any("conda" in str(m).lower() for m in workflow.deployment_settings.deployment_method)
PYTHON = "python" if USES_CONDA else sys.executable
SOURCE_ROOT = str(BASE / "workflow")

shell.prefix(
    "set -euo pipefail; "
    "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1; "
    f"export PYTHONPATH={shlex.quote(SOURCE_ROOT)}; "
    # doubled twice: once for this f-string, once because Snakemake formats the prefix
    f'sedfiber() {{{{ {shlex.quote(PYTHON)} -m sedfiber "$@"; }}}}; '
    f'snakemake() {{{{ {shlex.quote(sys.executable)} -m snakemake "$@"; }}}}; '
)


def here(path):
    """A file of the workflow, relative when the run's folder is the workflow's own."""
    return str(path.relative_to(BASE) if Path.cwd() == BASE else path)


LOCK = BASE / "envs/requirements.lock"


def code_of(command, *modules):
    """What the command's result depends on besides its inputs: the meaning of its code, and the lock file."""
    return code_fingerprint(command, modules, [LOCK])


def trajectory(B, k):
    return f"results/trajectories/B{B}_k{k}.parquet"


def trajectories(split):
    return [trajectory(B, k) for B, k in STUDY.runs(split)]


def as_json(settings):
    """Hyper-parameters as one word of a command."""
    return json.dumps(settings, sort_keys=True)


def simulate_options():
    """What all runs share: `sedfiber simulate` is a person's command and takes options, not settings."""
    words = {
        f"--{key.replace('_', '-')}": value for key, value in STUDY.simulation_settings.items()
    }
    given = {
        option: "" if value is True else value
        for option, value in words.items()
        if value is not False
    }
    return " ".join(f"{option} {value}".rstrip() for option, value in given.items())


def autoencoder(variant, dim, seed):
    return f"results/models/autoencoders/{variant}_d{dim}_s{seed}"


def autoencoder_of(model):
    """The autoencoder's folder that a neural ODE stands on."""
    node = NODES[model]
    return autoencoder(node["variant"], node["latent_dim"], node["seed"])


def model_files(folder):
    """The files of a model on disk: weights, and the card that says what they are."""
    return [f"{folder}/model.safetensors", f"{folder}/card.json"]


def forecaster(name):
    """Name, recipe and latent dimension, for the error tables."""
    node = NODES.get(name, {"recipe": "lookup", "latent_dim": None})
    return [name, node["recipe"], node["latent_dim"]]


def scene_files(scene):
    """A scene's file, and the files beside it that scenes name: start shapes, effects of the user's."""
    beside = [
        path
        for path in (BASE / "scenes").glob("*")
        if path.suffix in (".csv", ".npy", ".parquet", ".py")
    ]
    return [here(path) for path in [BASE / "scenes" / f"{scene}.yaml", *sorted(beside)]]


def hard_case_code(wildcards):
    """What the command and the module that measures the case depend on."""
    return code_of("measure_hard_case", f"study.hard_cases.{case_of(wildcards.case).module}")


def hard_case_model(wildcards):
    """The trained model, for the cases that forecast."""
    return model_files("results/models/forecast") if case_of(wildcards.case).needs_model else []


def short_autoencoder(wildcards):
    """The study's autoencoder that a neural ODE trained in short stands on: seeds are those of the ODE."""
    return autoencoder(wildcards.variant, wildcards.dim, config["autoencoders"]["seeds"][0])


def split_files(split):
    """A split's data set and the terminal shapes beside it."""
    return [f"results/{folder}/{split}.parquet" for folder in ("dataset", "terminal_shapes")]


def benchmarks_of(rule, results):
    """The benchmark files of the jobs of a rule, which are named as their results."""
    return [f"results/benchmarks/{rule}/{Path(result).stem}.tsv" for result in results]


def asked_models():
    """The study's forecast models, with the benchmark files of their trainings; the paper's recipe is judged elsewhere."""
    return [
        {
            "name": name,
            "folder": f"results/models/node/{name}",
            "benchmarks": [
                *benchmarks_of("train_autoencoder", [autoencoder_of(name)]),
                *benchmarks_of("train_node", [name]),
            ],
        }
        for name, node in NODES.items()
        if node["recipe"] == "rollout"
    ]


def cost_models():
    """Every model that is weighed against its training."""
    asked = {
        model["name"]: {key: model[key] for key in ("folder", "benchmarks")}
        for model in ASKED_MODELS
    }
    study = [
        {"recipe": "study", "seed": NODES[name]["seed"], **model} for name, model in asked.items()
    ]
    return study + [short_model(*one) for one in STUDY.short_models]


def short_model(variant, dim, seed):
    name, first = f"{variant}_d{dim}_s{seed}", config["autoencoders"]["seeds"][0]
    files = [
        *benchmarks_of("train_autoencoder", [autoencoder(variant, dim, first)]),
        *benchmarks_of("train_short_node", [name]),
    ]
    return {
        "recipe": "short",
        "seed": seed,
        "folder": f"results/models/short/{name}",
        "benchmarks": files,
    }


# Jobs that measure time take all cores, so that nothing runs beside them. Snakemake cuts it down to
# what there is; workflow.cores would do, but is unknown where Snakemake makes only the graph.
EVERY_CORE = 1024
SCENES = read_or_exit(scene_names, BASE / "scenes")
TEST_SETS = ("A", "B")
NODES = config["node"]["models"]
FORECAST_MODEL = config["node"]["forecast_model"]
FORECASTERS = [*NODES, "lookup"]
AUTOENCODERS = [
    autoencoder(variant, dim, seed)
    for variant in config["autoencoders"]["variants"]
    for dim in config["autoencoders"]["latent_dims"]
    for seed in config["autoencoders"]["seeds"]
]
SIMULATE_OPTIONS = simulate_options()
ASKED_MODELS = asked_models()
COST_MODELS = cost_models()
COST_CASES = {
    "integrators": [f"results/costs/integrators/B{B}_k{k}.csv" for B, k in STUDY.integrator_runs],
    "model_growth": [
        f"results/costs/model_growth/N{n}.csv" for n in config["cost"]["model_growth"]["n_beads"]
    ],
}


def benchmarks():
    """The benchmark file of every job that the study's results need, in the order of the rules."""
    found = {
        stage: {} for stage in workflow.rules if stage.name != "choose_forecast_model"
    }  # copies files
    todo, seen = [file for files in STUDY_RESULTS for file in files], set()
    while todo:
        file = todo.pop()
        stage = next((one for one in workflow.rules if one.is_producer(file)), None)
        job = stage and Wildcards(fromdict=stage.get_wildcards(file))
        if stage is None or (stage, str(job)) in seen:
            continue
        seen.add((stage, str(job)))
        todo.extend(stage.expand_input(job)[0])
        if stage in found:
            found[stage][str(stage.expand_benchmark(job))] = None
    return [file for files in found.values() for file in files]


def commit():
    """The commit of the code, with a mark when files differ from it; "unknown" outside git."""
    git = ["git", "-C", str(BASE), "describe", "--always", "--dirty", "--abbrev=40"]
    found = subprocess.run(git, capture_output=True, text=True)
    return found.stdout.strip() if found.returncode == 0 else "unknown"
