# SPDX-License-Identifier: Apache-2.0
"""From the names of modules to plug-ins: imported, and looked at before anything of them is used."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import import_module
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any, NoReturn

from haros_ci.checking.check import API_VERSION, Check
from haros_ci.checking.page import SECTIONS, read_page
from haros_ci.errors import UserError
from haros_ci.linters.linter import Linter
from haros_ci.model.api import Row, RowError, load_row
from haros_ci.plugins.guard import GuardedLinter, guarded_check, guarded_renderer
from haros_ci.plugins.place import digest, failed, located
from haros_ci.plugins.plugin import Plugin, Renderer
from haros_ci.plugins.stdout import kept_clean
from haros_ci.regex import regex
from haros_ci.results.rule import Rule

#: What a module may offer.
OFFERS = ("CHECKS", "LINTERS", "API_ROWS", "RENDERERS")
_NAME = regex(r"[^\W\d]\w*(\.[^\W\d]\w*)*", re.ASCII)
_ID = regex(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_TOOL = regex(r"[a-z][a-z0-9]*([_-][a-z0-9]+)*")
_METHODS = ("locate", "fingerprint", "dependencies", "command", "parse")
_ATTRIBUTES = tuple(Linter.__annotations__)


@cache
def load(names: tuple[str, ...], root: Path) -> tuple[Plugin, ...]:
    """The plug-ins called *names*, none of them from the workspace at *root*; UserError if one is no plug-in."""
    return tuple(_plugin(name, root) for name in names)


def _plugin(name: str, root: Path) -> Plugin:
    if not _NAME.fullmatch(name):
        raise UserError(f"plug-in {name!r}: not the name of a module", help="name it as 'import' does: package.module")
    if name.partition(".")[0] == "haros_ci":
        raise UserError(f"plug-in {name}: it is part of haros-ci", help="name a module of your own")
    spec = located(name, root)
    try:
        with kept_clean():
            module = import_module(name)
    except (Exception, SystemExit) as err:
        raise failed(name, err) from err
    return _looked_at(module, spec)


def _looked_at(module: ModuleType, spec: ModuleSpec) -> Plugin:
    """What *module* offers, each thing of the kind that it has to be."""
    name = module.__name__
    offered = {key: getattr(module, key) for key in OFFERS if hasattr(module, key)}
    if not offered:
        _refuse(name, f"it offers none of {', '.join(OFFERS)}", "see docs/plugins.md")
    _demand_api(name, getattr(module, "REQUIRES_API", API_VERSION))
    made = digest(spec)
    checks = tuple(_check(name, item) for item in _listed(name, "CHECKS", offered))
    linters = tuple(_linter(name, item) for item in _listed(name, "LINTERS", offered))
    version = getattr(module, "__version__", "")
    return Plugin(
        name=name,
        version=version if isinstance(version, str) else "",
        digest=made,
        checks=tuple(guarded_check(check) for check in checks),
        pages={check.id: _page(check, module) for check in checks},
        linters=tuple(GuardedLinter(linter, f"{name} {made}") for linter in linters),
        rules={linter.NAME: _rules(name, linter) for linter in linters},
        rows=tuple(_row(name, number, row) for number, row in enumerate(_listed(name, "API_ROWS", offered), 1)),
        renderers=_renderers(name, offered.get("RENDERERS", {})),
    )


def _demand_api(name: str, needs: object) -> None:
    """Refuse what was made for an API that this one is not, and say what has changed since."""
    mine = ".".join(map(str, API_VERSION))
    if not isinstance(needs, tuple) or not needs or not all(isinstance(number, int) for number in needs):
        _refuse(name, f"REQUIRES_API is {needs!r}", f"write the API as a tuple of numbers: {API_VERSION}")
    if needs[0] == API_VERSION[0] and needs <= API_VERSION:
        return
    fault = f"it is made for the API {'.'.join(map(str, needs))}; this is {mine}"
    if needs[0] != 1:
        _refuse(name, fault, "take a plug-in and a haros-ci that fit")
    _refuse(
        name,
        f"{fault}, where the code of a program is typed nodes (haros_ci.api.syntax) in place of tuples",
        f"adapt it as 'From API 1 to 2' in docs/plugins.md says, then write REQUIRES_API = {API_VERSION}",
    )


def _listed(name: str, key: str, offered: Mapping[str, Any]) -> tuple[Any, ...]:
    value = offered.get(key, ())
    if not isinstance(value, (tuple, list)):
        _refuse(name, f"{key} is a {type(value).__name__}", f"make {key} a tuple")
    return tuple(value)


def _check(name: str, value: object) -> Check:
    if not isinstance(value, Check):
        _refuse(name, f"CHECKS has a {type(value).__name__}", "fill it with haros_ci.api.Check(...)")
    if not isinstance(value.id, str) or not _ID.fullmatch(value.id):
        _refuse(name, f"the id of a check is {value.id!r}", "use lower-case words joined by hyphens")
    if (value.run is None) == (value.project is None):
        _refuse(name, f"check {value.id}: it has not one of 'run' and 'project'", "give it exactly one")
    for key, kind in (("aliases", tuple), ("tags", tuple), ("summary", str), ("catalogue", str)):
        if not isinstance(getattr(value, key), kind):
            _refuse(name, f"check {value.id}: '{key}' is no {kind.__name__}", "correct it")
    return value


def _page(check: Check, module: ModuleType) -> str:
    """The text of a check's page: from PAGES, or the file beside the module that the check stands in."""
    name, file = module.__name__, check.id.replace("-", "_") + ".md"
    pages = getattr(module, "PAGES", {})
    text = pages.get(check.id) if isinstance(pages, Mapping) else None
    if text is None:
        look: Any = check.run or check.project
        homes = (sys.modules.get(getattr(look, "__module__", "")), module)
        places = [Path(home).parent / file for home in (getattr(home, "__file__", None) for home in homes) if home]
        text = next((place.read_text(encoding="utf-8") for place in places if place.is_file()), None)
    if not isinstance(text, str):
        _refuse(name, f"check {check.id} has no page", f"put {file} beside its module, or its text into PAGES")
    page = read_page(text)
    if page.title != check.id or page.sections != SECTIONS:
        _refuse(name, f"the page of check {check.id} is not made as pages are", "see docs/adding-a-check.md")
    return text


def _linter(name: str, value: Any) -> Linter:
    tool = getattr(value, "NAME", None)
    if not isinstance(tool, str) or not _TOOL.fullmatch(tool):
        _refuse(name, f"the NAME of a linter is {tool!r}", "give the adapter a NAME in lower case")
    lacks = [attribute for attribute in _ATTRIBUTES if not hasattr(value, attribute)]
    lacks += [method for method in _METHODS if not callable(getattr(value, method, None))]
    if lacks:
        _refuse(name, f"linter {tool}: it has no {', '.join(lacks)}", "see haros_ci.api.linters.Linter")
    return value  # type: ignore[no-any-return]  # what the plug-in has, looked at above


def _rules(name: str, linter: Linter) -> dict[str, Rule]:
    rules = getattr(linter, "RULES", ())
    if not isinstance(rules, (tuple, list)) or not all(isinstance(rule, Rule) for rule in rules):
        _refuse(name, f"linter {linter.NAME}: RULES are not rules", "make it a tuple of haros_ci.api.linters.Rule")
    return {rule.id: rule for rule in rules}


def _row(name: str, number: int, row: object) -> Row:
    try:
        if not isinstance(row, Mapping):
            raise RowError("a row is a mapping with a 'call'")
        return load_row(row)
    except RowError as err:
        _refuse(name, f"row {number} of API_ROWS: {err}", "see docs/adding-an-api.md")


def _renderers(name: str, value: object) -> dict[str, Renderer]:
    if not isinstance(value, Mapping):
        _refuse(name, f"RENDERERS is a {type(value).__name__}", "make it a mapping from a format's name to a function")
    made: dict[str, Renderer] = {}
    for format, render in value.items():
        if not isinstance(format, str) or not _TOOL.fullmatch(format) or not callable(render):
            _refuse(name, f"RENDERERS has {format!r}", "name formats in lower case, each with a function of a Report")
        made[format] = guarded_renderer(format, name, render)
    return made


def without_clashes(
    plugins: Iterable[Plugin],
    *,
    checks: Iterable[str],
    tools: Iterable[str],
) -> None:
    """UserError if two plug-ins, or one and haros-ci itself, call different things alike."""
    owner: dict[tuple[str, str], str] = {("check", id): "haros-ci" for id in checks}
    owner |= {("linter", tool): "haros-ci" for tool in tools}

    def take(plugin: Plugin, kind: str, names: Iterable[str]) -> None:
        for name in names:
            other = owner.setdefault((kind, name), plugin.name)
            if other != plugin.name:
                _refuse(plugin.name, f"the {kind} {name!r} is one of {other} already", "give it another name")

    for plugin in plugins:
        ids = [check.id for check in plugin.checks]
        _once(plugin.name, "check", ids)
        _once(plugin.name, "linter", [linter.NAME for linter in plugin.linters])
        take(plugin, "check", ids)
        take(plugin, "linter", [linter.NAME for linter in plugin.linters])
        take(plugin, "format", plugin.renderers)


def _once(name: str, kind: str, names: list[str]) -> None:
    twice = sorted({item for item in names if names.count(item) > 1})
    if twice:
        _refuse(name, f"the {kind} {twice[0]!r} is there twice", "give one of them another name")


def _refuse(name: str, fault: str, help: str) -> NoReturn:
    raise UserError(f"plug-in {name}: {fault}", help=help)
