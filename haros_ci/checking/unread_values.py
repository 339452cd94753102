# SPDX-License-Identifier: Apache-2.0
"""Arguments and values of launch files that nobody reads: of ROS 1 arguments that are given on to parameters of nodes alone, of which no code has the name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from weakref import WeakKeyDictionary

from haros_ci.checking.given import Given
from haros_ci.checking.system import System
from haros_ci.checking.whole import Whole
from haros_ci.model.launch_facts import ArgumentDeclaration, FileUse
from haros_ci.model.location import Location
from haros_ci.regex import regex

#: Files of code that are looked at; where there are more, nothing is known.
_MOST = 3_000
#: Uses of an argument that are looked at.
_MOST_USES = 20
_PARAM = regex(r"<param\b([^<>]{0,1000})>")
_NAME = regex(r"""\bname\s*=\s*["']([\w/~]{1,200})["']""")
_NODE = regex(r"""<(/?)node\b([^<>]{0,2000}?)(/?)>""")
_PACKAGE = regex(r"""\bpkg\s*=\s*["']([\w-]{1,200})["']""")
_WORD = regex(r"[A-Za-z_]\w*")
_COMMENT = regex(r"<!--.*?(?:-->|\Z)", re.DOTALL)
#: What may use an argument without ``$(arg …)``.
_OTHERWISE = regex(r"\$\(eval\b|\bpass_all_args\b")

#: What launch files of ROS 2 are called, how many of them one may name, what declares an argument, and what has them all in Python.
_FILE = regex(r"[\w.-]+")
_LAUNCHES = (".py", ".xml", ".yaml", ".yml", ".launch")
_MOST_NAMED = 50
_DECLARED = regex(r"""(?:\bDeclareLaunchArgument\(\s*(?:name\s*=\s*)?|<arg\s+name\s*=\s*)["']([\w-]{1,200})["']""")
_BY_NAME = "launch_configurations"

#: The words of all code, by what is known of the whole workspace.
_words: WeakKeyDictionary[Whole, frozenset[str]] = WeakKeyDictionary()
#: The parameters that nodes are given, by their places, for each system.
_places: WeakKeyDictionary[System, dict[tuple[Location, str], list[Given]]] = WeakKeyDictionary()


def unread_parameter(system: System, path: str, argument: str) -> str:
    """The parameter that alone is given the launch *argument* of the file at *path*, and whose name no code of the workspace has; "" if there is none, or it may be read."""
    if system.workspace is None or not re.fullmatch(r"[\w-]+", argument):
        return ""
    text = _COMMENT.sub("", system.workspace.text(path))
    read = re.compile(rf"\$\(arg[ \t]+{re.escape(argument)}[ \t]*\)")
    uses = sum(1 for _ in read.finditer(text))
    given = [found for found in _PARAM.finditer(text) if read.search(found[1])]
    if not 0 < uses <= _MOST_USES or len(given) != uses or _OTHERWISE.search(text):
        return ""
    names: set[str] = set()
    for found in given:
        name = _NAME.search(found[1])
        if name is None or not _is_of_ours(system, text, found.start()):
            return ""
        names.add(name[1].rpartition("/")[2].lstrip("~"))
    name_of_all = names.pop() if len(names) == 1 else ""
    return name_of_all if name_of_all and not _is_in_code(system, name_of_all) else ""


def is_unread_argument(system: System, path: str, name: str) -> bool:
    """Whether neither the launch file of ROS 2 at *path*, which declares the argument *name*, nor a launch file that its text names reads it."""
    if system.workspace is None:
        return False
    text = system.workspace.text(path)
    declared = [fact for fact in system.facts(ArgumentDeclaration) if (fact.location.path, fact.name) == (path, name)]
    if len(declared) != 1 or declared[0].is_used or _BY_NAME in text or _times(text, name) != 1:
        return False
    if all(found[1] != name for found in _DECLARED.finditer(text)):
        return False  # a name that a variable has may be read by the variable, too
    words = {word for word in _FILE.findall(text) if word.endswith(_LAUNCHES)}
    named = [other for word in sorted(words) for other in system.whole.files_by_name.get(word, ()) if other != path]
    if len(named) > _MOST_NAMED:
        return False
    return not any(
        _times(other_text, name) or _BY_NAME in other_text for other_text in map(system.workspace.text, named)
    )


def is_undeclared_value(system: System, use: FileUse) -> bool:
    """Whether the file is named only by the value of a parameter that no node of ROS 2 which is given it declares: nothing reads it."""
    if use.kind != "value" or use.ros != 2 or not use.name:
        return False
    places = _places.get(system)
    if places is None:
        places = _places[system] = {}
        for parameter in system.given:
            places.setdefault(parameter.place, []).append(parameter)
    given = places.get((use.location, use.name), ())
    return bool(given) and all(parameter.node.names.has(parameter.key) is False for parameter in given)


def _times(text: str, name: str) -> int:
    """How often a launch file has the name of an argument as a text of its own, or reads it in a substitution."""
    return sum(
        1 for _ in re.finditer(rf"""(?<=["']){re.escape(name)}(?=["'])|\$\(var\s+{re.escape(name)}\s*\)""", text)
    )


def _is_of_ours(system: System, text: str, place: int) -> bool:
    """Whether the tag at *place* is in one of a node of a package of the workspace."""
    around = None
    for found in _NODE.finditer(text, 0, place):
        around = None if found[1] or found[3] else found[2]
    package = _PACKAGE.search(around) if around is not None else None
    return package is not None and package[1] in system.packages


def _is_in_code(system: System, name: str) -> bool:
    """Whether any code of the workspace has the word *name*; where there is too much of it, or none, it may."""
    words = _words.get(system.whole)
    if words is None:
        words = _words[system.whole] = frozenset(_words_of(system))
    return not words or name in words


def _words_of(system: System) -> Iterator[str]:
    """The words of all code of the workspace; none where there is too much of it."""
    workspace = system.workspace
    if workspace is None:
        return
    paths = [file.path for file in workspace.files if file.language in ("cpp", "python")]
    for path in paths if len(paths) <= _MOST else ():
        yield from _WORD.findall(workspace.text(path))
