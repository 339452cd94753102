# SPDX-License-Identifier: Apache-2.0
"""Threads: which calls begin one with a function, and whether it has to end before the next one begins."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import kinds
from haros_ci.code.body import Call, last_part
from haros_ci.code.codebase import Codebase, Routine

#: Functions that begin a thread with a function, by the last part of the name.
THREADS = frozenset(("thread", "Thread", "create_thread", "jthread"))
#: Functions that make an object of their first template argument.
MAKERS = frozenset(("std::make_unique", "std::make_shared"))
#: Threads that end the program where they are destroyed or assigned to while they run, or wait (std::thread, std::jthread).
JOINED = frozenset(("std::thread", "std::jthread"))


def begins_thread(code: Codebase, where: Routine, call: Call) -> bool:
    """Whether a call begins a thread with a function that it is given."""
    return last_part(call.callee) in THREADS or _made(call.whole) in JOINED or _starts(code, where, call)


def is_joined(code: Codebase, where: Routine, call: Call) -> bool:
    """Whether a thread that *call* begins is kept in a member that can only take the next one when it has ended.

    That holds for ``std::thread`` which nobody detaches: to destroy it, or assign to it, while it runs ends the program.
    """
    if where.is_python or _made(call.whole) not in JOINED or where.path in code.mentioning("detach"):
        return False
    for target, operator, value, _ in code.body(where).sets:
        if value is call.whole and operator == "=":
            name = syntax.name_of(target)
            return isinstance(target, (syntax.Name, syntax.Member)) and not kinds.is_local(code, where, name)
    return False


def _made(call: syntax.Call) -> str:
    """The class of the thread that a call makes; "" for other calls."""
    name = syntax.name_of(call.callee)
    if name in JOINED:
        return name
    first = call.templates[0] if name in MAKERS and call.templates else None
    return first.name if isinstance(first, syntax.Type) else ""


def _starts(code: Codebase, where: Routine, call: Call) -> bool:
    """Whether a call is ``start(function)`` of a thread object (ecl/threads/thread.hpp)."""
    return (
        call.name == "start"
        and call.receiver is not None
        and kinds.type_name(code, where, call.receiver) == "ecl::Thread"
    )


def in_one(code: Codebase, one: Routine, other: Routine) -> bool:
    """Whether two routines may be in one program. Python files that no file imports both of, directly or through others, are not."""
    if not one.is_python or one.path == other.path:
        return True
    return any(one.path in group and other.path in group for group in _closures(code).values())


def _closures(code: Codebase) -> dict[str, frozenset[str]]:
    """The files that each Python file imports, with itself and what these import."""
    key = "imported files"
    if key not in code.kept:
        direct = {
            source.path: _imports(code, source.path) for source in code.sources if source.program.language == "python"
        }
        found: dict[str, frozenset[str]] = {}
        for path in direct:
            seen, waiting = {path}, [path]
            while waiting:
                fresh = direct.get(waiting.pop(), frozenset()) - seen
                seen |= fresh
                waiting += fresh
            found[path] = frozenset(seen)
        code.kept[key] = found
    known: dict[str, frozenset[str]] = code.kept[key]
    return known


def _imports(code: Codebase, path: str) -> frozenset[str]:
    """The files of the workspace that one imports; all with a last part of that name, where it is not known which."""
    tails = _tails(code)
    if path in code.mentioning("importlib", "__import__"):
        return frozenset().union(*tails.values())
    source = code.by_path[path]
    names = {alias.type.name for alias in source.program.aliases} | set(source.program.includes)
    for routine in code.routines(path):
        names |= set(code.body(routine).imports.values())
    found: set[str] = set()
    for name in names:
        for part in name.replace("/", ".").split("."):
            found |= tails.get(part, frozenset())
    return frozenset(found)


def _tails(code: Codebase) -> dict[str, frozenset[str]]:
    """The Python files by the last part of their path, and packages by their folder."""
    key = "files by their last part"
    if key not in code.kept:
        found: dict[str, set[str]] = {}
        for source in code.sources:
            if source.program.language == "python":
                parts = source.path.removesuffix(".py").split("/")
                name = parts[-2] if parts[-1] == "__init__" and len(parts) > 1 else parts[-1]
                found.setdefault(name, set()).add(source.path)
        code.kept[key] = {name: frozenset(paths) for name, paths in found.items()}
    known: dict[str, frozenset[str]] = code.kept[key]
    return known
