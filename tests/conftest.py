"""Settings and models that every test shares; threads are set before NumPy is imported."""

import os

for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

import pytest  # noqa: E402
from hypothesis import settings  # noqa: E402

# The same examples on every machine and in every run; a slow machine fails no test.
settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=25, database=None)
settings.load_profile("repeatable")

# Test files that share what is slow to make: a group stays on one worker. They stand here and not as marks of
# pytest-xdist, which are without effect from pytest 9.2 on; the largest group is begun first.
GROUPS = {
    "test_run.py": "finished study",
    "test_graph.py": "finished study",
    "test_report.py": "finished study",
    "test_document_commands.py": "finished study",
    "test_scenes.py": "scenes",
    "test_explorer.py": "explorer",
    "test_explorer_input.py": "explorer",
    "test_explorer_shipped.py": "shipped explorer",
    "test_installed.py": "installed",
}


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Each test by itself to the next free worker, except those of a group."""
    from xdist.scheduler import LoadScopeScheduling

    class ByGroup(LoadScopeScheduling):
        def _split_scope(self, nodeid):
            file = nodeid.split("::")[0].rsplit("/", 1)[-1]
            return GROUPS.get(file, nodeid)

    return ByGroup(config, log)


@pytest.fixture(scope="session")
def trained_model(tmp_path_factory):
    """Folder of a forecast model of 7 beads, ℬ from 100 to 400, trained on simulations in under 10 s."""
    import torch  # the tests of the physics do without

    from sedfiber.reduced.model_files import save_forecast_model
    from sedfiber.reduced.torch_forecast import ForecastModel
    from sedfiber.reduced.training.settings import AutoencoderSettings, NodeSettings
    from sedfiber.reduced.training.train_autoencoder import train_autoencoder
    from sedfiber.reduced.training.train_node import train_node
    from sedfiber.simulation.equilibria.terminal_curve import FILE as CURVE
    from sedfiber.simulation.equilibria.terminal_curve import TerminalCurve, write_terminal_curve
    from sedfiber.study.hard_cases.training_cases import simulated

    torch.set_num_threads(1)
    training = simulated(7, (100.0, 200.0, 400.0), (0, 5, 10, 15, 20))
    sizes = {"samples_per_trajectory": 32}
    encoding = AutoencoderSettings((16, 16), modes_per_parity=4, batch_size=128, iterations=700, **sizes)
    autoencoder = train_autoencoder(training, "decoder", 2, 0, encoding)
    matching = {"matching_iterations": 800, "matching_batch_size": 128}
    rollouts = {"rollout_lengths": (8,), "rollout_iterations": (80,), "rollout_batch_steps": 800}
    settings = NodeSettings((16, 16), **sizes, **matching, **rollouts)
    node = train_node(training, autoencoder, 0, settings)
    folder = tmp_path_factory.mktemp("model")
    save_forecast_model(ForecastModel(autoencoder, node, settings.rtol, settings.atol), folder, {})
    write_terminal_curve(TerminalCurve.between(100.0, 400.0, 7), folder / CURVE)
    return folder
