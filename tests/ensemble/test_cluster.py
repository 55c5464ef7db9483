"""Workers: in processes of their own, killed in the middle, of another version, out of reach."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from types import SimpleNamespace

import dask
import distributed
import psutil
import pytest

from landlab_debrisflow import InputError, __version__
from landlab_debrisflow.ensemble import Ensemble, EnsembleResults, cluster
from landlab_debrisflow.ensemble.batch import OtherVersionError, run_batch

from .deadly import Deadly
from .scenes import SCENE, VARY, same

QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


@pytest.fixture
def ensemble():
    """Members that take long enough for a worker to be killed while it runs one."""
    return Ensemble(SCENE | {"output": {"max_duration": 20.0}}, VARY, 12, "random", batch=1)


@contextmanager
def started(*words):
    """Start a command of dask in a process of its own, and end it after the block."""
    process = subprocess.Popen([sys.executable, "-m", "dask", *words], **QUIET)
    try:
        yield process
    finally:
        process.kill()
        process.wait()


@contextmanager
def cluster_of_processes(folder, workers):
    """Yield the address of a scheduler on loopback, and the processes of its workers."""
    file = folder / "scheduler.json"
    with started("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(file)):
        while not file.exists() or not file.read_text():
            time.sleep(0.05)
        address = json.loads(file.read_text())["address"]
        words = "worker", address, "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny", "--no-dashboard"
        with started(*words) as first, started(*words) as second:
            yield address, [first, second][:workers]


@pytest.mark.slow
def test_a_worker_killed_in_the_middle_changes_no_bit(ensemble, tmp_path):
    with cluster_of_processes(tmp_path, 2) as (address, workers):
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(2)
        told = []

        def kill(text):
            told.append(text)
            if len(told) == 3:
                workers[0].send_signal(signal.SIGKILL)

        results = ensemble.run(address, tmp_path / "members.zarr", notify=kill)
        assert workers[0].wait(10.0) == -signal.SIGKILL and workers[1].poll() is None
    here = ensemble.run(workers=1)
    assert results.done.all() and results.failures == [] and len(told) == 12
    assert all(same(*pair) for pair in zip(results.members(), here.members(), strict=True))
    assert results.measures.identical(here.measures)


SCRIPT = """\
import sys
from landlab_debrisflow.ensemble import Ensemble
from tests.ensemble.scenes import SCENE, VARY

ensemble = Ensemble(SCENE | {"output": {"max_duration": 20.0}}, VARY, 12, "random", batch=1)
ensemble.run(store=sys.argv[1], workers=2, notify=lambda text: print(text, flush=True))
"""


@pytest.mark.slow
def test_a_script_killed_in_the_middle_goes_on(ensemble, tmp_path):
    """The script has no guard for its main part; its workers end with it."""
    (tmp_path / "script.py").write_text(SCRIPT)
    store = tmp_path / "members.zarr"
    words = [sys.executable, str(tmp_path / "script.py"), str(store)]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, text=True, env=os.environ | {"PYTHONPATH": os.getcwd()}
    ) as run:
        assert run.stdout.readline() == "ensemble: 1 of 12 members done\n"
        children = psutil.Process(run.pid).children(recursive=True)
        run.kill()
    gone, alive = psutil.wait_procs(children, 10.0)
    assert len(gone) >= 2 and alive == []
    done = int(EnsembleResults.open(store).done.sum())
    told = []
    results = ensemble.run(store=store, workers=1, notify=told.append)
    assert 1 <= done < 12 and len(told) == 12 - done
    assert all(same(*pair) for pair in zip(results.members(), ensemble.run(workers=1).members(), strict=True))


@pytest.mark.slow
def test_a_cluster_of_this_machine_listens_on_loopback_only():
    with cluster.connected(None, 1) as client:
        client.wait_for_workers(1)
        own = psutil.Process()
        listening = {
            connection.laddr.ip
            for process in (own, *own.children(recursive=True))
            for connection in process.net_connections(kind="inet")
            if connection.status == psutil.CONN_LISTEN
        }
        assert listening == {"127.0.0.1"}
        assert [(one["nthreads"], one["memory_limit"] > 0) for one in client.scheduler_info()["workers"].values()] == [
            (1, True)
        ]


@pytest.mark.slow
def test_a_member_that_ends_its_worker_is_found_and_others_count():
    scene, vary = SCENE | {"erosion": Deadly()}, {"erosion.deadly": [0.0, 1.0, 0.0]}
    ensemble = Ensemble(scene, vary, sampling="factorial", batch=2)
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
        results = ensemble.run(workers=2)
    (failure,) = results.failures
    assert failure.member == 1 and failure.error.startswith("KilledWorker: 1 workers ended while they ran this member")
    assert [one.error == "" for one in results.members()] == [True, False, True]


def test_a_scheduler_out_of_reach_is_named(tmp_path):
    ensemble = Ensemble(SCENE, VARY, 1, "random")
    with (
        dask.config.set({"distributed.comm.timeouts.connect": "0.1s"}),
        pytest.raises(InputError, match=r"no scheduler answers at tcp://127.0.0.1:9 .*; start one with: dask"),
    ):
        ensemble.run("tcp://127.0.0.1:9", tmp_path / "members.zarr")
    assert ensemble.run(store=tmp_path / "members.zarr", workers=1).done.all()


@pytest.mark.parametrize("client", [3, "nonsense://host"])
def test_what_is_no_client_is_refused(ensemble, client):
    with pytest.raises(InputError, match=r"client must be|no scheduler answers at nonsense"):
        ensemble.run(client)


def versions(*workers):
    """Return a client whose workers have versions of the package and of numpy."""
    known = {"landlab_debrisflow": __version__, "numpy": "2.0", "numba": "0.61", "scipy": "1.12"}
    found = {
        f"tcp://{k}": {"packages": known | {"landlab_debrisflow": own, "numpy": numpy}}
        for k, (own, numpy) in enumerate(workers)
    }
    return SimpleNamespace(get_versions=lambda packages: {"client": {"packages": known}, "workers": found})


def test_workers_of_another_version_are_refused(caplog):
    cluster.check_workers(versions((__version__, "2.0")))
    assert caplog.messages == []
    with pytest.raises(
        InputError, match=r"1 of 2 workers have another version .* tcp://1 with 0.0.9; this process has"
    ):
        cluster.check_workers(versions((__version__, "2.0"), ("0.0.9", "2.0")))
    with pytest.raises(InputError, match=r"tcp://0 with none"):
        cluster.check_workers(versions((None, "2.0")))
    cluster.check_workers(versions((__version__, "2.1")))
    assert "worker tcp://0 has other versions of numpy" in caplog.messages[0]


def test_a_worker_that_comes_later_with_another_version_says_so(ensemble):
    basis = ensemble.basis()._replace(version="0.0.9")
    with pytest.raises(OtherVersionError, match=f"a worker has landlab_debrisflow {__version__}, the ensemble 0.0.9"):
        run_batch(basis, 0, [])
