# SPDX-License-Identifier: Apache-2.0
"""Which rules are on, where, and at what level."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import islice

from haros_ci.config.selector import NO_MATCH, best_rank, rank
from haros_ci.config.settings import Policy, Settings
from haros_ci.model import globs
from haros_ci.records import dataclass
from haros_ci.results.result import Result
from haros_ci.results.rule import Level, Rule

#: Profiles that show nothing of what a check itself holds for less than it usually is: a note, where its rule is more.
WITHOUT_HINTS = ("bugs-only", "ros")

Catalogue = Callable[[str], Mapping[str, Rule]]
#: Whether a rule is on, and the level that the settings give it (None: its own).
_Decision = tuple[bool, Level | None]


@dataclass(frozen=True, slots=True)
class _RuleState:
    """What the layers so far make of a rule; *off* when its level is off."""

    on: bool
    level: Level | None = None
    off: bool = False


class Selection:
    """The settings as decisions on rules.

    Layers, each beating those before it: the profile; the project file; the per-package and then the per-path entries
    that match, in file order; the command line. Within a layer the most specific selector that names the rule decides (selector.py has the
    ranks), and between equals ``ignore``. A layer that does not name the rule leaves it as it was. ``levels`` follow
    the same order, between equals the last wins; ``off`` turns the rule off until a later layer selects it or gives it
    a level.
    """

    def __init__(
        self,
        settings: Settings,
        catalogue: Catalogue,
        unlisted: Callable[[str, str], Rule] | None = None,
        package: Callable[[str], str | None] | None = None,
        slip: Callable[[str], str] = lambda selector: "",
    ) -> None:
        """*catalogue* gives the documented rules of a tool by id, empty for a tool it does not know.

        *unlisted* makes a rule of a tool and an id that the catalogue lacks; without it such a rule has no profiles, so
        that only ``all`` or a selector turns it on. *package* tells the package of a path, for ``per-package``; *slip* which rule a misspelt
        selector of a comment means (``selector.slip_finder``).
        """
        self.slip = slip
        self._package = package
        self._settings = settings
        self._catalogue = catalogue
        self._unlisted = unlisted
        self._zones: dict[str, tuple[int, ...]] = {}
        self._decisions: dict[tuple[str, str | Rule, tuple[int, ...], bool], _Decision] = {}

    def decide(self, tool: str, rule: str | Rule, path: str, default: Level | None = None) -> Level | None:
        """The level of *rule* in the file *path*, or None if it is off there.

        Where no setting names a level it is *default*, or else the rule's own. A *default* of ``note`` below the rule's own
        level is a hint of a check: profiles that show what is wrong pass over those.
        """
        is_hint = default is Level.NOTE and self.rule(tool, rule).level is not Level.NOTE
        on, level = self._decision(tool, rule, path, is_hint=is_hint)
        if not on:
            return None
        return level or default or self.rule(tool, rule).level

    def over(self, package: Callable[[str], str | None]) -> Selection:
        """The same settings for a workspace whose packages *package* tells."""
        return Selection(self._settings, self._catalogue, self._unlisted, package, self.slip)

    def wants(self, tool: str, rule: str | Rule, path: str) -> bool:
        """Whether *rule* is on in the file *path*."""
        return self._decision(tool, rule, path)[0]

    def wants_any(self, tool: str, rules: Iterable[str | Rule], paths: Iterable[str]) -> bool:
        """Whether one of *rules* is on in one of the files; where no entry is for some files only, one tells of all."""
        requested = tuple(paths) if self._settings.local else tuple(islice(paths, 1))
        return any(self.wants(tool, rule, path) for rule in rules for path in requested)

    def may_want(self, tool: str, rule: str | Rule) -> bool:
        """Whether *rule* can be on in any file, whatever packages and paths there are; True where that is not certain."""
        settings, rule = self._settings, self.rule(tool, rule)
        state = _RuleState(settings.profile == "all" or settings.profile in rule.profiles)
        state = _apply(settings.policy, tool, rule, state)
        for entry in settings.local:
            selectors = (*entry.policy.select, *(selector for selector, level in entry.policy.levels if level))
            if entry.profile or best_rank(selectors, tool, rule) > NO_MATCH:
                state = _RuleState(True)
        state = _apply(settings.command_line, tool, rule, state)
        return state.on and not state.off

    def given_level(self, tool: str, rule: str | Rule, path: str) -> Level | None:
        """The level that the settings give *rule* in the file *path*, None if they leave it as it is."""
        return self._decision(tool, rule, path)[1]

    def is_asked_for(self, tool: str, rule: str | Rule, path: str) -> bool:
        """Whether the settings ask for *rule* in *path* by more than a profile that shows what is wrong.

        That is by another profile, or by a selector or a level.
        """
        rule, zone = self.rule(tool, rule), self._zone(path) if self._settings.local else ()
        local = [self._settings.local[i] for i in zone]
        profile = next((entry.profile for entry in reversed(local) if entry.profile), self._settings.profile)
        policies = (self._settings.policy, *(entry.policy for entry in local), self._settings.command_line)
        named = (selector for policy in policies for selector in (*policy.select, *(name for name, _ in policy.levels)))
        return profile not in WITHOUT_HINTS or any(rank(selector, tool, rule) > NO_MATCH for selector in named)

    def rule(self, tool: str, rule: str | Rule) -> Rule:
        """*rule* itself, or the catalogue's rule of that id, or one made for it."""
        if isinstance(rule, Rule):
            return rule
        known = self._catalogue(tool).get(rule)
        if known is not None:
            return known
        return self._unlisted(tool, rule) if self._unlisted else Rule(id=rule, summary="")

    def rules(self, tool: str) -> Mapping[str, Rule]:
        """The documented rules of *tool*."""
        return self._catalogue(tool)

    def matches(self, selector: str, result: Result) -> bool:
        """Whether *selector* names the rule of *result*, or a rule of another tool that found the same defect."""
        named = (
            (result.tool, result.rule),
            *((tool, rule) for tool, _, rule in (a.partition(":") for a in result.also)),
        )
        return any(rank(selector, tool, self.rule(tool, rule)) > NO_MATCH for tool, rule in named)

    def ignores_file(self, package: str | None, path: str) -> bool:
        """Whether a HAROS ``analysis.ignore.files`` pattern names *path* in *package*; ``*`` crosses directories."""
        if package is None:
            return False
        name = f"{package}/{path}"
        return any(globs.compiled(pattern)(name) for pattern in self._settings.ignore_files)

    def _decision(self, tool: str, rule: str | Rule, path: str, *, is_hint: bool = False) -> _Decision:
        zone = self._zone(path) if self._settings.local else ()
        key = (tool, rule, zone, is_hint)
        decision = self._decisions.get(key)
        if decision is None:
            decision = self._decisions[key] = self._decide(tool, self.rule(tool, rule), zone, is_hint)
        return decision

    def _zone(self, path: str) -> tuple[int, ...]:
        """Which per-package entries, counted from 0, and per-path entries, counted on, hold for *path*."""
        zone = self._zones.get(path)
        if zone is None:
            settings = self._settings
            name = self._package(path) if self._package and settings.per_package else None
            packages, here = len(settings.per_package), range(len(settings.per_package))
            entries = enumerate(settings.per_path, start=packages)
            zone = (
                *(
                    i
                    for i in here
                    if name and any(globs.compiled(glob)(name) for glob in settings.per_package[i].names)
                ),
                *(i for i, entry in entries if any(globs.matches(glob, path) for glob in entry.globs)),
            )
            self._zones[path] = zone
        return zone

    def _decide(self, tool: str, rule: Rule, zone: tuple[int, ...], is_hint: bool) -> _Decision:
        settings = self._settings
        local = [settings.local[i] for i in zone]
        profile = next((entry.profile for entry in reversed(local) if entry.profile), settings.profile)
        state = _RuleState(
            (profile == "all" or profile in rule.profiles) and not (is_hint and profile in WITHOUT_HINTS)
        )
        for policy in (settings.policy, *(entry.policy for entry in local), settings.command_line):
            state = _apply(policy, tool, rule, state)
        return state.on and not state.off, state.level


def _apply(policy: Policy, tool: str, rule: Rule, before: _RuleState) -> _RuleState:
    if not (policy.select or policy.ignore or policy.levels):
        return before
    selected = best_rank(policy.select, tool, rule)
    ignored = best_rank(policy.ignore, tool, rule)
    mapped, mapping = NO_MATCH, before.level
    for selector, level in policy.levels:
        here = rank(selector, tool, rule)
        if here > NO_MATCH and here >= mapped:
            mapped, mapping = here, level

    on, off = before.on, before.off
    if selected > ignored:
        on, off = True, False
    elif ignored > NO_MATCH:
        on = False
    if mapped > NO_MATCH:
        off = mapping is None and mapped >= selected
    return _RuleState(on, mapping or before.level, off)
