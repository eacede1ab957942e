"""What is raised where input cannot be used."""
from __future__ import annotations

import contextlib
import os
from typing import Any, Iterator, Mapping

from . import _native


class FileMissing(_native.Error, FileNotFoundError):
    """A file that is not there: an `Error` with its words, and a `FileNotFoundError` whose `filename` it is."""

    def __init__(self, words: str, path: str) -> None:
        super().__init__(words)
        self.filename = path

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> Any:
        return (FileMissing, (self.args[0], self.filename))


@contextlib.contextmanager
def naming_missing(*paths: Any) -> Iterator[None]:
    """Raises what is refused inside as FileMissing, where one of the paths (others than paths count not) leads nowhere."""
    try:
        yield
    except FileMissing:
        raise
    except _native.Error as failure:
        for path in paths:
            if isinstance(path, (str, bytes, os.PathLike)) and not os.path.exists(path):
                raise FileMissing(str(failure), os.fsdecode(path)) from None
        raise


@contextlib.contextmanager
def calling(names: Mapping[str, str]) -> Iterator[None]:
    """What is refused inside calls these paths, of files that the caller never saw, by their names. A file that is missing is the caller's."""
    try:
        yield
    except FileMissing:
        raise
    except _native.Error as failure:
        said = str(failure)
        for path, called in names.items():
            said = said.replace(path, called)
        raise type(failure)(said) from None
