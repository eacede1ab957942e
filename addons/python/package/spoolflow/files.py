"""Files of whole content: never a half-written one under the asked-for name."""
from __future__ import annotations

import os
import shutil
import stat
import tempfile
from typing import Any, Callable, Iterable, Mapping, Optional, Union

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
    first under that name at once, in place of what was there, whose rights it takes over. A link stays: what it leads to is
    replaced. A device or a pipe gets the bytes. Where `write` fails nothing is left."""
    asked = os.fsdecode(path)
    old = _old_file(asked)
    try:
        if old is not None and not stat.S_ISREG(old.st_mode):
            with tempfile.TemporaryFile() as made, tempfile.TemporaryFile() as beside:
                write(made.fileno(), beside.fileno())
                made.seek(0)
                with open(asked, "wb") as out:
                    shutil.copyfileobj(made, out)
        else:
            _replace(os.path.realpath(asked) if os.path.islink(asked) else asked, old, write)
    except OSError as failure:
        raise _native.Error(f"{asked}: cannot be written: {failure.strerror}; put that right or name another file") from None


def _old_file(asked: str) -> Optional[os.stat_result]:
    """What stands there now. Raises Error where it cannot be written to."""
    try:
        old = os.stat(asked)
    except OSError:
        return None
    if stat.S_ISDIR(old.st_mode):
        raise _native.Error(f"{asked}: cannot be written: it is a folder; name a file in it")
    if not os.access(asked, os.W_OK):
        raise _native.Error(f"{asked}: cannot be written: it is write-protected; name another file or change its rights")
    return old


def _replace(target: str, old: Optional[os.stat_result], write: Callable[[int, int], None]) -> None:
    folder = os.path.dirname(target) or "."
    unfinished = ""
    try:
        descriptor, unfinished = tempfile.mkstemp(dir=folder, prefix=".spoolflow-")
        try:
            with tempfile.TemporaryFile(dir=folder) as beside:
                write(descriptor, beside.fileno())
        finally:
            os.close(descriptor)
        if old is None:
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(unfinished, 0o666 & ~mask)
        else:
            if (old.st_uid, old.st_gid) != (os.geteuid(), os.getegid()) and os.geteuid() == 0:
                os.chown(unfinished, old.st_uid, old.st_gid)
            os.chmod(unfinished, stat.S_IMODE(old.st_mode))
        os.replace(unfinished, target)
    except BaseException:
        if unfinished:
            os.unlink(unfinished)
        raise


def keep_apart(outputs: Mapping[str, Optional[PathLike]], inputs: Iterable[Any]) -> None:
    """Before the work: raises Error where an output has no name or no folder, or is a file that the same call also reads or
    writes. Inputs in memory count by the file that they were read from, if any."""
    sources = (getattr(each, "file", each) for each in inputs)
    used = [os.fsdecode(each) for each in sources if isinstance(each, (str, bytes, os.PathLike))]
    for name, output in outputs.items():
        if output is None:
            continue
        target = os.fsdecode(output)
        folder = os.path.dirname(target) or "."
        if not target:
            raise _native.Error(f"{name}: has no name; give a file")
        if not os.path.isdir(folder):
            raise _native.Error(f"{target}: cannot be written: the folder {folder} does not exist; create it or name another")
        for other in used:
            if os.path.realpath(other) == os.path.realpath(target):
                raise _native.Error(
                    f"{name}: cannot write {target}: this call also uses {other}, which is the same file; name another")
        used.append(target)
