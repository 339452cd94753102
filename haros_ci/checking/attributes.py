# SPDX-License-Identifier: Apache-2.0
"""Attributes of ``self`` that Python code reads and that nothing sets: no method of the class, of its bases or of its subclasses, and
no code outside of them.

A class is looked at only where all that it inherits is known: classes of the workspace, and the nodes of rclpy with the public names
that they have in any distribution. One that makes attributes by name (``setattr``, ``__setattr__``, ``__getattr__``, ``__dict__``) is passed over.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Set

from haros_ci import syntax
from haros_ci.checking.file_words import (
    asked_for,
    called_in,
    defined_in,
    first_members,
    lines_of,
    makes_by_name,
    named_in,
)
from haros_ci.checking.likeness import is_letter_slip
from haros_ci.checking.project import Project
from haros_ci.code.classes import Owner, bases
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.regex import regex
from haros_ci.syntax import Block, Expression
from haros_ci.syntax.walk import below, everything

#: A call of something by a name of its own, whose first argument is not ``self``.
_CALL = regex(r"(?<!\w)(\w+)\.(\w+)[ \t]*\((?!\s*self\b)")
#: Classes that are made for others to complete them.
_PARTIAL = regex(r"mixin|abstract|interface|protocol|template", re.I)
#: So is one with this word, unless another file makes objects of it: the base may be that of a robot.
_BASE = regex(r"base", re.I)
_PLAIN = frozenset(("object", "abc.ABC", "ABC"))
_DECORATORS = ("@dataclass", "@dataclasses.dataclass", "@total_ordering", "@functools.total_ordering")
_THREAD = frozenset(
    "name daemon start run join is_alive isAlive ident native_id isDaemon setDaemon getName setName".split()
)
_NODE = frozenset(
    """publishers subscriptions clients services timers guards waitables executor context default_callback_group handle
    get_name get_namespace get_fully_qualified_name get_clock get_logger get_effective_namespace
    declare_parameter declare_parameters undeclare_parameter has_parameter get_parameter_types get_parameter_type get_parameters
    get_parameter get_parameter_or get_parameters_by_prefix set_parameters set_parameters_atomically list_parameters
    add_on_set_parameters_callback add_pre_set_parameters_callback add_post_set_parameters_callback
    remove_on_set_parameters_callback remove_pre_set_parameters_callback remove_post_set_parameters_callback
    set_parameters_callback describe_parameter describe_parameters set_descriptor add_waitable remove_waitable
    resolve_topic_name resolve_service_name create_publisher create_subscription create_client create_service create_timer
    create_guard_condition create_rate create_service_introspection destroy_publisher destroy_subscription destroy_client
    destroy_service destroy_timer destroy_guard_condition destroy_rate destroy_node get_node_names
    get_node_names_and_namespaces get_node_names_and_namespaces_with_enclaves get_fully_qualified_node_names
    get_publisher_names_and_types_by_node get_subscriber_names_and_types_by_node get_service_names_and_types_by_node
    get_client_names_and_types_by_node get_action_names_and_types_by_node get_action_client_names_and_types_by_node
    get_action_server_names_and_types_by_node get_topic_names_and_types get_service_names_and_types
    get_action_names_and_types count_publishers count_subscribers count_clients count_services
    get_publishers_info_by_topic get_subscriptions_info_by_topic get_servers_info_by_service get_clients_info_by_service
    wait_for_node automatically_declare_parameters_from_overrides enable_rosout enable_logger_service PARAM_REL_TOL
    loaded_parameters type_description_service
    """.split()
)
#: A class with more names of its own is not looked at for slips: each name is compared with each.
_MOST_OWN = 300
#: What rclpy's Node and Thread have for themselves, of short names.
_PRIVATE = frozenset(
    """_args _allow_undeclared_parameters _clock _context _default_callback_group _descriptors _enable_rosout _executor_event _handle _ident _kwargs _logger
    _name _parameter_event_publisher _parameter_overrides _parameter_service _parameters _started _target _time_source""".split()
)
_LIFECYCLE = frozenset(
    """
    create_lifecycle_publisher destroy_lifecycle_publisher add_managed_entity
    trigger_configure trigger_cleanup trigger_activate trigger_deactivate trigger_shutdown on_configure on_cleanup on_activate on_deactivate on_shutdown on_error track_transition_callback
    """.split()
)
#: Classes of libraries, each with what they bring; of what begins with an underscore nothing is said there.
_KNOWN = {
    "rclpy.node.Node": _NODE,
    "rclpy.Node": _NODE,
    "rclpy.lifecycle.Node": _NODE | _LIFECYCLE,
    "rclpy.lifecycle.LifecycleNode": _NODE | _LIFECYCLE,
    "rclpy.lifecycle.node.LifecycleNode": _NODE | _LIFECYCLE,
    "threading.Thread": _THREAD,
}


@dataclass(frozen=True, slots=True)
class Unset:
    """Attribute *name* of class *owner* is read at *location* in *routine*; *known* are those that it and its bases have.

    *is_reached* is false where no Python file of the workspace names the method, so that nothing seems to call it. *is_called* says that
    the class does nothing with the attribute but call it.
    """

    owner: str
    name: str
    routine: Routine
    location: Location
    known: frozenset[str]
    is_reached: bool
    is_called: bool = False


@dataclass(slots=True)
class _Attributes:
    """What the methods of one class do with ``self``."""

    owner: Owner
    routines: list[Routine]
    read: dict[str, Routine]
    has: set[str]
    #: How often an attribute is read without being called.
    uncalled: Counter[str] = field(default_factory=Counter)


def unset_attributes(project: Project) -> Iterator[Unset]:
    """Every attribute that is read and never set, once for each class."""
    code = project.code
    classes = _classes(code)
    parents = {key: list(bases(code, class_.owner)) for key, class_ in classes.items()}
    related = _related(classes, parents)
    elsewhere = _set_elsewhere(code)
    for key, class_ in classes.items():
        source, definition = class_.owner
        if not class_.read or source.package is None or not _is_plain(code, class_.owner):
            continue
        family = [classes[name] for name in sorted(related[key]) if name in classes]
        files = {one.owner[0].path for one in family}
        if any(_is(above, name) for name in related[key] for above, _ in parents.get(name, ())):
            continue  # a class that is called like the one that it inherits, which comes from elsewhere
        libraries = {name for member in related[key] for above, name in parents.get(member, ()) if above is None}
        if len(family) < len(related[key]) or not libraries <= {*_PLAIN, *_KNOWN}:
            continue
        if any(makes_by_name(code, path) for path in files):
            continue
        if not _is_made(code, class_.owner, is_alone=len(family) == 1):
            continue
        has = set().union(*(one.has for one in family), *(_KNOWN.get(name, frozenset()) for name in libraries))
        if "__init__" not in has:
            continue
        known = frozenset(class_.has).union(*(_known(above, name, classes) for above, name in parents[key]))
        if not libraries <= _PLAIN | {"threading.Thread"}:
            has |= _LIFECYCLE  # rclpy may get these names for its plain nodes
        for name, routine in sorted(class_.read.items()):
            is_hidden = name.startswith("__") or (bool(libraries - _PLAIN) and _is_private(name, class_.has))
            if name in has or name in elsewhere or is_hidden or name in asked_for(code, source.path):
                continue
            is_reached = _is_reached(code, routine, files)
            place = _place(code, routine, name)
            yield Unset(definition.name, name, routine, place, known, is_reached, not class_.uncalled[name])


def _is_private(name: str, own: Set[str]) -> bool:
    """Whether *name* may be one that a library's class has for itself: with an underscore, and no slip of an *own* one of the class."""
    is_alike = name not in _PRIVATE and len(own) <= _MOST_OWN and any(is_letter_slip(name, other) for other in own)
    return name.startswith("_") and not is_alike


def _known(above: Owner | None, name: str, classes: dict[tuple[str, str], _Attributes]) -> Set[str]:
    """What a base has: a class of the workspace, or one of a library that is known."""
    if above is None:
        return _KNOWN.get(name, frozenset())
    found = classes.get((above[0].path, above[1].name))
    return found.has if found is not None else frozenset()


def _classes(code: Codebase) -> dict[tuple[str, str], _Attributes]:
    """The Python classes of the workspace by file and name; those that a file defines twice are left out."""
    found: dict[tuple[str, str], _Attributes] = {}
    on_classes = _called_on_classes(code)
    for source in code.sources:
        program = source.program
        if program.language != "python" or program.problems or source.path.endswith(".pyi"):
            continue
        names = Counter(class_.name for class_ in program.classes)
        inside: dict[str, set[str]] = {}
        for inner in names:
            inside.setdefault(inner.rpartition(".")[0], set()).add(inner.rpartition(".")[2])
        for class_ in program.classes:
            if names[class_.name] == 1:
                has = {member.name for member in class_.fields} | inside.get(class_.name, set())
                found[source.path, class_.name] = _Attributes((source, class_), [], {}, has)
        for function in program.functions:
            one = found.get((source.path, function.owner))
            if one is not None and function.name.rpartition(".")[0] == function.owner:
                one.has.add(function.name.rpartition(".")[2])
        for routine in code.routines(source.path):
            one = found.get((source.path, routine.owner))
            if one is not None and (_short(routine.owner or ""), _short(routine.function.name)) in on_classes:
                one.has.update(_set_in(routine.function.body or ()))  # of the class, if it is a class method
            elif one is not None:
                one.routines.append(routine)
                _add(one, routine)
    return found


def _called_on_classes(code: Codebase) -> frozenset[tuple[str, str]]:
    """The methods, by class and name, to which some call gives their first argument by hand, as a function without ``self`` is called:
    ``Class.method(text)``.
    """
    texts = (
        code.text(source.path)
        for source in code.sources
        if source.program.language == "python" and source.path not in code.unbuilt
    )
    return frozenset(found for text in texts for found in _CALL.findall(text) if not found[1].startswith("__"))


def _short(name: str) -> str:
    return name.rpartition(".")[2]


def _is_reached(code: Codebase, routine: Routine, family: Set[str]) -> bool:
    """Whether a method is one that Python or a library calls by its name, or is named in the code of some Python file.

    What a file calls on ``self`` is its own method, if it defines one of this name and has no class of the *family*: its files.
    """
    name = _short(routine.function.name)
    if name.startswith("__") or name in _NODE | _LIFECYCLE | _THREAD:
        return True
    for path in code.mentioning(name):
        is_own = path not in family and name in defined_in(code, path)
        if name in named_in(code, path, is_own):
            return True
    return False


def _add(one: _Attributes, routine: Routine) -> None:
    """What a method reads and sets; what stands where an AttributeError is caught counts as neither."""
    waiting = below(routine.function.body)[::-1]
    while waiting:
        node = waiting.pop()
        if isinstance(node, syntax.Try) and any(_catches(handler) for handler in node.handlers):
            one.has.update(_set_in(node.body))
            waiting += node.handlers
        elif isinstance(node, syntax.Assignment) and node.operator == "=":
            one.has.update(name for is_own, name in _targets(node.target) if is_own)
            waiting += [*_rest(node.target), node.value]
        elif isinstance(node, syntax.Member) and isinstance(node.object, syntax.This):
            one.read.setdefault(node.name, routine)
            one.uncalled[node.name] += 1
        else:
            if isinstance(node, syntax.Call) and _is_own(node.callee):
                one.uncalled[syntax.name_of(node.callee)] -= 1
            waiting += reversed(below(node))


def _is_own(node: Expression) -> bool:
    return isinstance(node, syntax.Member) and isinstance(node.object, syntax.This)


def _catches(handler: syntax.Handler) -> bool:
    return not handler.text.strip() or "AttributeError" in handler.text


def _set_in(block: Block) -> Iterator[str]:
    for node in everything(block):
        if isinstance(node, syntax.Assignment):
            yield from (name for is_own, name in _targets(node.target) if is_own)


def _targets(target: Expression) -> Iterator[tuple[bool, str]]:
    """The attributes that an assignment sets: whether it is one of ``self``, and its name."""
    if isinstance(target, syntax.ListLiteral):
        for item in target.items:
            yield from _targets(item)
    elif isinstance(target, (syntax.Star, syntax.DoubleStar)):
        yield from _targets(target.value)
    elif isinstance(target, syntax.Member):
        yield isinstance(target.object, syntax.This), target.name


def _rest(target: Expression) -> Iterator[Expression]:
    """What an assignment's target reads."""
    if isinstance(target, syntax.ListLiteral):
        for item in target.items:
            yield from _rest(item)
    elif isinstance(target, (syntax.Star, syntax.DoubleStar)):
        yield from _rest(target.value)
    elif isinstance(target, syntax.Member):
        if not isinstance(target.object, syntax.This):
            yield target.object
    else:
        yield target


def _is(owner: Owner | None, key: tuple[str, str]) -> bool:
    return owner is not None and (owner[0].path, owner[1].name) == key


def _related(
    classes: dict[tuple[str, str], _Attributes], parents: dict[tuple[str, str], list[tuple[Owner | None, str]]]
) -> dict[tuple[str, str], set[tuple[str, str]]]:
    """Each class with its bases, its subclasses and their bases: all that may be one object with it."""
    above = {
        key: {key, *((definition[0].path, definition[1].name) for definition, _ in found if definition is not None)}
        for key, found in parents.items()
    }
    related: dict[tuple[str, str], set[tuple[str, str]]] = {key: set() for key in classes}
    for every in above.values():
        for pair in every:
            if pair in related:
                related[pair] |= every
    return related


def _set_elsewhere(code: Codebase) -> frozenset[str]:
    """The attributes that any code sets of something that is not ``self``."""
    found: set[str] = set()
    for source in code.sources:
        if source.program.language == "python":
            for routine in code.routines(source.path):
                for target, *_ in code.body(routine).sets:
                    found.update(name for is_own, name in _targets(target) if not is_own or not routine.owner)
    return frozenset(found)


def _is_plain(code: Codebase, owner: Owner) -> bool:
    """Whether nothing but its statements makes the class: no decorator that may add to it."""
    source, definition = owner
    lines = lines_of(code, source.path)
    above = (lines[number].strip() for number in range(min(definition.line - 1, len(lines)) - 1, -1, -1))
    before = next((line for line in above if line), "")
    return not (before.startswith("@") or before == ")") or before.startswith(_DECORATORS)


def _is_made(code: Codebase, owner: Owner, *, is_alone: bool) -> bool:
    """Whether code of the workspace makes objects of the class, or of a subclass; one for others to complete is not said to be."""
    if not is_alone:
        return True
    short = owner[1].name.rpartition(".")[2]
    if _PARTIAL.search(short) is not None:
        return False
    python = (path for path in code.mentioning(short) if code.by_path[path].program.language == "python")
    makers = (path for path in python if short in called_in(code, path))
    return any(_BASE.search(short) is None or path != owner[0].path for path in makers)


def _place(code: Codebase, routine: Routine, name: str) -> Location:
    """Where the attribute is first read in the routine; the routine's head if that is not found."""
    line = routine.function.line
    found = first_members(code, routine).get(name)
    if found is None:
        return Location(routine.path, line or 1)
    number, begin, end = found
    return Location(routine.path, number, begin + 1, number, end + 1)
