"""A cluster with TLS: the keys of dask's configuration, certificates as the page on clusters makes them, refusals."""

import os
import re
import subprocess
from pathlib import Path

import dask
import distributed
import pytest

from landlab_debrisflow import InputError
from landlab_debrisflow.ensemble import Ensemble

from .scenes import SCENE, VARY, same

PAGE = Path(__file__).parents[2] / "docs" / "cluster.md"
FILES = "ca.pem", "own.pem", "own.key"


@pytest.fixture(scope="module")
def certificates(tmp_path_factory):
    """Return the paths of the authority, the certificate and its key, made by the commands of the page."""
    folder = tmp_path_factory.mktemp("certificates")
    (commands,) = [
        block for block in re.findall(r"^```sh\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
        if block.startswith("openssl")
    ]  # fmt: skip
    try:
        subprocess.run(["sh", "-ec", commands], cwd=folder, check=True, capture_output=True)
    except subprocess.CalledProcessError as error:
        pytest.skip(f"openssl cannot make certificates: {error.stderr[-200:]}")
    assert os.name == "nt" or not (folder / "own.key").stat().st_mode & 0o077
    return [str(folder / name) for name in FILES]


@pytest.fixture(scope="module")
def address(certificates):
    """Yield the address of a scheduler with TLS on loopback, whose worker is a thread of this process."""
    authority, own, key = certificates
    security = distributed.Security(
        require_encryption=True, tls_ca_file=authority, tls_scheduler_cert=own, tls_scheduler_key=key,
        tls_worker_cert=own, tls_worker_key=key, tls_client_cert=own, tls_client_key=key,
    )  # fmt: skip
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tls://", host="127.0.0.1", security=security,
        dashboard_address=None, scheduler_kwargs={"dashboard": False, "dashboard_address": "127.0.0.1:0"},
    ) as cluster:  # fmt: skip
        yield cluster.scheduler_address


@pytest.mark.slow
def test_an_ensemble_runs_over_tls(certificates, address):
    ensemble = Ensemble(SCENE, VARY, 3, "random", batch=1)
    authority, own, key = certificates
    keys = {"ca-file": authority, "client.cert": own, "client.key": key}
    settings = {f"distributed.comm.tls.{name}": path for name, path in keys.items()}
    with dask.config.set(settings | {"distributed.comm.require-encryption": True}):
        results = ensemble.run(address)
    assert address.startswith("tls://127.0.0.1:") and results.done.all()
    assert all(same(*pair) for pair in zip(results.members(), ensemble.run(workers=1).members(), strict=True))


@pytest.mark.slow
def test_who_has_no_certificate_is_told_so(address):
    ensemble = Ensemble(SCENE, VARY, 1, "random")
    with pytest.raises(InputError, match=rf"encryption does not fit the scheduler at {address} .*ca-file"):
        ensemble.run(address)
    plain = address.replace("tls", "tcp")
    with dask.config.set({"distributed.comm.timeouts.connect": "0.5s"}):
        with pytest.raises(InputError, match=f"no scheduler answers at {plain}"):
            ensemble.run(plain)
        with (
            dask.config.set({"distributed.comm.require-encryption": True}),
            pytest.raises(InputError, match=r"encryption required .* give an address tls://"),
        ):
            ensemble.run(plain)
