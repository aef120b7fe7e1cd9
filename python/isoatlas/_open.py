"""Opening volumes and building stores."""
from __future__ import annotations

import os
import re
import tempfile
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _arrays, _core
from ._arrays import Spacing
from ._atlas import Atlas
from ._calls import Progress, call
from ._mesh import Array, Path
from .errors import InputError, UnsupportedError, raised

Memory = Union[None, int, str]


def bytes_of(memory: Memory) -> int:
    """A size like "4G" (factors of 1024) as a number of bytes; None: 0."""
    if memory is None:
        return 0
    found = re.fullmatch(r"\s*([0-9.]+)\s*([kmgt]?)(i?b)?\s*", str(memory).lower())
    size = int(float(found[1]) * 1024 ** " kmgt".index(found[2] or " ")) if found and found[1].count(".") < 2 else 0
    if size < _core.min_memory():
        raise raised(InputError, f"memory cannot be {memory!r}", expected="a size of at least 80M, such as '500M' or '2G'",
                     next="give more, or leave it out")
    return size


def reading_options(*, spacing: Spacing = None, origin: Any = None, unit: Optional[str] = None, value_unit: Optional[str] = None,
                    dims: Any = None, type: Any = None, endian: Optional[str] = None, skip: Optional[int] = None,
                    skip_rest: bool = False, follow_links: bool = False, time_step: Optional[int] = None,
                    channel: Union[None, str, int] = None, series: Union[None, str, int] = None, level: Optional[int] = None) -> dict[str, Any]:
    """What the reader of a volume file takes."""
    if endian not in (None, "little", "big"):
        raise raised(InputError, f"endian cannot be {endian!r}", expected="'little', 'big'", next="use one of them")
    return {"spacing": _arrays.spacing_of(spacing), "origin": None if origin is None else _arrays.numbers_of("origin", origin, (3,)),
            "unit": unit, "value_unit": value_unit, "dims": None if dims is None else [int(n) for n in dims][::-1],
            "type": None if type is None else np.dtype(type).name, "big_endian": None if endian is None else endian == "big",
            "skip_bytes": skip, "skip_rest": skip_rest, "follow_links": follow_links, "time_step": time_step,
            "channel": None if channel is None else str(channel), "series": None if series is None else str(series), "level": level}


def _box_of(box: Any, shape: Sequence[int]) -> Optional[list[list[int]]]:
    """Slices in the order of the array's axes as [begin, end] of x, y, z."""
    if box is None:
        return None
    ends = [one.indices(size)[:2] if isinstance(one, slice) else tuple(one) for one, size in zip(box, shape)]
    if len(ends) != len(shape):
        raise raised(InputError, f"box has {len(ends)} axes", expected=f"{len(shape)} slices, such as numpy.s_[0:20, 30:50, 10:30]",
                     next="give one for each axis")
    ends = ends[::-1] + [(0, 1)] * (3 - len(shape))
    return [[int(begin) for begin, _ in ends], [int(end) for _, end in ends]]


def open(source: Any, *, spacing: Spacing = None, origin: Any = None, direction: Any = None, unit: Optional[str] = None,
         value_unit: Optional[str] = None, dims: Any = None, type: Any = None, endian: Optional[str] = None, skip: Optional[int] = None,
         skip_rest: bool = False, follow_links: bool = False, time_step: Optional[int] = None, channel: Union[None, str, int] = None,
         series: Union[None, str, int] = None, level: Optional[int] = None, missing: Union[None, str, float] = None,
         no_data: Optional[float] = None, box: Any = None, gaussian: float = 0.0, polarity: Optional[str] = None,
         interpolant: str = "trilinear", tunnel_height: float = 0.0, memory: Memory = None, store: Optional[Path] = None,
         progress: Progress = None, threads: int = 0) -> Atlas:
    """Opens a volume for all isovalues: arrays are (z, y, x), points are (x, y, z) in physical units.

    Parameters
    ----------
    source : path, ndarray, or what behaves like one
        A volume file, a store (``.atlas``), an array with axes (z, y, x) or (y, x): also a memmap, a zarr, dask or h5py array, an
        ``xarray.DataArray``. C-contiguous arrays in host byte order of 8, 16 or 32 bit integers, float32 or float64 are used where they
        are and must not be changed while the atlas lives; others are copied.
    spacing : float or sequence of float, optional
        Distance of samples in the order of the array's axes, (z, y, x); of a file: instead of what its header says.
    origin : (float, float, float), optional
        Of sample 0, (x, y, z).
    direction : (3, 3) array, optional
        Columns: unit vectors along the axes x, y, z of the array. Arrays only.
    unit, value_unit : str, optional
        Of lengths ("mm", "um") and of samples.
    dims, type, endian, skip, skip_rest, follow_links
        Of the reader of files, as the options of the command line; dims are (z, y, x).
    time_step, channel, series, level : optional
        Which volume of a file that holds several: a number, of channels, DICOM series and images of an OME-TIFF (series) also a
        name. An array of many in one file is named behind it, ``"file.h5:/entry/data"``. Without a choice the error lists what there is.
    missing : {"below", "above"} or float, optional
        What becomes of NaN and infinite samples, and of those equal to no_data; without it they are an error.
    no_data : float, optional
    box : sequence of slice, optional
        Part of the volume, in the order of the array's axes.
    gaussian : float
        Filters first: sigma in the unit of the spacing; 0: off.
    polarity : {"high", "low"}, optional
        Objects of high values (default), or of low ones.
    interpolant : {"trilinear", "faces"}
        How samples are connected inside cells.
    tunnel_height : float
        Tunnels of at most this height are left out; calibrated.
    memory : int or str, optional
        Builds a store within this memory ("4G"), for volumes that are larger. Without it the volume is in memory.
    store : path, optional
        Where that store is kept; else it is a temporary file that ends with the atlas.
    progress : bool or callable, optional
        True: a bar (tqdm where it is installed); a function: called with the phase and the part, 0 to 1.
    threads : int
        0: all processors. Results are the same bytes for any number.

    Returns
    -------
    Atlas
        Nothing is analysed until it is asked for, except where a store is built.

    Raises
    ------
    InputError
        The file is missing or damaged, an argument means nothing, samples are missing.
    UnsupportedError
        A type of samples or a format that is not read.
    ResourceError
        Not enough memory or disk.
    """
    made = {name: value for name, value in locals().items() if name not in ("source", "progress", "threads")}
    own = call(progress, threads)
    is_file = _arrays.is_path(source)
    if is_file:
        reading = reading_options(spacing=spacing, origin=origin, unit=unit, value_unit=value_unit, dims=dims, type=type, endian=endian,
                                  skip=skip, skip_rest=skip_rest, follow_links=follow_links, time_step=time_step, channel=channel, series=series,
                                  level=level)
        if direction is not None:
            raise raised(InputError, "direction is for arrays; files have theirs", next="leave it out")
        path = os.fspath(source)
        if _core.is_store(path):
            found = _core.Source.of_store(path, polarity, reading)
            _check_store_options(found, interpolant, tunnel_height, gaussian, box, missing)
            return Atlas(found, (path, made))
    else:
        if any(value is not None for value in (dims, type, endian, skip, time_step, channel, series, level)):
            raise raised(InputError, "dims, type, endian, skip, time_step, channel, series and level are for files", next="leave them out")
        source, hints = _arrays.from_xarray(source)
        spacing, origin = hints.get("spacing", spacing) if spacing is None else spacing, hints.get("origin") if origin is None else origin
        value_unit = hints.get("value_unit") if value_unit is None else value_unit
    if memory is not None or store is not None:
        if box is not None:
            raise raised(UnsupportedError, "a store is of the whole volume", next="slice the array, or leave out memory= and store=")
        folder = None if store is not None else tempfile.TemporaryDirectory(prefix="isoatlas-")
        where = os.path.join(folder.name, "volume.atlas") if folder is not None else os.fspath(store or "")
        build(source, where, spacing=spacing, origin=origin, direction=direction, unit=unit, value_unit=value_unit, dims=dims, type=type,
              endian=endian, skip=skip, skip_rest=skip_rest, follow_links=follow_links, time_step=time_step, channel=channel,
              series=series, level=level, missing=missing,
              no_data=no_data, gaussian=gaussian, polarity=polarity or "high", interpolant=interpolant, tunnel_height=tunnel_height,
              memory=memory, progress=progress, threads=threads)
        return Atlas(_core.Source.of_store(where, None, {}), (source, made) if folder else (where, {}), folder)
    if is_file:
        volume = _core.read_volume(path, reading, missing, no_data, own)
    else:
        volume = _arrays.volume_of(source, spacing, origin, direction, unit, value_unit or "")
        volume.complete(missing, no_data, own)
    found_box = _box_of(box, volume.samples.shape)
    if found_box is not None or gaussian:
        volume = volume.shaped(found_box, gaussian, own)
    if polarity == "low":
        volume = volume.negated()
    elif polarity not in (None, "high"):
        raise raised(InputError, f"polarity cannot be {polarity!r}", expected="'high', 'low'", next="use one of them")
    height = tunnel_height / abs(volume.info["slope"])
    return Atlas(_core.Source.of_volume(volume, interpolant, height), (source, made))


def _check_store_options(source: _core.Source, interpolant: str, tunnel_height: float, gaussian: float, box: Any, missing: Any) -> None:
    """What is fixed when a store is built."""
    given = {"interpolant": interpolant != "trilinear" and interpolant != source.interpolant, "tunnel_height": tunnel_height != 0,
             "gaussian": gaussian not in (0, source.info["gaussian"]), "box": box is not None, "missing": missing is not None}
    for name, contradicts in given.items():
        if contradicts:
            raise raised(InputError, f"{name} contradicts the store, which is built", file=source.info["path"],
                         next=f"leave {name} out, or build another store from the volume")


def build(source: Any, path: Path, *, spacing: Spacing = None, origin: Any = None, direction: Any = None, unit: Optional[str] = None,
          value_unit: Optional[str] = None, dims: Any = None, type: Any = None, endian: Optional[str] = None, skip: Optional[int] = None,
          skip_rest: bool = False, follow_links: bool = False, time_step: Optional[int] = None, channel: Union[None, str, int] = None,
         series: Union[None, str, int] = None, level: Optional[int] = None, missing: Union[None, str, float] = None,
          no_data: Optional[float] = None, gaussian: float = 0.0, polarity: str = "high", interpolant: str = "trilinear",
          tunnel_height: float = 0.0, memory: Memory = None, restart: bool = False, progress: Progress = None,
          threads: int = 0) -> dict[str, Any]:
    """Analyses a volume of any size and writes a store, as ``isoatlas build``: arrays are (z, y, x), origin is (x, y, z).

    Parameters
    ----------
    source
        As :func:`open`. zarr, dask and h5py arrays and memmaps are read slab by slab, and may be larger than memory.
    path : path
        Of the store; it appears when it is complete. An interrupted build resumes with the same call.
    polarity : {"high", "low", "both"}
    memory : int or str, optional
        The process stays within it; default: half of what the machine has.
    restart : bool
        Discards what an interrupted build has finished.

    Returns
    -------
    dict
        ``bytes`` of the store, ``peak_memory`` of the process, ``resumed`` phases.

    Raises
    ------
    ResourceError
        The memory or the disk is too small.
    """
    options = {"interpolant": interpolant, "tunnel_height": float(tunnel_height), "gaussian": float(gaussian), "memory": bytes_of(memory),
               "polarity": polarity, "restart": restart}
    own = call(progress, threads)
    if _arrays.is_path(source):
        reading = reading_options(spacing=spacing, origin=origin, unit=unit, value_unit=value_unit, dims=dims, type=type, endian=endian,
                                  skip=skip, skip_rest=skip_rest, follow_links=follow_links, time_step=time_step, channel=channel, series=series,
                                  level=level)
        return _core.build_from_file(os.fspath(path), os.fspath(source), reading, options, missing, no_data, own)
    if _arrays.is_lazy(source) and len(source.shape) == 3:
        dtype = np.dtype(source.dtype).newbyteorder("=")
        if dtype.str[1:] not in _arrays.TYPES:
            raise raised(UnsupportedError, f"samples of type {dtype} are not read slab by slab",
                         expected="integers of 8, 16 or 32 bits, float32 or float64", next="convert the array")
        if 0 in source.shape:
            raise raised(InputError, "the array is empty", expected="at least one sample", next="check how it was made")
        about = _arrays.geometry(spacing, origin, direction, unit, 3)

        def read(begin: int, end: int) -> Array:
            return np.ascontiguousarray(np.asarray(source[begin:end]), dtype=dtype)

        return _core.build_from_slabs(os.fspath(path), list(source.shape), dtype, read, about, value_unit or "", options, missing, no_data,
                                      own)
    volume = _arrays.volume_of(source, spacing, origin, direction, unit, value_unit or "")
    return _core.build_from_volume(os.fspath(path), volume, options, missing, no_data, own)
