"""The navigator in a cell of a notebook: a server on this machine, and a frame that shows its page."""
from __future__ import annotations

import atexit
import html
import json
import os
import re
import tempfile
import urllib.request
import weakref
from collections.abc import Sequence
from importlib import metadata
from typing import TYPE_CHECKING, Any, Mapping, Optional, Union
from urllib.parse import urlsplit

from . import _serve
from ._scenes import Scenes
from .errors import Error, InputError, NotFoundError, UnsupportedError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas, Reference

PROXY = (4, 3)  #: the first version of jupyter-server-proxy that passes on a stream of events


class View:
    """The viewer of ``isoatlas view`` for one atlas, in the cell that returns it, and a link that opens it in a browser tab.

    What the frame shows is read and set by ``scene``, ``tau`` and ``selected``, also from later cells; all frames of a view show the same.
    Tabs begin with it and go their own way. It listens on this machine alone. In JupyterHub the frame is reached through
    jupyter-server-proxy (4.3 or later). An atlas in memory is written to a temporary store first, which ends with the view.

    Parameters
    ----------
    atlas : Atlas
    height : int
        Of the frame, in pixels.
    port : int
        0: any that is free.

    Raises
    ------
    UnsupportedError
        isoatlas was built where npm was missing, and has no page to show.
    """

    def __init__(self, atlas: Atlas, *, height: int = 600, port: int = 0) -> None:
        from ._open import build
        _serve.check_has_viewer()
        self._atlas = atlas
        self._height = int(height)
        self._known: Optional[Scenes] = None
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
        return self._served.address_for_one_use()

    @property
    def scene(self) -> dict[str, Any]:
        """What the frame shows, a copy; assign a scene to show it (docs/scene.md: the dictionary of a scene file).

        Before a frame has been opened: the scene with which it will begin. What a person changes in the frame is here a moment later; whoever
        sets last wins.

        Raises
        ------
        InputError
            What is assigned is not a scene, or one of a volume of another size.
        """
        text = self._served.scene()
        scene: dict[str, Any] = json.loads(text) if text else self._scenes.first()
        return scene

    @scene.setter
    def scene(self, scene: Mapping[str, Any]) -> None:
        self._served.set_scene(json.dumps(dict(scene)))

    @property
    def tau(self) -> Optional[float]:
        """The isovalue of the selected object, calibrated; None: nothing is shown. Assign one to change it.

        Where nothing is shown, the whole isosurface is from then on.

        Raises
        ------
        NotFoundError
            What is assigned is outside the range of the samples.
        """
        scene = self.scene
        return float(scene["shown"][scene["selected"]]["tau"]) if scene["selected"] >= 0 else None

    @tau.setter
    def tau(self, tau: float) -> None:
        self.scene = self._scenes.with_tau(self.scene, tau)

    @property
    def selected(self) -> list[Union[int, str]]:
        """The objects in view as :meth:`Atlas.object` takes them, such as ``[3, "c2"]``, the one that ``tau`` is about first.

        Assign references, or objects of a table, to see these alone: those that were in view as they were, others at their best isovalue.
        The whole isosurface is no object and not listed.

        Raises
        ------
        NotFoundError
            There is no such object, or the navigator does not list it.
        """
        return self._scenes.references(self.scene)

    @selected.setter
    def selected(self, objects: Union[Reference, Sequence[Reference]]) -> None:
        self.scene = self._scenes.with_objects(self.scene, objects)

    def close(self) -> None:
        """Ends the server."""
        self._end()

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def request(self, path: str) -> Any:
        """The answer of the server to a request of docs/server.md, such as ``/api/objects?tau=120``: a JSON document."""
        query = urllib.request.Request(self._served.address + path, headers={"Authorization": f"Bearer {self._served.token}"})
        with urllib.request.urlopen(query) as answer:
            return json.load(answer)

    @property
    def _served(self) -> _serve.Viewer:
        if not self._end.alive:
            raise raised(InputError, "the view is closed", next="atlas.view() opens another one")
        return self._viewer

    @property
    def _scenes(self) -> Scenes:
        if self._known is None:
            self._known = Scenes(self.request, self._atlas)
        return self._known

    def _frame(self) -> str:
        """An address that shows the page once, as the browser of the notebook reaches it: in JupyterHub through a proxy."""
        address = self._served.address_for_one_frame()
        prefix = os.environ.get("JUPYTERHUB_SERVICE_PREFIX")
        if prefix is None:
            return address
        parts = urlsplit(address)
        if not _has_proxy():
            raise raised(NotFoundError, "the notebook runs on another machine than the browser",
                         next=f"install jupyter-server-proxy {PROXY[0]}.{PROXY[1]} or later, or open view.address through a tunnel: "
                              f"ssh -L {parts.port}:127.0.0.1:{parts.port}")
        return f"{prefix.rstrip('/')}/proxy/{parts.port}{parts.path}?{parts.query}"

    def _repr_html_(self) -> str:
        if not self._end.alive:
            return "<p>isoatlas: the view is closed</p>"
        try:
            frame = html.escape(self._frame())
            tab = html.escape(self._frame() if "JUPYTERHUB_SERVICE_PREFIX" in os.environ else self.address)
        except Error as error:
            return f"<p>isoatlas: {html.escape(str(error))}</p>"
        name = html.escape(os.path.basename(self._atlas.info["path"]) or "an array")
        size = " x ".join(map(str, self._atlas.shape))
        link = f'<a href="{tab}" target="_blank" rel="noopener">Open in a tab</a> (the link works once)'
        return (f'<iframe src="{frame}" title="isoatlas: {name}" allow="clipboard-write; fullscreen" '
                f'style="width: 100%; height: {self._height}px; border: 0"></iframe>'
                f'<p><small>The navigator of {name}, {size}, while this notebook runs. {link}{self._tunnel()}</small></p>')

    def _tunnel(self) -> str:
        """How to reach the frame from another machine, where that may be necessary."""
        if "SSH_CONNECTION" not in os.environ or "JUPYTERHUB_SERVICE_PREFIX" in os.environ:
            return ""
        port = urlsplit(self._viewer.address).port
        return f". Nothing to see on another machine? <code>ssh -L {port}:127.0.0.1:{port} MACHINE</code>, then run the cell again."

    def __repr__(self) -> str:
        return f"<isoatlas.View at {self._viewer.address}>" if self._end.alive else "<isoatlas.View: closed>"


def _has_proxy() -> bool:
    try:
        numbers = re.findall(r"[0-9]+", metadata.version("jupyter-server-proxy"))
    except metadata.PackageNotFoundError:
        return False
    return tuple(map(int, numbers[:2])) >= PROXY


def _close(viewer: _serve.Viewer, folder: Any) -> None:
    viewer.close()
    if folder is not None:
        folder.cleanup()
