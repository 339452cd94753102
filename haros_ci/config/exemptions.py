# SPDX-License-Identifier: Apache-2.0
"""``exceptions`` of the project file: findings that it accepts, read and applied."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from haros_ci.config.settings import Exemption, Policy, Settings
from haros_ci.config.shapes import File, NamedShape, kind
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.model import globs
from haros_ci.model.workspace import Workspace
from haros_ci.results.linear_regex import PatternError, compiled
from haros_ci.results.result import Result, Run, Suppression

KEYS = ("files", "packages", "rules", "message", "reason")
CRITERIA = KEYS[:4]
MAX_EXEMPTIONS = 200
MAX_REASON = 500
#: Characters of a message that a pattern is searched in.
MAX_MESSAGE = 2_000
FORM = "exceptions: [{files: ['test/**'], rules: [pylint], message: 'has no .* member', reason: why}]"

Matches = Callable[[str, Result], bool]


def read_exemptions(
    file: File, value: YamlValue | None, selector: Callable[[NamedShape], str]
) -> tuple[Exemption, ...]:
    """The entries of ``exceptions``; *selector* takes note of where each of ``rules`` stands."""
    if value is None:
        return ()
    if not isinstance(value.data, tuple):
        raise file.error(value.line, f"'exceptions' must be a list, not {kind(value)}", f"write {FORM}")
    if len(value.data) > MAX_EXEMPTIONS:
        raise file.error(value.line, f"'exceptions' has more than {MAX_EXEMPTIONS} entries", "use globs and tags")
    found: list[Exemption] = []
    for number, entry in enumerate(value.data, start=1):
        exemption = _read(file, entry, selector)
        if any(exemption.origin == other.origin for other in found):  # two on one line
            exemption = replace(exemption, origin=f"{exemption.origin} (entry {number})")
        found.append(exemption)
    return tuple(found)


def _read(file: File, entry: YamlValue, selector: Callable[[NamedShape], str]) -> Exemption:
    parts = file.map(entry, "an entry of 'exceptions'", FORM, KEYS)
    if not any(key in parts for key in CRITERIA):
        raise file.error(entry.line, f"an exception needs one of {', '.join(CRITERIA)}", f"write {FORM}")
    names = {key: file.texts(parts[key], key) for key in ("files", "packages", "rules") if key in parts}
    for key, provided in names.items():
        if not provided:
            raise file.error(parts[key].line, f"'{key}' of an exception is empty, so it fits nothing", "leave it out")
    reason = file.text(parts["reason"], "'reason'") if "reason" in parts else ""
    if len(reason) > MAX_REASON:
        raise file.error(parts["reason"].line, f"a reason of more than {MAX_REASON} characters", "shorten it")
    return Exemption(
        files=tuple(file.glob(named) for named in names.get("files", ())),
        packages=tuple(named.text for named in names.get("packages", ())),
        rules=tuple(selector(named) for named in names.get("rules", ())),
        message=pattern(file, parts["message"], "'message'") if "message" in parts else "",
        reason=" ".join(reason.split()),
        origin=f"{file.name}:{entry.line}",
    )


def pattern(file: File, value: YamlValue, what: str) -> str:
    """A regular expression of linear_regex.py."""
    text = file.text(value, what)
    try:
        compiled(text)
    except PatternError as err:
        help = "docs/configuration.md says what patterns can have"
        raise file.error(value.line, f"{what} is no pattern that can be used: {err}", help) from err
    return text


def exempt(
    runs: Iterable[Run], settings: Settings, matches: Matches, package: Callable[[str], str | None]
) -> tuple[Run, ...]:
    """*runs* with an external suppression on every result that an exception fits; UserError if a pattern is too slow.

    *matches* tells whether a selector names a result's rule, *package* the package of a path.
    """
    if not settings.exemptions:
        return tuple(runs)
    fits = _Fits(settings, matches, package)
    return tuple(replace(run, results=tuple(fits.marked(result) for result in run.results)) for run in runs)


def _idle(runs: Iterable[Run], settings: Settings) -> tuple[str, ...]:
    """Sentences on exceptions that fitted nothing in *runs*, in the order of the file."""
    used = {s.source for run in runs for result in run.results for s in result.suppressions}
    return tuple(
        f"{e.origin}: this exception fits no finding of this run; remove it"
        for e in settings.exemptions
        if e.origin not in used
    )


def idle_entries(runs: Iterable[Run], workspace: Workspace, settings: Settings) -> tuple[str, ...]:
    """Notes on exceptions that are for nothing, where the whole workspace was analysed as the file says."""
    if not settings.exemptions:
        return ()
    whole = workspace.targets is None and settings.paths == (".",) and all(run.successful for run in runs)
    as_told = settings.command_line == Policy() and dict(settings.origins).get("profile") != "command line"
    everything_ran = settings.trust_config or not settings.declared
    return _idle(runs, settings) if whole and as_told and everything_ran else ()


class _Fits:
    """Which exceptions fit a result; what patterns say of a message is kept, as messages come again and again."""

    def __init__(self, settings: Settings, matches: Matches, package: Callable[[str], str | None]) -> None:
        self.exemptions = settings.exemptions
        self.matches = matches
        self.package = package
        self.places: dict[tuple[Exemption, str], bool] = {}
        self.rules: dict[tuple[Exemption, str, str, tuple[str, ...]], bool] = {}
        self.messages: dict[tuple[str, str], bool] = {}

    def marked(self, result: Result) -> Result:
        found = tuple(_suppression(e) for e in self.exemptions if self.fits(e, result))
        return replace(result, suppressions=(*result.suppressions, *found)) if found else result

    def fits(self, exemption: Exemption, result: Result) -> bool:
        return (
            self.in_place(exemption, result.location.path)
            and self.has_rule(exemption, result)
            and self.says(exemption, result.message)
        )

    def in_place(self, exemption: Exemption, path: str) -> bool:
        key = (exemption, path)
        if key not in self.places:
            here = not exemption.files or any(globs.matches(glob, path) for glob in exemption.files)
            if here and exemption.packages:
                name = self.package(path)
                here = name is not None and any(globs.compiled(glob)(name) for glob in exemption.packages)
            self.places[key] = here
        return self.places[key]

    def has_rule(self, exemption: Exemption, result: Result) -> bool:
        if not exemption.rules:
            return True
        key = (exemption, result.tool, result.rule, result.also)
        if key not in self.rules:
            self.rules[key] = any(self.matches(selector, result) for selector in exemption.rules)
        return self.rules[key]

    def says(self, exemption: Exemption, message: str) -> bool:
        if not exemption.message:
            return True
        key = (exemption.message, message)
        if key not in self.messages:
            self.messages[key] = compiled(exemption.message).search(message[:MAX_MESSAGE]) is not None
        return self.messages[key]


def _suppression(exemption: Exemption) -> Suppression:
    reason = exemption.reason or f"accepted by the exception at {exemption.origin}"
    return Suppression("external", reason, source=exemption.origin)


__all__ = ["exempt", "idle_entries", "pattern", "read_exemptions"]
