# SPDX-License-Identifier: Apache-2.0
"""What runs under other launch arguments: for each argument that decides about nodes, which come and which go.

Nothing is launched anew: the model has the presence of each node, and the nodes of other arguments.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence

from haros_ci.html_page.pool import Pool
from haros_ci.model.architecture import Configuration, Node
from haros_ci.model.launch_facts import ArgumentDeclaration
from haros_ci.model.presence import Choice, Presence, assignment, choice, in_words, together

#: The most of one configuration that are offered.
MOST = 40
_TRUTH = frozenset(("true", "false"))

Assigned = tuple[tuple[str, str], ...]


def variants(
    pool: Pool, one: Configuration, nodes: Sequence[Node], others: Sequence[Node]
) -> list[tuple[int, list[int], list[int]]]:
    """For each: the arguments in words, the indexes of *nodes* that go and of *others* that come. What changes nothing is left out."""
    defaults = {name: value for name, value in one.arguments if isinstance(value, str)}
    found = []
    for assigned in sorted(set(offered(one, nodes, others, defaults))):
        gone = [number for number, node in enumerate(nodes) if not stays(node.presence, assigned)]
        come = [number for number, node in enumerate(others) if comes(node.presence, assigned, defaults)]
        if gone or come:
            found.append((pool.text(in_words(assigned)), gone, come))
    return found[:MOST]


def offered(
    one: Configuration, nodes: Sequence[Node], others: Sequence[Node], defaults: Mapping[str, str]
) -> Iterator[Assigned]:
    """What can be set: what nodes that are not there ask for, the other truth value of what nodes ask for, and declared choices."""
    for node in others:
        chosen = assignment(node.presence, defaults)
        if chosen:
            yield chosen
    for item in (item for node in nodes for item in node.presence if item.equal and item.value in _TRUTH):
        yield from _set(Choice(item.argument, "false" if item.value == "true" else "true"), defaults)
    deciding = {item.argument for node in (*nodes, *others) for item in node.presence}
    for item in _declared(one, deciding):
        yield from _set(item, defaults)


def _declared(one: Configuration, names: Container[str]) -> Iterator[Choice]:
    """The choices that the configuration's own launch files declare for these arguments."""
    for fact in one.launch_facts:
        if isinstance(fact, ArgumentDeclaration) and not fact.included and fact.name in names:
            for value in fact.choices[:MOST]:
                yield choice(fact.name, value, boolean=value.lower() in _TRUTH)


def _set(chosen: Choice, defaults: Mapping[str, str]) -> Iterator[Assigned]:
    found = assignment((chosen,), defaults)
    if found:
        yield found


def stays(presence: Presence, assigned: Assigned) -> bool:
    """Whether what is there by default is there under the arguments, too."""
    return together(presence, _as_presence(assigned, presence)) is not None


def comes(presence: Presence, assigned: Assigned, defaults: Mapping[str, str]) -> bool:
    """Whether what is not there by default is there under the arguments; what is not assigned has its default."""
    set_ones = dict(assigned)
    rest = tuple(item for item in presence if item.argument not in set_ones)
    return stays(presence, assigned) and assignment(rest, defaults) == ()


def _as_presence(assigned: Assigned, presence: Presence) -> Presence:
    """The arguments as choices, spelt as *presence* spells its own."""
    truths = {item.argument for item in presence if item.value in _TRUTH}
    return tuple(sorted(choice(name, value, boolean=name in truths) for name, value in assigned))
