# SPDX-License-Identifier: Apache-2.0
"""What names of a manifest are: of nothing that anybody has, or of what brings variables of the environment."""

from __future__ import annotations

from haros_ci.checking.project import Project, ProjectPackage
from haros_ci.checking.provision import Provisions

#: What sets ROS_DISTRO and ROS_VERSION.
ENVIRONMENT = "ros_environment"
#: What brings it only in distributions after Jazzy, by rosidl_default_generators.
_LATE = frozenset(("rosidl_generator_rs",))


def is_nowhere(name: str, project: Project) -> bool:
    """Whether neither the workspace, nor a distribution, nor rosdep has *name*."""
    known = project.knowledge
    return project.package(name) is None and known.is_package(name) is False and not known.is_key(name)


def has_environment(package: ProjectPackage, provisions: Provisions) -> bool:
    """Whether a dependency brings ros_environment in ROS 2; what ROS 1 alone has brings nothing there (roslib of pluginlib)."""
    project = package.project
    waiting, seen = list(package.declared - _LATE), {*package.declared, *_LATE}
    while waiting:
        name = waiting.pop()
        if name == ENVIRONMENT:
            return True
        if (
            project.package(name) is None
            and project.knowledge.is_package(name)
            and not project.knowledge.is_in(name, 2)
        ):
            continue
        new = (provisions.brought(name, 2) or frozenset()) - seen
        seen |= new
        waiting += new
    return False
