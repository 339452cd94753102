# SPDX-License-Identifier: Apache-2.0
"""What reads the YAML files of a workspace besides nodes: descriptions of robots and programs that load them themselves."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from haros_ci.checking.whole import CODE, LAUNCH_FILES
from haros_ci.regex import regex

if TYPE_CHECKING:
    from haros_ci.checking.given import Given
    from haros_ci.checking.system import System

_DESCRIPTIONS = (".xacro", ".urdf", ".sdf")
#: Calls that load a YAML file: of xacro, PyYAML, ruamel and yaml-cpp.
_LOADS = regex(r"\bload_yaml\s*\(|\byaml\.(?:\w+_)?load(?:_all)?\s*\(|\bYAML::Load(?:File)?\s*\(|\bYAML\s*\(")


def readers(system: System) -> tuple[tuple[bool, str], ...]:
    """The texts of files that load YAML, each with whether it is a launch file, which may only hand the values to nodes."""
    workspace = system.workspace
    if workspace is None:
        return ()
    found = []
    for path in sorted(file.path for file in workspace.files):
        if path.endswith((*CODE, *_DESCRIPTIONS)):
            text = workspace.text(path)
            if ("yaml" in text or "YAML" in text) and _LOADS.search(text):
                found.append((path.endswith(LAUNCH_FILES), text))
    return tuple(found)


def is_read_besides(system: System, parameter: Given) -> bool:
    """Whether something else may read the value from its YAML file: it loads YAML, and names the file or the key.

    A launch file that names the file alone gives it to nodes.
    """
    if not parameter.at.path.endswith((".yaml", ".yml")) or parameter.at.path.endswith(LAUNCH_FILES):
        return False
    name = parameter.at.path.rpartition("/")[2]
    last = parameter.key.rpartition(".")[2]
    keys = (f"'{last}'", f'"{last}"')
    return any(
        (not is_launch and re.search(rf"(?<![\w.-]){re.escape(name)}\b", text) is not None)
        or any(key in text for key in keys)
        for is_launch, text in system.whole.yaml_readers
    )
