"""Batches of members: the unit in which an ensemble is computed and written."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ..core.version import __version__
from .basis import Basis
from .member import run_member
from .result import MemberResult


class OtherVersionError(RuntimeError):
    """A worker has another version of the package than the process that asked it."""


class BatchResult(NamedTuple):
    """Results of the members of a batch.

    Attributes
    ----------
    batch : int
        Number of the batch, from 0.
    results : list of MemberResult
        In the order of the members.
    attributes : dict of str to dict
        Unit and meaning of the measures by name; empty if all members failed.
    seconds : list of float
        CPU time of each member [s].
    """

    batch: int
    results: list[MemberResult]
    attributes: dict[str, dict[str, str]]
    seconds: list[float]


def run_batch(basis: Basis, batch: int, members: Sequence[tuple[int, Mapping[str, Any]]]) -> BatchResult:
    """Run the members of a batch one after the other.

    Parameters
    ----------
    basis : Basis
    batch : int
        Number of the batch.
    members : sequence of tuple of int and mapping
        Number and values of each member.

    Returns
    -------
    BatchResult

    Raises
    ------
    OtherVersionError
        If the basis is of another version of the package.
    """
    if basis.version != __version__:
        raise OtherVersionError(f"a worker has landlab_debrisflow {__version__}, the ensemble {basis.version}")
    outcomes = [run_member(basis, member, values) for member, values in members]
    attributes: dict[str, dict[str, str]] = next((one.attributes for one in outcomes if one.attributes), {})
    return BatchResult(batch, [one.result for one in outcomes], attributes, [one.seconds for one in outcomes])
