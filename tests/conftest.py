# SPDX-License-Identifier: Apache-2.0
"""What all tests stand on: Hypothesis looks at the same examples in every run, a shell's ignored signals and its wish for no bytecode are
not inherited, what takes long is marked ``slow``, and the garbage collector looks neither at the tests nor at them again and again.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Generator
from contextlib import suppress
from typing import Any

import pytest
from commandline import cache_home
from hypothesis import settings
from tiers import is_slow
from together import are_chosen, together

settings.register_profile("steady", derandomize=True, database=None, deadline=None)
settings.load_profile("steady")
# Hypothesis draws words of the modules that are loaded, too: other ones in each process and after each change, so that an example of one
# run is none of the next. To read them all takes each process five seconds.
with suppress(ImportError):  # earlier ones do not
    from hypothesis.internal.conjecture import providers

    providers._get_local_constants = lambda: providers._local_constants
# Collecting forty thousand tests took 26 seconds of the processor, of which 17 went into looking for garbage among them.
gc.disable()

# A shell starts what runs in the background with SIGINT ignored, nohup with SIGHUP, and so would every command that a test interrupts.
for _signal in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGTERM):
    if signal.getsignal(_signal) is signal.SIG_IGN:
        signal.signal(_signal, signal.default_int_handler if _signal == signal.SIGINT else signal.SIG_DFL)


# What is started hundreds of times is compiled once.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# Repositories of a few files that live for a second need no upkeep, and outlive no machine.
_GIT = {"maintenance.auto": "false", "core.fsync": "none"}
os.environ["GIT_CONFIG_COUNT"] = str(len(_GIT))
for _number, (_key, _value) in enumerate(_GIT.items()):
    os.environ[f"GIT_CONFIG_KEY_{_number}"], os.environ[f"GIT_CONFIG_VALUE_{_number}"] = _key, _value


def pytest_configure(config: pytest.Config) -> None:
    if not hasattr(config, "workerinput"):  # before the processes of pytest-xdist begin
        cache_home()


@pytest.hookimpl(wrapper=True)
def pytest_pycollect_makeitem(collector: pytest.Module | pytest.Class) -> Generator[None, Any, Any]:
    found = yield
    if hasattr(collector.config, "workerinput") and isinstance(found, list) and not are_chosen(collector.config):
        return together(found)
    return found


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> object | None:
    if config.getvalue("dist") != "loadscope":
        return None
    from scopes import Modules

    return Modules(config, log)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if is_slow(item.path):
            item.add_marker(pytest.mark.slow)


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()
    gc.set_threshold(50_000, 20, 20)
