"""What many calls take: threads and progress; blocks of cells."""
from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any, Callable, Optional, Union

from . import _core
from .errors import InputError, raised

#: None or False: nothing is shown; True: a bar of tqdm, or a line; else called with the phase and the part of the whole, 0 to 1.
Progress = Union[None, bool, Callable[[str, float], object]]


class _Bar:
    """A bar of tqdm where it is installed, else one line on the standard error output."""

    def __init__(self) -> None:
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm
            self._bar = tqdm(total=100, unit="%", leave=False, bar_format="{desc} {percentage:3.0f} %|{bar}| {elapsed}")
        except ImportError:
            pass

    def __call__(self, phase: str, part: float) -> None:
        percent = min(100.0, 100 * part)
        if self._bar is None:
            print(f"\r{phase[:30]:<30} {percent:3.0f} %", end="\n" if percent >= 100 else "", file=sys.stderr, flush=True)
            return
        self._bar.set_description_str(phase)
        self._bar.update(percent - self._bar.n)
        if percent >= 100:
            self._bar.close()


def call(progress: Progress = None, threads: int = 0) -> _core.Call:
    """The settings of one long call."""
    if progress is True:
        progress = _Bar()
    return _core.Call(threads, progress or None)


#: How large blocks of cells may be that are drawn as one piece; their greatest distance; from where they are seen, and in how many pixels.
Blocks = tuple[int, Optional[float], Optional[tuple[float, float, float]], float]
NO_BLOCKS: Blocks = (0, None, None, 1.0)


def blocks_of(octree: int, octree_error: Optional[float], eye: Optional[Sequence[float]], pixels: float) -> Blocks:
    """The options of ``surface()`` of these names."""
    place = None
    if eye is not None:
        numbers = [float(x) for x in eye]
        if len(numbers) != 3:
            raise raised(InputError, f"eye has {len(numbers)} numbers", expected="three: x, y, z")
        place = numbers[0], numbers[1], numbers[2]
    return int(octree), None if octree_error is None else float(octree_error), place, float(pixels)
