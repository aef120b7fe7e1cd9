"""Trees, persistence, tunnels and the spectrum, as arrays."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

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
        import networkx
        graph = networkx.DiGraph()
        columns = {name: array.tolist() for name, array in self._arrays.items() if name != "kind"}
        columns["kind"] = [self.kinds[kind] for kind in self.kind]
        names = list(columns)
        graph.add_nodes_from((i, dict(zip(names, row))) for i, row in enumerate(zip(*columns.values())))
        graph.add_edges_from((i, parent) for i, parent in enumerate(self.parent.tolist()) if parent >= 0)
        return graph

    def contours(self) -> Columns:
        """The contour tree: ``upper`` and ``lower`` critical element, ``tau_high``, ``tau_low`` and ``genus`` of each arc."""
        return Columns(_core.contours(self._atlas._source, call()))

    def save(self, path: Path, *, detail: str = "events", all: bool = False) -> None:
        """Writes .json, .graphml, .csv or .vtu, as ``isoatlas tree``; detail: events, levels, elements, contours."""
        _core.write_tree(self._atlas._source, os.fspath(path), detail, all, call())


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
