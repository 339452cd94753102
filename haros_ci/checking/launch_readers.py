# SPDX-License-Identifier: Apache-2.0
"""Python code that loads launch files itself and asks for their arguments: a tool with windows that shows them, a program that starts launch files."""

from __future__ import annotations

import re
from collections.abc import Iterable

from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: What loads a launch file, and what asks for its arguments or has all of them.
_LOADS = regex(
    r"\bget_launch_description_from_\w+|\bParser\.load\b|\bParser\.parse_description\b|\bAnyLaunchDescriptionSource\b"
    r"|\broslaunch\.(?:xmlloader|config|arg_dump)\b|\bXmlLoader\b|\bROSLaunchConfig\b|\bload_config_default\b"
)
_ASKS = regex(
    r"\blaunch_configurations\b|\bget_launch_arguments\w*|\bDeclareLaunchArgument\b|\b(?:dump|get)_args\b"
    r"|\broslaunch\.(?:xmlloader|arg_dump)\b|\bXmlLoader\b|\bROSLaunchConfig\b|\bload_config_default\b"
)
#: What is itself a launch file: it includes others and passes what they need.
_LAUNCH = regex(r"^def[ \t]+generate_launch_description\b", re.MULTILINE)
#: Where a launch file in Python declares an argument.
_DECLARED = regex(r"""\bDeclareLaunchArgument\s*\(\s*(?:name\s*=\s*)?["']\w+["']""")
_TEXT = regex(r"""["']([A-Za-z_]\w*)["']""")


@dataclass(frozen=True, slots=True)
class LaunchReaders:
    """By the directory of a package: whether code there reads the arguments of launch files that it loads, and the names in quotes beside such code.

    *texts* are those of all files that do.
    """

    folders: frozenset[str]
    names: frozenset[tuple[str, str]]
    texts: tuple[str, ...]

    def may_read(self, name: str, folder: str, file: str) -> bool:
        """Whether code may read the argument *name* of the launch *file* of the package in *folder*."""
        if folder in self.folders or (folder, name) in self.names:
            return True
        return any(file in text for text in self.texts)


def launch_readers(workspace: Workspace | None) -> LaunchReaders:
    """What the Python files of *workspace* do with launch files."""
    homes: set[str] = set()
    asking: set[str] = set()
    texts: list[str] = []
    files = [file for file in workspace.files if file.path.endswith(".py")] if workspace is not None else []
    roots = {package.name: package.path for package in workspace.packages} if workspace is not None else {}
    for file in files:
        text = workspace.text(file.path) if workspace is not None else ""
        folder = roots.get(file.package or "")
        if folder is None or not _ASKS.search(text):
            continue
        if not _LAUNCH.search(text) and _LOADS.search(text):
            homes.add(folder)
            texts.append(text)
        if "launch_configurations" in text or "get_launch_arguments" in text:
            asking.add(folder)
    names = {
        (roots[file.package], name)
        for file in files
        if workspace is not None and file.package is not None and roots.get(file.package) in asking
        for name in _names(workspace.text(file.path))
    }
    return LaunchReaders(frozenset(homes), frozenset(names), tuple(texts))


def _names(text: str) -> Iterable[str]:
    """The names in quotes, but for those that launch files declare or pass."""
    return _TEXT.findall(
        "" if _LAUNCH.search(text) and "launch_configurations" not in text else _DECLARED.sub("", text)
    )
