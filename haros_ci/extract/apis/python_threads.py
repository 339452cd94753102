# SPDX-License-Identifier: Apache-2.0
"""Threads and processes (Python): what they run is called later, with the arguments that they are given for it.

docs.python.org/3/library/threading.html, multiprocessing.html, concurrent.futures.html. A process works on a copy of what there is.
"""

from __future__ import annotations

from collections.abc import Mapping

#: Classes whose objects run a function in a process of its own.
PROCESSES = (
    "multiprocessing.Process",
    "multiprocessing.context.Process",
    "multiprocessing.context.ForkProcess",
    "multiprocessing.context.SpawnProcess",
    "multiprocessing.process.BaseProcess",
)
#: Functions that make what hands functions to threads or processes.
POOLS = (
    "multiprocessing.Pool",
    "multiprocessing.context.BaseContext.Pool",
    "multiprocessing.pool.ThreadPool",
    "multiprocessing.dummy.Pool",
)
EXECUTORS = (
    "concurrent.futures.ThreadPoolExecutor",
    "concurrent.futures.ProcessPoolExecutor",
    "concurrent.futures.thread.ThreadPoolExecutor",
    "concurrent.futures.process.ProcessPoolExecutor",
)
_CONTEXT, _POOL, _EXECUTOR = (
    "multiprocessing.context.BaseContext",
    "multiprocessing.pool.Pool",
    "concurrent.futures.Executor",
)

# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    {"class": "threading.Thread", "entry": ["run"]},
    {"call": "threading.Thread", "calls": ["target", "1"]},
    {"call": "threading.Timer", "calls": ["function", "1"]},

    *({"class": name, "entry": ["run"]} for name in PROCESSES),
    *({"call": name, "calls": ["target", "1"]} for name in PROCESSES),
    {"call": "multiprocessing.get_context", "returns": _CONTEXT},
    {"call": f"{_CONTEXT}.Process", "calls": ["target", "1"]},
    *({"call": name, "returns": _POOL} for name in POOLS),
    *({"call": f"{_POOL}.{name}", "calls": ["func", "0"]}
      for name in ("apply", "apply_async", "map", "map_async", "imap", "imap_unordered")),

    *({"call": name, "returns": _EXECUTOR} for name in EXECUTORS),
    *({"call": f"{_EXECUTOR}.{name}", "calls": ["fn", "0"]} for name in ("submit", "map")),
)
