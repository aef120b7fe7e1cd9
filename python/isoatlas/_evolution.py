"""Surfaces of an atlas at several isovalues, as the steps of one file."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Iterable

from ._calls import Progress, call
from ._mesh import Path

if TYPE_CHECKING:
    from ._atlas import Atlas


def save_evolution(self: Atlas, path: Path, taus: Iterable[float], *, boundary: str = "closed", style: str = "compact", shell: str = "all",
                   normals: bool = True, space: str = "lps", progress: Progress = None, threads: int = 0) -> None:
    """Writes the surfaces at several isovalues into one .vtkhdf, a step each: the time slider of ParaView moves through them.

    The file of ``isoatlas animate --from A --to B -o FILE.vtkhdf``; never half a file. Needs memory for one surface at a time.

    Parameters
    ----------
    path : path
        Ends in .vtkhdf.
    taus : iterable of float
        Isovalues; written in ascending order, each once.
    boundary, style, shell, normals
        As of :meth:`surface`.
    space : {"lps", "ras", "volume"}
        As of :meth:`Mesh.save`.

    Raises
    ------
    InputError
        Another extension, no isovalue, or one without a surface.
    NotFoundError
        An isovalue is outside the range of the samples.
    ResourceError
        It cannot be written.
    """
    reported = sorted({float(tau) for tau in taus})
    stored = [self._source.stored(tau) for tau in reported]
    self._source.write_evolution(os.fspath(path), stored, (boundary, style, shell), normals, space, call(progress, threads))
