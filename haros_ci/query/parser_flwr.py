# SPDX-License-Identifier: Apache-2.0
"""The part of the grammar with clauses: for, let, where, order by, return, collect."""

from __future__ import annotations

from haros_ci.query.fault import QueryError
from haros_ci.query.parser import QueryReader
from haros_ci.query.syntax import Collect, Flwr, For, Let, Order, ReturnedValue, Tree

#: Variables of one ``for``.
MOST_VARIABLES = 12


def braced(reader: QueryReader) -> Tree:
    """``{for ... return ...}``."""
    reader.take("{")
    tree = reader.nested(lambda: flwr(reader))
    reader.take("}")
    return tree


def flwr(reader: QueryReader) -> Flwr:
    """for, let, where, order by, and what it gives."""
    at = reader.token.at
    fors = _fors(reader) if reader.skip("for") else ()
    lets: list[Let] = []
    while reader.skip("let"):
        lets.append(_let(reader))
        while reader.skip(","):
            lets.append(_let(reader))
    where = reader.condition() if reader.skip("where") else None
    order = _order(reader) if reader.kind == "order" else None
    output, flatten, collects = None, False, []
    if reader.skip("return"):
        flatten = reader.skip("flatten")
        output = ReturnedValue((reader.value_or_query(),)) if flatten else _output(reader)
    else:
        while reader.kind == "collect":
            collects.append(_collect(reader))
        if not collects:
            raise reader.unexpected("return or collect")
    if order is not None and output is not None:
        _check(order, output)
    return Flwr(fors, tuple(lets), where, order, output, flatten, tuple(collects), at)


def _fors(reader: QueryReader) -> tuple[For, ...]:
    found: list[For] = []
    while True:
        name = reader.take("name", "the name of a variable")
        if name.text in [one.name for one in found]:
            raise QueryError(f"{name.text} stands twice in one for", name.at)
        reader.take("in")
        source = reader.value_or_query() if reader.kind in ("<", "{") else reader.atom()
        found.append(For(name.text, source, name.at))
        if not reader.skip(","):
            break
    if len(found) > MOST_VARIABLES:
        raise QueryError(f"more than {MOST_VARIABLES} variables in one for", found[0].at)
    return tuple(found)


def _let(reader: QueryReader) -> Let:
    name = reader.take("name", "the name of a variable")
    reader.take("=")
    value = reader.function() if reader.kind == "function" else reader.value_or_query()
    return Let(name.text, value, name.at)


def _order(reader: QueryReader) -> Order:
    at = reader.take("order").at
    reader.take("by")
    token = reader.token
    if token.kind not in ("number", "text") or isinstance(token.value, float) or token.value is None:
        raise reader.unexpected("the number or the quoted name of what is returned")
    reader.number += 1
    if reader.kind not in ("ascd", "desc"):
        raise reader.unexpected("ascd or desc")
    descending = reader.kind == "desc"
    reader.number += 1
    return Order(token.value, descending, at)


def _check(order: Order, output: ReturnedValue) -> None:
    """Named output is ordered by a name, positional by a number."""
    if isinstance(order.key, str):
        if not output.names:
            raise QueryError("order by a name needs names in return", order.at, "write return 'name': value")
        if order.key not in output.names:
            raise QueryError(f"return gives nothing called {order.key!r}", order.at)
    elif output.names:
        raise QueryError("order by a number needs return without names", order.at, "write order by 'name'")
    elif order.key >= len(output.values) > 1:
        raise QueryError(f"return gives {len(output.values)} values, the first is number 0", order.at)


def _output(reader: QueryReader) -> ReturnedValue:
    names, values = [], []
    while True:
        if reader.kind == "text" and reader.next_kind() == ":":
            names.append(str(reader.token.value))
            reader.number += 2
        elif names:
            raise reader.unexpected("'name': value, as before")
        values.append(reader.value_or_query())
        if len(names) not in (0, len(values)):
            raise reader.unexpected("values without names, as before")
        if not reader.skip(","):
            return ReturnedValue(tuple(values), tuple(names))


def _collect(reader: QueryReader) -> Collect:
    at = reader.take("collect").at
    output = _output(reader)
    reader.take("as")
    key = reader.arithmetic()
    reader.take("with")
    reducer = reader.function() if reader.kind == "function" else reader.chain()
    return Collect(output, key, reducer, at)
