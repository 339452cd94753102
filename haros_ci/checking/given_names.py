# SPDX-License-Identifier: Apache-2.0
"""Names in the code of a node that it gives to something that is not followed: wrappers of publishers that come with other packages."""

from __future__ import annotations

import re
from collections.abc import Mapping
from weakref import WeakKeyDictionary

from haros_ci.checking.system import System, SystemNode
from haros_ci.checking.whole import Whole
from haros_ci.checking.written_names import is_written
from haros_ci.model.architecture import RemapRule
from haros_ci.regex import regex

#: Of all systems that are seen together, what _ends() found.
_FOUND: WeakKeyDictionary[Whole, Mapping[str, Mapping[str, frozenset[str]]]] = WeakKeyDictionary()
#: Of the same, by package, what _has_foreign_part() found.
_PARTS: WeakKeyDictionary[Whole, dict[str, bool]] = WeakKeyDictionary()
#: What is read of a file, and how far before a string the call that it is given to may begin.
_MOST, _BEFORE = 400_000, 400
_COMMENT = regex(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_HASH = regex(r"^[ \t]*#[^\n]*", re.MULTILINE)
#: Calls that make no topic of a string: of parameters, transforms, messages for people, nodes and paths, conversions and look-ups.
_OTHER = regex(
    r"\w*param\w*|\w*transform\w*|\w*frame\w*|(?:ROS|RCLCPP|RCUTILS)_\w+|print\w*|log\w*|info|warn\w*|error|debug|fatal|init\w*|create_node"
    r"|Node|NodeHandle|__init__|get|at|find|count|erase|open|join|format|getenv|strcmp|compare|append|push_back|split|startswith|endswith"
    r"|if|while|for|switch|return|print|assert\w*|static_assert|raise|throw|\w*_?error|\w*exception",
    re.IGNORECASE,
)
#: A variable of a class in a namespace, plain or behind a pointer; namespaces whose classes are followed, or make no topics.
_HELD = regex(
    r"\b(?<!\w::)(?:(?:std|boost)::(?:unique_ptr|shared_ptr|optional)<\s*)?((?:\w+::)+)(\w+)(?:<[^;{}()<>]{0,100}>)?[\s>]+(\w+)\s*[;({]"
)
_FOLLOWED = frozenset(
    "std ros rclcpp rclcpp_lifecycle tf tf2 tf2_ros boost Eigen message_filters image_transport sensor_msgs".split()
)
_HANDLE = r"\b{}\s*[({{][^;{{}}]{{0,200}}?\b(?:\w*nh\w*|\w*node_?handle\w*|shared_from_this\s*\(\s*\)|node_?)\s*[,)}}]"
_CALLEE = regex(r"(?<!\w)(\w+)\s*(?:<[^;(){}]{0,200}>\s*)?(?:(?<!\w)\w+\s*)?$")


def is_given_away(node: SystemNode, rule: RemapRule, system: System) -> bool:
    """Whether a source of *node* gives the name that *rule* remaps to a call of which no topic or service is known.

    Its sources are the files of its package but those that only other nodes have their topics from. A name that a file is known to use,
    in whatever node, is followed.
    """
    if system.workspace is None:
        return False
    if _has_foreign_part(node, system):
        return True
    names = {rule.source, rule.source.lstrip("/"), rule.source.removeprefix("~/"), rule.source.removeprefix("~")}
    if is_written(node, {name.strip("/") for name in names if name.strip("/")}, system):
        return True
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


def _has_foreign_part(node: SystemNode, system: System) -> bool:
    """Whether the package of *node* gives a node handle to an object whose class no file of the workspace defines: it has topics of its own."""
    key = node.package
    kept = _PARTS.setdefault(system.whole, {})
    if key not in kept and system.workspace is not None:
        files = [file for file in system.workspace.files if file.package == node.package and file.language == "cpp"]
        texts = [_COMMENT.sub("", system.workspace.text(file.path)[:_MOST]) for file in files]
        held = {(match[2], match[3]) for text in texts for match in _HELD.finditer(text) if _is_foreign(match[1])}
        kinds = {kind for kind, name in held if any(re.search(_HANDLE.format(re.escape(name)), text) for text in texts)}
        kept[key] = bool(kinds) and not kinds <= _defined(kinds, system)
    return kept.get(key, False)


def _is_foreign(namespace: str) -> bool:
    first = namespace.partition("::")[0]
    return first not in _FOLLOWED and not first.endswith(("_msgs", "_srvs", "_interfaces"))


def _defined(names: set[str], system: System) -> set[str]:
    """Those of the class *names* that a file of the workspace defines or declares."""
    found: set[str] = set()
    for file in system.workspace.files if system.workspace is not None else ():
        if file.language == "cpp" and len(found) < len(names):
            text = system.workspace.text(file.path)[:_MOST] if system.workspace is not None else ""
            found |= {
                name
                for name in names - found
                if name in text and re.search(rf"\b(?:class|struct)\s[^;(){{}}]{{0,100}}\b{re.escape(name)}\b", text)
            }
    return found


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
