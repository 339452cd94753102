# SPDX-License-Identifier: Apache-2.0
"""Python classes that read an attribute or call a method of ``self`` that nothing sets or defines."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from haros_ci.api import Check, Finding, Level, Project, listed
from haros_ci.api.code import Unset, unset_attributes, weighed

#: Methods by which a class shows that it is meant to be a node of rclpy.
OF_NODES = frozenset(
    """
    create_client create_publisher create_rate create_service create_subscription create_timer declare_parameter declare_parameters
    destroy_node get_clock get_logger get_parameter set_parameters
    """.split()
)


def check(project: Project) -> Iterator[Finding]:
    yield from weighed(project, _found(project))


def _found(project: Project) -> Iterator[Finding]:
    classes: dict[tuple[str, str], list[Unset]] = {}
    for each in unset_attributes(project):
        classes.setdefault((each.location.path, each.owner), []).append(each)
    for found in classes.values():
        nodes = [each for each in found if each.name in OF_NODES and not OF_NODES & each.known]
        if len(nodes) > 1:
            yield _no_node(nodes)
        yield from map(_finding, (each for each in found if len(nodes) < 2 or each not in nodes))


def _finding(each: Unset) -> Finding:
    method = each.routine.function.name.rpartition(".")[2]
    return Finding(
        at=each.location,
        message=f"{each.owner} reads self.{each.name}, but nothing sets or defines it: the line raises "
        f"AttributeError{_like(each)}{'' if each.is_reached else f' (no Python file here calls {method}())'}",
        level=None if each.is_reached else Level.NOTE,
        about=(each.owner, each.name),
        apart=(each.owner, each.name),
    )


def _no_node(found: list[Unset]) -> Finding:
    """One for a class that calls methods of rclpy's Node and is none."""
    first, *others = found
    return Finding(
        at=first.location,
        message=f"{first.owner} calls {listed([f'self.{each.name}()' for each in found])}, but is no rclpy.node.Node: the line raises "
        "AttributeError; derive the class from Node",
        about=(first.owner, "Node"),
        related=tuple((each.location, f"self.{each.name} is called here") for each in others),
        apart=(first.owner, "Node"),
    )


def _like(each: Unset) -> str:
    if any(each.name == parameter.name for parameter in each.routine.function.parameters):
        return f"; write {each.name}, the parameter of {each.routine.function.name.rpartition('.')[2]}()"
    found = get_close_matches(each.name, sorted(each.known), 1, 0.75)
    return f"; did you mean self.{found[0]}?" if found else "; set it in __init__()"


CHECK = Check(
    id="undefined-attribute",
    summary="Attribute of self that nothing sets.",
    level=Level.ERROR,
    tags=("python",),
    project=check,
)
