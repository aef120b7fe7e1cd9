"""The navigator in a notebook: a server on this machine, and an iframe."""
from __future__ import annotations

import atexit
import importlib.util
import json
import os
import tempfile
import urllib.request
import weakref
from typing import TYPE_CHECKING, Any, Optional
from urllib.parse import urlsplit

from . import _serve
from .errors import InputError, NotFoundError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas


class View:
    """The viewer of ``isoatlas view`` in a notebook cell, for one atlas.

    An atlas in memory is written to a temporary store first, which ends with the view.

    Parameters
    ----------
    atlas : Atlas
    height : int
        Of the cell, in pixels.
    port : int
        0: any that is free.

    Attributes
    ----------
    scene : dict
        What the page shows; can be set. See docs/scene.md.
    tau : float or None
        The isovalue of what is selected, else of the slider; can be set.
    selected : list
        The objects that are shown.
    """

    def __init__(self, atlas: Atlas, *, height: int = 700, port: int = 0) -> None:
        from ._atlas import build
        self._atlas, self._height = atlas, height
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        path = atlas.info["path"] if atlas.is_store else ""
        if not path:
            self._folder = tempfile.TemporaryDirectory(prefix="isoatlas-view-")
            path = os.path.join(self._folder.name, "volume.atlas")
            source, options = atlas._recipe
            kept = {name: value for name, value in options.items() if name not in ("box", "memory", "store")}
            build(source, path, **{**kept, "polarity": kept.get("polarity") or "high"})
        self._viewer = _serve.Viewer(os.path.abspath(path), port, False)
        self._end = weakref.finalize(self, _close, self._viewer, self._folder)
        atexit.register(self._end)

    @property
    def address(self) -> str:
        """A new address that opens the page in one browser, once, within ten minutes."""
        return self._viewer.address_for_one_use()

    def close(self) -> None:
        """Ends the server."""
        self._end()

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def request(self, path: str) -> Any:
        """The answer of the server to a request of docs/server.md, such as ``/api/objects``: a JSON document."""
        if not self._end.alive:
            raise raised(InputError, "the view is closed", next="atlas.view() opens another one")
        query = urllib.request.Request(self._viewer.address + path, headers={"Authorization": f"Bearer {self._viewer.token}"})
        with urllib.request.urlopen(query) as answer:
            return json.load(answer)

    def _frame_address(self) -> str:
        """What the browser of the notebook can reach: the address, or where jupyter-server-proxy forwards it to."""
        address = self.address
        prefix = os.environ.get("JUPYTERHUB_SERVICE_PREFIX")
        if prefix is None:
            return address
        if importlib.util.find_spec("jupyter_server_proxy") is None:
            raise raised(NotFoundError, "the notebook runs on another machine than the browser",
                         next="pip install jupyter-server-proxy, or open view.address through a tunnel: ssh -L PORT:127.0.0.1:PORT")
        parts = urlsplit(address)
        return f"{prefix.rstrip('/')}/proxy/{parts.port}{parts.path}" + (f"?{parts.query}" if parts.query else "")

    def _repr_html_(self) -> str:
        return f'<iframe src="{self._frame_address()}" width="100%" height="{self._height}" style="border:0" title="isoatlas"></iframe>'

    def __repr__(self) -> str:
        return f"<isoatlas.View at {self._viewer.address}>" if self._end.alive else "<isoatlas.View: closed>"


def _close(viewer: _serve.Viewer, folder: Any) -> None:
    viewer.close()
    if folder is not None:
        folder.cleanup()
