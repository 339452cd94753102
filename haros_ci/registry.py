# SPDX-License-Identifier: Apache-2.0
"""What a run can do: the built-in linters, checks and formats, and those that plug-ins bring, as one value."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from functools import cache
from importlib.resources import files
from types import MappingProxyType
from typing import TYPE_CHECKING

from haros_ci import PROJECT_URL
from haros_ci.checking.check import Check
from haros_ci.config.settings import PROFILES, Settings
from haros_ci.errors import UserError
from haros_ci.linters import (
    bandit,
    black,
    catalogue,
    catkin_lint,
    clang_format,
    clang_tidy,
    cmake_lint,
    cmakelint,
    codespell,
    cppcheck,
    cpplint,
    flake8,
    flawfinder,
    hadolint,
    isort,
    lizard,
    mypy,
    pylint,
    radon,
    ruff,
    shellcheck,
    vulture,
    xmllint,
    yamllint,
)
from haros_ci.linters.linter import Linter
from haros_ci.records import dataclass, field
from haros_ci.results import own
from haros_ci.results.result import Report, Tool
from haros_ci.results.rule import Rule
from haros_ci.timing import timed

if TYPE_CHECKING:
    from haros_ci.plugins.plugin import Plugin

#: First what runs without being asked for, then the others by name.
LINTERS: tuple[Linter, ...] = (
    *(cppcheck, cpplint, pylint, lizard, radon, ruff, clang_tidy, catkin_lint),
    bandit,
    black,
    clang_format,
    cmake_lint,
    cmakelint,
    codespell,
    flake8,
    flawfinder,
    hadolint,
    isort,
    mypy,
    shellcheck,
    vulture,
    xmllint,
    yamllint,
)
#: Tools with more rules than the catalogue lists: any id of theirs may be selected.
OPEN_ENDED = (
    "bandit",
    "catkin_lint",
    "clang-tidy",
    "cppcheck",
    "flake8",
    "flawfinder",
    "hadolint",
    "mypy",
    "pylint",
    "ruff",
    "shellcheck",
)
#: Names in front of a rule's id that are no tool's.
TAKEN = ("architecture", "haros-ci", "metrics", "user")


@dataclass(frozen=True, slots=True)
class Registry:
    """*linters* in the order of their runs, *checks* with their *check_rules* by id, *renderers* by the name of their format.

    *tool_rules* are the documented rules of linters that the catalogue does not know, *open_ended* the tools that may report others.
    *components* are the plug-ins as SARIF lists them. *declared* are the names of the tools that the project file declares, those
    too that do not run.
    """

    linters: tuple[Linter, ...]
    checks: tuple[Check, ...]
    check_rules: Mapping[str, Rule]
    tool_rules: Mapping[str, Mapping[str, Rule]] = field(default_factory=lambda: MappingProxyType({}))
    open_ended: tuple[str, ...] = OPEN_ENDED
    renderers: Mapping[str, Callable[[Report], str]] = field(default_factory=lambda: MappingProxyType({}))
    components: tuple[Tool, ...] = ()
    declared: tuple[str, ...] = ()

    @property
    def adapters(self) -> tuple[str, ...]:
        """The names of all linters, as the key ``linters`` has them."""
        return tuple(dict.fromkeys((*(linter.NAME for linter in self.linters), *self.declared)))

    @property
    def tools(self) -> tuple[str, ...]:
        """The names that results of ours carry."""
        return (own.TOOL, *catalogue.TOOLS, *self.tool_rules, *self.declared)

    def rules_of(self, tool: str) -> Mapping[str, Rule]:
        """The documented rules of a tool, haros-ci itself included."""
        if tool == own.TOOL:
            return {**own.RULES, **self.check_rules}
        return self.tool_rules[tool] if tool in self.tool_rules else catalogue.rules_of(tool)

    def identifiers(self, tool: str) -> Collection[str]:
        """The ids of a linter's rules that are known, documented or not; empty for one that a plug-in or a project file brings."""
        from haros_ci.linters.catalogue.spelling import identifiers

        return identifiers(tool)

    def doubt(self, tool: str, identifier: str) -> tuple[bool, str] | None:
        """What is to be said against *identifier* as a rule of *tool* (``catalogue.spelling.doubt``)."""
        from haros_ci.linters.catalogue.spelling import doubt

        return doubt(tool, identifier)

    def unlisted(self, tool: str, identifier: str) -> Rule:
        """A rule that no table has. Those of declared tools are on in every profile, as those of imported logs are."""
        made = catalogue.rule(tool, identifier)
        return replace(made, profiles=PROFILES) if tool in self.declared else made

    def documented_rules(self) -> Iterator[tuple[str, Rule]]:
        """Every documented rule with its tool's name, in order."""
        for tool in sorted(self.tools):
            for _, rule in sorted(self.rules_of(tool).items()):
                yield tool, rule


@timed("loading")
def registry(settings: Settings) -> Registry:
    """What a run under *settings* can do; UserError for a plug-in that cannot be used."""
    known = built_in()
    if settings.plugins:
        from haros_ci.plugins.load import load

        known = with_plugins(known, load(settings.plugins, settings.root))
    if settings.haros_plugins or settings.plugin_whitelist:
        known = with_haros_plugins(known, settings)
    return with_declared(known, settings) if settings.declared else known


@cache
def built_in() -> Registry:
    """What haros-ci can do by itself."""
    return Registry(LINTERS, checks(), check_rules())


def with_plugins(before: Registry, plugins: tuple[Plugin, ...]) -> Registry:
    """*before* and what *plugins* bring, in their order; UserError where names clash."""
    from haros_ci.plugins.load import without_clashes

    names = {name for rule in before.rules_of(own.TOOL).values() for name in (rule.id, *rule.aliases)}
    without_clashes(plugins, checks=names, tools=(*before.tools, *before.adapters, *TAKEN))
    rules = dict(before.check_rules)
    tool_rules = dict(before.tool_rules)
    for plugin in plugins:
        rules |= plugin.check_rules()
        tool_rules |= plugin.rules
    return Registry(
        linters=(*before.linters, *(linter for plugin in plugins for linter in plugin.linters)),
        checks=(*before.checks, *(check for plugin in plugins for check in plugin.checks)),
        check_rules=MappingProxyType(rules),
        tool_rules=MappingProxyType(tool_rules),
        open_ended=(*before.open_ended, *(tool for plugin in plugins for tool in plugin.rules)),
        renderers=MappingProxyType({f: render for plugin in plugins for f, render in plugin.renderers.items()}),
        components=(*before.components, *(Tool(p.name, p.version or f"0+{p.digest}") for p in plugins)),
    )


def with_haros_plugins(before: Registry, settings: Settings) -> Registry:
    """*before* and the rules of HAROS's plug-ins, which are read and not run for it; UserError for one that cannot be had."""
    from haros_ci.haros_plugins.chosen import chosen

    names = (settings.haros_plugins, settings.plugin_whitelist, settings.plugin_blacklist)
    plugins = chosen(*names, settings.root)
    return replace(
        before,
        tool_rules=MappingProxyType({**before.tool_rules, **{plugin.name: plugin.all_rules() for plugin in plugins}}),
        declared=(*before.declared, *(plugin.name for plugin in plugins)),
    )


@cache
def checks() -> tuple[Check, ...]:
    """The built-in checks."""
    from haros_ci_checks import CHECKS

    return CHECKS


def page_of(check: Check) -> str:
    """The text of a check's page; every check has one (tests/test_checks.py)."""
    return files("haros_ci_checks").joinpath(page_name(check)).read_text(encoding="utf-8")


def page_name(check: Check) -> str:
    return check.id.replace("-", "_") + ".md"


@cache
def check_rules() -> dict[str, Rule]:
    """The rules of the built-in checks by id."""
    return {
        check.id: check.rule(page_of(check), f"{PROJECT_URL}/blob/main/checks/{page_name(check)}") for check in checks()
    }


def with_declared(before: Registry, settings: Settings) -> Registry:
    """*before* and the tools that the project file declares, which run only if it is trusted; UserError where names clash."""
    from haros_ci.linters.declared import declared

    for tool in settings.declared:
        if tool.name in (*before.tools, *before.adapters, *TAKEN):
            message = f"{tool.origin}: haros-ci has a tool named '{tool.name}' already"
            raise UserError(message, help="give yours another name")
    names = tuple(tool.name for tool in settings.declared)
    return replace(
        before,
        linters=(*before.linters, *declared(settings.tools)),
        open_ended=(*before.open_ended, *names),
        declared=(*before.declared, *names),
    )
