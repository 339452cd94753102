# SPDX-License-Identifier: Apache-2.0
"""What a block of code names: what it calls and constructs, what it assigns to, which variables may hold a function."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from haros_ci.link.index import Index, Source
from haros_ci.model.program import Statement

#: Methods that build a list, whose turns are worth following one by one.
COLLECTING = frozenset(("push_back", "emplace_back", "append", "insert", "emplace", "extend"))
#: Methods of pluginlib's loaders that give an instance.
LOADERS = frozenset(
    "createInstance createUniqueInstance createSharedInstance createUnmanagedInstance createClassInstance".split()
)
#: Methods that change a text, as calls of them look.
EDITING = frozenset((".erase", ".replace", ".pop_back"))
#: Methods that leave what they are called on as it is.
READING = frozenset(
    "size length empty c_str str find rfind substr compare at begin end count get front back data lock expired isValid "
    "ok now toSec".split()
)
#: Methods of containers, texts and pointers: called on an object, they are taken for these.
CONTAINERS = (
    READING | COLLECTING | frozenset("clear erase resize reset set has swap pop_back pop push lock unlock".split())
)
#: Methods of all sorts of classes that are told apart by the number of their arguments.
COUNTED = frozenset(("publish",))
#: Stands for an assignment to an element among the names of a block.
ELEMENT = "[]="
#: Stands for the call of a variable: what it holds may make something.
CALLED = "()"
#: Types of variables that can be called, and Python's expressions that may give a function.
FUNCTIONS = frozenset(("()", "boost::function", "std::function", "function"))
#: The method that a call of an object runs.
CALL = "operator()"
HELD = frozenset(("lambda", "name", "field", "call", "index", "if", "op"))


def called_in(item: Any, found: set[str], mentioned: set[str], source: Source) -> None:
    """Collect what is called or constructed in *item*, and what is mentioned in any other way."""
    lambdas: set[int] = set()
    waiting = _inner((item,))
    while waiting:
        node = waiting.pop()
        tag = node[0]
        if tag == "call" and len(node) == 6:
            callee = node[1]
            if callee[0] == "name":
                found.add(last(callee[1]))
                found.add("::".join(callee[1].split("::")[-2:]))
                if callee[1].endswith(("::make_shared", "::make_unique")):
                    found.add(callee[1].split("::")[-2])
            elif callee[0] == "field":
                found.add(callee[2] if callee[2] in COLLECTING else f".{callee[2].rpartition('::')[2]}")
                if callee[2] in COUNTED:
                    found.add(f"{callee[2]}/{len(node[2])}")
            elif callee[0] == "index" and source.separator == ".":
                found.add(CALLED)
            elif callee[0] == "index" and callee[1][0] in ("name", "field"):
                found.add(last(callee[1][-1]))
            found.update(last(name) for kind in node[3] for name in type_names(kind))  # make_shared<T>()
        elif tag == "set" and len(node) == 4 and node[2][0] == "index":
            found.add(ELEMENT)
        elif (tag == "new" and len(node) == 5) or (tag == "var" and len(node) == 6):
            kind = node[1] if tag == "new" else node[2]
            found.update(last(name) for name in type_names(kind))
        elif tag in ("lambda", "def") and isinstance(node[-1], int) and node[-1] not in lambdas:
            lambdas.add(node[-1])
            if 0 <= node[-1] < len(source.program.functions):
                waiting += _inner((source.program.functions[node[-1]].body,))
        elif tag in ("name", "field") and isinstance(node[-1], str):
            mentioned.add(last(node[-1]))
        waiting += _inner(node)


def may_be_called(kind: Any, source: Source, kinds: frozenset[str] = FUNCTIONS) -> bool:
    """Whether a parameter of the type may be a function, which those of *kinds* are; Python does not say."""
    return kind[0] in kinds or kind[0] == "auto" or (kind[0] == "" and source.program.language == "python")


def function_types(index: Index) -> frozenset[str]:
    """The names of C++ types that hold functions: of libraries, and the workspace's aliases of them."""
    named = set(FUNCTIONS)
    for _ in range(2):  # an alias of an alias
        for name, aliases in index.aliases.items():
            if any(not named.isdisjoint(type_names(alias.type)) for _, alias in aliases):
                named |= {name, last(name)}
    return frozenset(named)


def functors(index: Index) -> frozenset[str]:
    """The last names of the C++ classes whose objects can be called."""
    return frozenset(last(name.removesuffix(f"::{CALL}")) for name in index.functions if name.endswith(f"::{CALL}"))


def members_of(index: Index, kinds: frozenset[str]) -> frozenset[str]:
    """The names of C++ members of one of these types."""
    return frozenset(
        field.name
        for classes in index.classes.values()
        for source, definition in classes
        for field in definition.fields
        if source.separator == "::" and any(last(name) in kinds for name in type_names(field.type))
    )


def holding(index: Index) -> frozenset[str]:
    """The names of members that hold a function.

    C++ says so in the member's type; in Python it is an attribute that is assigned to, and no method of any class.
    """
    named = function_types(index)
    found = {
        field.name
        for classes in index.classes.values()
        for source, definition in classes
        for field in definition.fields
        if source.separator == "::" and not named.isdisjoint(type_names(field.type))
    }
    attributes = set[str]()
    methods = set[str]()
    for functions in index.functions.values():
        for source, function in functions:
            if source.separator == ".":
                methods.add(last(function.name))
                if function.owner and function.body is not None:
                    _attributes(function.body, attributes)
    return frozenset(found | (attributes - methods - CONTAINERS))


def _attributes(block: Any, found: set[str]) -> None:
    """Collect the attributes that Python code may keep a function in."""
    waiting = _inner((block,))
    while waiting:
        node = waiting.pop()
        if node[0] == "set" and len(node) == 4 and node[2][0] == "field" and node[3][0] in HELD:
            found.add(node[2][2])
        waiting += _inner(node)


def callable_variables(block: Any, names: set[str], source: Source, kinds: frozenset[str]) -> None:
    """Collect the local variables of *block* that a function, lambda or class is assigned to, or of one of *kinds*."""
    waiting = _inner((block,))
    python = source.program.language == "python"
    while waiting:
        node = waiting.pop()
        if node[0] == "var" and len(node) == 6:
            init = node[3]
            if (
                may_be_called(node[2], source)
                or any(last(name) in kinds for name in type_names(node[2]))
                or (init and init[0] == "=" and init[1] and init[1][0] == "lambda")
            ):
                if node[2][0] != "auto" or (
                    init and init[0] == "=" and init[1][0] in ("lambda", "name", "&", "call", "if")
                ):
                    names.add(node[1])
        elif python and node[0] == "set" and len(node) == 4 and node[2][0] == "name" and node[3][0] in HELD:
            names.add(node[2][1])
        elif node[0] == "each" and len(node) == 8 and may_be_called(node[5], source):
            names.add(node[4])
        elif node[0] == "def":
            continue
        waiting += _inner(node)


def _inner(node: Any) -> list[Any]:
    """The parts of a node that have parts themselves."""
    return [part for part in node if (part.__class__ is list or part.__class__ is tuple) and part]


def targets(item: Any, found: set[str]) -> None:
    """The last names of all that is assigned to, read into or built up in a block."""
    waiting = _inner((item,))
    while waiting:
        node = waiting.pop()
        target = None
        if node[0] == "set" and len(node) == 4:
            target = node[2]
        elif node[0] == "op" and len(node) == 3 and node[1] in (">>", "<<") and len(node[2]) == 2:
            target = node[2][1] if node[1] == ">>" else node[2][0]
        elif node[0] == "call" and len(node) == 6 and node[1][0] == "field" and node[1][2] not in READING:
            target = node[1][1]
        while target is not None:
            if target[0] in ("name", "field"):
                found.add(last(target[-1]))
                break
            target = (
                target[1] if target[0] in ("index", "*", "&", "call") else target[2] if target[0] == "cast" else None
            )
        waiting += _inner(node)


def type_names(kind: Any) -> Iterable[str]:
    if isinstance(kind, (tuple, list)) and len(kind) == 3 and isinstance(kind[0], str):
        yield kind[0]
        for inner in kind[1]:
            yield from type_names(inner)


def last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2]


def without(item: Any, statement: Statement) -> Any:
    """*item*, statements in one another, without one of them; the same object where it is not in it."""
    if not isinstance(item, (tuple, list)):
        return item
    if item is statement:
        return ("block", ())
    inner = [without(each, statement) for each in item]
    return item if all(one is other for one, other in zip(item, inner, strict=True)) else tuple(inner)
