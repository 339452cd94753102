# SPDX-License-Identifier: Apache-2.0
"""What is called back later: functions given to an API, and methods that a framework calls."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.follow import beside, call_arguments, methods, overriding, partials, qt, setters
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import objects as library_objects
from haros_ci.follow.made import SEVERAL, Root, counts_alone, either
from haros_ci.follow.walk import CHAIN, ROOTS, Walk
from haros_ci.model.architecture import Condition
from haros_ci.model.location import Location
from haros_ci.values.abstract import NONE, Callable, Choice, Known, Object, Pointer, Value

#: Why what a callback makes may not be made.
ONE_OF = "one of several functions is called back"

#: Why what further callbacks make may be missing.
BEYOND = f"there are more callbacks than the {ROOTS} that are followed"

#: Transitions of managed nodes (design.ros2.org/articles/node_lifecycle.html): a launch file's manager brings them up.
SETUP = frozenset(("on_configure", "on_activate"))
TEARDOWN = frozenset(("on_deactivate", "on_cleanup", "on_shutdown", "on_error"))


def register(
    walk: Walk,
    value: Value,
    others: tuple[call_arguments.PassedArgument, ...] = (),
    is_update: bool = False,
    is_setup: bool = False,
    doubt: str | None = None,
    is_entry: bool = False,
) -> None:
    """*value* will be called back: remember it with the object among *others* that it is a method of.

    With *is_update* that is when somebody sets parameters of the node or takes it down, with *is_setup* when it is brought
    up. *doubt* is why it may not be registered, where no statement says so. *is_entry* is what the framework does not call
    before what is followed now has come to its end.
    """
    if isinstance(value, Pointer):
        value = value.cell.value
    if isinstance(value, Object) and value.name == partials.PARTIAL:
        value = partials.callback(value) or NONE
    if isinstance(value, Object) and value.definition is not None:
        separator = value.definition[0].separator
        found = methods.method_of(walk, value, "operator()" if separator == "::" else "__call__")
        if found is None:
            return
        value = found
    if isinstance(value, Choice):
        for option in value.options:
            register(walk, option, others, is_update, doubt=ONE_OF)
        return
    if not isinstance(value, Callable) or walk.is_raised or walk.setting:
        return
    function = value.function
    if value.this is None and function.owner and value.frame is None and not (function.is_static and value.bound):
        for argument in others:
            inner = argument.value.cell.value if isinstance(argument.value, Pointer) else argument.value
            if isinstance(inner, Object) and inner.definition is not None:
                value = Callable(value.source, function, inner, value.bound, value.frame, inner.templates)
                break
    value = overriding.final(walk, value)
    key = (
        id(value.function),
        value.this,
        len(value.bound),
        _carried(walk, value),
    )  # which keeps identities from being used again
    dead = walk.ruled_out()
    conditions = tuple(walk.conditions)
    doubt = doubt or (walk.doubts[-1] if walk.doubts else None)
    root = Root(value, conditions, is_update=is_update, is_setup=is_setup, is_entry=is_entry, doubt=doubt, dead=dead)
    if key in walk.known_roots:
        _again(walk, walk.known_roots[key], root)
    elif not _is_endless(walk, value):
        walk.known_roots[key] = len(walk.roots)
        walk.roots.append(root)
        if not (walk.is_called_back or is_entry):
            setters.disturbed(walk, value)


def _carried(walk: Walk, function: Callable) -> tuple[object, ...]:
    """The plain data that a callback which makes something takes along, bound to it, captured by value, or given to the function that made it."""
    if not walk.relevance.makes(function.function, function.source):
        return ()
    bound: list[tuple[str, object]] = [(str(number), value) for number, value in enumerate(function.bound)]
    if isinstance(function.frame, Frame) and function.function.captures:
        bound += [(name, cell.value) for name, cell in function.frame.scopes[-1].items()]
    if isinstance(function.frame, Frame) and function.source.separator == ".":
        outer, scope = function.frame.function, function.frame.scopes[-1]
        bound += [(name, cell.value) for name, cell in scope.items() if name.endswith("=")]
        if outer is not None and outer.kind != "module":
            cells = ((one.name, function.frame.find(one.name)) for one in outer.parameters)
            bound += [(name, cell.value) for name, cell in cells if cell is not None]
    return tuple((name, value.kind, repr(value.value)) for name, value in bound if isinstance(value, Known))


def _again(walk: Walk, number: int, other: Root) -> None:
    """The root of that *number* is registered on an*other* way: what it makes stands under what both have in common.

    If it has been called back already, it is so once more, for what it makes then.
    """
    if number >= len(walk.roots) or walk.roots[number].function.function is not other.function.function:
        return
    known = walk.roots[number]
    conditions, doubt = _in_common(walk, known, other)
    dead = min(known.dead, other.dead)
    if (conditions, doubt, dead) == (known.conditions, known.doubt, known.dead):
        return
    merged = replace(known, conditions=conditions, doubt=doubt, dead=dead)
    if number not in walk.called:
        walk.roots[number] = merged
    elif not walk.quiet:
        key = next(key for key, known_root in walk.known_roots.items() if known_root == number)
        walk.known_roots[key] = len(walk.roots)
        walk.roots.append(merged)


def _in_common(walk: Walk, known: Root, other: Root) -> tuple[tuple[Condition, ...], str | None]:
    """The conditions of what is registered on two ways, and its doubt; one that fewer branches rule out counts alone."""
    conditions, is_all = either(known.conditions, other.conditions, walk.pairs)
    if counts_alone(known, other, is_all):  # as of two ways to one endpoint
        counting = known if known.dead < other.dead else other
        return counting.conditions, counting.doubt
    certain = any(root.doubt is None and root.conditions == conditions for root in (known, other))
    return conditions, None if certain else known.doubt or other.doubt or (None if is_all else SEVERAL)


def _is_endless(walk: Walk, function: Callable) -> bool:
    """Whether callbacks go on registering *function*, each time for another object.

    In a rehearsal one stands for all of them: what it makes is seen where it is registered in earnest.
    """
    if len(walk.roots) >= ROOTS:  # those beyond are not followed, and not counted either
        if not walk.quiet:
            beyond(walk, function)
        return True
    registered = sum(root.function.function is function.function for root in walk.roots)
    if walk.quiet:
        return registered > 0
    if registered < CHAIN or not walk.is_called_back:
        return False
    if walk.relevance.makes(function.function, function.source):
        reason = f"{function.function.name or 'a function'} is called back for more objects than are followed"
        walk.gaps.setdefault(reason, Location(function.source.path, function.function.line))
    return True


def beyond(walk: Walk, function: Callable) -> None:
    """*function* is one callback more than are followed: what it makes may be missing."""
    if walk.relevance.makes(function.function, function.source):
        walk.gaps.setdefault(BEYOND, Location(function.source.path, function.function.line))


def framework_entries(walk: Walk, this: Object) -> None:
    """Methods that a framework will call on *this*, as its library base classes say (``entry`` of a row)."""
    for owner in library_objects.owners(walk, this):
        for row in walk.rows.get(owner, ()):
            for name in row.entry:
                method = methods.method_of(walk, this, name)
                if method is not None and row.is_class:
                    is_entry = method.source.separator == "::" or name in SETUP | TEARDOWN
                    register(walk, method, (), name in TEARDOWN, name in SETUP, is_entry=is_entry)
                    if owner.startswith(beside.BEGINNING):
                        beside.note(walk, method)
    _entries_of_unknown_base(walk, this)
    qt.called(walk, this)
    _destructor(walk, this)


def _destructor(walk: Walk, this: Object) -> None:
    """A destructor, or ``__del__``, that may make something is called in the end, as what takes a node down."""
    if this.definition is None:
        return
    source, definition = this.definition
    last = f"~{definition.name.rpartition('::')[2]}" if source.separator == "::" else "__del__"
    key = ("destructor", definition.name, source.path)
    if key not in walk.found:
        method = methods.method_of(walk, this, last)
        has_body = method is not None and method.function.body is not None
        walk.found[key] = method is not None and has_body and walk.relevance.makes(method.function, method.source)
    if walk.found[key]:
        register(walk, methods.method_of(walk, this, last) or NONE, (), is_update=True)


def _entries_of_unknown_base(walk: Walk, this: Object) -> None:
    """A nodelet whose base class is in a package outside: the manager initialises it, more is not known."""
    if this.definition is None or this.definition[0].separator != "::":
        return
    if not any(found[1] is this.definition[1] for found in walk.context.plugins.values()):
        return
    method = methods.method_of(walk, this, "onInit", ())
    templates = this.templates if this.definition[1].templates else methods.NOTHING
    bases = [
        base for base in methods.library_bases(walk, *this.definition, templates=templates) if base not in walk.rows
    ]
    if method is None or not bases:
        return
    message = f"the base class {bases[0]} is not in the workspace: what it makes and calls is not known"
    walk.gaps.setdefault(message, Location(this.definition[0].path, this.definition[1].line))
    register(walk, method, is_entry=True)
