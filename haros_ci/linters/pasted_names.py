# SPDX-License-Identifier: Apache-2.0
"""Names that the preprocessor pastes of what a macro stands for (C++ standard, [cpp.concat]), where cppcheck does not have that macro.

``CAT(give_, EINTR)`` is ``give_4`` for a compiler, and ``give_EINTR`` for a tool without the headers of the system; ``__LINE__`` over several lines is
another number.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import NamedTuple

from haros_ci.linters.macros_elsewhere import MacrosElsewhere
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import without_comments

_DEFINE = regex(
    r"^[ \t]*(?:#|%:)[ \t]*define[ \t]+([A-Za-z_]\w*)(?:\(([^()\n]{0,2000})\))?((?:[^\n\\]|\\\r?\n|\\.){0,8000})", re.M
)
_CALL = regex(r"\b([A-Za-z_]\w*)\s*\(")
_BRACKET = regex(r"[(),]|\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.){1,12}'")
_WORD = regex(r"[A-Za-z_]\w*")
_PASTED = regex(r"(?:([A-Za-z_]\w*)\s*)?(?:##|%:%:)(?:\s*([A-Za-z_]\w*))?")
#: What a macro declares as a class is none itself: no macro can be a number there.
_DECLARED = regex(r"\b(?:class|struct)\s+([A-Za-z_]\w*)\s*;")
#: The beginning or the end of a name by custom, which no header of the system has a macro for.
_PIECE = regex(r"[A-Za-z]\w*_|_[a-z]\w*")
#: A name as variables have it, of several words, or a keyword: of the macros of the system's headers few are called so, and those of term.h and stdbool.h.
_USUAL = regex(
    r"(?!(?:(?:no|required|optional)_argument|sched_priority|h_addr|s_addr|(?:si|sa|st|ss|ut|sigev|ifr|ifc|ifa|ip6|icmp6|nd|mld|rr|ip6t|ipt|arpt|input_event|sqlite3|res|d|tc|v4l2)_\w*)\Z)"
    r"(?:[a-z][a-z0-9]*(?:_[a-z0-9]+)+|bool|char|short|int|long|float|double|unsigned|signed|void|auto|const|static|inline|return|true|false|nullptr|this|class|struct|enum|typename)"
)
_ODD_HEADERS = regex(r"\b(?:n?(?:term|cap|curses)\w*|stdbool)\.h\b")
#: Rounds in which macros that hand an argument on are found, characters of the arguments of one call, and brackets and commas that are read of one file.
_ROUNDS, _LONGEST, _MOST = 8, 4_000, 200_000
_NUMBERED = regex(r"\b([A-Za-z_]\w*?)\d+\b")


class _Macro(NamedTuple):
    parameters: tuple[str, ...] | None
    body: str


#: By the name of a macro the numbers of its parameters.
_Places = dict[str, set[int]]


def pattern(names: Iterable[str]) -> re.Pattern[str] | None:
    """What finds one of *names* as a word; None without any."""
    listed = sorted(names)
    return re.compile(rf"\b(?:{'|'.join(map(re.escape, listed))})\b") if listed else None


def pasted(file: SourceFile, workspace: Workspace, elsewhere: MacrosElsewhere) -> Iterator[str]:
    """The names in *file* that are pasted to others after they have been expanded, and that no file of the workspace which it includes defines."""
    texts = [without_comments(workspace.text(path), "c") for path in (file.path, *elsewhere.reached(file))]
    if not any("##" in text or "%:%:" in text for text in texts):
        return
    macros: dict[str, _Macro] = {}
    for text in texts:
        for match in _DEFINE.finditer(text):
            parameters = None if match[2] is None else tuple(word.strip() for word in match[2].split(","))
            macros[match[1]] = _Macro(parameters, match[3])
    places = _handed_on(macros)
    if places:
        usual = None if any(_ODD_HEADERS.search(text) for text in texts) else _USUAL
        yield from dict.fromkeys(_odd(texts[0], macros, places, usual))


def _handed_on(macros: Mapping[str, _Macro]) -> _Places:
    """The parameters that are expanded, and then pasted by a macro that is called with them."""
    called = {name: macro for name, macro in macros.items() if macro.parameters is not None}
    direct: _Places = {}
    inner: list[tuple[str, str, list[str], set[str]]] = []
    left = [_MOST]
    for name, macro in called.items():
        words = {word for pair in _PASTED.findall(macro.body) for word in pair}
        direct[name] = {at for at, word in enumerate(macro.parameters or ()) if _name_of(word) in words}
        declared = {*_DECLARED.findall(macro.body)}
        inner += ((name, callee, arguments, declared) for callee, arguments in _calls(macro.body, called.keys(), left))
    found: _Places = {}
    for _ in range(_ROUNDS):
        grown = False
        for name, callee, arguments, declared in inner:
            taken = _taken(macros[callee], direct[callee] | found.get(callee, set()), arguments)
            words = {word for argument in taken for word in _WORD.findall(argument)} - declared
            new = {at for at, word in enumerate(macros[name].parameters or ()) if _name_of(word) in words}
            grown |= not new <= found.get(name, set())
            found.setdefault(name, set()).update(new)
        if not grown:
            break
    return {name: numbers for name, numbers in found.items() if numbers}


def _odd(text: str, macros: Mapping[str, _Macro], places: _Places, usual: re.Pattern[str] | None) -> Iterator[str]:
    bodies = [(match[2] or "", match[3]) for match in _DEFINE.finditer(text)]
    left = [_MOST]
    for parameters, part in (("", _DEFINE.sub("", text)), *bodies):
        own = {_name_of(word.strip()) for word in parameters.split(",")}
        for name, arguments in _calls(part, places, left):
            for word in (argument.strip() for argument in _taken(macros[name], places[name], arguments)):
                if _WORD.fullmatch(word) is None or _PIECE.fullmatch(word) or word in own or word in macros:
                    continue
                if usual is not None and usual.fullmatch(word):
                    continue
                if word != "__LINE__" or (
                    any("\n" in argument for argument in arguments) and _has_numbered(text, arguments)
                ):
                    yield f"the name that {name} makes of {word}"
    if left[0] < 0:
        yield "a name that is pasted, in more calls than are looked at,"


def _has_numbered(text: str, arguments: list[str]) -> bool:
    """Whether a name in *text* is one of *arguments* with a number behind it."""
    begins = {argument.strip() for argument in arguments}
    return any(found[1] in begins for found in _NUMBERED.finditer(text))


def _taken(macro: _Macro, numbers: set[int], arguments: list[str]) -> Iterator[str]:
    parameters = macro.parameters or ()
    for at in numbers:
        if at < len(parameters) and parameters[at].endswith("..."):
            yield from arguments[at:]
        else:
            yield from arguments[at : at + 1]


def _calls(text: str, names: Collection[str], left: list[int]) -> Iterator[tuple[str, list[str]]]:
    """The calls of macros with one of *names* in *text*, with their arguments; of calls in arguments, too. No more when nothing is *left*."""
    for match in _CALL.finditer(text):
        if match[1] in names:
            if left[0] < 0:
                return
            yield match[1], _arguments(text, match.end(), left)


def _arguments(text: str, at: int, left: list[int]) -> list[str]:
    found, start, depth = [], at, 0
    for match in _BRACKET.finditer(text, at, at + _LONGEST):
        left[0] -= 1
        sign = match[0]
        if sign == "(":
            depth += 1
        elif sign == ")":
            depth -= 1
        if depth < 0 or (sign == "," and depth == 0):
            found.append(text[start : match.start()])
            start = match.end()
        if depth < 0:
            break
    return found


def _name_of(parameter: str) -> str:
    """How a parameter is called in the words of its macro."""
    return parameter.removesuffix("...").strip() or "__VA_ARGS__"
