# SPDX-License-Identifier: Apache-2.0
"""Parts of robot descriptions under conditions of xacro that never hold: what stood there before is gone, and no check sees it.

A condition is constant if it is a literal (``value="${false}"``), or is calculated of literals and of properties that the file sets
once. Arguments, the environment, parameters of macros and files that are included may be anything.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.result import Notification

#: Conditions that are mentioned; the rest is counted. Characters of an expression that is looked at.
MOST = 20
_LONGEST = 200
_COMMENT = regex(r"<!--|-->")
_TAG = regex(r"<(/?)([\w:.-]+)([^<>\"']*(?:\"[^\"<]*\"[^<>\"']*|'[^'<]*'[^<>\"']*)*)>")
_ATTRIBUTE = regex(r"\b(\w+)\s?=\s?(?:\"([^\"]*)\"|'([^']*)')")
_WORD = regex(r"[A-Za-z_]\w*")
_CONDITIONS = {"xacro:if": False, "xacro:unless": True}
#: What is in a description for its own sake; the last part of a tag.
_PARTS = frozenset(
    "joint link plugin include sensor transmission gazebo hardware ros2_control visual collision inertial".split()
)
_NO_CALLS = frozenset("if unless property arg macro element attribute insert_block".split())
_SHOWN = 4
_LITERALS = {"true": True, "True": True, "false": False, "False": False}
Value = bool | int | float | str


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such condition of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    return notes(brought(head, base, _look), MOST, "parts of descriptions are never there, since this change")


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    def look(file: SourceFile) -> Iterator[Found]:
        text = workspace.text(file.path) if file.language == "xml" else ""
        for line, condition, parts in absent(text):
            message = (
                f"since this change {condition} leaves out {parts}: the condition never holds, and no check sees them"
            )
            yield line, (condition, parts), message

    return look


def absent(text: str) -> Iterator[tuple[int, str, str]]:
    """The lines of conditions that never hold, each with its tag and what is under it, in words; takes linear time."""
    if "xacro:" not in text:
        return
    text = _uncommented(text)
    known = _properties(text)
    around: list[bool] = []  # of each condition around, whether it is the outermost that never holds
    hidden: tuple[int, str] | None = None
    parts: Counter[str] = Counter()
    line, seen = 1, 0
    for tag in _TAG.finditer(text):
        line, seen = line + text.count("\n", seen, tag.start()), tag.start()
        name = tag[2]
        if name not in _CONDITIONS:
            if hidden is not None and not tag[1] and _is_part(name):
                parts[name] += 1
        elif tag[1]:
            if around and around.pop() and hidden is not None:
                if parts:
                    yield (*hidden, _in_words(parts))
                hidden, parts = None, Counter()
        elif not tag[3].endswith("/"):
            value = next((one[2] or one[3] or "" for one in _ATTRIBUTE.finditer(tag[3]) if one[1] == "value"), "")
            is_never = hidden is None and _truth(value, known) is _CONDITIONS[name]
            if is_never:
                shown = " ".join(value.split())[:60]
                hidden = line, f'<{name} value="{shown}">'
            around.append(is_never)


def _is_part(name: str) -> bool:
    """Whether a tag puts something into the description: a part, a file, or a call of a macro."""
    space, _, last = name.rpartition(":")
    return last in _PARTS or (space == "xacro" and last not in _NO_CALLS)


def _in_words(parts: Counter[str]) -> str:
    shown = [f"{count} <{part[:40]}>" for part, count in sorted(parts.items())[:_SHOWN]]
    return ", ".join((*shown, "more") if len(parts) > _SHOWN else shown)


def _uncommented(text: str) -> str:
    """*text* with comments left out; their lines stay."""
    kept, at = list[str](), 0
    start = None
    for mark in _COMMENT.finditer(text):
        if mark[0] == "<!--" and start is None:
            start = mark.start()
            kept.append(text[at:start])
        elif mark[0] == "-->" and start is not None:
            kept.append("\n" * text.count("\n", start, mark.end()))
            start, at = None, mark.end()
    return "".join((*kept, text[at:] if start is None else ""))


def _properties(text: str) -> Mapping[str, Value]:
    """The properties that the file sets once, to a literal, and that nothing else may set: no included file, no parameter of a macro."""
    values: dict[str, str] = {}
    others: set[str] = set()
    for tag in _TAG.finditer(text):
        last = tag[2].rpartition(":")[2]
        if tag[1] or last not in ("property", "macro", "include", "arg"):
            continue
        given = {one[1]: one[2] or one[3] or "" for one in _ATTRIBUTE.finditer(tag[3])}
        if last == "include":
            return {}
        name = given.get("name", "")
        if last == "macro":
            others.update(_WORD.findall(given.get("params", "")))
        elif last == "arg" or name in values or "value" not in given or {"scope", "default", "remove"} & given.keys():
            others.add(name)
        else:
            values[name] = given["value"]
    found = {name: _literal(value) for name, value in values.items() if name not in others}
    return {name: value for name, value in found.items() if value is not None}


def _literal(text: str) -> Value | None:
    """What a property of that text is (``xacro.Table._eval_literal``); None where it is evaluated."""
    if "$" in text:
        return None
    if text.strip() in _LITERALS:
        return _LITERALS[text.strip()]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _truth(value: str, known: Mapping[str, Value]) -> bool | None:
    """Whether a condition holds whatever is set from outside; None where that is not known."""
    value = " ".join(value.split())
    if not (value.startswith("${") and value.endswith("}")):
        found = _literal(value)
    elif len(value) > _LONGEST or value.count("$") > 1:
        return None
    else:
        source = value[2:-1].replace("&gt;", ">").replace("&lt;", "<").replace("&amp;", "&").replace("&quot;", '"')
        try:
            found = _evaluated(ast.parse(source.strip(), mode="eval").body, known)
        except (SyntaxError, ValueError, TypeError, MemoryError, RecursionError, OverflowError):
            return None
    if isinstance(found, str):
        return _LITERALS.get(found)
    return None if found is None else bool(found)


def _evaluated(node: ast.expr, known: Mapping[str, Value]) -> Value | None:
    """The value of an expression of literals and known properties; None where it is not known."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, (bool, int, float, str)) else None
    if isinstance(node, ast.Name):
        return _LITERALS.get(node.id, known.get(node.id))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.Not, ast.USub)):
        inner = _evaluated(node.operand, known)
        if inner is None or isinstance(inner, str):
            return None
        return not inner if isinstance(node.op, ast.Not) else -inner
    if isinstance(node, ast.BoolOp):
        values = [_evaluated(item, known) for item in node.values]
        deciding = isinstance(node.op, ast.Or)
        if any(value is not None and bool(value) is deciding for value in values):
            return deciding
        return None if None in values else not deciding
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        return _compared(node.ops[0], _evaluated(node.left, known), _evaluated(node.comparators[0], known))
    return None


def _compared(operator: ast.cmpop, one: Value | None, other: Value | None) -> bool | None:
    """What a comparison gives; None between texts and numbers, of which xacro converts some."""
    if one is None or other is None or isinstance(one, str) != isinstance(other, str):
        return None
    if isinstance(operator, (ast.Eq, ast.NotEq)):
        return (one == other) is isinstance(operator, ast.Eq)
    if isinstance(one, str) or isinstance(other, str):
        return None
    if isinstance(operator, (ast.Lt, ast.GtE)):
        return (one < other) is isinstance(operator, ast.Lt)
    return (one > other) is isinstance(operator, ast.Gt) if isinstance(operator, (ast.Gt, ast.LtE)) else None
