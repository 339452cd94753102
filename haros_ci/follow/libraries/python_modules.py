# SPDX-License-Identifier: Apache-2.0
"""Which module of the workspace a dotted Python name means, where a package and its modules share names."""

from __future__ import annotations

import posixpath
import sys
from collections.abc import Iterable
from itertools import accumulate

from haros_ci import syntax
from haros_ci.follow import python_names
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import python_numbers
from haros_ci.follow.walk import Walk
from haros_ci.index.common_messages import COMMON, OPENED
from haros_ci.index.index import Source
from haros_ci.syntax import Type
from haros_ci.values.abstract import Known, Library, Module, Value

#: Modules of a ROS package that are generated: a script of the package's own name is not meant by what is imported of them.
_GENERATED = frozenset(("msg", "srv", "action", "cfg"))

#: How the names of packages of messages end (REP 144); those of other packages end with the last of these, too.
_OF_MESSAGES = ("_msgs", "_srvs", "_interfaces")


def bound(walk: Walk, module: str) -> Value | None:
    """What a package's ``__init__.py`` binds to the name of its submodule *module*; None if the name is the submodule.

    Python asks the package first (docs.python.org/3/reference/import.html, the from clause and submodules).
    """
    parent, _, name = module.rpartition(".")
    for source in walk.index.modules.get(parent, ())[:1]:
        if source.path.endswith("__init__.py"):
            inner = python_names.module_frame(walk, source)
            cell = inner.scopes[0].get(name)
            value = cell.value if cell is not None else python_names.meant(walk, inner, name)
            return None if isinstance(value, (Library, Module)) else value
    return None


def imported(walk: Walk, first: Iterable[Source]) -> set[str]:
    """The paths of *first* and of all that they import, by way of others too, with each package's ``__init__.py``."""
    waiting = list(first)
    found = {source.path for source in waiting}
    for source in waiting:
        package = source.module if source.path.endswith("__init__.py") else source.module.rpartition(".")[0]
        targets = [source.module]
        for alias in source.program.aliases:
            target = alias.type.name.removesuffix(".*")
            dots = len(target) - len(target.lstrip("."))
            base = package.split(".")[: len(package.split(".")) - dots + 1] if dots else []
            targets += [".".join((*base, target[dots:])) if base else target, f"{package}.{target}"]
        for target in targets:
            parts = target.split(".")
            for length in range(1, len(parts) + 1):
                for other in walk.index.modules.get(".".join(parts[:length]), ())[:1]:
                    if other.path not in found:
                        found.add(other.path)
                        waiting.append(other)
    return found


#: Python modules that give the messages of a package under their own name (tf2_geometry_msgs.py, tf2_sensor_msgs.py of geometry2;
#: actionlib's ``__init__.py`` and modules have ``from actionlib_msgs.msg import *``).
PASSING = {"tf2_geometry_msgs": "geometry_msgs", "tf2_sensor_msgs": "sensor_msgs", "actionlib": "actionlib_msgs"}


def passed_on(target: str) -> str:
    """The full name of a message that a module of a library only passes on."""
    head, _, last = target.rpartition(".")
    package = PASSING.get(head.partition(".")[0])
    return f"{package}.msg.{last}" if package is not None and last in COMMON.get(package, ()) else target


def absolute(source: Source, target: str) -> str:
    """What *source* imports as *target* by its whole name: relative names begin with that of its package."""
    dots = len(target) - len(target.lstrip("."))
    if not dots:
        return target
    base = source.module.split(".")[: None if source.path.endswith("__init__.py") else -1]
    return ".".join((*base[: len(base) - dots + 1], *filter(None, (target[dots:],))))


def placed(walk: Walk, source: Source, target: str) -> tuple[Source, tuple[str, ...]] | None:
    """The module that *target* means by where it lies, and the names in it that are left.

    That is beside the script that is run, as its directory comes first in ``sys.path`` (docs.python.org/3/library/sys_path_init.html), and, of relative
    names in what no import root leads to, beside the file itself.
    """
    script = "" if target.startswith(".") or not walk.modules else next(iter(walk.modules.values())).source.path
    key = ("placed", script, source.path, target)
    if key not in walk.found:
        walk.found[key] = _placed(walk, source, target)
    found: tuple[Source, tuple[str, ...]] | None = walk.found[key]
    return found


def _placed(walk: Walk, source: Source, target: str) -> tuple[Source, tuple[str, ...]] | None:
    dots = len(target) - len(target.lstrip("."))
    names = target[dots:].split(".") if target[dots:] else []
    if not dots:
        script = next(iter(walk.modules.values())).source if walk.modules else source
        is_generated = not _GENERATED.isdisjoint(names[1:2]) or _is_of_messages(target)
        if script.module or names[0] in _libraries(walk) or is_generated:
            return None
        directory = posixpath.dirname(script.path)
    elif source.module:
        return None
    else:
        directory = source.path
        for _ in range(dots):
            directory = posixpath.dirname(directory)
    for count in range(len(names), 0 if not dots else -1, -1):
        found = walk.index.by_place.get("/".join(filter(None, (directory, *names[:count]))))
        if found is not None and found is not source:
            return found, tuple(names[count:])
    return None


def beside(walk: Walk, source: Source, target: str) -> str | None:
    """The module or content of a module beside *source* in its package that ``import`` without dots means in Python 2.

    Python 3, which all programs of ROS 2 run on, finds nothing there (PEP 328). Messages and libraries that are known go first.
    """
    head, *rest = target.split(".")
    if walk.context.process is not None or not _GENERATED.isdisjoint(rest[:1]) or _is_of_messages(target):
        return None
    package = source.module if source.path.endswith("__init__.py") else source.module.rpartition(".")[0]
    if not package or head == package.partition(".")[0] or f"{package}.{head}" not in walk.index.modules:
        return None
    return None if head in _libraries(walk) else f"{package}.{target}"


def is_generated_elsewhere(walk: Walk, target: str) -> bool:
    """Whether *target* is generated code by its name, and no Python module of a ROS package of that name: one that another package has is not meant."""
    head = target.partition(".")[0]
    return _is_of_messages(target) and not any(
        source.package == head
        for name in accumulate(target.split("."), "{}.{}".format)
        for source in walk.index.modules.get(name, ())
    )


def _is_of_messages(target: str) -> bool:
    """Whether a dotted name is that of generated code; ``import a_msgs.msg`` binds ``a_msgs`` alone."""
    head, *rest = target.split(".")
    return head.endswith(_OF_MESSAGES) and rest[0] in _GENERATED if rest else head.endswith(_OF_MESSAGES[:-1])


def is_outside(walk: Walk, source: Source, module: str) -> bool:
    """Whether nothing in the workspace is, or is below, what *source* imports as *module*: whatever it has is a library's (``python_names.imported``)."""
    script = "" if not walk.modules else next(iter(walk.modules.values())).source.path
    key = ("outside", script, source.path, module)
    if key not in walk.found:
        walk.found[key] = _is_outside(walk, source, module, posixpath.dirname(script or source.path))
    found: bool = walk.found[key]
    return found


def _is_outside(walk: Walk, source: Source, module: str, directory: str) -> bool:
    head = module.partition(".")[0]
    if not head or beside(walk, source, module) is not None:
        return False
    place = f"{directory}/{head}" if directory else head
    return not any(
        name == start or name.startswith(f"{start}{separator}")
        for start, separator, names in ((head, ".", walk.index.modules), (place, "/", walk.index.by_place))
        for name in names
    )


def is_library(walk: Walk, head: str) -> bool:
    """Whether a module is one of Python itself, or of a library that the API rows have."""
    return head in _libraries(walk)


def _libraries(walk: Walk) -> frozenset[str]:
    """The modules of Python itself and of libraries that the API rows have."""
    known = walk.found.get(("heads",))
    if known is None:
        known = walk.found["heads",] = frozenset(name.partition(".")[0] for name in walk.rows) | sys.stdlib_module_names
    return known


def starred(walk: Walk, source: Source, name: str, only: str = "") -> str | None:
    """The message type that ``from pkg.msg import *`` brings in: defined in the workspace, or else by the one package outside.

    With *only* it is known to be one of modules of that kind: ``msg``, ``srv`` or ``action``.
    """
    outside = []
    complete = OPENED if walk.context.process is None else COMMON
    for alias in reversed(source.program.aliases):  # of several the last counts
        module = alias.type.name.removesuffix(".*")
        package, _, kind = module.rpartition(".")
        whole = f"{module}.{name}"
        if alias.name == "*" and (whole in walk.rows or passed_on(whole) != whole):
            return passed_on(whole)
        if alias.name != "*" or kind not in ("msg", "srv", "action") or (only and kind != only):
            continue
        if f"{package}/{name}" in walk.index.interfaces or _of_action(walk, package, name):
            return f"{module}.{name}"
        if package in walk.index.packages:
            continue
        if not OPENED.get(package, frozenset()).isdisjoint((name, f"{name}Action" if kind == "action" else name)):
            return f"{module}.{name}"
        if package not in complete:
            outside.append(f"{module}.{name}")
    return outside[0] if len(outside) == 1 and name[:1].isupper() else None


def opened(walk: Walk, frame: Frame, kind: Type, of: str) -> Type:
    """The type of an endpoint of the kind *of*, by its full name where modules with all their names bring it: services from ``pkg.srv``, actions of ROS 2 from ``pkg.action``, else ``pkg.msg``.

    One that a variable holds may be of another module.
    """
    name = kind.name
    if not name.isidentifier() or frame.source.separator != ".":
        return kind
    if any(cell.value == Library(name) for scope in frame.scopes for cell in scope.values()):
        return kind
    of_actions = starred(walk, frame.source, name, "action") if of.startswith("action_") else None
    found = of_actions or starred(walk, frame.source, name, "srv" if of in ("servers", "clients") else "msg")
    return kind if found is None else Type(found)


def _of_action(walk: Walk, package: str, name: str) -> bool:
    """Whether *name* is a message of an action of the workspace (wiki.ros.org/actionlib: FooAction, FooGoal, ...)."""
    action = name
    for suffix in ("Action", "Goal", "Result", "Feedback"):
        base = name.removesuffix(suffix)
        action = base if base != name and base else action
    return action != name and f"{package}/{action}" in walk.index.interfaces


def of_library(target: str) -> Value:
    """What a dotted name of a Python library means: a number that it stands for, or the name."""
    name = passed_on(target)
    number = python_numbers.CONSTANTS.get(name)
    return Library(name) if number is None else Known(number)


def rebound(source: Source) -> set[str]:
    """The variables of a Python module that its functions assign to (``global``)."""
    statements = (statement for function in source.program.functions for statement in function.body or ())
    return {name for statement in statements if type(statement) is syntax.Global for name in statement.names}
