# SPDX-License-Identifier: Apache-2.0
"""What holds data: members of classes, variables of files and locals, each with one identity wherever it is mentioned."""

from __future__ import annotations

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.records import dataclass, field
from haros_ci.syntax import Expression
from haros_ci.syntax.walk import everything

#: Methods that give a part of their object, or the object behind a pointer.
PARTS = frozenset("at back front begin end rbegin cbegin find get value data lock top first emplace_back".split())
#: Functions that return what they are given.
SAME = frozenset(("move", "forward", "ref"))


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """A *member* of a class, a *variable* of a file, or a *local* of a routine: *owner* says of which. *title* is for people.

    There is one object for one thing of a code base (``_one``): it is looked up very often.
    """

    kind: str
    owner: str
    name: str
    title: str = ""
    #: Its hash, which is asked for again and again.
    number: int = field(init=False, compare=False, repr=False, default=0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "number", hash((self.kind, self.owner, self.name)))

    def __hash__(self) -> int:
        return self.number


def held(code: Codebase, routine: Routine, node: Expression) -> Held | None:
    """What a name or member access in *routine* means, if that holds data of the workspace; None for anything else."""
    if isinstance(node, syntax.Name):
        key = ("held", id(routine), node.name)
        if key not in code.kept:
            code.kept[key] = _named(code, routine, node.name)
            code.kept["keep", id(routine)] = routine
        found: Held | None = code.kept[key]
        return found
    if isinstance(node, syntax.Member):
        is_own = isinstance(node.object, syntax.This)
        owner = classes.owner_of(code, routine) if is_own else kinds.class_of(code, routine, node.object)
        return member(code, owner, node.name) if owner is not None else None
    return None


def member(code: Codebase, owner: classes.Owner, name: str) -> Held | None:
    """The data member of that name, of the class that has it first; None for a method, or where the class has none."""
    key = ("held member", id(owner[1]), name)
    if key not in code.kept:
        code.kept[key] = _member(code, owner, name)
    found: Held | None = code.kept[key]
    return found


def _member(code: Codebase, owner: classes.Owner, name: str) -> Held | None:
    if owner[0].separator == "::":
        found = classes.field_of(code, owner, name)
        return _of_class(code, found[0], name) if found is not None else None
    if classes.methods(code, owner, name):
        return None
    every = [owner, *(above for above, _ in classes.bases(code, owner) if above is not None)]
    for above in reversed(every):
        if any(field.name == name for field in above[1].fields) or _sets(code, above, name):
            return _of_class(code, above, name)
    return None


def _one(code: Codebase, kind: str, owner: str, name: str, title: str) -> Held:
    """The one object that stands for a thing; the first title stays."""
    key = ("held", kind, owner, name)
    if key not in code.kept:
        code.kept[key] = Held(kind, owner, name, title)
    found: Held = code.kept[key]
    return found


def _of_class(code: Codebase, owner: classes.Owner, name: str) -> Held:
    source, definition = owner
    return _one(code, "member", f"{source.path}:{definition.name}", name, name)


def _sets(code: Codebase, owner: classes.Owner, name: str) -> bool:
    """Whether a method of a Python class itself assigns to the attribute."""
    key = ("sets", id(owner[1]))
    if key not in code.kept:
        names = set()
        for routine in code.routines(owner[0].path):
            if routine.owner == owner[1].name:
                for target, *_ in code.body(routine).sets:
                    if isinstance(target, syntax.Member) and isinstance(target.object, syntax.This):
                        names.add(target.name)
        code.kept[key] = frozenset(names)
    known: frozenset[str] = code.kept[key]
    return name in known


def _named(code: Codebase, routine: Routine, name: str) -> Held | None:
    around: Routine | None = routine
    while around is not None:
        if _declares(code, around, name):
            return _one(code, "local", f"{around.path}:{around.function.line}:{around.function.column}", name, name)
        around = around.outer
    if routine.is_python:
        return _of_module(code, routine, name)
    owner = classes.owner_of(code, routine)
    if owner is not None and "::" not in name:
        found = member(code, owner, name)
        if found is not None:
            return found
    outside = kinds.variables_outside(code, routine, name)
    return _one(code, "variable", outside[0][0].path, outside[0][1].name, name.rpartition("::")[2]) if outside else None


def _of_module(code: Codebase, routine: Routine, name: str) -> Held | None:
    modules = [other for other in code.routines(routine.path) if other.function.kind == "module"]
    if any(name in _assigned(code, module) for module in modules):
        return _one(code, "variable", routine.path, name, name)
    return None


def _declares(code: Codebase, routine: Routine, name: str) -> bool:
    """Whether a name is a variable or parameter of this very routine."""
    if routine.is_python and routine.function.kind == "module":
        return False
    if any(parameter.name.lstrip("*") == name for parameter in routine.function.parameters):
        return True
    if name in code.body(routine).variables:
        return not (routine.is_python and name in _outer_names(code, routine))
    return routine.is_python and name in _assigned(code, routine) and name not in _outer_names(code, routine)


def _assigned(code: Codebase, routine: Routine) -> frozenset[str]:
    key = ("assigned names", id(routine))
    if key not in code.kept:
        targets = [target for target, *_ in code.body(routine).sets]
        names = {node.name for target in targets for node in _targets(target)}
        code.kept[key] = frozenset(names) | code.body(routine).variables.keys()
        code.kept["keep", id(routine)] = routine
    found: frozenset[str] = code.kept[key]
    return found


def _targets(target: Expression) -> list[syntax.Name]:
    if isinstance(target, syntax.Name):
        return [target]
    if isinstance(target, syntax.ListLiteral):
        return [name for item in target.items for name in _targets(item)]
    return []


def _outer_names(code: Codebase, routine: Routine) -> frozenset[str]:
    """The names that Python's ``global`` and ``nonlocal`` say to be of somebody else."""
    key = ("outer names", id(routine))
    if key not in code.kept:
        parts = everything(routine.function.body or ())
        code.kept[key] = frozenset(
            name for node in parts if isinstance(node, (syntax.Global, syntax.Nonlocal)) for name in node.names
        )
        code.kept["keep", id(routine)] = routine
    found: frozenset[str] = code.kept[key]
    return found


def chain(node: Expression) -> tuple[list[Expression], bool]:
    """The names and member accesses from *node* down to the variable that it is a part of, and whether it is that itself.

    ``a.b[i].c`` gives ``a.b[i].c``, ``a.b`` and ``a``; nothing for what is no part of a variable.
    """
    found: list[Expression] = []
    is_whole = True
    for _ in range(100):
        if isinstance(node, syntax.Name) or (isinstance(node, syntax.Member) and isinstance(node.object, syntax.This)):
            found.append(node)
            return found, is_whole
        if isinstance(node, syntax.Member):
            found.append(node)
            node, is_whole = node.object, False
        elif isinstance(node, syntax.Subscript):
            node, is_whole = node.object, False
        elif isinstance(node, syntax.Dereference):
            node, is_whole = node.value, False
        elif isinstance(node, (syntax.Address, syntax.Cast, syntax.Keyword, syntax.Star)):
            node = node.value
        elif isinstance(node, syntax.Call):
            inner = _through(node)
            if inner is None:
                return [], False
            node, is_whole = inner, False
        else:
            return [], False
    return [], False


def _through(call: syntax.Call) -> Expression | None:
    """The object of whose value a call gives a part; None for another call."""
    callee = call.callee
    if isinstance(callee, syntax.Member) and callee.name in PARTS:
        return callee.object
    if syntax.name_of(callee).rpartition("::")[2] in SAME and len(call.arguments) == 1:
        return call.arguments[0]
    return None
