# SPDX-License-Identifier: Apache-2.0
"""The comments that ask for silence: ``haros: ignore[rule] reason`` and its relatives."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.results.comments import comments, lines_of
from haros_ci.results.result import Suppression

_MARK = "haros:"
_DIRECTIVE = regex(
    r"haros:[ \t]*(?P<kind>ignore-next-line|ignore-line|ignore)(?![\w-])[ \t]*"
    r"(?:\[(?P<rules>[^\]\n]*)\])?(?P<reason>[^\n]*)"
)
#: The comments that clang-tidy and flake8 honour; metrics of ours do, too.
_NATIVE = {
    "c": ("NOLINT", regex(r"\bNOLINT(?P<next>NEXTLINE)?(?!\w)(?:\((?P<rules>[^)\n]*)\))?")),
    "python": ("noqa", regex(r"#[ \t]*noqa(?P<next>)(?!\w)(?:[ \t]*:[ \t]*(?P<rules>[\w,\- \t]+))?")),
}
_MOST_SELECTORS = 100
_LONGEST_REASON = 300
_LONGEST_WORDS = 100


@dataclass(frozen=True, slots=True)
class Directive:
    """Silence for the rules that *selectors* name, all if there are none, on *line*; *place* is the comment's own."""

    line: int
    selectors: tuple[str, ...]
    suppression: Suppression
    place: Location
    words: str
    metrics_only: bool = False


def directives(text: str, path: str, kind: str, *, metrics: bool = False) -> Iterator[Directive]:
    """The directives in the comments of a file of syntax *kind*, top to bottom; with *metrics*, NOLINT and noqa, too.

    ``ignore`` holds for its own line, or, in a comment that stands alone, for the next line of code. As in HAROS,
    ``ignore-line`` and ``ignore-next-line`` hold for the physical line.
    """
    if _MARK in text:
        code: list[int] | None = None
        for comment in comments(text, kind, _MARK):
            for match in _DIRECTIVE.finditer(comment.text):
                own = comment.line + comment.text.count("\n", 0, match.start())
                line = own + (match["kind"] == "ignore-next-line")
                if match["kind"] == "ignore" and comment.alone:
                    code = code_lines(text, kind) if code is None else code
                    after = bisect_right(code, comment.end_line)
                    line = code[after] if after < len(code) else own
                yield _directive(match, line, Location(path, own, comment.column if own == comment.line else None))
    mark, pattern = _NATIVE.get(kind, ("", None))
    if metrics and pattern and mark in text:
        for comment in comments(text, kind, mark):
            if native := pattern.search(comment.text):
                place = Location(path, comment.line, comment.column)
                yield _directive(native, comment.line + bool(native["next"]), place, metrics_only=True)


def _directive(match: re.Match[str], line: int, place: Location, *, metrics_only: bool = False) -> Directive:
    found = match.groupdict()
    names = re.split(r"[,\s]+", found["rules"] or "")
    reason = re.sub(r"[\s*\-/>]+\Z", "", found.get("reason") or "").lstrip(" \t:-—")[:_LONGEST_REASON]
    words = f"haros: {found['kind']}" if "kind" in found else match[0]
    if "kind" in found and found["rules"] is not None:
        words += f"[{found['rules']}]"
    return Directive(
        line=line,
        selectors=tuple(dict.fromkeys(name for name in names if name))[:_MOST_SELECTORS],
        suppression=Suppression("inSource", reason, place),
        place=place,
        words=words[:_LONGEST_WORDS],
        metrics_only=metrics_only,
    )


def code_lines(text: str, kind: str) -> list[int]:
    """The lines that hold more than comments, ascending."""
    empty = {number for number, line in enumerate(lines_of(text), 1) if not line or line.isspace()}
    for comment in comments(text, kind):
        if comment.alone:
            empty.update(range(comment.line, comment.end_line + 1))
    return [number for number in range(1, len(lines_of(text)) + 1) if number not in empty]
