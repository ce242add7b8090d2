"""Errors and warnings."""
from __future__ import annotations

import sys
import warnings
from pathlib import Path
from types import FrameType
from typing import Iterable

_PACKAGE = str(Path(__file__).parent)


class Error(ValueError):
    """Input that vspring cannot work with. The message names the element at fault and says what to do.

    code: "invalid-argument", "unusable-file", "unusable-shape" or "unusable-constraint".
    A call that raises it changes nothing.
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(code, message)
        self.code = code

    def __str__(self) -> str:
        return self.args[1]


class Warning(UserWarning):
    """A warning about a result.

    code: for runs as in the report of the command line, such as "immovable-nodes" or "worse-than-input"; for files
    "reading" or "writing".
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(code, message)
        self.code = code

    def __str__(self) -> str:
        return self.args[1]


def warn(each: Iterable[tuple[str, str]]) -> None:
    """Warns at the caller of the package."""
    depth = 1
    frame: FrameType | None = sys._getframe()
    while frame is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        depth, frame = depth + 1, frame.f_back
    for code, message in each:
        warnings.warn(Warning(code, message), stacklevel=depth)
