# SPDX-License-Identifier: Apache-2.0
"""Tags of launch files of ROS 1 that roslaunch passes over with a warning."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, System
from haros_ci.api.launch import ConstructUse, included_by

#: The tags of roslaunch (wiki.ros.org/roslaunch/XML), and those that another one takes (roslaunch/xmlloader.py).
_TAGS = ("arg", "env", "group", "include", "launch", "machine", "node", "param", "remap", "rosparam", "test")
_TAKES = {"include": "<arg> and <env>", "node": "<env>, <param>, <remap> and <rosparam>", "machine": "no tag"}
#: What is lost, and what to do.
_LOST = {
    "param": "the parameter is not set",
    "rosparam": "the parameters are not set",
    "remap": "the name is not remapped",
    "node": "the node is not started",
    "include": "the file is not included",
    "arg": "the argument is not set",
    "env": "the variable is not set",
}
_BEFORE = ("remap", "arg", "env")


def check(system: System) -> Iterator[Finding]:
    for use in system.facts(ConstructUse):
        message = _message(use) if use.kind == "ignored" else ""
        if message:
            yield Finding(
                at=use.location,
                message=message,
                about=(use.location.path, use.text, use.instead),
                apart=(use.text, use.instead),
                flow=included_by(use),
            )


def _message(use: ConstructUse) -> str:
    """What is wrong with an ignored tag; "" where it is not known what is meant by it."""
    name = use.text
    if use.instead:
        takes = _TAKES.get(use.instead, _TAKES["node"])
        lost = f": {_LOST[name]}" if name in _LOST else ""
        place = f"before the <{use.instead}>" if name in _BEFORE else f"out of the <{use.instead}>"
        if name == "arg" or name not in _LOST:
            todo = "remove it"
        elif use.instead == "include" and name in ("param", "rosparam"):
            todo = f"move it {place}, with the namespace that its node has"
        else:
            todo = f"move it {place}"
        return f"<{name}> inside of <{use.instead}>, which takes {takes} alone, is ignored by roslaunch{lost}; {todo}"
    meant = get_close_matches(name.lower(), _TAGS, 1, 0.75)
    if not meant or name.lower().endswith(meant[0]):  # <anode>: that is how some switch a tag off
        return ""
    lost = _LOST.get(meant[0], "what is in it has no effect")
    return f"roslaunch knows no tag <{name}> and ignores it: {lost}; write <{meant[0]}>"


CHECK = Check(
    id="ignored-launch-tag",
    summary="Tag of a launch file that roslaunch ignores where it stands.",
    level=Level.WARNING,
    tags=("launch",),
    run=check,
)
