"""Names of objects: a file beside the store."""
from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Optional

from . import _core
from .errors import InputError, NotFoundError, UnsupportedError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas
    from ._objects import Object


class Named(NamedTuple):
    """A name, and the line of the table that it is the name of, if the table has it at the isovalue that it was named at."""

    name: str
    voxel: int
    isovalue: float
    is_cavity: bool
    line: Optional[Object]

    @property
    def reference(self) -> str:
        return f"v{self.voxel}" if self.line is None else self.line.reference


def names_of(atlas: Atlas) -> list[Named]:
    """All names; of an atlas in memory there are none."""
    if not atlas.is_store:
        return []
    given = _core.names(atlas._source)
    lines = {key_of(one): one for is_cavity in {name[3] for name in given} for one in atlas._numbered(is_cavity)}
    return [Named(name, voxel, isovalue, is_cavity, lines.get((voxel, isovalue, is_cavity))) for name, voxel, isovalue, is_cavity in given]


def names_of_lines(atlas: Atlas) -> dict[tuple[int, float, bool], str]:
    """By id, best isovalue and side of a line. Reads the file: once for a table."""
    return {(voxel, isovalue, is_cavity): name for name, voxel, isovalue, is_cavity in _core.names(atlas._source)} if atlas.is_store else {}


def key_of(one: Object) -> tuple[int, float, bool]:
    return one.id, one.best_tau, one.is_cavity


def named(atlas: Atlas, name: str) -> Object:
    """The object with this name."""
    for one in names_of(atlas):
        if one.name != name:
            continue
        if one.line is not None:
            return one.line
        raise raised(NotFoundError, f"the table has no object {name} at the isovalue {one.isovalue:g}", expected="an object of the table",
                     next=f"atlas.surface({one.isovalue!r}, objects=[{one.voxel}]) is its surface")
    raise raised(InputError, f"an object cannot be {name!r}", expected="a number, 'c' and that of a cavity, 'v' and an id, or a name",
                 next="atlas.objects and atlas.names list them")


def give_name(atlas: Atlas, one: Object, name: Optional[str]) -> None:
    if not atlas.is_store:
        raise raised(UnsupportedError, "an atlas in memory keeps no names", next="isoatlas.build() makes a store, isoatlas.open() opens it")
    if name == "":
        raise raised(InputError, "a name cannot be empty", next="None takes a name away")
    _core.give_name(atlas._source, name or "", one.id, one.best_tau, one.is_cavity)
