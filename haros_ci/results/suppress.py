# SPDX-License-Identifier: Apache-2.0
"""Comments in the source that silence findings, and those among them that silence nothing."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Iterator
from dataclasses import replace

from haros_ci.model.location import Location
from haros_ci.results import own
from haros_ci.results.comments import syntax
from haros_ci.results.directives import Directive, directives
from haros_ci.results.result import Result, Run
from haros_ci.results.rule import Level

Matches = Callable[[str, Result], bool]
Enabled = Callable[[str, str], Iterable[str]]


def suppress(
    runs: Iterable[Run],
    text: Callable[[str], str],
    language: Callable[[str], str],
    matches: Matches,
    *,
    enabled: Enabled | None = None,
    mentions: Callable[[str], bool] | None = None,
    slip: Callable[[str], str] = lambda selector: "",
) -> tuple[tuple[Run, ...], tuple[Result, ...]]:
    """The runs with ``suppressions`` filled in, and a result for each comment that suppressed nothing.

    *matches* tells whether a selector names a result's rule. *enabled* gives the rules of a tool that are on for a
    path: a comment is called unused only where a tool that has answered for the file could have reported what it
    names; without *enabled*, that is judged by the rules that were reported anywhere. *mentions* may tell without
    reading a file that it has no ``haros:`` in it. *slip* tells what a misspelt name was meant to be, "" for one that is none.
    """
    runs = tuple(runs)
    measured = {r.location.path for run in runs for r in run.results if r.value is not None}
    paths = {r.location.path for run in runs for r in run.results}.union(*(run.analysed for run in runs))
    found = [
        directive
        for path in sorted(paths)
        if path in measured or mentions is None or mentions(path)
        for directive in directives(text(path), path, syntax(language(path), path), metrics=path in measured)
    ]
    if not found:
        return runs, ()
    by_line: dict[tuple[str, int | None], list[Directive]] = {}
    for directive in found:
        by_line.setdefault((directive.place.path, directive.line), []).append(directive)
    used: set[tuple[int, str]] = set()  # (id of a directive, selector)
    silenced = tuple(
        replace(run, results=tuple(_silenced(result, by_line, matches, used) for result in run.results)) for run in runs
    )
    return silenced, tuple(_idle(found, used, _CommentJudge(runs, matches, enabled), slip))


def _idle(
    found: Iterable[Directive], used: Container[tuple[int, str]], judge: _CommentJudge, slip: Callable[[str], str]
) -> Iterator[Result]:
    """A result for each comment with a name that silences nothing, and for each name that is misspelt."""
    for directive in found:
        if directive.metrics_only:
            continue
        idle = [name for name in directive.selectors or ("",) if (id(directive), name) not in used]
        known = [name for name in idle if judge.knows(name, directive.place.path)]
        if known:
            yield _unused(directive, known)
        misspelt = ((name, slip(name)) for name in idle if name and name not in known)
        yield from (_misspelt(directive, name, meant) for name, meant in misspelt if meant)


def _silenced(
    result: Result,
    by_line: dict[tuple[str, int | None], list[Directive]],
    matches: Matches,
    used: set[tuple[int, str]],
) -> Result:
    suppressions = list(result.suppressions)
    for directive in by_line.get((result.location.path, result.location.line), ()):
        if directive.metrics_only and result.value is None:
            continue
        names = [name for name in directive.selectors if matches(name, result)] if directive.selectors else [""]
        if names:
            suppressions.append(directive.suppression)
            used.update((id(directive), name) for name in names)
    parts = tuple(_silenced(part, by_line, matches, used) for part in result.parts)
    if len(suppressions) == len(result.suppressions) and parts == result.parts:
        return result
    return replace(result, suppressions=tuple(suppressions), parts=parts)


class _CommentJudge:
    """Whether this run could have reported what a comment names."""

    def __init__(self, runs: tuple[Run, ...], matches: Matches, enabled: Enabled | None) -> None:
        self.runs = runs
        self.matches = matches
        self.enabled = enabled
        self.known: dict[tuple[str, str, str], bool] = {}

    def knows(self, selector: str, path: str) -> bool:
        """A comment that names no rule (*selector* "") may be there for one that is off in this run: never judged."""
        if not selector:
            return False
        answered = [run for run in self.runs if path in run.analysed and run.successful and run.tool.name != own.TOOL]
        return any(self._reports(run, selector, path) for run in answered)

    def _reports(self, run: Run, selector: str, path: str) -> bool:
        tool = run.tool.name
        if self.enabled is None:
            rules = {rule.id for rule in run.rules} | {result.rule for result in run.results}
        else:
            rules = set(self.enabled(tool, path))
        place = Location(path)
        return any(self.matches(selector, Result(tool, rule, Level.NOTE, "", place)) for rule in sorted(rules))


def _unused(directive: Directive, idle: list[str]) -> Result:
    names = ", ".join(f"'{name}'" for name in idle)
    verb, them = ("suppresses", "it") if len(idle) == 1 else ("suppress", "them")
    message = f"In the comment '{directive.words}', {names} {verb} no finding. Remove {them}."
    rule = own.UNUSED_SUPPRESSION
    return Result(own.TOOL, rule.id, rule.level, message, directive.place)


def _misspelt(directive: Directive, name: str, meant: str) -> Result:
    message = f"In the comment '{directive.words}', '{name}' is the name of no rule, so it silences nothing: {meant}"
    return Result(own.TOOL, own.UNUSED_SUPPRESSION.id, Level.ERROR, message, directive.place)
