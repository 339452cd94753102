# SPDX-License-Identifier: Apache-2.0
"""Facts of ROS 1 launch files, recorded while their tags are evaluated."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from haros_ci.graph.words import split
from haros_ci.launch.facts.texts import (
    absolute_paths,
    is_file_name,
    named_files,
    named_packages,
    package_run,
    without_comments,
)
from haros_ci.launch.ros1.dialect import foreign_constructs
from haros_ci.model.launch_facts import (
    ArgumentDeclaration,
    ArgumentRead,
    CommandUse,
    Comparison,
    ConditionUse,
    ConstructUse,
    FileUse,
    IncludeUse,
    LaunchFact,
    PackageUse,
    PassedArgument,
    PathUse,
    ProgramUse,
)
from haros_ci.model.location import Location
from haros_ci.model.slips import equally_near
from haros_ci.regex import regex
from haros_ci.substitutions.names import Text

if TYPE_CHECKING:
    from haros_ci.launch.ros1.scope import LoaderScope
    from haros_ci.launch.ros1.state import RoslaunchState
    from haros_ci.model.launch import LaunchElement, LaunchFile, Started

#: What the attributes of tags name, by tag and attribute.
_KINDS: Mapping[tuple[str, str], str] = {
    ("include", "file"): "include",
    ("rosparam", "file"): "parameters",
    ("param", "textfile"): "text",
    ("param", "binfile"): "text",
    ("param", "value"): "value",
    ("param", "command"): "value",
    ("node", "args"): "value",
    ("test", "args"): "value",
    ("node", "launch-prefix"): "value",
    ("arg", "value"): "value",
    ("arg", "default"): "default",
    ("env", "value"): "value",
}
_ARG = regex(r"\$\(arg\s+([^\s)]+)\s*\)")
_COMPARED = regex(r"(?:\barg\(\s*['\"]([\w/]+)['\"]\s*\)|(?<![\w.'\"])([A-Za-z_]\w*))\s*(==|!=)\s*(['\"])([^'\"]*)\4")


def note(
    state: RoslaunchState, scope: LoaderScope, fact: type[LaunchFact], location: Location, /, **values: Any
) -> None:
    """Record a *fact* of this kind as it is here."""
    if not getattr(state, "is_asking", False):
        presence = getattr(scope, "presence", ())
        state.facts.add(fact(location=location, presence=presence, included=scope.includes, ros=1, **values))


def place(scope: LoaderScope, tag: LaunchElement) -> Location:
    return Location(scope.path, tag.line, tag.column)


def ignored(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, parent: str = "") -> None:
    """A *tag* that roslaunch passes over with a warning: inside of the tag *parent*, which takes others, or, without one, as it knows none of the name."""
    note(state, scope, ConstructUse, place(scope, tag), kind="ignored", text=tag.tag, instead=parent, stops=False)


def attribute(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: str, text: Text) -> None:
    """Files, packages and absolute paths that an attribute of *tag* names."""
    kind = _KINDS.get((tag.tag, name))
    if kind is None or ("/" not in text.raw and "$(" not in text.raw and not text.raw.startswith("~")):
        return
    if tag.tag == "rosparam" and (tag.get("command") or "load") != "load":
        return
    at = place(scope, tag)
    called = tag.get("name") or name if tag.tag in ("param", "arg", "env") else name
    raw = without_comments(text.raw)
    for package in named_packages(raw):
        note(state, scope, PackageUse, at, kind="find", package=package, is_here=False)
        if kind == "include":
            note(state, scope, PackageUse, at, kind="include", package=package, is_here=False)
    for path, is_whole in named_files(raw):
        if is_whole and is_file_name(path):
            note(state, scope, FileUse, at, kind=kind, text=path, name=called, chosen=text.chosen)
    for how, path in absolute_paths(raw, kind in ("include", "parameters", "text")):
        note(state, scope, PathUse, at, kind=how, text=path, name=called)


def command(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, text: Text) -> None:
    """A command whose output becomes a parameter."""
    note(state, scope, CommandUse, place(scope, tag), text=text.shown)
    if package := package_run(text.shown):
        note(state, scope, PackageUse, place(scope, tag), kind="command", package=package, is_here=False)


def undeclared(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, raw: str) -> None:
    """Each ``$(arg x)`` in *raw* that is not declared above it: roslaunch stops there."""
    for match in _ARG.finditer(raw):
        name = match[1]
        if name not in scope.args and name not in scope.missing:
            known = sorted({*scope.args, *scope.missing})[:100]
            similar = equally_near(name, known, 0.7) if len(state.facts.found) < 5_000 else ()
            is_undecided = bool(scope.conditions) or (tag.get("if") or tag.get("unless") or raw) != raw
            note(
                state,
                scope,
                ArgumentRead,
                place(scope, tag),
                name=name,
                similar=similar,
                is_undecided=is_undecided,
            )


def declared(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, name: str) -> None:
    """An ``<arg>``; it is used if its file reads it, as args are not seen in other files."""
    default = tag.get("default") if tag.get("default") is not None else tag.get("value")
    note(
        state,
        scope,
        ArgumentDeclaration,
        place(scope, tag),
        name=name,
        default=default,
        is_used=_is_used(state, scope.path, name),
        is_top=not scope.includes,
    )


def _is_used(state: RoslaunchState, path: str, name: str) -> bool | None:
    texts = state.facts.texts
    if path not in texts:
        text = state.files.workspace.text(path)
        doubtful = "pass_all_args" in text or "subst_value" in text or "$(eval" in text
        texts[path] = (frozenset(_ARG.findall(text)), doubtful)
    read, doubtful = texts[path]
    if name in read:
        return True
    return None if doubtful else False


def tested(
    state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, statement: str, text: Text, holds: bool | None
) -> None:
    """The ``if`` or ``unless`` of *tag*."""
    raw = tag.get(statement) or ""
    found = []
    if raw.startswith("$(eval"):
        for match in _COMPARED.finditer(raw):
            name = match[1] or match[2]
            value = scope.args.get(name)
            values = (value.raw,) if value is not None and value.known else ()
            if name in scope.args:
                found.append(Comparison(name, match[5], values, match[3], is_quoted=False))
    note(
        state,
        scope,
        ConditionUse,
        place(scope, tag),
        statement=statement,
        text=raw,
        value=holds if text.known else None,
        is_constant="$" not in raw,
        comparisons=tuple(found),
    )


def included(
    state: RoslaunchState,
    scope: LoaderScope,
    tag: LaunchElement,
    file: Text,
    path: str | None = None,
    passed: Iterable[str] = (),
    declares: Iterable[str] = (),
    is_whole: bool = False,
) -> None:
    """An ``<include>`` once its file has been evaluated; *passed* are the args that it names."""
    at = place(scope, tag)
    children = {child.get("name"): place(scope, child) for child in tag.children if child.tag == "arg"}
    missing = tuple(sorted(state.facts.absent.pop((at, path or ""), ())))
    note(
        state,
        scope,
        IncludeUse,
        at,
        text=file.shown,
        path=path,
        passed=tuple(PassedArgument(name, children.get(name, at)) for name in passed),
        declared=tuple(sorted(declares)),
        missing=missing,
        is_whole=is_whole,
    )


def started(state: RoslaunchState, scope: LoaderScope, made: Started) -> None:
    """A ``<node>`` or ``<test>``."""
    if "?" in made.package or "?" in made.type:
        return
    note(state, scope, PackageUse, made.location, kind="node", package=made.package, is_here=False)
    note(state, scope, ProgramUse, made.location, kind="executable", package=made.package, program=made.type)
    if (made.package, made.type) == ("nodelet", "nodelet"):
        words = split(made.arguments).rest
        if len(words) > 1 and words[0] in ("load", "standalone") and "/" in words[1] and "?" not in words[1]:
            package = words[1].partition("/")[0]
            note(state, scope, ProgramUse, made.location, kind="nodelet", package=package, program=words[1])


def foreign(state: RoslaunchState, scope: LoaderScope | None, path: str, launch: LaunchFile) -> None:
    """Constructs of ROS 2 in the file at *path*; of ROS 1, if its package is of ROS 2. *scope* is that of its include."""
    included = scope.includes if scope is not None else ()
    owner = max(
        (
            package
            for package in state.files.workspace.packages
            if package.path == "." or path.startswith(package.path + "/")
        ),
        key=lambda package: len(package.path),
        default=None,
    )
    native = 2 if owner is not None and owner.ros == 2 else 1
    for found in foreign_constructs(launch, path, native):
        fact = ConstructUse(
            location=found.location,
            included=included,
            ros=1,
            kind="foreign",
            text=found.text,
            instead=found.instead,
            stops=found.stops,
            matters=found.matters,
        )
        state.facts.add(fact)
