"""Sessions: one shape, faired again and again while its constraints move, as in an editor."""
from __future__ import annotations

import threading
from typing import Any, Callable, Sequence, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _vspring
from ._errors import Error
from ._fairing import ended
from ._holding import held_in
from ._options import SessionOptions, spelled_out
from ._progress import Bar, Progress, teller
from ._reports import Report, Result, report_of
from ._shapes import Closed, Faces, array_of, in_space, indices_of, number_of, shape_of, threads_of, whole_number_of

PICTURE = 2e-4
"""Of the size: a fifth of a pixel where that is a thousand of them."""


class Session:
    """Fairs one shape again and again while its constraints move. For surfaces it keeps levels, equations and their
    factors between calls, and each call starts from the last shape; curves are faired anew.

        session = vspring.Session(vertices, faces)
        session.hold(17, (0.1, 0.2, 0.3))
        positions, report = session.update()

    Calls from several threads wait for each other; one from a progress function of the session is refused.
    Nodes go by their numbers; lengths are in units of the input. Source: docs/solver.md, "Shapes that follow".
    """

    @spelled_out(SessionOptions)
    def __init__(self, vertices: ArrayLike | _vspring.Surface | _vspring.Curve, faces: Faces | None = None, *,
                 chains: Sequence[ArrayLike] | None = None, closed: Closed = None,
                 **options: Unpack[SessionOptions]) -> None:
        """vertices, faces, chains, closed: as for fair() and fair_curve(), or the result of read(). Raises what these
        raise."""
        self._given = shape_of(vertices, faces, chains, closed)
        held = held_in(self._given, options)
        self._held = held.constraints
        self._threads = threads_of(options.get("threads"))
        self._session = _vspring.FairingSession(self._given.core, held.settled(options))
        self._turn = _Turn()

    def _number(self, node: int) -> int:
        """The number of a node; of one that follows another that of the other."""
        return int(self._given.nodes_of([whole_number_of(node, "node")], "node")[0])

    def hold(self, node: int, position: ArrayLike | None = None) -> None:
        """Holds a node at a position, (3,) or for curves in a plane (2,); by default where the input has it."""
        number = self._number(node)
        with self._turn:
            if position is None:
                self._held.fix(self._given.core, indices_of([number], "node"))
            else:
                self._held.fix_position(number, self._place(position, "position"))

    def free(self, node: int) -> None:
        """Lets a node move."""
        with self._turn:
            self._held.free_position(self._number(node))

    def hold_normal(self, node: int, normal: ArrayLike) -> None:
        """Gives a node a normal, (3,), of any length but zero."""
        with self._turn:
            self._held.fix_normal(self._number(node), self._place(normal, "normal"))

    def free_normal(self, node: int) -> None:
        """Frees the normal of a node: it follows from the nodes around."""
        with self._turn:
            self._held.free_normal(self._number(node))

    def hold_tangent(self, node: int, tangent: ArrayLike) -> None:
        """Gives a node of a curve a tangent, (3,) or in a plane (2,), of any length but zero, in the direction of its chain."""
        with self._turn:
            self._held.fix_tangent(self._number(node), self._place(tangent, "tangent"))

    def free_tangent(self, node: int) -> None:
        """Frees the tangent of a node: it follows from the nodes around."""
        with self._turn:
            self._held.free_tangent(self._number(node))

    def fair(self, *, progress: Callable[[Progress], object] | Bar | None = None) -> Result[Report]:
        """Fairs to the tolerance of the session: within the expected error the result of vspring.fair(). Raises what
        that raises; a call that ends early leaves the session unchanged. Cost: a few iterations if the same nodes are
        held as in the last call, else that of vspring.fair()."""
        return self._solve(self._session.fair, progress)

    def update(self, *, tolerance: float = PICTURE, progress: Callable[[Progress], object] | Bar | None = None) -> Result[Report]:
        """Fairs for a picture during a drag. tolerance: as a share of the size. For surfaces the report lacks moves and
        counts of held nodes, and a shape worse than the input is returned with that outcome. Cost: one or two
        iterations while constraints move steadily, about 20 ms for 15,000 nodes."""
        return self._solve(self._session.update, progress, number_of(tolerance, "tolerance"))

    def predict(self, *, tolerance: float = PICTURE) -> np.ndarray | None:
        """Predicts the positions of update(); None for curves, and if update() would not start from the last shape.
        Cost: about one iteration."""
        with self._turn:
            positions = self._session.predict(self._held, number_of(tolerance, "tolerance"))
        return None if positions is None else self._given.like_given(positions)

    def _solve(self, call: Callable[..., Any], progress: Callable[[Progress], object] | Bar | None, *more: float) -> Result[Report]:
        tell = teller({"progress": progress})
        with self._turn:
            positions, fields, stopped_by = call(self._held, *more, self._threads, tell)
        return ended(self._given, positions, report_of(fields), tell, stopped_by)

    def _place(self, numbers: ArrayLike, name: str) -> list[float]:
        array, columns = np.atleast_2d(array_of(numbers, name)), self._given.columns
        if array.dtype.kind not in "fiu" or array.shape not in [(1, count) for count in columns]:
            raise Error("invalid-argument", f"{name}: {' or '.join(map(str, columns))} real numbers are needed, not {numbers!r}")
        if not np.isfinite(array).all():
            raise Error("unusable-constraint", f"{name}: {numbers!r} is not finite")
        return in_space(array)[0].tolist()


class _Turn:
    """Lets one call in at a time: those of other threads wait, but one from within another would wait for itself."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._taken = False

    def __enter__(self) -> None:
        self._lock.acquire()
        if self._taken:
            self._lock.release()
            raise Error("invalid-argument", "a session cannot be changed or solved from its own progress function; do so after the "
                        "call, which an exception from that function ends early")
        self._taken = True

    def __exit__(self, *raised: object) -> None:
        self._taken = False
        self._lock.release()
