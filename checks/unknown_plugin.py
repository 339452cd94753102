# SPDX-License-Identifier: Apache-2.0
"""Parameters and code that name a plug-in which no description of its package exports."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.api import Check, Finding, Level, Location, Project, dataclass, is_slip, regex
from haros_ci.api.packages import (
    PLUGIN_NAME,
    Build,
    Element,
    PluginUse,
    Unlisted,
    plugins_in_parameters,
    plugins_in_yaml,
    unlisted_plugins,
)

_CREATE = regex(rf'\bcreate(?:Unique|Shared|Unmanaged)?Instance\s*\(\s*"({PLUGIN_NAME})"')

#: Remarks on what is not written yet.
_TO_DO = regex(r"(?:<!--|#|//)[^\n]*?\b(?:TODO|FIXME|XXX|PLACEHOLDER)\b", re.IGNORECASE)


@dataclass(slots=True)
class _LookupNames:
    """The look-up names of the workspace: each with its place; by their namespaces; the packages that export them."""

    names: dict[str, Location]
    spaces: dict[str, list[str]]
    owners: dict[str, set[str]]
    #: Those that containers load, and nobody as a part of a robot.
    components: set[str]
    #: Those of released packages that are not here.
    outside: dict[str, list[str]]

    @classmethod
    def of(cls, project: Project) -> _LookupNames:
        names: dict[str, Location] = {}
        spaces: dict[str, list[str]] = {}
        owners: dict[str, set[str]] = {}
        components: set[str] = set()
        for package in project.packages:
            for plugin in package.build.plugins:
                for name in {plugin.name, plugin.type} if "NodeFactory" in plugin.base else {plugin.name}:
                    names.setdefault(name, plugin.location)
                    if "NodeFactory" in plugin.base:
                        components.add(name)
                    space = _plain(name).rpartition("::")[0]
                    spaces.setdefault(space, []).append(name)
                    owners.setdefault(space, set()).add(package.name)
        outside: dict[str, list[str]] = {}
        for name in project.knowledge.plugin_names():
            space = _plain(name).rpartition("::")[0]
            if space not in spaces:
                outside.setdefault(space, []).append(name)
        return cls(names, spaces, owners, components, outside)


def check(project: Project) -> Iterator[Finding]:
    known = _LookupNames.of(project)
    vague = {package.name for package in project.packages if _is_vague(package.build)}
    by_plain = {_plain(name): name for name in known.names}
    reported: set[tuple[Location, str]] = set()
    left: dict[str, Mapping[int, Unlisted]] = {}
    for use in _uses(project):
        if use.name in known.names or (use.location, use.name) in reported:
            continue
        released = _released(use, known)
        if released:
            reported.add((use.location, use.name))
            yield _of_elsewhere(use, released)
            continue
        meant = _meant(use, known, by_plain)
        if meant is None or known.owners.get(_plain(meant or use.name).rpartition("::")[0], set()) & vague:
            continue
        reported.add((use.location, use.name))
        path = use.location.path
        if path not in left:
            left[path] = unlisted_plugins(project.text(path)) if path.endswith((".yaml", ".yml")) else {}
        found = _finding(use, meant, known, left[path].get(use.location.line or 0))
        yield found if meant else _of_placeholder(found, project)


def _meant(use: PluginUse, known: _LookupNames, by_plain: Mapping[str, str]) -> str | None:
    """The exported name that is meant, "" if none is like it; None if the name may be right, or none of a plug-in.

    Separators are part of a look-up name. Otherwise its namespace has to be a package's that exports plug-ins, all of which
    are known then; where the key does not say that a plug-in is named, it has to be a slip for an exported one, too.
    """
    plain = _plain(use.name)
    if plain in by_plain:
        return by_plain[plain]
    space, _, last = plain.rpartition("::")
    inside = known.spaces.get(space, [])
    alike = sorted(name for name in inside if is_slip(_plain(name).rpartition("::")[2], last))
    if alike:
        return alike[0]
    if use.is_sure and space in known.owners.get(space, ()):
        return ""
    return None


def _released(use: PluginUse, known: _LookupNames) -> str:
    """The plug-in of a released package for which *use* is a slip; "" if it is none of any, or one itself.

    The list of released ones may lack new ones, and packages changed separators: only a slip in the last part counts.
    """
    space, _, last = _plain(use.name).rpartition("::")
    names = known.outside.get(space, [])
    if any(_plain(name) == _plain(use.name) for name in names):
        return ""
    alike = {_plain(name): name for name in sorted(names) if is_slip(_plain(name).rpartition("::")[2], last)}
    if len(alike) != 1:
        return ""
    meant = next(iter(alike))
    return meant.replace("::", "/") if "/" in use.name and meant.replace("::", "/") in names else alike[meant]


def _of_elsewhere(use: PluginUse, meant: str) -> Finding:
    return Finding(
        at=use.location,
        message=f"no released package is known to export a plug-in {use.name}: loading {use.key} fails; did you mean "
        f"{meant}?",
        about=(use.name, use.key),
        level=Level.WARNING,
        apart=(use.name,),
    )


def _finding(use: PluginUse, meant: str, known: _LookupNames, unlisted: Unlisted | None) -> Finding:
    owners = sorted(known.owners.get(_plain(meant or use.name).rpartition("::")[0], ()))
    if meant and _plain(meant) == _plain(use.name):
        hint = f"it is exported as {meant}; write the same name"
    elif meant:
        hint = f"did you mean {meant}?"
    else:
        names = sorted({*known.spaces[_plain(use.name).rpartition("::")[0]]} - known.components)
        hint = f"there are {', '.join(names[:3])}" + (" and more" if len(names) > 3 else "")
        hint = hint if names else "the package has components alone: write the name of a plug-in, or export this one"
    effect = f": loading {use.key} fails"
    if unlisted is not None:
        effect = (
            f", and {unlisted.key} (line {unlisted.line}) does not name {unlisted.section}, so that nothing loads it"
        )
        hint = f"remove the section {unlisted.section}, or mend both; {hint}"
    return Finding(
        at=use.location,
        message=f"no plug-in description of package {owners[0]} exports {use.name}{effect}; {hint}",
        level=None if unlisted is None else Level.NOTE,
        about=(use.name, use.key),
        related=((known.names[meant], f"{meant} is exported here"),) if meant else (),
        apart=(use.name,),
    )


def _of_placeholder(finding: Finding, project: Project) -> Finding:
    """*finding*; a note where a comment in the line, or in the one above it, says that something is still to be done."""
    at = finding.at
    lines = project.text(at.path).split("\n")[max((at.line or 1) - 2, 0) : at.line or 1]
    if not any(_TO_DO.search(line) for line in lines):
        return finding
    message = f"{finding.message} (a comment says that this is still to be done)"
    return replace(finding, message=message, level=Level.NOTE)


def _plain(name: str) -> str:
    return name.replace("/", "::")


def _is_vague(build: Build) -> bool:
    """Whether a package has descriptions that could not be read."""
    words = ("plug-in description", "its classes are missing", "the component is missing", "<class> without type")
    return any(word in problem.message for problem in build.problems for word in words)


def _uses(project: Project) -> Iterator[PluginUse]:
    """Where plug-ins are named: YAML files, parameters of launch files, hardware of robots, calls of loaders."""
    for file in project.workspace.files:
        if file.language == "yaml":
            yield from plugins_in_yaml(file.path, project.text(file.path))
    yield from plugins_in_parameters(project.systems)
    for package in project.packages:
        if "pluginlib" in package.declared:
            for file in package.files:
                if file.language == "cpp":
                    text = project.text(file.path)
                    for match in _CREATE.finditer(text) if "Instance" in text else ():
                        place = Location(file.path, text.count("\n", 0, match.start(1)) + 1)
                        yield PluginUse(match[1], place, "the loader", True)
        for file in package.files:
            if file.path.endswith((".urdf", ".xacro")) and "<hardware>" in project.text(file.path):
                root = project.element(file.path)
                yield from _in_robot(file.path, root) if root is not None else ()


def _in_robot(path: str, root: Element) -> Iterator[PluginUse]:
    """``<hardware><plugin>package/Class</plugin></hardware>`` of ros2_control."""
    waiting = [root]
    while waiting:
        element = waiting.pop()
        for child in element.all("plugin") if element.tag == "hardware" else ():
            name = child.text.strip()
            if re.fullmatch(PLUGIN_NAME, name):
                yield PluginUse(name, Location(path, child.line), "<hardware>", True)
        waiting += element.children


CHECK = Check(
    id="unknown-plugin",
    summary="Plug-in name that no package exports.",
    level=Level.ERROR,
    catalogue="P13",
    tags=("parameters", "plugins"),
    project=check,
)
