"""Work in a process of its own, where this one must not start the processes that read HDF5 and MATLAB files.

Such files are read by a child process in a sandbox, which is forked. A process with several threads (a notebook, NumPy
with its own threads) must not fork: what another thread has locked stays locked in the child for ever. A fresh
interpreter, which has but one thread, does the work then: it sends its progress and its result, and an interruption here
ends it.
"""
from __future__ import annotations

import contextlib
import os
import pickle
import subprocess
import sys
from typing import Any, Dict, Iterable

from . import _native

_CHILD = """
import importlib.util, os, pickle, signal, sys, types
signal.signal(signal.SIGINT, signal.SIG_IGN)
out = os.fdopen(os.dup(1), "wb")
os.dup2(2, 1)
spec = importlib.util.spec_from_file_location("spoolflow._native", sys.argv[1])
sys.modules["spoolflow"] = types.ModuleType("spoolflow")
native = sys.modules["spoolflow._native"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(native)

def send(kind, content):
    try:
        pickle.dump((kind, content), out, protocol=4)
        out.flush()
    except BrokenPipeError:
        os._exit(1)  # nobody waits for the answer

name, arguments, has_progress = pickle.load(sys.stdin.buffer)
if has_progress:
    arguments = (*arguments, lambda *progress: send("progress", progress))
try:
    answer = ("result", getattr(native, name)(*arguments))
except Exception as failure:
    answer = ("Error" if isinstance(failure, native.Error) else type(failure).__name__, str(failure))
send(*answer)
"""


def _threads() -> int:
    try:
        return len(os.listdir("/proc/self/task"))
    except OSError:
        return 1


def call(name: str, files: Iterable[Any], *arguments: Any, **progress: Any) -> Any:
    """The compiled part's function of that name; in a process of its own where `files` need it. `progress`, its last argument,
    is a function that it calls as it goes on, or None; the other process sends the arguments of each call."""
    if _threads() > 1 and sys.executable and _native.takes_a_process([os.fsdecode(file) for file in files]):
        return _call_apart(name, arguments, progress)
    return getattr(_native, name)(*arguments, *progress.values())


def _call_apart(name: str, arguments: Any, progress: Dict[str, Any]) -> Any:
    with subprocess.Popen([sys.executable, "-I", "-c", _CHILD, _native.__file__], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as child:
        try:
            assert child.stdin is not None
            with contextlib.suppress(BrokenPipeError), child.stdin:
                pickle.dump((name, arguments, bool(progress)), child.stdin, protocol=4)
            kind, content = _next_message(child)
            while kind == "progress":
                for report in progress.values():
                    if report is not None:
                        report(*content)
                kind, content = _next_message(child)
        except BaseException:  # an interruption, or what `progress` raised
            child.kill()
            raise
    if kind == "result":
        return content
    raise {"Error": _native.Error, "MemoryError": MemoryError}.get(kind, RuntimeError)(content)


def _next_message(child: subprocess.Popen[bytes]) -> Any:
    try:
        assert child.stdout is not None
        return pickle.load(child.stdout)
    except (EOFError, pickle.UnpicklingError):
        raise RuntimeError(f"the process that read the recordings ended with status {child.wait()}") from None
