# SPDX-License-Identifier: Apache-2.0
"""What code of others prints must not get into an output that a machine reads."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def kept_clean(is_enabled: bool = True) -> Iterator[None]:
    """Within the context, all output to stdout, by whatever means, goes to stderr; no-op unless *is_enabled*."""
    if not is_enabled:
        yield
        return
    sys.stdout.flush()
    kept = os.dup(1)
    try:
        os.dup2(2, 1)
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
