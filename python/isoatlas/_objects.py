"""Tables of objects and cavities."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Union, overload

import numpy as np

from . import _html, _names
from ._calls import Progress, blocks_of
from ._mesh import Array, Mesh

if TYPE_CHECKING:
    from ._atlas import Atlas


class Isovalue(NamedTuple):
    """An isovalue that shows an object well: calibrated, why ("stable", "outline", ...), in words, and how prominent it is."""

    tau: float
    reason: str
    why: str
    prominence: float


class Object:
    """An object of the table: a connected part of the volume, and the isovalue that shows it best.

    Attributes
    ----------
    number : int
        Its line in the table, from 1, as in the command line (``--object 3``).
    id : int
        Its highest voxel at ``best_tau``, as index into the array in C order: ``np.unravel_index(id, atlas.shape)``.
    appears, merges, best_tau : float
        Calibrated. On its own for isovalues in (merges, appears]; merges is infinite for the one that never merges.
    tau_range : (float, float)
        In this range of isovalues it has the same tunnels and cavities.
    voxels : int
        At ``best_tau``.
    measure : float
        Its volume (2D: area) at ``best_tau``, in the cubed unit of lengths.
    tunnels, cavities : int
        At ``best_tau``. Of a cavity: the tunnels of its wall, and ``islands`` inside it.
    hypervolume : float
        Contrast times size, the rank.
    index : tuple of int
        Of its highest voxel: (z, y, x).
    position : (float, float, float)
        The same, (x, y, z) in physical units.
    reason, why : str or None
        Why this isovalue.
    isovalues : tuple of Isovalue
        All that show it well.
    inside : int or None
        The number of the closest object of the table that contains this one.
    is_cavity, main_branch, outline, background : bool
    note : str
    """

    def __init__(self, atlas: Atlas, number: int, row: dict[str, Any], is_cavity: bool = False) -> None:
        self._atlas = atlas
        self._tau: float = row["tau"]
        self.number = number
        self.is_cavity = is_cavity
        self.id: int = row["id"]
        self.appears: float = row["appears"]
        self.merges: float = row["merges"]
        self.best_tau: float = row["best_tau"]
        self.tau_range: tuple[float, float] = (row["tau_range"][0], row["tau_range"][1])
        self.voxels: int = row["voxels"]
        self.measure: float = row["measure"]
        self.tunnels: int = row["tunnels"]
        self.cavities: int = row.get("cavities", 0)
        self.islands: int = row.get("islands", 0)
        self.hypervolume: float = row["hypervolume"]
        self.index: tuple[int, ...] = tuple(int(i) for i in np.unravel_index(self.id, atlas.shape))
        self.position: tuple[float, float, float] = (row["position"][0], row["position"][1], row["position"][2])
        self.reason: Optional[str] = row["reason"]
        self.why: Optional[str] = row["why"]
        self.isovalues = tuple(Isovalue(*one[:4]) for one in row["isovalues"])
        self.inside: Optional[int] = row["inside"] + 1 if row["inside"] >= 0 else None
        self.main_branch: bool = row.get("main_branch", False)
        self.outline: bool = row.get("outline", False)
        self.background: bool = row.get("background", False)
        self.note: str = row["note"]

    @property
    def name(self) -> Optional[str]:
        """The name that it was given in a store: see :meth:`Atlas.give_name`."""
        return _names.names_of_lines(self._atlas).get(_names.key_of(self))

    @property
    def reference(self) -> str:
        """As the command line calls it: "3", of a cavity "c3"."""
        return f"c{self.number}" if self.is_cavity else str(self.number)

    def __repr__(self) -> str:
        kind = "cavity" if self.is_cavity else "object"
        return f"<isoatlas {kind} {self.number}: best at {self.best_tau:g}, {self.voxels:,} voxels>"

    def _stored(self, tau: Optional[float]) -> float:
        return self._tau if tau is None or tau == self.best_tau else self._atlas._source.stored(tau)

    def surface(self, tau: Optional[float] = None, *, boundary: str = "closed", style: str = "compact", shell: str = "all",
                normals: bool = True, ids: bool = True, simplify: Optional[float] = None, triangles: int = 0, octree: int = 0,
                octree_error: Optional[float] = None, eye: Optional[Sequence[float]] = None, pixels: float = 1.0,
                progress: Progress = None, threads: int = 0) -> Mesh:
        """Its surface, a closed mesh with points (x, y, z); of a cavity its wall.

        Parameters
        ----------
        tau : float, optional
            Isovalue instead of the best one: then that of the object at tau which contains the voxel ``id``.
        boundary, style, shell, normals, ids, simplify, triangles, octree, octree_error, eye, pixels
            As :meth:`Atlas.surface`.

        Raises
        ------
        NotFoundError
            It does not exist at this isovalue.
        """
        objects, contours = ([], [self.id]) if self.is_cavity else ([self.id], [])
        return self._atlas._extract(self._stored(tau), objects=objects, contours=contours, boundary=boundary, style=style, shell=shell,
                                    normals=normals, ids=ids, simplify=simplify, triangles=triangles,
                                    blocks=blocks_of(octree, octree_error, eye, pixels), progress=progress, threads=threads)

    def mask(self, tau: Optional[float] = None, *, progress: Progress = None, threads: int = 0) -> Array:
        """Which voxels it has: an array of bool in the shape of the volume, (z, y, x)."""
        part = (self.is_cavity, self.id, self._stored(tau), 1)
        return self._atlas._nested([part], progress, threads).view(np.uint32).astype(bool)

    def handles(self, *, min_persistence: float = 0.0, progress: Progress = None, threads: int = 0) -> Any:
        """Its tunnels as exact persistence pairs: see :meth:`Atlas.handles`."""
        return self._atlas.handles(exact=True, min_persistence=min_persistence, object=self, progress=progress, threads=threads)

    def measures(self, tau: Optional[float] = None, *, thickness: bool = False) -> dict[str, Any]:
        """Volume, area, shape, values: as ``isoatlas measure``, for this object."""
        return self._atlas._measures(self._stored(tau), [self.id], thickness)[0]

    def picture(self, tau: Optional[float] = None, *, size: int = 256, **options: Any) -> Array:
        """A picture of its surface: (size, size, 4) uint8. Options as :func:`isoatlas.render`."""
        from ._pictures import render
        return render([self.surface(tau)], colours=[self.colour], size=(size, size), **options)

    @property
    def colour(self) -> tuple[int, int, int]:
        """Red, green, blue: as on the page, in the viewer and in label files."""
        from ._pictures import colour_of
        return colour_of(self.number, self.is_cavity)

    def to_dict(self) -> dict[str, Any]:
        """Its attributes, without methods."""
        return {name: getattr(self, name) for name in COLUMNS}


COLUMNS = ("number", "id", "appears", "merges", "best_tau", "voxels", "measure", "tunnels", "cavities", "hypervolume", "index", "position",
           "reason", "inside", "is_cavity", "main_branch", "outline", "background", "note")


class Table(Sequence[Object]):
    """Objects by rank: a sequence. The first one has number 1 and index 0.

    Attributes
    ----------
    total : int
        How many there are in all, noise included.
    noise : float
        Estimated standard deviation of the noise, calibrated.
    """

    def __init__(self, atlas: Atlas, found: dict[str, Any], is_cavity: bool = False) -> None:
        self._atlas = atlas
        self._objects = [Object(atlas, i + 1, row, is_cavity) for i, row in enumerate(found["rows"])]
        self._is_cavity = is_cavity
        self.total: int = found["branches"]
        self.noise: float = found["noise"]

    @overload
    def __getitem__(self, index: int) -> Object: ...

    @overload
    def __getitem__(self, index: slice) -> list[Object]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Object, list[Object]]:
        return self._objects[index]

    def __len__(self) -> int:
        return len(self._objects)

    def to_dict(self) -> dict[str, list[Any]]:
        """A list for each column."""
        return {name: [getattr(one, name) for one in self._objects] for name in COLUMNS}

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each object; needs the package pandas."""
        import pandas
        return pandas.DataFrame(self.to_dict()).set_index("number")

    def __repr__(self) -> str:
        rows = [("#", "id", "appears", "merges", "best tau", "voxels", "tunnels", "cavities", "reason", "note")]
        for one in self._objects:
            merges = "never" if math.isinf(one.merges) else f"{one.merges:g}"
            rows.append((str(one.number), str(one.id), f"{one.appears:g}", merges, f"{one.best_tau:g}", f"{one.voxels:,}",
                         str(one.tunnels or "-"), str(one.cavities or "-"), one.reason or "", one.note))
        widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
        lines = ["  ".join(cell.ljust(width) if i > 7 else cell.rjust(width) for i, (cell, width) in enumerate(zip(row, widths)))
                 for row in rows]
        return "\n".join(line.rstrip() for line in lines)

    def _repr_html_(self) -> str:
        return _html.table(self._objects, self._atlas)
