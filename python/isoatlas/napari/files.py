"""Files that napari opens and saves."""
from __future__ import annotations

import os
from typing import Any, Callable, Optional, Sequence, Union

import numpy as np

from .. import _core, _functions
from .._arrays import volume_of
from .._mesh import Array
from .._open import open as open_atlas
from .._pictures import colour_of
from ..errors import Error, UnsupportedError, raised
from .layers import Layer, image

Paths = Union[str, Sequence[str]]
ENDINGS = (".nii.gz", ".atlas", ".nrrd", ".nhdr", ".nii", ".mha", ".mhd", ".vti", ".npy")


def reader_of(path: Paths) -> Optional[Callable[[Paths], list[Layer]]]:
    """What reads this path; None: another plugin shall. A list of paths is a stack of slices, which is not ours."""
    if not isinstance(path, str) or not path.lower().endswith(ENDINGS):
        return None
    try:
        _functions.info(path)
    except (Error, ValueError):  # another plugin may know the variant
        return None
    return read


def read(path: Paths) -> list[Layer]:
    """The volume of a file or a store as an image, with its atlas."""
    assert isinstance(path, str)
    name = os.path.basename(path)
    return [image(open_atlas(path), next((name[: -len(end)] for end in ENDINGS if name.lower().endswith(end)), name))]


def demo() -> list[Layer]:
    """A small volume with known objects."""
    return [image(open_atlas(_functions.phantom("demo", 64)), "demo")]


def _geometry(options: dict[str, Any], rank: int) -> dict[str, Any]:
    """Spacing in the order of the array, origin and direction (x, y, z), of the place of a layer."""
    affine = np.asarray(options.get("affine", np.eye(rank + 1)), dtype=float)
    own = np.eye(rank + 1)
    own[:rank, :rank] = np.diag(np.broadcast_to(np.asarray(options.get("scale", 1.0), dtype=float), (rank,)))
    own[:rank, rank] = np.broadcast_to(np.asarray(options.get("translate", 0.0), dtype=float), (rank,))
    rotate, shear = options.get("rotate"), options.get("shear")
    if any(value is not None and not np.allclose(value, none) for value, none in ((rotate, np.eye(rank)), (shear, 0.0))):
        raise raised(UnsupportedError, "a rotated or sheared layer", next="rotate the volume, or save the labels with another plugin")
    whole = affine @ own
    matrix, origin = whole[:rank, :rank][::-1, ::-1], np.zeros(3)
    origin[:rank] = whole[:rank, rank][::-1]
    spacing, direction = np.linalg.norm(matrix, axis=0), np.eye(3)
    direction[:rank, :rank] = matrix / spacing
    return {"spacing": tuple(spacing[::-1]), "origin": tuple(origin), "direction": direction if rank == 3 else None}


def _segments(data: Array, features: Any) -> Optional[list[tuple[int, str, tuple[int, int, int], float, int, str]]]:
    """Number, name, colour, isovalue, voxels and polarity of each label; None: some label is not one of our objects."""
    if features is None or any(column not in features for column in ("index", "object", "isovalue")):
        return None
    known = {int(n): (str(name), float(tau)) for n, name, tau in zip(features["index"], features["object"], features["isovalue"])}
    segments = []
    for number, voxels in zip(*np.unique(data[data > 0], return_counts=True)):
        name, tau = known.get(int(number), ("", np.nan))
        kind, _, own = name.partition(" ")
        if not np.isfinite(tau) or not own.isdigit():
            return None
        segments.append((int(number), name, colour_of(int(own), kind == "cavity"), tau, int(voxels), "high"))
    return segments


def write_labels(path: str, data: Any, options: dict[str, Any]) -> list[str]:
    """Writes a layer of labels: those of our objects with name, colour and isovalue where the format has room for them."""
    array = np.ascontiguousarray(data, dtype=np.uint32)
    place = _geometry(options, array.ndim)
    segments = _segments(array, options.get("features"))
    volume = volume_of(array, place["spacing"], place["origin"], place["direction"], None, "")
    if segments:
        _core.Source.of_volume(volume, "trilinear", 0.0).write_segments(os.fspath(path), array, segments)
    else:
        volume.write(os.fspath(path))
    return [path]
