# SPDX-License-Identifier: Apache-2.0
"""Attributes of self that a callback reads and that the constructor sets after it has registered the callback (rospy runs it in a thread of its own)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project, dataclass, listed, regex, syntax
from haros_ci.api.code import Callback, Codebase, Routine, alone, base_names, callbacks, methods, owner_of

_KINDS = frozenset(("subscription", "service", "timer"))
#: Calls that take their time: a message comes while they wait.
_WAITS = frozenset(
    "sleep wait_for_service wait_for_message wait_for_server waitForServer wait_for_transform waitForTransform wait_for_result".split()
)
#: Calls in which callbacks of rclpy run.
_SPINS = frozenset(("spin_once", "spin_some", "spin_until_future_complete", "spin_until_complete", "spin"))
#: Classes that may set or ask for attributes by name.
_BY_NAME = regex(r"\b(?:setattr|hasattr|getattr|vars)\s*\(|__(?:getattr|getattribute|dict|slots)__|AttributeError")
#: A constructor with more statements is data.
_MANY = 500
_CALLBACKS = 50


@dataclass(frozen=True, slots=True)
class _Late:
    """*names* are set in the constructor only after *callback* is registered; *waits* is a call between that takes its time."""

    callback: Callback
    names: tuple[str, ...]
    waits: str


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    by_maker: dict[int, list[Callback]] = {}
    for callback in callbacks(code):
        maker = callback.maker
        if (
            maker.is_python
            and callback.kind in _KINDS
            and maker.function.name.endswith(".__init__")
            and maker.outer is None
        ):
            by_maker.setdefault(id(maker), []).append(callback)
    for made in by_maker.values():
        yield from _of_constructor(project, made)


def _of_constructor(project: Project, made: list[Callback]) -> Iterator[Finding]:
    code, maker = project.code, made[0].maker
    statements = maker.function.body or ()
    if maker.is_test or len(statements) > _MANY or _BY_NAME.search(alone(code, maker.path)):
        return
    available = _available(code, maker)
    found = [_late(code, callback, statements, available) for callback in made[:_CALLBACKS]]
    every = [late for late in found if late is not None]
    for group in ([late for late in every if late.waits], [late for late in every if not late.waits]):
        if group:
            yield _finding(project, group)


def _late(code: Codebase, callback: Callback, statements: syntax.Block, available: frozenset[str]) -> _Late | None:
    maker, routine = callback.maker, callback.routine
    ros = code.ros_of(maker.source)
    at = next(
        (
            n
            for n, statement in enumerate(statements)
            if any(node is callback.call.whole for node in syntax.preorder(statement))
        ),
        None,
    )
    if at is None or not isinstance(statements[at], syntax.Do) or routine.owner != maker.owner or ros is None:
        return None
    before = _made(code, maker, statements[: at + 1])
    read = _read_first(routine)
    sets = [_sets(statement) if isinstance(statement, syntax.Do) else set() for statement in statements[at + 1 :]]
    names = [name for name in read if name not in before | available and any(name in group for group in sets)]
    if not names:
        return None
    last = max(n for n, group in enumerate(sets) if group & {*names})
    calls = [name for statement in statements[at + 1 : at + 2 + last] for name in _calls(statement)]
    waits = next((name for name in calls if name in (_WAITS if ros == 1 else _SPINS)), "")
    return _Late(callback, tuple(names), waits) if ros == 1 or waits else None


def _own(node: syntax.Part) -> str:
    """The attribute of self that *node* is; "" of anything else."""
    return node.name if isinstance(node, syntax.Member) and isinstance(node.object, syntax.This) else ""


def _sets(part: syntax.Part) -> set[str]:
    """The attributes of self that a statement sets, anywhere in it."""
    found: set[str] = set()
    for node in syntax.everything(part):
        if isinstance(node, syntax.Assignment):
            targets = node.target.items if isinstance(node.target, syntax.ListLiteral) else (node.target,)
            found.update(name for target in targets if (name := _own(target)))
    return found


def _calls(statement: syntax.Statement) -> Iterator[str]:
    for node in syntax.preorder(statement):
        if isinstance(node, syntax.Call):
            yield syntax.name_of(node.callee)


def _made(code: Codebase, maker: Routine, statements: syntax.Block) -> set[str]:
    """What statements set, themselves or in methods of the object that they call; each method is seen once."""
    found: set[str] = set()
    owner = owner_of(code, maker)
    if owner is None:
        return _sets(statements)
    waiting = [statements]
    seen: set[str] = set()
    while waiting:
        block = waiting.pop()
        found |= _sets(block)
        for node in syntax.preorder(block):
            name = _own(node.callee) if isinstance(node, syntax.Call) else ""
            if name and name not in seen:
                seen.add(name)
                waiting += [method.function.body or () for method in methods(code, owner, name)]
    return found


def _available(code: Codebase, maker: Routine) -> frozenset[str]:
    """What objects of the class have from the start: its methods, what stands in its body, and the same of its bases."""
    owner = owner_of(code, maker)
    if owner is None:
        return frozenset()
    found: set[str] = set()
    for name in {owner[1].name, *(base_name.rpartition(".")[2] for base_name in base_names(code, owner))}:
        for path, class_ in _classes(code).get(name, ()):
            found.update(field.name.rpartition(".")[2] for field in class_.fields)
            is_base = class_.name != owner[1].name
            for routine in code.routines(path):
                if routine.owner == class_.name:
                    found.add(routine.function.name.rpartition(".")[2])
                    found |= {name for one in routine.function.body or () for name in _sets(one)} if is_base else set()
    return frozenset(found)


def _classes(code: Codebase) -> dict[str, list[tuple[str, syntax.Class]]]:
    """The Python classes by name, with their files."""
    key = "attribute-set-late"
    if key not in code.kept:
        made: dict[str, list[tuple[str, syntax.Class]]] = {}
        for source in code.sources:
            for class_ in source.program.classes if source.program.language == "python" else ():
                made.setdefault(class_.name, []).append((source.path, class_))
        code.kept[key] = made
    found: dict[str, list[tuple[str, syntax.Class]]] = code.kept[key]
    return found


def _read_first(routine: Routine) -> list[str]:
    """The attributes that a callback reads each time, before a branch can keep it from that."""
    found: dict[str, None] = {}
    known: set[str] = set()
    waiting = list(reversed(routine.function.body or ()))
    while waiting:
        statement = waiting.pop()
        if isinstance(statement, syntax.Nested):
            waiting.extend(reversed(statement.body))
            continue
        if not isinstance(statement, (syntax.Do, syntax.Variable, syntax.If, syntax.Return, syntax.Each)):
            break
        part = (
            statement.test
            if isinstance(statement, syntax.If)
            else statement.iterable
            if isinstance(statement, syntax.Each)
            else statement
        )
        found.update((name, None) for name in _reads(part) if name not in known)
        known |= _sets(part)
        if isinstance(statement, syntax.Return) or (
            isinstance(statement, syntax.If) and _may_leave((statement.then, statement.other))
        ):
            break
        if isinstance(statement, (syntax.If, syntax.Each)):
            known |= _sets(statement)
    return list(found)


def _may_leave(part: syntax.Part) -> bool:
    return any(isinstance(node, (syntax.Return, syntax.Throw)) for node in syntax.everything(part))


def _reads(part: syntax.Part) -> Iterator[str]:
    """The attributes of self that are read in a part of a statement; not what it sets."""
    waiting = syntax.below((part,))
    while waiting:
        node = waiting.pop()
        if isinstance(node, syntax.Assignment) and node.operator == "=":
            waiting += [node.value] if _own(node.target) else [node.value, node.target]
        elif isinstance(node, syntax.Operation) and node.operator in ("&&", "||"):
            waiting.append(node.operands[0])
        elif name := _own(node):
            yield name
        else:
            waiting += reversed(syntax.below(node))


def _finding(project: Project, group: list[_Late]) -> Finding:
    """One finding for the callbacks of a constructor: who moves one to its end moves them all."""
    late, *others = group
    callback = late.callback
    maker = callback.maker
    ros = project.code.ros_of(maker.source)
    when = f", and {late.waits}() lies between" if late.waits else ""
    how = "rospy runs it as soon as a message comes" if ros == 1 else f"it runs in {late.waits}()"
    names = listed([f"{other.callback.routine.title}()" for other in others])
    more = f"; and the same of {names}" if others else ""
    places = [place for one in group for place in _set_at(project, one)]
    registered = [(other.callback.location, f"{other.callback.routine.title}() is registered here") for other in others]
    return Finding(
        at=callback.location,
        message=f"{callback.routine.title}() is registered before {listed([f'self.{name}' for name in late.names])}, which it reads, "
        f"{'is' if len(late.names) == 1 else 'are'} set{when if ros == 1 else ''}: {how}, and raises AttributeError; register it at the end of "
        f"__init__(){more}",
        about=(maker.title, callback.routine.title, *late.names),
        related=(*registered, *dict.fromkeys(places)),
        level=None if late.waits else Level.NOTE,
        apart=(callback.routine.title,),
    )


def _set_at(project: Project, late: _Late) -> Iterator[tuple[Location, str]]:
    """Where the attributes are set, below the registration."""
    maker, line = late.callback.maker, late.callback.call.line
    text = project.text(maker.path).split("\n")
    for name in late.names:
        pattern = re.compile(rf"\bself\.{re.escape(name)}\b[^=\n]*=(?!=)")
        found = next((n for n in range(line, len(text)) if pattern.search(text[n])), None)
        if found is not None:
            yield Location(maker.path, found + 1), f"self.{name} is set here"


CHECK = Check(
    id="attribute-set-late",
    summary="Callback that is registered before the attributes that it reads are set.",
    level=Level.WARNING,
    tags=("code", "python"),
    project=check,
)
