# SPDX-License-Identifier: Apache-2.0
"""All tables of ROS API calls, checked and parsed, by language and ROS version."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import Any

from haros_ci.model.api import Row, load_row

#: Modules of this package, by language and ROS version; each has ``ROWS`` in the form of ``haros_ci.model.api``.
TABLES: tuple[tuple[str, int, tuple[str, ...]], ...] = (
    (
        "cpp",
        1,
        ("roscpp", "nodelet", "transports", "filters", "tf", "actions", "reconfigure", "diagnostics", "tools"),
    ),
    ("python", 1, ("rospy",)),
)


#: Calls that advertise an image, and what the plug-ins publish below its topic (wiki.ros.org/image_transport_plugins).
IMAGES = frozenset(("image_transport::ImageTransport::advertise", "image_transport::ImageTransport::advertiseCamera"))
TRANSPORTS = (
    ("compressed", "sensor_msgs/CompressedImage"),
    ("compressedDepth", "sensor_msgs/CompressedImage"),
    ("theora", "theora_image_transport/Packet"),
)
UNSURE = "the plug-in of this transport may not be installed"


@cache
def rows(language: str, ros: int) -> tuple[Row, ...]:
    """The rows for ``cpp`` or ``python`` under ROS 1 or 2, in the order of the tables; () where there are none."""
    return tuple(
        load_row(_with_transports(row))
        for table_language, version, modules in TABLES
        if (table_language, version) == (language, ros)
        for module in modules
        for row in import_module(f"{__package__}.{module}").ROWS
    )


def _with_transports(row: Mapping[str, Any]) -> Mapping[str, Any]:
    """*row* with the topics of the image's transports, beside the image that it makes first."""
    if row.get("call") not in IMAGES:
        return row
    below = {"implicit": True, "unsure": UNSURE}
    topics = ({**row["makes"][0], **below, "name": f"{{resolve(0)}}/{name}", "type": kind} for name, kind in TRANSPORTS)
    return {**row, "makes": [*row["makes"], *topics]}
