# SPDX-License-Identifier: Apache-2.0
"""From settings to linters: which of them run, with what, and how they are confined."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from functools import cache
from itertools import islice

from haros_ci import PROJECT_URL, __version__
from haros_ci.analysis.inspection import asks
from haros_ci.config.selection import Selection
from haros_ci.config.selector import is_glob
from haros_ci.config.settings import Settings
from haros_ci.linters import pylint, values
from haros_ci.linters.doubting import Doubting
from haros_ci.linters.given_names import is_extra_script
from haros_ci.linters.harmless import with_harmless
from haros_ci.linters.idle_python import with_idle_python
from haros_ci.linters.in_default import IN_TESTS, is_idle, is_of_linter, is_test
from haros_ci.linters.linter import REFUTED, SILENCED, LintOptions, When
from haros_ci.linters.loaded_files import loaded_files
from haros_ci.linters.metrics import STRUCTURE_RULES
from haros_ci.linters.pylint_surroundings import is_refuted_around
from haros_ci.linters.recorded import Testimony
from haros_ci.linters.said_by_ours import unrepeated
from haros_ci.linters.undefined_names import uses_gettext, weighed_names
from haros_ci.model.location import Location
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.registry import Registry
from haros_ci.results import own
from haros_ci.results.counted import count_metrics, raise_exceeded
from haros_ci.results.result import Baseline, Result, Run, Suppression, Tool, results_of
from haros_ci.results.rule import Level, Rule

_SILENCED = regex(r"'(?P<rule>[\w-]{1,100})' \(from line (?P<line>\d{1,9})\)")

#: The metrics of both languages are one run, whatever measured them.
METRICS = "metrics"
MEASURED_BY = ("lizard", "radon", "structure")
#: Checks of ours that, like a linter, speak of the code of one file alone.
OF_CODE = frozenset(
    f"{own.TOOL}:{rule}"
    for rule in (
        "method-defined-twice",
        "missing-argument",
        "undefined-attribute",
        "undefined-field",
        "undefined-name",
        "wrong-field-value",
        "wrong-format-arguments",
    )
)
#: Stands for any rule that a tool may report and that no table lists.
UNKNOWN = "a-rule-of-no-table"


def lint_options(settings: Settings, known: Registry) -> LintOptions:
    """The part of the settings that the linters room sees."""
    chosen = dict(settings.linters)
    return LintOptions(
        enabled=frozenset(name for name, s in chosen.items() if s.enabled) | named(settings, known),
        disabled=frozenset(name for name, s in chosen.items() if s.enabled is False)
        | unreported_rules(settings, known),
        timeouts={name: s.timeout for name, s in chosen.items() if s.timeout is not None},
        timeout=settings.linter_timeout,
        jobs=settings.jobs,
        trust_config=settings.trust_config,
        arguments={name: s.arguments for name, s in chosen.items() if s.arguments},
        compile_database=settings.compile_database,
        root=settings.root,
        beside={one.of.NAME: one for one in values.ADAPTERS} if settings.is_measured else {},
    )


def split_refuted(runs: Iterable[Run]) -> tuple[Run, ...]:
    """*runs* with the findings that the code around them speaks against as ``Run.refuted``, by their own rules."""
    done = []
    for run in runs:
        apart = [result for result in run.results if result.rule.startswith(REFUTED)]
        if apart:
            left = tuple(result for result in run.results if not result.rule.startswith(REFUTED))
            own_rules = tuple(replace(result, rule=result.rule.removeprefix(REFUTED)) for result in apart)
            run = replace(run, results=left, refuted=own_rules)
        done.append(run)
    return tuple(done)


def with_refuted(runs: Iterable[Run], refuted: Iterable[Result]) -> tuple[Run, ...]:
    """*runs*, each with those of *refuted* that are of its tool in place of its own."""
    by_tool: dict[str, list[Result]] = {}
    for result in refuted:
        by_tool.setdefault(result.tool, []).append(result)
    return tuple(replace(run, refuted=tuple(by_tool.get(run.tool.name, ()))) for run in runs)


def with_silenced(runs: Iterable[Run], workspace: Workspace, selection: Selection) -> tuple[Run, ...]:
    """*runs* with what pylint says of findings that comments silence as ``Run.silenced``, those whose rule is on."""

    def left_out(result: Result) -> Result | None:
        found = _SILENCED.search(result.message)
        if found is None or not workspace.reports_on(result.location.path):
            return None
        level = selection.decide(result.tool, selection.rule(result.tool, found["rule"]), result.location.path)
        place = Location(result.location.path, int(found["line"]))
        comment = (Suppression("inSource", location=place),)
        return level and replace(result, rule=found["rule"], level=level, suppressions=comment)

    done = []
    for run in runs:
        apart = [result for result in run.results if result.rule == SILENCED]
        if run.tool.name == pylint.NAME and apart:
            kept = tuple(result for result in run.results if result.rule != SILENCED)
            run = replace(run, results=kept, silenced=tuple(filter(None, map(left_out, apart))))
        done.append(run)
    return tuple(done)


def with_names(results: Iterable[Result], workspace: Workspace, selection: Selection) -> tuple[Result, ...]:
    """*results*, undefined names weighed (:func:`haros_ci.linters.undefined_names.weighed_names`), and as notes what is said of Python that nothing runs, and what changes nothing."""
    versions = {package.name: package.ros for package in workspace.packages}
    every = set(versions.values())
    of_all = 1 if every == {1} else 0  # what lies in no package of a workspace of ROS 1 alone
    package_of = workspace.package_finder()
    loaded = cache(lambda: loaded_files(workspace))
    python = [file.path for file in workspace.files if file.language in ("python", "launch", "setup")]
    weighed_results = weighed_names(
        results,
        workspace.text,
        is_ros1=lambda path: versions.get(package_of(path) or "", of_all) == 1,
        is_given=lambda result: selection.given_level(result.tool, result.rule, result.location.path) is not None,
        is_loaded=lambda path: path.rpartition("/")[2] in loaded(),
        is_extra=lambda path: is_extra_script(path, workspace.names.__contains__, workspace.text),
        is_translated=cache(lambda: any(map(uses_gettext, map(workspace.text, python)))),
    )

    def is_asked_for(result: Result) -> bool:
        return selection.is_asked_for(result.tool, result.rule, result.location.path)

    results = with_idle_python(weighed_results, workspace, is_given=is_asked_for)
    return with_harmless(results, workspace.text, is_given=is_asked_for)


def worth_reporting(
    results: Iterable[Result],
    workspace: Workspace,
    selection: Selection,
    left_out: Callable[[Collection[str]], Collection[str]],
    aside: list[Result] | None = None,
    is_built: Callable[[str], bool] = lambda path: False,
) -> tuple[Result, ...]:
    """*results* without those of linters, and of checks that speak of code alone, that nobody mends where they are; who asks for every finding, or for the rule, has them.

    They are in files that are *left_out*, as nothing uses them or as they are copies, in tests, of what is deprecated in no Python of ROS 1, or refuted by
    other files. The latter are put *aside*. A file that *is_built* into what is no test is none, however it is called.
    """
    ros = {package.name: package.ros for package in reversed(workspace.packages)}
    package_of = cache(workspace.package_finder())

    def is_extra(result: Result) -> bool:
        return (is_of_linter(result) or result.full_id in OF_CODE) and not selection.is_asked_for(
            result.tool, result.rule, result.location.path
        )

    kept: list[tuple[Result, bool]] = []
    doubting = Doubting()
    for result in results:
        extra = is_extra(result)
        path = result.location.path
        if extra and doubting.may(path, result.full_id, workspace.text(path)) and is_refuted_around(result, workspace):
            if aside is not None:
                aside.append(result)
            continue
        if not extra or not is_idle(result, ros.get(package_of(path) or ""), is_built):
            kept.append((result, extra))
    left = left_out({result.location.path for result, extra in kept if extra})
    return tuple(result for result, extra in kept if not extra or result.location.path not in left)


def without_hints(
    results: Iterable[Result], every: Iterable[Result], workspace: Workspace, selection: Selection
) -> tuple[Result, ...]:
    """*results* without those of catkin_lint that repeat a hint of ours, of *every* result, which the profile passes over."""
    hints = [
        result
        for result in every
        if result.tool == own.TOOL
        and result.level is Level.NOTE
        and selection.wants(result.tool, result.rule, result.location.path)
        and selection.decide(result.tool, result.rule, result.location.path, default=result.level) is None
    ]
    return unrepeated(results, hints, workspace.package_finder())


def reported_rules(tool: str, path: str, selection: Selection) -> Iterable[str]:
    """The rules of *tool* whose findings in the file at *path* are reported, those aside that are of no use in a test."""
    of_test = is_test(path)
    for rule in selection.rules(tool):
        is_left = of_test and f"{tool}:{rule}" in IN_TESTS and not selection.is_asked_for(tool, rule, path)
        is_of_recordings = tool == own.TOOL and rule in own.OF_RECORDINGS
        if selection.wants(tool, rule, path) and not is_left and not is_of_recordings:
            yield rule


def named(settings: Settings, known: Registry) -> frozenset[str]:
    """The linters that a selector asks for: ``ruff``, ``flake8:E501``, or the id of a rule of theirs (``bugprone-use-after-move``).

    If several tools have a rule of that id, the first of them is asked for, in the order of the registry: those that always run come first.
    """
    words = tuple(dict.fromkeys(word for policy in settings.policies for word in policy.select))
    if not words:
        return frozenset()
    optional = {linter.NAME for linter in known.linters if linter.WHEN is not When.ALWAYS}
    tools = {word.partition(":")[0] for word in words}
    own_words = {rule.id for rule in known.rules_of(own.TOOL).values()} | set(known.tools)
    for word in words:
        if ":" in word or is_glob(word) or word in own_words:
            continue
        found = (linter.NAME for linter in known.linters if word in known.identifiers(linter.NAME))
        tools.update(islice(found, 1))
    return frozenset(tools & optional)


def contradictions(settings: Settings, known: Registry) -> tuple[str, ...]:
    """Sentences on linters that a selector asks for and the key ``linters`` switches off: they do not run."""
    origins = dict(settings.origins)
    off = {name for name, chosen in settings.linters if chosen.enabled is False}
    words = {word.partition(":")[0] for policy in settings.policies for word in policy.select}
    return tuple(
        f"{origins.get(f'linter {name}', 'the project file')}: {name} is switched off here, so nothing of it is reported, although a "
        "selector asks for it"
        for name in sorted(off & (named(settings, known) | words))
    )


def unreported_rules(settings: Settings, known: Registry) -> frozenset[str]:
    """The linters that need not run: all in the profile of the checks alone, unless the command line selects other rules, and
    those none of whose rules is on in any file.
    """
    checks = known.check_rules.keys()
    selected = {text.removeprefix(f"{own.TOOL}:") for text in settings.command_line.select}
    has_others = not selected <= checks or any(entry.profile for entry in settings.local)
    if settings.profile == "architecture" and not has_others:
        return frozenset(known.adapters)
    selection = Selection(settings, with_queries(settings, known), unlisted=known.unlisted)
    requested = named(settings, known) | {name for name, chosen in settings.linters if chosen.enabled}
    run = (linter.NAME for linter in known.linters if linter.WHEN is not When.ASKED or linter.NAME in requested)
    return frozenset(name for name in run if is_silent(name, settings, selection, known))


def is_silent(name: str, settings: Settings, selection: Selection, known: Registry) -> bool:
    """Whether nothing that the linter *name* can say is shown anywhere; False where that is not certain."""
    tool = METRICS if name in MEASURED_BY else name
    rules = selection.rules(tool)
    ignored = {word for policy in settings.policies for word in policy.ignore}
    ignored |= {word for policy in settings.policies for word, level in policy.levels if level is None}
    is_requested = any(linter == name and chosen.enabled for linter, chosen in settings.linters)
    unsure = is_requested or tool in known.open_ended  # a rule of no table may be in a profile, by the look of its name
    if not rules or (unsure and ignored.isdisjoint((tool, f"{tool}:", f"{tool}:*", "*"))):
        return False
    if any(selection.may_want(tool, rule) for rule in rules):
        return False
    if tool not in known.open_ended:
        return True
    words = {word for policy in settings.policies for word in policy.select}
    words |= {word for policy in settings.policies for word, level in policy.levels if level}
    named = [word.removeprefix(f"{tool}:") for word in words if word.startswith(f"{tool}:") or is_glob(word)]
    others = [UNKNOWN, *(re.sub(r"\[.*?\]|[*?]", "x", word) for word in named if word not in ("*", ""))]
    return not any(selection.may_want(tool, id) for id in others)


def has_structure(workspace: Workspace, selection: Selection) -> bool:
    """Whether any threshold is on that only syntax trees and the index of the workspace can tell of."""
    paths = (file.path for file in workspace.files if file.language in ("cpp", "python"))
    return selection.wants_any(METRICS, STRUCTURE_RULES, paths)


def weighed(runs: tuple[Run, ...], baseline: Baseline | None, selection: Selection) -> tuple[Run, ...]:
    """*runs* with metrics at their weight: a change that crosses a limit of ``ros`` warns, what was there is a number."""
    if baseline is None or not baseline.available:
        return count_metrics(runs, selection.is_asked_for)

    def weighs(result: Result) -> bool:
        level = selection.given_level(result.tool, result.rule, result.location.path)
        return level is None and "ros" in selection.rule(result.tool, result.rule).profiles

    return raise_exceeded(runs, weighs)


def with_queries(settings: Settings, known: Registry) -> Callable[[str], Mapping[str, Rule]]:
    """The documented rules of each tool, with the queries of the project file as rules of ours."""
    if not asks(settings):
        return known.rules_of
    from haros_ci.query.declared import rules

    own_ones = {**known.rules_of(own.TOOL), **rules(settings.project)}
    return lambda tool: own_ones if tool == own.TOOL else known.rules_of(tool)


def confinement(runs: tuple[Run, ...], settings: Settings, testimony: Testimony | None) -> frozenset[str]:
    """How linters are confined, here or on the machines whose *testimony* is given, whether or not their answers were cached.

    Empty if no linter has a part in *runs*.
    """
    if all(run.imported or run.tool.name == own.TOOL for run in runs):
        return frozenset()
    if testimony is not None:
        return testimony.confined
    from haros_ci.linters.sandbox import state

    return frozenset({state(settings.trust_config)})


def with_metrics(runs: Iterable[Run]) -> tuple[Run, ...]:
    """The runs that measure joined into the one named ``metrics``, after the linters."""
    runs = tuple(runs)
    parts = [run for run in runs if run.tool.name in MEASURED_BY]
    others = tuple(run for run in runs if run.tool.name not in MEASURED_BY)
    if not parts:
        return others
    by = ", ".join(f"{run.tool.name} {run.tool.version}".strip() for run in parts)
    metrics = Run(
        tool=Tool(METRICS, __version__, PROJECT_URL, f"haros-ci metrics (measured by {by})"),
        results=results_of(parts),
        notifications=tuple(n for run in parts for n in run.notifications),
        analysed=frozenset().union(*(run.analysed for run in parts)),
        successful=all(run.successful for run in parts),
    )
    return (*others, metrics)
