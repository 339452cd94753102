# SPDX-License-Identifier: Apache-2.0
"""Following a ROS 2 process, unless it has been followed before with all that it looks at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from haros_ci.follow.context import Context
from haros_ci.follow.follow import Entry
from haros_ci.follow.ros import behavior_trees
from haros_ci.graph.given_parameters import Parameters
from haros_ci.graph.names import clean
from haros_ci.graph.ros2_process import Process, RemappingRule
from haros_ci.keeping.kept import Followed, digest_of
from haros_ci.model.architecture import Node, RemapRule
from haros_ci.model.workspace import Problem
from haros_ci.records import dataclass
from haros_ci.systems import sharing
from haros_ci.systems.following import Types, files_key, followed_in
from haros_ci.values.abstract import Known, Value
from haros_ci.values.given import Marks
from haros_ci.values.marks import PARAMETER, filled

#: Steps that may go into one program, however many times and ways it is started.
OF_ONE_PROGRAM = 500_000
TOO_OFTEN = "the program is large and started with many different parameters: it is followed for the first ones, for others what it makes is not known"


@dataclass(frozen=True, slots=True)
class Started:
    """A process or component as it is started: its remapping rules, parameters, words of its command line."""

    rules: tuple[RemappingRule, ...]
    parameters: Parameters
    words: tuple[str, ...]
    is_component: bool
    #: The remapping rules of launch files, with the places they stand at.
    written: tuple[RemapRule, ...] = ()
    #: The rules of the container that a component is loaded into.
    around: tuple[RemappingRule, ...] = ()
    #: Whether every plug-in that it could load is followed.
    has_plugins: bool = False
    #: Whether, of a behaviour tree that is not known, the nodes of every tree of the workspace are.
    has_trees: bool = False
    #: Whether a launch file starts it: launch adds words to its command line.
    is_launched: bool = False


def run_process(types: Types, entry: Entry, files: frozenset[str], started: Started, node: Node) -> Followed:
    """Follow one process, unless it has been followed with the same rules and all that it asked for is the same again.

    With the nodes of every behaviour tree it is followed only where it creates one that is not known without them.
    """
    if started.has_trees:
        plain = run_process(types, entry, files, replace(started, has_trees=False), node)
        if behavior_trees.UNKNOWN not in plain.gaps and not plain.problems:
            return plain
    (rules, around), names, instead = sharing.without_names(started.rules, started.around)
    found = _shared(types, entry, files, replace(started, rules=rules, around=around), node, names, instead)
    if found is None:
        found = _shared(types, entry, files, started, node, {}, {}, is_exact=True)
    assert found is not None
    return found


def _shared(
    types: Types,
    entry: Entry,
    files: frozenset[str],
    started: Started,
    node: Node,
    names: Mapping[str, str],
    instead: Mapping[RemappingRule, RemappingRule],
    *,
    is_exact: bool = False,
) -> Followed | None:
    """A process followed with marks for *names* and parameters, put under those that it has; None where marks hide what is the same.

    Where it *is_exact* there are no marks.
    """
    kinds = (
        started.is_component,
        started.has_plugins,
        started.has_trees,
        started.around,
        started.is_launched,
        is_exact,
    )
    key = (2, entry.key, files_key(files), started.rules, started.words, *kinds)
    earlier = types.followed.setdefault(key, [])
    marks = Marks(names)

    @cache  # what was followed with other parameters asks for much the same
    def parameter(full: str) -> Value | None:
        if full in names:
            return Known(names[full])
        name, _, inner = filled(full, names).partition(":")
        return started.parameters.get(clean(name) if name else name, inner, node.conditions)

    counted = types.counted.setdefault((entry.key, started.has_plugins), {})
    is_over = sum(counted.values()) > OF_ONE_PROGRAM
    for done in earlier:
        if sharing.fits(done, names, parameter):
            digest = _digest(types, key, done)
            if is_over and digest not in counted:
                break  # what an earlier run has followed; this one would not
            counted[digest] = types.used[digest] = done.steps
            return _put_under(types, done, names, instead, parameter)
    if is_over:
        return Followed((), (Problem(entry.source.path, TOO_OFTEN),), (), {}, {})
    requested: dict[str, Value | None] = {}
    provided: dict[str, Value | None] = {}

    def ask(name: str) -> Value | None:
        if PARAMETER in name and not name.partition(":")[2].startswith("qos_overrides."):
            name = marks.looked_at(name)
        if name not in requested:
            value = parameter(marks.real(name))
            requested[name] = value
            provided[name] = value if is_exact else marks.given(name, f"p{len(requested) - 1}", value)
        return provided[name]

    is_component = started.is_component
    words = None if any("?" in word for word in started.words) else started.words
    context = Context(
        marks=marks,
        name="",
        namespace="/",
        arguments=words,
        is_launched=started.is_launched,
        plugins=types.plugins,
        declared=types.declared,
        of_base=types.of_base if started.has_plugins else None,
        trees=types.trees,
        any_tree=started.has_trees,
        xml=types.xml,
        parameter=ask,
        read_yaml=types.read_yaml,
        process=Process(
            rules=started.around if is_component else started.rules, component=started.rules if is_component else None
        ),
    )
    done = followed_in(types, entry, files, context, requested, key)
    earlier.append(done)
    digest = _digest(types, key, done)
    counted[digest] = types.used[digest] = done.steps
    return _put_under(types, done, names, instead, parameter)


def _put_under(
    types: Types,
    done: Followed,
    names: Mapping[str, str],
    instead: Mapping[RemappingRule, RemappingRule],
    parameter: Callable[[str], Value | None],
) -> Followed | None:
    """``sharing.put_under``, once for the same names, rules and values."""
    values = sharing.unseen(done, names, parameter)
    key = (id(done), tuple(names.items()), tuple(instead.items()), values)
    if key not in types.put:
        types.put[key] = (done, sharing.put_under(done, names, instead, parameter))
    return types.put[key][1]


def _digest(types: Types, key: Any, done: Followed) -> str:
    """What *done* is known by, made once."""
    if id(done) not in types.digests:
        types.digests[id(done)] = (done, digest_of(key, *done.asked.items(), *done.answers))
    return types.digests[id(done)][1]
