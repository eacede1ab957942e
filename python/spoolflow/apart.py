"""Work in a process of its own, where this one must not start the processes that read HDF5 and MATLAB files.

Such files are read by a child process of few rights, which is forked. A process with several threads (a notebook, NumPy
with its own threads) must not fork: what another thread has locked stays locked in the child for ever. A fresh
interpreter, which has but one thread, does the work then and sends its result.
"""
from __future__ import annotations

import os
import pickle
import subprocess
import sys
from typing import Any, Iterable

from . import _native

_CHILD = """
import importlib.util, pickle, signal, sys, types
signal.signal(signal.SIGINT, signal.SIG_IGN)
spec = importlib.util.spec_from_file_location("spoolflow._native", sys.argv[1])
sys.modules["spoolflow"] = types.ModuleType("spoolflow")
native = sys.modules["spoolflow._native"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(native)
name, arguments = pickle.load(sys.stdin.buffer)
try:
    answer = (None, getattr(native, name)(*arguments))
except Exception as failure:
    answer = ("Error" if isinstance(failure, native.Error) else type(failure).__name__, str(failure))
pickle.dump(answer, sys.stdout.buffer, protocol=4)
"""


def _threads() -> int:
    try:
        return len(os.listdir("/proc/self/task"))
    except OSError:
        return 1


def call(name: str, files: Iterable[Any], *arguments: Any, **telling: Any) -> Any:
    """The compiled part's function of that name; in a process of its own where `files` need it. `telling`, its last argument,
    is a function that it calls as it goes on, and that another process would not have."""
    if _threads() > 1 and sys.executable and _native.takes_a_process([os.fsdecode(file) for file in files]):
        return _call_apart(name, (*arguments, *(None for _ in telling)))
    return getattr(_native, name)(*arguments, *telling.values())


def _call_apart(name: str, arguments: Any) -> Any:
    with subprocess.Popen([sys.executable, "-I", "-c", _CHILD, _native.__file__], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as child:
        try:
            answer, _ = child.communicate(pickle.dumps((name, arguments), protocol=4))
        except BaseException:
            child.kill()
            raise
    if child.returncode != 0 or not answer:
        raise RuntimeError(f"the process that read the recordings ended with status {child.returncode}")
    failure, result = pickle.loads(answer)
    if failure is None:
        return result
    raise {"Error": _native.Error, "MemoryError": MemoryError}.get(failure, RuntimeError)(result)
