# SPDX-License-Identifier: Apache-2.0
"""What a robot description (xacro, URDF) says once it is expanded. A value that is not known is None."""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.records import dataclass

#: A place and what happens there, outermost first: the calls and includes that lead to something.
Way = tuple[tuple[Location, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Fault:
    """Something for which xacro stops, or that it leaves out.

    *kind*: ``property``, ``argument``, ``macro`` and ``block`` (not defined; *of* is its name where a plain parameter has it), ``parameter`` (not given to macro *of*), ``extra`` (given, but the
    macro *of* has none such), ``include`` (the file is missing), ``default`` (an xacro:arg without one), ``unprefixed`` (a call
    of a macro without ``xacro:``, which is left out), ``expression`` and ``syntax`` (cannot be evaluated here). *certain* says that
    nothing unknown can make it right. *defined_later* says that the name is defined further down.
    """

    kind: str
    name: str
    location: Location
    certain: bool = True
    of: str = ""
    similar: tuple[str, ...] = ()
    way: Way = ()
    defined_later: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Thing:
    """Something at *location*, reached by *way*; not *certain* if it is there under an unknown condition only."""

    location: Location
    way: Way = ()
    certain: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Link(Thing):
    """A link; None if its name is not known."""

    name: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A ``<limit>``: the attributes as they come out, None where one is not given; ``?`` where it is not known."""

    location: Location
    lower: str | None = None
    upper: str | None = None
    effort: str | None = None
    velocity: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint(Thing):
    """A joint. *type*, *parent* and *child* are None where they are not known, "" where they are not given.

    *mimic* is the joint that it follows, *factor* how often, *offset* what is added: None where one is not given, ``?`` where it is not known.
    *origin* is where it is, as ``xyz`` and ``rpy``: "" where one is not given, None where it is not known.
    """

    name: str | None
    type: str | None
    parent: str | None
    child: str | None
    limit: Limit | None = None
    mimic: str | None = None
    factor: str | None = None
    offset: str | None = None
    origin: tuple[str | None, str | None] = ("", "")


@dataclass(frozen=True, slots=True, kw_only=True)
class Mesh(Thing):
    """A mesh's file name as it comes out; None if it is not known. *link* is the link that shows it.

    *path* is its file in the workspace; *is_missing* says that a package of the workspace certainly does not have it, *similar*
    are files that may be meant.
    """

    filename: str | None
    link: str | None = None
    path: str | None = None
    is_missing: bool = False
    similar: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """The description that *path* expands to with *arguments* (others have their defaults).

    *files* are all files that it is made of. *is_whole* says that all of it is known: nothing is left out or under an unknown
    condition. *root* is the tag of the document, *name* its name. *macros* are those defined, *size* the number of elements that
    come out besides the root.
    """

    path: str
    arguments: tuple[tuple[str, str | None], ...] = ()
    root: str = ""
    name: str | None = None
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    faults: tuple[Fault, ...] = ()
    files: tuple[str, ...] = ()
    macros: tuple[str, ...] = ()
    size: int = 0
    is_whole: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """A robot as some run of xacro makes it: *command* is the one of a launch file, at *location*; "" for the file as it is.

    Then arguments that launch files pass to it are taken for unknown, all of them if none names it. *is_named* says that a launch
    file, a program or a build names it; one that nobody names may be a part for files elsewhere, which define what it uses.
    """

    robot: Robot
    package: str
    ros: int | None
    command: str = ""
    location: Location | None = None
    is_named: bool = True
