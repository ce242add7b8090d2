"""What goes wrong, and what a person should know."""
from __future__ import annotations

import sys
import warnings
from pathlib import Path
from types import FrameType
from typing import Iterable

_PACKAGE = str(Path(__file__).parent)


class Error(ValueError):
    """Input that vspring cannot work with. The message names what is at fault and says what to do.

    code: "invalid-argument", "unusable-file", "unusable-shape" or "unusable-constraint".
    A call that raises it has changed nothing.
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(code, message)
        self.code = code

    def __str__(self) -> str:
        return self.args[1]


class Warning(UserWarning):
    """What a person should know of a result.

    code: of a run, as the report of the command line has it, such as "immovable-nodes" or "worse-than-input";
    "reading" and "writing" of files.
    """

    def __init__(self, code: str, message: str) -> None:
        super().__init__(code, message)
        self.code = code

    def __str__(self) -> str:
        return self.args[1]


def warn(each: Iterable[tuple[str, str]]) -> None:
    """Warns where the package was called."""
    depth = 1
    frame: FrameType | None = sys._getframe()
    while frame is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        depth, frame = depth + 1, frame.f_back
    for code, message in each:
        warnings.warn(Warning(code, message), stacklevel=depth)
