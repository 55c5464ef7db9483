"""Results of a run in their directory."""

import dataclasses
import html
from pathlib import Path

import xarray as xr

from ..core.errors import InputError
from ..core.words import grouped
from ..record.measures import ELEVATION, RELEASE
from ..record.written_maps import ELEVATION_BEFORE, RELEASED_DEPTH
from .directory import checkpoints_in
from .files import MAPS, RECORD, REPORT
from .record import FINISHED, RunRecord


@dataclasses.dataclass(frozen=True)
class Results:
    """Results of a scene.

    Parameters
    ----------
    directory : Path
        Directory that holds them.

    Raises
    ------
    InputError
        If there is no record of a run.

    Attributes
    ----------
    record : RunRecord
        Scene, digests, versions and progress of the run.
    """

    directory: Path
    record: RunRecord = dataclasses.field(init=False, repr=False)

    def __post_init__(self) -> None:
        path = Path(self.directory)
        if not (path / RECORD).is_file():
            raise InputError(f"{path} holds no results of a run: {RECORD} is missing; give the directory of a scene")
        object.__setattr__(self, "directory", path)
        object.__setattr__(self, "record", RunRecord.read(path / RECORD))

    @property
    def finished(self) -> bool:
        """Whether the run came to its end and all results are there."""
        return self.record.state == FINISHED

    @property
    def at_rest(self) -> bool:
        """Whether the whole flow came to rest within the longest duration."""
        return self.record.at_rest

    @property
    def elapsed_time(self) -> float:
        """Elapsed time at the end [s]."""
        return self.record.elapsed_time

    @property
    def budget(self) -> dict[str, float]:
        """Volumes at the end, as of `DebrisFlow.budget` [m3]."""
        return self.record.budget

    @property
    def checkpoints(self) -> list[Path]:
        """Checkpoints from which a run can go on, the latest first."""
        return checkpoints_in(self.directory)

    @property
    def files(self) -> list[Path]:
        """Files of the results."""
        return sorted(path for name in self.record.results for path in self.directory.glob(name))

    @property
    def maps(self) -> xr.Dataset:
        """Maps at the end, read from their file.

        Raises
        ------
        InputError
            If the run was not finished.
        """
        if not self.finished and not (self.directory / MAPS).is_file():
            raise InputError(f"{self.directory} holds no maps: the run is {self.record.state}; resume it first")
        return self.dataset("maps")

    @property
    def before(self) -> xr.Dataset | None:
        """Ground before the event and depth of all releases, as `measures` takes them; None if not written."""
        return before_in(self.maps)

    def dataset(self, name: str) -> xr.Dataset:
        """Return one of the files of the results, whole.

        Parameters
        ----------
        name : str
            Name of a NetCDF file without its ending, such as ``gauges``.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        InputError
            If it is not there or cannot be read.
        """
        path = self.directory / f"{name}.nc"
        if not path.is_file():
            raise InputError(
                f"{self.directory} holds no {path.name}: the run did not write it, or it was removed; run the scene "
                "anew with --overwrite"
            )
        try:
            with xr.open_dataset(path, engine="netcdf4", decode_coords="all", decode_timedelta=False) as data:
                return data.load()
        except (OSError, RuntimeError, ValueError) as error:
            raise InputError(
                f"cannot read {path}: {error}; the file is damaged, run the scene anew with --overwrite"
            ) from error

    @property
    def report(self) -> str:
        """Statement on a run by a plan as text: particles, column, steps, stated errors; empty before its end."""
        path = self.directory / REPORT
        return path.read_text(encoding="utf-8").rstrip() if path.is_file() else ""

    def __repr__(self) -> str:
        return "\n  ".join([f"Results in {self.directory}", *(f"{name}: {words}" for name, words in self._rows())])

    def _repr_html_(self) -> str:
        cells = "".join(
            f'<tr><th style="text-align:left">{html.escape(name)}</th>'
            f'<td style="text-align:left">{html.escape(words)}</td></tr>'
            for name, words in self._rows()
        )
        return f"<table><caption>Results in {html.escape(str(self.directory))}</caption>{cells}</table>"

    def _rows(self) -> list[tuple[str, str]]:
        record = self.record
        state = record.state if record.state != FINISHED else "at rest" if record.at_rest else "still moving"
        rows = [("state", f"{state} at {record.elapsed_time:.6g} s")]
        if record.budget:
            rows.append(("budget [m3]", ", ".join(f"{name} {grouped(v)}" for name, v in record.budget.items())))
        return [*rows, ("files", ", ".join(path.name for path in self.files))]


def before_in(maps: xr.Dataset) -> xr.Dataset | None:
    """Return ground before the event and depth of all releases in maps of a file, as `measures` takes them.

    Parameters
    ----------
    maps : xarray.Dataset
        As `Results.maps` returns them.

    Returns
    -------
    xarray.Dataset or None
        None if the version that wrote the file did not keep them.
    """
    if ELEVATION_BEFORE not in maps:
        return None
    return maps[[ELEVATION_BEFORE, RELEASED_DEPTH]].rename({ELEVATION_BEFORE: ELEVATION, RELEASED_DEPTH: RELEASE})
