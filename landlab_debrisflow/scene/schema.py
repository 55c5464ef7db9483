"""JSON schema of scene files, made from the declarations, for editors that complete and check text as it is typed.

The schema knows names, types, words and bounds. Only `Scene` checks the content of files, and whether keys agree with
each other.
"""

import dataclasses
import inspect
import math
from collections.abc import Mapping
from typing import Any

from ..core.docstrings import default
from ..core.values import keys_of
from ..model.inflow.hydrograph import Hydrograph
from ..model.numerics import Numerics
from ..physics.material import Material
from ..physics.registry import LAWS
from .keys import EnsembleKeys, OutputKeys, ReleaseKeys, TerrainKeys
from .zones import KINDS as ZONED

DIALECT = "https://json-schema.org/draft/2020-12/schema"
MEANINGS = {
    "flow": "grains and water together, or as two phases",
    "friction": "shear stress at the base of the flow",
    "erosion": "rate at which the flow takes up soil",
    "column": "excess pore pressure over the thickness of the flow",
    "release": "masses that start to move: one, or a list of them",
    "inflow": "discharge across lines: one, or a list of them",
}
PAIR = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
NO_NUMBER = r"^(?!\s*[-+]?\.?\d[\d.,eE+-]*\s*$)"
FEWEST = {"lines": 2, "polygons": 3, "table": 2}


def scene_schema() -> dict[str, Any]:
    """Return the JSON schema of a scene (draft 2020-12).

    Returns
    -------
    dict
        Of plain values, to be written as JSON.

    Examples
    --------
    >>> schema = scene_schema()
    >>> schema["$defs"]["friction_voellmy"]["properties"]["turbulent_coefficient"]["anyOf"][0]
    {'type': 'number', 'minimum': 1.0}
    """
    definitions = {
        "terrain": _declared(TerrainKeys), "release": _declared(ReleaseKeys), "output": _declared(OutputKeys),
        "ensemble": _declared(EnsembleKeys),
        "material": _declared(Material), "numerics": _declared(Numerics), "inflow": _declared(Hydrograph),
    }  # fmt: skip
    definitions["release"]["oneOf"] = [_is_set(kind) for kind in ("polygons", "raster", "points")]
    for form in definitions["terrain"]["properties"]["zones"]["anyOf"]:
        _restrict_zone(form.get("items", form))
    definitions["terrain"]["oneOf"] = [_is_set(kind) for kind in ("elevation", "example")]
    definitions["inflow"]["allOf"] = [
        _is_set(key) for key in ("line_start", "line_end", "times", "discharge", "velocity")
    ]
    properties: dict[str, Any] = {"terrain": _reference("terrain")}
    properties["release"] = _one_or_several(_reference("release")) | {"description": MEANINGS["release"]}
    properties |= {key: _or_null(_reference(key)) for key in ("output", "ensemble")}
    for kind, laws in LAWS.items():
        definitions |= {f"{kind}_{name}": _law(name, law) for name, law in laws.items()}
        properties[kind] = _choice_of_law(kind, laws)
    properties |= {key: _or_null(_reference(key)) for key in ("material", "numerics")}
    properties["inflow"] = _one_or_several(_reference("inflow")) | {"description": MEANINGS["inflow"]}
    return {
        "$schema": DIALECT, "title": "Scene of landlab_debrisflow", "type": "object",
        "properties": properties, "required": ["terrain"], "additionalProperties": False, "$defs": definitions,
    }  # fmt: skip


def _restrict_zone(zone: dict[str, Any]) -> None:
    """Restrict the parameters of laws in a zone to numbers that may vary in space, in place."""
    for kind in ZONED:
        varying = {}
        for law in LAWS[kind].values():
            for name, field in keys_of(law).items():
                if field.metadata["varies"]:
                    varying[name] = _number(field.metadata)
        zone["properties"][kind] = {
            "description": f"parameters of the {kind} law inside, by name",
            "anyOf": [{"type": "object", "properties": varying, "additionalProperties": False}, {"type": "null"}],
        }


def _reference(name: str) -> dict[str, Any]:
    return {"$ref": f"#/$defs/{name}"}


def _is_set(key: str) -> dict[str, Any]:
    """Return the schema of mappings that have a key with another value than null."""
    return {"required": [key], "properties": {key: {"not": {"type": "null"}}}}


def _or_null(schema: Mapping[str, Any]) -> dict[str, Any]:
    return {"anyOf": [schema, {"type": "null"}]}


def _one_or_several(schema: Mapping[str, Any]) -> dict[str, Any]:
    return {"anyOf": [schema, {"type": "array", "items": schema}, {"type": "null"}]}


def _choice_of_law(kind: str, laws: Mapping[str, type]) -> dict[str, Any]:
    first = next(iter(laws))
    return {
        "description": f"{MEANINGS[kind]}: a name, or a mapping with law and its parameters; default {first}",
        "default": first,
        "if": {"type": "object"},
        "then": {
            "properties": {"law": {"enum": list(laws)}},
            "required": ["law"],
            "allOf": [
                {
                    "if": {"properties": {"law": {"const": name}}, "required": ["law"]},
                    "then": _reference(f"{kind}_{name}"),
                }
                for name in laws
            ],
        },
        "else": {"enum": [*laws, None]},
    }


def _law(name: str, law: type) -> dict[str, Any]:
    schema = _declared(law)
    return schema | {"properties": {"law": {"const": name}, **schema["properties"]}}


def _declared(cls: type) -> dict[str, Any]:
    """Return the schema of a mapping of the parameters of a declared class."""
    summary = inspect.cleandoc(cls.__doc__ or "").split("\n")[0]
    properties = {key: parameter_schema(field) for key, field in keys_of(cls).items()}
    return {"description": summary, "type": "object", "properties": properties, "additionalProperties": False}


def parameter_schema(field: dataclasses.Field) -> dict[str, Any]:
    """Return the schema of a declared parameter, with meaning, unit, default and bounds.

    Parameters
    ----------
    field : dataclasses.Field
        As `core.parameters.parameter` returns it.

    Returns
    -------
    dict
    """
    meta, value = field.metadata, field.default
    unit = "" if meta["unit"] == "-" else f" [{meta['unit']}]"
    words = ", ".join(value) if isinstance(value, tuple) else default(value)
    schema: dict[str, Any] = {"description": f"{meta['meaning']}{unit}; default: {words or 'none'}"}
    forms = _forms(meta)
    if value is None:
        forms.append({"type": "null"})
    else:
        schema["default"] = list(value) if isinstance(value, tuple) else value
    return schema | (forms[0] if len(forms) == 1 else {"anyOf": forms})


def _forms(meta: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return a schema for each of the forms in which a parameter may be written."""
    kind = meta["kind"]
    if meta["items"] is not None:
        item = _declared(meta["items"])
        return [item, {"type": "array", "items": item}]
    if kind is bool:
        return [{"type": "boolean"}]
    if kind is dict:
        return [{"type": "object"}]
    forms: list[dict[str, Any]] = [{"type": "string", "pattern": r"\S"}] if meta["file"] else []
    if meta["coordinates"]:
        return forms + _coordinates(meta["coordinates"], meta["named"])
    if kind is dict:
        return [{"type": "object", "additionalProperties": {"type": "number"}}]
    if meta["choices"]:
        words = {"enum": list(meta["choices"])}
        if meta["length"] is not None:
            return [words, _numbers(meta)]
        return [words, {"type": "array", "items": words}] if kind is tuple else [words]
    if kind is str:
        return forms or [{"type": "string", "pattern": r"\S"}]
    if kind is tuple:
        return [_numbers(meta)] if meta["length"] is not None else [_number(meta), _numbers(meta)]
    forms.insert(0, _number(meta))
    if meta["words"]:
        forms.append({"enum": list(meta["words"])})
    if meta["derivation"]:
        forms.append(_declared(meta["derivation"]) | {"required": list(keys_of(meta["derivation"]))})
    if meta["varies"]:
        forms += [
            {"type": "string", "pattern": NO_NUMBER},
            {"type": "array", "items": {"type": "number"}, "minItems": 1},
        ]
    return forms


def _number(meta: Mapping[str, Any]) -> dict[str, Any]:
    low, high = meta["bounds"]
    schema: dict[str, Any] = {"type": "integer" if meta["kind"] is int else "number"}
    if low > -math.inf:
        schema["exclusiveMinimum" if meta["open_below"] else "minimum"] = low
    if high < math.inf:
        schema["maximum"] = high
    return schema


def _numbers(meta: Mapping[str, Any]) -> dict[str, Any]:
    length = meta["length"]
    fixed = {} if length is None else {"minItems": length, "maxItems": length}
    return {"type": "array", "items": _number(meta)} | fixed


def _coordinates(form: str, named: bool) -> list[dict[str, Any]]:
    feature = PAIR if form == "points" else {"type": "array", "items": PAIR, "minItems": FEWEST[form]}
    forms = [feature] if form == "table" else [feature, {"type": "array", "items": feature, "minItems": 1}]
    if named:
        forms.append({"type": "object", "additionalProperties": feature, "minProperties": 1})
    return forms
