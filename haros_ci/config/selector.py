# SPDX-License-Identifier: Apache-2.0
"""What a selector names, how specific it is, and whether it names anything at all."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import lru_cache

from haros_ci.config.settings import PROFILES, Settings
from haros_ci.config.suggestion import did_you_mean, nearest, quoted, suggestion
from haros_ci.errors import UserError
from haros_ci.model.globs import compiled
from haros_ci.model.slips import nearly
from haros_ci.results.rule import Rule

#: How specific a match is: larger is more specific; the second number ranks globs by length.
Rank = tuple[int, int]
NO_MATCH: Rank = (-1, 0)
MAX_NOTES = 20
#: Different words in comments that are compared with the rules: each costs some milliseconds.
MAX_WORDS = 500
#: What is to be said against an id as a rule of a tool: whether it must be a mistake, and a help text; None where nothing is.
Doubt = Callable[[str, str], tuple[bool, str] | None]
_EVERYTHING, _TOOL_OR_TAG, _GLOB, _ALIAS, _ID, _FULL_ID = range(6)
_HAROS = "haros_plugin_"


def rank(selector: str, tool: str, rule: Rule) -> Rank:
    """How specifically *selector* names *rule* of *tool*; NO_MATCH if it does not.

    From most to least specific: ``tool:id``; the bare id; a HAROS or catalogue alias, also written
    ``haros_plugin_<tool>:<id>``; a glob, the longer the more; a tool or a tag; ``*``. Case counts.
    """
    own = (rule.id, *rule.deprecated_ids)
    prefix, _, rest = selector.partition(":")
    if prefix == tool and rest in own:
        return (_FULL_ID, 0)
    if selector in own:
        return (_ID, 0)
    if selector in rule.aliases:
        return (_ALIAS, 0)
    ours = prefix in (tool, _HAROS + tool)
    if ours and rest and (rest in own or rest in rule.aliases or f"{_HAROS}{tool}:{rest}" in rule.aliases):
        return (_ALIAS, 0)
    if selector == "*":
        return (_EVERYTHING, 0)
    if selector in rule.tags or (ours and rest in ("", "*")):
        return (_TOOL_OR_TAG, 0)
    if is_glob(selector):
        match = compiled(selector)
        for name in own:
            if match(name) or match(f"{tool}:{name}"):
                return (_GLOB, len(selector))
        if any(map(match, rule.aliases)):
            return (_GLOB, len(selector))
    return NO_MATCH


def best_rank(selectors: tuple[str, ...], tool: str, rule: Rule) -> Rank:
    """The highest rank that one of *selectors* has for *rule* of *tool*; NO_MATCH if none names it.

    Plain words, which most selectors are, are looked up all at once: a run asks this of each rule of each linter.
    """
    words, others = _sorted_out(selectors)
    best = max((rank(selector, tool, rule) for selector in others), default=NO_MATCH) if others else NO_MATCH
    if not words:
        return best
    if rule.id in words or not words.isdisjoint(rule.deprecated_ids):
        return max(best, (_ID, 0))
    if not words.isdisjoint(rule.aliases):
        return max(best, (_ALIAS, 0))
    if tool in words or _HAROS + tool in words or not words.isdisjoint(rule.tags):
        return max(best, (_TOOL_OR_TAG, 0))
    return best


@lru_cache(maxsize=256)
def _sorted_out(selectors: tuple[str, ...]) -> tuple[frozenset[str], tuple[str, ...]]:
    """Of *selectors* those that are plain words, and the others: globs, and those with a colon."""
    others = tuple(selector for selector in selectors if ":" in selector or is_glob(selector))
    return frozenset(selectors) - set(others), others


def is_glob(selector: str) -> bool:
    return "*" in selector or "?" in selector or "[" in selector


def check_selectors(
    settings: Settings,
    catalogue: Callable[[str], Mapping[str, Rule]],
    tools: Iterable[str],
    *,
    linters: Iterable[str] = (),
    unserved: Collection[str] = (),
    open_tools: Collection[str] = (),
    doubt: Doubt = lambda tool, id: None,
    identifiers: Callable[[str], Collection[str]] = lambda tool: (),
) -> tuple[str, ...]:
    """Notes on selectors that name nothing here; UserError for one that is misspelt.

    *tools* are the names that results carry, *open_tools* those whose catalogue may lack rules: of their ids *doubt* judges, and
    *identifiers* are those that are known of them beside the catalogue. *linters* are the names for the ``linters`` key, where they are not *tools*.
    *unserved* are HAROS ids and tags without a rule here. A HAROS ignore list may name anything, as in HAROS: that is a
    note. So is a ``tool:id`` of a tool that is none of ours, which may be for an imported log.
    """
    names = tuple(sorted(tools))
    runnable = tuple(sorted(linters)) or names
    _check_linters(settings, runnable)
    written = _written(settings)
    if not written:
        return ()
    known = _KnownNames(names, catalogue, open_tools, identifiers)
    idle: list[str] = []
    notes: list[str] = []
    origins = dict(settings.origins)
    for selector in written:
        if known.names_something(selector) or _is_user_query(selector, settings):
            continue
        where = origins.get(f"selector {selector}") or origins.get(f"haros {selector}") or "command line"
        in_full = len(notes) < MAX_NOTES
        if _is_unserved(selector, unserved):
            idle.append(selector)
        elif f"haros {selector}" in origins and f"selector {selector}" not in origins:
            near = did_you_mean(selector, known.words) if in_full else None
            notes.append(f"{where}: no rule or tag {quoted(selector)} here" + (f"; {near}" if near else ""))
        elif ":" in selector and not known.is_ours(selector) and not nearest(selector.partition(":")[0], names):
            notes.append(f"{where}: {quoted(selector)} can only match in an imported log: no tool here has that name")
        elif tool := known.open_tool(selector):
            notes += _of_open_tool(selector, tool, where, identifiers, doubt if in_full else lambda tool, id: None)
        else:
            what = "no rule matches" if is_glob(selector) else "unknown rule or tag"
            raise UserError(f"{where}: {what} {quoted(selector)}", help=known.help(selector))
    if idle:
        notes.append(f"HAROS names without a rule here, so nothing to turn on or off: {', '.join(sorted(idle))}")
    if len(notes) > MAX_NOTES + 1:
        notes[MAX_NOTES:] = [f"and {len(notes) - MAX_NOTES} more notes on selectors"]
    return tuple(notes)


def _check_linters(settings: Settings, runnable: Collection[str]) -> None:
    """UserError for a name under ``linters`` that is none of *runnable*."""
    for entry, where in settings.origins:
        tool = entry.removeprefix("linter ")
        if tool != entry and tool not in runnable:
            raise UserError(f"{where}: unknown tool {quoted(tool)}", help=suggestion(tool, runnable))


def _is_unserved(selector: str, unserved: Collection[str]) -> bool:
    """Whether *selector* is a name of HAROS that no rule here serves."""
    return selector in unserved or selector.removeprefix(_HAROS).partition(":")[2] in unserved


def _of_open_tool(
    selector: str, tool: str, where: str, identifiers: Callable[[str], Collection[str]], doubt: Doubt
) -> Iterator[str]:
    """A note on a selector that names no known rule of *tool*, whose catalogue may lack rules; UserError if the tool can have none of that name."""
    rest = selector.partition(":")[2]
    against = doubt(tool, rest) if not is_glob(rest) else (False, "") if identifiers(tool) else None
    if against is None:
        return
    if against[0]:
        message = f"{where}: {tool} has no rule {quoted(rest)}"
        raise UserError(message, help=against[1] or "haros-ci rules lists every rule; ids are case-sensitive")
    yield (
        f"{where}: {quoted(selector)} names no rule of {tool} that haros-ci knows: it has no effect unless {tool} reports one of that name"
    )


def slip_finder(
    settings: Settings,
    catalogue: Callable[[str], Mapping[str, Rule]],
    tools: Iterable[str],
    *,
    unserved: Collection[str] = (),
    open_tools: Collection[str] = (),
    doubt: Doubt = lambda tool, id: None,
    identifiers: Callable[[str], Collection[str]] = lambda tool: (),
) -> Callable[[str], str]:
    """What tells of a selector in a comment which rule was meant, "" where it is no misspelt one; the arguments are those of check_selectors.

    A comment may name what only another run knows: a query, a plug-in's rule, a rule of an imported log. So a word is misspelt only
    if it is a known one but for a slip, or if it stands behind the name of a tool and the tool can have no such rule.
    """
    names = tuple(sorted(tools))
    known: list[_KnownNames] = []  # made when first needed
    found: dict[str, str] = {}

    def slip(selector: str) -> str:
        if selector not in found:
            found[selector] = looked_up(selector) if len(found) < MAX_WORDS else ""
        return found[selector]

    def looked_up(selector: str) -> str:
        if not known:
            known.append(_KnownNames(names, catalogue, open_tools, identifiers))
        if is_glob(selector) or selector.startswith("user:") or known[0].names_something(selector):
            return ""
        if _is_unserved(selector, unserved):
            return ""
        if tool := known[0].open_tool(selector):
            against = doubt(tool, selector.partition(":")[2])
            return against[1] if against is not None and against[0] else ""
        near = nearly(selector, known[0].words)
        return f"did you mean {near!r}?" if near else ""

    return slip


def unknown_packages(settings: Settings, packages: Iterable[str]) -> tuple[str, ...]:
    """Notes on names under ``per-package`` that no package has."""
    known = tuple(sorted(packages))
    where = dict(settings.origins).get("per-package", "per-package")
    written = (name for entry in settings.per_package for name in entry.names)
    idle = [name for name in written if not any(compiled(name)(package) for package in known)]
    notes = []
    for name in idle[:MAX_NOTES]:
        near = did_you_mean(name, known) if not is_glob(name) else None
        notes.append(f"{where}: no package {quoted(name)} here" + (f"; {near}" if near else ""))
    return (*notes, *([f"and {len(idle) - MAX_NOTES} more names"] if len(idle) > MAX_NOTES else []))


def _written(settings: Settings) -> tuple[str, ...]:
    """Every selector of the settings, once, in the order of the layers."""
    policies = settings.policies
    chosen = [s for p in policies for s in (*p.select, *p.ignore, *(name for name, _ in p.levels))]
    return tuple(dict.fromkeys((*chosen, *(rule for entry in settings.exemptions for rule in entry.rules))))


def _is_user_query(selector: str, settings: Settings) -> bool:
    """``user:<id>``: a query that the project file defines under ``rules``."""
    rules = settings.project.get("rules")
    return isinstance(rules, dict) and selector.startswith("user:") and selector.removeprefix("user:") in rules


class _KnownNames:
    """Every name that a selector can have, gathered once."""

    def __init__(
        self,
        tools: tuple[str, ...],
        catalogue: Callable[[str], Mapping[str, Rule]],
        open_tools: Collection[str],
        identifiers: Callable[[str], Collection[str]],
    ) -> None:
        self.tools = tools
        self.open_tools = open_tools
        self.identifiers = identifiers
        self.rules = [(tool, rule) for tool in tools for rule in catalogue(tool).values()]
        self.words = {*tools}
        for tool, rule in self.rules:
            self.words.update((rule.id, f"{tool}:{rule.id}", *rule.tags, *rule.aliases, *rule.deprecated_ids))

    def names_something(self, selector: str) -> bool:
        if selector in self.words or selector == "*":
            return True
        if any(rank(selector, tool, rule) > NO_MATCH for tool, rule in self.rules):
            return True
        tool = self.open_tool(selector)
        word = selector.partition(":")[2] if tool else selector
        known = [self.identifiers(open_tool) for open_tool in ((tool,) if tool else self.open_tools)]
        if is_glob(word):
            match = compiled(word)
            return any(match(name) for names in known for name in names)
        return (bool(tool) and not word) or any(word in names for names in known)

    def open_tool(self, selector: str) -> str:
        """The tool in front of *selector* if its catalogue may lack rules, else ""."""
        tool = selector.partition(":")[0].removeprefix(_HAROS)
        return tool if tool in self.open_tools and ":" in selector else ""

    def is_ours(self, selector: str) -> bool:
        return selector.partition(":")[0].removeprefix(_HAROS) in (*self.tools, "user")

    def help(self, selector: str) -> str:
        if selector in PROFILES:
            return f"{selector!r} is a profile: choose it with profile: {selector} or --profile {selector}"
        near = None if is_glob(selector) else did_you_mean(selector, self.words)
        return near or "haros-ci rules lists every rule; ids are case-sensitive"
