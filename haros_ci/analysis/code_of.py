# SPDX-License-Identifier: Apache-2.0
"""The call graph of what was linked, made once: nodes are marked by it, checks ask it, and so does the search for calls of ROS APIs."""

from __future__ import annotations

from haros_ci.code.codebase import Codebase, codebase
from haros_ci.model.workspace import Workspace
from haros_ci.systems.link import Linked


def code_of(made: Linked, workspace: Workspace) -> Codebase:
    """The code of the programs of *workspace* that were linked."""
    if "code" not in made.kept:
        ros = {package.name: package.ros for package in workspace.packages if package.ros is not None}
        made.kept["code"] = codebase(made.sources, workspace.text, ros)
    found: Codebase = made.kept["code"]
    return found
