# SPDX-License-Identifier: Apache-2.0
"""One node from its entry: initialisation first, then everything that is called back, until nothing new turns up."""

from __future__ import annotations

from collections.abc import Callable as Function_
from dataclasses import replace
from functools import partial

from haros_ci import syntax
from haros_ci.follow import (
    activation,
    alternatives,
    call_arguments,
    callbacks,
    chains,
    commands,
    construct,
    counters,
    cut_short,
    disturbances,
    inert,
    initialised,
    python_names,
    uncalled,
)
from haros_ci.follow.frames import Frame
from haros_ci.follow.made import Root, forget_again, forget_unowned, is_set_in_time, not_ruled_out
from haros_ci.follow.ros import outside_nodes, registration, ros2_nodes
from haros_ci.follow.walk import ROOTS, OutOfSteps, Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.records import dataclass
from haros_ci.syntax import Class, Function
from haros_ci.values.abstract import (
    Callable,
    Cell,
    Known,
    Object,
    Opaque,
    Sequence,
    Value,
    tick,
)
from haros_ci.values.effects import Effects
from haros_ci.values.state import Writes


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """Where a node begins: a function (``main``), a class that a framework loads, or a Python module.

    *is_hosted* is a plug-in on the node of the program that loads it, which constructs it without options. *begin* is how
    what is made by others is made in their place; *label* distinguishes these.
    """

    source: Source
    function: Function | None = None
    definition: Class | None = None
    is_hosted: bool = False
    begin: Function_[[Walk, Frame], None] | None = None
    label: str = ""
    #: ``package/name`` of the target, where several compile the same file with other macros.
    target: str = ""
    #: What the template parameters of the class stand for, in their order.
    arguments: tuple[syntax.Argument, ...] = ()

    @property
    def key(self) -> tuple[str, str, str]:
        """The file and the names of the function and class: the same in the next run."""
        function = self.function.name if self.function is not None else self.label
        function = f"{function}@{self.target}" if self.target else function
        class_name = self.definition.name if self.definition is not None else ""
        return self.source.path, function, f"{class_name}{repr(self.arguments) if self.arguments else ''}"


def follow(walk: Walk, entry: Entry) -> bool:
    """Follow the node; what it makes is in ``run.made``. False if it is larger than the budget."""
    frame = Frame(entry.source, "")
    walk.is_program = entry.begin is None
    try:
        _start(walk, frame, entry)
        _call_back(walk, frame)
        cut_short.reopen(walk)
    except OutOfSteps:
        return False
    finally:
        forget_unowned(walk)
        outside_nodes.without_node(walk)
    if walk.context.process is None:
        is_set_in_time(walk)
        registration.forget_unregistered(walk, entry.source)
    return True


def _start(walk: Walk, frame: Frame, entry: Entry) -> None:
    walk.entry = entry.function
    if entry.source.separator == "::":
        initialised.before_main(walk)
    if entry.begin is not None:
        entry.begin(walk, frame)
    elif entry.definition is not None:
        owner = (entry.source, entry.definition)
        args: tuple[call_arguments.PassedArgument, ...] = _component_arguments(walk, entry)
        place = Location(entry.source.path, entry.definition.line)
        made = construct.instance(walk, frame, owner, entry.arguments, args, place)
        if args:
            outside_nodes.spun(walk, (call_arguments.PassedArgument(made),), place)
        first = _entries(walk) if walk.context.process is None else []
        for root in first:
            activation.invoke(walk, frame, root.function, _arguments(walk, root, frame))
    elif entry.function is not None and entry.source.separator == ".":
        python_names.module_frame(walk, entry.source)
        commands.begin(walk, frame, Callable(entry.source, entry.function))
    elif entry.function is not None:
        words = walk.context.arguments
        args = ()
        if entry.function.parameters:
            argv = Opaque("the command line") if words is None else None
            program: Value = Opaque("the program's name", None, syntax.Type("char", (), "*"))
            cells = tuple(Cell(value) for value in (program, *walk.context.words()))
            args = (
                call_arguments.PassedArgument(argv or Known(len(cells))),
                call_arguments.PassedArgument(argv or Sequence(Cell(cells))),
            )
        activation.invoke(walk, frame, Callable(entry.source, entry.function), args)
    else:
        python_names.module_frame(walk, entry.source)


def _entries(walk: Walk) -> list[Root]:
    """What a nodelet's manager calls, before anything is called back; it is no callback any more."""
    first = [root for root in walk.roots if root.is_entry and not root.is_update]
    left = [number for number, root in enumerate(walk.roots) if not root.is_entry or root.is_update]
    numbers = {old: new for new, old in enumerate(left)}
    walk.roots[:] = [walk.roots[number] for number in left]
    walk.known_roots = {key: numbers[old] for key, old in walk.known_roots.items() if old in numbers}
    return first


def _component_arguments(walk: Walk, entry: Entry) -> tuple[call_arguments.PassedArgument, ...]:
    """What a component is constructed with: the options of its node (rclcpp_components/node_factory.hpp)."""
    if walk.context.process is None or entry.is_hosted or entry.source.separator == ".":
        return ()
    return (call_arguments.PassedArgument(ros2_nodes.options_for(walk), type=syntax.Type("rclcpp::NodeOptions")),)


def _call_back(walk: Walk, frame: Frame) -> None:
    """Follow the callbacks: each from the state after initialisation, joined with what the others leave behind."""
    _set_up(walk, frame)  # which is part of the beginning
    walk.is_called_back = True
    done = 0
    while done < min(len(walk.roots), ROOTS) or uncalled.register(walk):
        batch = walk.roots[done:ROOTS]
        _rehearse_all(walk, frame)
        every = chains.followed(walk, batch, done, partial(_rehearsed, walk, frame), _counted)
        found = disturbances.changed(every.together)  # each of the batch begins with what holds now
        for number, root in sorted(enumerate(batch, start=done), key=lambda item: _rank(walk, item[1])):
            if root.is_setup or not inert.may_make(walk, root.function, ()):
                continue
            mark, known, made, held = walk.state.mark(), len(walk.roots), len(walk.made), len(walk.held)
            disturbances.disturb(walk, every, number, found)
            walk.called.add(number)
            _invoke(walk, frame, walk.roots[number])
            if walk.state.has_set(mark) and any(item.dead for item in list(walk.made.values())[made:]):
                not_ruled_out(
                    walk, partial(_invoke, walk, frame, walk.roots[number])
                )  # it finds the object that it has made
            writes = walk.state.undo(mark)
            _hand_on(walk, known, writes)
            uncalled.hand_on(walk, held, writes)
            if root.is_update:
                forget_again(walk, made)
        done += len(batch)
    for root in walk.roots[ROOTS:]:
        callbacks.beyond(walk, root.function)


def _counted(first: Writes, second: Writes) -> Writes:
    """What a callback writes when it runs a *second* time; a number that is another one each time is not known.

    What it has written the first time alone counts, too: by then it is what the others leave behind.
    """
    return {cell: value for cell, value in first.items() if cell not in second} | {
        cell: Opaque(counters.COUNTS, type=cell.type)
        if cell in first and counters.goes_on(cell.value, first[cell], value)
        else value
        for cell, value in second.items()
    }


def _rank(walk: Walk, root: Root) -> tuple[bool, bool]:
    """Callbacks of plug-ins come first where a node is followed for these; those that change parameters come last."""
    return root.is_update, bool(walk.alternatives) and not alternatives.have(walk, root.function.this)


def _set_up(walk: Walk, frame: Frame) -> None:
    """Bring managed nodes up, and those that they make on the way: what that writes holds from then on."""
    done = 0
    while done < min(len(walk.roots), ROOTS):
        root = walk.roots[done]
        if root.is_setup:
            known = len(walk.roots)
            walk.called.add(done)
            _invoke(walk, frame, root)
            _hand_on(walk, known, {})
        done += 1


def _rehearse_all(walk: Walk, frame: Frame) -> None:
    """What each callback writes by itself, however often it runs, for those that have not been asked yet."""
    for number in range(len(walk.effects), min(len(walk.roots), ROOTS)):
        begun = tick()
        writes = _rehearsed(walk, frame, walk.roots[number], Effects(), number)
        if any(
            walk.is_older(cell, begun) and counters.has_other_number(cell.value, value)
            for cell, value in writes.items()
        ):
            writes.update(_again(walk, frame, walk.roots[number], writes))
        walk.effects.append(writes)


def _again(walk: Walk, frame: Frame, root: Root, writes: Writes) -> Writes:
    """The numbers that a callback changes once more after its *writes*; it takes nothing of what others may spend."""
    rehearsed, spent = walk.rehearsed, dict(walk.spent)
    found = _counted(writes, _rehearsed(walk, frame, root, Effects([writes]), 0))
    walk.rehearsed, walk.spent = rehearsed, spent
    return {cell: value for cell, value in found.items() if counters.is_counted(value)}


def _rehearsed(walk: Walk, frame: Frame, root: Root, others: Effects, number: int) -> Writes:
    """What a callback writes, from a state that the *others* have disturbed."""
    if root.is_update or root.is_setup or root.is_tick:
        return {}
    start = walk.state.mark()
    _disturb(walk, others, number)
    mark, known = walk.state.mark(), len(walk.roots)
    before = walk.steps
    walk.quiet += 1
    try:
        _invoke(walk, frame, root)
    finally:
        walk.quiet -= 1
        walk.rehearsed += walk.steps - before
    writes = walk.state.since(mark)
    _hand_on(walk, known, walk.state.undo(start))
    return writes


def _hand_on(walk: Walk, known: int, writes: Writes) -> None:
    """The callbacks that were registered after the first *known* ones begin with the *writes* of the one that did it."""
    for number in range(known, len(walk.roots)):
        walk.roots[number] = replace(walk.roots[number], writes=writes)


def interlude(walk: Walk, frame: Frame) -> None:
    """Callbacks are called here (``ros::spinOnce``): what they may write is joined with what holds."""
    if walk.is_interlude:
        return
    walk.is_interlude = True
    try:
        _rehearse_all(walk, frame)
    finally:
        walk.is_interlude = False
    _disturb(walk, walk.effects, -1)


def meanwhile(walk: Walk, frame: Frame) -> None:
    """Other threads may call callbacks here: in ROS 1 as ``interlude``, in ROS 2 for the flags, numbers and texts that they set.

    What callbacks write by themselves is not kept for later: here they are called before the node is complete.
    """
    if walk.beside is None:
        interlude(walk, frame)
        return
    if walk.is_interlude:
        return
    effects, rehearsed, spent = walk.effects, walk.rehearsed, dict(walk.spent)
    walk.is_interlude, walk.effects = True, walk.beside
    try:
        _rehearse_all(walk, frame)
    finally:
        walk.is_interlude, walk.effects, walk.rehearsed, walk.spent = False, effects, rehearsed, spent
    for cell, value in disturbances.changed(walk.beside.together).items():
        if isinstance(cell.value, Known):
            walk.state.put(cell, value)


def _disturb(walk: Walk, effects: Effects, own: int) -> None:
    """The callback of the number *own* begins with what the *effects* of the callbacks leave behind."""
    disturbances.disturb(walk, effects, own, disturbances.changed(effects.together))


def _invoke(walk: Walk, frame: Frame, root: Root) -> None:
    before, dead, trials = walk.conditions[:], walk.dead_root, walk.trials
    walk.trials = []
    walk.conditions[:], walk.dead_root, walk.is_raised = root.conditions, root.dead, False
    for cell, value in root.writes.items():
        walk.state.put(cell, value)
    if root.is_tick:
        walk.idle.clear()  # what one node of a tree makes, others may have made
    with walk.doubted(root.doubt):
        activation.invoke(walk, frame, root.function, _arguments(walk, root, frame))
    walk.conditions[:], walk.dead_root, walk.trials = before, dead, trials


def _arguments(walk: Walk, root: Root, frame: Frame) -> tuple[call_arguments.PassedArgument, ...]:
    """What a framework passes: a dynamic_reconfigure callback gets the configuration, all else is not known."""
    function = root.function.function
    found: list[call_arguments.PassedArgument] = []
    scope = function.owner or function.name.rpartition("::")[0]
    inner = Frame(root.function.source, scope, function, root.function.this, templates=root.function.templates)
    for number, parameter in enumerate(function.parameters):
        if number < len(root.function.bound) and root.function.bound[number] is not None:
            continue
        if parameter.default is not None or parameter.name.startswith("*"):
            break
        kind = walk.type_in(parameter.type, inner)
        config: Object | None = walk.config_objects.get(kind.name)
        if config is not None:
            found.append(call_arguments.PassedArgument(config))
        else:
            found.append(
                call_arguments.PassedArgument(walk.opaque("what a callback is given", inner, function.line, kind))
            )
    return tuple(found)
