# SPDX-License-Identifier: Apache-2.0
"""Properties that the code of a configuration suggests: what callbacks always send, and what is sent in callbacks alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from haros_ci.model.architecture import Configuration, Endpoint, Node
from haros_ci.model.dependence import DIRECT, PERHAPS, STATE, Cause, NodeDependence, Output
from haros_ci.records import dataclass

#: A bound is so many periods of what sends: one until it runs, one for its work.
PERIODS = 2


@dataclass(frozen=True, slots=True)
class Suggestion:
    """A property as *text*, and the *evidence* for it: sentences with places."""

    text: str
    evidence: tuple[str, ...]


def suggestions(configuration: Configuration) -> tuple[Suggestion, ...]:
    """What the dependence and rates of a *configuration* suggest, by text; nothing where it has neither.

    ``/a causes /b``: a callback of /a publishes on /b each time. ``/a causes /b within t``: it changes what a timer publishes each time.
    ``/b requires /a``: all that publishes on /b is done in callbacks of /a.
    """
    if configuration.dependence is None:
        return ()
    nodes = {node.name: node for node in configuration.nodes}
    rates = (
        {(one.node, one.topic): one.rate.low for one in configuration.rates.published} if configuration.rates else {}
    )
    found: dict[str, list[str]] = {}
    for one in configuration.dependence.nodes:
        for output in _topics(one):
            for text, evidence in _caused(one, output, nodes[one.node], rates):
                found.setdefault(text, []).append(evidence)
    for text, evidence in _required(configuration):
        found.setdefault(text, []).append(evidence)
    return tuple(Suggestion(text, tuple(dict.fromkeys(every))) for text, every in sorted(found.items()))


def _topics(node: NodeDependence) -> Iterator[Output]:
    return (output for output in node.outputs if output.kind == "publishers" and "?" not in output.name)


def _caused(
    one: NodeDependence, output: Output, node: Node, rates: Mapping[tuple[str, str], float]
) -> Iterator[tuple[str, str]]:
    if node.conditions or not _is_certain(node.endpoints, "publishers", output.name):
        return
    timer = next((cause for cause in output.causes if cause.kind == "timer" and cause.is_each), None)
    low = rates.get((one.node, output.name), 0.0)
    for cause in output.causes:
        if cause.kind != "subscription" or not _is_other(node, cause.name, output.name):
            continue
        if cause.how == DIRECT and cause.is_each:
            yield f"globally: {cause.name} causes {output.name}", _way(one, cause)
        elif cause.how == STATE and timer is not None and low > 0:
            bound = _bound(low)
            yield (
                f"globally: {cause.name} causes {output.name} within {bound}",
                f"{_way(one, cause)}; {one.node} publishes at least {low:.6g} times a second, and the bound is {PERIODS} periods",
            )


def _is_other(node: Node, name: str, other: str) -> bool:
    """Whether a node surely subscribes to a topic of that name, which is not the *other* one."""
    return "?" not in name and name != other and _is_certain(node.endpoints, "subscribers", name)


def _is_certain(endpoints: Iterable[Endpoint], kind: str, name: str) -> bool:
    """Whether an endpoint of that name is made whatever happens."""
    return any(end.kind == kind and end.name == name and not end.conditions for end in endpoints)


def _bound(hertz: float) -> str:
    return f"{max(round(PERIODS * 1000 / hertz), 1)} ms"


def _required(configuration: Configuration) -> Iterator[tuple[str, str]]:
    """Each topic whose publishers are all seen to publish in callbacks of subscriptions alone."""
    more = _not_known(configuration)
    for topic, group in sorted(_by_topic(configuration).items()):
        ways = [(one, cause) for one, output in group for cause in _direct(output)]
        names = sorted({cause.name for _, cause in ways})
        if not names or topic in names or "?" in "".join(names) or not all(_in_callbacks(one) for _, one in group):
            continue
        event = names[0] if len(names) == 1 else f"({' or '.join(names)})"
        evidence = "; ".join(dict.fromkeys(_way(one, cause) for one, cause in ways))
        yield f"globally: {topic} requires {event}", f"nothing else publishes it: {evidence}{more}"


def _not_known(configuration: Configuration) -> str:
    """What the evidence says of nodes of which not all endpoints are known."""
    others = [node.name for node in configuration.nodes if any(why.field == "endpoints" for why in node.unknowns)]
    return f"; not all that {', '.join(others[:5])} may publish is known" if others else ""


def _by_topic(configuration: Configuration) -> dict[str, list[tuple[NodeDependence, Output]]]:
    """Who publishes each topic."""
    assert configuration.dependence is not None
    found: dict[str, list[tuple[NodeDependence, Output]]] = {}
    for one in configuration.dependence.nodes:
        for output in _topics(one):
            found.setdefault(output.name, []).append((one, output))
    return found


def _direct(output: Output) -> list[Cause]:
    return [cause for cause in output.causes if not cause.state]


def _in_callbacks(output: Output) -> bool:
    """Whether it is sent in callbacks of subscriptions alone, for certain."""
    direct = _direct(output)
    if output.reason or output.is_start or not direct:
        return False
    return all(cause.kind == "subscription" and cause.how != PERHAPS for cause in direct)


def _way(one: NodeDependence, cause: Cause) -> str:
    places = [str(at) for at, _ in (cause.path[0], cause.path[-1])] if cause.path else [str(cause.location)]
    through = f" through {', '.join(cause.state)}" if cause.state else ""
    when = " under conditions" if cause.conditions else ""
    return f"{one.node}: {' to '.join(places)}{through}{when}"
