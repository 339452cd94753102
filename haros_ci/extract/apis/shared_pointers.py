# SPDX-License-Identifier: Apache-2.0
"""Objects that hand out pointers to themselves (C++).

en.cppreference.com/w/cpp/memory/enable_shared_from_this, boost.org/doc/libs/release/libs/smart_ptr.
"""

from __future__ import annotations

ROWS: tuple[dict[str, object], ...] = (
    {"call": "std::enable_shared_from_this::shared_from_this", "args": [0], "transparent": "{this}"},
    {"call": "std::enable_shared_from_this::weak_from_this", "args": [0], "transparent": "{this}"},
    {"call": "boost::enable_shared_from_this::shared_from_this", "args": [0], "transparent": "{this}"},
    {"call": "boost::enable_shared_from_this::weak_from_this", "args": [0], "transparent": "{this}"},
)
