"""How far a call has come."""
from __future__ import annotations

import time
from typing import Any, Callable, Mapping, NamedTuple, Protocol

from ._errors import Error
from ._shapes import number_of


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
        """Advances the bar by n."""


class TimeIsUp(Exception):
    """Raised when the time limit has ended a call."""


class Teller:
    """The progress function for the library."""

    def __init__(self, progress: Callable[[Progress], object] | Bar | None, time_limit: float | None) -> None:
        self._progress: Any = progress
        self._is_bar = hasattr(progress, "update")
        self.time_limit = time_limit
        self._begin = time.monotonic()

    def __call__(self, stage: str, fraction: float, iteration: int, residual: float) -> None:
        if self.time_limit is not None and time.monotonic() - self._begin > self.time_limit:
            raise TimeIsUp
        if self._progress is None:
            return
        if self._is_bar:
            self._progress.update(fraction * self._progress.total - self._progress.n)
        else:
            self._progress(Progress(stage, fraction, iteration, residual))

    def done(self) -> None:
        """Fills a bar, which gets no update at the very end."""
        if self._is_bar:
            self._progress.update(self._progress.total - self._progress.n)


def teller(options: Mapping[str, Any]) -> Teller | None:
    progress, limit = options.get("progress"), options.get("time_limit")
    if limit is not None and not number_of(limit, "time_limit") > 0:
        raise Error("invalid-argument", f"time_limit: seconds, more than 0, not {limit!r}")
    return None if progress is None and limit is None else Teller(progress, limit)
