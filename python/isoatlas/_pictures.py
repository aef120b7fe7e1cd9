"""Pictures and measures: with the module of C++ that links Embree."""
from __future__ import annotations

import os
from typing import Any, Iterable, Optional, Sequence, Union

from . import _core, _render
from ._calls import Progress, call
from ._mesh import Array, Mesh, Path
from .errors import InputError, raised

_VIEWS = {"front": (0, 0), "right": (90, 0), "back": (180, 0), "left": (270, 0), "top": (0, 90), "bottom": (0, -90)}
_AXES = {"x": 0, "y": 1, "z": 2}


def colour_of(number: int, is_cavity: bool = False) -> tuple[int, int, int]:
    """Red, green, blue of an object or a cavity by its number, as on the page and in the viewer."""
    red, green, blue = _render.colour_of(number, is_cavity)
    return red, green, blue


def measures(source: _core.Source, tau: float, objects: Sequence[int], thickness: bool) -> list[dict[str, Any]]:
    return _render.measures(source, tau, [int(i) for i in objects], thickness, call())


def render(meshes: Union[Mesh, Iterable[Mesh]] = (), *, colours: Optional[Sequence[Any]] = None, opacities: Optional[Sequence[float]] = None,
           names: Optional[Sequence[str]] = None, volume: Any = None, draws_volume: Optional[bool] = None, slices: Any = None,
           view: Union[str, Sequence[float]] = "auto", up: Sequence[float] = (0, 0, 1), size: Union[int, tuple[int, int]] = 768,
           projection: str = "orthographic", background: str = "light", samples: int = 4, shading: bool = True, scale_bar: bool = False,
           legend: bool = False, caption: Sequence[str] = (), progress: Progress = None, threads: int = 0) -> Array:
    """A picture of meshes, drawn without a display: (height, width, 4) uint8, the same bytes for any number of threads.

    Parameters
    ----------
    meshes : Mesh or iterable of Mesh
    colours : sequence of (red, green, blue), optional
        0 to 255; default: those of objects 1, 2, ...
    opacities : sequence of float, optional
        Above 0 and at most 1.
    names : sequence of str, optional
        For the legend.
    volume : Atlas, optional
        Drawn itself by emission and absorption, or cut by slices.
    draws_volume : bool, optional
        Default: with a volume and without slices.
    slices : dict, optional
        Of the volume: ``{"z": 40}``.
    view : {"auto", "front", "right", "back", "left", "top", "bottom"} or (around, above)
        Angles in degrees; auto: where most of the meshes is seen.
    up : (float, float, float)
        What is upwards in the picture, (x, y, z).
    size : int or (int, int)
        Width and height in pixels, 1 to 16384.
    projection : {"orthographic", "perspective"}
    background : {"light", "dark", "transparent"}
    samples : int
        Per pixel, 1 to 256.
    """
    drawn = [meshes] if isinstance(meshes, Mesh) else list(meshes)
    count = len(drawn)
    given = {"colours": colours, "opacities": opacities, "names": names}
    for name, one in given.items():
        if one is not None and len(one) != count:
            raise raised(InputError, f"{name} has {len(one)} elements for {count} meshes", expected="one for each", next="correct it")
    tints = list(colours) if colours is not None else [colour_of(i + 1) for i in range(count)]
    parts = [(mesh._surface, [int(c) for c in tint], float(opacity), name) for mesh, tint, opacity, name in
             zip(drawn, tints, opacities or [1.0] * count, names or [""] * count)]
    if isinstance(view, str) and view != "auto" and view not in _VIEWS:
        raise raised(InputError, f"view cannot be {view!r}", expected=", ".join(map(repr, ("auto", *_VIEWS))) + ", or two angles in degrees",
                     next="use one of them")
    angles: Any = _VIEWS.get(view) if isinstance(view, str) else tuple(view)
    cuts = [(_AXES[axis], int(index)) for axis, index in (slices or {}).items()]
    width, height = (size, size) if isinstance(size, int) else size
    options = {"width": width, "height": height, "projection": projection, "background": background, "samples": samples, "shading": shading,
               "scale_bar": scale_bar, "legend": legend, "caption": list(caption)}
    whole = draws_volume if draws_volume is not None else volume is not None and not cuts
    if count == 0 and not cuts and angles is None:
        angles = (30, 20)  # the best view is one of surfaces
    return _render.render(parts, None if volume is None else volume._source, whole, cuts, angles, [float(u) for u in up], options,
                          call(progress, threads))


def save_image(path: Path, image: Array) -> None:
    """Writes a picture (height, width, 4) uint8 as .png or .webp."""
    _render.write_image(os.fspath(path), image)


def save_animation(path: Path, frames: Iterable[Array], *, frames_per_second: float = 12.0) -> None:
    """Writes pictures of one size as .gif, .png (APNG), .apng or .webp."""
    _render.write_animation(os.fspath(path), list(frames), frames_per_second)
