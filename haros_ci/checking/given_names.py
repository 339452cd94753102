# SPDX-License-Identifier: Apache-2.0
"""Names in the code of a node that it gives to something that is not followed: wrappers of publishers that come with other packages."""

from __future__ import annotations

import re
from collections.abc import Mapping
from weakref import WeakKeyDictionary

from haros_ci.checking.system import System, SystemNode
from haros_ci.checking.whole import Whole
from haros_ci.model.architecture import RemapRule

#: Of all systems that are seen together, what _ends() found.
_FOUND: WeakKeyDictionary[Whole, Mapping[str, Mapping[str, frozenset[str]]]] = WeakKeyDictionary()
#: What is read of a file, and how far before a string the call that it is given to may begin.
_MOST, _BEFORE = 400_000, 400
_COMMENT = re.compile(r"//[^\n]*|/\*.{0,4000}?\*/", re.DOTALL)
_HASH = re.compile(r"^[ \t]*#[^\n]*", re.MULTILINE)
#: Calls that make no topic of a string: of parameters, transforms, messages for people, nodes and paths, conversions and look-ups.
_OTHER = re.compile(
    r"\w*param\w*|\w*transform\w*|\w*frame\w*|(?:ROS|RCLCPP|RCUTILS)_\w+|print\w*|log\w*|info|warn\w*|error|debug|fatal|init\w*|create_node"
    r"|Node|NodeHandle|__init__|get|at|find|count|erase|open|join|format|getenv|strcmp|compare|append|push_back|split|startswith|endswith"
    r"|if|while|for|switch|return|print|assert\w*|static_assert|raise|throw|\w*_?error|\w*exception",
    re.IGNORECASE,
)
_CALLEE = re.compile(r"(\w+)\s*(?:<[^;(){}]{0,200}>\s*)?(?:\w+\s*)?$")


def is_given_away(node: SystemNode, rule: RemapRule, system: System) -> bool:
    """Whether a source of *node* gives the name that *rule* remaps to a call of which no topic or service is known.

    Its sources are the files of its package but those that only other nodes have their topics from. A name that a file is known to use,
    in whatever node, is followed.
    """
    if system.workspace is None:
        return False
    names = {rule.source, rule.source.lstrip("/"), rule.source.removeprefix("~/"), rule.source.removeprefix("~")}
    ends = _ends(system.whole)
    own = set(ends.get(node.type, ()))
    others = {path for files in ends.values() for path in files} - own
    for file in system.workspace.files:
        if file.package != node.package or file.language not in ("cpp", "python") or file.path in others:
            continue
        text = system.workspace.text(file.path)[:_MOST]
        followed = {name for files in ends.values() for name in files.get(file.path, ())}
        for name in names:
            if name and name in text and name.rpartition("/")[2] not in followed and _is_argument(name, text):
                return True
    return False


def _ends(whole: Whole) -> Mapping[str, Mapping[str, frozenset[str]]]:
    """By type of node the files that its ends stand in, each with the last parts of the names that it uses there."""
    if whole not in _FOUND:
        found: dict[str, dict[str, frozenset[str]]] = {}
        for system in whole.systems:
            for end in system.ends:
                if end.in_source:
                    files = found.setdefault(end.node.type, {})
                    name = end.original_name.rpartition("/")[2]
                    files[end.location.path] = files.get(end.location.path, frozenset()) | {name}
        _FOUND[whole] = found
    return _FOUND[whole]


def _is_argument(name: str, text: str) -> bool:
    """Whether *text* has the string *name* as an argument of a call that may make a topic."""
    plain = _HASH.sub("", _COMMENT.sub("", text))
    for found in re.finditer(rf"(?<=[(,{{=\s])[\"']{re.escape(name)}[\"']\s*[,)}}]", plain):
        before = plain[max(found.start() - _BEFORE, 0) : found.start()]
        depth = 0
        for at in range(len(before) - 1, -1, -1):
            letter = before[at]
            if letter in ";":
                break
            if letter in ")}":
                depth += 1
            elif letter in "({":
                depth -= 1
                if depth < 0:
                    called = _CALLEE.search(before[max(at - 250, 0) : at])
                    if called is not None and not _OTHER.fullmatch(called[1]):
                        return True
                    break
    return False
