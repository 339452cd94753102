# SPDX-License-Identifier: Apache-2.0
"""The nodes of a behaviour tree: each is constructed as its tag's ID is registered, and its tick is called back."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci import syntax
from haros_ci.follow import activation, call_arguments, calls, construct, inert, methods
from haros_ci.follow.frames import Frame
from haros_ci.follow.made import Key, MadeEntity, Root
from haros_ci.follow.ros import behavior_tree_ports
from haros_ci.follow.walk import Walk
from haros_ci.index.behavior_tree_files import Tag
from haros_ci.model.location import Location
from haros_ci.values.abstract import TRUE, Callable, Cell, Known, Object, Opaque, Value

#: What the tree calls of a node, whatever its kind (behaviortree.dev/docs/tutorial-basics/tutorial_04_sequence).
TICKS = ("tick", "onStart", "onRunning", "onHalted")
#: Why it is not known whether a node is made.
SEVERAL = "one of several types of nodes of that name is registered"
#: Nodes of one ID, distinguished by their ports.
MOST = 12
#: Kinds of what is no communication.
PARAMETERS = frozenset(("getters", "setters", "parameters"))


def construct_all(
    walk: Walk, frame: Frame, factory: Object, board: Object, tags: tuple[Tag, ...], location: Location
) -> None:
    """Construct the nodes of *tags*, those of the same ID and ports once."""
    steps = walk.steps
    by_type: dict[str, list[Tag]] = {}
    for tag in tags:
        by_type.setdefault(tag.type, []).append(tag)
    for registered, name in _registered(walk, factory):
        for ports, own in _with_common_parts(name, by_type.get(name, [])):
            fields: dict[str, Cell] = {"blackboard": Cell(board), "name": Cell(own), **ports}
            _construct(walk, frame, registered, Object(behavior_tree_ports.CONFIG, fields=fields), location)
    walk.aside += walk.steps - steps


def construct_others(
    walk: Walk, frame: Frame, factory: Object, board: Object, tags: Iterable[Tag], location: Location
) -> None:
    """Construct the nodes that are registered and are not of *tags*.

    They have the defaults of their ports; where nothing is made of these, what ports say is not known.
    """
    steps = walk.steps
    known = {tag.type for tag in tags}
    for registered, name in _registered(walk, factory):
        if name not in known:
            before = dict(walk.made)
            fields: dict[str, Cell] = {"blackboard": Cell(board), "name": Cell(Known(name))}
            _construct(walk, frame, registered, Object(behavior_tree_ports.CONFIG, fields=fields), location)
            if not _makes_ends(walk, before):
                fields = {**fields, behavior_tree_ports.UNTOLD: Cell(TRUE)}
                _construct(walk, frame, registered, Object(behavior_tree_ports.CONFIG, fields=fields), location)
    walk.aside += walk.steps - steps


def _registered(walk: Walk, factory: Object) -> Iterator[tuple[Object, str]]:
    """What is registered, and the ID of its tags; if there are several of one ID, with a doubt."""
    for key, cell in list(factory.fields.items()):
        registered, name = cell.value, key.partition("\n")[0]
        if isinstance(registered, Object):
            with walk.doubted(SEVERAL if name != key or f"{name}\n1" in factory.fields else None):
                yield registered, name


def _makes_ends(walk: Walk, before: Mapping[Key, MadeEntity]) -> bool:
    """Whether an endpoint but parameters was made since, also one that was known before."""
    new = (made for key, made in walk.made.items() if before.get(key) is not made)
    return any(made.kind not in PARAMETERS for made in new)


def _with_common_parts(name: str, tags: list[Tag]) -> list[tuple[dict[str, Cell], Value]]:
    """The ports and the name of each node; of too many what they do not have in common is not known."""
    names: dict[tuple[tuple[str, str], ...], dict[str, None]] = {}
    for tag in tags:
        names.setdefault(tuple(sorted(tag.ports)), {})[tag.name or name] = None
    prefix = behavior_tree_ports.PORT
    if len(names) > MOST:
        every = {port for ports in names for port, _ in ports}
        values = {port: {dict(ports).get(port) for ports in names} for port in sorted(every)}
        several = Opaque("nodes of a behaviour tree have different ports")
        ports: dict[str, Cell] = {
            f"{prefix}{port}": Cell(several if len(found) > 1 else Known(found.pop())) for port, found in values.items()
        }
        return [(ports, Opaque("it is one of several nodes of a behaviour tree"))]
    return [
        (
            {f"{prefix}{port}": Cell(Known(text)) for port, text in ports},
            Known(next(iter(own))) if len(own) == 1 else Opaque("it is one of several nodes of a behaviour tree"),
        )
        for ports, own in names.items()
    ]


def _construct(walk: Walk, frame: Frame, registered: Object, config: Object, location: Location) -> None:
    walk.step()
    name = call_arguments.PassedArgument(config.fields["name"].value, None, syntax.Type("std::string"))
    argument = call_arguments.PassedArgument(config, None, syntax.Type(config.name))
    built: Value | None = None
    if registered.name == "registerNodeType" and registered.arguments:
        more = (call_arguments.PassedArgument(cell.value) for cell in registered.fields.values())
        kind = registered.arguments[0]
        if type(kind) is syntax.Type:
            built = construct.create(walk, frame, kind.bare(), (name, argument, *more), location)
    elif "0" in registered.fields:
        builder = registered.fields["0"].value
        if registered.name != "registerBuilder":  # a function is what is ticked
            _tick(walk, builder)
        elif isinstance(builder, Callable):
            built = _built(walk, frame, builder, (name, argument))
        else:
            built = calls.apply(walk, frame, builder, (name, argument), (), location, syntax.Unknown("a builder"))
    if not isinstance(built, Object) or built.definition is None:
        return
    built.fields.setdefault(behavior_tree_ports.HELD, Cell(config))
    for tick in TICKS:
        method = methods.method_of(walk, built, tick)
        if method is not None and inert.may_make(walk, method, ()):
            _tick(walk, method)


def _tick(walk: Walk, function: Value) -> None:
    if isinstance(function, Callable):
        doubt = walk.doubts[-1] if walk.doubts else None
        walk.roots.append(Root(function, tuple(walk.conditions), is_tick=True, doubt=doubt))


def _built(walk: Walk, frame: Frame, builder: Callable, args: tuple[call_arguments.PassedArgument, ...]) -> Value:
    """What a builder returns, also where its node makes nothing before it is ticked."""
    definition = builder.function
    scope = definition.owner or definition.name.rpartition("::")[0]
    inner = Frame(
        builder.source,
        scope,
        definition,
        builder.this,
        templates=builder.templates,
        outer=builder.frame if isinstance(builder.frame, Frame) else None,
        mark=walk.state.mark(),
    )
    activation.bind(walk, frame, inner, definition, args)
    return activation.follow_body(walk, inner, definition)
