"""Files of whole content: never a half-written one under the asked-for name."""
from __future__ import annotations

import os
import tempfile
from typing import Callable, Union

from . import _native

PathLike = Union[str, bytes, "os.PathLike[str]"]


def write_whole(path: PathLike, text: str) -> None:
    """Puts the text under that name at once; in place of what was there."""

    def write(descriptor: int, beside: int) -> None:
        with os.fdopen(os.dup(descriptor), "w", encoding="utf-8", newline="") as out:
            out.write(text)

    make_whole(path, write)


def write_bytes(path: PathLike, content: bytes) -> None:
    """The same with bytes."""

    def write(descriptor: int, beside: int) -> None:
        with os.fdopen(os.dup(descriptor), "wb") as out:
            out.write(content)

    make_whole(path, write)


def make_whole(path: PathLike, write: Callable[[int, int], None]) -> None:
    """Calls `write` with the descriptor of an empty file and that of another beside it, which goes afterwards; then puts the
    first under that name at once, in place of what was there. Where `write` fails nothing is left."""
    target = os.fsdecode(path)
    folder = os.path.dirname(target) or "."
    unfinished = ""
    try:
        descriptor, unfinished = tempfile.mkstemp(dir=folder, prefix=".spoolflow-")
        try:
            with tempfile.TemporaryFile(dir=folder) as beside:
                write(descriptor, beside.fileno())
        finally:
            os.close(descriptor)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(unfinished, 0o666 & ~mask)
        os.replace(unfinished, target)
    except BaseException as failure:
        if unfinished:
            os.unlink(unfinished)
        if isinstance(failure, OSError):
            raise _native.Error(f"{target}: cannot be written: {failure.strerror}") from None
        raise
