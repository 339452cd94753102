# SPDX-License-Identifier: Apache-2.0
"""What a block of code names: what it calls and constructs, what it assigns to, which variables may hold a function."""

from __future__ import annotations

from collections.abc import Container, Iterable
from functools import cache

from haros_ci import syntax
from haros_ci.index.index import Index, Source
from haros_ci.syntax.walk import Part, below, everything

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
#: Methods of containers and pointers that classes of a workspace have as often: called on another object, they may be either's.
EITHER = frozenset("clear erase pop push reset resize set has swap".split())
#: Methods of containers, texts and pointers that are taken for these; and those, too, that may be either's.
THEIRS = READING | COLLECTING | frozenset("pop_back lock unlock".split())
CONTAINERS = THEIRS | EITHER
#: Methods of unrelated classes, distinguished by the number of their arguments.
COUNTED = frozenset(("publish",))
#: Stands for an assignment to an element among the names of a block.
ELEMENT = "[]="
#: Decorators of methods that are called where their name is read, by the last part of their names.
PROPERTIES = frozenset(("property", "cached_property", "abstractproperty"))
#: Decorators of click and Typer that make commands, groups, and what runs before the commands of a group; methods that add one; and their modules.
GROUPING = frozenset(("command", "group", "callback"))
ADDING = frozenset(("add_command", "add_typer"))
MODULES = frozenset(("click", "rich_click", "typer"))
#: What an entry of a map is made of: who calls it calls what the map holds.
PAIR = frozenset(("first", "second"))
#: Stands for the call of a variable: what it holds may make something.
CALLED = "()"
#: Types of variables that can be called, and Python's expressions that may give a function.
FUNCTIONS = frozenset(("()", "boost::function", "std::function", "function"))
#: The method that a call of an object runs.
CALL = "operator()"
HELD = (
    syntax.Lambda,
    syntax.Name,
    syntax.Member,
    syntax.Call,
    syntax.Subscript,
    syntax.Conditional,
    syntax.Operation,
)
#: Base classes of Python that call none of what is overridden.
CALLING_NOTHING = frozenset(
    "object Exception Enum IntEnum ABC Node Thread TestCase NamedTuple dict list str int float".split()
)
#: Python's comprehensions, as the extraction writes them.
TURNS = (syntax.Name("[for]"), syntax.Name("[for in]"))
#: What wraps a reference to a variable.
REFERENCES = frozenset(("std::ref", "boost::ref", "ref", "std::addressof", "boost::addressof"))
#: What ``auto`` may take a function from.
GIVING = (syntax.Lambda, syntax.Name, syntax.Address, syntax.Call, syntax.Conditional, syntax.Subscript)


def called_in(item: Part, found: set[str], mentioned: set[str], given: set[str], source: Source) -> None:  # noqa: C901 - one branch for each form of a call
    """Collect what is called or constructed in *item*, what is mentioned in any other way, and what Python gives to a function by its name."""
    lambdas: set[int] = set()
    waiting = below((item,))
    while waiting:
        node = waiting.pop()
        if type(node) is syntax.Call:
            callee = node.callee
            if type(callee) is syntax.Name:
                found.add(last(callee.name))
                found.add("::".join(callee.name.split("::")[-2:]))
                if callee.name.endswith(("::make_shared", "::make_unique")):
                    found.add(callee.name.split("::")[-2])
            elif type(callee) is syntax.Member:
                found.add(_spelled(callee))
                if callee.name in PAIR and source.separator == "::":
                    found.add(CALLED)
                if callee.name in COUNTED:
                    found.add(f"{callee.name}/{len(node.arguments)}")
            elif type(callee) is syntax.Call or (type(callee) is syntax.Subscript and source.separator == "."):
                found.add(CALLED)
            elif type(callee) is syntax.Operation and callee.operator == ".*":
                found.add(CALLED)
            elif type(callee) is syntax.Subscript and (
                type(callee.object) is syntax.Name or type(callee.object) is syntax.Member
            ):
                found.add(last(callee.object.name))
            found.update(last(name) for kind in node.templates for name in type_names(kind))  # make_shared<T>()
            if source.separator == ".":
                for argument in node.arguments:
                    passed = argument.value if type(argument) is syntax.Keyword else argument
                    if type(passed) is syntax.Name:
                        # a class that is given may be made by whoever gets it
                        (found if passed.name[:1].isupper() else given).add(passed.name)
                    elif type(passed) is syntax.Member and type(passed.object) is syntax.This:
                        given.add(f".{passed.name}")
        elif type(node) is syntax.Assignment and type(node.target) is syntax.Subscript:
            found.add(ELEMENT)
        elif type(node) is syntax.New or type(node) is syntax.Variable:
            found.update(last(name) for name in type_names(node.type))
        elif (type(node) is syntax.Lambda or type(node) is syntax.NestedFunction) and node.function not in lambdas:
            lambdas.add(node.function)
            if 0 <= node.function < len(source.program.functions):
                waiting += below(source.program.functions[node.function].body)
        elif type(node) is syntax.Address and type(node.value) is syntax.Name:
            found.add(last(node.value.name))  # a pointer to a function is there to be called
        elif type(node) is syntax.Name or type(node) is syntax.Member:
            mentioned.add(last(node.name))
        waiting += below(node)


def _spelled(callee: syntax.Member) -> str:
    """How the call of a method looks: ``.name``, or ``name`` if it is one of the object itself or of a base, or puts something into a list."""
    name = callee.name.rpartition("::")[2]
    on = callee.object.callee if type(callee.object) is syntax.Call else callee.object
    is_own = type(on) is syntax.This or (type(on) is syntax.Name and on.name == "super")
    return callee.name if callee.name in COLLECTING else name if is_own and name in CONTAINERS else f".{name}"


def grouped(program: syntax.Program) -> list[tuple[str, str]]:
    """What of a Python file runs where a group of commands does: the name of the group, and of the function or class that is added to it."""
    found: list[tuple[str, str]] = []
    for function in program.functions:
        for decorator in function.decorators:
            callee = decorator.callee if type(decorator) is syntax.Call else decorator
            if type(callee) is syntax.Member and callee.name in GROUPING:
                found.append((syntax.name_of(callee.object), last(function.name)))
    if any(alias.type.name.partition(".")[0] in MODULES for alias in program.aliases):
        bodies = tuple(function.body or () for function in program.functions if function.kind == "module")
        found += [pair for node in everything(bodies) for pair in _added(node)]
    return found


def commands(index: Index) -> list[tuple[str, str]]:
    """What ``grouped`` finds in all files of Python, twice: so are the commands of groups that are in groups."""
    return [pair for source in index.by_place.values() for pair in grouped(source.program)] * 2


def _added(node: object) -> list[tuple[str, str]]:
    """The group and the command of a call that adds it."""
    callee = node.callee if type(node) is syntax.Call else None
    if type(node) is not syntax.Call or type(callee) is not syntax.Member or callee.name not in ADDING:
        return []
    return [(syntax.name_of(callee.object), syntax.name_of(item)) for item in node.arguments[:1]]


def may_be_called(kind: syntax.Type, source: Source, kinds: frozenset[str] = FUNCTIONS) -> bool:
    """Whether a parameter of the type may be a function, which those of *kinds* are; Python does not say."""
    return kind.name in kinds or kind.name == "auto" or (kind.name == "" and source.program.language == "python")


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


def properties(index: Index) -> frozenset[str]:
    """The last names of methods of Python that are called where their name is read."""
    return frozenset(
        last(function.name)
        for source in index.by_place.values()
        for function in source.program.functions
        if any(syntax.name_of(decorator) in PROPERTIES for decorator in function.decorators)
    )


def overriding(source: Source, class_: syntax.Class, known: Container[str]) -> list[str]:
    """The methods of a Python class that a base may call which is not among the *known* names, as calls of them look."""
    bases = {last(base.name) for base in class_.bases} - CALLING_NOTHING
    if source.separator != "." or all(base in known and base != last(class_.name) for base in bases):
        return []
    return [f".{last(function.name)}" for function in source.program.functions if function.owner == class_.name]


def members_of(index: Index, kinds: frozenset[str]) -> frozenset[str]:
    """The names of C++ members of one of these types."""
    return frozenset(
        field.name
        for classes in index.classes.values()
        for source, definition in classes
        for field in definition.fields
        if source.separator == "::" and any(last(name) in kinds for name in type_names(field.type))
    )


def shared(index: Index) -> frozenset[str]:
    """The last parts of the names of all global variables, module variables and static members."""
    return frozenset(
        [last(name) for name, found in index.variables.items() if any("c" not in v.type.marks for _, v in found)]
        + [
            f.name
            for found in index.classes.values()
            for _, c in found
            for f in c.fields
            if f.is_static and "c" not in f.type.marks
        ]
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
    attributes, methods = set[str](), set[str]()
    for functions in index.functions.values():
        for source, function in functions:
            if source.separator == ".":
                methods.add(last(function.name))
                if function.owner and function.body is not None:
                    _attributes(function.body, attributes)
    return frozenset(found | (attributes - methods - CONTAINERS))


def _attributes(block: Part, found: set[str]) -> None:
    """Collect the attributes that Python code may keep a function in."""
    for node in everything(block):
        if type(node) is syntax.Assignment and type(node.target) is syntax.Member and isinstance(node.value, HELD):
            found.add(node.target.name)


def callable_variables(block: Part, names: set[str], source: Source, kinds: frozenset[str]) -> None:
    """Collect the local variables of *block* that a function, lambda or class is assigned to, or of one of *kinds*."""
    python = source.program.language == "python"
    for node in everything(block):
        if type(node) is syntax.Variable:
            value = node.init.value if type(node.init) is syntax.Equals else None
            if (
                may_be_called(node.type, source)
                or any(last(name) in kinds for name in type_names(node.type))
                or type(value) is syntax.Lambda
            ):
                if node.type.name != "auto" or isinstance(value, GIVING):
                    names.add(node.name)
        elif type(node) is syntax.Assignment:
            if python and type(node.target) is syntax.Name and isinstance(node.value, HELD):
                names.add(node.target.name)
            elif python and type(node.target) is syntax.ListLiteral:
                names.update(item.name for item in everything((node.target,)) if type(item) is syntax.Name)
        elif type(node) is syntax.Each and may_be_called(node.type, source):
            names.add(node.name)
        elif python and type(node) is syntax.Call and node.callee in TURNS:
            for item in node.arguments:  # the elements of a comprehension
                function = source.program.functions[item.function] if type(item) is syntax.Lambda else None
                if function is not None and function.body is not None:
                    names.update(parameter.name for parameter in function.parameters)
                    callable_variables(function.body, names, source, kinds)


def type_names(kind: syntax.Argument) -> Iterable[str]:
    if type(kind) is syntax.Type:
        yield kind.name
        for inner in kind.arguments:
            yield from type_names(inner)


@cache
def last(name: str) -> str:
    """The last part of a qualified name; asked for the same names again and again."""
    return name.rpartition("::")[2].rpartition(".")[2]
