# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the text around them refutes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from haros_ci.linters.constant_switches import is_switched_by_hand
from haros_ci.linters.cppcheck_conditions import OF_VALUES, has_large_constant, is_of_switches, is_spelled_out
from haros_ci.linters.cppcheck_initializers import is_of_parameter
from haros_ci.linters.cppcheck_lifetimes import OF_LIFETIMES, is_text_of_message, may_be_alive
from haros_ci.linters.cppcheck_registers import OF_FIRMWARE, is_of_firmware
from haros_ci.linters.cppcheck_uses import (
    has_no_truth_value,
    is_array_that_is_copied,
    is_copied,
    is_given_back,
    is_meant,
    is_pointed_to,
    is_read_checked,
)
from haros_ci.linters.cppcheck_ways import OF_WAYS, ends_process, is_list_of_values, sets_nothing
from haros_ci.linters.moved_values import is_copied_by_move
from haros_ci.linters.scanned_texts import is_large_enough
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.scope import scopes

#: A literal of the user's own that takes a default, as pybind11's arguments do: ``"steps"_a = false``.
_NAMED_ARGUMENT = regex(r"\"_[A-Za-z]\w*[ \t]*=(?!=)")
_OF_LITERALS = frozenset({"assignBoolToPointer", "selfAssignment", "AssignmentIntegerToAddress", "stringLiteralWrite"})
#: An assertion that says why: ``assert(ok && "no solution" && __LINE__)``; cppcheck knows that of two parts alone.
_SAID = regex(r"\b\w*(?:assert|ASSERT|Assert|CHECK|REQUIRE|EXPECT)\w*[ \t]*\(.*&&[ \t]*\"")
#: ``Same expression on both sides of '-'``.
_BOTH_SIDES = regex(r"both sides of '([^'\s]{1,3})'")
_LONGEST = 2000
_OF_UNUSED = frozenset({"unreadVariable", "unusedVariable"})
#: ``Variable 'pose(2)' is assigned …`` and ``Unused variable: pose``.
_SUBJECT = regex(r"'([^']+)'|: (\w+)\.?$")
_OF_UNSET = frozenset({"uninitvar", "legacyUninitvar", "uninitStructMember"})
#: ``Uninitialized variable: made.cost``: to return *made* copies the member, and the caller may set it.
_MEMBER = regex(r": (\w+)\.\w+$")
#: Types whose objects refer to what others own: who writes to them writes there.
_VIEW = (
    r"\b(?:(?:Ref|Map|Block|VectorBlock|span|mdspan|ArrayRef|reference_wrapper)\s*<[^;{{}}()]{{0,200}}>|Mat_?(?:<[^;<>]{{0,200}}>)?)"
    r"\s*(?:&\s*)?{name}\b"
)
#: Functions of Eigen and OpenCV that return a part of a matrix and copy nothing.
_PART = (
    r"\bauto\s*(?:&&?\s*)?{name}\s*=[^;]{{0,300}}\.\s*(?:template\s+)?(?:row|col|block|segment|head|tail|diagonal|array|matrix|noalias"
    r"|topRows|bottomRows|leftCols|rightCols|middleRows|middleCols|topLeftCorner|topRightCorner|bottomLeftCorner"
    r"|bottomRightCorner|linear|translation|rotation|coeffRef|transpose|reshaped|rowRange|colRange)\s*[<(]"
)
_BINDING = r"\bauto\s*(?:&&?\s*)?\[[^\]]{{0,200}}\b{name}\b[^\]]{{0,200}}\]"
_COMMENT = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
#: What stands in a statement and seldom in a sentence.
_STATEMENT = regex(r";[ \t]*(?:$|\*/)|<<|\w\(|\)[ \t]*\{", re.MULTILINE)
_SWITCH = regex(r"[^\n{}]{0,200}\bswitch\s*\([^{};]{0,300}\)\s*\{")
_DIRECTIVE = regex(r"[ \t]*#[ \t]*(if|ifdef|ifndef|endif|define)\b[ \t]*(\w*)")


#: The last statement of a function that does not go on behind it: a call of what the standard library declares so.
_ENDING = regex(
    r"\s*(?:std\s*::\s*)?(?:rethrow_exception|throw_with_nested|terminate|abort|exit|quick_exit|_Exit|unreachable|longjmp)"
    r"\s*\([^;]{0,300};[\s}]*"
)
#: Macros of GoogleTest, Catch2, doctest and Boost.Test around what is run to see what it throws, or how it ends.
_PROVOKED = regex(
    r"\b(?:(?:EXPECT|ASSERT)_(?:ANY_|NO_)?THROW|(?:EXPECT|ASSERT)_(?:THAT_)?(?:DEATH|EXIT|DEBUG_DEATH)\w*|(?:EXPECT|ASSERT)_THROW_\w+"
    r"|(?:REQUIRE|CHECK)_(?:THROWS|NOTHROW)\w*|BOOST_(?:CHECK|REQUIRE|WARN)_(?:THROW|NO_THROW|EXCEPTION))\s*\("
)
_OF_PROVOKED = frozenset({"ignoredReturnValue", "unusedScopedObject", "constStatement", "leakReturnValNotUsed"})
_OF_LEAKS = frozenset({"memleak", "memleakOnRealloc"})
_LEAKED = regex(r": \w*leak\w*", re.IGNORECASE)
_LEAKS = regex(
    r"\b(?:intentional|deliberate|on purpose|never freed|not freed|let it)\w*[^.]{0,80}\bleak|\bleak\w*[^.]{0,80}\b(?:intentional|deliberate|purpose)",
    re.IGNORECASE | re.DOTALL,
)
#: A macro as the last statement: which cppcheck does not expand, or expands to what it does not follow.
_MACRO = regex(r"[A-Z][A-Z0-9_]{2,}")
#: Macros that write a line and go on, unless the name says that they do not.
_WRITES = regex(
    r"(?:.*_)?(?:LOG\w*|INFO|WARN(?:ING)?|DEBUG|ERROR|TRACE|PRINT\w*|VERBOSE|NOTICE|COUT|CERR)(?:_\w+)?|(?:ROS|RCLCPP|RCUTILS)_FATAL\w*"
    r"|(?:EXPECT|Q)_\w+"
)
_GOES_NOWHERE = regex(r".*(?:THROW|RAISE|ABORT|UNREACHABLE|PANIC|EXIT|ASSERT|RETURN|NORETURN|TERMINATE|NOT_?REACHED)")
_QUOTED = regex(r"\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)'")
#: ``%g in format string (no. 2) requires 'double' but the argument type is 'number_t'.``: where cppcheck knows the type
#: behind a name it says so (``{aka unsigned long}``).
_OF_PRINTF = regex(r"invalidPrintfArgType_(?:float|sint|uint|p)")
_ARGUMENT = regex(r"argument type is '(?:const )?(\w+)(?: const)?'")
#: Lines of the last statement that are looked at.
_STATEMENT_LINES = 8
_PLACED = regex(r"\bnew\s*\([^;]{1,300}\)\s*[A-Za-z_:][\w:<>, ]{0,200}\s*[({]")
_LOOP = regex(r"\bfor\s*\(\s*\w+\s*;")
_BY_NAME = regex(r"%=?\s*(?:\(\s*)?[A-Za-z_]")
_BY_ONE = regex(r"%=?\s*(?:\(\s*)?1\b")
_OF_CONDITIONS = frozenset({"identicalInnerCondition", "duplicateCondition"})


def is_refuted(rule: str, message: str, line: int, whole: str) -> bool:  # noqa: C901 - one branch for each rule
    """Whether the text of a file refutes what cppcheck says by *rule* at *line*, counted from 1.

    Cppcheck 2.22 takes a string with a suffix for a pointer, and does not see that a ``case`` reads the constant that
    is its label. It does not know which classes are views of what others own, takes each name of a structured binding for a
    variable of its own, and looks at one preprocessor configuration. Comments and texts refute nothing, but for what is leaked, declared or commented out on purpose.
    """
    if rule == "wrongfeofUsage":  # by the text of a format, too
        return is_read_checked(line, whole)
    if rule == "invalidscanf":
        return is_large_enough(line, whole)
    text = code_alone(whole, "c")
    if rule == "assignBoolToPointer" and has_no_truth_value(_line(text, line)):
        return True
    if rule in OF_LIFETIMES and may_be_alive(rule, message, line, text):
        return True
    if rule == "accessMoved" and is_copied_by_move(message, line, text):
        return True
    if rule == "selfInitialization" and is_of_parameter(message, line, text):
        return True
    if rule in OF_FIRMWARE and is_of_firmware(rule, _line(text, line), text):
        return True
    if rule == "uninitdata" and is_given_back(message, _line(text, line)):
        return True
    if rule == "autoVariables" and is_array_that_is_copied(line, text):
        return True
    if rule == "incorrectStringBooleanError" and _SAID.search(_line(text, line)) is not None:
        return True
    if rule in _OF_LITERALS:
        is_case = rule == "selfAssignment" and sets_nothing(message, line, text)
        return is_case or _NAMED_ARGUMENT.search(_line(text, line)) is not None
    member = _MEMBER.search(message.rstrip(".")) if rule in _OF_UNSET else None
    if member is not None:
        lines = text.split("\n")
        returned = rf"\s*return\s+{member[1]}\s*;"
        return 0 < line <= len(lines) and re.match(returned, lines[line - 1]) is not None
    if rule == "missingReturn":
        return _is_exhaustive(line, text) or _ends(line, text) or _ends_in_macro(line, text)
    if _OF_PRINTF.fullmatch(rule):
        return _is_alias(message, text)
    if rule == "constStatement" and (
        _LOOP.search(_line(text, line)) or _PLACED.search(_line(text, line)) or is_list_of_values(message, line, text)
    ):
        return True  # ``for (i; …)`` where i is set before, and an object that is made in a place
    if rule == "moduloofone":  # by a constant with a name, which may be another number tomorrow
        here = "\n".join(text.split("\n")[max(line - 1, 0) : line + 1])
        return _BY_NAME.search(here) is not None and _BY_ONE.search(here) is None
    if rule in OF_WAYS:
        return OF_WAYS[rule](message, line, text)
    if rule in OF_VALUES and (has_large_constant(message, _line(text, line)) or is_of_switches(message)):
        return True
    if rule == "danglingTemporaryLifetime":
        return is_copied(line, text) or is_text_of_message(line, text)
    if rule == "danglingTempReference":
        return is_pointed_to(line, text)
    if rule == "multiCondition":
        return is_spelled_out(message, line, text)
    if rule in _OF_CONDITIONS:
        return is_switched_by_hand(line, text)
    if rule == "duplicateExpression":
        return _is_of_numbers(message, _line(text, line))
    if rule in _OF_LEAKS and ends_process(message, line, text):
        return True
    if rule == "memleak":  # who names it so, or says so just above, means it
        near = "\n".join(whole.split("\n")[max(line - 7, 0) : line])
        return _LEAKED.search(message) is not None or any(_LEAKS.search(match[0]) for match in _COMMENT.finditer(near))
    if rule in _OF_PROVOKED:
        return _is_provoked(line, text)
    if rule == "unusedVariable" and is_meant(line, whole):
        return True
    subject = _SUBJECT.search(message) if rule in _OF_UNUSED else None
    return subject is not None and _is_used(subject[1] or subject[2], line, text, whole)


def _is_used(subject: str, line: int, text: str, whole: str) -> bool:
    """Whether *subject*, which cppcheck calls unused, is a part of something else, or used where cppcheck does not look."""
    if "(" in subject:  # an element by a call: only a class has those, and who else has the matrix is not known
        return True
    if not re.fullmatch(r"\w+", subject) or subject not in whole:
        return False
    if any(re.search(pattern.format(name=subject), text) for pattern in (_VIEW, _PART, _BINDING)):
        return True
    if re.search(rf"\bcase\s[^:;{{}}]{{0,200}}\b{subject}\b", text):
        return True
    word = re.compile(rf"\b{subject}\b")
    return any(word.search(part) for part in (*_switched(line, text), *_commented_out(line, whole)))


def _line(text: str, line: int) -> str:
    lines = text.split("\n")
    return lines[line - 1] if 0 < line <= len(lines) else ""


def _is_of_numbers(message: str, line: str) -> bool:
    """Whether the same number stands on both sides of the operator, as in an index that is counted from one: ``x(1-1)``."""
    operator = _BOTH_SIDES.search(message)
    if operator is None:
        return False
    return (
        re.search(rf"(?<![\w.)\]])(\d[\w.]{{0,40}})\s*{re.escape(operator[1])}\s*\1(?![\w.])", line[:_LONGEST])
        is not None
    )


def _is_provoked(line: int, text: str) -> bool:
    """Whether the statement at *line* is inside a macro that waits for what it throws."""
    lines = text.split("\n")
    before = "\n".join(lines[max(line - 12, 0) : line])
    last = None
    for last in _PROVOKED.finditer(before):  # noqa: B007 - the last one is used below
        pass
    if last is None:
        return False
    depth = 1
    for bracket in re.finditer(r"[()]", before[last.end() : before.rfind("\n") + 1]):
        depth += 1 if bracket[0] == "(" else -1
        if depth == 0:
            return False
    return True


def _ends(line: int, text: str) -> bool:
    """Whether the path without a return ends in a call that never comes back: cppcheck gives the place of its last statement."""
    lines = text.split("\n")
    return 0 < line <= len(lines) and _ENDING.match("\n".join(lines[line - 1 : line + 5])) is not None


def _ends_in_macro(line: int, text: str) -> bool:
    """Whether the path without a return ends in a call of a macro that may not come back, as far as its name tells.

    The place is that of the last statement, or of the bracket behind it.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    here, last = lines[line - 1].strip(), line - 1
    if not here.startswith("}"):
        if re.match(r"[A-Z][A-Z0-9_]{2,}\b", here) is None:
            return False
        after = range(line, min(line + _STATEMENT_LINES, len(lines)) + 1)
        last = next((number for number in after if ";" in _QUOTED.sub("0", lines[number - 1])), line)
    statement = _COMMENT.sub("", "\n".join(lines[max(last - _STATEMENT_LINES, 0) : last]))
    before = _QUOTED.sub("0", statement).rstrip()
    if last >= line:
        before = before.rstrip("} \t\n")
    if not before.endswith(";"):
        return False
    before = before.rstrip("; \t\n")
    if before.endswith(")"):
        depth = 0
        for bracket in reversed(list(re.finditer(r"[()]", before))):
            depth += 1 if bracket[0] == ")" else -1
            if depth == 0:
                before = before[: bracket.start()].rstrip()
                break
    name = re.search(r"(?:^|[;{}:]|\belse\b)\s*(\w+)$", before)
    if name is None or _MACRO.fullmatch(name[1]) is None:
        return False
    return _GOES_NOWHERE.match(name[1]) is not None or _WRITES.fullmatch(name[1]) is None


def _is_alias(message: str, text: str) -> bool:
    """Whether the type of the argument is a name that *text* gives to a type that cppcheck does not know, or a template's parameter."""
    named = _ARGUMENT.search(message)
    if named is None:
        return False
    name = named[1]
    return any(
        re.search(pattern, text)
        for pattern in (
            rf"\busing\s+{name}\s*=",
            rf"\btypedef\b[^;{{}}]{{1,200}}\b{name}\s*;",
            rf"\b(?:typename|class)\s+{name}\s*[,>=]",
        )
    )


def _is_exhaustive(line: int, text: str) -> bool:
    """Whether the path goes past a ``switch`` without ``default`` all of whose labels are enumerators of one scoped type.

    Compilers warn where an enumerator is missing (-Wswitch); cppcheck does not know how many there are.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    first = line - 2 if lines[line - 1].strip() == "{" and line > 1 else line - 1
    start = "\n".join(lines[first : first + 200])
    switch = _SWITCH.match(start)
    if switch is None:
        return False
    body = start[switch.end() :]
    depth, end = 1, 0
    for brace in re.finditer(r"[{}]", body):
        depth, end = depth + (1 if brace[0] == "{" else -1), brace.start()
        if depth == 0:
            break
    body = body[:end]
    labels = re.findall(r"\bcase\s+([^;{}?]{1,200}?)\s*(?<!:):(?!:)", body)
    scopes_of = {label.rpartition("::")[0] for label in labels}
    if depth or len(labels) < 2 or len(scopes_of) != 1 or "" in scopes_of or "default" in body:
        return False
    return _enumerators(scopes_of.pop().rpartition("::")[2], text) <= {label.rpartition("::")[2] for label in labels}


def _enumerators(name: str, text: str) -> set[str]:
    """Those of the enumeration called *name*, if *text* defines one alone; of any other nothing is known."""
    if not re.fullmatch(r"\w+", name):
        return set()
    found = re.findall(rf"\benum\s+(?:class\s+|struct\s+)?{name}\b[^{{}};]{{0,100}}\{{([^{{}}]{{0,20000}})\}}", text)
    parts = [part.partition("=")[0].split() for part in found[0].split(",")] if len(found) == 1 else []
    return {words[0] for words in parts if words}


def _commented_out(line: int, text: str) -> Iterator[str]:
    """The statements in comments of the function around *line*."""
    here = scopes(text, "cpp").at(line)
    return (comment for scope, comment in _statements(text) if scope == here)


@lru_cache(maxsize=4)
def _statements(text: str) -> tuple[tuple[str, str], ...]:
    """The comments of *text* that hold statements, each with the function that it stands in."""
    inside, found = scopes(text, "cpp"), []
    line, counted = 1, 0
    for comment in _COMMENT.finditer(text):
        line, counted = line + text.count("\n", counted, comment.start()), comment.start()
        if _STATEMENT.search(comment[0]):
            found.append((inside.at(line), comment[0]))
    return tuple(found)


def _switched(line: int, text: str) -> Iterator[str]:
    """The other lines that the preprocessor may leave out; what an include guard holds is not meant."""
    lines = text.split("\n")
    depth: list[bool] = []
    for number, here in enumerate(lines, start=1):
        directive = _DIRECTIVE.match(here)
        if directive and directive[1].startswith("if"):
            follows = _DIRECTIVE.match(lines[number]) if number < len(lines) else None
            is_guard = directive[1] == "ifndef" and follows and follows.groups() == ("define", directive[2])
            depth.append(not is_guard)
        elif directive and directive[1] == "endif" and depth:
            depth.pop()
        elif any(depth) and number != line:
            yield here
