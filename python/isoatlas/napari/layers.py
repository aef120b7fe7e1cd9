"""Layers of napari as it takes them: data, options, kind. All of a volume lie in the samples of its image, (z, y, x), and share its place."""
from __future__ import annotations

import importlib.util
from typing import Any, Mapping, Sequence

import numpy as np

from .._atlas import Atlas
from .._mesh import Array
from .._objects import Object

Layer = tuple[Any, dict[str, Any], str]
PLACE = ("scale", "translate", "rotate", "shear", "affine")  #: options that say where the samples of a layer lie


def place_of(info: Mapping[str, Any]) -> dict[str, Any]:
    """Where the samples of a volume lie: from (z, y, x) in samples to (z, y, x) in physical units."""
    rank = int(info["rank"])
    matrix = np.asarray(info["direction"])[:rank, :rank] * np.asarray(info["spacing"])[:rank]  # of (x, y, z)
    affine = np.eye(rank + 1)
    affine[:rank, :rank] = matrix[::-1, ::-1]
    affine[:rank, rank] = np.asarray(info["origin"])[:rank][::-1]
    return {"affine": affine}


def place_of_layer(layer: Any) -> dict[str, Any]:
    """The same of a layer that is shown, whoever made it."""
    return {name: getattr(layer, name) for name in PLACE if hasattr(layer, name)}


def in_samples(points: Array, info: Mapping[str, Any]) -> Array:
    """Points (x, y, z) in physical units as (z, y, x) in samples."""
    matrix = np.asarray(info["direction"]) * np.asarray(info["spacing"])
    found: Array = np.linalg.solve(matrix, (points - np.asarray(info["origin"])).T).T
    return found[:, ::-1]


def _colour(one: Object) -> list[float]:
    return [channel / 255 for channel in one.colour] + [1.0]


def name_of(one: Object) -> str:
    return f"{'cavity' if one.is_cavity else 'object'} {one.number}"


def image(atlas: Atlas, name: str) -> Layer:
    """The volume. Its atlas goes with it, so that the objects of the image are those of the store it came from."""
    options = {"name": name, "metadata": {"isoatlas": atlas}, **place_of(atlas.info)}
    return atlas.volume, options, "image"


def surface(one: Object, tau: float, info: Mapping[str, Any], place: Mapping[str, Any]) -> Layer:
    """The surface of an object at an isovalue, in its colour.

    Raises
    ------
    NotFoundError
        It does not exist at this isovalue.
    """
    mesh = one.surface(tau, normals=False)
    colours = {"colors": [_colour(one), _colour(one)], "name": f"isoatlas {name_of(one)}"}
    options = {"name": name_of(one), "colormap": colours, "contrast_limits": (0.0, 1.0), "metadata": {"isovalue": mesh.tau}, **place}
    return (in_samples(mesh.points, info), mesh.triangles, np.ones(len(mesh.points), dtype=np.float32)), options, "surface"


def labels(atlas: Atlas, chosen: Sequence[Object], place: Mapping[str, Any]) -> Layer:
    """Objects as labels, each at its own best isovalue; a table of them as features."""
    data = atlas.labels(objects=list(chosen))
    numbers = [label for label, _ in atlas._labelled(0, list(chosen))]
    features = {"index": [0, *numbers], "object": ["", *map(name_of, chosen)],
                "isovalue": [float("nan"), *(one.best_tau for one in chosen)], "voxels": [0, *(one.voxels for one in chosen)]}
    options: dict[str, Any] = {"name": "objects", "features": features, **place}
    if importlib.util.find_spec("napari") is not None:
        from napari.utils.colormaps import DirectLabelColormap
        colours: dict[Any, Any] = {None: [0.0] * 4, 0: [0.0] * 4}
        options["colormap"] = DirectLabelColormap(color_dict=colours | {n: _colour(one) for n, one in zip(numbers, chosen)})
    return data, options, "labels"
