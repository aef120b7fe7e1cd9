"""Trees, persistence, tunnels and the spectrum, as arrays."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Optional

import numpy as np

from . import _core
from ._calls import Progress, call
from ._mesh import Array, Path

if TYPE_CHECKING:
    from ._atlas import Atlas


class Columns:
    """Arrays of one length, by name: ``columns["value"]`` or ``columns.value``."""

    def __init__(self, arrays: dict[str, Array]) -> None:
        self._arrays = arrays

    def __getattr__(self, name: str) -> Array:
        try:
            return self.__dict__["_arrays"][name]  # type: ignore[no-any-return]
        except KeyError:
            raise AttributeError(name) from None

    def __getitem__(self, name: str) -> Array:
        return self._arrays[name]

    def __dir__(self) -> list[str]:
        return sorted([*super().__dir__(), *self._arrays])

    def keys(self) -> list[str]:
        """The names of the columns."""
        return list(self._arrays)

    def to_dict(self) -> dict[str, Array]:
        """The arrays by name."""
        return dict(self._arrays)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``, columns of rows as several columns; needs the package pandas."""
        import pandas
        flat: dict[str, Array] = {}
        for name, array in self._arrays.items():
            if array.ndim == 1:
                flat[name] = array
            else:
                flat.update({f"{name}_{axis}": array[:, i] for i, axis in enumerate("xyz"[:array.shape[1]])})
        return pandas.DataFrame(flat)


class Tree(Columns):
    """The criticality tree: an element of each array for each event, in descending values; children come before their parent.

    Between events nothing changes. All values are calibrated.

    Attributes
    ----------
    value : (n,) float64
    kind : (n,) int8
        Index into ``Tree.kinds``.
    parent : (n,) int64
        The next event of the same object going down; -1: the root, the last one.
    tau_low, tau_high : (n,) float64
        Its zone: isovalues in (tau_low, tau_high].
    zone_voxels, object_voxels : (n,) int64
        Of the zone, and of the object at the low end of the zone.
    euler, tunnels, cavities, contours : (n,) int64
        Of the object inside its zone.
    voxel, position : (n, 3) float64
        Where: (x, y, z) in voxels, and in physical units.
    """

    kinds: list[str] = _core.tree_kinds()

    def __init__(self, atlas: Atlas, progress: Progress = None, threads: int = 0) -> None:
        super().__init__(_core.tree(atlas._source, call(progress, threads)))
        self._atlas = atlas

    def __len__(self) -> int:
        return len(self.value)

    def __repr__(self) -> str:
        return f"<isoatlas.Tree: {len(self):,} events>"

    def to_networkx(self) -> Any:
        """A ``networkx.DiGraph``: a node for each event with its values, an edge from each to its parent; needs the package networkx."""
        columns = {name: array.tolist() for name, array in self._arrays.items() if name != "kind"}
        columns["kind"] = [self.kinds[kind] for kind in self.kind]
        return _graph(columns, self.parent)

    def contours(self) -> Columns:
        """The contour tree: ``upper`` and ``lower`` critical element, ``tau_high``, ``tau_low`` and ``genus`` of each arc."""
        return Columns(_core.contours(self._atlas._source, call()))

    def save(self, path: Path, *, detail: str = "events", all: bool = False) -> None:
        """Writes .json, .graphml, .csv or .vtu, as ``isoatlas tree``; detail: events, levels, elements, contours."""
        _core.write_tree(self._atlas._source, os.fspath(path), detail, all, call())


    def simplify(self, *, keep: Optional[int] = None, top_percent: Optional[float] = None, min_voxels: float = 0.0,
                 min_measure: float = 0.0, min_persistence: float = 0.0, min_hypervolume: float = 0.0, progress: Progress = None,
                 threads: int = 0) -> SimplifiedTree:
        """The tree of the objects that a selection keeps, as ``isoatlas tree`` with these options; all conditions must hold."""
        selection = self._atlas._selection(keep, top_percent, min_voxels, min_measure, min_persistence, min_hypervolume)
        return SimplifiedTree(self._atlas, selection, progress, threads)


class SimplifiedTree(Columns):
    """The tree of some objects: zones of the others have joined that of the object into which they merge.

    An element of each array for each node, in descending values; children come before their parent.

    Attributes
    ----------
    event : (n,) int64
        Index into the full tree.
    parent : (n,) int64
        -1: the root, the last one.
    object : (n,) int64
        Id of the object that the node lies on.
    is_maximum : (n,) bool
        It begins; else others end in it.
    tau_low, tau_high : (n,) float64
        Its zone: isovalues in (tau_low, tau_high].
    zone_voxels, object_voxels : (n,) int64
        Of the zone, those of bypassed ones included, and of the object at its low end.
    node_of_event : (events,) int64
        The node whose zone that of each event of the full tree has joined.
    kept, hidden, hidden_voxels : int
        Objects of the selection, the other ones, and how many voxels lie in these.
    """

    def __init__(self, atlas: Atlas, selection: dict[str, Any], progress: Progress = None, threads: int = 0) -> None:
        arrays, node_of_event, kept, hidden, hidden_voxels = _core.simplified(atlas._source, selection, call(progress, threads))
        arrays["is_maximum"] = arrays["is_maximum"].astype(bool)
        super().__init__(arrays)
        self._atlas, self._selection = atlas, selection
        self.node_of_event: Array = node_of_event
        self.kept, self.hidden, self.hidden_voxels = kept, hidden, hidden_voxels

    def __len__(self) -> int:
        return len(self.event)

    def __repr__(self) -> str:
        return f"<isoatlas.SimplifiedTree: {len(self):,} nodes of {self.kept:,} objects, {self.hidden:,} hidden>"

    def to_networkx(self) -> Any:
        """As :meth:`Tree.to_networkx`."""
        return _graph({name: array.tolist() for name, array in self._arrays.items()}, self.parent)

    def zones(self, *, progress: Progress = None, threads: int = 0) -> Array:
        """The node of every voxel, plus 1: (z, y, x) uint32, as ``isoatlas label --zones`` with a selection."""
        node: Array = (self.node_of_event + 1).astype(np.uint32)
        nodes: Array = node[self._atlas.zones(progress=progress, threads=threads) - 1]
        return nodes

    def save(self, path: Path) -> None:
        """Writes .json, .graphml, .csv or .vtu, as ``isoatlas tree`` with a selection."""
        _core.write_simplified(self._atlas._source, self._selection, os.fspath(path), call())


def _graph(columns: dict[str, list[Any]], parents: Array) -> Any:
    import networkx
    graph = networkx.DiGraph()
    names = list(columns)
    graph.add_nodes_from((i, dict(zip(names, row))) for i, row in enumerate(zip(*columns.values())))
    graph.add_edges_from((i, parent) for i, parent in enumerate(parents.tolist()) if parent >= 0)
    return graph


class Handles(Columns):
    """Tunnels: ``pairs`` (n, 2) of isovalues at which each opens and closes, ``opened_at`` and ``closed_at`` (n, 3) in physical units,
    ``is_open``: still open where its object merges."""

    def __len__(self) -> int:
        return len(self.pairs)


class Spectrum(Columns):
    """Counts at all isovalues, and sizes of the surface at some.

    ``tau_low``, ``tau_high``: intervals in which no count changes, descending; ``objects``, ``contours``, ``tunnels``, ``cavities`` in
    them, ``significant``: objects that noise does not explain. ``size_tau``, ``size_facets``, ``size_area``, ``size_measure``: sizes.
    """

    def __init__(self, atlas: Atlas, samples: int, progress: Progress, threads: int) -> None:
        super().__init__(_core.spectrum(atlas._source, samples, call(progress, threads)))
        self._atlas, self._samples = atlas, samples

    def counts_at(self, tau: float) -> dict[str, int]:
        """How many objects, contours, tunnels and cavities there are at an isovalue."""
        names = ("objects", "contours", "tunnels", "cavities", "significant")
        inside = np.flatnonzero((self.tau_low < tau) & (tau <= self.tau_high))
        return {name: int(self[name][inside[0]]) if len(inside) else 0 for name in names}

    def save(self, path: Path) -> None:
        """Writes .csv, .svg or .json, as ``isoatlas spectrum``."""
        _core.write_spectrum(self._atlas._source, os.fspath(path), self._samples, call())
