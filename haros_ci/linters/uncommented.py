# SPDX-License-Identifier: Apache-2.0
"""What linters say of files without the comments that silence them: what these hide nobody else tells.

A comment is made one of no meaning, character by character, in the copies that tools get: lines and columns stay. pylint tells by itself what most of
its comments silence; the others' tools do not.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from typing import Any, cast

from haros_ci.linters.linter import REFUTED, SILENCED, Linter, LintOptions, Unit
from haros_ci.linters.rows import IsSelected
from haros_ci.linters.run import lint
from haros_ci.linters.work import asked_for, units_of
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Reader, Store, Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import comments, lines_of, syntax
from haros_ci.results.result import Result, Run
from haros_ci.results.silencers import FORMS, Form, joined

#: By tool the words without which no comment of a text silences it; a tool that is not here has none that hides a defect, or tells what it silences.
_WORDS: dict[str, re.Pattern[str]] = {
    "cppcheck": regex("cppcheck-suppress"),
    "clang-tidy": regex("NOLINT"),
    "cpplint": regex("NOLINT|LINT_C_FILE|LINT_KERNEL_FILE"),
    "pylint": regex(r"pylint:[^\n]*\b(?:skip-file|all)\b"),
    **dict.fromkeys(("ruff", "flake8", "vulture"), regex(r"noqa", re.IGNORECASE)),
    "mypy": regex(r"#\s*(?:type:\s*ignore|mypy:)"),
    "bandit": regex(r"nosec", re.IGNORECASE),
    "shellcheck": regex(r"shellcheck\s"),
    "yamllint": regex(r"yamllint\s"),
    "hadolint": regex(r"hadolint\s"),
    "flawfinder": regex(r"(?i)flawfinder|rats:|its4:"),
}
_LETTERS = regex(r"[A-Za-z0-9_]")
#: The rules that a comment names, behind the words that make it one.
_MEANT = regex(
    r"(?:cppcheck-suppress(?:-\w+)?|NOLINT\w*|noqa|disable|ignore|nosec)(?:[\s:=(]*\[([^\]]*)|[\s:=(\[]*([^#;)\]\n]*))",
    re.IGNORECASE,
)
_RULE = regex(r"[A-Za-z*][\w./+*-]*")


@dataclass(frozen=True, slots=True)
class _Rewritten:
    """*inner* with other texts for some files."""

    inner: Reader
    texts: dict[str, str]

    def text(self, path: str) -> str:
        found = self.texts.get(path)
        return self.inner.text(path) if found is None else found

    def data(self, path: str) -> bytes | None:
        found = self.texts.get(path)
        return self.inner.data(path) if found is None else found.encode("utf-8", "surrogatepass")

    def head(self, path: str, length: int) -> bytes:
        return self.inner.head(path, length)


class _Some:
    """The adapter *linter* for some of its units."""

    def __init__(self, linter: Linter, paths: Collection[str]) -> None:
        self._linter = linter
        self._paths = paths

    def __getattr__(self, name: str) -> Any:
        return getattr(self._linter, name)

    def plan(self, workspace: Workspace, options: LintOptions, store: Store) -> Iterator[Unit]:
        """Those units whose file is one of the paths."""
        return (unit for unit in units_of(self._linter, workspace, options, store) if unit.file.path in self._paths)


def silenced_findings(
    workspace: Workspace,
    changed: frozenset[str],
    linters: Iterable[Linter],
    options: LintOptions,
    store: Store,
    is_selected: IsSelected,
) -> tuple[Run, ...]:
    """A run for each of *linters* with what comments keep it from saying of files that have *changed*, or that use such a file.

    Nothing is run where no comment can silence it. Results are those that tools have without the comments alone, of rules that are on; notifications
    those on files that cannot be analysed without them: what comments hide there is not known.
    """
    done = []
    for linter in linters:
        words = _WORDS.get(linter.NAME)
        if words is None or linter.NAME in options.disabled:
            continue
        own = [file.path for file in workspace.files if file.language in linter.LANGUAGES]
        if changed.isdisjoint(own) or not any(words.search(joined(_read(workspace, path), "c")) for path in own):
            continue
        units = _concerned(linter, workspace, changed, options, store, is_selected)
        if not units:
            continue
        some = [cast(Linter, _Some(linter, frozenset(unit.file.path for unit in units)))]
        needed = frozenset(path for unit in units for path in (unit.file.path, *unit.dependencies))
        heard, noted = set[object](), set[object]()
        for run in lint(workspace, some, options, store, is_selected):
            heard.update(map(_key, run.results))
            noted.update((note.path, note.message) for note in run.notifications)
        for run in lint(_bare(workspace, needed), some, options, store, is_selected):
            results = tuple(one for one in run.results if _key(one) not in heard and _counts(one))
            lost = tuple(note for note in run.notifications if note.path and (note.path, note.message) not in noted)
            done += [Run(run.tool, results=results, notifications=lost)] if results or lost else []
    return tuple(done)


def _read(workspace: Workspace, path: str) -> str:
    """The text of a file that may not be looked at again."""
    return (workspace.data(path) or b"").decode("latin-1")


def _key(result: Result) -> tuple[object, ...]:
    return result.full_id, result.location.path, result.location.line, result.message


def _counts(result: Result) -> bool:
    return result.rule != SILENCED and not result.rule.startswith(REFUTED)


def _concerned(
    linter: Linter,
    workspace: Workspace,
    changed: Collection[str],
    options: LintOptions,
    store: Store,
    is_selected: IsSelected,
) -> list[Unit]:
    """The units of *linter* that depend on something *changed*, and of which a comment may silence a rule that is on."""
    known: dict[str, bool] = {}
    hopeless: frozenset[str] = getattr(linter, "GAVE_UP", frozenset())

    def may_be_silent(path: str) -> bool:
        if path not in known:
            language = files[path].language if path in files else ""
            rules = _may_silence(linter.NAME, workspace.text(path), syntax(language, path))
            known[path] = any(not rule or rule in hopeless or is_selected(linter.NAME, rule, path) for rule in rules)
        return known[path]

    files = {file.path: file for file in workspace.files}
    return [
        unit
        for unit in asked_for(units_of(linter, workspace, options, store), workspace)
        if any(path in changed for path in (unit.file.path, *unit.dependencies))
        and any(may_be_silent(path) for path in (unit.file.path, *unit.covers))
    ]


def _may_silence(tool: str, text: str, kind: str) -> Iterator[str]:
    """The rules of *tool* that comments of *text* may silence; "" for one that names none, or many."""
    words = _WORDS[tool]
    if not words.search(joined(text, kind)):
        return
    forms = _forms(kind, tool)
    for unspliced in (joined(comment.text, kind) for comment in comments(text, kind)):
        if words.search(unspliced) and any(form.pattern.search(unspliced) for form in forms):
            meant = _MEANT.search(unspliced)
            rules = _RULE.findall(meant[1] or meant[2] or "") if meant else []
            yield from ("" if "*" in rule or rule == "all" else rule for rule in rules or [""])


def _forms(kind: str, tool: str = "") -> list[Form]:
    return [form for form in FORMS if kind in form.kinds and (not tool or tool in form.tools)]


def _bare(workspace: Workspace, paths: Collection[str]) -> Workspace:
    """*workspace*, in which the files at *paths* have no comments that silence anything."""
    texts: dict[str, str] = {}
    files: list[SourceFile] = []
    for file in workspace.files:
        text = workspace.text(file.path) if file.path in paths else ""
        made = without_silencers(text, syntax(file.language, file.path)) if text else text
        if made is not text:
            texts[file.path] = made
            file = replace(file, digest=hashlib.sha256(made.encode("utf-8", "surrogatepass")).hexdigest())
        files.append(file)
    return replace(workspace, files=tuple(files), reader=_Rewritten(workspace.reader, texts))


def without_silencers(text: str, kind: str) -> str:
    """*text*, of which each comment that silences a tool says nothing any more; the same object where there is none. Lines and columns stay."""
    forms = _forms(kind)
    unspliced = joined(text, kind)
    if not any(word.search(unspliced) for word in _WORDS.values()):
        return text
    plain = "\n".join(lines_of(text))
    starts = [0]
    for line in plain.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    parts, at = [], 0
    for comment in comments(plain, kind):
        unspliced = joined(comment.text, kind)
        if any(form.pattern.search(unspliced) for form in forms):
            start = starts[comment.line - 1] + comment.column - 1
            parts += [plain[at:start], _LETTERS.sub("x", comment.text)]
            at = start + len(comment.text)
    return "".join((*parts, plain[at:])) if parts else text
