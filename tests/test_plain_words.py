# SPDX-License-Identifier: Apache-2.0
"""Words of a private vocabulary that must not come back: as names, in docstrings and comments, or on pages (CONTRIBUTING.md, Style)."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

#: Directories whose words are plain.
ROOMS = ("checks", "haros_ci")

#: Not a name of a variable, parameter, function, class or field. In their places: the name of the element, ``reported``, ``requested`` or
#: ``expected``, ``unknown``, ``exceeded``, ``message``.
NAMES = ("each", "told", "wanted", "havoc", "crossings", "said", "hearsay")
#: Not in prose: a docstring says what is reported, requested, distinguished, or returned otherwise.
PROSE = re.compile(
    r"(?<!\*)\b(?:told|wanted|havoc|crossings|hearsay)\b|\bor is none\b|\b(?:None|UserError|ValueError) if it is none[.;,]"
)
#: Not on the pages of rules and of the user guide. What somebody is told to do is plain.
ON_PAGES = re.compile(r"\btold\b(?! to\b)|\bgiven up\b", re.IGNORECASE)
#: Pages of evidence, which quote what was reported at its time, and decisions.
EVIDENCE = ("judgement", "handcheck", "history", "measurements", "corpus", "rounds/", "decisions/")
#: Places of NAMES where they mean something, each with the reason.
ALLOWED = {
    ("haros_ci/api/testing.py", "said"): "a name of haros_ci.api.testing that plug-ins use",
    ("haros_ci/model/api.py", "each"): "a key of API rows (docs/adding-an-api.md)",
    ("haros_ci/systems/known/entry.py", "each"): "a key of known nodes (docs/known-nodes.md)",
    ("haros_ci/systems/known/text.py", "each"): "the reader of that key",
}

#: Where a name may be bound, to parse few files.
_BOUND = re.compile(
    rf"\b(?:def|class|lambda|as) (?:{'|'.join(NAMES)})\b|\b(?:{'|'.join(NAMES)})\b(?: (?:in|=|:=) |=|: |[,):])"
)
_SUSPECT = re.compile(rf"\b(?:{'|'.join(NAMES)})\b")


@cache
def _sources() -> tuple[tuple[str, str], ...]:
    found = []
    for room in ROOMS:
        path = ROOT / room
        for file in sorted(path.rglob("*.py")) if path.is_dir() else (path,):
            text = file.read_text(encoding="utf-8")
            if _SUSPECT.search(text) or PROSE.search(text):
                found.append((file.relative_to(ROOT).as_posix(), text))
    return tuple(found)


def names_in(text: str) -> Iterator[tuple[int, str]]:
    """Lines and names of what a module binds: variables, parameters, functions, classes and fields."""
    if not _BOUND.search(text):
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load) and node.id in NAMES:
            yield node.lineno, node.id
        elif isinstance(node, ast.arg) and node.arg in NAMES:
            yield node.lineno, node.arg
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name in NAMES:
            yield node.lineno, node.name


def prose_in(text: str) -> Iterator[tuple[int, str]]:
    """Lines and words of docstrings and comments that are not plain."""
    if not PROSE.search(text):
        return
    at_start = True
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        is_docstring = token.type == tokenize.STRING and at_start
        if token.type == tokenize.COMMENT or is_docstring:
            yield from ((token.start[0], match[0]) for match in PROSE.finditer(token.string))
        if token.type not in (tokenize.COMMENT, tokenize.NL):
            at_start = token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING)


def test_names_are_plain() -> None:
    found = [
        f"{path}:{line}: {name}"
        for path, text in _sources()
        for line, name in names_in(text)
        if (path, name) not in ALLOWED
    ]
    assert found == []


def test_prose_is_plain() -> None:
    assert [f"{path}:{line}: {word}" for path, text in _sources() for line, word in prose_in(text)] == []


def test_pages_are_plain() -> None:
    pages = [*(ROOT / "checks").glob("*.md"), *ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
    found = [
        f"{page.relative_to(ROOT)}:{number}: {line.strip()}"
        for page in sorted(pages)
        if page.name != "CHANGELOG.md"
        and not page.relative_to(ROOT).as_posix().startswith(tuple(f"docs/{name}" for name in EVIDENCE))
        for number, line in enumerate(page.read_text("utf-8").splitlines(), start=1)
        if ON_PAGES.search(line)
    ]
    assert found == []


def test_rooms_are_there() -> None:
    assert [room for room in ROOMS if not (ROOT / room).exists()] == []


@pytest.mark.parametrize(
    "text",
    [
        "for each in found: pass",
        "x = [each for each in found]",
        "sorted(found, key=lambda each: each.path)",
        "def told(): pass",
        "def read(wanted, *, said=None): pass",
        "class A:\n    told: int = 0",
        "first, each = found",
        "if (said := found()): pass",
    ],
)
def test_fires_on_a_name(text: str) -> None:
    assert [*names_in(text)]


@pytest.mark.parametrize(
    "text",
    [
        '"""For each file in the list, one line."""',
        "# each in its own line",
        "x = found.told",
        "read(wanted=1)",
        'x = "each"',
        "x = ns['said']",
        "each_file = 1",
        "retold = 1",
        "import each",
    ],
)
def test_stays_quiet_on_other_uses(text: str) -> None:
    assert [*names_in(text)] == []


@pytest.mark.parametrize(
    "text", ['"""What is told."""', "def a():\n    '''Returns None if it is none.'''", "x = 1  # as wanted"]
)
def test_fires_on_prose(text: str) -> None:
    assert [*prose_in(text)]


@pytest.mark.parametrize(
    "text",
    ['"""None if there is none."""', "x = 'told'", "def a():\n    return 'wanted'", "# retold, unwanted", "told = 1"],
)
def test_stays_quiet_on_other_texts(text: str) -> None:
    assert [*prose_in(text)] == []
