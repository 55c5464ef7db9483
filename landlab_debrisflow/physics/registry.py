"""All laws by name, and the one place that builds them from names."""

from collections.abc import Mapping
from typing import Any, TypeVar

from ..core.errors import ParameterError
from ..core.hints import did_you_mean, python_value, same_word
from ..core.values import from_mapping
from .column import ALE, Classical, ConstantRatio, NoExcessPressure
from .erosion import ExcessTraction, Growth, LiquefiedBed, NoErosion, ShearExcess
from .flow import OnePhase, TwoPhase
from .friction import Bingham, Coulomb, HerschelBulkley, MuI, Voellmy

LAWS = {
    "flow": {"one_phase": OnePhase, "two_phase": TwoPhase},
    "friction": {
        "coulomb": Coulomb,
        "voellmy": Voellmy,
        "bingham": Bingham,
        "herschel_bulkley": HerschelBulkley,
        "mu_i": MuI,
    },
    "erosion": {
        "growth": Growth,
        "shear_excess": ShearExcess,
        "liquefied_bed": LiquefiedBed,
        "excess_traction": ExcessTraction,
        "none": NoErosion,
    },
    "column": {"ale": ALE, "classical": Classical, "constant_ratio": ConstantRatio, "none": NoExcessPressure},
}
"""Every law by kind and name; the first of a kind is the default."""

T = TypeVar("T")

METHOD = {
    "flow": "interact",
    "friction": "basal_resistance",
    "erosion": "entrainment_rate",
    "column": "advance",
}
"""The method that makes an object a law of its kind."""


def law_name(kind: str, law: Any) -> str:
    """Return the name by which `law` of a `kind`, such as "friction", is chosen; without a name, module and class."""
    cls = type(law)
    return next((name for name, known in LAWS[kind].items() if known is cls), f"{cls.__module__}.{cls.__qualname__}")


def build_law(kind: str, value: Any) -> Any:
    """Return the law of some kind that `value` stands for; the case of its name does not matter.

    Examples
    --------
    >>> build_law("friction", {"law": "voellmy", "turbulent_coefficient": 300})
    Voellmy(basal_friction_angle=30.96375653207352, cohesion=0.0, turbulent_coefficient=300.0)
    >>> build_law("friction", "MU_I").inertial_number
    0.279
    >>> build_law("flow", "plough")
    Traceback (most recent call last):
        ...
    landlab_debrisflow.core.errors.ParameterError: flow: unknown law 'plough'; allowed: one_phase, two_phase
    """
    laws, value = LAWS[kind], python_value(value)
    if value is None:
        value = next(iter(laws))
    if isinstance(value, str):
        value = {"law": value}
    if isinstance(value, Mapping):
        values = dict(value)
        if "law" not in values:
            hint = "".join(did_you_mean(key, ("law",)) for key in values)
            names = ", ".join(laws)
            raise ParameterError(f"{kind}: a mapping needs the key 'law', one of {names}; got {value!r}{hint}")
        name = values.pop("law")
        if (known := same_word(python_value(name), laws)) is None:
            outside = isinstance(name, str) and "." in name
            remedy = f"; give an object of that class, or put the class into LAWS[{kind!r}]" if outside else ""
            hint, allowed = did_you_mean(name, laws), ", ".join(laws)
            raise ParameterError(f"{kind}: unknown law {name!r}{hint}; allowed: {allowed}{remedy}")
        return from_mapping(laws[known], values, laws)
    if isinstance(value, type) and callable(getattr(value, METHOD[kind], None)):
        raise ParameterError(f"{kind}: {value.__name__} is no {kind} law but the class of one; give {value.__name__}()")
    if isinstance(value, type) or not callable(getattr(value, METHOD[kind], None)):
        raise ParameterError(
            f"{kind}: {value!r} is no {kind} law (it has no method {METHOD[kind]!r}); "
            f"give an object, a mapping with 'law', or one of {', '.join(laws)}"
        )
    return value


def build_declared(cls: type[T], value: T | Mapping[str, Any] | None, keyword: str) -> T:
    """Return an instance of a declared class from an instance, a mapping or None.

    Raises
    ------
    ParameterError
        If `value` is something else.
    """
    if isinstance(value, cls):
        return value
    if value is None or isinstance(value, Mapping):
        return from_mapping(cls, value or {})
    hint = f"; give {cls.__name__}(), not the class" if value is cls else ""
    raise ParameterError(f"{keyword} must be a {cls.__name__} or a mapping, got {value!r}{hint}")
