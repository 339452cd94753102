# SPDX-License-Identifier: Apache-2.0
"""Whether a node that has a parameter with a plug-in's name may load a plug-in by it."""

from __future__ import annotations

import re
from weakref import WeakKeyDictionary

from haros_ci.checking.project import Project
from haros_ci.checking.system import System, SystemNode
from haros_ci.model.architecture import Parameter
from haros_ci.regex import regex

#: What loads plug-ins, itself or in a library that does.
_LOADS = regex(
    r"\bClassLoader\s*<|\bMultiLibraryClassLoader\b|\bcreate(?:Unmanaged|Shared|Unique)?Instance\s*[(<]|\bFilterChain\s*<|\bMultiChannelFilterChain\s*<"
    r"|\bPlanningPipeline\b|\bMoveItCpp\b|\bCostmap2DROS\b|\bLayeredCostmap\b|\bMoveGroupExe\b"
    r"|\bControllerManager\b|\bcontroller_manager::|\bCombinedRobotHW\b|\bmbf_\w+::|\bAbstractNavigationServer\b|\bnav2_\w+::"
)
#: What loads the plug-ins for kinematics.
_KINEMATICS = regex(
    r"\bRobotModelLoader\b|\bMoveGroupInterface\b|\bPlanningSceneMonitor\b|\bMoveGroupCommander\b|\bKinematicsPluginLoader\b"
)
_CODE = ("cpp", "python")
#: So many packages are looked through for one node at most; of more nothing is known.
_MOST = 40

_kept: WeakKeyDictionary[Project, dict[tuple[str, str], bool]] = WeakKeyDictionary()


def is_of_node(system: System, parameter: Parameter) -> bool:
    """Whether a node has *parameter* as its own."""
    return bool(_owners(system, parameter))


def _owners(system: System, parameter: Parameter) -> list[SystemNode]:
    return [node for node in system.nodes if node.known and parameter.name.startswith(f"{node.name}/")]


def may_load(project: Project, system: System, parameter: Parameter, key: str) -> bool:
    """Whether a node may load a plug-in by *parameter*, whose name ends in *key*.

    A node of the workspace does so if its package, or one of the workspace that it depends on, has a loader or names the
    key. What no node has as its own is read if it stands in a section, which something else is called after: a controller.
    """
    owners = _owners(system, parameter)
    if any(node.ros != 1 or not node.package for node in owners):
        return True
    if not owners:
        section = parameter.name.rpartition("/")[0]
        spaces = {"", *(node.name.rpartition("/")[0] for node in system.nodes)}
        return section not in spaces or any(node.ros != 1 for node in system.nodes) or not system.nodes
    return any(_loads(project, node, key) for node in owners)


def _loads(project: Project, node: SystemNode, key: str) -> bool:
    if project.package(node.package) is None:
        return True
    known = _kept.setdefault(project, {})
    place = (node.package, key)
    if place not in known:
        known[place] = _has_loader(project, node.package, key)
    return known[place]


def _has_loader(project: Project, name: str, key: str) -> bool:
    """Whether code of the package called *name*, or of those of the workspace that it depends on, has a loader or names the *key*."""
    waiting = [name]
    for item in waiting:
        package = project.package(item)
        if package is None:
            continue
        files = [file.path for file in package.files if file.language in _CODE]
        if (not files and item == name) or any(_is_loading(project.text(path), key) for path in files):
            return True
        declared = (other for other in sorted(package.declared) if project.package(other) is not None)
        waiting += [other for other in declared if other not in waiting]
        if len(waiting) > _MOST:
            return True
    return False


def _is_loading(text: str, key: str) -> bool:
    """Whether *text* has a loader of plug-ins, or names the *key*."""
    if re.search(rf"""["'/.~]{re.escape(key)}["']""", text) or _LOADS.search(text):
        return True
    return key == "kinematics_solver" and _KINEMATICS.search(text) is not None
