"""Persistence pairs and tunnels of an atlas."""
from __future__ import annotations

from typing import TYPE_CHECKING, Optional

import numpy as np

from . import _core
from ._calls import Progress, call
from ._mesh import Array
from ._tree import Handles
from .errors import InputError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas, Reference


def persistence(self: Atlas, dimension: int = 0, *, min_persistence: float = 0.0, progress: Progress = None, threads: int = 0) -> Array:
    """Persistence pairs of the sets where samples are >= tau: (n, 2), birth and death; birth is above death, as tau falls.

    Parameters
    ----------
    dimension : {0, 1, 2}
        0: objects, by the elder rule; the one that never merges has death -inf. 1: tunnels, as ``isoatlas handles --exact``; of 2D
        volumes holes. 2: cavities, from where they close to where they are filled: their lowest sample.
    min_persistence : float
        Pairs of less are left out.

    Notes
    -----
    ``-persistence`` are the pairs of sublevel sets of ``-volume`` in ascending order, as gudhi and persim plot them. An atlas of
    polarity "low" has the pairs of sublevel sets of the volume.
    """
    if dimension == 0:
        pairs = _core.object_pairs(self._source, call(progress, threads))
    elif dimension == self.ndim - 1:
        pairs = _core.cavity_pairs(self._source, call(progress, threads))
    elif dimension == 2:
        pairs = np.empty((0, 2))
    elif dimension == 1:
        stored = min_persistence / abs(self.info["slope"])
        pairs = _core.handles(self._source, True, stored, -1, call(progress, threads))["pairs"]
    else:
        raise raised(InputError, f"persistence of dimension {dimension}", expected="0 (objects), 1 (tunnels) or 2 (cavities)",
                     next="correct it")
    kept: Array = pairs[np.abs(pairs[:, 0] - pairs[:, 1]) >= min_persistence]
    return kept


def handles(self: Atlas, *, exact: bool = True, min_persistence: float = 0.0, object: Optional[Reference] = None, progress: Progress = None,
            threads: int = 0) -> Handles:
    """Tunnels with the isovalues at which each opens and closes, by descending persistence.

    Parameters
    ----------
    exact : bool
        False: from the trees alone; how many tunnels there are is exact, single pairs are not.
    object : reference, optional
        Only those of this object.
    """
    if object is not None and not exact:
        raise raised(InputError, "tunnels of one object are exact ones", next="leave exact out")
    voxel = -1 if object is None else self.object(object).id
    stored = min_persistence / abs(self.info["slope"])
    return Handles(_core.handles(self._source, exact, stored, voxel, call(progress, threads)))
