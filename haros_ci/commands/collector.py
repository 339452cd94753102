# SPDX-License-Identifier: Apache-2.0
"""The garbage collector of a short-lived process over acyclic values: it would only look for what is not there."""

from __future__ import annotations

import atexit
import gc


def without_collector() -> None:
    """Switch the collector off for the rest of the process, and for its end.

    The interpreter collects once more while it ends, whether the collector is on or not (``Py_FinalizeEx``): with the architecture of a large
    workspace in memory that takes a second. What is frozen before is left to the system.
    """
    gc.disable()
    atexit.unregister(gc.freeze)
    atexit.register(gc.freeze)
