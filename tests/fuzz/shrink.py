# SPDX-License-Identifier: Apache-2.0
"""A smaller input that shows the same."""

from __future__ import annotations

import time
from collections.abc import Callable


def shrunk(data: bytes, shows: Callable[[bytes], bool], seconds: float = 20.0) -> bytes:
    """*data* with lines and then bytes left out as long as *shows* holds, for at most so many *seconds*."""
    end = time.monotonic() + seconds
    for split in (b"\n", b""):
        parts = data.split(split) if split else [data[i : i + 1] for i in range(len(data))]
        size = max(1, len(parts) // 2)
        while size and time.monotonic() < end:
            at = 0
            while at < len(parts) and time.monotonic() < end:
                fewer = parts[:at] + parts[at + size :]
                if shows(split.join(fewer)):
                    parts = fewer
                else:
                    at += size
            size //= 2
        data = split.join(parts)
    return data
