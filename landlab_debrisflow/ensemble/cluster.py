"""Connection to the workers of an ensemble, on a given cluster or on this machine."""

import logging
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from multiprocessing import resource_tracker
from typing import Any

from ..core.errors import InputError
from ..core.version import __version__

log = logging.getLogger("landlab_debrisflow")

LOOPBACK = "127.0.0.1"
"""Address on which a cluster of this machine listens: no other machine reaches it."""

LIBRARIES = ("numpy", "numba", "scipy")
"""Libraries whose other versions may change results in the last bits."""


def processors() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def connected(client: Any, workers: int | None) -> Iterator[Any]:
    """Yield a client whose workers run batches in a block.

    Parameters
    ----------
    client : distributed.Client, str or None
        A client, which stays open; the address of a scheduler; or None for a cluster on this machine that listens on
        loopback only, without a dashboard, and ends with the block.
    workers : int or None
        Worker processes of a cluster on this machine; None: one for each processor.

    Yields
    ------
    distributed.Client

    Raises
    ------
    InputError
        If no scheduler answers, or a worker has another version of the package.
    """
    distributed = _distributed()
    if client is None:
        with _main_left_out(), _local(distributed, workers or processors()) as found:
            yield found
        return
    if isinstance(client, str):
        with _remote(distributed, client) as found:
            check_workers(found)
            yield found
        return
    if not isinstance(client, distributed.Client) or client.asynchronous:
        raise InputError(
            f"ensemble: client must be a distributed.Client, not an asynchronous one, or the address of a scheduler, "
            f"got {client!r:.80}"
        )
    check_workers(client)
    yield client


@contextmanager
def _local(distributed: Any, workers: int) -> Iterator[Any]:
    options = {"dashboard": False, "dashboard_address": f"{LOOPBACK}:0"}
    with ExitStack() as ends:
        ends.enter_context(_silent("asyncio"))  # where calls fail that an interrupted cluster leaves unanswered
        with _interrupts_later():
            cluster = distributed.LocalCluster(
                n_workers=workers, threads_per_worker=1, host=LOOPBACK, silence_logs=logging.CRITICAL,
                dashboard_address=None, scheduler_kwargs=options,
            )  # fmt: skip
            ends.enter_context(cluster)
        yield ends.enter_context(distributed.Client(cluster, set_as_default=False))


@contextmanager
def _silent(name: str) -> Iterator[None]:
    """Let a logger say nothing below critical messages in a block."""
    logger = logging.getLogger(name)
    level = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(level)


@contextmanager
def _interrupts_later() -> Iterator[None]:
    """Keep Ctrl-C until the end of a block; threads and processes that begin in the block never get it.

    A terminal sends Ctrl-C to workers, too; the process that started them ends them in order.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    resource_tracker.ensure_running()  # its start, within that of the first worker, would let Ctrl-C through again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _remote(distributed: Any, address: str) -> Iterator[Any]:
    try:
        client = distributed.Client(address, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"ensemble: no scheduler answers at {address} ({str(error).splitlines()[0]}); start one with: dask "
            "scheduler, or leave the scheduler out to use this machine"
        ) from error
    except (TypeError, RuntimeError) as error:  # no certificate for tls, or no tls where encryption is required
        raise InputError(
            f"ensemble: encryption does not fit the scheduler at {address} ({str(error).splitlines()[0]}); give an "
            "address tls://... and set distributed.comm.tls in the configuration of dask (ca-file, client.cert, "
            "client.key)"
        ) from error
    with client:
        yield client


def check_workers(client: Any) -> None:
    """Refuse workers of another version of the package, and warn of other versions of libraries.

    Parameters
    ----------
    client : distributed.Client

    Raises
    ------
    InputError
        If a worker has another version, or none.
    """
    own, found = client.get_versions(packages=["landlab_debrisflow", *LIBRARIES]), {}
    for address, worker in own["workers"].items():
        packages = worker["packages"] if worker else {}
        found[address] = packages.get("landlab_debrisflow")
        other = [name for name in LIBRARIES if packages.get(name) != own["client"]["packages"].get(name)]
        if other:
            log.warning(
                "worker %s has other versions of %s: results may differ in the last bits from those of this process",
                address, " and ".join(other),
            )  # fmt: skip
    wrong = {address: version for address, version in found.items() if version != __version__}
    if wrong:
        (address, version), *_ = wrong.items()
        raise InputError(
            f"ensemble: {len(wrong)} of {len(found)} workers have another version of landlab_debrisflow, such as "
            f"{address} with {version or 'none'}; this process has {__version__}: install it there"
        )


@contextmanager
def _main_left_out() -> Iterator[None]:
    """Hide the file of the script in a block: new processes then do not run the script that starts them."""
    main = sys.modules["__main__"]
    hidden: dict[str, Any] = {name: vars(main)[name] for name in ("__file__", "__spec__") if name in vars(main)}
    vars(main).update(dict.fromkeys(hidden))
    try:
        yield
    finally:
        vars(main).update(hidden)


def _distributed() -> Any:
    try:
        import distributed
    except ImportError as error:
        raise InputError(
            'several workers need dask and distributed; pip install "landlab_debrisflow[ensemble]", or give workers=1'
        ) from error
    return distributed
