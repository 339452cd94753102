# SPDX-License-Identifier: Apache-2.0
"""Objects that hand out pointers to themselves (C++).

en.cppreference.com/w/cpp/memory/enable_shared_from_this, boost.org/doc/libs/release/libs/smart_ptr.
"""

from __future__ import annotations

ROWS: tuple[dict[str, object], ...] = tuple(
    {"call": f"{space}::enable_shared_from_this::{name}", "args": [0], "transparent": "{this}"}
    for space in ("std", "boost")
    for name in ("shared_from_this", "weak_from_this")
)
