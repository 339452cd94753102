# SPDX-License-Identifier: Apache-2.0
"""Python classes that read an attribute or call a method of ``self`` that nothing sets or defines."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Project, all_nearest, alternatives, listed
from haros_ci.api.code import Unset, unset_attributes, weighed

#: Methods by which a class shows that it is meant to be a node of rclpy.
OF_NODES = frozenset(
    """
    create_client create_publisher create_rate create_service create_subscription create_timer declare_parameter declare_parameters
    destroy_node get_clock get_logger get_parameter set_parameters
    """.split()
)

#: Attributes of a class for which a name that is meant is looked for, and names that it may be: each is compared with each.
MOST_COMPARED, MOST_NAMES = 100, 1_000


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))


def _found(project: Project) -> Iterator[Finding]:
    classes: dict[tuple[str, str], list[Unset]] = {}
    for unset in unset_attributes(project):
        classes.setdefault((unset.location.path, unset.owner), []).append(unset)
    for found in classes.values():
        nodes = [unset for unset in found if unset.name in OF_NODES and not OF_NODES & unset.known]
        if len(nodes) > 1:
            yield _no_node(nodes)
        rest = [unset for unset in found if len(nodes) < 2 or unset.name not in OF_NODES]
        yield from (_finding(unset, number < MOST_COMPARED) for number, unset in enumerate(rest))


def _finding(unset: Unset, is_compared: bool) -> Finding:
    method = unset.routine.function.name.rpartition(".")[2]
    return Finding(
        at=unset.location,
        message=f"{unset.owner} {_use(unset)}, but nothing sets or defines it: the line raises "
        f"AttributeError{_like(unset, is_compared)}{'' if unset.is_reached else f' (no Python file here calls {method}())'}",
        level=None if unset.is_reached else Level.NOTE,
        about=(unset.owner, unset.name),
        apart=(unset.owner, unset.name),
    )


def _use(unset: Unset) -> str:
    return f"calls self.{unset.name}()" if unset.is_called else f"reads self.{unset.name}"


def _no_node(found: list[Unset]) -> Finding:
    """One for a class that calls methods of rclpy's Node and is none."""
    first, *others = found
    return Finding(
        at=first.location,
        message=f"{first.owner} calls {listed([f'self.{unset.name}()' for unset in found])}, but is no rclpy.node.Node: the line raises "
        "AttributeError; derive the class from Node",
        about=(first.owner, "Node"),
        related=tuple((other.location, f"self.{other.name} is called here") for other in others),
        apart=(first.owner, "Node"),
    )


def _like(unset: Unset, is_compared: bool) -> str:
    """What to do; names are compared where *is_compared*."""
    if any(unset.name == parameter.name for parameter in unset.routine.function.parameters):
        return f"; write {unset.name}, the parameter of {unset.routine.function.name.rpartition('.')[2]}()"
    own = unset.routine.function.name.rpartition(".")[2]  # nobody means the method that the line is in
    known = sorted(unset.known - {own})[:MOST_NAMES] if is_compared else []
    found = alternatives([f"self.{name}" for name in all_nearest(unset.name, known)])
    if found:
        return f"; did you mean {found}?"
    return "; define the method, or remove the call" if unset.is_called else "; set it in __init__()"


CHECK = Check(
    id="undefined-attribute",
    summary="Attribute of self that nothing sets.",
    level=Level.ERROR,
    tags=("python",),
    project=check,
)
