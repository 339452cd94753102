# SPDX-License-Identifier: Apache-2.0
"""Python classes without a constructor of their own that take arguments: these are their annotated fields (docs.python.org/3/library/dataclasses.html)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, expressions, linear, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.syntax import Class, Field
from haros_ci.values.abstract import Cell, Object, Opaque, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: Bases that leave the fields to the class (docs.python.org/3/library/typing.html).
PLAIN = frozenset(("object", "typing.NamedTuple", "typing.Generic", "typing.Protocol", "abc.ABC"))
#: The last parts of the names of functions that declare a field.
FIELD = ("field", "ib", "attrib")
#: Why a field is not known.
OTHER = "the constructor of its class is not known"


def construct(walk: Walk, frame: Frame, this: Object, args: tuple[PassedArgument, ...]) -> None:
    """Set the fields of *this* to *args*, or as their ``field(…)`` says, and call ``__post_init__``."""
    assert this.definition is not None
    source, definition = this.definition
    fields = _fields(walk, source, definition)
    if not fields:
        return
    is_other = any(base not in PLAIN for base in methods.library_bases(walk, source, definition))
    if is_other or methods.method_of(walk, this, "__new__") is not None:
        fields = {name: fields[name] for argument in args if (name := argument.keyword) and name in fields}
        args = tuple(argument for argument in args if argument.keyword)
    _set(walk, this, fields, args)
    after = methods.method_of(walk, this, "__post_init__")
    if after is not None:
        activation.invoke(walk, frame, after, ())


def _set(walk: Walk, this: Object, fields: dict[str, tuple[Source, Field]], args: tuple[PassedArgument, ...]) -> None:
    named = {argument.keyword: argument.value for argument in args if argument.keyword}
    rest = [argument.value for argument in args if not argument.keyword]
    is_known = not rest or all(field.type.name for _, field in fields.values())
    for name, (where, field) in fields.items():
        # where that is not known, which of them are fields is not
        value = _first_of(walk, where, _options(where, field), named.get(name), rest) if is_known else Opaque(OTHER)
        if is_known and not named.keys().isdisjoint(("*", "**")):
            value = named.get(name) or Opaque(call_arguments.UNPACKED)
        if value is not None:
            this.fields[name] = Cell(value)


def _first_of(
    walk: Walk, where: Source, options: dict[str, syntax.Expression], named: Value | None, rest: list[Value]
) -> Value | None:
    """What a field begins with: one of the *rest* of the arguments, that of its name, or what its declaration says."""
    if options.get("init") == syntax.Boolean(False):
        return _default(walk, where, options)
    if rest:
        return rest.pop(0)
    return named or _default(walk, where, options)


def _fields(walk: Walk, source: Source, definition: Class) -> dict[str, tuple[Source, Field]]:
    """The annotated fields of a class, those of its bases first."""
    found: dict[str, tuple[Source, Field]] = {}
    for where, known in reversed([*linear.of_workspace(linear.order(walk, source, definition))]):
        for field in known.fields:
            if not field.type.name.endswith("ClassVar"):
                found[field.name] = (where, field)
    return found


def _options(source: Source, field: Field) -> dict[str, syntax.Expression]:
    """The keyword arguments of a field that is declared by ``field(…)``."""
    value = field.init.value if type(field.init) is syntax.Equals else None
    if type(value) is not syntax.Call or syntax.name_of(value.callee).rpartition(".")[2] not in FIELD:
        return {}
    return {argument.name: argument.value for argument in value.arguments if type(argument) is syntax.Keyword}


def _default(walk: Walk, source: Source, options: dict[str, syntax.Expression]) -> Value | None:
    """What ``field(default=…)`` or ``field(default_factory=…)`` begins with; None for a field that is not declared so."""
    inner = Frame(source, "")
    if "default" in options:
        return expressions.evaluate(walk, inner, options["default"])
    factory = options.get("default_factory", options.get("factory"))
    return expressions.evaluate(walk, inner, syntax.Call(factory, (), (), 0, 0)) if factory is not None else None
