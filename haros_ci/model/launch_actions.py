# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch files as one representation, whatever their dialect: actions, with phrases of text and substitutions.

XML and YAML files are read into it by ``extract/launch``; Python files are interpreted into it by ``link``. Nothing in it is
resolved: it says what the launch description says. ``link`` performs it in a context of launch configurations.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol, Union

from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

#: What ``find-pkg-share``, ``find-pkg-prefix`` and ``dirname`` give: text that stands for a directory, wherever it will be.
#: ``$(find-pkg-share pkg)/config/x.yaml`` is a path as any other text; only reading a file asks where it is.
SHARE = "$(find-pkg-share {})"
PREFIX = "$(find-pkg-prefix {})"
#: A directory of the workspace by its root-relative path, for ``dirname`` and Python's ``__file__``.
WORKSPACE = "$(workspace {})"


@dataclass(frozen=True, slots=True)
class Performed:
    """A phrase in a context: its *text*, with ``?`` for each part that is not known, and the first *reason*, "" if all is."""

    text: str
    reason: str = ""
    location: Location | None = None

    @property
    def known(self) -> bool:
        return not self.reason


class LaunchContext(Protocol):
    """What an OpaqueFunction may ask of the launch context that it runs in."""

    def perform(self, phrase: Phrase) -> Performed: ...

    def configuration(self, name: str) -> Performed | None:
        """A launch configuration; None if nothing has set it."""
        ...

    def names_of_configurations(self) -> tuple[str, ...] | None:
        """The launch configurations that are set; None if there may be others."""
        ...

    def set_configuration(self, name: str, value: Performed) -> None: ...

    def set_any_configuration(self) -> None:
        """Something may have been set under a name that is not known."""
        ...

    def test(self, test: Test) -> bool | None:
        """Whether a condition holds; None if that is not known."""
        ...


@dataclass(frozen=True, slots=True)
class Substitution:
    """A part of a text that the context fills in. *kind* is the word of the XML dialect (``$(var x)`` is ``var``):

    var, env, find-pkg-share, find-pkg-prefix, exec-in-pkg, find-exec, eval, command, anon, dirname, filename,
    file-content, log_dir, launch_log_dir, param, not, and, or, any, all, equals, not-equals, if; of Python alone
    ``join`` (PathJoinSubstitution: its arguments as parts of a path), ``rewritten`` (RewrittenYaml: *data* says how), ``xacro``
    (its functions: the file, then each argument as ``name:=value``) and ``moveit`` (MoveItConfigsBuilder). ``?`` is one that cannot be known: *reason* says why. *arguments* are phrases.
    """

    kind: str
    arguments: tuple[Phrase, ...] = ()
    location: Location | None = None
    reason: str = ""
    data: Any = None


#: A text: literal parts and substitutions in turn; () is the empty text.
Phrase = tuple[Union[str, Substitution], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Test:
    """What an action's ``if``, ``unless`` or ``condition=`` asks.

    *kind* is ``if`` or ``unless`` (*phrases* is one text that must be a boolean), ``equals`` or ``not-equals`` (a launch
    configuration's name, then the value expected), or ``?`` (*reason*). *text* is the condition as written, *location* its place.
    """

    kind: str
    phrases: tuple[Phrase, ...] = ()
    text: str = ""
    location: Location | None = None
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterSource:
    """One source of a node's parameters, in the order given.

    *kind* is ``file`` (*path*; with *substitutes* substitutions inside the YAML are performed, ``allow_substs``), ``values``
    (*values*: pairs of a dotted name phrase and a value) or ``?`` (*reason*). A value is a phrase (text to be read as YAML,
    unless *types* names its type: bool, int, float, str and ``…_array``), plain data (None, bool, int, float, str, list, as the
    code has it), or a tuple of such. ``ParameterValue(x, value_type=str)`` gives its name in *types*. Values that are an
    *argument* (``Parameter(name, value)``) are given as ``-p name:=value``, for any node of the process.
    """

    kind: str
    location: Location
    path: Phrase = ()
    substitutes: bool = False
    values: tuple[tuple[Phrase, Any], ...] = ()
    types: tuple[tuple[str, str], ...] = ()
    argument: bool = False
    reason: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Action:
    """Something that a launch description does. *kind*:

    arg                 declares ``name`` with ``default`` (absent: it must be given), ``choices``
    let, set-env, append-env, unset-env      ``name``, ``value``;   reset (clears configurations), reset-env
    group               *children*; ``scoped`` and ``forwarding`` phrases (default true)
    include             ``file``; *arguments* are pairs of phrases
    node, lifecycle-node, container          ``package``, ``executable``, ``name``, ``namespace``, ``args``, ``ros_args``, ``exec_name``,
                        ``launch-prefix``, ``respawn``; *parameters*, *remaps*, *environment*; a container's *children* are
                        its ``component`` actions; a ``handle`` tells it from others that are made in the same place
    component           of a container or load: ``package``, ``plugin``, ``name``, ``namespace``; *parameters*, *remaps*
    load                load_composable_node: ``target`` (container's name) or the container's ``handle``, *children* are components
    executable          ``cmd``
    push-namespace ``namespace``   set-remap (*remaps*)   set-parameter (*parameters*, kind values)
    set-parameters-from-file (*parameters*, kind file)   set-use-sim-time (``value``)
    event               *children* are done when something happens (a process ends, a timer): they are conditional
    opaque              *function* is called with the context (OpaqueFunction) and returns more actions
    written             the launch file writes the file ``path`` itself: its ``content``, or the *reason* why that is not known
    list                *children* one after the other, without scope (a LaunchDescription as an action)
    shutdown, log       of no consequence
    ?                   what it does is not known: *reason*

    *phrases* are pairs of an attribute's name and its phrase. *deferred* is the text of the event for ``event``. *deprecated*
    are spellings that launch has given up, each with what to write instead.
    """

    kind: str
    location: Location
    phrases: tuple[tuple[str, Phrase], ...] = ()
    children: tuple[Action, ...] = ()
    arguments: tuple[tuple[Phrase, Phrase], ...] = ()
    parameters: tuple[ParameterSource, ...] = ()
    remaps: tuple[tuple[Phrase, Phrase, Location], ...] = ()
    environment: tuple[tuple[Phrase, Phrase], ...] = ()
    tests: tuple[Test, ...] = ()
    function: Callable[[LaunchContext], tuple[Action, ...]] | None = field(default=None, compare=False)
    reason: str = ""
    deferred: str = ""
    deprecated: tuple[tuple[str, str], ...] = ()

    def get(self, name: str) -> Phrase | None:
        """The phrase of attribute *name*; None if it is not there."""
        return next((phrase for key, phrase in self.phrases if key == name), None)


@dataclass(frozen=True, slots=True, kw_only=True)
class Description:
    """A launch file's actions in order; *problems* are pairs of a line and what is wrong with it.

    *foreign* are constructs of ROS 1: place, text, and what to write instead.
    """

    actions: tuple[Action, ...] = ()
    foreign: tuple[tuple[Location, str, str], ...] = ()
    problems: tuple[tuple[int, str], ...] = ()
