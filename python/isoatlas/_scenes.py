"""Scenes of the navigator (docs/scene.md) in words of Python: which objects are shown, and at which isovalues."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Callable, Optional, Union

from ._objects import Object
from .errors import InputError, NotFoundError, raised

if TYPE_CHECKING:
    from ._atlas import Atlas, Reference

EVERYTHING = -1  #: the entry of a scene that is the whole isosurface
LISTED = 20000  #: objects that have an entry, as in the viewer


class Scenes:
    """What the entries of scenes are. An entry is a line of the page; an object of rank r that the page does not list follows its lines."""

    def __init__(self, ask: Callable[[str], Any], atlas: Atlas) -> None:
        self._ask = ask
        self._atlas = atlas
        self._page = ask("/api/atlas")
        self._lines: list[dict[str, Any]] = self._page["entries"]
        self._entry_of = {line["reference"]: i for i, line in enumerate(self._lines)}
        self._known: Optional[dict[str, list[Any]]] = None

    @property
    def _branches(self) -> dict[str, list[Any]]:
        if self._known is None:
            self._known = self._ask(f"/api/branches?top={LISTED}")
        return self._known

    def first(self) -> dict[str, Any]:
        """That of a page which opens without one: the first line that is more than the scanned field."""
        volume = self._page["volume"]
        first = next((i for i, line in enumerate(self._lines) if not line.get("background")), 0)
        shown = [_part(first, self._lines[first]["id"], self._lines[first]["tau"])] if self._lines else []
        return {"schema": "isoatlas/scene/1", "volume": {"name": volume["name"], "size": volume["size"]}, "shown": shown,
                "selected": len(shown) - 1, "view": None, "parts": {}}

    def with_tau(self, scene: dict[str, Any], tau: float) -> dict[str, Any]:
        """Another isovalue of the selected object; the whole isosurface, where nothing is shown."""
        axis, tau = self._page["axis"], float(tau)
        if not math.isfinite(tau):
            raise raised(InputError, "the isovalue is not finite", next="give a number")
        if not axis["low"] <= tau <= axis["high"]:
            raise raised(NotFoundError, f"the isovalue {tau:g} is outside the range of the samples", expected=f"{axis['low']:g} to {axis['high']:g}")
        shown = [dict(one) for one in scene["shown"]] or [_part(EVERYTHING, None, tau)]
        selected = max(scene["selected"], 0)
        shown[selected]["tau"] = tau
        return {**scene, "shown": shown, "selected": selected}

    def with_objects(self, scene: dict[str, Any], objects: Union[Reference, Sequence[Reference]]) -> dict[str, Any]:
        """Shows these and nothing else, fitted to the view, and selects the first one. What was shown before looks as it did."""
        given = [objects] if isinstance(objects, (Object, int, str)) else objects
        before = {one["entry"]: one for one in scene["shown"]}
        shown: dict[int, dict[str, Any]] = {}
        for reference in given:
            part = self._part_of(reference)
            shown.setdefault(part["entry"], {**before.get(part["entry"], part), "visible": True})
        view = scene["view"] if set(shown) == set(before) else None
        return {**scene, "shown": list(shown.values()), "selected": 0 if shown else -1, "view": view}

    def references(self, scene: dict[str, Any]) -> list[Union[int, str]]:
        """What is visible, the selected object first; without the whole isosurface."""
        shown, selected = list(scene["shown"]), scene["selected"]
        if selected > 0:
            shown.insert(0, shown.pop(selected))
        return [self._reference(one["entry"]) for one in shown if one["visible"] and one["entry"] != EVERYTHING]

    def _reference(self, entry: int) -> Union[int, str]:
        if entry < len(self._lines):
            word: str = self._lines[entry]["reference"]
            return int(word) if word.isdigit() else word
        rank = entry - len(self._lines)
        return self._branches["number"][rank] or f"v{self._branches['voxel'][rank]}"

    def _part_of(self, reference: Reference) -> dict[str, Any]:
        word = reference.reference if isinstance(reference, Object) else str(reference)
        if word not in self._entry_of and word[:1] == "v" and word[1:].isdigit() and int(word[1:]) in self._branches["voxel"]:
            return self._part_of_rank(self._branches["voxel"].index(int(word[1:])), None)
        if word not in self._entry_of:
            one = self._atlas.object(reference)
            word = one.reference
            if word not in self._entry_of and not one.is_cavity and one.number in self._branches["number"]:
                return self._part_of_rank(self._branches["number"].index(one.number), one.best_tau)
        if word not in self._entry_of:
            raise raised(NotFoundError, f"the navigator does not list {word}", expected=", ".join(self._entry_of) or "nothing is listed",
                         next="view.scene can show the whole isosurface: its entry is -1")
        entry = self._entry_of[word]
        return _part(entry, self._lines[entry]["id"], self._lines[entry]["tau"])

    def _part_of_rank(self, rank: int, tau: Optional[float]) -> dict[str, Any]:
        known = self._branches
        return _part(len(self._lines) + rank, known["voxel"][rank], known["tau"][rank] if tau is None else tau)


def _part(entry: int, voxel: Optional[int], tau: float) -> dict[str, Any]:
    return {"entry": entry, "id": voxel, "tau": tau, "opacity": 1, "visible": True, "colour": None, "walls": "all"}
