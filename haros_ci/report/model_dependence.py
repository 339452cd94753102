# SPDX-License-Identifier: Apache-2.0
"""The dependence in a configuration, and slices over it: for JSON, and for a person at a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from haros_ci.model.dependence import UNKNOWN, Cause, Dependence, NodeDependence, Output, Slice, When
from haros_ci.model.location import Location
from haros_ci.report.escape import terminal
from haros_ci.report.message import shorten

Place = Callable[[Location | None], dict[str, Any] | None]
#: Conditions of one way that are printed.
SHOWN = 3
WORDS = {"publishers": "publishes", "clients": "calls", "action_clients": "sends goals to"}


def dependence_of(dependence: Dependence, place: Place) -> dict[str, Any]:
    """*dependence* as JSON holds it: for each node its inputs and outputs, and the causes of each output; the slices, if any."""
    slices = {"slices": _slices(dependence.slices, place)} if dependence.slices else {}
    return {"dependence": [_node(node, place) for node in dependence.nodes], **slices}


def _node(node: NodeDependence, place: Place) -> dict[str, Any]:
    return {
        "node": node.node,
        "reason": terminal(node.reason) or None,
        "inputs": [
            {
                "kind": one.kind,
                "name": one.name,
                "location": place(one.location),
                "reason": terminal(one.reason) or None,
            }
            for one in node.inputs
        ],
        "outputs": [_output(one, place) for one in node.outputs],
    }


def _output(output: Output, place: Place) -> dict[str, Any]:
    return {
        "kind": output.kind,
        "name": output.name,
        "location": place(output.location),
        "calls": [place(call) for call in output.calls],
        "start": output.is_start,
        "reason": terminal(output.reason) or None,
        "causes": [cause_of(cause, place) for cause in output.causes],
    }


def cause_of(cause: Cause, place: Place) -> dict[str, Any]:
    """A cause as JSON holds it."""
    return {
        "kind": cause.kind,
        "name": cause.name,
        "how": cause.how,
        "each": cause.is_each,
        "state": list(cause.state),
        "reason": terminal(cause.reason) or None,
        "location": place(cause.location),
        "conditions": [
            {"text": terminal(one.text), "met": one.is_met, "reads": list(one.reads), "location": place(one.location)}
            for one in cause.conditions
        ],
        "path": [{"text": terminal(text), "location": place(at)} for at, text in cause.path],
    }


def _slices(slices: tuple[Slice, ...], place: Place) -> list[dict[str, Any]]:
    return [
        {
            "name": one.name,
            "direction": "affects" if one.is_forward else "caused-by",
            "steps": [
                {
                    "node": step.node,
                    "from": {"kind": step.source[0], "name": step.source[1]},
                    "to": {"kind": step.target[0], "name": step.target[1]},
                    "how": step.how,
                    "depth": step.depth,
                    "reason": terminal(step.reason) or None,
                    "cause": None if step.cause is None else cause_of(step.cause, place),
                }
                for step in one.steps
            ],
        }
        for one in slices
    ]


def lines(dependence: Dependence) -> Iterator[str]:
    """For each node a line for each input of each output, and what is not known; if there are slices, these."""
    for one in dependence.slices:
        yield from _slice(one)
    if dependence.slices:
        return
    yield "  dependence:"
    for node in dependence.nodes:
        found = list(_of_node(node))
        if found:
            yield f"    {terminal(node.node)}"
            yield from (f"      {line}" for line in found)


def _of_node(node: NodeDependence) -> Iterator[str]:
    for output in node.outputs:
        name = f"{WORDS[output.kind]} {terminal(output.name)}"
        for cause in output.causes:
            yield f"{source(cause)} {name}{how(cause)}"
        if output.is_start:
            yield f"by itself {name}"
        if output.reason:
            yield f"? other inputs may cause {terminal(output.name)}: {shorten(terminal(output.reason), 160)}"
        elif not output.causes and not output.is_start:
            yield f"nothing {name}"
    for one in node.inputs:
        if one.reason:
            yield f"? {terminal(one.name) or one.kind}: {shorten(terminal(one.reason), 160)}"


def source(cause: Cause) -> str:
    """What a cause is called: the topic, or the timer with its place."""
    if cause.name:
        return terminal(cause.name)
    return f"{cause.kind} ({terminal(str(cause.location))})"


def how(cause: Cause) -> str:
    """How a cause leads to its output, in words behind the output."""
    parts = [f"through state {', '.join(terminal(name) for name in cause.state)}"] if cause.state else []
    shown = [_when(one) for one in cause.conditions[:SHOWN]]
    more = len(cause.conditions) - SHOWN
    if shown:
        parts.append("if " + " and ".join(shown) + (f" and {more} more" if more > 0 else ""))
    if cause.reason:
        parts.append(f"perhaps: {shorten(terminal(cause.reason), 120)}")
    return f" ({'; '.join(parts)})" if parts else ""


def _when(one: When) -> str:
    text = shorten(terminal(one.text), 60)
    reads = f" [{', '.join(terminal(name) for name in one.reads)}]" if one.reads else ""
    return f"{'' if one.is_met else 'not '}{text}{reads}"


def _slice(one: Slice) -> Iterator[str]:
    yield f"  {terminal(one.name)} {'affects' if one.is_forward else 'is caused by'}:"
    if not one.steps:
        yield "    nothing that is known"
    for step in one.steps:
        indent = "    " + "  " * min(step.depth - 1, 12)
        names = [terminal(name) or kind for kind, name in (step.source, step.target)]
        if step.how == UNKNOWN:
            yield f"{indent}? {names[0]} -> {names[1]} in {terminal(step.node)}: {shorten(terminal(step.reason), 160)}"
            continue
        assert step.cause is not None
        yield f"{indent}{names[0]} -> {names[1]} in {terminal(step.node)}{how(step.cause)}"
        for at, text in step.cause.path:
            yield f"{indent}    {terminal(str(at))}: {terminal(text)}"
