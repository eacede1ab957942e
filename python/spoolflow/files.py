"""Files of whole content: never a half-written one under the asked-for name."""
from __future__ import annotations

import os
import tempfile
from typing import Union

from . import _native

PathLike = Union[str, "os.PathLike[str]"]


def write_whole(path: PathLike, text: str) -> None:
    """Puts the text under that name at once; in place of what was there."""
    target = os.fspath(path)
    folder = os.path.dirname(target) or "."
    try:
        descriptor, unfinished = tempfile.mkstemp(dir=folder, prefix=".spoolflow-")
    except OSError as failure:
        raise _native.Error(f"{target}: cannot be written: {failure.strerror}") from None
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8", newline="") as out:
            out.write(text)
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(unfinished, 0o666 & ~mask)
        os.replace(unfinished, target)
    except BaseException as failure:
        os.unlink(unfinished)
        if isinstance(failure, OSError):
            raise _native.Error(f"{target}: cannot be written: {failure.strerror}") from None
        raise
