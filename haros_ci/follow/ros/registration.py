# SPDX-License-Identifier: Apache-2.0
"""Python programs of ROS 1 that never call ``rospy.init_node``: nobody learns of their topics and services.

``rospy/impl/registration.py``: what is made is registered once the node is started, at ``init_node``; parameters and calls of
services do without (``rospy/client.py``, ``rospy/impl/tcpros_service.py``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.follow.libraries import python_modules

if TYPE_CHECKING:
    from haros_ci.follow.walk import Walk
    from haros_ci.index.index import Source
    from haros_ci.syntax import Alias

#: What is registered with the master.
REGISTERED = frozenset(("publishers", "subscribers", "servers", "action_servers", "action_clients"))
#: Why there is none of it.
NEVER = "the program never calls rospy.init_node, without which rospy registers nothing"
#: Why there may be none.
NOT_SEEN = "no call of rospy.init_node is seen, without which rospy registers nothing"
#: Libraries without ROS, and such of ROS, as people use them that leave it to the program to name its node.
QUIET = frozenset(
    "PIL actionlib_msgs angles control cv2 cv_bridge geopy image_geometry laser_geometry matplotlib networkx numba numpy pandas "
    "pygame pyproj pyquaternion ros_numpy rosgraph roslib rospkg scipy serial shapely simplejson six skimage sklearn sympy "
    "tensorflow tf_conversions torch torchvision transforms3d usb utm yaml zmq".split()
)
#: What loads modules that no import names.
LOADING = frozenset(("imp", "importlib", "runpy"))
#: Parts of the names of what is generated from interfaces.
GENERATED = ("msg", "srv", "action", "cfg")


def forget_unregistered(walk: Walk, source: Source) -> None:
    """Drop what a program makes that is never registered; where that is not certain, say so of it."""
    if source.program.language != "python" or walk.context.process is not None or walk.names:
        return
    is_certain = not any(_may_name(walk, other) for other in (source, *_followed(walk)))
    for key, made in list(walk.made.items()):
        if made.kind in REGISTERED and is_certain:
            del walk.made[key]
        elif made.kind in REGISTERED:
            walk.made[key] = replace(made, unknowns=(*made.unknowns, ("conditions", NOT_SEEN, made.location)))


def _followed(walk: Walk) -> Iterator[Source]:
    return (frame.source for frame in walk.modules.values())


def _may_name(walk: Walk, source: Source) -> bool:
    """Whether a module calls ``init_node`` itself, or uses a library that is not known."""
    if any(not _is_quiet(walk, source, alias) for alias in source.program.aliases):
        return True
    functions = source.program.functions
    return any(
        name.endswith("init_node") for function in functions for name in walk.relevance.calls_of(function, source)
    )


def _is_quiet(walk: Walk, source: Source, alias: Alias) -> bool:
    """Whether what is imported is of the workspace, or of a library that names no node."""
    target = python_modules.absolute(source, alias.type.name)
    head, *rest = target.split(".")
    if head.endswith(("_msgs", "_srvs")) or any(part in GENERATED for part in rest):
        return True
    if head in LOADING:
        return False
    if head in QUIET or python_modules.is_library(walk, head):
        return True
    return head in walk.index.modules or python_modules.beside(walk, source, target) is not None
