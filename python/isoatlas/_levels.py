"""Levels of detail of the objects of a store, kept beside it."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Optional, Sequence

from ._calls import Progress, call
from ._mesh import Path
from .errors import NotFoundError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas, Reference

USUAL = 8  #: objects, as on the command line


def save_levels(self: Atlas, objects: Sequence[Reference] = (), *, top: int = 0, path: Optional[Path] = None, progress: Progress = None,
                threads: int = 0) -> list[dict[str, Any]]:
    """Prepares coarser surfaces of objects of a store, each at its best isovalue, and keeps them beside it, as ``isoatlas levels``: viewers
    then read what they draw. Every one has the topology of the exact surface.

    Surfaces that the file has are kept, others are added; an interrupted call goes on where it ended.

    Parameters
    ----------
    objects : sequence of references
        As :meth:`object` takes them; of high values, or of low ones if the store is of low values.
    top : int
        The first so many objects of the table, beside those; 8 where neither is given.
    path : path, optional
        Instead of STORE.lod, where the viewer looks for them.

    Returns
    -------
    list of dict
        What the file holds: ``id``, ``tau``, ``is_cavity``, ``triangles`` of the exact surface and of the ``coarsest``, and its
        ``distance`` from the exact one, at most, in voxels.

    Raises
    ------
    InputError
        The atlas has no store, or the file is of another one.
    UnsupportedError
        The volume is 2D.
    NotFoundError
        There is no such object, or none that shows more than background.
    """
    chosen = [self.object(one) for one in objects]
    if top > 0 or not chosen:
        chosen += self._first(top if top > 0 else USUAL)
    if not chosen:
        raise raised(NotFoundError, "no object of this volume is above the noise level", next="name some: objects=[...]")
    surfaces = [(one.id, one._tau, one.is_cavity) for one in chosen]
    return self._source.save_levels("" if path is None else os.fspath(path), surfaces, call(progress, threads))
