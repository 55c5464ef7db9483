"""Setup of a run as one value: laws, material, numerics, inflow."""

import dataclasses
import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import xarray as xr

from ..core.derived_number import DerivedNumber
from ..core.errors import ParameterError
from ..core.hints import did_you_mean
from ..core.names import legal_name
from ..core.values import NodeValues
from ..model.inflow.hydrograph import Hydrograph
from ..model.numerics import Numerics
from ..physics.agreement import CONSOLIDATION, check_laws
from ..physics.column_contracts import ColumnLaw, is_dilatant
from ..physics.contracts import ErosionLaw, FlowLaw, FrictionLaw
from ..physics.material import Material
from ..physics.registry import LAWS, build_declared, build_law, law_name
from .digest import digest, state_of, text_of

UNSET: Any = None
"""Default of an attribute that `Setup` builds itself; of any type for mypy."""


class NodeArray(NamedTuple):
    """Parameter of a setup that has a value at every node of the grid, as `Setup.node_arrays` returns it for output.

    Attributes
    ----------
    values : ndarray, shape (nodes,)
        Value of the parameter at each node, as float, in `unit`.
    unit : str
        Unit of the parameter as declared, such as "deg".
    meaning : str
        Meaning of the parameter as declared.
    """

    values: np.ndarray
    unit: str
    meaning: str


@dataclasses.dataclass(frozen=True, kw_only=True)
class Setup:
    """One law of each kind, the material, the numerics and the inflow: a whole run except its grid.

    It is compared, hashed and pickled as a value, and its attributes are the keywords of `DebrisFlow`, so that
    ``DebrisFlow(grid, **vars(setup))`` runs it.

    Parameters
    ----------
    flow, friction, erosion, column : law, str or mapping, optional
        A law, its name in any case, or plain values with its name under ``"law"``; by default the first of its kind.
    material : Material or mapping, optional
        Densities, porosity, consolidation, initial pore pressure.
    numerics : Numerics or mapping, optional
        Number of particles, threads, settling.
    inflow : Hydrograph, mapping or a sequence of them, optional
        Discharge, velocity and pore pressure against time, across lines.

    Raises
    ------
    ParameterError
        If a law or key is unknown (the message lists the legal ones) or a value out of bounds.

    Examples
    --------
    >>> setup = Setup(friction={"law": "voellmy", "cohesion": 100.0}, numerics={"particle_count": 500})
    >>> setup.friction.turbulent_coefficient, setup.to_mapping()["numerics"]["particle_count"]
    (500.0, 500)
    >>> Setup.from_mapping(setup.to_mapping()) == setup, Setup().digest() == setup.digest()
    (True, False)
    """

    flow: FlowLaw = UNSET
    friction: FrictionLaw = UNSET
    erosion: ErosionLaw = UNSET
    column: ColumnLaw = UNSET
    material: Material = UNSET
    numerics: Numerics = UNSET
    inflow: tuple[Hydrograph, ...] = ()

    if TYPE_CHECKING:  # arguments are words and mappings, the attributes are objects

        def __init__(
            self,
            *,
            flow: Any = None,
            friction: Any = None,
            erosion: Any = None,
            column: Any = None,
            material: Material | Mapping[str, Any] | None = None,
            numerics: Numerics | Mapping[str, Any] | None = None,
            inflow: Hydrograph | Mapping[str, Any] | Sequence[Hydrograph | Mapping[str, Any]] | None = None,
        ) -> None: ...

    def __post_init__(self):
        names_c_v = isinstance(self.material, Mapping) and self.material.get(CONSOLIDATION) is not None
        built = {kind: build_law(kind, getattr(self, kind)) for kind in LAWS}
        built["material"] = build_declared(Material, self.material, "material")
        built["numerics"] = build_declared(Numerics, self.numerics, "numerics")
        built["inflow"] = _hydrographs(self.inflow)
        for name, value in built.items():
            object.__setattr__(self, name, value)
        check_laws(self, names_c_v)

    @property
    def two_phases(self) -> bool:
        """Whether grains and water move as two phases: then the flow law has a `drag_coefficient` between them."""
        return hasattr(self.flow, "drag_coefficient")

    @property
    def has_dilatancy(self) -> bool:
        """Whether debris of the columns contracts or dilates as it is sheared."""
        return is_dilatant(self.column)

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any]) -> "Setup":
        """Build a setup from plain values, as they come from YAML.

        Parameters
        ----------
        mapping : mapping
            Values by the names of the attributes; missing ones have their defaults.

        Returns
        -------
        Setup

        Raises
        ------
        ParameterError
            If a key is unknown or a value is refused.
        """
        if not isinstance(mapping, Mapping):
            raise ParameterError(f"Setup: a mapping is needed, got {mapping!r}")
        legal_keys = [field.name for field in dataclasses.fields(cls)]
        for key in mapping:
            if key not in legal_keys:
                hint = did_you_mean(key, legal_keys)
                raise ParameterError(f"Setup: unknown key {key!r}{hint}; allowed: {', '.join(legal_keys)}")
        return cls(**mapping)

    def to_mapping(self) -> dict[str, Any]:
        """Return all values, defaults included, as numbers, words, lists and mappings, without the unset ones.

        Returns
        -------
        dict
            `from_mapping` builds an equal setup from it, also by way of YAML or JSON. A law that is not declared
            appears as its class and its `repr`, a declared law without a name in `LAWS` as its class: from such a
            mapping no setup can be built. With dilatancy the coefficient of consolidation is no value of the material.
        """
        return self._mapping(lambda kind, name, array: array.values.tolist())

    def _mapping(self, array_of) -> dict[str, Any]:
        """Return the mapping; ``array_of(kind, name, values)`` stands for the values of a parameter at nodes."""

        def values_of(kind, obj):
            values = {field.name: getattr(obj, field.name) for field in dataclasses.fields(obj)}
            plain = {name: _plain(value) for name, value in values.items()}
            plain = {name: values_of(kind, value) if is_declared(value) else value for name, value in plain.items()}
            return {
                name: array_of(kind, name, value) if isinstance(value, NodeValues) else value
                for name, value in plain.items() if value is not None
            }  # fmt: skip

        mapping: dict[str, Any] = {}
        for kind in LAWS:
            law = getattr(self, kind)
            values = values_of(kind, law) if is_declared(law) else {"repr": text_of(law)}
            mapping[kind] = {"law": law_name(kind, law)} | values
        mapping |= {kind: values_of(kind, getattr(self, kind)) for kind in ("material", "numerics")}
        if self.has_dilatancy:
            del mapping["material"][CONSOLIDATION]
        return mapping | {"inflow": [values_of("inflow", hydrograph) for hydrograph in self.inflow]}

    def digest(self) -> str:
        """Return 32 hexadecimal digits, equal in every process for equal setups and different otherwise.

        For a law that is not declared, class, state and printed form count.

        Returns
        -------
        str
        """
        laws = {kind: (law_name(kind, law := getattr(self, kind)), state_of(law)) for kind in LAWS}
        return digest([laws, *(state_of(part) for part in (self.material, self.numerics)), list(self.inflow)])

    # ---- in a Dataset ----

    def node_arrays(self) -> dict[str, NodeArray]:
        """Return the parameters given at every node.

        Returns
        -------
        dict of str to NodeArray
            Values, unit and meaning by the name of a variable, such as ``friction__cohesion``.
        """
        return {
            _variable(kind, field.name): NodeArray(value.values, field.metadata["unit"], field.metadata["meaning"])
            for kind in LAWS if is_declared(law := getattr(self, kind))
            for field in dataclasses.fields(law) if isinstance(value := getattr(law, field.name), NodeValues)
        }  # fmt: skip

    def to_attributes(self) -> dict[str, str]:
        """Return the setup as attributes of a Dataset that has `node_arrays` as variables.

        Returns
        -------
        dict of str to str
            ``setup``, as JSON, and ``setup_digest``; `from_dataset` reads them.
        """
        mapping = self._mapping(lambda kind, name, array: {"variable": _variable(kind, name)})
        return {"setup": json.dumps(mapping), "setup_digest": self.digest()}

    @classmethod
    def from_dataset(cls, dataset: xr.Dataset) -> "Setup":
        """Return the setup of a run from its maps, or from snapshots that have all variables.

        Parameters
        ----------
        dataset : xarray.Dataset

        Returns
        -------
        Setup
            Equal to that of the run.

        Raises
        ------
        ParameterError
            If the Dataset has no setup, lacks a variable, or a law of it cannot be built from plain values.
        """
        return cls.from_mapping(written_mapping(dataset))


def written_mapping(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the mapping of the setup in a Dataset, of which `Setup.from_mapping` builds it; see `Setup.from_dataset`.

    Parameters at nodes are arrays, shape (nodes,).
    """
    if "setup" not in dataset.attrs:
        raise ParameterError("Setup: the Dataset has no attribute 'setup'; give the maps or snapshots of a flow")
    try:
        mapping: dict[str, Any] = json.loads(dataset.attrs["setup"])
    except (TypeError, ValueError, RecursionError) as error:
        raise ParameterError(
            f"Setup: the attribute 'setup' of the Dataset is no JSON ({error}), so this package did not write it, "
            "or it was changed; give the maps or snapshots of a flow as they were written"
        ) from error
    if not isinstance(mapping, dict) or not all(isinstance(mapping.get(kind), dict) for kind in LAWS):
        raise ParameterError(
            f"Setup: the attribute 'setup' of the Dataset must have a mapping for each of {', '.join(LAWS)}; give the "
            "maps or snapshots of a flow as they were written"
        )
    for kind in LAWS:
        for key, value in mapping[kind].items():
            if not isinstance(value, Mapping) or list(value) != ["variable"]:
                continue
            if (name := value.get("variable")) not in dataset:
                raise ParameterError(f"{kind}: {key} is in the variable {name!r}, which the Dataset does not have")
            mapping[kind][key] = dataset[name].values.reshape(-1)
    return mapping


def is_declared(obj: Any) -> bool:
    """Return whether the parameters of an object are all declared."""
    return dataclasses.is_dataclass(obj) and all("meaning" in field.metadata for field in dataclasses.fields(obj))


def _plain(value: Any) -> Any:
    """Return a tuple as a list, and a number that followed from other parameters as the mapping of these."""
    if isinstance(value, DerivedNumber):
        return dict(value.parameters)
    return list(value) if isinstance(value, tuple) else value


def _variable(kind: str, name: str) -> str:
    return legal_name(f"{kind}__{name}")


def _hydrographs(inflow) -> tuple[Hydrograph, ...]:
    """Return the hydrographs of an inflow given as None, a Hydrograph, a mapping, or several of them."""
    if inflow is None:
        return ()
    if isinstance(inflow, Hydrograph | Mapping):
        inflow = (inflow,)
    if isinstance(inflow, str) or not hasattr(inflow, "__iter__"):
        raise ParameterError(f"inflow must be a Hydrograph, a mapping, or a list of them, got {inflow!r}")
    return tuple(build_declared(Hydrograph, one, "inflow") for one in inflow)
