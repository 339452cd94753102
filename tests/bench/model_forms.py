# SPDX-License-Identifier: Apache-2.0
"""``python tests/bench/model_forms.py WORKSPACE [CACHE [BEFORE]]``: what it takes to write the model as JSON, plain and compact.

BEFORE is ``haros_ci/report/model_json.py`` of another revision, measured in turn with this one. CPU seconds, the least of five.
"""

from __future__ import annotations

import gc
import importlib.util
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.report import model_compact, model_json
from haros_ci.workspace.cache import DiskCache, MemoryCache
from haros_ci.workspace.discover import discover

TIMES = 5


def loaded(path: str) -> Any:
    """The module at *path*."""
    spec = importlib.util.spec_from_file_location("before", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["before"] = module
    spec.loader.exec_module(module)
    return module


def main(root: str, cache: str | None = None, before: str | None = None) -> None:
    """Measure and print."""
    gc.disable()
    workspace = discover(Path(root).resolve(), (".",))
    store = MemoryCache() if cache is None else DiskCache(Path(cache))
    found = architecture(workspace, Settings(root=workspace.root), store, processes=2)
    store.flush()
    plain, compact = model_json.render(found), model_compact.render(found)
    assert model_compact.expand(compact) == plain
    jobs: dict[str, Callable[[], object]] = {}
    if before is not None:
        old = loaded(before)
        assert old.render(found) == plain
        jobs["plain, before"] = lambda: old.render(found)
    jobs["plain"] = lambda: model_json.render(found)
    jobs["compact"] = lambda: model_compact.render(found)
    jobs["plain read by json.loads"] = lambda: json.loads(plain)
    jobs["compact read by json.loads"] = lambda: json.loads(compact)
    jobs["compact expanded"] = lambda: model_compact.expand(compact)
    least = dict.fromkeys(jobs, float("inf"))
    for _ in range(TIMES):
        for name, job in jobs.items():
            began = time.process_time()
            job()
            least[name] = min(least[name], time.process_time() - began)
    print(f"{len(plain):,} bytes plain, {len(compact):,} compact")
    first = next(iter(least.values()))
    for name, seconds in least.items():
        print(f"{seconds:7.3f} s  {first / seconds:6.2f}  {name}")


if __name__ == "__main__":
    main(*sys.argv[1:])
