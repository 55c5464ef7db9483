"""Commented scene files, made of the declarations: keys with unit, default, bounds and meaning."""

import json
import re
import textwrap
from collections.abc import Iterable, Mapping
from typing import Any

from ..core.docstrings import allowed
from ..core.values import keys_of
from ..model.inflow.hydrograph import Hydrograph
from ..model.numerics import Numerics
from ..physics.material import Material
from ..physics.registry import LAWS
from .keys import EnsembleKeys, OutputKeys, ReleaseKeys, TerrainKeys

COMMENT_AT, WIDTH = 44, 118
"""Column at which comments begin, and length of a line at most."""
SCHEMA_FILE = "scene.schema.json"
PLAIN = re.compile(r"([A-Za-z_/]|\.\.?/)[\w./-]*( [\w./-]+)*\Z")
"""Text that needs no quotes."""
HEAD = f"""\
# yaml-language-server: $schema={SCHEMA_FILE}
#
# A scene of landlab_debrisflow. Check it, run it, go on after an interruption:
#   landlab-debrisflow check {{name}}
#   landlab-debrisflow run {{name}}
#   landlab-debrisflow resume {{name}}
# Editors complete and check it after: landlab-debrisflow schema > {SCHEMA_FILE}
#
# Lines with # in front show other keys with their defaults; null: not set. Units are SI, angles are in degrees.
# Names of files are relative to this file. Several releases or inflows are a list: each begins with a dash.
"""
SHORT = """\
# These are the usual keys; all of them, with their meaning: landlab-debrisflow new --full, docs/scenes.md, docs/laws.md
"""
USUAL: dict[type, tuple[str, ...]] = {
    TerrainKeys: ("soil_depth", "spacing", "zones", "edits"),
    ReleaseKeys: ("time", "from"),
    Material: ("coefficient_of_consolidation", "bed_pressure_ratio", "initial_pressure_ratio"),
    Numerics: ("particle_count",),
    OutputKeys: ("max_duration", "interval", "maps", "gauges", "sections", "exposure"),
}
"""Keys that a short scene shows although they are not set; for the kinds in `USUAL_LAWS`, all keys of the chosen
law."""
USUAL_LAWS = ("friction", "erosion")
INFLOW = {
    "line_start": [0.0, 0.0], "line_end": [0.0, 20.0], "times": [0.0, 60.0, 300.0], "discharge": [0.0, 20.0, 0.0],
    "velocity": 3.0,
}  # fmt: skip
"""Values of keys that an inflow needs, to be replaced."""
VARIED = {"friction.basal_friction_angle": {"normal": {"mean": 28.0, "sd": 2.0}}}
"""Values that vary in an ensemble, to be replaced."""


def scene_text(
    name: str, terrain: Mapping[str, Any], release: Mapping[str, Any], remarks: Iterable[str] = (),
    notes: Mapping[str, str] | None = None, settings: Mapping[str, Mapping[str, Any]] | None = None,
    full: bool = False,
) -> str:  # fmt: skip
    """Return the text of a scene file with some keys set and other keys as comments.

    Parameters
    ----------
    name : str
        Name of the file, for the commands in its head.
    terrain, release : mapping
        Values of keys that are set.
    remarks : iterable of str
        Lines of comment below the head.
    notes : mapping of str to str, optional
        Remark on the value of a key of terrain or release, instead of its meaning.
    settings : mapping of str to mapping, optional
        Values of keys that are set in other parts, such as ``{"friction": {"law": "voellmy"}}``.
    full : bool
        Whether every key of every law is there; by default the usual ones.

    Returns
    -------
    str
    """
    settings, notes = settings or {}, notes or {}
    lines = (HEAD + ("" if full else SHORT)).format(name=name).splitlines()
    lines += [f"# {line}" for remark in remarks for line in textwrap.wrap(remark, WIDTH - 2) or [""]]
    lines += ["", "terrain:", *_keys(TerrainKeys, terrain, notes, full)]
    lines += ["", "release:", *_keys(ReleaseKeys, release, notes, full)]
    for kind, laws in LAWS.items():
        if full or kind in USUAL_LAWS or kind in settings:
            lines += ["", *_laws(kind, laws, settings.get(kind, {}), full)]
    for key, cls in (("material", Material), ("numerics", Numerics), ("output", OutputKeys)):
        lines += _mapping(key, _keys(cls, settings.get(key, {}), {}, full))
    if full:
        lines += ["", "# Many runs of the scene, in which values vary (landlab-debrisflow ensemble):", "# ensemble:"]
        lines += _commented(_keys(EnsembleKeys, {"vary": VARIED}, {}))
        lines += ["", "# Flow across a line, instead of a release or besides:", "# inflow:"]
        lines += _commented(_keys(Hydrograph, INFLOW, {}))
    return "\n".join(line.rstrip() for line in lines) + "\n"


def yaml_text(value: Any) -> str:
    """Return a plain value as it is written in YAML on one line.

    Examples
    --------
    >>> yaml_text(None), yaml_text("dem 5m.tif"), yaml_text("no: way"), yaml_text([1.5, "null"])
    ('null', 'dem 5m.tif', '"no: way"', '[1.5, "null"]')
    """
    if isinstance(value, str):
        word = (
            PLAIN.match(value) and value.lower() not in ("null", "true", "false") and not re.match(r"\.(?!\.?/)", value)
        )
        return value if word else json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(yaml_text, value))}]"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{yaml_text(key)}: {yaml_text(one)}' for key, one in value.items())}}}"
    return json.dumps(value)


def _keys(cls: type, given: Mapping[str, Any], notes: Mapping[str, str], full: bool = True) -> list[str]:
    """Return a line, or some, for keys of a declared class: first the given keys, then other keys as comments."""
    lines = []
    fields = keys_of(cls)
    shown = fields if full else USUAL.get(cls, fields)
    for key in [*given, *(key for key in fields if key in shown and key not in given)]:
        field, mark = fields[key], "  " if key in given else "  # "
        value = given.get(key, field.default)
        lines += _line(f"{mark}{key}: {yaml_text(value)}", notes.get(key, _meaning(field.metadata)))
    return lines


def _line(text: str, comment: str) -> list[str]:
    """Return a line of text with a comment behind, on further lines if it is long."""
    lines = [f"# {line}" for line in textwrap.wrap(comment, WIDTH - COMMENT_AT - 4, subsequent_indent="  ")]
    if len(text) > COMMENT_AT - 2:
        return [text, *(f"{'':{COMMENT_AT}}{line}" for line in lines)]
    return [f"{text:<{COMMENT_AT}}{lines[0]}", *(f"{'':{COMMENT_AT}}{line}" for line in lines[1:])]


def _meaning(meta: Mapping[str, Any]) -> str:
    unit = "" if meta["unit"] == "-" else f"[{meta['unit']}] "
    bounds = "" if (meta["kind"] is str and not meta["choices"]) or meta["items"] else allowed(meta)
    bounds = bounds.removeprefix("list, ").removesuffix("any")
    return "; ".join(filter(None, (unit + meta["meaning"], bounds, "may vary in space" if meta["varies"] else "")))


def _mapping(key: str, lines: list[str]) -> list[str]:
    """Return the lines of a key, itself a comment if all below it are."""
    empty = all(line.lstrip().startswith("#") for line in lines)
    return ["", f"{'# ' if empty else ''}{key}:", *lines]


def _laws(kind: str, laws: Mapping[str, type], given: Mapping[str, Any], full: bool) -> list[str]:
    """Return the lines of a kind of law: the chosen law, then, if wanted, every other law as a comment."""
    chosen = given.get("law", next(iter(laws)))
    values = {key: value for key, value in given.items() if key != "law"}
    lines = [f"{kind}:", *_line(f"  law: {chosen}", ", ".join(laws)), *_keys(laws[chosen], values, {})]
    for name, law in laws.items():
        if full and name != chosen and keys_of(law):
            lines += [f"# or {kind}:", f"#   law: {name}"]
            lines += _commented(_keys(law, {}, {}))
    return lines


def _commented(lines: list[str]) -> list[str]:
    """Return lines as comments, every line with the mark in front."""
    return [f"# {line.replace('  # ', '  ', 1) if line.startswith('  # ') else line}" for line in lines]
