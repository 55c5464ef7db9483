"""``help`` of a declared class tells of every parameter what it is, its unit, its bounds and its default."""

import dataclasses
import inspect
import re

import pytest

from landlab_debrisflow import Hydrograph, Material, Numerics
from landlab_debrisflow.core.parameters import declared, parameter
from landlab_debrisflow.physics.registry import LAWS

DECLARED = [law for laws in LAWS.values() for law in laws.values()] + [Material, Numerics, Hydrograph]
ORDER = ["Parameters", "References", "Examples"]


def entries(cls):
    """Return the section Parameters by name: what stands behind the colon, and the words below, in one line."""
    sections = re.split(r"^(\w+)\n-{3,}$", inspect.getdoc(cls), flags=re.MULTILINE)
    named = dict(zip(sections[1::2], sections[2::2], strict=True))
    found = re.findall(r"^(\w+) : (.*)\n((?:    .*\n?)+)", named.get("Parameters", ""), re.MULTILINE)
    return {name: (kind, " ".join(words.split())) for name, kind, words in found}


@pytest.mark.parametrize("cls", DECLARED, ids=lambda cls: cls.__name__)
def test_help_tells_of_every_parameter(cls):
    found = entries(cls)
    assert list(found) == [field.name for field in dataclasses.fields(cls)]
    for field in dataclasses.fields(cls):
        (kind, words), meta = found[field.name], field.metadata
        assert words.startswith(meta["meaning"])
        if meta["choices"]:
            assert all(f'"{word}"' in kind for word in meta["choices"])
        elif meta["kind"] is not bool and not dataclasses.is_dataclass(meta["kind"]):
            assert f"[{meta['unit']}]" in words
            assert all(f"{bound:g}" in words for bound in meta["bounds"] if abs(bound) < float("inf"))
        assert ("name of a field" in kind) == meta["varies"]
        assert kind.endswith("optional") == (field.default is None)
        if isinstance(field.default, float):
            assert float(kind.split("default ")[1]) == pytest.approx(field.default, rel=1e-5)


@pytest.mark.parametrize("cls", DECLARED, ids=lambda cls: cls.__name__)
def test_sections_stand_in_the_order_of_numpydoc(cls):
    sections = re.findall(r"^(\w+)\n-{3,}$", inspect.getdoc(cls), re.MULTILINE)
    assert sections == [name for name in ORDER if name in sections]
    assert ("Parameters" in sections) == bool(dataclasses.fields(cls))
    assert all(len(line) <= 120 for line in inspect.getdoc(cls).splitlines())


def test_the_rest_of_a_docstring_is_kept():
    @declared
    class Sledge:
        """Go downhill.

        On snow.

        Examples
        --------
        >>> 1
        1
        """

        load: float = parameter("kg", "of all on it", 30.0, (0.0, None), open_below=True)
        painted: bool = parameter("-", "painted or not", False, kind=bool)
        wood: str = parameter("-", "kind of wood", "ash", choices=("ash", "beech"))

    assert Sledge.__doc__ == inspect.cleandoc("""Go downhill.

        On snow.

        Parameters
        ----------
        load : float, default 30
            of all on it [kg]; more than 0.
        painted : bool, default False
            painted or not.
        wood : {"ash", "beech"}, default "ash"
            kind of wood.

        Examples
        --------
        >>> 1
        1""")


def test_a_section_written_by_hand_stays():
    @declared
    class Sledge:
        """Go downhill.

        Parameters
        ----------
        load : float
            In hundredweights.
        """

        load: float = parameter("kg", "of all on it", 30.0)

    assert inspect.getdoc(Sledge).endswith("load : float\n    In hundredweights.")
