# SPDX-License-Identifier: Apache-2.0
"""What a node is given from outside, and what the exact tier tells of its calls: it stays as it is meanwhile."""

from __future__ import annotations

from collections.abc import Callable as Function_
from collections.abc import Mapping
from itertools import combinations

from haros_ci.follow.made import MadeEntity
from haros_ci.graph.parameters import YamlFiles
from haros_ci.graph.ros2_process import Process
from haros_ci.graph.words import PART
from haros_ci.index.behavior_tree_files import TreeFiles
from haros_ci.index.plugins import PluginDescription
from haros_ci.index.xml_files import XmlFileReader
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field
from haros_ci.values.abstract import Known, Opaque, Value
from haros_ci.values.given import Marks

#: From a call's place, the last part of its function's name and the number of its arguments to the arguments' types and
#: values and the template arguments' types, each None where it is not known.
Exact = Function_[
    [str, int, int, str, int], tuple[tuple[tuple[str | None, object], ...], tuple[str | None, ...]] | None
]

#: Why a word of the command line is not known.
NO_WORD = "a part of the command line is not known"
#: What roslaunch may add to the words of a node (wiki.ros.org/roslaunch/XML/node), and launch_ros (launch_ros/actions/node.py).
ADDED: tuple[tuple[str, ...], ...] = ((), ("__name:=x", "__log:=/x"), ("x:=y", "__name:=x", "__log:=/x"))
_FLAGS = ("-r", "-p", "--params-file", "--log-level")
ADDED_BY_LAUNCH: tuple[tuple[str, ...], ...] = (
    (),
    *(
        ("--ros-args", *(word for flag in flags for word in (flag, "x")))
        for number in range(len(_FLAGS) + 1)
        for flags in combinations(_FLAGS, number)
    ),
)


@dataclass(slots=True)
class Context:
    """What the node is given from outside: its names, its arguments, the parameter server, files of the workspace."""

    name: str
    namespace: str
    arguments: tuple[str, ...] | None
    #: Whether a launch file starts the node, which adds words to its command line.
    is_launched: bool = field(default=False, kw_only=True)
    #: Whether *parameter* knows what is set below the node's name, though a part of that is not known.
    has_own: bool = field(default=False, kw_only=True)
    #: The classes that pluginlib can load, by look-up name: where they are defined.
    plugins: Mapping[str, PluginDescription]
    #: Where a node is followed for all that its plug-ins could make: the workspace's plug-ins by base class.
    of_base: Mapping[str, tuple[PluginDescription, ...]] | None = field(default=None, kw_only=True)
    #: The look-up names of all plug-ins of a base class, where all of them are the workspace's.
    declared: Mapping[str, tuple[str, ...]] = field(default_factory=dict, kw_only=True)
    #: Behaviour trees in files of the workspace; None where nothing makes any.
    trees: TreeFiles | None = field(default=None, kw_only=True)
    #: The workspace's XML files and directories; None in ROS 1.
    xml: XmlFileReader | None = field(default=None, kw_only=True)
    #: Whether all of them are followed where it is not known which is created.
    any_tree: bool = field(default=False, kw_only=True)
    #: The value of a parameter that the configuration sets (a Choice if under a condition), None if it does not.
    parameter: Function_[[str], Value | None]
    #: The YAML files of the workspace by their paths as values have them.
    read_yaml: YamlFiles
    #: The pointed-to remapping of an absolute name.
    remap: Function_[[str], str] = lambda name: name
    #: The remappings of absolute names.
    remaps: Mapping[str, str] = field(default_factory=dict)
    #: What the nodelet of a look-up name makes, under a full name and in the namespace above, as part of the node; and
    #: why that may not be all. None if the nodelet is not known. *loaded* are those asked for so far.
    nodelet: Function_[
        [str, str, str, Function_[[str], Value | None]], tuple[tuple[MadeEntity, ...], Mapping[str, Location]] | None
    ] = lambda look_up, name, above, parameter: None
    loaded: list[str] = field(default_factory=list)
    #: The process that a nodelet is loaded into; the node itself otherwise.
    process_name: str = ""
    process_namespace: str = "/"
    #: Whether the remappings are those of the process; a nodelet's are its own, and not those of its manager.
    remaps_process: bool = field(default=True, kw_only=True)
    #: What a ROS 2 process is given; None in ROS 1.
    process: Process | None = None
    #: What of it stands in what is made by a mark.
    marks: Marks = field(default_factory=Marks)
    #: Whether to stop at the first name that the node gives itself (a value, and whether it is made anonymous).
    renames: Function_[[Value, bool | None], bool] = lambda name, anonymous: False

    def words(self) -> list[Value]:
        """The words of the command line behind the program's name; none where they are not known."""
        return [Opaque(NO_WORD) if PART in word else Known(word) for word in self.arguments or ()]

    def own_words(self) -> list[str] | None:
        """The words that a launch file gives to the program; None where they are not known, or nothing starts it."""
        words = self.arguments if self.is_launched else None
        return None if words is None or any(PART in word for word in words) else list(words)

    def words_by_hand(self) -> list[Value] | None:
        """The words of a program that nothing starts: there are none; None of one that a launch file starts."""
        return [] if not self.is_launched and self.arguments == () else None

    def added(self) -> tuple[tuple[str, ...], ...]:
        """What launch may add behind these words, beginning with nothing."""
        return ADDED if self.process is None else ADDED_BY_LAUNCH

    def is_asked(self, name: str) -> bool:
        """Whether it is known which parameter a full name is: all of it is, or all that stands behind the node's own name."""
        return "?" not in name or (
            self.has_own and name.startswith(f"{self.name}/") and "?" not in name[len(self.name) :]
        )
