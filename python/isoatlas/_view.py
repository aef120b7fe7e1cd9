"""The navigator beside a notebook: a server on this machine, and a link to it."""
from __future__ import annotations

import atexit
import html
import importlib.util
import json
import os
import tempfile
import urllib.request
import weakref
from typing import TYPE_CHECKING, Any, Optional
from urllib.parse import urlsplit

from . import _serve
from .errors import InputError, NotFoundError, UnsupportedError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas


class View:
    """The viewer of ``isoatlas view`` for one atlas: its cell has a link that opens it in a browser tab.

    It listens on this machine alone. An atlas in memory is written to a temporary store first, which ends with the view.

    Parameters
    ----------
    atlas : Atlas
    port : int
        0: any that is free.

    Raises
    ------
    UnsupportedError
        isoatlas was built where npm was missing, and has no page to show.
    """

    def __init__(self, atlas: Atlas, *, port: int = 0) -> None:
        from ._open import build
        _serve.check_has_viewer()
        self._atlas = atlas
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        path = atlas.info["path"] if atlas.is_store else ""
        if not path:
            self._folder = tempfile.TemporaryDirectory(prefix="isoatlas-view-")
            path = os.path.join(self._folder.name, "volume.atlas")
            source, options = atlas._recipe
            if options.get("box") is not None:
                raise raised(UnsupportedError, "the viewer shows whole volumes", next="slice the array instead of box=")
            kept: dict[str, Any] = {name: value for name, value in options.items() if name not in ("box", "memory", "store")}
            kept["polarity"] = kept.get("polarity") or "high"
            build(source, path, **kept)
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
        """The answer of the server to a request of docs/server.md, such as ``/api/objects?tau=120``: a JSON document."""
        if not self._end.alive:
            raise raised(InputError, "the view is closed", next="atlas.view() opens another one")
        query = urllib.request.Request(self._viewer.address + path, headers={"Authorization": f"Bearer {self._viewer.token}"})
        with urllib.request.urlopen(query) as answer:
            return json.load(answer)

    def _link(self) -> str:
        """What the browser of the notebook can reach: the address, or where jupyter-server-proxy forwards it to."""
        address = self.address
        prefix = os.environ.get("JUPYTERHUB_SERVICE_PREFIX")
        if prefix is None:
            return address
        if importlib.util.find_spec("jupyter_server_proxy") is None:
            raise raised(NotFoundError, "the notebook runs on another machine than the browser",
                         next="install jupyter-server-proxy, or open view.address through a tunnel: ssh -L PORT:127.0.0.1:PORT")
        parts = urlsplit(address)
        return f"{prefix.rstrip('/')}/proxy/{parts.port}{parts.path}" + (f"?{parts.query}" if parts.query else "")

    def _repr_html_(self) -> str:
        if not self._end.alive:
            return "<p>isoatlas: the view is closed</p>"
        return f'<p><a href="{html.escape(self._link())}" target="_blank" rel="noopener">Open the navigator</a> (the link works once)</p>'

    def __repr__(self) -> str:
        return f"<isoatlas.View at {self._viewer.address}>" if self._end.alive else "<isoatlas.View: closed>"


def _close(viewer: _serve.Viewer, folder: Any) -> None:
    viewer.close()
    if folder is not None:
        folder.cleanup()
