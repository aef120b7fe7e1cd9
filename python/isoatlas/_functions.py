"""Functions of one call: drop-ins for scikit-image and scipy, phantoms, files."""
from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np

from . import _arrays, _core
from ._arrays import Spacing
from ._atlas import Atlas
from ._calls import Progress, call
from ._mesh import Array, Check, Mesh, Path, read_mesh
from ._open import open, reading_options
from ._tree import Columns
from .errors import InputError, UnsupportedError, raised


def _atlas_of(volume: Any, interpolant: str = "trilinear") -> Atlas:
    return volume if isinstance(volume, Atlas) else open(volume, interpolant=interpolant)


def betti(volume: Any, level: float, *, interpolant: str = "trilinear") -> tuple[int, int, int]:
    """Betti numbers (b0, b1, b2) of where an array (z, y, x) is >= level: objects, tunnels, cavities.

    Parameters
    ----------
    volume : array, path or Atlas
        As :func:`isoatlas.open` takes it; a mask of bool with level 0.5.
    level : float
        Any finite number.
    interpolant : {"trilinear", "faces"}
        How samples are connected inside cells. Of 2D arrays b1 is the number of holes, and b2 is 0.

    Examples
    --------
    >>> import numpy, isoatlas
    >>> z, y, x = numpy.mgrid[-8:9, -8:9, -8:9]
    >>> ring = (numpy.hypot(numpy.hypot(x, y) - 5, z) < 2).astype(float)
    >>> isoatlas.betti(ring, 0.5)
    (1, 1, 0)
    """
    return _atlas_of(volume, interpolant).betti(level)


def euler_number(volume: Any, level: float = 0.5, *, interpolant: str = "trilinear") -> int:
    """The Euler number b0 - b1 + b2 of where an array (z, y, x) is >= level.

    Parameters
    ----------
    volume, level, interpolant
        As :func:`betti`.
    """
    b0, b1, b2 = betti(volume, level, interpolant=interpolant)
    return b0 - b1 + b2


def label(volume: Any, level: float = 0.5, *, connectivity: str = "trilinear", progress: Progress = None,
          threads: int = 0) -> tuple[Array, int]:
    """Labels the connected parts of where an array (z, y, x) is >= level, as ``scipy.ndimage.label`` labels a mask.

    Parameters
    ----------
    volume : array, path or Atlas
    level : float
        Any finite number.
    connectivity : {"trilinear", "faces"}
        How samples are connected inside cells: at least neighbours along the axes, diagonal ones where the interpolant joins them.

    Returns
    -------
    labels : ndarray of int32
        In the shape of the volume: 0 where it is below level; 1 is the largest part.
    count : int
    """
    atlas = _atlas_of(volume, connectivity)
    labels, count = atlas._source.labels(atlas._stored_any(level), [], call(progress, threads))
    return labels.view(np.int32), count


def marching_cubes(volume: Any, level: Optional[float] = None, *, spacing: Spacing = (1.0, 1.0, 1.0), gradient_direction: str = "descent",
                   step_size: int = 1, allow_degenerate: bool = True, method: str = "lewiner", mask: Any = None,
                   boundary: str = "closed", interpolant: str = "trilinear", progress: Progress = None,
                   threads: int = 0) -> tuple[Array, Array, Array, Array]:
    """The surface of an array (z, y, x) as ``skimage.measure.marching_cubes`` returns it, points in the order of its axes: (z, y, x).

    Parameters
    ----------
    volume : (z, y, x) array
    level : float, optional
        Isovalue; default: the middle of the range. It may equal samples: the surface has no holes and no repeated triangles.
    spacing : (float, float, float)
        Of the samples along z, y, x.
    gradient_direction : {"descent", "ascent"}
        descent: objects are where values are higher; ascent turns the triangles around.
    step_size : int
        Takes every so many-th sample.
    allow_degenerate : bool
        Of no meaning: there are no degenerate triangles.
    method : {"lewiner", "lorensen"}
        Of no meaning: the topology is that of the trilinear interpolant.
    boundary : {"closed", "open"}
        closed: surfaces have caps where they reach the border of the array, and are watertight; open, as scikit-image: they end there.
    mask
        Not supported.

    Returns
    -------
    points : (n, 3) float64
        In the order of the array's axes, times spacing.
    triangles : (m, 3) int64
    normals : (n, 3) float32
        Towards lower values, perpendicular to the surface for any spacing.
    values : (n,) float32
        The largest sample of the cell around each point.

    Raises
    ------
    NotFoundError
        level is outside the range of the samples.
    UnsupportedError
        A mask.
    """
    if mask is not None:
        raise raised(UnsupportedError, "a mask is not supported", next="fill what is not to be seen with a value below level")
    if gradient_direction not in ("descent", "ascent"):
        raise raised(InputError, f"gradient_direction cannot be {gradient_direction!r}", expected="'descent', 'ascent'", next="use one of them")
    if method not in ("lewiner", "lorensen"):
        raise raised(InputError, f"method cannot be {method!r}", expected="'lewiner', 'lorensen'", next="use one of them")
    if step_size < 1:
        raise raised(InputError, f"step_size cannot be {step_size!r}", expected="a number of at least 1", next="correct it")
    array = np.asarray(volume)
    if array.ndim != 3 or min(array.shape) < 2:
        raise raised(InputError, f"the array has the shape {array.shape}", expected="three axes of at least 2 samples",
                     next="isoatlas.open(array).surface(level) has curves of 2D arrays")
    if level is None:
        level = (float(array.min()) + float(array.max())) / 2
    array = array[::step_size, ::step_size, ::step_size]
    steps = np.array((_arrays.spacing_of(spacing, 3) or [1.0, 1.0, 1.0])[::-1]) * step_size
    atlas = open(array, spacing=tuple(steps), interpolant=interpolant)
    mesh = atlas.surface(level, boundary=boundary, ids=False, progress=progress, threads=threads)
    points, triangles = np.ascontiguousarray(mesh.points[:, ::-1]), mesh.triangles
    normals = np.ascontiguousarray(mesh.normals[:, ::-1])
    # With the axes the other way round the triangles are, too: that is how scikit-image has them in "descent".
    if gradient_direction == "ascent":
        triangles = np.ascontiguousarray(triangles[:, ::-1])
    return points, triangles, normals, _largest_around(array, points / steps)


def _largest_around(array: Array, points: Array) -> Array:
    """The largest of the samples at the corners of the cell around each point (in samples)."""
    last = np.array(array.shape) - 1
    low = np.clip(np.floor(points), 0, last).astype(np.intp)
    high = np.clip(np.ceil(points), 0, last).astype(np.intp)
    values = np.full(len(points), -np.inf, dtype=np.float32)
    for corner in range(8):
        z, y, x = (np.where(corner >> axis & 1, high[:, axis], low[:, axis]) for axis in range(3))
        np.maximum(values, array[z, y, x], out=values, casting="unsafe")
    return values


def phantom(name: str, size: int = 0, *, seed: int = 1, genus: int = 3, shells: int = 3, noise: float = 0.0, quantise: int = 0) -> Array:
    """A generated volume with known answers, as ``isoatlas phantom``: an array (z, y, x), the same on every machine.

    Parameters
    ----------
    name : str
        :func:`phantoms` lists them.
    size : int
        Samples along each axis; 0: the phantom's own.
    """
    options = {"size": size, "seed": seed, "genus": genus, "shells": shells, "noise": float(noise), "quantise": quantise}
    return _core.phantom(name, options).samples


def phantoms() -> dict[str, str]:
    """Names and descriptions of generated volumes."""
    return {name: summary for name, summary, _ in _core.phantoms()}


def read(path: Path, *, missing: Union[None, str, float] = None, no_data: Optional[float] = None, progress: Progress = None,
         **reading: Any) -> tuple[Array, dict[str, Any]]:
    """Reads a volume file: the samples as an array (z, y, x), and what its header says (lengths in the order x, y, z).

    Parameters
    ----------
    path : path
        NRRD, NIfTI, MetaImage, TIFF, VTI, legacy VTK, NPY, MRC or RAW; or a store.
    **reading
        dims, type, endian, skip, spacing, ... as :func:`isoatlas.open`.
    """
    if _core.is_store(os.fspath(path)):
        atlas = open(path, **reading)
        return atlas.volume, atlas.info
    volume = _core.read_volume(os.fspath(path), reading_options(**reading), missing, no_data, call(progress))
    return volume.samples, volume.info


def info(path: Path, **reading: Any) -> dict[str, Any]:
    """What the header of a volume file or a store says; no sample is read."""
    if _core.is_store(os.fspath(path)):
        return open(path).info
    return _core.volume_info(os.fspath(path), reading_options(**reading))


def write(path: Path, array: Any, *, spacing: Spacing = None, origin: Any = None, direction: Any = None, unit: Optional[str] = None,
          value_unit: str = "", space: Optional[str] = None) -> None:
    """Writes an array (z, y, x) as .nrrd, .npy, .raw, .mha, .h5, .vti, .nii, .nii.gz or .tif; origin is (x, y, z).

    Parameters
    ----------
    spacing, origin, direction, unit, value_unit
        As :func:`isoatlas.open`.
    space : str, optional
        What the physical axes mean: "LPS", "RAS", ...
    """
    _arrays.volume_of(array, spacing, origin, direction, unit, value_unit, space).write(os.fspath(path))


def _labels_of(labels: Any, spacing: Spacing) -> _core.Volume:
    if _arrays.is_path(labels):
        return _core.read_volume(os.fspath(labels), reading_options(spacing=spacing), None, None, call())
    return _arrays.volume_of(labels, spacing, None, None, None, "", None)


def label_regions(labels: Any, *, spacing: Spacing = None, interpolant: str = "trilinear", progress: Progress = None,
                  threads: int = 0) -> Columns:
    """What each label of a label volume is, as ``isoatlas objects`` lists them: 0 is background.

    Parameters
    ----------
    labels : array (z, y, x) or path
        Whole numbers of at least 0.
    spacing : sequence of float, optional
        Of the samples along the array's axes.

    Returns
    -------
    Columns
        ``label``, ``voxels``, ``measure`` (volume; 2D: area), ``components``, ``tunnels``, ``cavities`` (n,); ``box_low``, ``box_high``
        (n, 3): inclusive bounds in voxels, ``position`` (n, 3): mean in physical units, all (x, y, z).
    """
    return Columns(_core.label_regions(_labels_of(labels, spacing), interpolant, call(progress, threads)))


def label_surface(labels: Any, label: int, *, spacing: Spacing = None, interpolant: str = "trilinear", boundary: str = "closed",
                  normals: bool = True, progress: Progress = None, threads: int = 0) -> Mesh:
    """The surface around one label of a label volume, half-way to its neighbours: a closed mesh, points (x, y, z).

    Parameters
    ----------
    labels, spacing
        As :func:`label_regions`.
    boundary, normals
        As :meth:`Atlas.surface`.

    Raises
    ------
    NotFoundError
        No sample has this label.
    """
    return Mesh(_core.label_surface(_labels_of(labels, spacing), int(label), interpolant, boundary, normals, call(progress, threads)))


def verify(what: Any, *, strict: bool = True, **options: Any) -> tuple[Check, ...]:
    """Checks the guarantees of a mesh (a file or a Mesh), a volume or a store, as ``isoatlas verify``.

    Raises
    ------
    VerificationError
        One does not hold, unless strict is False.
    """
    if _arrays.is_path(what) and os.fspath(what).lower().endswith((".ply", ".stl", ".obj", ".vtp", ".glb", ".vtkhdf")):
        what = read_mesh(what)
    if isinstance(what, Mesh):
        return what.verify(strict=strict)
    return _atlas_of(what).verify(strict=strict, **options)


def save_meshes(path: Path, meshes: Any, *, names: Any = None, colours: Any = None, space: str = "lps") -> list[str]:
    """Writes several meshes to one .glb, .obj, .ply, .stl, .vtp or .vtkhdf: each with its name and colour where the format has them."""
    from ._pictures import colour_of
    meshes = list(meshes)
    names = list(names) if names is not None else [f"object {i + 1}" for i in range(len(meshes))]
    colours = list(colours) if colours is not None else [colour_of(i + 1) for i in range(len(meshes))]
    parts = [(mesh._surface, name, list(colour)) for mesh, name, colour in zip(meshes, names, colours)]
    return _core.write_surfaces(os.fspath(path), parts, space)


__all__ = ["betti", "euler_number", "info", "label", "label_regions", "label_surface", "marching_cubes", "phantom", "phantoms", "read", "save_meshes", "verify",
           "write"]
