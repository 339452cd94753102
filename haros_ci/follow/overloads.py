# SPDX-License-Identifier: Apache-2.0
"""Which of several functions of one name is meant; where that is not known, a function that is certainly none of them.

C++ ranks overloads by how their parameters fit the arguments (en.cppreference.com/w/cpp/language/overload_resolution).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

from haros_ci import syntax
from haros_ci.follow import yielding
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import EITHER, Source
from haros_ci.index.types import INTEGERS, REALS, STRINGS, is_smart_pointer, pointee
from haros_ci.syntax import Block, Class, Function, Type
from haros_ci.syntax.walk import everything
from haros_ci.values.abstract import Known, Object, Value, join

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

Found = tuple[Source, Function]
Placed = TypeVar("Placed", Class, Function)
#: How a parameter takes an argument: as it is, as a template's, converted, perhaps, not at all.
EXACT, GENERIC, CONVERTED, PERHAPS, NOT = 4, 3, 2, 1, 0
#: Decorators that leave what a function returns as it is, by the last part of their names.
TRANSPARENT = frozenset(
    "property staticmethod classmethod wraps abstractmethod abstractproperty cached_property lru_cache cache override final setter "
    "getter deleter overload".split()
)
#: Expressions and statements whose numbers are no places.
STRICT = (syntax.Number, syntax.Lambda, syntax.NestedFunction)
ACCESSORS = frozenset(("setter", "deleter", "getter"))
#: Classes of bases that are looked into.
BASES = 12
#: Functions of one name that are compared with the arguments of a call.
MOST = 200


def nearest(walk: Walk, found: list[Found], source: Source) -> list[Found]:
    """Of definitions elsewhere of what *source* declares: those of the node's own files, else of its package, else others."""
    index = walk.index
    for fits in (
        lambda other: other.path in walk.files,
        lambda other: other.path == source.path,
        lambda other: other.package == source.package,
    ):
        near = [item for item in found if fits(item[0])]
        if near:
            informed = [
                item for item in near if item[0].path == source.path or source.path in index.reach(item[0].path)
            ]
            return informed or near
    return [item for item in found if item[1].owner in index.classes or index.sees(source, item[0], walk.files)]


def chosen(walk: Walk, candidates: list[Found], arguments: Sequence[PassedArgument]) -> Found:
    """The overload that fits *arguments* best; of several that fit alike, none for certain."""
    ranked: list[tuple[int, Found]] = []
    for item in candidates:
        fits = [
            _fit(walk, item, parameter.type, argument)
            for parameter, argument in zip(item[1].parameters, arguments, strict=False)
        ]
        ranked.append((-1 if NOT in fits else sum(fits), item))
    top = max(score for score, _ in ranked)
    best = sorted((item for score, item in ranked if score == top), key=lambda item: item[1].body is None)
    names = {signature(item[1]) for item in best}
    if len(names) == 1 or best[0][1].body is None:
        return any_of(walk, best[0], best) if best[0][1].body is not None else best[0]
    return best[0][0], _unsure(walk, best[0][1], tuple(item[1] for item in best))


def takes(function: Function, count: int) -> bool:
    """Whether a function can be called with *count* arguments."""
    required = sum(1 for p in function.parameters if p.default is None and not p.name.startswith("*"))
    open_end = any(p.name.startswith("*") for p in function.parameters)
    return required <= count and (open_end or count <= len(function.parameters))


def any_of(walk: Walk, one: Found, candidates: Sequence[Found]) -> Found:
    """*one*, or what stands for all that have its signature and another body."""
    if len(candidates) == 1 and candidates[0][1] is one[1]:
        return one
    key = ("any of", id(one[1]), *(id(function) for _, function in candidates))
    known: Found | None = walk.found.get(key)
    if known is None:
        known = walk.found[key] = _any_of(walk, one, candidates)
    return known


def _any_of(walk: Walk, one: Found, candidates: Sequence[Found]) -> Found:
    requested = signature(one[1])
    alike = [
        item for item in candidates if item is one or (item[1].body is not None and signature(item[1]) == requested)
    ]
    different = [one, *(item for item in alike if item[1] is not one[1] and _is_other(walk, item, one))]
    if len(different) == 1:
        return one
    functions = tuple(item[1] for item in different)
    if all(f.guards for f in functions) and _are_alternatives(different):
        return one[0], _guarded(walk, functions)
    may_be = [item for item in different if not _is_left_out(walk, *item)]
    if len(may_be) == 1:
        return may_be[0]
    return one[0], _one_of(walk, one[1], may_be) or _unsure(walk, one[1], functions)


def _are_alternatives(different: list[Found]) -> bool:
    """Whether functions of one file have the same names of parameters: one body may stand for another."""
    names = {tuple(parameter.name for parameter in function.parameters) for _, function in different}
    return len(names) == 1 and len({source.path for source, _ in different}) == 1


def _one_of(walk: Walk, one: Function, found: list[Found]) -> Function | None:
    """What stands for functions in several files of which a build has one; None if these are others."""
    paths = {source.path for source, _ in found}
    if len(paths) != len(found) or not paths <= walk.index.conditional or one.kind != "function":
        return None
    made: Function = syntax.replace(one, name=one.name)  # another one, by identity
    walk.found["any", id(made)] = made
    walk.found["one of", id(made)] = tuple(found)
    return made


def _is_other(walk: Walk, item: Found, one: Found) -> bool:
    """Whether two functions do not do the same: of the same text, in files of which a build has one, they use what their files define."""
    if not _same(item[1].body, one[1].body):
        return True
    if item[0].path == one[0].path or not {item[0].path, one[0].path} <= walk.index.conditional:
        return False
    used = {node.name for node in everything(one[1].body) if isinstance(node, (syntax.Name, syntax.Member))}
    programs = [source.program for source, _ in (one, item)]
    defined = [function.name for program in programs for function in program.functions]
    defined += [variable.name for program in programs for variable in program.variables]
    return not used.isdisjoint(name.rpartition("::")[2] for name in defined)


def compiled(walk: Walk, candidates: list[Found]) -> list[Found]:
    """Without those that stand under an ``#if`` that is not compiled, where others are left."""
    if not any(function.guards for _, function in candidates):
        return candidates
    return [item for item in candidates if not _is_left_out(walk, *item)] or candidates


def _is_left_out(walk: Walk, source: Source, function: Function) -> bool:
    """Whether a function stands under an ``#if`` that is not compiled."""
    return any(walk.is_compiled(source.path, line) is False for line, _, _ in function.guards)


def ways(walk: Walk, function: Function) -> tuple[Found, ...]:
    """What *function* stands for, of which the build takes one: definitions in files that are there in some builds only; empty if it is itself."""
    found: tuple[Found, ...] = walk.found.get(("one of", id(function)), ())
    return found


def is_any(walk: Walk, function: Function) -> bool:
    """Whether *function* stands for several, or for what a decorator makes of one."""
    return ("any", id(function)) in walk.found


def original(walk: Walk, function: Function) -> Function:
    """The function that *function* stands for: the first where it is several."""
    found: Function = walk.found.get(("any", id(function)), function)
    return found


def decorated(walk: Walk, function: Function) -> Function:
    """A Python function as its decorators leave it: with results that are not known where they may do anything."""
    for decorator in function.decorators:
        while type(decorator) is syntax.Call:
            decorator = decorator.callee
        if (name := syntax.name_of(decorator)) not in TRANSPARENT and not yielding.is_manager(name, function):
            return _unsure(walk, function, (function,))
    return function


def python_methods(found: list[Found]) -> list[Found]:
    """The last definition of a method counts; a property's setter is none."""
    own = [
        item for item in found if not any(type(d) is syntax.Member and d.name in ACCESSORS for d in item[1].decorators)
    ]
    return (own or found)[-1:]


def last(found: list[tuple[Source, Placed]]) -> list[tuple[Source, Placed]]:
    """Of definitions of one name in a module those that count: the last, and before it those that an ``if`` or ``try`` decides about."""
    sure = [number for number, (_, item) in enumerate(found) if item.column == 1]
    return found[sure[-1] :] if sure else found


def either(values: list[Value]) -> Value:
    """What a name is that has one of *values*."""
    value = values[0]
    for other in values[1:]:
        value = join(value, other)
    return value


def signature(function: Function) -> tuple[str, ...]:
    """The parameters' types as text that a declaration and its definition share, names without their scopes."""
    return tuple(plain(parameter.type) for parameter in function.parameters)


def plain(kind: syntax.Argument, depth: int = 0) -> str:
    """A type as text, names without their scopes."""
    if type(kind) is not syntax.Type or depth > BASES:
        return "?"
    inner = ",".join(plain(item, depth + 1) for item in kind.arguments)
    return f"{kind.name.rpartition('::')[2]}<{inner}>{kind.marks}"


def _same(one: object, other: object) -> bool:
    """Whether two blocks are the same but for their places."""
    waiting = [(one, other)]
    while waiting:
        left, right = waiting.pop()
        if isinstance(left, tuple) and isinstance(right, tuple):
            if len(left) != len(right):
                return False
            waiting += zip(left, right, strict=True)
        elif isinstance(left, syntax.Record) and isinstance(right, syntax.Record):
            if type(left) is not type(right) or (isinstance(left, STRICT) and left != right):
                return False
            waiting += [(getattr(left, name), getattr(right, name)) for name in left.__struct_fields__]
        elif left != right and not (type(left) is int and type(right) is int):
            return False
    return True


def _guarded(walk: Walk, functions: tuple[Function, ...]) -> Function:
    """One function of the bodies under the branches of an #if."""
    branches = tuple(syntax.Branch(*function.guards[-1], function.body or ()) for function in functions)
    return _made(walk, functions, (syntax.Preprocessor(branches),), functions[0].guards[:-1])


def _unsure(walk: Walk, function: Function, functions: tuple[Function, ...]) -> Function:
    """*function* with results, and effects, that are not sure."""
    removed = (syntax.Return(syntax.Unknown(EITHER)),)
    branch = syntax.Branch(function.line, function.column, "", removed)
    body = (syntax.Preprocessor((branch,)), *(function.body or ()))
    return _made(walk, functions, body, function.guards)


def _made(
    walk: Walk, functions: tuple[Function, ...], body: Block, guards: tuple[tuple[int, int, str], ...]
) -> Function:
    key = ("any of", *(id(function) for function in functions))
    found: Function | None = walk.found.get(key)
    if found is None:
        found = walk.found[key] = syntax.replace(functions[0], body=body, guards=guards)
        walk.found["any", id(found)] = functions[0]
    return found


def _fit(walk: Walk, item: Found, written: Type, argument: PassedArgument) -> int:
    source, function = item
    value, type_ = argument.value, argument.type
    if type_ is None or not type_.name:
        if isinstance(value, Known) and value.value is None:
            return EXACT if "*" in written.marks else PERHAPS
        if source.separator != "::" or not isinstance(value, Object) or value.definition is None:
            return PERHAPS
        type_ = syntax.Type(value.name, value.arguments, "*")
    if written.name in function.templates:
        return GENERIC
    kind = walk.type_in(written, Frame(source, function.owner or function.name.rpartition("::")[0]))
    owner = walk.class_of(function.owner, source) if function.owner else None
    if owner is not None and kind.name in owner[1].templates:
        return GENERIC
    fits = _conversion(walk, source, kind, type_)
    is_own = type_ is not argument.type and fits == PERHAPS and (is_smart_pointer(kind) or "*" in kind.marks)
    return NOT if is_own and _is_of_workspace(walk, source, type_.name) and "void" not in pointee(kind).name else fits


def _is_of_workspace(walk: Walk, source: Source, name: str) -> bool:
    """Whether a class and all its bases are defined in the workspace: what it converts to is known."""
    waiting, seen = [name], set[str]()
    while waiting:
        current = waiting.pop()
        owner = walk.class_of(current, source)
        if owner is None or len(seen) > BASES:
            return False
        if current not in seen:
            seen.add(current)
            waiting += [kind.name for kind in walk.bases(owner[0], owner[1], {})]
    return True


def _conversion(walk: Walk, source: Source, kind: Type, type_: Type) -> int:
    expected, shown = _sort(kind), _sort(type_)
    if expected in ("int", "real", "bool") and shown in ("int", "real", "bool"):
        if "*" in kind.marks:
            return NOT
        return EXACT if expected == shown else CONVERTED
    if "auto" in (expected, shown):
        return PERHAPS
    if expected == shown == "text":
        return EXACT
    if shown == "text":
        return NOT if expected in ("int", "real") else PERHAPS
    inner, actual = pointee(kind).name, pointee(type_).name
    if expected == "text":
        return NOT if shown in ("real", "bool") or _has_no_conversion(walk, source, actual) else PERHAPS
    if inner == actual or inner in (f"{actual}Ptr", f"{actual}ConstPtr"):
        return EXACT
    return CONVERTED if _derives(walk, source, actual, inner) else PERHAPS


def _has_no_conversion(walk: Walk, source: Source, name: str) -> bool:
    """Whether a class is of the workspace and neither it nor a base of it declares a conversion (``operator X``)."""
    owner = walk.class_of(name, source)
    if owner is None:
        return False
    if "conversions" not in walk.found:
        names = (name.partition("::operator ") for name in walk.index.functions)
        walk.found["conversions"] = frozenset(owner for owner, found, _ in names if found)
    return owner[1].name not in walk.found["conversions"] and not walk.bases(owner[0], owner[1], {})


def _sort(kind: Type) -> str:
    """What sort of thing a type is: text, bool, int, real, auto or its own name."""
    name: str = kind.name
    if name in STRINGS or (name == "char" and "*" in kind.marks):
        return "text"
    if name == "bool":
        return name
    if name in REALS:
        return "real"
    if name in INTEGERS or set(name.split()) <= INTEGERS:
        return "int"
    return "auto" if name == "auto" else name or "auto"


def _derives(walk: Walk, source: Source, name: str, base: str) -> bool:
    seen: set[str] = set()
    waiting = [name]
    while waiting and len(seen) < BASES:
        current = waiting.pop()
        if current == base:
            return True
        owner = walk.class_of(current, source)
        if owner is not None and current not in seen:
            seen.add(current)
            waiting += [kind.name for kind in walk.bases(owner[0], owner[1], {})]
    return False
