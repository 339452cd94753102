# SPDX-License-Identifier: Apache-2.0
"""Threads (C++): what they run is called later, beside the callbacks.

en.cppreference.com/w/cpp/thread, boost.org/doc/libs/release/doc/html/thread, man7.org/linux/man-pages/man3/pthread_create.3.html.
"""

from __future__ import annotations

ROWS: tuple[dict[str, object], ...] = (
    {"call": "std::thread", "args": [1, 2, 3, 4, 5, 6, 7, 8, 9], "calls": ["0"]},
    {"call": "std::jthread", "args": [1, 2, 3, 4, 5, 6, 7, 8, 9], "calls": ["0"]},
    {"call": "boost::thread", "args": [1, 2, 3, 4, 5, 6, 7, 8, 9], "calls": ["0"]},
    {"call": "std::async", "args": [1, 2, 3, 4, 5, 6, 7, 8, 9], "calls": ["0", "1"]},
    {"call": "boost::thread_group::create_thread", "args": [1], "calls": ["0"]},
    {"call": "pthread_create", "args": [4], "calls": ["2"]},
)
