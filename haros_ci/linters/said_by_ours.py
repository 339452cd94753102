# SPDX-License-Identifier: Apache-2.0
"""What catkin_lint says of a package and a check of ours says of the same thing: one finding, ours, which names the other.

So is what linters say of the markers of a merge that a check of ours names.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.regex import regex
from haros_ci.results.own import TOOL as OURS
from haros_ci.results.result import Related, Result

TOOL = "catkin_lint"
#: A finding names no more other places than this.
MOST = 40
#: The check of ours that names the markers of a merge, all files of one merge in one finding, and what linters say from the first marker of a file on.
_CONFLICT = "haros-ci:merge-conflict"
_OF_MARKERS = frozenset(
    ("pylint:syntax-error", "cppcheck:syntaxError", "ruff:invalid-syntax", "flake8:E999", "mypy:syntax")
)

_DEPENDENCY = ("undeclared-dependency", "undeclared-import", "undeclared-launch-dependency", "dependency-not-linked")
_INSTALLATION = ("directory-not-installed", "target-not-installed")
#: By a message of catkin_lint, the checks of ours that say the same (docs/catkin-lint.md); both name the thing.
SAME: dict[str, tuple[str, ...]] = {
    "MISSING_DEPEND": _DEPENDENCY,
    "MISSING_FIND": _DEPENDENCY,
    "MISSING_CATKIN_DEPEND": _DEPENDENCY,
    "WRONG_DEPEND": (*_DEPENDENCY, "unknown-target"),
    "LAUNCH_DEPEND": _DEPENDENCY,
    "UNINSTALLED_PLUGIN": (*_INSTALLATION, "plugin-not-loadable"),
    "UNINSTALLED_EXPORT_LIB": _INSTALLATION,
    "UNINSTALLED_DEPEND": _INSTALLATION,
    "UNINSTALLED_SCRIPT": _INSTALLATION,
    "UNINSTALLED_TARGET": _INSTALLATION,
    "SCRIPT_NOT_EXECUTABLE": ("script-not-runnable",),
    "MISSING_SHEBANG": ("script-not-runnable",),
    "MISSING_FILE": ("missing-install-source", "interface-not-generated", "missing-source"),
    "MISSING_DIRECTORY": ("missing-install-source", "unknown-target"),
    "MISSING_INCLUDE_PATH": ("unknown-target",),
    "MISSING_PLUGIN": ("plugin-not-loadable", "missing-install-source"),
    "SYSTEM_AS_CATKIN_DEPEND": ("unknown-target", *_DEPENDENCY),
    "UNDEFINED_TARGET": ("unknown-target",),
    "EXPORT_LIB_NOT_LIB": ("unknown-target",),
}
#: Those that name nothing: one of ours in the package is of the same thing.
UNNAMED: dict[str, tuple[str, ...]] = {
    "PROJECT_NAME": ("wrong-package-name",),
    "MISSING_GENERATE_MSG": ("interface-not-generated",),
}
#: ``… exports package include path that is not installed.``: ours then speaks of the directory include.
_INCLUDE_PATH = "UNINSTALLED_INCLUDE_PATH"
#: Those that say of a target, the last that they name, that it is not installed: once of each place that needs it.
_OF_TARGET = ("UNINSTALLED_EXPORT_LIB", "UNINSTALLED_TARGET", "UNINSTALLED_DEPEND")
#: Those that say of a script, by its path in the package, why it does not start; ours gives the path from the root.
_OF_SCRIPT = ("SCRIPT_NOT_EXECUTABLE", "MISSING_SHEBANG")
_QUOTED = regex(r"'([^']+)'")
_WORD = regex(r"[\w.+/-]*\w")


def said_once(results: Iterable[Result], package_of: Callable[[str], str | None]) -> tuple[Result, ...]:
    """*results* in their order without those of catkin_lint that a finding of ours repeats, which then names them.

    They are of one package, which *package_of* tells of a path, and name one thing: or the directory that it is in.
    Nor does a linter repeat what ours says of the markers of a merge.
    """
    found = _without_markers(results)
    by_package: dict[str, list[int]] = defaultdict(list)
    for i, result in enumerate(found):
        package = package_of(result.location.path) if result.tool == OURS else None
        if package:
            by_package[package].append(i)
    also: dict[int, set[str]] = defaultdict(set)
    dropped: set[int] = set()
    for i, result in enumerate(found):
        if result.tool == TOOL:
            near = by_package.get(package_of(result.location.path) or "", ())
            twin = next((n for n in near if _is_same(result, found[n])), None)
            if twin is not None:
                also[twin].update((result.full_id, *result.also))
                dropped.add(i)
    return _of_one_target(
        (
            replace(result, also=tuple(sorted({*result.also, *also[i]}))) if i in also else result
            for i, result in enumerate(found)
            if i not in dropped
        ),
        package_of,
    )


def _without_markers(results: Iterable[Result]) -> tuple[Result, ...]:
    """*results* without those of linters at markers of a merge that one of ours names, which then names their rules.

    A tool says of a file what it cannot read first, which need not be the first marker: a number in the name of a commit is read before the lines are put together.
    """
    found = tuple(results)
    begins: dict[str, tuple[int, int]] = {}
    for i, result in enumerate(found):
        if result.full_id == _CONFLICT:
            for place in (result.location, *(related.location for related in result.related)):
                if place.line:
                    begins[place.path] = min(begins.get(place.path, (place.line, i)), (place.line, i))
    also: dict[int, set[str]] = defaultdict(set)
    kept: list[int] = []
    for i, result in enumerate(found):
        line, twin = begins.get(result.location.path, (0, -1)) if result.full_id in _OF_MARKERS else (0, -1)
        if twin < 0 or (result.location.line or 0) < line:
            kept.append(i)
        else:
            also[twin].update((result.full_id, *result.also))
    return tuple(
        replace(found[i], also=tuple(sorted({*found[i].also, *also[i]}))) if i in also else found[i] for i in kept
    )


def unrepeated(
    results: Iterable[Result], hidden: Iterable[Result], package_of: Callable[[str], str | None]
) -> tuple[Result, ...]:
    """*results* without those of catkin_lint that repeat one of ours in *hidden*: hints, which are left out by themselves."""
    by_package: dict[str, list[Result]] = defaultdict(list)
    for result in hidden:
        package = package_of(result.location.path) if result.tool == OURS else None
        if package:
            by_package[package].append(result)
    return tuple(
        result
        for result in results
        if result.tool != TOOL
        or not any(_is_same(result, ours) for ours in by_package.get(package_of(result.location.path) or "", ()))
    )


def _of_one_target(results: Iterable[Result], package_of: Callable[[str], str | None]) -> tuple[Result, ...]:
    """*results* in their order, those of one target that is not installed as one: the first, which names the others' places."""
    kept: list[Result] = []
    first: dict[tuple[str, str], int] = {}
    for result in results:
        names = _QUOTED.findall(result.message) if result.tool == TOOL and result.rule in _OF_TARGET else []
        package = package_of(result.location.path) if names else None
        at = first.setdefault((package, names[-1]), len(kept)) if package else len(kept)
        if at == len(kept):
            kept.append(result)
            continue
        one = kept[at]
        others = {*result.also, *((result.full_id,) if result.full_id != one.full_id else ())}
        related = (*one.related, Related(result.location, f"Of the same cause: {result.message}"), *result.related)
        also = tuple(sorted({*one.also, *others}))
        kept[at] = replace(one, also=also, related=related[:MOST])
    return tuple(kept)


def _is_same(theirs: Result, ours: Result) -> bool:
    if ours.rule in UNNAMED.get(theirs.rule, ()):
        return True
    if theirs.rule == _INCLUDE_PATH:
        return ours.rule == "directory-not-installed" and "include" in _WORD.findall(ours.message)
    if ours.rule not in SAME.get(theirs.rule, ()):
        return False
    words = set(_WORD.findall(ours.message))
    quoted = _QUOTED.findall(theirs.message)
    if theirs.rule in _OF_TARGET:  # what depends on the target is installed
        return quoted[-1:] != [] and quoted[-1] in words
    if theirs.rule in _OF_SCRIPT:
        paths = {*words, ours.location.path, *(related.location.path for related in ours.related)}
        return any(f"/{path}".endswith(f"/{name}") for name in quoted for path in paths)
    names = {part for name in quoted for part in (name, name.partition("/")[0])}
    return not names.isdisjoint(words)
