# SPDX-License-Identifier: Apache-2.0
"""A command runs without the garbage collector."""

from __future__ import annotations

import atexit
import gc

from haros_ci.commands.collector import without_collector


def test_it_is_off_however_often_that_is_asked_for() -> None:
    was_on = gc.isenabled()
    try:
        without_collector()
        without_collector()
        assert not gc.isenabled()
    finally:
        atexit.unregister(gc.freeze)
        if was_on:
            gc.enable()
