# SPDX-License-Identifier: Apache-2.0
"""Files that launch files name, and that their packages do not have."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from haros_ci.api import Check, Finding, Level, System, regex
from haros_ci.api.launch import (
    FileUse,
    ParameterFileUse,
    included_by,
    is_end_of_longer,
    is_undeclared_value,
    is_unread_argument,
    meant,
    unread_parameter,
)
from haros_ci.api.packages import entries_of, is_ignored, writer_of

#: Files that nodes read; of others they may be the ones who write them.
_READ = regex(r"\.(ya?ml|rviz|urdf|xacro|sdf|srdf|world|launch|launch\.\w+|py|lua|perspective|stl|dae|vcg)$", re.I)
_WRITES = regex(r"output|save|write|dump|record|store|cache|result|calibrat|camera_info|log", re.I)
#: Endings of templates that a launch file in Python may expand.
_TEMPLATES = (".em", ".in", ".erb", ".j2", ".jinja", ".jinja2", ".mako", ".template", ".tmpl", ".tpl")
#: An argument in a path, what stands for it, and what ends one part of a path.
_MARK = "\0"
_PART = regex(r"[\s\"'()$/]+")
_ARGUMENT = regex(r"\$\((?:arg|var)[ \t]+[\w-]+[ \t]*\)")
#: What begins the rest of a name, behind an argument.
_SEPARATORS = ("_", "-", ".")
#: What a launch file in Python opens to write it, and a variable that is given something.
_WRITTEN = regex(
    r"\bopen\([ \t]*(\w+)[ \t]*,[ \t]*(?:mode[ \t]*=[ \t]*)?[\"'][wx]|\bopen_output\([ \t]*(\w+)[ \t]*\)|\b(\w+)\.write_(?:text|bytes)\("
    r"|\bPath\([ \t]*(\w+)[ \t]*\)\.write_(?:text|bytes)\("
)
_GIVEN = regex(r"^[ \t]*(\w+)[ \t]*=([^=\n][^\n(]{0,200}(?:\([^()]{0,400}\))?[^\n]*)", re.MULTILINE)
_TEXT = regex(r"[\"']([^\"'\n]+)[\"']")
#: A value of an environment variable stands at most so often in the name of a file.
_VALUES = 3
#: So many places of one finding are shown.
_SHOWN = 10
_UNKNOWN = "; correct the path, or add the file"
_WHAT = {
    "include": "the launch file includes",
    "parameters": "the launch file loads parameters from",
    "text": "the launch file reads",
    "value": "the launch file names",
}


def check(system: System) -> Iterator[Finding]:
    # Parameter files of ROS 2 nodes are reported by parameter-file-missing, also at the argument that names them.
    reported = {use.text for use in system.facts(ParameterFileUse) if use.is_found is False and use.ros == 2}
    lost: dict[tuple[object, ...], list[tuple[FileUse, str]]] = {}
    folders = entries_of(system.workspace.names) if system.workspace is not None and system.workspace.names else ()
    for use in system.facts(FileUse):
        if use.is_found is not False or use.text in reported:
            continue
        if (use.kind == "parameters" and use.ros == 2) or _is_without_name(system, use) or _is_written(system, use):
            continue
        if use.kind in ("value", "default") and (
            not _READ.search(use.inner) or _WRITES.search(f"{use.name} {use.inner}")
        ):
            continue
        reported.add(use.text)
        made = _made(system, use)
        # files in one directory that is not there are one slip of a launch file
        folder = "" if made else _lost_folder(use, folders)
        key: tuple[object, ...] = (
            (use.location.path, use.package, folder, use.presence, use.included) if folder else (use,)
        )
        lost.setdefault(key, []).append((use, made))
    for key, group in lost.items():
        if len(group) > 1:
            yield _several([use for use, _ in group], str(key[2]))
        else:
            yield _finding(*group[0])


def _is_without_name(system: System, use: FileUse) -> bool:
    """Whether the name of the file has an argument in it that is empty: whoever starts the launch file is to give it."""
    text = system.workspace.text(use.location.path) if system.workspace is not None else ""
    base = use.inner.rpartition("/")[2]
    names = _PART.split(_ARGUMENT.sub(_MARK, text))
    return any(_MARK in name and name.replace(_MARK, "") == base for name in names) or (
        base[:1] in _SEPARATORS and is_end_of_longer(text, base)
    )


def _made(system: System, use: FileUse) -> str:
    """Why another file may be used, or why this one may be made elsewhere; "" if nothing says so."""
    if system.workspace is None or use.path is None:
        return ""
    if use.ros == 1 and use.kind in ("value", "default"):
        if name := unread_parameter(system, use.location.path, use.name):
            return f"; no code of the workspace has the name of the parameter {name!r} that alone is given it: remove the argument and the parameter"
    if is_undeclared_value(system, use):
        return f"; no node that is given it declares the parameter {use.name!r}: remove it"
    if use.ros == 2 and use.kind == "default" and is_unread_argument(system, use.location.path, use.name):
        return f"; nothing here reads the argument {use.name!r}: remove it, or correct the path where a launch file of elsewhere reads it"
    if _is_chosen(system, use):
        return f"; the environment variable {use.chosen.partition('=')[0]} names one that does where it is set"
    if is_ignored(system.workspace, use.path):
        return "; .gitignore names it, so that it may be made elsewhere"
    if use.kind == "include":
        return ""  # programs write no launch files
    if template := _template(system, use):
        return f"; {template} beside it is a template of it, which the launch file names, too, so that it may be made when this is started"
    writer = writer_of(system, use.path)
    return f"; {writer} writes a file of this name, so that it may be made at run time" if writer else ""


def _is_written(system: System, use: FileUse) -> bool:
    """Whether the launch file, in Python, opens the file to write it."""
    text = system.workspace.text(use.location.path) if system.workspace is not None else ""
    names = {name for found in _WRITTEN.finditer(text) for name in found.groups() if name}
    ends = (end for name, value in _GIVEN.findall(text) if name in names for end in _TEXT.findall(value))
    return any(use.inner.endswith(end) for end in ends)


def _template(system: System, use: FileUse) -> str:
    """The base name of a template of the file (empy, CMake, ERB, Jinja, Mako) that lies beside it and that the launch file has in its text."""
    if system.workspace is None or not use.path:
        return ""
    text, base = system.workspace.text(use.location.path), use.path.rpartition("/")[2]
    made = (f"{base}{ending}" for ending in _TEMPLATES if f"{use.path}{ending}" in system.workspace.names)
    return next((name for name in made if name in text), "")


def _is_chosen(system: System, use: FileUse) -> bool:
    """Whether an environment variable names the file, and there is one for another value of it."""
    default = use.chosen.partition("=")[2]
    if not default or use.path is None or system.workspace is None or not 0 < use.path.count(default) <= _VALUES:
        return False
    other = re.compile("[^/]+".join(re.escape(part) for part in use.path.split(default)))
    return any(other.fullmatch(name) for name in system.workspace.names)


def _lost_folder(use: FileUse, folders: Collection[str]) -> str:
    """The highest directory above the file, inside its package, that does not exist; "" if there is none."""
    if use.path is None or not f"/{use.path}".endswith(f"/{use.inner}") or not folders:
        return ""
    path = use.path.removesuffix(use.inner)
    for part in use.inner.split("/")[:-1]:
        path += part
        if path not in folders:
            return path[len(use.path) - len(use.inner) :]
        path += "/"
    return ""


def _level(use: FileUse) -> Level | None:
    return None if use.kind in ("include", "parameters", "text") else Level.WARNING


def _several(uses: list[FileUse], folder: str) -> Finding:
    """One finding for *uses* of files below the directory *folder*, which their package does not have."""
    first, *others = sorted(uses, key=lambda use: (_level(use) is not None, use.location.sort_key))
    more = f" and {len(others)} more files" if len(others) > 1 else f" and {others[0].inner}"
    return Finding(
        at=first.location,
        message=f"{_what(first)} {first.inner}{more} of {first.package}, but the package has no directory {folder}{meant(first.similar)}",
        about=(f"{first.package}/{folder}",),
        related=tuple((use.location, f"{_what(use)} {use.inner}") for use in others[:_SHOWN]),
        flow=included_by(first),
        apart=(folder,),
        level=_level(first),
        presence=first.presence,
    )


def _what(use: FileUse) -> str:
    return f"the default of {use.name!r} is" if use.kind == "default" else _WHAT[use.kind]


def _finding(use: FileUse, made: str) -> Finding:
    return Finding(
        at=use.location,
        message=f"{_what(use)} {use.inner} of {use.package}, but this file does not exist{made or meant(use.similar) or _UNKNOWN}",
        about=(f"{use.package}/{use.inner}",),
        flow=included_by(use),
        apart=(use.text,),
        level=Level.NOTE if made else _level(use),
        presence=use.presence,
    )


CHECK = Check(
    id="missing-launch-file",
    summary="Reference of a launch file to a file that does not exist.",
    level=Level.ERROR,
    catalogue="L01",
    tags=("launch",),
    run=check,
)
