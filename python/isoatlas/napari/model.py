"""What the dock widget does, without a window: the objects of an image, and their layers in a viewer."""
from __future__ import annotations

import threading
from typing import Any, Callable, Generic, Optional, Sequence, TypeVar

import numpy as np

from .. import _arrays
from .._atlas import Atlas
from .._objects import Object
from .._open import open as open_atlas
from ..errors import InputError, raised
from . import layers

T = TypeVar("T")


class Cancelled(Exception):
    """Raised inside a job that was asked to end."""


class Job(Generic[T]):
    """A long call beside the window: ``work(progress)`` in a thread of its own. ``done`` after its end, then ``result()``."""

    def __init__(self, work: Callable[[Callable[[str, float], None]], T]) -> None:
        self.phase, self.part = "", 0.0
        self._cancelled = threading.Event()
        self._found: Optional[T] = None
        self._error: Optional[BaseException] = None
        self._work = work
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        try:
            self._found = self._work(self._tell)
        except BaseException as error:  # noqa: BLE001, told by result()
            self._error = error

    def _tell(self, phase: str, part: float) -> None:
        self.phase, self.part = phase, part
        if self._cancelled.is_set():
            raise Cancelled

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    def cancel(self) -> None:
        """It ends at its next look."""
        self._cancelled.set()

    def wait(self) -> None:
        self._thread.join()

    def result(self) -> T:
        """What it found; what it raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._found  # type: ignore[return-value]


class Model:
    """Objects of the image that is looked at. viewer: has ``layers``, ``add_labels``, ``add_surface`` as napari's."""

    def __init__(self, viewer: Any) -> None:
        self.viewer = viewer
        self.atlas: Optional[Atlas] = None
        self.objects: Sequence[Object] = ()
        self._place: dict[str, Any] = {}
        self._surfaces: dict[int, Any] = {}  # by number of object

    def images(self) -> list[Any]:
        """Layers that objects can be sought in."""
        return [layer for layer in self.viewer.layers if type(layer).__name__ == "Image" and not getattr(layer, "rgb", False)
                and getattr(layer.data, "ndim", 0) in (2, 3)]

    def seek(self, layer: Any, polarity: str = "high") -> Job[Atlas]:
        """Starts looking for the objects of an image; give what it finds to take()."""
        known = getattr(layer, "metadata", {}).get("isoatlas")
        if known is not None and known.polarity == polarity:
            atlas = known
        else:
            data = layer.data if _arrays.is_lazy(layer.data) else np.asarray(layer.data)
            atlas = open_atlas(data, spacing=tuple(float(one) for one in layer.scale), polarity=polarity, missing="below")

        def work(progress: Callable[[str, float], None]) -> Atlas:
            atlas._objects = atlas.find_objects(progress=progress)
            return atlas

        self._place = layers.place_of_layer(layer)
        return Job(work)

    def take(self, atlas: Atlas) -> None:
        """Shows these objects from now on."""
        self.atlas, self.objects, self._surfaces = atlas, atlas.objects, {}

    def _own(self) -> Atlas:
        if self.atlas is None:
            raise raised(InputError, "no image was searched yet", next="choose an image and press Find objects")
        return self.atlas

    def or_all(self, chosen: Sequence[Object]) -> Sequence[Object]:
        """What is chosen; nothing: all but the background."""
        return chosen or [one for one in self.objects if not one.background]

    def show_surface(self, one: Object, tau: Optional[float] = None) -> Any:
        """The surface of an object as a layer; the layer that shows it already is changed. tau: default its best isovalue."""
        data, options, _ = layers.surface(one, one.best_tau if tau is None else tau, self._own().info, self._place)
        shown = self._surfaces.get(one.number)
        if shown is not None and shown in self.viewer.layers:
            shown.data = data
            shown.metadata = options["metadata"]
        else:
            shown = self._surfaces[one.number] = self.viewer.add_surface(data, **options)
        return shown

    def show_labels(self, chosen: Sequence[Object]) -> Any:
        """Objects as one layer of labels, each at its best isovalue."""
        data, options, _ = layers.labels(self._own(), self.or_all(chosen), self._place)
        return self.viewer.add_labels(data, **options)

    def isovalues(self, one: Object) -> tuple[float, float]:
        """Lowest and highest isovalue at which an object can be shown: where it is on its own."""
        low, high = self._own().range
        ends = [end if np.isfinite(end) else low for end in (one.merges, one.appears)]
        return max(low, min(ends)), min(high, max(ends))
