# SPDX-License-Identifier: Apache-2.0
"""What a node of a behaviour tree asks for: its configuration, its ports as its tag and its class have them.

A port is what the attribute of its tag says, else the default of ``providedPorts``; ``{key}`` is an entry of the
blackboard, which other nodes may set at any time (TreeNode::getInput).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, expressions, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.index.types import INTEGERS, REALS, STRINGS
from haros_ci.model.location import Location
from haros_ci.syntax import Expression, Function, Type
from haros_ci.syntax.walk import Part, below
from haros_ci.values.abstract import FALSE, NONE, TRUE, Cell, Known, Object, Opaque, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument
    from haros_ci.index.index import Source

#: The type of a node's configuration, what its field is called in the node; how the fields of it begin that are ports.
CONFIG = "BT::NodeConfig"
CONFIGS = frozenset((CONFIG, "BT::NodeConfiguration"))
HELD = "(behaviour tree)"
PORT = "(port) "
#: The field of a configuration that no tree tells.
UNTOLD = "(untold)"
EXPECTED = "BT::Expected"
#: Functions that declare ports; those with three arguments give a default.
DECLARING = frozenset(("InputPort", "BidirectionalPort", "OutputPort"))
#: How booleans are written.
WORDS = dict.fromkeys(("true", "TRUE", "True", "1"), True)
WORDS |= dict.fromkeys(("false", "FALSE", "False", "0"), False)
#: Functions inside functions that declare ports.
DEEPEST = 8


def text_of(value: Value | None) -> str | None:
    """*value*, if it is a text that is known."""
    return value.of(str) if isinstance(value, Known) and issubclass(value.kind, str) else None


def configured(this: Object, args: tuple[PassedArgument, ...]) -> None:
    """A base class of the library is constructed: it keeps the configuration."""
    for argument in args:
        if isinstance(argument.value, Object) and argument.value.name in CONFIGS:
            this.fields[HELD] = Cell(argument.value)


def call(
    walk: Walk, frame: Frame, node: Object, name: str, args: tuple[PassedArgument, ...], location: Location
) -> Value | None:
    """What a method of a tree's node does and gives; None if there is no model of it."""
    held = node.fields.get(HELD)
    config = held.value if held is not None else None
    if node.name == EXPECTED and name in ("value", "has_value"):
        return node.fields["(value)"].value if name == "value" else TRUE
    if not isinstance(config, Object):
        return None
    if name == "config" and not args:
        return config
    if name == "name" and not args:
        return config.fields["name"].value
    if name == "getInput" and args:
        found = _input(walk, frame, node, config, args[0].value)
        if len(args) > 1:
            cell = _target(args[1])
            if found is None and UNTOLD in config.fields and cell is not None and cell.value == Known(""):
                message = "no behaviour tree of the workspace has the node: its ports are not known"
                walk.state.write(cell, walk.opaque(message, frame, location.line, cell.type))
            return stored(walk, frame, args[1], found)
        if found is None or isinstance(found, Opaque):
            return NONE if found is None else found
        return Object(EXPECTED, fields={"(value)": Cell(found)})
    if name == "setOutput" and len(args) == 2:
        _output(walk, frame, config, args[0].value)
        return walk.opaque("whether an output is set", frame, location.line)
    return None


def stored(walk: Walk, frame: Frame, target: PassedArgument, value: Value | None) -> Value:
    """Write what a port or entry gives through a reference, and say whether there is anything; None leaves it alone."""
    if value is None:
        return FALSE
    cell = _target(target)
    if cell is not None:
        value = _read_as(walk, frame, value, cell.type)
        walk.state.write(cell, value)
    return walk.opaque("whether it is set", frame) if isinstance(value, Opaque) else TRUE


def _target(target: PassedArgument) -> Cell | None:
    return target.value.cell if isinstance(target.value, Pointer) else target.cell


def _read_as(walk: Walk, frame: Frame, value: Value, kind: Type | None) -> Value:
    """*value*, where it is a text, as BT::convertFromString reads it as a *kind*."""
    if not isinstance(value, Known) or not issubclass(value.kind, str) or kind is None:
        return conversions.converted(value, kind)
    if kind.name in STRINGS or kind.name in ("", "auto"):
        return value
    try:
        if kind.name == "bool":
            return Known(WORDS[value.of(str)])
        if kind.name in INTEGERS:
            return conversions.converted(Known(int(value.of(str))), kind)
        if kind.name in REALS:
            return Known(float(value.of(str)))
    except (ValueError, KeyError):
        pass
    return walk.opaque("it is read from a port's text", frame, None, kind)


def _input(walk: Walk, frame: Frame, node: Object, config: Object, port: Value) -> Value | None:
    """What a port gives; None if there is none of that name, or nothing in it."""
    name = text_of(port)
    if name is None:
        return walk.opaque("the port's name is not known", frame)
    argument_value = config.fields.get(f"{PORT}{name}")
    value = argument_value.value if argument_value is not None else _default(walk, frame, node, name)
    text = (text_of(value) or "").strip()
    if text.startswith("{") and text.endswith("}"):
        return walk.opaque(f"the blackboard's {text[1:-1]} is not known", frame)
    return value


def _output(walk: Walk, frame: Frame, config: Object, port: Value) -> None:
    """An output changes the entry that its port names."""
    value = config.fields.get(f"{PORT}{text_of(port)}")
    board = config.fields["blackboard"].value
    key = text_of(value.value) if value is not None else None
    cell = board.fields.get(key.strip("{} ")) if key is not None and isinstance(board, Object) else None
    if cell is not None:
        walk.state.write(cell, walk.opaque("a node of the tree sets it", frame))


def _default(walk: Walk, frame: Frame, node: Object, name: str) -> Value | None:
    """The default of a port that the tag does not have."""
    if node.definition is None:
        return None
    declared, is_all = _declared(walk, node)
    if name not in declared:
        return None if is_all else walk.opaque("the node's ports are not known", frame)
    default = declared[name]
    return expressions.evaluate(walk, default[0], default[1]) if default is not None else None


Ports = dict[str, tuple[Frame, Expression] | None]


def _declared(walk: Walk, node: Object) -> tuple[Ports, bool]:
    """The ports that a class's ``providedPorts`` declares by name, with their defaults; and whether these are all."""
    assert node.definition is not None
    key = id(node.definition[1])
    if key not in walk.ports:
        ports: Ports = {}
        source, definition = node.definition
        found = methods.class_method(walk, source, definition, "providedPorts")
        is_all = found is None or all([*_declare(walk, ports, *found, node, 0)])
        walk.ports[key] = (ports, is_all, node.definition[1])  # which keeps the identity from being used again
    return walk.ports[key][:2]


def _declare(walk: Walk, ports: Ports, source: Source, function: Function, node: Object, depth: int) -> Iterator[bool]:
    """Put what a function declares among *ports*; for each call in it, whether it is understood."""
    frame = Frame(source, function.owner, function, None, templates=node.templates)
    yield function.body is not None and depth < DEEPEST
    for callee, args in _calls(function.body):
        last = callee.rpartition("::")[2]
        if last in DECLARING:
            text = args[0] if args else None
            yield type(text) is syntax.String
            if type(text) is syntax.String:
                ports[text.value] = (frame, args[1]) if len(args) == 3 and last != "OutputPort" else None
        elif last.startswith("provided") and depth < DEEPEST:
            head = callee.rpartition("::")[0]
            owner = walk.class_of(walk.type_in(syntax.Type(head), frame).name, source) if head else node.definition
            found = methods.class_method(walk, owner[0], owner[1], last) if owner is not None else None
            yield found is not None
            if found is not None and found[1] is not function:
                yield from _declare(walk, ports, *found, node, depth + 1)
        elif last[:1].islower() and last not in ("insert", "begin", "end", "move", "merge", "emplace"):
            yield False


def _calls(block: Part) -> Iterator[tuple[str, tuple[Expression, ...]]]:
    """The calls in a block by the names of what they call, with their arguments."""
    waiting = below((block,))[::-1]
    while waiting:
        node = waiting.pop()
        if type(node) is syntax.Call:
            name = node.callee.text if type(node.callee) is syntax.Unknown else syntax.name_of(node.callee)
            yield name, node.arguments
            if name.rpartition("::")[2] in DECLARING:
                continue
        waiting += reversed(below(node))
