# SPDX-License-Identifier: Apache-2.0
"""Comments of every file kind: where they stand, and lines without them."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: A quote in a number of at most 90 characters separates digits (``1'000``); one behind any other word begins a character (``case'a'``).
_LONGEST_NUMBER = 90
#: Stands behind a quote that begins a character.
BEGINS_CHARACTER = (
    r"(?:(?<![0-9A-Fa-f]')|(?!"
    + "|".join(rf"(?<=(?<![\w'])[0-9][\w.']{{{n}}}')" for n in range(_LONGEST_NUMBER))
    + "))"
)
#: What may hide or be a comment, after its first character. Every pattern begins with a set of first characters,
#: which Python's regular expressions skip to fast, and consumes what it starts, so that a scan is linear.
C_SKIPPED = (
    r"(?<=/)(?:/[^\n\\]*(?:\\[\s\S]?[^\n\\]*)*|\*[^*]*(?:\*(?!/)[^*]*)*(?:\*/|\Z))"
    r'|(?<=")(?:(?:(?<=\bR")|(?<=\bu8R")|(?<=\b[uUL]R"))(?P<end>[^\s()\\"]{0,16})'
    r'\([^)]*(?:\)(?!(?P=end)")[^)]*)*(?:\)(?P=end)"|\Z)|[^"\\\n]*(?:\\[\s\S]?[^"\\\n]*)*"?)'
    rf"|(?<='){BEGINS_CHARACTER}"
    r"[^'\\\n]*(?:\\[\s\S]?[^'\\\n]*)*'?"
)
PYTHON_SKIPPED = (
    r"(?<=#)[^\n]*"
    r'|(?<=")(?:""[^"\\]*(?:(?:\\[\s\S]?|"(?!""))[^"\\]*)*(?:"""|\Z)|[^"\\\n]*(?:\\[\s\S]?[^"\\\n]*)*"?)'
    r"|(?<=')(?:''[^'\\]*(?:(?:\\[\s\S]?|'(?!''))[^'\\]*)*(?:'''|\Z)|[^'\\\n]*(?:\\[\s\S]?[^'\\\n]*)*'?)"
)
PATTERNS = {
    "c": rf"""["'/](?:{C_SKIPPED})""",
    "python": rf"""["'#](?:{PYTHON_SKIPPED})""",
    "yaml": r"""(?<![^\s,:\[{-])"[^"\\]*(?:\\[\s\S]?[^"\\]*)*"?|(?<![^\s,:\[{-])'[^'\n]*'?|(?<!\S)#[^\n]*""",
    "cmake": r'"[^"\\]*(?:\\[\s\S]?[^"\\]*)*"?|#\[(?P<end>=*)\[[\s\S]*?(?:\](?P=end)\]|\Z)|#[^\n]*',
    "interface": r"""^[ \t]*w?string[ \t]+\w+[ \t]*=[^\n]*|"[^"\n]*"?|'[^'\n]*'?|#[^\n]*""",
    "shell": r"""\\[\s\S]|"[^"\\]*(?:\\[\s\S]?[^"\\]*)*"?|'[^']*'?|(?<![^\s;&|()])#[^\n]*""",
    "dockerfile": r"^[ \t]*#[^\n]*",
    "xml": r"<!\[CDATA\[[\s\S]*?(?:\]\]>|\Z)|<!--[\s\S]*?(?:-->|\Z)",
}
_MARKS = {"c": ("//", "/*"), "xml": ("<!--",)}
_HASH = ("#",)
_BY_LANGUAGE = {
    "cpp": "c",
    "python": "python",
    "yaml": "yaml",
    "cmake": "cmake",
    "interface": "interface",
    "package": "xml",
    "xml": "xml",
    "world": "xml",
    "shell": "shell",
    "dockerfile": "dockerfile",
    "markdown": "xml",
    "hpl": "interface",
}
_BY_SUFFIX = {".py": "python", ".yaml": "yaml", ".yml": "yaml", ".cfg": "yaml"}
#: The end of a line of C++ that goes on in the next one ([lex.phases] 2).
SPLICE = regex(r"\\[ \t]*\r?\n")
_SPACE = regex(r"\s+")
_LONG_LINE = 10_000  # characters; beyond, nobody writes a comment on a line of its own


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment with its marks; *alone* when nothing else stands on its lines. Lines are 1-based."""

    text: str
    line: int
    column: int
    end_line: int
    alone: bool


def syntax(language: str, path: str) -> str:
    """The comment syntax of a file, a key of the patterns above; "" where none is known."""
    if language in _BY_LANGUAGE:
        return _BY_LANGUAGE[language]
    if language in ("launch", "setup"):
        fallback = "xml" if language == "launch" else "python"
        return next((kind for suffix, kind in _BY_SUFFIX.items() if path.endswith(suffix)), fallback)
    return ""


def lines_of(text: str) -> list[str]:
    """The lines of *text*, split at LF, CRLF and CR only, without a byte-order mark. The empty text has one line."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n").split("\n")


def comments(text: str, kind: str, mark: str = "") -> Iterator[Comment]:
    """The comments of a whole file that contain *mark*, in order; text in string literals is not a comment."""
    if kind not in PATTERNS:
        return
    marks = _MARKS.get(kind, _HASH)
    text = "\n".join(lines_of(text))
    line, counted, line_start, line_end = 1, 0, 0, -1
    for match in re.compile(PATTERNS[kind], re.MULTILINE).finditer(text):
        found = match[0]
        if mark not in found or not found.startswith(marks):
            continue
        start, end = match.span()
        if breaks := text.count("\n", counted, start):
            line += breaks
            line_start = text.rfind("\n", counted, start) + 1
        counted = start
        if end > line_end:
            line_end = text.find("\n", end)
            line_end = len(text) if line_end < 0 else line_end
        alone = (
            start - line_start < _LONG_LINE
            and line_end - end < _LONG_LINE
            and not text[line_start:start].strip()
            and not text[end:line_end].strip()
        )
        yield Comment(found, line, start - line_start + 1, line + found.count("\n"), alone)


def bare(line: str, kind: str) -> str:
    """One line without comments and white space, as identities see it. A line that is all comment keeps its text."""
    marks = _MARKS.get(kind, _HASH)
    if any(mark in line for mark in marks) and kind in PATTERNS:
        code = re.compile(PATTERNS[kind]).sub(lambda match: "" if match[0].startswith(marks) else match[0], line)
        if code.strip():
            line = code
    return _SPACE.sub("", line)
