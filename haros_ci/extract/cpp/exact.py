# SPDX-License-Identifier: Apache-2.0
"""The second, exact tier of the C++ front end, seen from outside: what to ask its worker, and what the answer says.

Nothing here loads libclang or starts a process; ``exact_worker`` does the former, the pipeline the latter.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.regex import regex

#: Path, line and column where a call begins, as in ``haros_ci.syntax``.
Place = tuple[str, int, int]
Scalar = str | bool | int | float
#: An answer beyond this many characters is not read.
ANSWER_LIMIT = 64_000_000
#: LLVM of the libclang that the project asks for: builtin headers of a newer clang do not suit it.
LLVM = 18
_VERSION = regex(r"\d+")
_PLACE = regex(r"([1-9]\d{0,8}):([1-9]\d{0,8})")
_KINDS = ("call", "construct", "new")


@dataclass(frozen=True, slots=True)
class ExactArgument:
    """An argument that is written. *type* is that of the parameter it becomes, *written* its own before conversions.

    *value* is a constant of either. Types are spelled without const, ``&``, ``*`` (but for C strings: ``char*``) and
    allocators; None is not known.
    """

    type: str | None
    value: Scalar | None = None
    written: str | None = None


@dataclass(frozen=True, slots=True)
class ExactCall:
    """A call: *callee* is the qualified function, or the class of what is constructed; *type* is that of its result.

    *kind*: call, construct, new. *templates*: those of the function, or of the class, given and deduced.
    *is_macro*: a macro's body makes it, and it stands where the macro is used.
    """

    callee: str | None
    type: str | None = None
    arguments: tuple[ExactArgument, ...] = ()
    templates: tuple[str | None, ...] = ()
    kind: str = "call"
    is_macro: bool = False


@dataclass(frozen=True, slots=True)
class ExactFile:
    """A file to look at: its path in the workspace, its harmless compiler flags, and where the calls in doubt begin."""

    path: str
    flags: tuple[str, ...]
    calls: tuple[tuple[int, int], ...]


def default_headers() -> tuple[str, ...]:
    """The directories of installed headers that this system has; none without any.

    ROS 1 and ROS 2 (``/opt/ros/<distribution>/include``), the compiler's own (``stddef.h``, from a clang no newer than
    libclang, else from GCC), and the system's. What the environment says is not asked.
    """
    ros = sorted(map(str, Path("/opt/ros").glob("*/include")))
    clang = [p for p in _newest(Path("/usr/lib").glob("llvm-*/lib/clang/*/include")) if _numbers(p)[-1:] <= [LLVM]]
    gcc = _newest(Path("/usr/lib/gcc").glob("*/*/include"))
    own = [p for p in (*clang, *gcc) if os.path.isfile(os.path.join(p, "stddef.h"))][:1]
    return tuple(p for p in (*ros, *own, "/usr/include") if os.path.isdir(p))


def _newest(paths: Iterable[Path]) -> list[str]:
    return sorted(map(str, paths), key=lambda path: (_numbers(path), path), reverse=True)


def _numbers(path: str) -> list[int]:
    """The major version in the last directory but ``include``."""
    found = _VERSION.match(os.path.basename(os.path.dirname(path)))
    return [int(found.group())] if found else [0]


def requests(root: str, files: Iterable[ExactFile], headers: Sequence[str], batch: int = 1) -> tuple[str, ...]:
    """One JSON text for the standard input of each worker to start; none where there is nothing to ask.

    *batch* files share a worker and its fate: what libclang does not survive takes their answers along. Starting a
    worker is cheap beside one file.
    """
    requested = [f for f in sorted(files, key=lambda f: f.path) if f.calls]
    if not headers:
        return ()
    found = []
    for start in range(0, len(requested), max(batch, 1)):
        group = [
            {"path": f.path, "flags": list(f.flags), "calls": sorted(set(f.calls))}
            for f in requested[start : start + max(batch, 1)]
        ]
        found.append(json.dumps({"root": root, "files": group, "headers": list(headers)}, sort_keys=True))
    return tuple(found)


def parse(answer: str) -> Mapping[Place, tuple[ExactCall, ...]]:
    """The calls at each place, outermost first: those of ``a.b().c()`` begin at one place, and a macro may make many.

    Whatever has not the shape of the worker's answer is dropped.
    """
    found: dict[Place, tuple[ExactCall, ...]] = {}
    for path, places in _table(_load(answer), "files").items():
        for place, entries in places.items() if isinstance(places, dict) else ():
            match = _PLACE.fullmatch(place)
            if match and isinstance(entries, list):
                calls = tuple(call for call in map(_call, entries) if call is not None)
                if calls and len(calls) == len(entries):
                    found[path, int(match[1]), int(match[2])] = calls
    return found


def failures(answer: str) -> tuple[Problem, ...]:
    """The files that the worker could not look at, and why."""
    failed = _table(_load(answer), "failed")
    return tuple(Problem(path, reason) for path, reason in sorted(failed.items()) if isinstance(reason, str))


def pick(calls: Sequence[ExactCall], name: str, count: int | None = None) -> ExactCall | None:
    """The only one of *calls* at a place whose callee is called *name* (its last part), with *count* arguments.

    An object may be constructed by an alias's name: then the only call there is taken if it constructs one.
    """
    fitting = [call for call in calls if count is None or len(call.arguments) == count]
    named = [call for call in fitting if call.callee and _last(call.callee) == name]
    if named:
        return named[0] if len(set(named)) == 1 else None
    return fitting[0] if len(calls) == len(fitting) == 1 and fitting[0].kind != "call" else None


def _last(callee: str) -> str:
    return callee.partition("<")[0].rpartition("::")[2]


def _load(answer: str) -> object:
    try:
        return json.loads(answer) if len(answer) <= ANSWER_LIMIT else None
    except (ValueError, RecursionError):
        return None


def _table(value: object, key: str) -> dict[str, Any]:
    found = value.get(key) if isinstance(value, dict) else None
    return found if isinstance(found, dict) else {}


def _call(value: object) -> ExactCall | None:
    if not isinstance(value, dict):
        return None
    arguments, templates = value.get("arguments"), value.get("templates")
    if not (isinstance(arguments, list) and isinstance(templates, list)):
        return None
    parsed = tuple(a for a in map(_argument, arguments) if a is not None)
    callee, type_, kind, is_macro = (value.get(key) for key in ("callee", "type", "kind", "macro"))
    well = _is_text(callee) and _is_text(type_) and kind in _KINDS and isinstance(is_macro, bool)
    if not well or len(parsed) != len(arguments) or not all(map(_is_text, templates)):
        return None
    return ExactCall(callee, type_, parsed, tuple(templates), str(kind), bool(is_macro))


def _argument(value: object) -> ExactArgument | None:
    if not isinstance(value, dict):
        return None
    type_, written, known = value.get("type"), value.get("written"), value.get("value")
    if not (_is_text(type_) and _is_text(written)) or not (known is None or isinstance(known, (str, bool, int, float))):
        return None
    if isinstance(known, float) and not math.isfinite(known):
        return None
    return ExactArgument(type_, known, written)


def _is_text(value: object) -> bool:
    return value is None or isinstance(value, str)
