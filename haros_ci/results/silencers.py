# SPDX-License-Identifier: Apache-2.0
"""The comments that suppress findings of each tool: one table of their forms."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import SPLICE, Comment, comments, lines_of

#: Kinds of syntax (``comments.syntax``) in which comments begin with a hash.
_HASHED = frozenset(("python", "yaml", "cmake", "shell", "dockerfile", "interface"))


@dataclass(frozen=True, slots=True)
class Form:
    """One form: what it is called, the *tools* that obey it, in which *kinds* of syntax, and what the comment looks like.

    *only_beside_code*: on a line of its own it silences nothing.
    """

    name: str
    tools: tuple[str, ...]
    kinds: frozenset[str]
    pattern: re.Pattern[str]
    only_beside_code: bool = False


def _form(name: str, tools: str, kinds: str | frozenset[str], pattern: str, *, beside: bool = False) -> Form:
    known = frozenset(kinds.split()) if isinstance(kinds, str) else kinds
    return Form(name, tuple(tools.split()), known, re.compile(pattern), beside)


#: The first pragma of the comment, in which ``enable=…`` may come before what disables.
_PYLINT = r"#(?:(?!\bpylint:)[^\n])*\bpylint:(?:(?!\b(?:disable|skip-file)\b)[^\n])*\b(?:disable(?:-next|-msg)?|skip-file)\b[^\n]*"

#: The sources of the patterns are the tools' own: cpplint's _RE_SUPPRESSION, clang-tidy's NoLintDirectiveHandler, flake8's defaults.NOQA_*,
#: pylint's pragma_parser, mypy's type comments, cppcheck's manual ("Inline suppressions"), the manuals of the others.
FORMS = (
    _form("NOLINT", "clang-tidy cpplint", "c", r"\bNOLINT(?!\w)(?:\([^)\n]*\))?", beside=True),
    _form("NOLINTNEXTLINE", "clang-tidy cpplint", "c", r"\bNOLINTNEXTLINE(?!\w)(?:\([^)\n]*\))?"),
    _form("NOLINTBEGIN", "clang-tidy cpplint", "c", r"\bNOLINTBEGIN(?!\w)(?:\([^)\n]*\))?"),
    _form("LINT_C_FILE", "cpplint", "c", r"\bLINT_(?:C|KERNEL)_FILE|\bvim?:[^\n]*filetype=c(?:[\s:]|\Z)"),
    _form("cppcheck-suppress", "cppcheck", "c", r"\A/[/*]\s*cppcheck-suppress(?:-begin|-file|-macro)?\b[^\n]*"),
    _form("clang-format off", "clang-format", "c", r"\A/[/*]\s*clang-format off\b"),
    _form("Flawfinder: ignore", "flawfinder", "c", r"(?i)\b(?:Flawfinder|RATS|ITS4):\s*ignore\b"),
    _form("noqa", "flake8 pylint ruff vulture", "python", r"(?i)#\s*noqa(?:\s*:\s*[A-Z][\w,\s]*)?", beside=True),
    _form("flake8: noqa", "flake8", "python", r"(?i)\A#\s*flake8[:=]\s*noqa\b[^\n]*"),
    _form("ruff: noqa", "ruff", "python", r"(?i)\A#\s*ruff\s*:\s*(?:noqa|ignore|disable)\b[^\n]*"),
    _form("pylint: disable", "pylint", "python", _PYLINT),
    _form("type: ignore", "mypy", "python", r"#\s*type:\s*ignore(?!\w)(?:\[[^\]\n]*\])?"),
    _form("mypy:", "mypy", "python", r"\A#\s*mypy:\s*\S[^\n]*"),
    _form("nosec", "bandit", "python", r"(?i)#\s*nosec[^\n]*", beside=True),
    _form("fmt: off", "black ruff", "python", r"#\s*fmt:\s*(?:off|skip)\b"),
    _form("yapf: disable", "black", "python", r"\A#\s*yapf:\s*disable\b"),
    _form("isort: skip", "isort", "python", r"(?i)\bisort:\s*(?:skip_file|skip|off|dont-add-imports?|split)\b"),
    _form("#lizard forgives", "lizard", "python c", r"#\s*lizard forgives?\b"),
    _form("GENERATED CODE", "lizard", "python c", r"\bGENERATED CODE\b"),
    _form("shellcheck disable", "shellcheck", "shell", r"\A#\s*shellcheck\s[^\n]*\bdisable=[^\n]*"),
    _form("hadolint ignore", "hadolint", "dockerfile", r"\A\s*#\s*hadolint\s[^\n]*\bignore=[^\n]*"),
    _form("yamllint disable", "yamllint", "yaml", r"\A#\s*yamllint\s+disable(?:-line|-file)?\b[^\n]*"),
    _form("catkin_lint", "catkin_lint", "cmake xml", r"#?catkin_lint:\s*(?:ignore|ignore_once|report)\b[^\n]*"),
    _form("lint_cmake", "cmakelint", "cmake", r"\A#\s*lint_cmake:\s*[^\n]*-[\w/]+[^\n]*"),
    _form("cmake-lint: disable", "cmake-lint", "cmake", r"\A#\s*cmake-lint:\s*disable\b[^\n]*"),
    _form("cmake-format: off", "cmake-lint", "cmake", r"\A#\s*cmake-format:\s*off\b"),
    _form("codespell:ignore", "codespell", _HASHED | {"c", "xml"}, r"(?i)\bcodespell:ignore\b[^\n]*"),
)

#: A cheap look whether a text, in lower case, can hold any of them.
_HINTS = (
    "nolint", "lint_", "filetype=c", "cppcheck", "clang-format", "noqa", "ruff", "pylint", "type:", "mypy:", "nosec", "fmt:", "yapf:",
    "isort:", "lizard", "shellcheck", "hadolint", "yamllint", "catkin_lint", "cmake-", "codespell", "flawfinder", "rats:", "its4:",
    "generated code",
)  # fmt: skip
#: A comment that keeps pylint out of a file: what it silences there nobody tells.
_EVERYTHING = regex(r"pylint:[^\n]*\bdisable=(?:[\w,-]*,)?all\b")
#: What a generated file says of itself in its first lines.
_GENERATED = regex(r"(?i)\b(?:do not edit|auto-?generated|automatically generated|generated (?:by|from|file|code))\b")
_HEAD = 10


@dataclass(frozen=True, slots=True)
class Silencer:
    """A comment of that *form* on *line*: its *words* without white space, and the *code* that it stands beside or before, on *code_line*."""

    form: Form
    line: int
    words: str
    code: str
    code_line: int


def silencers(text: str, kind: str) -> Iterator[Silencer]:
    """Every comment in a file of syntax *kind* that silences a tool, top to bottom. Strings and prose are none."""
    lower = _joined(text).lower()
    if not any(hint in lower for hint in _HINTS):
        return
    forms = [form for form in FORMS if kind in form.kinds]
    lines = lines_of(text) if forms else []
    for comment in comments(text, kind) if forms else ():
        unspliced = joined(comment.text, kind)
        for form in forms:
            if form.only_beside_code and comment.alone:
                continue
            if (found := form.pattern.search(unspliced)) is None:
                continue
            if form.name == "type: ignore" and comment.alone and _follows_code(lines, comment):
                continue
            line = comment.line + unspliced.count("\n", 0, found.start())
            code, code_line = _code_of(lines, comment)
            words = "".join(found[0].split())
            if comment.alone and _EVERYTHING.search(words):
                words = f"{words} alone"  # of the whole file; beside code, of its line
            yield Silencer(form, line, words, code, code_line)


def joined(comment: str, kind: str) -> str:
    """What a *comment* says to a tool: in C++ without the ends of lines that go on in the next one, where that is one word more ([lex.phases])."""
    return _joined(comment) if kind == "c" else comment


def _joined(text: str) -> str:
    return SPLICE.sub("", text) if "\\" in text else text


def _code_of(lines: list[str], comment: Comment) -> tuple[str, int]:
    """The code beside *comment*, or on the next line that is not blank, without white space, and its line."""
    if not comment.alone:
        return "".join(lines[comment.line - 1][: comment.column - 1].split()), comment.line
    following = lines[comment.end_line : comment.end_line + 5]
    index = next((index for index, line in enumerate(following) if line.strip()), None)
    return ("", comment.line) if index is None else ("".join(following[index].split()), comment.end_line + index + 1)


def is_generated(text: str) -> bool:
    """Whether the first lines say that a program has written the file."""
    return any(_GENERATED.search(line) for line in text[:4_000].splitlines()[:_HEAD])


def _follows_code(lines: list[str], comment: Comment) -> bool:
    """Whether anything but comments stands above *comment*: only at the top ``type: ignore`` is for the whole file."""
    return any(line.strip() and not line.lstrip().startswith("#") for line in lines[: comment.line - 1])
