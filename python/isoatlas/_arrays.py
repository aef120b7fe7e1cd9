"""Arrays of numpy, and what behaves like them, become volumes: without a copy where that is possible."""
from __future__ import annotations

import numbers
import os
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _core
from .errors import InputError, UnsupportedError, raised

Spacing = Union[None, float, Sequence[float]]
TYPES = ("u1", "i1", "u2", "i2", "u4", "i4", "f4", "f8")


def is_path(source: object) -> bool:
    return isinstance(source, (str, os.PathLike))


def spacing_of(spacing: Spacing, rank: Optional[int] = None) -> Optional[list[float]]:
    """(x, y, z) of numbers in the order of the array's axes, or of one number."""
    if spacing is None:
        return None
    if isinstance(spacing, numbers.Real):
        return [float(spacing)] * 3
    values = numbers_of("spacing", spacing, (rank,) if rank else (2, 3))
    return values[::-1] + [1.0] * (3 - len(values))


def numbers_of(name: str, given: Any, lengths: tuple[int, ...]) -> list[float]:
    """Finite numbers, as many as that."""
    try:
        values = [float(value) for value in given]
    except (TypeError, ValueError):
        values = []
    if len(values) not in lengths or not np.all(np.isfinite(values)):
        many = " or ".join(str(length) for length in lengths)
        raise raised(InputError, f"{name} cannot be {given!r}", expected=f"{many} finite numbers",
                     next="give one for each axis of the array" if name == "spacing" else "correct it")
    return values


def geometry(spacing: Spacing, origin: Any, direction: Any, unit: Optional[str], rank: int, space: Optional[str] = None) -> dict[str, Any]:
    """What the constructor of _core.Volume takes."""
    result: dict[str, Any] = {"spacing": spacing_of(spacing, rank), "unit": unit, "space": space}
    if origin is not None:
        values = numbers_of("origin", origin, (2, 3))
        result["origin"] = values + [0.0] * (3 - len(values))
    if direction is not None:
        matrix = np.asarray(direction, dtype=float)
        if matrix.shape != (3, 3) or not np.isfinite(matrix).all():
            raise raised(InputError, "direction is no matrix of 3 x 3 finite numbers",
                         expected="columns: unit vectors along x, y and z of the array", next="correct it, or leave it out")
        result["direction"] = matrix.tolist()
    return result


def native(array: Any) -> np.ndarray[Any, Any]:
    """A C-contiguous array of one of the eight types in host byte order: the array itself where it is one, else a copy.

    bool is taken as uint8 (without a copy), float16 as float32, 64-bit integers as 32-bit ones where their values fit.
    """
    if isinstance(array, np.ma.MaskedArray):
        raise raised(UnsupportedError, "masked arrays are not read", next="array.filled(VALUE), and missing= for what VALUE stands for")
    array = np.asarray(array)
    if array.ndim not in (2, 3):
        raise raised(InputError, f"the array has {array.ndim} axes", expected="3 axes (z, y, x), or 2 axes (y, x)",
                     next="choose one volume of it, such as array[0]" if array.ndim > 3 else "reshape it")
    if array.size == 0:
        raise raised(InputError, "the array is empty", expected="at least one sample", next="check how it was made")
    if array.dtype == np.bool_:
        array = np.ascontiguousarray(array).view(np.uint8)
    elif array.dtype == np.float16:
        array = array.astype(np.float32)
    elif array.dtype.kind in "iu" and array.dtype.itemsize == 8:
        array = _narrowed(array)
    if array.dtype.newbyteorder("=").str[1:] not in TYPES:
        raise raised(UnsupportedError, f"samples of type {array.dtype} are not read",
                     expected="integers of 8, 16 or 32 bits, float32 or float64", next="array.astype(...) makes one of these")
    result: np.ndarray[Any, Any] = np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("="))
    return result if result.flags.aligned else result.copy()


def _narrowed(array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """64-bit integers as 32-bit ones."""
    low, high = int(array.min()), int(array.max())
    for dtype in (np.int32, np.uint32):
        if np.iinfo(dtype).min <= low and high <= np.iinfo(dtype).max:
            return array.astype(dtype)
    raise raised(UnsupportedError, f"64-bit integers from {low} to {high} do not fit in 32 bits",
                 expected="integers of 8, 16 or 32 bits, float32 or float64", next="array.astype(...) makes one of these")


def volume_of(array: Any, spacing: Spacing = None, origin: Any = None, direction: Any = None, unit: Optional[str] = None,
              value_unit: str = "", space: Optional[str] = None) -> _core.Volume:
    samples = native(array)
    return _core.Volume(samples, geometry(spacing, origin, direction, unit, samples.ndim, space), value_unit)


def is_lazy(source: Any) -> bool:
    """Is it an array that is read in pieces (zarr, dask, h5py), or a memmap?"""
    if isinstance(source, np.memmap):
        return True
    return not isinstance(source, np.ndarray) and all(hasattr(source, name) for name in ("shape", "dtype", "__getitem__"))


def from_xarray(source: Any) -> tuple[Any, dict[str, Any]]:
    """The data of an xarray.DataArray, with spacing and origin from its evenly spaced coordinates; others as they are."""
    if not (hasattr(source, "dims") and hasattr(source, "coords") and hasattr(source, "data")):
        return source, {}
    spacing, origin = [], []
    for dim in source.dims:
        values = np.asarray(source.coords[dim], dtype=float) if dim in source.coords else np.arange(2.0)
        step = float(values[1] - values[0]) if len(values) > 1 else 1.0
        if step <= 0 or not np.allclose(np.diff(values), step, rtol=1e-6, atol=0):
            raise raised(UnsupportedError, f"the coordinates along {dim} are not evenly spaced and ascending",
                         next="interpolate them, or pass array.data with spacing=")
        spacing.append(step)
        origin.append(float(values[0]))
    return source.data, {"spacing": tuple(spacing), "origin": tuple(origin[::-1]), "value_unit": str(source.attrs.get("units", ""))}
