# SPDX-License-Identifier: Apache-2.0
"""The hash by which two nodes tell whether they mean the same type, in either ROS."""

from __future__ import annotations

from haros_ci.interfaces.definitions import Definitions
from haros_ci.interfaces.md5 import md5
from haros_ci.interfaces.rihs import rihs01
from haros_ci.model.build import Interface


def wire_hash(interface: Interface, known: Definitions) -> str | None:
    """The MD5 sum (ROS 1) or RIHS01 type hash (ROS 2) of *interface*; None if a part of it is not known for certain."""
    return md5(interface, known) if known.ros == 1 else rihs01(interface, known)
