# SPDX-License-Identifier: Apache-2.0
"""msg, srv and action definitions of ROS 1 (wiki ``msg``) and ROS 2 (Interfaces)."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from haros_ci.model.build import Interface, InterfaceField
from haros_ci.model.workspace import Problem
from haros_ci.regex import regex
from haros_ci.workspace.idl import read_idl

MAX_FIELDS = 5_000

_PRIMITIVE = frozenset(("bool", "byte", "char", "float32", "float64", "string", "wstring", "time", "duration"))
_PRIMITIVE |= {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_TYPE = regex(r"(?P<base>(?:[A-Za-z]\w*/){0,2}[A-Za-z]\w*)(?P<bound><=\d+)?(?P<array>\[(?:<=)?\d*\])?\Z", re.ASCII)
_LINE = regex(r"(?P<type>(?:[^\s=]|<=)+)\s+(?P<name>[A-Za-z]\w*)(?P<rest>.*)\Z", re.ASCII | re.DOTALL)
_SECTIONS = {"msg": 1, "srv": 2, "action": 3}
_INTEGER = regex(r"[+-]?(?:0[xX](?:_?[0-9a-fA-F])+|0[bB](?:_?[01])+|0[oO](?:_?[0-7])+|\d+(?:_\d+)*)\Z", re.ASCII)


def read_interface(path: str, text: str, package: str, *, is_generated: bool = True) -> tuple[Interface, list[Problem]]:
    """The definition at *path*; a malformed line is reported as a problem and left out.

    ``pkg/msg/T`` becomes ``pkg/T``, a type of the package itself ``package/T``, ``Header`` ``std_msgs/Header``.
    """
    stem, _, kind = path.rpartition("/")[2].rpartition(".")
    if kind == "idl":
        return _of_idl(path, text, stem, package, is_generated), []
    sections: list[list[InterfaceField]] = [[]]
    problems: list[Problem] = []
    count = 0
    for number, line in enumerate(re.split("\r\n|\n|\r", text), start=1):
        bare = line.strip()
        if not bare or bare[0] == "#" or bare[0] == "@":  # @verbatim and its like annotate .idl
            continue
        if bare.startswith("---"):
            if len(sections) >= _SECTIONS.get(kind, 1):
                problems.append(Problem(path, f"one '---' too many for a .{kind}; what follows is ignored", number))
                break
            sections.append([])
            continue
        count += 1
        if count > MAX_FIELDS:
            problems.append(Problem(path, f"more than {MAX_FIELDS} fields; the rest is ignored", number))
            break
        read = _field(bare, package, number)
        if read is None:
            problems.append(Problem(path, f"not a field or constant: {bare[:60]!r}", number))
        else:
            sections[-1].append(read)
    missing = _SECTIONS.get(kind, 1) - len(sections)
    sections += [[] for _ in range(missing)]
    made = Interface(
        name=f"{package}/{stem}",
        kind=kind,
        path=path,
        sections=tuple(map(tuple, sections)),
        is_generated=is_generated,
        is_whole=not problems,
    )
    return made, problems


def _of_idl(path: str, text: str, stem: str, package: str, is_generated: bool) -> Interface:
    """An .idl; its directory, ``msg``, ``srv`` or ``action``, tells its kind (rosidl_adapter)."""
    above = path.rpartition("/")[0].rpartition("/")[2]
    kind = above if above in _SECTIONS else "msg"
    read = read_idl(text, stem, kind)
    return Interface(
        name=f"{package}/{stem}",
        kind=kind,
        path=path,
        sections=read or ((),) * _SECTIONS[kind],
        is_generated=is_generated,
        is_whole=read is not None,
    )


def _field(line: str, package: str, number: int) -> InterfaceField | None:
    match = _LINE.match(line)
    if match is None:
        return None
    kind = _complete(match["type"], package)
    if kind is None:
        return None
    made = InterfaceField(name=match["name"], type=kind, line=number, written=match["type"])
    rest = match["rest"]
    stripped = rest.lstrip()
    if stripped[:1] == "=":
        value = stripped[1:].strip()
        if kind.startswith(("string", "wstring")):
            # ROS 1 takes the rest of the line, "#" included; ROS 2 wants quotes.
            return replace(made, default=_text(value), is_constant=True, value=value)
        value = value.partition("#")[0].strip()
        constant = _value(kind, value)
        return None if constant is None else replace(made, default=constant, is_constant=True, value=value)
    if not stripped or stripped[0] == "#":
        return made
    if rest[:1].isspace():
        default = _default(kind, stripped)
        return None if default is None else replace(made, default=default, value=stripped.partition("#")[0].strip())
    return None


def _complete(written: str, package: str) -> str | None:
    """The type with its package; None if it is no type."""
    match = _TYPE.match(written)
    if match is None:
        return None
    base, bound, array = match["base"], match["bound"] or "", match["array"] or ""
    if base in _PRIMITIVE:
        return f"{base}{bound}{array}" if not bound or base in ("string", "wstring") else None
    if bound:
        return None
    parts = base.split("/")
    if len(parts) == 1:
        return "std_msgs/Header" if written == "Header" else f"{package}/{base}{array}"
    if len(parts) == 3 and parts[1] not in ("msg", "srv", "action"):
        return None
    return f"{parts[0]}/{parts[-1]}{array}"


def _default(kind: str, text: str) -> Any:
    """A ROS 2 default: a value, or values in brackets as a tuple; None for anything else."""
    if kind.endswith("]"):
        match = re.match(r"\[(.*)\]\s*(?:#.*)?\Z", text, re.DOTALL)
        if match is None:
            return None
        base = re.sub(r"\[[^\]]*\]\Z", "", kind)
        if not match[1].strip():
            return ()
        words = re.findall(r'\s*("(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\'|[^,]*)\s*(?:,|\Z)', match[1])
        words = words[:-1] if words and not words[-1] else words
        values = tuple(_text(w) if base.startswith(("string", "wstring")) else _value(base, w.strip()) for w in words)
        return None if None in values else values
    if kind.startswith(("string", "wstring")):
        match = re.match(r'("(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)*\')\s*(?:#.*)?\Z', text, re.DOTALL)
        return _text(match[1] if match else text.partition("#")[0].strip())  # quotes are optional (rosidl_adapter)
    return _value(kind, text.partition("#")[0].strip())


def _text(value: str) -> str:
    """*value* without the quotes around it."""
    if len(value) > 1 and value[0] == value[-1] and value[0] in "\"'":
        return re.sub(r"\\(.)", r"\1", value[1:-1])
    return value


def _value(kind: str, text: str) -> bool | int | float | None:
    """The number or truth value that *text* is for a primitive type; None otherwise."""
    if len(text) > 60:
        return None
    if kind == "bool":
        return {"true": True, "1": True, "false": False, "0": False}.get(text.lower())
    if kind in ("float32", "float64"):
        try:
            return float(text)
        except ValueError:
            return None
    if kind not in _PRIMITIVE or kind in ("time", "duration") or not _INTEGER.match(text):
        return None
    return int(text, 0) if text.lstrip("+-")[:2].lower() in ("0x", "0b", "0o") else int(text)
