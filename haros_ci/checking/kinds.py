# SPDX-License-Identifier: Apache-2.0
"""Kinds of endpoints, as checks speak of them."""

from __future__ import annotations

#: Kinds of endpoints that are the two ends of a topic, a service, an action: who gives, then who takes.
TOPIC = ("publishers", "subscribers")
SERVICE = ("servers", "clients")
ACTION = ("action_servers", "action_clients")
#: One end of each kind in words.
WORDS = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "servers": "service server",
    "clients": "service client",
    "action_servers": "action server",
    "action_clients": "action client",
    "getters": "read",
    "setters": "write",
    "parameters": "parameter",
}
#: How configurations are called that are no systems, but tell of code that may run in nodes (docs/model.md).
NO_SYSTEMS = (" (plug-ins)", " (behaviour trees)", " (library)")
