# SPDX-License-Identifier: Apache-2.0
"""Threads (C++): what they run is called later, beside the callbacks.

en.cppreference.com/w/cpp/thread, boost.org/doc/libs/release/doc/html/thread.
"""

from __future__ import annotations

MOST = list(range(1, 13))

ROWS: tuple[dict[str, object], ...] = (
    *({"call": name, "args": MOST, "calls": ["0"]} for name in ("std::thread", "std::jthread", "boost::thread")),
    {"call": "std::async", "args": MOST, "calls": ["0", "1"]},
    {"call": "boost::thread_group::create_thread", "args": [1], "calls": ["0"]},
)
