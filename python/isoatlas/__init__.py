"""isoatlas: which objects are in a volume, and at which isovalues?

Arrays are (z, y, x); points are (x, y, z) in physical units. ::

    import isoatlas
    atlas = isoatlas.open("scan.nii.gz")        # a file, a store, an array with spacing=
    atlas.objects                               # the table, with the isovalue that shows each best
    mesh = atlas.objects[3].surface()           # closed; points, triangles and normals are arrays
    labels = atlas.labels(keep=24)              # each object at its own best isovalue
"""
from __future__ import annotations

from typing import Any

from . import _core
from ._atlas import Atlas
from ._functions import (betti, euler_number, info, label, label_regions, label_surface, marching_cubes, phantom, phantoms, read,
                         save_meshes, verify, write)
from ._mesh import Check, Mesh, read_mesh
from ._objects import Isovalue, Object, Table
from ._open import build, open
from ._tree import Columns, Handles, SimplifiedTree, Spectrum, Tree
from .errors import Error, InputError, InternalError, NotFoundError, ResourceError, UnsupportedError, VerificationError

__version__: str = _core.version

__all__ = ["Atlas", "Check", "Columns", "Error", "Handles", "InputError", "InternalError", "Isovalue", "Mesh", "NotFoundError", "Object",
           "ResourceError", "SimplifiedTree", "Spectrum", "Table", "Tree", "UnsupportedError", "VerificationError", "View", "betti", "build",
           "euler_number", "info", "label", "label_regions", "label_surface", "marching_cubes", "open", "phantom", "phantoms", "read",
           "read_mesh", "render", "save_animation", "save_image",
           "save_meshes", "verify", "write"]


def __getattr__(name: str) -> Any:
    """What draws needs a module of its own, with Embree: it is loaded when it is first used."""
    if name in ("render", "save_animation", "save_image"):
        from . import _pictures
        return getattr(_pictures, name)
    if name == "View":
        from ._view import View
        return View
    raise AttributeError(f"module 'isoatlas' has no attribute {name!r}")
