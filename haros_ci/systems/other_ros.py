# SPDX-License-Identifier: Apache-2.0
"""The ROS whose client library a program uses: it decides where the manifest of the package does not, and what is of the other ROS is named.

A program of the other ROS than its package cannot be followed as one of the package (rclpy.readthedocs.io and wiki.ros.org/rospy share no
call), but people run it: ``python3 path/of/script.py`` asks for no manifest.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from haros_ci.follow.follow import Entry
from haros_ci.index.index import Source, is_test
from haros_ci.model.workspace import Problem
from haros_ci.systems.entries import Programs

#: Client libraries by the module that a Python program imports, and by the directory of the headers that one of C++ includes.
CLIENTS = {"rospy": 1, "rclpy": 2}
HEADERS = {"ros": 1, "rclcpp": 2, "rclcpp_action": 2, "rclcpp_components": 2, "rclcpp_lifecycle": 2}


def client_of(programs: Programs, source: Source) -> int | None:
    """The version of ROS whose client library a program uses, one of C++ also by the workspace's headers; None for both or neither."""
    if source.program.language == "python":
        found = {CLIENTS.get(alias.type.name.partition(".")[0]) for alias in source.program.aliases}
    else:
        paths = (source.path, *programs.cpp.reach(source.path))
        sources = (programs.cpp.sources[path] for path in paths if path in programs.cpp.sources)
        includes = (include for one in sources for include in one.program.includes)
        found = {HEADERS.get(_directory(include)) for include in includes}
    found -= {None}
    return found.pop() if len(found) == 1 else None


def _directory(include: str) -> str:
    """The directory of a header of a library: ``ros`` of ``<ros/ros.h>``."""
    return include.strip('<>" ').partition("/")[0]


def left_out(
    programs: Programs,
    tables: Iterable[Mapping[tuple[str, str], tuple[Entry, frozenset[str]]]],
    versions: Mapping[str, int | None],
) -> dict[str, int]:
    """Of the *tables* of node types the files that use the client library of the other ROS than their package is of, with that ROS."""
    found: dict[str, int] = {}
    for table in tables:
        for (package, _), (entry, _) in table.items():
            version, source = versions.get(package), entry.source
            if version is not None and source.path not in found and not is_test(source.path):
                client = client_of(programs, source)
                if client is not None and client != version:
                    found[source.path] = client
    return found


def problems(lost: Collection[tuple[str, int]]) -> Iterator[Problem]:
    """One problem for each ROS whose programs, by path, are *lost* in packages of the other."""
    for ros in (1, 2):
        paths = sorted({path for path, client in lost if client == ros})
        if paths:
            others = len(paths) - 1
            what = f"this program and {others} more use" if others else "this program uses"
            whose = "their packages are" if others else "its package is"
            yield Problem(
                paths[0],
                f"{what} the client library of ROS {ros}, but {whose} taken for ROS {3 - ros} (package.xml): "
                "what such nodes publish and subscribe to is not in the model",
            )
