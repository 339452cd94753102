# SPDX-License-Identifier: Apache-2.0
"""yamllint on YAML files, with the workspace's .yamllint: what that extends or reads is taken from the workspace alone."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from posixpath import dirname, isabs, join, normpath, relpath
from typing import Any

from haros_ci.linters import settings_files, texts, yaml_settings
from haros_ci.linters.linter import Batch, Command, Finding, GaveUp, LintOptions, Output, Program, Unit, When
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace

NAME = "yamllint"
LANGUAGES = frozenset({"yaml", "launch"})
WHEN = When.ASKED
COST = 25.0

MARKS: settings_files.Marks = {".yamllint": (), ".yamllint.yaml": (), ".yamllint.yml": ()}
#: The configurations that come with yamllint ("Configuration").
SHIPPED = frozenset({"default", "relaxed", "empty"})
#: Where the workspace has no settings; True and False are booleans to every program that reads YAML for ROS.
BOOLEANS = ["true", "false", "True", "False", "TRUE", "FALSE"]
DEFAULT_SETTINGS = {"extends": "default", "rules": {"truthy": {"allowed-values": BOOLEANS, "level": "warning"}}}
#: How long a chain of ``extends`` may be.
LONGEST_CHAIN = 8
#: Files of patterns that one ``ignore-from-file`` may name, and lines of all of them.
MOST_FILES, MOST_LINES = 8, 10_000


def locate(options: LintOptions) -> Program | None:
    return texts.locate("yamllint", NAME)


def fingerprint(workspace: Workspace, options: LintOptions) -> str:
    return json.dumps([DEFAULT_SETTINGS])


def dependencies(workspace: Workspace, file: SourceFile) -> Iterable[str]:
    return ()  # plan() knows them


def plan(workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
    """Groups by configuration; a file depends on it and on all that it extends or reads patterns from."""
    needs: dict[str, tuple[str, ...]] = {"": ()}
    for unit in settings_files.units(workspace, LANGUAGES, MARKS):
        if not unit.file.path.endswith((".yaml", ".yml")):
            continue
        if unit.group not in needs:
            read: list[str] = []
            try:
                resolved(workspace, unit.group, read)
            except ValueError:
                pass  # command() says so
            needs[unit.group] = tuple(read)
        yield Unit(unit.file, group=unit.group, settings=needs[unit.group])


def command(program: Program, batch: Batch) -> Command:
    """Paths are given as yamllint would see them where the configuration lies, for its patterns begin there.

    ValueError for a configuration that cannot be followed: without it nothing is checked.
    """
    try:
        settings = resolved(batch.workspace, batch.group, []) if batch.group else DEFAULT_SETTINGS
    except ValueError as err:
        raise ValueError(f"{batch.group}: {err}") from err
    return texts.command(program, batch, settings, lambda path: relpath(path, dirname(batch.group) or "."))


def parse(output: Output, batch: Batch) -> Iterator[Finding | GaveUp]:
    return texts.parse(output, batch, NAME)


def resolved(workspace: Workspace, path: str, read: list[str]) -> dict[str, Any]:
    """The configuration at *path* with everything that it refers to in its place; *read* takes the paths of the files.

    Merging is yamllint's: the rules of the extended file first, a rule's own options over the extended ones. Raises
    ValueError for what is malformed, or refers to a file that is not in the workspace.
    """
    read.append(path)
    settings = yaml_settings.read(workspace.setting(path))
    settings.pop("locale", None)  # is the machine's
    rules = {name: _options(options) for name, options in _map(settings.get("rules")).items()}
    for where in (settings, *(options for options in rules.values() if isinstance(options, dict))):
        _take_patterns(workspace, where, dirname(path), read)
    base = settings.get("extends")
    if isinstance(base, str) and base not in SHIPPED:
        target = _inside(dirname(path), base)
        if not workspace.setting(target) or len(read) > LONGEST_CHAIN:
            raise ValueError(f"extends {base!r}, which is no file of the workspace, or one too many")
        under = resolved(workspace, target, read)
        settings = {**{key: value for key, value in under.items() if key == "ignore"}, **settings}
        settings.pop("extends")
        if "extends" in under:
            settings["extends"] = under["extends"]
        rules = {
            **under["rules"],
            **{name: _over(under["rules"].get(name), options) for name, options in rules.items()},
        }
    return {**settings, "rules": rules}


def _take_patterns(workspace: Workspace, where: dict[str, Any], directory: str, read: list[str]) -> None:
    """Puts the lines of the files that ``ignore-from-file`` names in place of the names; one that is not there has none."""
    names = where.pop("ignore-from-file", None)
    if names is None:
        return
    lines: list[str] = []
    files = [names] if isinstance(names, str) else names if isinstance(names, list) else []
    if len(files) > MOST_FILES:
        raise ValueError(f"ignore-from-file names more than {MOST_FILES} files")
    for name in files:
        read.append(_inside(directory, str(name)))
        lines += workspace.setting(read[-1]).splitlines()
    if len(lines) > MOST_LINES:
        raise ValueError(f"more than {MOST_LINES} patterns to ignore")
    where["ignore"] = lines


def _inside(directory: str, name: str) -> str:
    path = normpath(join(directory, name))
    if isabs(path) or path.split("/")[0] == "..":
        raise ValueError(f"refers to {name!r}, which lies outside the workspace")
    return path


def _options(value: object) -> Any:
    return {"enable": {}, "disable": False}.get(value, value) if isinstance(value, str) else value


def _over(under: object, options: object) -> object:
    return {**under, **options} if isinstance(under, dict) and isinstance(options, dict) else options


def _map(value: object) -> dict[str, Any]:
    if value is not None and not isinstance(value, dict):
        raise ValueError("rules is not a map")
    return value or {}
