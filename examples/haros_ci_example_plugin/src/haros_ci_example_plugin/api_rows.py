# SPDX-License-Identifier: Apache-2.0
"""What the calls of a library mean whose source no workspace has: rows as a project file's 'apis' has them."""

from __future__ import annotations

API_ROWS = (
    # acme_ros.beacon(node, name): publishes <name>/beacon on the node
    {
        "call": "acme_ros.beacon",
        "args": [2],
        "makes": [
            {
                "kind": "publishers",
                "name": "{1}/beacon",
                "type": "std_msgs/msg/String",
                "qos": "10",
                "namespace": "{0}",
            }
        ],
    },
    # acme::Beacon(node, name)
    {
        "call": "acme::Beacon",
        "args": [2],
        "makes": [
            {
                "kind": "publishers",
                "name": "{1}/beacon",
                "type": "std_msgs/msg/String",
                "qos": "10",
                "namespace": "{0}",
            }
        ],
    },
)
