# SPDX-License-Identifier: Apache-2.0
"""Pointers of which cppcheck says that they outlive what they point to, though they need not point there, and values that are kept on purpose."""

from __future__ import annotations

import re

from haros_ci.linters.cppcheck_returns import copies_what_it_returns
from haros_ci.linters.function_text import function_text
from haros_ci.regex import regex

OF_LIFETIMES = frozenset({"danglingLifetime", "returnDanglingLifetime", "selfAssignment"})
#: ``Non-local variable 'handle' will use pointer to local variable 'name'.``
_KEPT = regex(r"[Vv]ariable '([A-Za-z_]\w*)' will use (?:pointer|object) to local variable '([A-Za-z_]\w*)'")
#: ``Non-local variable 'waiting' will use object that points to local variable 'task'.``
_POINTING = regex(r"will use object that points to local variable '([A-Za-z_]\w*)'")
#: ``Returning object that points to local variable 'view' that will be invalid when returning.``
_RETURNED = regex(r"points to local variable '([A-Za-z_]\w*)'")
#: ``Non-local variable 'res.name' will use object that points to local variable 'buffer'.``
_FIELD = regex(r"[Vv]ariable '([A-Za-z_]\w*)(?:\.|->)\w[\w.>-]*' will use object that points to local variable")
#: A parameter of a type that is generated for a message, service or action: its fields are texts, numbers and lists, which copy what they are given.
_GENERATED = (
    r"(?:::(?:Request|Response|Goal|Result|Feedback)|\b\w+_(?:msgs|srvs|interfaces)(?:::\w+){{1,3}})"
    r"(?:_?<[^<>;{{}}]{{0,80}}>|::(?:SharedPtr|UniquePtr)|Ptr)?\s*(?:[&*]\s*)?{name}\b"
)
#: A message itself, with the name of its package or in one for messages of any name.
_OF_MESSAGE = rf"(?:\b\w+::(?:msg|srv|action)::\w+\s*(?:[&*]\s*)?{{name}}\b|{_GENERATED})"
#: A field that is given the text of something: ``msg->header.frame_id = make().c_str();``
_GIVEN = regex(r"\b([A-Za-z_]\w*)(?:(?:\.|->)\w{1,60}){1,6}\s*=(?!=)[^;{}=]{1,600}\.\s*(?:c_str|data)\s*\(\s*\)\s*;")
_WORD = regex(r"[A-Za-z_]\w*")
_LONGEST = 400
#: ``Non-local variable 'view.first' will use pointer to local variable 'task'.``
_OWNED = regex(r"will use (?:pointer to|object that points to) local variable '([A-Za-z_]\w*)'")
#: ``Non-local variable 'path' will use …``
_OUTER = regex(r"[Vv]ariable '([A-Za-z_]\w*)' will use")
_SMART = (
    r"\b(?:unique_ptr|shared_ptr|UniquePtr|SharedPtr|\w+Ptr)\b(?:\s*<[^;{{}}]{{0,300}}>)?\s*(?:&&?\s*)?{name}\s*[=;({{,)]"
    r"|\bauto\s+{name}\s*=\s*[^;]{{0,60}}\b(?:make_unique|make_shared|allocate_shared)\b"
)
#: That somebody else has the object from there on; of a copy only where the pointer is a shared one.
_GIVEN_ON = r"\bmove\s*\(\s*{name}\s*\)|\b{name}\s*\.\s*release\s*\(|\breturn\s+{name}\s*;"
_SHARED = r"\b(?:make_shared|allocate_shared|shared_ptr|SharedPtr|(?!Unique)\w+Ptr)\b[^;]{{0,300}}\b{name}\b|\b{name}\s*=[^;]{{0,60}}_shared\b"
_COPIED = (
    r"(?:\.|->)\s*(?:push_back|emplace_back|push_front|push|insert|emplace|add\w*)\s*\([^;]{{0,300}}\b{name}\s*[,)}}]"
    r"|[\w\])]\s*=\s*{name}\s*;"
)
#: The pointer itself, which ends with the function.
_ITS_PLACE = r"(?<!&)&\s*{name}\b(?!\s*(?:->|\.))"
_CONSTANT = r"\bconst\b[^,;(){{}}=]{{0,200}}&\s*{name}\s*[,)=]|\b\w+\s+const\s*&\s*{name}\s*[,)=]"
_ITSELF = regex(r"assignment of '([^']{1,80})' to itself")
#: Functions of the standard library that give back what they are given, or what points to it.
_PASSING = frozenset(
    "addressof as_bytes as_const begin bind c_str cbegin cend crbegin data end forward get make_pair make_tuple max min move rbegin ref cref span "
    "static_cast reinterpret_cast const_cast dynamic_cast string_view tie".split()
)
#: Lines above the report that are looked at.
_NEAR = 60


def may_be_alive(rule: str, message: str, line: int, text: str) -> bool:
    """Whether what cppcheck says by *rule* at *line* of *text* rests on what it cannot know, or is meant.

    It takes what any function returns for a pointer to its arguments, a handle of a C library too, and what a member of a local object points to
    for a part of that object; it does not see that a lambda returns a text of its own, nor that somebody else has the owner of an object from
    there on; in functions that call themselves it takes a constant reference for one that is set; and a branch that leaves a variable as it is may say so.
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    near = "\n".join(lines[max(line - 1 - _NEAR, 0) : line])
    if rule == "selfAssignment":
        itself = _ITSELF.search(message)
        return itself is not None and _is_other_branch(itself[1], line, lines)
    if rule == "danglingLifetime":
        kept = _KEPT.search(message)
        points, owner = _POINTING.search(message), _FIELD.search(message)
        if owner is not None and re.search(_GENERATED.format(name=owner[1]), near):
            return True
        if points is not None and _is_moved(points[1], lines[line - 1]):
            return True
        owned, outer = _OWNED.search(message), _OUTER.search(message)
        here = function_text(line, text)
        if owned is not None and _is_given_on(owned[1], here):
            return True
        if outer is not None and re.search(_CONSTANT.format(name=outer[1]), here.partition("{")[0]):
            return True
        return kept is not None and _is_returned_by_a_call(kept[1], kept[2], near, text)
    returned = _RETURNED.search(message)
    return copies_what_it_returns(line, text) or (returned is not None and _is_of_a_view(returned[1], near))


def is_text_of_message(line: int, text: str) -> bool:
    """Whether what is used at *line* is a message that has been given the text of a temporary above: its fields copy what they are given.

    ``msg.header.frame_id = (prefix + frame).c_str();``
    """
    lines = text.split("\n")
    if not 0 < line <= len(lines):
        return False
    used = set(_WORD.findall(lines[line - 1][:_LONGEST]))
    near = "\n".join(other[:_LONGEST] for other in lines[max(line - 1 - _NEAR, 0) : line - 1])
    given = {found[1] for found in _GIVEN.finditer(near)} & used
    return any(re.search(_OF_MESSAGE.format(name=name), near) for name in given)


def _is_returned_by_a_call(name: str, local: str, near: str, text: str) -> bool:
    """Whether all that *name* is set to with *local* in it are calls of functions of which nothing is known: that pass no argument on, and are not of the file."""
    assigned = re.findall(rf"\b{name}\s*=(?!=)\s*([^;{{}}]{{1,600}});", near)
    sources = [source for source in assigned if re.search(rf"\b{local}\b", source)]
    calls = [re.match(r"(?:[\w.]+(?:->|::))*(\w+)\s*\(", source) for source in sources]
    return bool(calls) and all(
        call is not None
        and call[1] not in _PASSING
        and re.search(rf"\b{call[1]}\s*\([^;{{}}]{{0,400}}\)[\s\w]{{0,40}}\{{", text) is None
        for call in calls
    )


def _is_moved(local: str, line: str) -> bool:
    """Whether the line takes what *local* points to, and moves *local* itself with it: ``all.emplace(task.get(), std::move(task))``."""
    return re.search(rf"\b{local}\s*\.\s*get\s*\(\s*\)", line) is not None and (
        re.search(rf"\bstd\s*::\s*move\s*\(\s*{local}\s*\)", line) is not None
    )


def _is_given_on(local: str, function: str) -> bool:
    """Whether *local* is a pointer that owns what is pointed to, and is given to somebody else in the *function*: the object lives on."""
    if re.search(_SMART.format(name=local), function) is None or re.search(_ITS_PLACE.format(name=local), function):
        return False
    if re.search(_GIVEN_ON.format(name=local), function) is not None:
        return True
    is_shared = re.search(_SHARED.format(name=local), function) is not None
    return is_shared and re.search(_COPIED.format(name=local), function) is not None


def _is_of_a_view(local: str, near: str) -> bool:
    """Whether the element is one of what a member of *local* points to, an object of a type that is not named: ``auto & e = view.data[i];``."""
    element = re.search(rf"\bauto\s*&\s*\w+\s*=\s*{local}\s*\.\s*\w+\s*\[", near)
    return element is not None and re.search(rf"\bauto\s+{local}\s*=", near) is not None


def _is_other_branch(name: str, line: int, lines: list[str]) -> bool:
    """Whether *name* keeps its value in an ``else``, or in the second half of ``?:``: the other branch sets it."""
    word = re.escape(name)
    here = lines[line - 1][:1000]
    if re.search(rf"\?[^;?]{{0,400}}:\s*(?:\(\s*)?{word}\s*=\s*{word}\b", here) or re.search(
        rf"\belse\b\s*(?:if\s*\([^;{{}}]{{0,400}}\)\s*)?\{{?\s*{word}\s*=", here
    ):
        return True
    before = [other.strip() for other in lines[max(line - 4, 0) : line - 1] if other.strip() not in ("", "{")]
    return (
        bool(before)
        and re.fullmatch(r"\}?\s*else\b(?:\s*if\s*\(.{0,400}\))?\s*(?:\{\s*)?(?://.*)?", before[-1]) is not None
    )
