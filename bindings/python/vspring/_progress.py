"""How far a call has come."""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Protocol


class Progress(NamedTuple):
    """How far a call has come."""

    stage: str
    """What is being done, in a word or two."""
    fraction: float
    """Of the whole call, 0 to 1, never falling."""
    iteration: int
    """Iterations done so far; 0 outside iterations."""
    residual: float
    """The figure that the stopping test compares; 0 outside iterations."""


class Bar(Protocol):
    """A bar such as tqdm's."""

    n: float
    total: float

    def update(self, n: float) -> object:
        """Adds n to what the bar shows."""


class Teller:
    """What the library calls."""

    def __init__(self, progress: Callable[[Progress], object] | Bar) -> None:
        self._progress: Any = progress
        self._is_bar = hasattr(progress, "update")

    def __call__(self, stage: str, fraction: float, iteration: int, residual: float) -> None:
        if self._is_bar:
            self._progress.update(fraction * self._progress.total - self._progress.n)
        else:
            self._progress(Progress(stage, fraction, iteration, residual))

    def done(self) -> None:
        """Fills a bar, which is not told of the very end."""
        if self._is_bar:
            self._progress.update(self._progress.total - self._progress.n)


def teller(progress: Callable[[Progress], object] | Bar | None) -> Teller | None:
    return None if progress is None else Teller(progress)
