# SPDX-License-Identifier: Apache-2.0
"""What launch files say that checks ask about: files, packages and programs named, arguments, includes, conditions.

The launch evaluators record it while they start a configuration; ``Configuration.launch_facts`` has it in launch order. What is
not certain is None, never a guess.
"""

from __future__ import annotations

from haros_ci.model.location import Location
from haros_ci.model.presence import ALWAYS, Presence
from haros_ci.records import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchFact:
    """Something that a launch file says at *location*, the tag or call where a fix goes.

    *included* are the include tags that lead there from the file that is launched, outermost first. *ros* is 1 or 2.
    """

    location: Location
    presence: Presence = ALWAYS
    included: tuple[Location, ...] = ()
    ros: int = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class FileUse(LaunchFact):
    """A file, or a directory, of a package that a launch file names.

    *kind*: ``include``, ``parameters`` (a parameter file or rosparam), ``text`` (textfile, binfile, file-content), ``value`` (in a
    node's arguments, a parameter's value or a command) or ``default`` (of a launch argument). *text* is what is named
    (``$(find-pkg-share pkg)/launch/x.py``, or ``$(workspace dir)/x`` by the directory of the launch file itself), *package* the
    owner, "" where there is none; *inner* the path inside the package's share directory; *path* where it would lie, relative to the
    root. *name* says what it is the value of. *is_found* is None where that cannot be known: a package outside the workspace, a file that the build may make.
    *similar* are the files of the package that may be meant instead, nearest first; *chosen*, ``NAME=default``, is the environment variable that may
    name another file, where the default of its ``$(optenv)`` names this one.
    """

    kind: str
    text: str
    name: str = ""
    package: str = ""
    inner: str = ""
    path: str | None = None
    is_found: bool | None = None
    similar: tuple[str, ...] = ()
    chosen: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageUse(LaunchFact):
    """A *package* that a launch file names; *kind*: ``node``, ``component``, ``find`` (its directory), ``include`` or ``command``."""

    kind: str
    package: str
    is_here: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramUse(LaunchFact):
    """A program, or the class of a component or nodelet, that a launch file starts from *package*.

    *kind*: ``executable``, ``component`` or ``nodelet``. *is_found* says whether the package builds or installs it, None where
    its build cannot tell or it is not in the workspace. *similar* are names that the package has, or of one outside of the workspace those
    that are known, nearest first. *is_library* says that the package builds a library of this name, *is_module* that it has a Python module
    of this name, which the programs *similar* run.
    """

    kind: str
    package: str
    program: str
    is_found: bool | None = None
    similar: tuple[str, ...] = ()
    is_library: bool = False
    is_module: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ArgumentDeclaration(LaunchFact):
    """A launch argument: its *default* as written (None: it must be given) and its *choices*.

    *is_used* says whether anything that sees it reads it, None where a part of that cannot be read. *is_top* says whether
    the launched file itself declares it.
    """

    name: str
    default: str | None = None
    choices: tuple[str, ...] = ()
    is_used: bool | None = None
    is_top: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class ArgumentRead(LaunchFact):
    """A launch argument or configuration *name* that is read, but that nothing can have declared or set before.

    *similar* are names that are set there, nearest first. Certain only for the launched file as it is: with ROS 2 a launch
    file outside the workspace that includes it may set the name. *is_undecided* says that a condition around it (ROS 1) may be false.
    """

    name: str
    similar: tuple[str, ...] = ()
    is_undecided: bool = False


@dataclass(frozen=True, slots=True)
class PassedArgument:
    """An argument that an include passes; *location* is that of the ``<arg>``, or of the include."""

    name: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class IncludeUse(LaunchFact):
    """An include of the file *path* (None if it is not known, or not in the workspace; *text* is what is named).

    *declared* are the arguments that the target declares, and with ROS 2, where configurations are inherited, its own includes;
    *read* those that are read there. Both are certain only if *is_whole*. *missing* are arguments without a default that are
    certainly not given.
    """

    text: str
    path: str | None = None
    passed: tuple[PassedArgument, ...] = ()
    declared: tuple[str, ...] = ()
    read: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    is_whole: bool = False


@dataclass(frozen=True, slots=True)
class Comparison:
    """``left == right`` inside a condition: *left* as written, *right* a literal, *values* all that left can have here.

    *values* holds defaults, choices and what callers give; () if that is not known. *sign* is ``==`` or ``!=``. *is_quoted* is False
    where left stands in a Python expression without quotes: then Python evaluates its text.
    """

    left: str
    right: str
    values: tuple[str, ...] = ()
    sign: str = "=="
    is_quoted: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class ConditionUse(LaunchFact):
    """A condition of a tag or action: *statement* is ``if`` or ``unless``, *text* what is written.

    *value* is what it gives here (None if undecided). *is_constant* says that nothing in it depends on anything.
    """

    statement: str
    text: str
    value: bool | None = None
    is_constant: bool = False
    comparisons: tuple[Comparison, ...] = ()


@dataclass(frozen=True, slots=True)
class NodePattern:
    """A section of a parameter file: the *pattern* of the nodes it is for; *matches* the node that got the file, or not.

    *keys* are the names of its parameters, () where it has none or too many.
    """

    pattern: str
    location: Location
    matches: bool | None = None
    keys: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class RefusedValue:
    """Where in a parameter file that is valid YAML rcl stops: the *problem*, and *advice* what to write."""

    path: str
    line: int
    problem: str
    advice: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterFileUse(LaunchFact):
    """A parameter file given to a node (ROS 2): *node* is its full name, None where the program names itself.

    *text* is what is named, *path* the file, None if it is not known; *is_found* as in ``FileUse``. *patterns* are its sections, ()
    with *is_read* False where they cannot be read. *program* is the package and executable or class of the node. *substitutes* says that launch
    itself opens the file, for the substitutions in it. *refused* is where the node's process, which reads the file as it stands, stops;
    None also where launch reads it, or writes another one of it.
    """

    text: str
    node: str | None
    program: tuple[str, str]
    path: str | None = None
    is_found: bool | None = None
    is_read: bool = False
    patterns: tuple[NodePattern, ...] = ()
    substitutes: bool = False
    refused: RefusedValue | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ConstructUse(LaunchFact):
    """A construct of another ROS version (*kind* ``foreign``), one that is deprecated (``deprecated``), or a tag that launch passes over (``ignored``).

    *text* is the construct, *instead* what to write. *is_installed* says whether the package installs the launch file, None
    where nobody can tell; it is looked up for ``foreign`` alone. *stops* says whether launch rejects the file for it; otherwise
    it is passed over with a warning, and *matters* where the system is another one for that.
    """

    kind: str
    text: str
    instead: str = ""
    is_installed: bool | None = None
    stops: bool = True
    matters: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class PathUse(LaunchFact):
    """An absolute path, or one below a home directory, where a launch file or its YAML surely names a path.

    *kind*: ``home`` (somebody's own directory) or ``absolute``; *name* says what it is the value of.
    """

    kind: str
    text: str
    name: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class CommandUse(LaunchFact):
    """A command whose output is taken: *text* is its line, substitutions performed, ``?`` for what is not known in it."""

    text: str
