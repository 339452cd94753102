# SPDX-License-Identifier: Apache-2.0
"""C++ text in which no directive can make a tool open what lies outside the analysed tree.

A directive stays as it is if its target is relative and cannot climb out of any directory that it may be looked for in, or
climbs, but to a file that is there. All others are overwritten with blanks, so that lines and columns stay: absolute
targets, targets that a macro makes, what cannot be read. The search is for the words, wherever they stand: in comments and
strings, too, as a tool's idea of where these end may be another one. There the words alone go, and what is blanked behind them ends
no comment or text that may be open: what is none to a compiler stays code.

``#line`` goes as well: by it a tool would say of code that it stands in another file. So does ``#error``: cppcheck looks at nothing of a file
in which it meets one, in whatever configuration.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from posixpath import normpath

from haros_ci.regex import regex

#: What may stand between words: cppcheck takes each control character for a blank.
_BETWEEN = r"[\x00-\x09\x0b-\x20]"
_BLANKS = "".join(map(chr, (*range(0x0A), *range(0x0B, 0x21))))
#: A line that goes on in the next (C++ standard, [lex.phases] 2), some compilers allow blanks between.
_SPLICE = rf"(?:\\|\?\?/){_BETWEEN}*\n"
_SPLICES = regex(_SPLICE)
_ENDS = regex(rf"{_SPLICE}|[\r\n]")
#: A text without any of these has nothing to look at, once lines are spliced.
_MARKS = ("include", "import", "embed", "pragma")
#: What introduces a directive, in all spellings ([lex.digraph]; trigraphs until C++17).
_HASH = regex(r"#|%:|\?\?=")
_USUAL_HASH = regex("#")
_BLANK = regex(rf"(?:{_BETWEEN}|{_SPLICE})*")
_WORD = regex(rf"(?:[A-Za-z_0-9]|{_SPLICE})+")
_OPENING = frozenset({"include", "include_next", "import", "embed"})
#: A pragma that opens the file that it names (GCC, "Other Directives"; clang and MSVC have more).
_PRAGMA = regex(r"dependency|include|module|header|comment|load")


def _spliced(word: str) -> str:
    return rf"(?:{_SPLICE})*".join(map(re.escape, word))


_HAS = regex(
    r"(?<!\w)(?:" + "|".join(map(_spliced, ("__has_include_next", "__has_include", "__has_embed"))) + r")(?!\w)"
)
#: What may stand before the name of such a function where it is only asked whether there is one.
_ASKED = regex(r"(?:defined(?:[ \t]*\()?|#[ \t]*ifn?def)[ \t]*$")
#: What ends a tool's work, or sets the line and the file that it names (C++ standard, [cpp.error], [cpp.line]; "Preprocessor Output" of GCC's manual for ``# 1 "a.cpp"``).
_MOVES = regex(rf"(?:#|%:|\?\?=){_BETWEEN}*(?:/\*|line|error|[0-9])")
#: What ends a comment, or a raw text ([lex.string]): to blank it would make code a part of either.
_CLOSING = regex(r"\*/|\)[^()\\\s\"]{0,16}\"|\r(?!\n)")
#: Comments and blanks, as far as they stand in one line.
_COMMENTS = regex(rf"(?:{_BETWEEN}|/\*(?:[^*]|\*(?!/))*\*/)*")
#: Characters before a directive that are looked at.
_NEAR = 400
#: A byte-order mark of UTF-8, read as Latin-1.
_BOM = "\xef\xbb\xbf"
#: An import of a header (C++20), and what it follows: the beginning of a line or a statement, a comment, ``export``.
_IMPORT = regex(rf"(?<![A-Za-z0-9_]){_spliced('import')}(?=(?:{_BETWEEN}|{_SPLICE}|/\*)*[\"<])")
_BEFORE_IMPORT = (";", "{", "}", "*/", "export", "\n")
_DRIVE = regex(r"[A-Za-z]:")

Exists = Callable[[str], bool]


def confined(text: str, directory: str, exists: Exists) -> str:
    """*text* of a file in *directory* (relative to the root, "" for the root itself) without what leads out.

    *exists* tells whether there is a file of the analysed tree at a path relative to the root. Returns *text* itself if
    nothing had to go.
    """
    plain = _SPLICES.sub("", text) if "\\" in text or "??/" in text else text
    if not any(mark in plain for mark in _MARKS) and _MOVES.search(plain) is None:
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
    return _unspliced(text, "".join((*parts, text[at:])))


def _unspliced(text: str, made: str) -> str:
    """*made* of *text* without backslashes behind which all is blank now: the next line would be a part of theirs."""
    if "\\" not in made and "??/" not in made:
        return made
    lines = made.split("\n")
    for at, (before, after) in enumerate(zip(text.split("\n"), lines, strict=True)):
        if before != after and not before.rstrip(_BLANKS).endswith(("\\", "??/")):
            kept = after.rstrip(_BLANKS)
            while kept.endswith(("\\", "??/")):
                kept = kept.removesuffix("\\").removesuffix("??/").rstrip(_BLANKS)
            lines[at] = kept + "".join(c if c in _BLANKS else " " for c in after[len(kept) :])
    return "\n".join(lines)


#: From, to, and what to write at its beginning.
_Doomed = tuple[int, int, str]


def _directives(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    done = line = gone = 0
    hashes = _HASH if "%:" in text or "??=" in text else _USUAL_HASH
    for match in hashes.finditer(text):
        if match.start() < done:
            continue
        at = gaps.after(match.end())
        word, end = gaps.word(at)
        behind = _behind(word, end, match.start(), directory, exists, gaps)
        becomes_one = match.start() < line and not gaps.follows_comment(gone, match.start())
        if behind is not None or becomes_one:  # nothing may become a directive in place of one that is gone
            yield match.start(), match.end(), ""
        if behind is not None:
            gone = match.start()
            yield at, end, ""
            start, done = behind if gaps.begins_line(match.start()) else (end, end)
            yield start, done, ""
            line = gaps.end_of_line(done)


def _behind(word: str, end: int, hash_at: int, directory: str, exists: Exists, gaps: _Gaps) -> tuple[int, int] | None:
    """What has to go behind the *word* of a directive, from and to; None if the directive stays."""
    text = gaps.text
    if word in _OPENING:
        target, done = gaps.target(end)
        if target is not None:
            if _is_inside(target, directory, exists):
                return None
            if _CLOSING.search(target):
                return end, end
            ends = gaps.end_of_line(done)
            comment = text.find("/*", done, ends)
            end, done = done - len(target), ends if comment < 0 else comment
    elif word == "pragma":
        done = gaps.end_of_line(end)
        if not gaps.opens_what_is_outside(end, done):
            return None
    elif word in ("line", "error") or word[:1].isdigit():
        done = gaps.end_of_line(end)
        before = gaps.before(hash_at).rstrip(_BLANKS)
        if before and not before.endswith("*/"):
            return None
    else:
        return None
    closing = _CLOSING.search(text, end, done)
    return end, done if closing is None else closing.start()


def _imports(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    done = 0
    for match in _IMPORT.finditer(text):
        before = text[max(0, match.start() - _NEAR) : match.start()].rstrip(_BLANKS)
        if match.start() < done or (before and not before.endswith(_BEFORE_IMPORT)):
            continue
        target, done = gaps.target(match.end())
        if target is None or not _is_inside(target, directory, exists):
            done = match.end()
            yield match.start(), done, ""


def _questions(text: str, directory: str, exists: Exists, gaps: _Gaps) -> Iterator[_Doomed]:
    """What asks whether a file is there: the answer is no."""
    done = 0
    for match in _HAS.finditer(text):
        if match.start() < done:
            continue
        opening = gaps.after(match.end())
        if text[opening : opening + 1] != "(":
            if not _ASKED.search(gaps.before(match.start())):
                yield match.start(), match.end(), "0"
            continue
        target, done = gaps.target(opening + 1, ")")
        if target is not None and _is_inside(target, directory, exists):
            continue
        yield match.start(), match.end(), "0"
        closing = gaps.after(done)
        done = closing + 1 if text[closing : closing + 1] == ")" else done
        is_condition = _HASH.match(gaps.before(match.start()).lstrip(_BLANKS)) is not None
        if (
            is_condition
            and _CLOSING.search(text, opening, done + 20) is None
            and (target or '"' not in text[opening:done])
        ):
            yield opening, done, ""
        else:
            done = match.end()


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
        self._pragmas = (
            -1,
            False,
        )  # where the last line with a pragma ends, and whether its first one may open what lies outside

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

    def before(self, at: int) -> str:
        """What stands before a position in its logical line, without splices; of much the end."""
        near = _SPLICES.sub("", self.text[max(at - _NEAR, 0) : at]).removeprefix(_BOM)
        return near[max(near.rfind("\n"), near.rfind("\r")) + 1 :]

    def begins_line(self, at: int) -> bool:
        """Whether nothing but blanks and comments stands before a position in its line, also of a comment that began above."""
        before = self.before(at)
        if _COMMENTS.fullmatch(before):
            return True
        return before.rstrip(_BLANKS).endswith("*/") and '"' not in before and len(before) < _NEAR - 20

    def follows_comment(self, gone: int, at: int) -> bool:
        """Whether what is *gone* stood in a comment that ends before a position in its line, which begins that line so."""
        between = self.text[gone:at] if at - gone < _NEAR else ""
        return "*/" in between and "/*" not in between and self.begins_line(at)

    def opens_what_is_outside(self, start: int, end: int) -> bool:
        """Whether the pragma with the words from *start* to the *end* of its line may; of several in a line the first decides, which has the words of all."""
        if self._pragmas[0] != end:
            words = self.text[start:end]
            outside = _names_outside(words) and _PRAGMA.search(_SPLICES.sub("", words)) is not None
            self._pragmas = (end, outside)
        return self._pragmas[1]

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
                before = self.text[max(last - 1, 0) : end].rstrip(_BLANKS)
                if not before.endswith(("\\", "??/")):
                    last = end
                    break
                last = end + 1
            self._line = (at, last)
        return last
