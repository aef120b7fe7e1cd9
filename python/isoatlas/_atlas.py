"""Atlas: a volume with all its isovalues, in memory or from a store."""
from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _arrays, _core, _html, _names, _persistence
from ._calls import NO_BLOCKS, Blocks, Progress, blocks_of, call
from ._evolution import save_evolution as _save_evolution
from ._levels import save_levels as _save_levels
from ._mesh import Array, Check, Mesh, Path, checked
from ._objects import Object, Table
from ._tree import Spectrum, Tree
from .errors import InputError, NotFoundError, raised

if TYPE_CHECKING:
    from ._view import View

Reference = Union[Object, int, str]
ROWS = 24  #: lines of the table, as the command line lists them
KNOWN = 1000  #: lines that numbers refer to


class Atlas:
    """A volume with its objects at all isovalues: arrays are (z, y, x), points are (x, y, z) in physical units.

    Made by :func:`isoatlas.open`. What needs an analysis computes it once, at the first call. Isovalues are calibrated. Queries may be
    called from several threads at once, and interrupted with Ctrl-C.
    """

    def __init__(self, source: _core.Source, recipe: tuple[Any, Mapping[str, Any]], folder: Any = None) -> None:
        self._open_source: Optional[_core.Source] = source
        self._recipe = recipe
        self._folder = folder  # of a temporary store
        # Rows and not tables, which refer to the atlas: it is freed with its last reference, without waiting for a collection.
        self._found: dict[tuple[bool, int], dict[str, Any]] = {}

    @property
    def _source(self) -> _core.Source:
        if self._open_source is None:
            raise raised(InputError, "the atlas is closed", next="isoatlas.open() opens it again")
        return self._open_source

    def close(self) -> None:
        """Frees the volume and its trees, and removes a temporary store. Meshes and labels live on."""
        self._open_source = None
        self._found = {}
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def __enter__(self) -> Atlas:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __copy__(self) -> Atlas:
        return self

    def __deepcopy__(self, _: Any) -> Atlas:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        source, options = self._recipe
        return _open_again, (os.path.abspath(source) if _arrays.is_path(source) else source, dict(options))

    # What it is of.

    @property
    def info(self) -> dict[str, Any]:
        """What the header says, by the names of the JSON documents of the command line: ``dims``, ``spacing`` in the order x, y, z."""
        return self._source.info

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the array: (z, y, x), or (y, x)."""
        return tuple(self.info["dims"][::-1])

    @property
    def ndim(self) -> int:
        """3 or 2."""
        return int(self.info["rank"])

    @property
    def dtype(self) -> np.dtype[Any]:
        """Of the samples."""
        return np.dtype(self.info["type"])

    @property
    def spacing(self) -> tuple[float, ...]:
        """In the order of the array's axes: (z, y, x)."""
        return tuple(self.info["spacing"][: self.ndim][::-1])

    @property
    def range(self) -> tuple[float, float]:
        """The lowest and the highest sample, calibrated."""
        low, high = (self._source.reported(value) for value in self._source.range())
        return min(low, high), max(low, high)

    @property
    def is_store(self) -> bool:
        """Is it read from a store? Else it is in memory."""
        return self._source.is_store

    @property
    def interpolant(self) -> str:
        """"trilinear" or "faces"."""
        return self._source.interpolant

    @property
    def polarity(self) -> str:
        """"high" or "low"."""
        return str(self.info["polarity"])

    @property
    def volume(self) -> Array:
        """The samples, read-only: a view where they are in memory; of a store all are read. Of low polarity they are negated."""
        return self._source.volume(call()).samples

    def save(self, path: Path) -> None:
        """Writes the samples as .nrrd, .npy, .raw, .mha, .mrc, .vdb, .h5, .vti, .nii, .nii.gz or .tif, as ``isoatlas convert``."""
        self._source.volume(call()).write(os.fspath(path))

    def __repr__(self) -> str:
        if self._open_source is None:
            return "<isoatlas.Atlas: closed>"
        low, high = self.range
        name = self.info["path"] or "array"
        return f"<isoatlas.Atlas of {name}: {' x '.join(map(str, self.shape))} {self.dtype}, values {low:g} .. {high:g}>"

    def _repr_html_(self) -> str:
        return _html.atlas(self)

    # Tables.

    @property
    def objects(self) -> Table:
        """The table of objects: those that noise does not explain, at most 24 lines, by rank."""
        return self._table(False, ROWS)

    @property
    def cavities(self) -> Table:
        """The table of cavities: enclosed regions of low values, at most 24 lines, by rank."""
        return self._table(True, ROWS)

    def _table(self, is_cavity: bool, top: int) -> Table:
        """Of those that noise does not explain."""
        source, key = self._source, (is_cavity, top)
        if key not in self._found:
            self._found[key] = (_core.cavities if is_cavity else _core.objects)(source, top, True, None, call())
        return Table(self, self._found[key], is_cavity)

    def find_objects(self, top: Optional[int] = None, *, all: bool = False, keep: Optional[int] = None, top_percent: Optional[float] = None,
                     min_voxels: float = 0.0, min_measure: float = 0.0, min_persistence: float = 0.0, min_hypervolume: float = 0.0,
                     progress: Progress = None, threads: int = 0) -> Table:
        """Another table of objects.

        Parameters
        ----------
        top : int, optional
            At most so many lines; 0: any number. Default: 24, with all or a selection any number.
        all : bool
            Also what noise explains.
        keep, top_percent, min_voxels, min_measure, min_persistence, min_hypervolume
            A selection instead of the noise gate, as the options of ``isoatlas objects``; all conditions must hold.
        """
        selection = self._selection(keep, top_percent, min_voxels, min_measure, min_persistence, min_hypervolume) or None
        if top is None:
            top = 0 if all or selection else ROWS
        return Table(self, _core.objects(self._source, top, not all, selection, call(progress, threads)))

    def _selection(self, keep: Optional[int], top_percent: Optional[float], min_voxels: float, min_measure: float, min_persistence: float,
                   min_hypervolume: float) -> dict[str, Any]:
        """What is given, in stored values."""
        slope = abs(self.info["slope"])
        given = {"keep": keep, "top_percent": top_percent, "min_voxels": min_voxels, "min_measure": min_measure,
                 "min_persistence": min_persistence / slope, "min_hypervolume": min_hypervolume / slope}
        return {name: value for name, value in given.items() if value}

    def object(self, reference: Reference) -> Object:
        """An object by its number from 1, or as the command line calls it: ``3``, ``"3"``, ``"c2"`` (a cavity), ``"v81275"`` (by id), or
        by its name.

        Raises
        ------
        NotFoundError
            There is none.
        """
        if isinstance(reference, Object):
            return reference
        found = re.fullmatch(r"([cv]?)([0-9]+)", str(reference))
        if not found:
            return _names.named(self, str(reference))
        is_cavity, number = found[1] == "c", int(found[2])
        table = self._numbered(is_cavity)
        for one in table:
            if number == (one.id if found[1] == "v" else one.number):
                return one
        what = "cavity" if is_cavity else "object"
        raise raised(NotFoundError, f"there is no {what} {reference}", expected=f"1 to {len(table)}" if len(table) else "the table is empty",
                     next="atlas.cavities lists them" if is_cavity else "atlas.objects lists them")

    @property
    def names(self) -> dict[str, str]:
        """Names of objects and cavities, as ``isoatlas name`` lists them, and what each is the name of: "3", "c2"; "v81275" where the table
        does not list it at the isovalue that it was named at. They lie beside the store; an atlas in memory has none."""
        return {one.name: one.reference for one in _names.names_of(self)}

    def give_name(self, reference: Reference, name: Optional[str]) -> None:
        """Names an object of a store, at its best isovalue, as ``isoatlas name``; None takes its name away.

        Raises
        ------
        UnsupportedError
            The atlas is in memory.
        InputError
            Another object has this name, or it is no name: docs/cli.md, "References to objects".
        """
        _names.give_name(self, self.object(reference), name)

    def _numbered(self, is_cavity: bool) -> Table:
        return self._table(is_cavity, KNOWN)

    def _first(self, count: int) -> list[Object]:
        """The first lines that show more than background, if there are any."""
        table = self.find_objects(0)
        return [one for one in table if len(table) == 1 or not one.background][:count]

    # One isovalue.

    def surface(self, tau: float, *, objects: Sequence[int] = (), contours: Sequence[int] = (), boundary: str = "closed",
                style: str = "compact", shell: str = "all", normals: bool = True, ids: bool = True, simplify: Optional[float] = None,
                triangles: int = 0, octree: int = 0, octree_error: Optional[float] = None, eye: Optional[Sequence[float]] = None,
                pixels: float = 1.0, progress: Progress = None, threads: int = 0) -> Mesh:
        """The surface at an isovalue, a closed mesh with points (x, y, z); of 2D volumes closed curves.

        Parameters
        ----------
        tau : float
            Isovalue. The object is where samples are >= tau.
        objects : sequence of int
            Ids of voxels: the objects at tau that contain them; empty: all.
        contours : sequence of int
            Ids of contours, as :meth:`objects_at` lists them; empty: all.
        boundary : {"closed", "open"}
            open: without the caps where objects reach the border of the volume.
        style : {"compact", "full"}
            full: the articulation points of the dissertation; the same topology with more triangles.
        shell : {"all", "outer", "inner"}
            inner: walls of cavities.
        normals : bool
        ids : bool
            False: without ``object_ids`` and ``contour_ids``, in about half the time.
        simplify : float, optional
            Fewer triangles, at most so many voxels from the exact surface, and back, with the same topology.
        triangles : int
            Simplify to this number of triangles, not fewer; without ``simplify`` at any distance.
        octree : int
            Coarse at once, with the same topology: blocks of 2, 4, 8, 16 or 32 cells where the surface is one disk are a fan of triangles.
        octree_error : float, optional
            Smaller blocks, until every point of the exact surface on an edge of the grid is within so many voxels.
        eye : sequence of float, optional
            Instead, seen from this place, (x, y, z): they are at most ``pixels`` away, in a picture of 1080 lines that is 30 degrees high.
        pixels : float
            With ``eye``.

        Raises
        ------
        NotFoundError
            tau is outside the range of the samples, or there is no such object or contour.
        """
        return self._extract(self._source.stored(float(tau)), objects=objects, contours=contours, boundary=boundary, style=style, shell=shell,
                             normals=normals, ids=ids, simplify=simplify, triangles=triangles, blocks=blocks_of(octree, octree_error, eye, pixels),
                             progress=progress, threads=threads)

    def _extract(self, tau: float, *, objects: Sequence[int] = (), contours: Sequence[int] = (), boundary: str, style: str, shell: str,
                 normals: bool, ids: bool = True, simplify: Optional[float] = None, triangles: int = 0, blocks: Blocks = NO_BLOCKS,
                 progress: Progress, threads: int) -> Mesh:
        return Mesh(self._source.extract(tau, list(map(int, objects)), list(map(int, contours)), (boundary, style, shell), normals, ids,
                                         None if simplify is None else float(simplify), int(triangles), blocks, call(progress, threads)))

    save_evolution = _save_evolution
    save_levels = _save_levels

    def objects_at(self, tau: float, *, progress: Progress = None, threads: int = 0) -> list[dict[str, Any]]:
        """Every object at an isovalue, the largest first: ``id``, ``voxels``, ``measure``, ``chi``, ``tunnels``, ``cavities``, ``box``
        (inclusive bounds in voxels, x, y, z), ``contours`` (id, shell, genus)."""
        return self._source.cut(self._source.stored(float(tau)), call(progress, threads))

    def betti(self, tau: float, *, progress: Progress = None, threads: int = 0) -> tuple[int, int, int]:
        """(b0, b1, b2) of where samples are >= tau: objects, tunnels, cavities. 2D: objects, holes, 0. Any finite tau."""
        b0, b1, b2 = self._source.betti(self._stored_any(tau), call(progress, threads))
        return b0, b1, b2

    def _stored_any(self, tau: float) -> float:
        if not np.isfinite(tau):
            raise raised(InputError, "the isovalue is not finite", next="give a number")
        return self._source.stored_of_any(float(tau))

    def labels(self, tau: Optional[float] = None, *, keep: int = ROWS, objects: Sequence[Reference] = (), cavities: bool = False,
               progress: Progress = None, threads: int = 0) -> Array:
        """A label array, (z, y, x) uint32: each object of the table at its own best isovalue, or all objects at one isovalue.

        Parameters
        ----------
        tau : float, optional
            All objects at this isovalue: 1 is the largest. With cavities=True its cavities.
        keep : int
            Without tau: the first so many objects of the table that show more than background; labels are their numbers. A voxel in
            several has the label of the innermost.
        objects : sequence of references, optional
            These objects instead, as :meth:`object` takes them.

        Raises
        ------
        NotFoundError
            tau is outside the range, or no object is above the noise.
        """
        if tau is not None:
            stored, own = self._source.stored(float(tau)), call(progress, threads)
            return (self._source.cavity_labels(stored, own) if cavities else self._source.labels(stored, [], own))[0]
        return self._nested([(one.is_cavity, one.id, one._tau, label) for label, one in self._labelled(keep, objects)], progress, threads)

    def _labelled(self, keep: int, objects: Sequence[Reference]) -> list[tuple[int, Object]]:
        """Objects with their labels: their numbers; those of cavities follow the numbers of the table."""
        chosen = [self.object(one) for one in objects] or self._first(keep)
        if not chosen:
            raise raised(NotFoundError, "no object of this volume is above the noise level",
                         next="give tau, or atlas.find_objects(all=True) lists all")
        table = len(self._numbered(False)) if any(one.is_cavity for one in chosen) else 0
        return [(one.number + (table if one.is_cavity else 0), one) for one in chosen]

    def _nested(self, parts: list[tuple[bool, int, float, int]], progress: Progress, threads: int) -> Array:
        return self._source.nested_labels(parts, call(progress, threads))

    def save_labels(self, path: Path, tau: Optional[float] = None, *, keep: int = ROWS, objects: Sequence[Reference] = (),
                    cavities: bool = False, progress: Progress = None, threads: int = 0) -> list[str]:
        """Writes what :meth:`labels` returns, as ``isoatlas label``: .seg.nrrd, .nrrd, .nii, .nii.gz, .tif, .mrc or .h5; returns warnings."""
        labels = self.labels(tau, keep=keep, objects=objects, cavities=cavities, progress=progress, threads=threads)
        if tau is not None:
            self._source.write_labels(os.fspath(path), labels, self._source.stored(float(tau)), cavities)
            return []
        counts = np.bincount(labels.ravel())
        segments = []
        for label, one in sorted(self._labelled(keep, objects), key=lambda pair: pair[0]):
            name = f"{'cavity' if one.is_cavity else 'object'} {one.number}"
            voxels = int(counts[label]) if label < len(counts) else 0
            segments.append((label, name, one.colour, one.best_tau, voxels, self.polarity))
        return self._source.write_segments(os.fspath(path), labels, segments)

    def zones(self, *, progress: Progress = None, threads: int = 0) -> Array:
        """The zone of every voxel, (z, y, x) uint32: the index of its event in :attr:`tree`, plus 1."""
        return self._source.zones(call(progress, threads))

    # All isovalues.

    @property
    def tree(self) -> Tree:
        """The criticality tree as arrays."""
        return Tree(self)

    persistence, handles = _persistence.persistence, _persistence.handles

    def spectrum(self, samples: int = 24, *, progress: Progress = None, threads: int = 0) -> Spectrum:
        """Numbers of objects, contours, tunnels and cavities at all isovalues, and sizes of the surface at so many."""
        return Spectrum(self, samples, progress, threads)

    def measures(self, tau: float, *, objects: Sequence[int] = (), thickness: bool = False) -> list[dict[str, Any]]:
        """Volume, area, shape and values of the objects at an isovalue, as ``isoatlas measure``; objects: ids, empty: all."""
        return self._measures(self._source.stored(float(tau)), objects, thickness)

    def _measures(self, tau: float, objects: Sequence[int], thickness: bool) -> list[dict[str, Any]]:
        from ._pictures import measures
        return measures(self._source, tau, objects, thickness)

    def verify(self, *, levels: int = 8, full: bool = False, seed: int = 1, strict: bool = True, progress: Progress = None,
               threads: int = 0) -> tuple[Check, ...]:
        """Checks the guarantees for this volume or store, as ``isoatlas verify``.

        Raises
        ------
        VerificationError
            One does not hold, unless strict is False.
        """
        return checked(self._source.verify(levels, full, seed, call(progress, threads)), strict)

    def view(self, *, height: int = 600, port: int = 0) -> View:
        """The navigator, in the cell of a notebook or in a browser tab: see :class:`isoatlas.View`."""
        from ._view import View
        return View(self, height=height, port=port)


def _open_again(source: Any, options: dict[str, Any]) -> Atlas:
    """What a pickle of an atlas calls."""
    from ._open import open
    return open(source, **options)
