# SPDX-License-Identifier: Apache-2.0
"""One program started under several names and with several parameters: what was followed once, put under each of them.

In what ``follow`` gives, marks stand for names and values that the program has never looked at (``values.given``). A result is used again
where all that it did look at is the same; then the marks are replaced by what this one is given.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from operator import is_not
from typing import Any

from haros_ci.follow.made import MadeEntity
from haros_ci.follow.twins import Twin
from haros_ci.graph.names import clean
from haros_ci.graph.ros2_process import NAMES, SPACES, RemappingRule, RosNode
from haros_ci.keeping.kept import Followed
from haros_ci.regex import regex
from haros_ci.systems.following import same
from haros_ci.values.abstract import Known, Value
from haros_ci.values.given import AsGiven, Unseen, shape
from haros_ci.values.marks import BEGIN, END, PARAMETER, filled

_NAME = regex(r"[A-Za-z]\w{0,100}", re.ASCII)
_SPACE = regex(r"/|/?[A-Za-z][\w/]{0,100}", re.ASCII)

Rules = tuple[RemappingRule, ...]


def without_names(*groups: Rules) -> tuple[tuple[Rules, ...], dict[str, str], dict[RemappingRule, RemappingRule]]:
    """Rules with marks for the names that they give, the text of each mark's key, and the rule that each new one is for.

    Where a rule is for one node alone all stay as they are: which one that is depends on the names.
    """
    texts: dict[str, str] = {}
    instead: dict[RemappingRule, RemappingRule] = {}
    if any(rule.node for group in groups for rule in group):
        return groups, texts, instead
    found = []
    for group in groups:
        rules = []
        for rule in group:
            made = rule
            if rule.source in NAMES and _NAME.fullmatch(rule.target):
                key = f"n{len(texts)}"
                texts[key], made = rule.target, replace(rule, target=f"{BEGIN}{key}{END}")
            elif rule.source in SPACES and _SPACE.fullmatch(rule.target):
                key = f"s{len(texts)}"
                texts[key], made = clean(rule.target), replace(rule, target=f"/{BEGIN}{key}{END}")
            instead[made] = rule
            rules.append(made)
        found.append(tuple(rules))
    return tuple(found), texts, instead


Give = Callable[[str], "Value | None"]


def fits(followed: Followed, names: Mapping[str, str], provided: Give) -> bool:
    """Whether a result is that for *names* and the parameters *provided*: what was looked at is the same, what was not is of the same shape and has the same answers."""
    texts, values = dict(names), dict[str, Any]()
    for name, now, before in _asked(followed, texts, provided):
        if isinstance(before, Unseen):
            if shape(now) != before.shape:
                return False
        elif not same(now, before):
            return False
        values[name] = now.value if isinstance(now, Known) else None
    return all(answer.holds(texts, values.get) for answer in followed.answers)


def _asked(followed: Followed, texts: dict[str, str], provided: Give) -> Iterator[tuple[str, Value | None, Any]]:
    """The names of the parameters that were asked for, what they are given now and what they were; *texts* get those that are texts."""
    for number, (name, before) in enumerate(followed.asked.items()):
        now = provided(filled(name, texts) if PARAMETER in name else name)
        if isinstance(now, Known) and isinstance(now.value, str):
            texts[f"p{number}"] = now.value
        yield name, now, before


def unseen(followed: Followed, names: Mapping[str, str], provided: Give) -> tuple[Any, ...]:
    """What is *provided* for the parameters that were not looked at, in order."""
    found = _asked(followed, dict(names), provided)
    return tuple(
        (now.kind, now.value) for _, now, before in found if isinstance(before, Unseen) and isinstance(now, Known)
    )


def put_under(
    followed: Followed, names: Mapping[str, str], rules: Mapping[RemappingRule, RemappingRule], provided: Give
) -> Followed | None:
    """*followed* with *names* for their keys, *rules* for those with marks and the parameters *provided*.

    None if two things that were made, or two parameters that were asked for, are one then.
    """
    texts = dict(names)
    values = {name: now for name, now, _ in _asked(followed, texts, provided)}
    if len({filled(name, texts) if PARAMETER in name else name for name in values}) < len(values):
        return None
    nodes: dict[int, RosNode] = {}

    def text(marked: str) -> str:
        return filled(marked, texts) if BEGIN in marked else marked

    def name(marked: str) -> str:
        if BEGIN not in marked:
            return marked
        head, colon, tail = filled(marked, texts).partition(":")
        return f"{clean(head)}{colon}{tail}"

    def node(before: RosNode) -> RosNode:
        if id(before) not in nodes:
            main = node(before.main) if before.main is not None else None
            texts_of = (before.name, before.own, before.space, before.why[0] if before.why else "")
            is_as_it_was = main is before.main and not any(BEGIN in part for part in texts_of)
            if is_as_it_was and not any(rule in rules for rule in before.rules):
                nodes[id(before)] = before
                return before
            nodes[id(before)] = replace(
                before,
                name=name(before.name),
                own=name(before.own),
                space=name(before.space),
                rules=tuple(rules.get(rule, rule) for rule in before.rules),
                why=before.why and (text(before.why[0]), before.why[1]),
                main=main,
            )
        return nodes[id(before)]

    def made(before: MadeEntity) -> MadeEntity:
        effective: Any = before.effective
        if isinstance(effective, AsGiven):
            value = values.get(effective.key)
            effective = value.value if isinstance(value, Known) else None
        elif isinstance(effective, str):
            effective = text(effective)
        own = node(before.node) if before.node is not None else None
        texts_of = (before.name, before.written or "", *(why for _, why, _ in before.unknowns))
        if own is before.node and effective is before.effective and not any(BEGIN in part for part in texts_of):
            return before
        return replace(
            before,
            name=name(before.name),
            effective=effective,
            node=own,
            unknowns=tuple((what, text(why), where) for what, why, where in before.unknowns),
            written=before.written and text(before.written),
        )

    every = tuple(map(made, followed.made))
    if any(map(is_not, every, followed.made)) and _number(every) != _number(followed.made):
        return None
    return replace(
        followed,
        made=every,
        gaps={text(message): where for message, where in followed.gaps.items()},
        nodes=tuple(map(node, followed.nodes)),
        twins=tuple(Twin(name(twin.name), twin.first, twin.second) for twin in followed.twins),
    )


def _number(made: Iterable[MadeEntity]) -> int:
    return len({(m.kind, m.name, m.type, m.location, m.node and m.node.name) for m in made})
