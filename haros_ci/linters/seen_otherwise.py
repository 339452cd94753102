# SPDX-License-Identifier: Apache-2.0
"""What a change brings that cppcheck is given in another way than the compiler: notes, so that somebody looks there.

cppcheck does not read what ``#include NAME`` includes (:mod:`inclusions`), nor the arguments of macros of ROS that stand for nothing
(:mod:`ros_macros`): code there is compiled, if the workspace gives such a macro another meaning, and has no findings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.linters import ros_macros
from haros_ci.linters.dead_text import dead
from haros_ci.linters.macro_scan import is_decoration
from haros_ci.linters.macros_elsewhere import MacrosElsewhere
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Notification
from haros_ci.results.rule import Level

#: Files that are named; the rest is counted. And characters of what is quoted, and of the arguments that are looked at.
MOST_FILES = 20
_QUOTED = 80
_LONGEST = 20_000
_COMPUTED = re.compile(r"^[ \t]*(?:#|%:)[ \t]*(?:include(?:_next)?|import)[ \t]*([A-Za-z_]\w*[^\n]*)", re.M)
_DEFINED = re.compile(r"^[ \t]*(?:#|%:)[ \t]*define[ \t]+([A-Za-z_]\w*)(\([^()\n]*\))?([^\n]*)", re.M)
_TESTED = re.compile(
    r"^[ \t]*(?:#|%:)[ \t]*(?:if(n)?def[ \t]+|(?:el)?if\b[^\n]{0,200}?(!)?[ \t]*\bdefined\b[ \t(]*)([A-Za-z_]\w*)[^\n]*\n(?:[ \t]*\n)*[ \t]*(#|%:)?",
    re.M,
)
#: A comment whose end is written over two lines; a line that goes on behind other white space than blanks; what is taken for an assembler's.
_OVER_LINES = re.compile(r"\*(?:(?:\\|\?\?/)[ \t\f\v]*\r?\n[ \t\f\v]*)+/")
_ODD_SPLICE = re.compile(r"(?:\\|\?\?/)[ \t]*[\f\v][ \t\f\v]*\r?\n")
_ASSEMBLER = re.compile(r"(?<!\w)(?:_asm\b|__asm\s*\{)")
_CALL = re.compile(r"\b([A-Z]\w{3,80})[ \t]*\(")
_TOKEN = re.compile(r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,12}'|[(){};]")
#: What a decoration can mean without being code: attributes, words, other macros.
_WORDS = re.compile(
    r"(?:\s|\w|\"C\"|\[\[[^\[\]{};]{0,200}\]\]|(?:__attribute__|__attribute|__declspec)\s*\((?:[^(){};]|\((?:[^(){};]|\([^(){};]{0,200}\)){0,200}\)){0,400}\)|__pragma\s*\([^{};]{0,200}\))*"
)
#: Macros that cppcheck is given without a meaning, those with arguments and all.
_WITH_ARGUMENTS = frozenset(name.partition("(")[0] for name in ros_macros.empty() if name.endswith("(...)"))
_EMPTY = frozenset(name.partition("(")[0] for name in ros_macros.empty())


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each C++ file of *head* that has such code, which nothing in *base* has in the same words; none without a base."""
    if base is None:
        return ()
    old = {file.path: file for file in base.files if file.language == "cpp"}
    there = {file.path for file in head.files}
    known = {file.digest for file in old.values()}
    moved: set[str] | None = None
    elsewhere: MacrosElsewhere | None = None
    before_it: MacrosElsewhere | None = None
    found = []
    for file in head.files:
        if file.language != "cpp" or file.digest in known or not head.reports_on(file.path):
            continue
        elsewhere = elsewhere or MacrosElsewhere(head)
        marks = list(dict.fromkeys(_marks(file, head, elsewhere)))
        if marks and before_it is None:
            before_it = MacrosElsewhere(base)
            moved = {mark for path in old.keys() - there for mark in _marks(old[path], base, before_it)}
        before = {*(moved or ())}
        if before_it is not None and file.path in old:
            before |= {*_marks(old[file.path], base, before_it)}
        if new := [mark for mark in marks if mark not in before]:
            more = f", and {len(new) - 1} more" if len(new) > 1 else ""
            found.append(
                (file.path, f"since this change cppcheck is given {new[0]} in another way than the compiler{more}")
            )
    rest = len(found) - MOST_FILES
    text = f"{rest} more files have code that cppcheck is given in another way than the compiler"
    return (
        *(Notification(Level.NOTE, f"{words}; look at it", path=path) for path, words in found[:MOST_FILES]),
        *([Notification(Level.NOTE, text)] if rest > 0 else []),
    )


def _marks(file: SourceFile, workspace: Workspace, elsewhere: MacrosElsewhere) -> Iterator[str]:
    yield from seen_otherwise(workspace.text(file.path))
    yield from elsewhere.used(file)


def seen_otherwise(text: str) -> Iterator[str]:
    """What *text* has of this, quoted, in its order by kind; takes linear time."""
    if _OVER_LINES.search(text) is not None:
        yield "a comment whose end is written over two lines"
    if _ODD_SPLICE.search(text) is not None:
        yield "a line that goes on behind a form feed or vertical tab"
    if _ASSEMBLER.search(text) is not None:
        yield "the name _asm, which it takes for an assembler's block,"
    if "#" not in text and "%:" not in text and not any(name in text for name in _WITH_ARGUMENTS):
        return
    text = _code(text)
    yield from (f"'#include {_quoted(match[1])}'" for match in _COMPUTED.finditer(text))
    guarded = {match[3] for match in _TESTED.finditer(text)}
    for match in _DEFINED.finditer(text):
        name, arguments, meaning = match[1], match[2], match[3].strip()
        if name not in guarded or not (name in _EMPTY or is_decoration(name)) or not meaning:
            continue
        if arguments or _WORDS.fullmatch(meaning[:_LONGEST]) is None:
            yield f"the macro {name}, which it takes for nothing,"
    for match in _TESTED.finditer(text):
        if match[3] in _EMPTY and match[4] is None:
            yield f"what is compiled where {match[3]} is not defined"
    done = 0
    for match in _CALL.finditer(text):
        if match[1] in _WITH_ARGUMENTS and match.start() >= done:
            has_code, done = _read(text, match.end())
            if has_code:
                yield f"code in the arguments of {match[1]}"


def _code(text: str) -> str:
    """*text* with spliced lines joined, and without comments, raw texts and what is written false."""
    text = text.replace("\\\r\n", "").replace("\\\n", "") if "\\" in text else text
    parts, at = [], 0
    for start, end in dead(text):
        parts.append(text[at:start] + " ")
        at = end
    return "".join((*parts, text[at:]))


def _read(text: str, at: int) -> tuple[bool, int]:
    """Whether the arguments that begin there hold a statement or a block, and how far that was looked for."""
    depth = 1
    for match in _TOKEN.finditer(text, at, at + _LONGEST):
        depth += {"(": 1, ")": -1}.get(match[0], 0)
        if depth == 0 or match[0] in ("{", ";"):
            return depth > 0, match.end()
    return False, at + _LONGEST


def _quoted(text: str) -> str:
    plain = " ".join(text.split())
    return plain if len(plain) <= _QUOTED else plain[:_QUOTED] + "…"
