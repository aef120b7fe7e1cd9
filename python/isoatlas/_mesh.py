"""Meshes: closed surfaces as arrays."""
from __future__ import annotations

import os
from typing import Any, NamedTuple, Sequence, Union

import numpy as np

from . import _core
from .errors import VerificationError, raised

Array = np.ndarray[Any, Any]
Path = Union[str, "os.PathLike[str]"]


class Check(NamedTuple):
    """One guarantee: its name, whether it holds, and numbers; of a failure the first violation."""

    name: str
    holds: bool
    detail: str


def checked(found: Sequence[tuple[str, bool, str]], strict: bool) -> tuple[Check, ...]:
    checks = tuple(Check(*one) for one in found)
    failed = [check for check in checks if not check.holds]
    if strict and failed:
        error = raised(VerificationError, f"{len(failed)} of {len(checks)} guarantees fail: {failed[0].name}", where=failed[0].detail,
                       next="strict=False returns them all")
        error.checks = checks  # type: ignore[attr-defined]
        raise error
    return checks


class Mesh:
    """A surface: points are (x, y, z) in physical units, arrays are views of memory that the mesh owns.

    Attributes
    ----------
    points : (n, 3) float64
        In the space of the volume: ``origin + direction @ (spacing * index)``.
    triangles : (m, 3) int64
        Counter-clockwise seen from outside, where values are lower. Empty for 2D volumes.
    segments : (m, 2) int64
        Of 2D volumes: closed curves, the object on the left.
    normals : (n, 3) float32
        Unit length, towards lower values; empty where they were not asked for.
    object_ids, contour_ids : (n,) int64
        Of each point: the id of its object, and of its contour.
    tau : float
        The isovalue, calibrated.
    closed : bool
        False: it is open at the border of the volume.
    space, unit, interpolant, polarity : str
    """

    __slots__ = ("_surface", "__weakref__")

    def __init__(self, surface: _core.Surface) -> None:
        self._surface = surface

    @classmethod
    def from_arrays(cls, points: Any, triangles: Any, *, normals: Any = None, tau: float = 0.0, space: str = "unknown",
                    unit: str = "") -> Mesh:
        """A mesh of copies of arrays: points (n, 3), triangles (m, 3), normals (n, 3)."""
        about = {"tau": tau, "reported_tau": tau, "space": space, "unit": unit, "closed": True, "interpolant": "trilinear",
                 "tunnel_height": 0.0, "reported_tunnel_height": 0.0, "polarity": "high"}
        return cls(_core.Surface({"points": points, "triangles": triangles, "normals": normals}, about))

    @property
    def points(self) -> Array:
        return self._surface.points

    @property
    def triangles(self) -> Array:
        return self._surface.triangles

    @property
    def segments(self) -> Array:
        return self._surface.segments

    @property
    def normals(self) -> Array:
        return self._surface.normals

    @property
    def object_ids(self) -> Array:
        return self._surface.object

    @property
    def contour_ids(self) -> Array:
        return self._surface.contour

    @property
    def tau(self) -> float:
        return float(self._surface.about["reported_tau"])

    @property
    def closed(self) -> bool:
        return bool(self._surface.about["closed"])

    @property
    def space(self) -> str:
        return str(self._surface.about["space"])

    @property
    def unit(self) -> str:
        return str(self._surface.about["unit"])

    @property
    def interpolant(self) -> str:
        return str(self._surface.about["interpolant"])

    @property
    def polarity(self) -> str:
        return str(self._surface.about["polarity"])

    def __len__(self) -> int:
        """The number of triangles; of 2D of segments."""
        return len(self.triangles) or len(self.segments)

    def __repr__(self) -> str:
        facets = f"{len(self.segments):,} segments" if len(self.segments) else f"{len(self.triangles):,} triangles"
        closed = "closed" if self.closed else "open at the border"
        return f"<isoatlas.Mesh: {len(self.points):,} points, {facets}, {closed}, isovalue {self.tau:g}>"

    def __reduce__(self) -> tuple[Any, ...]:
        names = ("points", "triangles", "segments", "normals", "object", "contour")
        arrays = {name: np.array(getattr(self._surface, name)) for name in names}
        return _mesh_of, (arrays, self._surface.about)

    def save(self, path: Path, *, space: str = "lps") -> list[str]:
        """Writes .ply, .stl, .obj, .vtp, .glb or .vtkhdf, by the name; never half a file.

        Parameters
        ----------
        space : {"lps", "ras", "volume"}
            The space of the points in the file, for volumes whose space is medical; others keep theirs.

        Returns
        -------
        list of str
            What the format could not keep.

        Raises
        ------
        InputError
            Unknown extension.
        ResourceError
            It cannot be written.
        """
        return self._surface.write(os.fspath(path), space)

    def verify(self, *, strict: bool = True) -> tuple[Check, ...]:
        """Checks that it is closed, manifold, oriented and without triangles of no area.

        Raises
        ------
        VerificationError
            A guarantee does not hold, unless strict is False.
        """
        return checked(self._surface.verify(), strict)

    def inspect(self) -> dict[str, Any]:
        """Counts of points, edges and triangles, closedness, and the Euler number of each component."""
        return self._surface.inspect()

    def to_trimesh(self) -> Any:
        """A ``trimesh.Trimesh``; needs the package trimesh."""
        import trimesh
        normals = self.normals if len(self.normals) else None
        return trimesh.Trimesh(vertices=self.points, faces=self.triangles, vertex_normals=normals, process=False)

    def to_pyvista(self) -> Any:
        """A ``pyvista.PolyData`` with normals and ids; needs the package pyvista."""
        import pyvista
        cells = self.triangles if len(self.triangles) else self.segments
        table = np.empty((len(cells), cells.shape[1] + 1), dtype=np.int64)
        table[:, 0], table[:, 1:] = cells.shape[1], cells
        mesh = pyvista.PolyData(self.points, table.ravel()) if len(self.triangles) else pyvista.PolyData(self.points, lines=table.ravel())
        if len(self.normals):
            mesh.point_data["Normals"] = self.normals
        if len(self.object_ids):
            mesh.point_data["Object"], mesh.point_data["Contour"] = self.object_ids, self.contour_ids
        return mesh

    def to_meshio(self) -> Any:
        """A ``meshio.Mesh`` with ids; needs the package meshio."""
        import meshio
        cells = [("triangle", self.triangles)] if len(self.triangles) else [("line", self.segments)]
        data = {"object": self.object_ids, "contour": self.contour_ids} if len(self.object_ids) else {}
        return meshio.Mesh(self.points, cells, point_data=data)


def _mesh_of(arrays: dict[str, Any], about: dict[str, Any]) -> Mesh:
    return Mesh(_core.Surface(arrays, about))


def read_mesh(path: Path) -> Mesh:
    """Reads .ply, .stl, .obj, .vtp or .glb; .vtkhdf is written only.

    Raises
    ------
    InputError
        Missing or damaged.
    UnsupportedError
        A variant of the format that is not read.
    """
    return Mesh(_core.read_mesh(os.fspath(path)))
