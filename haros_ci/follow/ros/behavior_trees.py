# SPDX-License-Identifier: Apache-2.0
"""BehaviorTree.CPP: factories that register node types, the trees that they create, blackboards (behaviortree.dev).

A tree's nodes are constructed when it is created, each by what is registered for its tag, and ticked later.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import activation
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import behavior_tree_nodes, behavior_tree_ports
from haros_ci.follow.ros.behavior_tree_ports import text_of
from haros_ci.follow.walk import Walk
from haros_ci.index.behavior_tree_files import BUILT_IN, CREATING, LOADING, READING, REGISTERING, BehaviorTreeFile, Tag
from haros_ci.index.trace import XML_FILES
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import NONE, TRUE, Callable, Cell, Choice, Known, Object, Opaque, Text, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: How the library's names begin, and its classes.
SPACE = "BT::"
FACTORY, BLACKBOARD, TREE = "BT::BehaviorTreeFactory", "BT::Blackboard", "BT::Tree"
#: Fields of a factory: that plug-ins are loaded of which the library is not known; the trees that are read. All others
#: are what is registered, by ID.
OPEN, READ = "(open)", "(read) "
#: Why it is not known whether what the nodes of a tree make is made.
ANY = "which behaviour tree is created, of which plug-ins, is a matter of parameters"
UNKNOWN = "a behaviour tree is created that is not known, nor what its nodes make"


def call(
    walk: Walk,
    frame: Frame,
    name: str,
    receiver: Value | None,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """What a function or method of the library does and gives; None if there is no model of it."""
    owner, _, last = name.rpartition("::")
    if not isinstance(receiver, Object):
        return Object(BLACKBOARD, location=location) if name == f"{BLACKBOARD}::create" else None
    if owner == FACTORY:
        return _factory(walk, frame, receiver, last, args, targs, location)
    if owner == BLACKBOARD:
        return _blackboard(walk, frame, receiver, last, args, targs)
    return behavior_tree_ports.call(walk, frame, receiver, last, args, location)


def _factory(
    walk: Walk,
    frame: Frame,
    factory: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    if name in REGISTERING and args:
        types = tuple(walk.type_in(targ, frame) for targ in targs if type(targ) is syntax.Type)
        _register(walk, factory, name, args, types)
        return NONE
    if name in LOADING:
        _load(walk, factory, args[0].value if name == "registerFromPlugin" and args else None)
        return NONE
    if name in READING and args:
        _read(factory, args[0].value, name.endswith("Text"))
        return NONE
    if name in CREATING and args:
        if not walk.quiet:
            _create(walk, frame, factory, name, args, location)
        return Object(TREE, location=location)
    return None


def _register(
    walk: Walk, factory: Object, name: str, args: tuple[PassedArgument, ...], types: tuple[Type, ...]
) -> None:
    """Keep the type of a node, or what builds it, and further arguments of its constructor by the ID of its tags."""
    name_of_tags = text_of(args[0].value)
    if name_of_tags is None:
        factory.fields[OPEN] = Cell(TRUE)
        return
    held = {str(number): Cell(argument.value) for number, argument in enumerate(args[1:])}
    made = Object(name, types, fields=held)
    key, number = name_of_tags, 0
    while key in factory.fields:
        if _is_same(factory.fields[key].value, made):
            return
        number += 1
        key = f"{name_of_tags}\n{number}"  # on another way, or by another library
    factory.fields[key] = Cell(made)


def _is_same(one: Value, other: Object) -> bool:
    """Whether two registrations are of the same type, built by the same function."""
    if not isinstance(one, Object) or (one.name, one.arguments) != (other.name, other.arguments):
        return False
    first, second = (object_.fields["0"].value if "0" in object_.fields else None for object_ in (one, other))
    if isinstance(first, Callable) and isinstance(second, Callable):
        return first.function is second.function
    return isinstance(first, Callable) == isinstance(second, Callable)


def _load(walk: Walk, factory: Object, library: Value | None) -> None:
    """Register what a plug-in's library has; one that is not known stands for all of the workspace."""
    if isinstance(library, Choice):
        for option in library.options:
            _load(walk, factory, option)
        return
    name = text_of(library)
    if not name:  # the empty text is that of a parameter which is not set here
        factory.fields[OPEN] = Cell(TRUE)
    else:
        registered_by(walk, factory, name)


def registered_by(walk: Walk, factory: Object, library: str | None) -> None:
    """Follow what registers the nodes of a library, or of all libraries of the workspace, with *factory*."""
    trees = walk.context.trees
    if walk.index.trace is not None and library is not None:
        walk.index.trace.is_whole = False  # what a library is built of
    for source, function in trees.registered(library) if trees is not None else ():
        inner = Frame(source, "", function, mark=walk.state.mark())
        for parameter in function.parameters[:1]:  # the macro's argument is the factory's name
            inner.declare(parameter.name or parameter.type.name, Cell(factory, syntax.Type(FACTORY, (), "&")))
        activation.follow_body(walk, inner, function)


def _read(factory: Object, value: Value, is_text: bool) -> None:
    text = text_of(value)
    if text is not None:
        text = f"\n{text}" if is_text else text
        factory.fields.setdefault(f"{READ}{text}", Cell(Known(text)))


def _create(
    walk: Walk, frame: Frame, factory: Object, name: str, args: tuple[PassedArgument, ...], location: Location
) -> None:
    """Construct the nodes of a tree, once at each place for each blackboard."""
    provided = (argument.value for argument in args if isinstance(argument.value, Object))
    board = next((object_ for object_ in provided if object_.name == BLACKBOARD), None)
    done = (location, factory, board, text_of(args[0].value))
    if done in walk.offered:
        return
    walk.offered.add(done)
    if walk.index.trace is not None:
        walk.index.trace.paths.add(XML_FILES)
    board = board if board is not None else Object(BLACKBOARD, location=location)
    tags, is_whole = _tags(walk, factory, name, args[0].value)
    if OPEN in factory.fields:
        factory = Object(FACTORY, fields=dict(factory.fields))
        registered_by(walk, factory, None)
        for elsewhere in sorted({tag.type for tag in tags} - factory.fields.keys() - BUILT_IN):
            walk.gaps.setdefault(f"the node {elsewhere[:200]} of a behaviour tree is not in the workspace", location)
    behavior_tree_nodes.construct_all(walk, frame, factory, board, tags, location)
    if is_whole:
        return
    walk.gaps.setdefault(UNKNOWN, location)
    if walk.context.any_tree and walk.context.trees is not None:
        walk.gaps.setdefault(ANY, location)
        every = [tag for trees in walk.context.trees.every() for found in trees.tags.values() for tag in found]
        known = frozenset(tags)
        others = tuple(tag for tag in every if tag not in known)
        with walk.doubted(ANY):
            behavior_tree_nodes.construct_all(walk, frame, factory, board, others, location)
            behavior_tree_nodes.construct_others(walk, frame, factory, board, (*tags, *every), location)


def _tags(walk: Walk, factory: Object, name: str, value: Value) -> tuple[tuple[Tag, ...], bool]:
    """The nodes of the tree that is created, as far as they are known; and whether these are all."""
    files, message = walk.context.trees, text_of(value)
    if files is None or message is None:
        return (), False
    every = [files.read(key[len(READ) :]) for key in factory.fields if key.startswith(READ)]
    before = [trees for trees in every if trees is not None]
    if name == "createTree":
        return BehaviorTreeFile({}, message, {}).beside(before).of(message)
    found = files.read(f"\n{message}" if name == "createTreeFromText" else message)
    return found.beside(before).of(found.main) if found is not None else ((), False)


def _blackboard(
    walk: Walk,
    frame: Frame,
    board: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
) -> Value | None:
    """``set`` and ``get`` of an entry by its key; of one that is not known nothing is."""
    if name == "rootBlackboard":
        return board
    if name not in ("get", "set") or not args:
        return None
    key = text_of(args[0].value)
    cell = board.fields.get(key) if key is not None else None
    if name == "set" and len(args) == 2:
        if key is None:
            for field in board.fields.values():
                if isinstance(field.value, (Known, Text, Choice)):
                    walk.state.write(field, Opaque("it may be set under a key that is not known"))
            return NONE
        if cell is None:
            cell = board.fields[key] = Cell(Opaque(f"the blackboard's {key} is not set before"))
        walk.state.write(cell, args[1].value)
        return NONE
    kind = walk.type_in(targs[0], frame) if targs and type(targs[0]) is syntax.Type else None
    message = f"the blackboard's {key or 'entry of a key that is not known'} is not known"
    value = cell.value if cell is not None else walk.opaque(message, frame, None, kind)
    return value if len(args) == 1 else behavior_tree_ports.stored(walk, frame, args[1], value)
