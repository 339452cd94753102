# SPDX-License-Identifier: Apache-2.0
"""What two revisions of a workspace are compared by, from what their architectures were made of."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from haros_ci.analysis.code_of import code_of
from haros_ci.changes.calls import Rows, by_name
from haros_ci.changes.change import shown
from haros_ci.changes.endpoints import WORDS
from haros_ci.changes.revision import Revision
from haros_ci.changes.settings import ParameterValue
from haros_ci.extract.apis.tables import rows
from haros_ci.launch.ros2.parameter_files import SECTION, values_in
from haros_ci.model.architecture import Architecture
from haros_ci.model.workspace import Workspace
from haros_ci.systems.link import Linked


def revision_of(workspace: Workspace, made: Linked) -> Revision:
    """*workspace* at one revision, with the architecture that was *made* of it."""
    versions = {package.name: package.ros for package in workspace.packages}
    interfaces = tuple(
        (interface, versions.get(name)) for name, build in made.builds.items() for interface in build.interfaces
    )
    programs = {source.path: source.program for source in made.sources}

    def timed() -> Architecture:
        from haros_ci.analysis.rates import with_rates  # most changes leave rates as they are

        return with_rates(made.architecture, code_of(made, workspace))

    return Revision(workspace, made.architecture, interfaces, read_values, programs, call_rows(), timed)


@cache
def call_rows() -> Mapping[tuple[str, int], Rows]:
    """What calls of ROS libraries make, by language and ROS version; of ROS 2 no readings: what is read there is declared."""
    read = {1: WORDS.keys(), 2: WORDS.keys() - {"getters"}}
    return {
        (language, ros): by_name(rows(language, ros), frozenset(kinds))
        for language in ("cpp", "python")
        for ros, kinds in read.items()
    }


def read_values(path: str, text: str) -> tuple[ParameterValue, ...]:
    """What a parameter file of ROS 2 gives, () if it is none."""
    if SECTION not in text:
        return ()
    return tuple(
        ParameterValue(rule.node, rule.name, None if rule.unknowns else shown(rule.value), rule.origin or rule.location)
        for rule in values_in(text, path)
    )
