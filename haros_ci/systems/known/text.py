# SPDX-License-Identifier: Apache-2.0
"""The small language of the data on known nodes: names with holes, conditions, lists (docs/known-nodes.md)."""

from __future__ import annotations

import re

from haros_ci.records import dataclass
from haros_ci.regex import regex

#: What a hole can ask for, with the form of what stands after the colon; see docs/known-nodes.md.
HOLES = {
    "param": r"[~/]?(?:[A-Za-z]|\{item\})(?:[A-Za-z0-9_/.]|\{item\})*",
    "search": r"[A-Za-z][A-Za-z0-9_/]*",
    "arg": r"\d{1,3}",
    "option": r"-[A-Za-z0-9_-]+",
    "beside": r"[~/]?[A-Za-z][A-Za-z0-9_/]*",
    "resolved": r"[~/]?[A-Za-z][A-Za-z0-9_/]*",
    "unknown": r"[^{}|]+",
    "item": r"(?:[A-Za-z][A-Za-z0-9_]*)?",
}
_SUBJECT = regex(r"(?:(arg|option|item):)?([~/]?(?:[A-Za-z0-9_/.-]|\{item\})+)(?:\|([^|=]*?))?(?: == (.+))?")
_LIST = regex(r"args:(\d{1,3})(?: as (.+))?|(file:)?([~/]?[A-Za-z][A-Za-z0-9_/.]*?)(#|\.\*)?")
_FIELD = regex(r"\{([a-z_]+)\}")
_DEEPEST = 4
_LONGEST = 1000


@dataclass(frozen=True, slots=True)
class Hole:
    """``{kind:about|default}``: what only the running system tells."""

    kind: str
    about: str
    default: Template | None = None


#: Literal text and holes.
Template = tuple[str | Hole, ...]


@dataclass(frozen=True, slots=True)
class Test:
    """A condition ``about|default == expected`` on a parameter (*kind* param), an arg, an option or an item; without *expected*: is it on?

    The *kind* unknown has no answer; *about* is the reason.
    """

    kind: str
    about: str
    default: str | None
    expected: str | None


@dataclass(frozen=True, slots=True)
class Repetition:
    """``args:1``, ``~list`` or ``~name#`` (``~name0``, ``~name1``, ... up to the first that is not set).

    ``~group.*`` are the names of what is set below a prefix, ``file:~path`` the list in a YAML file. ``args:0 as
    {topic}@{type}`` are those arguments that have the *shape*, as maps of its fields.
    """

    kind: str
    about: str
    shape: str = ""


def template(text: str, depth: int = 0) -> Template:
    """*text* in its parts. Raises ValueError, saying what is wrong with it."""
    if len(text) > _LONGEST or depth > _DEEPEST:
        raise ValueError("it is too long, or has too many braces in each other")
    parts: list[str | Hole] = []
    at = 0
    while at < len(text):
        start = text.find("{", at)
        literal = text[at : start if start >= 0 else len(text)]
        if "}" in literal:
            raise ValueError("there is a '}' without its '{'")
        if literal:
            parts.append(literal)
        if start < 0:
            break
        end = _closing(text, start)
        parts.append(_hole(text[start + 1 : end], depth))
        at = end + 1
    return tuple(parts)


def test(text: str) -> Test:
    """A condition: ``~tf|true``, ``~mode|sync == async``, ``arg:0 == manager``, ``option:-urdf``, ``unknown:why``.

    Raises ValueError, as all readers here do, with a sentence on the form.
    """
    head, _, reason = text.strip().partition(":")
    if head == "unknown" and re.fullmatch(HOLES[head], reason):
        return Test(head, reason, None, None)
    found = _SUBJECT.fullmatch(text.strip())
    kind = (found[1] or "param") if found else ""
    if found is None or not re.fullmatch(HOLES[kind], found[2]):
        forms = "~parameter, ~parameter|default, ~parameter == word, arg:0 == word or option:-name"
        raise ValueError(f"a condition is written as {forms}")
    return Test(kind, found[2], found[3], found[4])


def each(text: str) -> Repetition:
    """A list: ``~parameter``, ``~parameter#``, ``~group.*``, ``file:~parameter``, ``args:1`` or ``args:0 as {a}@{b}``."""
    found = _LIST.fullmatch(text.strip())
    if found is None or (found[3] and found[5]):
        raise ValueError("a list is written as ~parameter, ~parameter# or args:1")
    if found[1]:
        if found[2] and not _is_shape(found[2]):
            raise ValueError("the shape of an argument is written as {topic}@{type}")
        return Repetition("args", found[1], found[2] or "")
    kinds = {None: "file" if found[3] else "param", "#": "numbered", ".*": "children"}
    return Repetition(kinds[found[5]], found[4])


def _is_shape(text: str) -> bool:
    names = _FIELD.findall(text)
    between = _FIELD.split(text)[2:-1:2]
    return 0 < len(names) == len(set(names)) and all(between) and len(text) <= _LONGEST


def fields(shape: str, word: str) -> dict[str, str] | None:
    """The fields of *word*, None if it has not the *shape*: no field has a character that stands between fields."""
    literals = _FIELD.split(shape)[::2]
    differing = re.escape("".join(literals + list("@[]")))
    pattern = "".join(
        re.escape(part) if n % 2 == 0 else f"(?P<{part}>[^{differing}]+)" for n, part in enumerate(_FIELD.split(shape))
    )
    found = re.fullmatch(pattern, word)
    return found.groupdict() if found else None


def literal(text: str) -> object:
    """A default as text: true, false, numbers, else the text."""
    if text in ("true", "false"):
        return text == "true"
    if re.fullmatch(r"-?\d{1,9}", text):
        return int(text)
    return text


def _closing(text: str, start: int) -> int:
    depth = 0
    for at in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
    raise ValueError("there is a '{' without its '}'")


def _hole(inside: str, depth: int) -> Hole:
    head, bar, rest = inside.partition("|")
    word, _, about = head.partition(":")
    if word.startswith("item") and word[4:5] in ("", "."):
        word, about = "item", word[5:]
    if word not in HOLES or not re.fullmatch(HOLES[word], about):
        raise ValueError(f"{{{inside[:60]}}} is none of {', '.join('{' + kind + '}' for kind in HOLES)}")
    return Hole(word, about, template(rest, depth + 1) if bar else None)
