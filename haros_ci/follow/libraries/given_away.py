# SPDX-License-Identifier: Apache-2.0
"""What a library that is not here does with a class or an object of the workspace that it is given: it may make the one, and call the other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import callbacks, construct, linear, methods, partials, properties, uncalled
from haros_ci.follow.frames import Frame
from haros_ci.follow.ros import ros2_nodes
from haros_ci.follow.walk import Walk
from haros_ci.index.index import Source
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.values.abstract import Callable, ClassValue, Mapped, Object, Pointer, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

#: What frameworks commonly call first; other methods are known to be called from outside by ``virtual`` or ``override`` alone.
BEGINNING = frozenset("init initialize onInit onInitialize setup configure load start".split())
#: Base classes whose libraries call nothing that is overridden, or what the API rows and ``follow.qt`` tell.
KNOWN = frozenset("std boost ros nodelet rclcpp rviz rclpy rospy object Exception".split())
#: Modules and classes of Python's own library, and of toolkits that call what is given to them alone.
KNOWN_PYTHON = frozenset(
    "abc enum threading multiprocessing unittest typing typing_extensions dataclasses collections argparse logging io queue json "
    "string contextlib configparser ctypes tkinter Tkinter PyQt4 PyQt5 PyQt6 PySide PySide2 PySide6 python_qt_binding ABC Enum "
    "IntEnum NamedTuple Thread TestCase dict list str int float tuple set BaseException RuntimeError ValueError KeyError".split()
)
#: Modules, namespaces and classes of bases that are put beside others and call nothing: ``enable_shared_from_this``, ``ABC``.
_BESIDE = frozenset("std boost object abc ABC typing typing_extensions dataclasses".split())
#: Classes whose objects are processes when they are started, with nodes of their own (docs.python.org/3/library/multiprocessing.html).
PROCESSES = frozenset(
    ("multiprocessing.Process", "multiprocessing.context.Process", "multiprocessing.process.BaseProcess")
)
#: How the names of base classes end whose methods are tests: ``asynctest.TestCase``, ``aiounittest.AsyncTestCase``.
_TEST = "TestCase"
#: Lists in lists that are looked into for what is given, and values that are looked at.
DEEP, MOST = 3, 300
#: How the first part of a name begins whose library is known: packages of several namespaces or modules.
_BEGINNINGS = ("rclcpp_", "rviz_", "rqt_")
#: A class, namespace or module of Qt (doc.qt.io): QObject, QSGNode, Qt::, QtWidgets.
_QT = regex(r"Qt(?:[A-Z]|$)|Q(?:[A-Z][a-z]|SG|GL)")


def among(frame: Frame, args: Iterable[PassedArgument]) -> list[Value]:
    """The classes and objects among *args*, in Python also in lists, tuples and dictionaries (``Application([("/x", Handler)])``)."""
    depth = DEEP if frame.source.separator == "." else 0
    every = (value for argument in args for value in _held(argument.value, depth))
    return [value for value in islice(every, MOST) if isinstance(value, (ClassValue, Object))]


def taken(walk: Walk, frame: Frame, name: str, found: Iterable[Value]) -> None:
    """Follow what the function or method *name* may do with the classes and objects that it is given."""
    for value in found:
        args: tuple[PassedArgument, ...] = ()
        if isinstance(value, Object) and value.name == partials.PARTIAL:
            value, args = partials.called(value, ())
        if isinstance(value, ClassValue):
            _made(walk, frame, name, value, args)
        elif isinstance(value, Object) and value.definition is not None:
            _called(walk, value, f"{name} is not known, which is given the object and may call it")


def _held(value: Value, depth: int) -> Iterator[Value]:
    """A value that is given, and of a list, tuple or dictionary what it holds."""
    value = value.cell.value if isinstance(value, Pointer) else value
    yield value
    content = value.content.value if depth and isinstance(value, (Sequence, Mapped)) else ()
    cells = content.values() if isinstance(content, dict) else content if isinstance(content, tuple) else ()
    for cell in cells:
        yield from _held(cell.value, depth - 1)


def _made(walk: Walk, frame: Frame, name: str, value: ClassValue, args: tuple[PassedArgument, ...]) -> None:
    """A node's class is for nothing else than to be made (``process.spin(Driver)``); how often, and whether, is not known.

    So is one whose base class is a library's, and of which that library may call methods (``HTTPServer(address, Handler)``).
    """
    owner = (value.source, value.definition)
    key = ("made elsewhere", id(value.definition))
    if walk.quiet or key in walk.offered:
        return
    is_node = ros2_nodes.NODE["."] in methods.library_bases(walk, *owner)
    if not is_node and (value.source.separator != "." or not any(_overridden(walk, Object("", definition=owner)))):
        return
    walk.offered.add(key)
    reason = f"{name} is not known, which is given the class and may make {'a node' if is_node else 'an object'} of it"
    with walk.doubted(reason):
        made = construct.instance(walk, frame, owner, (), args, Location(value.source.path, value.definition.line))
    if not is_node and isinstance(made, Object):
        _called(walk, made, f"{reason} and call that")


def _called(walk: Walk, this: Object, reason: str) -> None:
    """An object whose base class is not in the workspace is called by the library that has that class."""
    for found, base in _overridden(walk, this):
        doubt = f"{reason} by its base class {base}"
        if found.source.separator == "::":
            callbacks.register(walk, found, doubt=doubt)
        else:
            uncalled.offer(walk, found, doubt)


def constructed(walk: Walk, made: Value) -> Value:
    """*made* by ``new`` or ``make_shared``: its base class that the workspace does not have may know the object, and its library call what nothing else is seen to."""
    if (
        isinstance(made, Object)
        and made.definition is not None
        and made.definition[0].separator == "::"
        and not walk.quiet
    ):
        for found, base in _overridden(walk, made):
            uncalled.offer(
                walk, found, f"the base class {base} is not in the workspace: its library may call the object"
            )
    return made


def _overridden(walk: Walk, this: Object) -> Iterator[tuple[Callable, str]]:
    """The methods of an object that may make something and that a library may call by a base class of its own, with that class."""
    assert this.definition is not None
    source, definition = this.definition
    if not definition.bases:
        return
    templates = this.templates if definition.templates else methods.NOTHING
    key = ("called elsewhere", id(definition), walk.numbered(templates) if templates else 0)
    if key not in walk.found:
        bases = _calling_bases(walk, source, definition, templates)
        called = _callable if source.separator == "::" else _callable_python
        walk.found[key] = called(walk, source, definition, bases), bases
    names, bases = walk.found[key]
    for last in names:
        found = methods.method_of(walk, this, last)
        if found is not None and walk.relevance.makes(found.function, found.source):
            yield found, bases[0]


def started(walk: Walk, name: str, this: Object) -> None:
    """A method of Python that only the library has of which the object's base class is (``App().run()``): it may call what is overridden."""
    if this.definition is None or this.definition[0].separator != ".":
        return
    source, definition = this.definition
    if (
        name == "start"
        and walk.context.process is None
        and not PROCESSES.isdisjoint(methods.library_bases(walk, source, definition))
    ):
        run = methods.method_of(walk, this, "run")
        if run is not None and walk.relevance.makes(run.function, run.source):
            reason = f"{definition.name} is a process of its own: what that makes is told of the node that starts it"
            walk.gaps.setdefault(reason, Location(run.source.path, run.function.line))
    _called(walk, this, f"{name} is not known, which is given the object and may call it")


def is_known(base: str) -> bool:
    """Whether it is known of a class's library what it calls of the methods that are overridden; those of Qt are ``QObject`` and the like."""
    first, *rest = base.replace("::", ".").split(".")
    is_of_qt = _QT.match(first) is not None and (not rest or first.startswith("Qt"))
    return first in KNOWN or first.startswith(_BEGINNINGS) or is_of_qt


def _calling_bases(
    walk: Walk, source: Source, definition: syntax.Class, templates: Mapping[str, syntax.Argument]
) -> list[str]:
    """The base classes that the workspace does not have, without those of which it is known that they call nothing."""
    bases = methods.library_bases(walk, source, definition, templates=templates)
    return [base for base in bases if base.replace("::", ".").partition(".")[0] not in _BESIDE]


def _callable(walk: Walk, source: Source, definition: syntax.Class, bases: list[str]) -> list[str]:
    """The last parts of the names of the methods that a library may call of a class's objects, in their order."""
    if not bases or any(base in walk.rows or is_known(base) for base in bases):
        return []
    names: dict[str, None] = {}
    for where, class_ in walk.index.classes.get(definition.name, ()):
        for function in where.program.functions:
            last = function.name.rpartition("::")[2]
            if (
                function.owner == class_.name
                and (function.is_virtual or last in BEGINNING)
                and not last.startswith("~")
            ):
                names[last] = None
    return list(names)


def _callable_python(walk: Walk, source: Source, definition: syntax.Class, bases: list[str]) -> list[str]:
    """The same for Python, where nothing says what is overridden: the methods that no method of the class calls."""
    firsts = {base.partition(".")[0] for base in bases}
    if not bases or firsts & KNOWN_PYTHON or any(base in walk.rows or is_known(base) for base in bases):
        return []
    if any(base.endswith(_TEST) for base in bases):
        return []
    own = list(_methods(walk, source, definition))
    called = frozenset[str]().union(*(walk.relevance.calls_of(function, where) for where, function in own))
    return list(
        dict.fromkeys(
            name
            for name, function in ((function.name.rpartition(".")[2], function) for _, function in own)
            if f".{name}" not in called and _may_override(name, function)
        )
    )


def _methods(walk: Walk, source: Source, definition: syntax.Class) -> Iterator[tuple[Source, syntax.Function]]:
    """The methods of a Python class and of its bases in the workspace."""
    for entry in linear.order(walk, source, definition):
        if not isinstance(entry, str):
            where, class_ = entry
            functions = where.program.functions
            yield from ((where, item) for item in functions if item.owner == class_.name and item.kind != "lambda")


def _may_override(name: str, function: syntax.Function) -> bool:
    """Whether a method is one that is called on an object by its name, as those that a base class calls are."""
    if function.is_static or properties.is_property(function):
        return False
    return name == "__call__" or not name.startswith("__")
