# SPDX-License-Identifier: Apache-2.0
"""C++ text in which no directive can make a tool open what lies outside the analysed tree.

A directive stays as it is if its target is relative and cannot climb out of any directory that it may be looked for in, or
climbs, but to a file that is there. All others are overwritten with blanks, so that lines and columns stay: absolute
targets, targets that a macro makes, what cannot be read. The search is for the words, wherever they stand: in comments and
strings, too, as a tool's idea of where these end may be another one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from posixpath import normpath

#: A line that goes on in the next (C++ standard, [lex.phases] 2), some compilers allow blanks between.
_SPLICE = r"(?:\\|\?\?/)[ \t\v\f\r]*\n"
_SPLICES = re.compile(_SPLICE)
_ENDS = re.compile(rf"{_SPLICE}|[\r\n]")
#: A text without any of these has nothing to look at, once lines are spliced.
_MARKS = ("include", "import", "embed", "pragma")
#: What introduces a directive, in all spellings ([lex.digraph]; trigraphs until C++17).
_HASH = re.compile(r"#|%:|\?\?=")
_USUAL_HASH = re.compile("#")
_BLANK = re.compile(rf"(?:[ \t\v\f\r]|{_SPLICE})*")
_WORD = re.compile(rf"(?:[A-Za-z_0-9]|{_SPLICE})+")
_OPENING = frozenset({"include", "include_next", "import", "embed"})
#: A pragma that opens the file that it names (GCC, "Other Directives"; clang and MSVC have more).
_PRAGMA = re.compile(r"dependency|include|module|header|comment|load")


def _spliced(word: str) -> str:
    return rf"(?:{_SPLICE})*".join(map(re.escape, word))


_HAS = re.compile("|".join(map(_spliced, ("__has_include_next", "__has_include", "__has_embed"))))
#: What may stand before the name of such a function where it is only asked whether there is one.
_ASKED = re.compile(r"(?:defined(?:[ \t]*\()?|#[ \t]*ifn?def)[ \t]*$")
#: An import of a header (C++20), and what it follows: the beginning of a line or a statement, a comment, ``export``.
_IMPORT = re.compile(rf"(?<![A-Za-z0-9_]){_spliced('import')}(?=(?:[ \t\v\f\r]|{_SPLICE}|/\*)*[\"<])")
_BEFORE_IMPORT = (";", "{", "}", "*/", "export", "\n")
_DRIVE = re.compile(r"[A-Za-z]:")

Exists = Callable[[str], bool]


def confined(text: str, directory: str, exists: Exists) -> str:
    """*text* of a file in *directory* (relative to the root, "" for the root itself) without what leads out.

    *exists* tells whether there is a file of the analysed tree at a path relative to the root. Returns *text* itself if
    nothing had to go.
    """
    plain = _SPLICES.sub("", text) if "\\" in text or "??/" in text else text
    if not any(mark in plain for mark in _MARKS):
        return text
    gaps = _Gaps(text)
    doomed = [*_directives(text, directory, exists, gaps)]
    if "import" in plain:
        doomed += _imports(text, directory, exists, gaps)
    if "__has_" in plain:
        doomed += _questions(text, directory, exists, gaps)
    if not doomed:
        return text
    parts: list[str] = []
    at = 0
    for start, end, instead in sorted(doomed):
        if end <= at:
            continue
        start = max(start, at)
        parts += (text[at:start], instead, _blanked(text[start + len(instead) : end]))
        at = end
    return "".join((*parts, text[at:]))


#: From, to, and what to write at its beginning.
_Doomed = tuple[int, int, str]


def _directives(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    done = 0
    hashes = _HASH if "%:" in text or "??=" in text else _USUAL_HASH
    for match in hashes.finditer(text):
        if match.start() < done:
            continue
        word, end = gaps.word(gaps.after(match.end()))
        if word in _OPENING:
            target, done = gaps.target(end)
            if target is None or not _is_inside(target, directory, exists):
                yield match.start(), done, ""
        elif word == "pragma":
            done = gaps.end_of_line(end)
            if _PRAGMA.search(_SPLICES.sub("", text[end:done])) and _names_outside(text[end:done]):
                yield match.start(), done, ""


def _imports(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    done = 0
    for match in _IMPORT.finditer(text):
        before = text[max(0, match.start() - 400) : match.start()].rstrip(" \t\v\f\r")
        if match.start() < done or (before and not before.endswith(_BEFORE_IMPORT)):
            continue
        target, done = gaps.target(match.end())
        if target is None or not _is_inside(target, directory, exists):
            yield match.start(), done, ""


def _questions(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    """What asks whether a file is there: the answer is no."""
    done = 0
    for match in _HAS.finditer(text):
        if match.start() < done:
            continue
        opening = gaps.after(match.end())
        if text[opening : opening + 1] != "(":
            line = text.rfind("\n", 0, match.start()) + 1
            if not _ASKED.search(text[line : match.start()]):
                yield match.start(), match.end(), "0"
            continue
        target, done = gaps.target(opening + 1, ")")
        if target is None or not _is_inside(target, directory, exists):
            closing = gaps.after(done)
            done = closing + 1 if text[closing : closing + 1] == ")" else done
            yield match.start(), done, "0"


def _is_inside(target: str, directory: str, exists: Exists) -> bool:
    """Whether *target*, with its brackets, leads to nothing outside wherever it is looked for."""
    name = _SPLICES.sub("", target[1:-1])
    if name.startswith("/") or "\\" in name or "\0" in name or "??/" in name or _DRIVE.match(name):
        return False
    depth = 0
    for part in name.split("/"):
        depth += -1 if part == ".." else part not in ("", ".")
        if depth < 0:
            break
    else:
        return True
    path = normpath(f"{directory}/{name}" if directory else name)
    return target[0] == '"' and not path.startswith("../") and exists(path)


def _names_outside(words: str) -> bool:
    return '"' in words or "<" in words or "/" in words


def _blanked(text: str) -> str:
    """Blanks in place of *text*, but for its line ends, spliced ones as they are: no line may begin where none did."""
    kept = [False] * len(text)
    for match in _ENDS.finditer(text):
        kept[match.start() : match.end()] = [True] * (match.end() - match.start())
    return "".join(c if keep else " " for c, keep in zip(text, kept, strict=True))


class _Gaps:
    """Steps over what may stand between the words of a directive; takes linear time over a whole text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._closing = 0  # the last "*/" that was found
        self._line = (1, 0)  # the last logical line that was found, from where it was looked for

    def after(self, at: int) -> int:
        """The position after blanks, spliced lines and comments; a comment without end goes to the end."""
        text = self.text
        while True:
            match = _BLANK.match(text, at)
            assert match is not None
            at = match.end()
            if not text.startswith("/*", at):
                return at
            if self._closing < at + 2:
                found = text.find("*/", at + 2)
                self._closing = len(text) if found < 0 else found
            at = min(self._closing + 2, len(text))

    def word(self, at: int) -> tuple[str, int]:
        """The word at a position, without splices, and where it ends; of one that is too long its beginning."""
        match = _WORD.match(self.text, at, at + 400)
        return ("", at) if match is None else (_SPLICES.sub("", match[0]), match.end())

    def target(self, at: int, stop: str = "/*") -> tuple[str | None, int]:
        """The header's name with its brackets, and where it ends; if it is no plain one None, and where its line ends or *stop* stands."""
        text, at = self.text, self.after(at)
        line = self.end_of_line(at)
        closing = {'"': '"', "<": ">"}.get(text[at : at + 1])
        end = -1 if closing is None else text.find(closing, at + 1, line)
        if end >= 0:
            return text[at : end + 1], end + 1
        end = text.find(stop, at, line)
        return None, line if end < 0 else end

    def end_of_line(self, at: int) -> int:
        """Where the logical line ends that a position is in."""
        first, last = self._line
        if not first <= at <= last:
            last = at
            while True:
                end = self.text.find("\n", last)
                if end < 0:
                    last = len(self.text)
                    break
                before = self.text[max(last - 1, 0) : end].rstrip(" \t\v\f\r")
                if not before.endswith(("\\", "??/")):
                    last = end
                    break
                last = end + 1
            self._line = (at, last)
        return last
