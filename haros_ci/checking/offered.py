# SPDX-License-Identifier: Apache-2.0
"""Services and actions whose server and clients disagree on the type."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import partial

from haros_ci.checking.check import Finding
from haros_ci.checking.coexistence import by_types
from haros_ci.checking.remapping import named_at, rule_of, way_to
from haros_ci.checking.system import Channel, End
from haros_ci.checking.wording import line_of


def type_mismatches(channels: Iterable[Channel], consequence: str) -> Iterator[Finding]:
    """One finding for each two types that meet at one of *channels*, at the end that was remapped, else at a client."""
    for channel in channels:
        if len(channel.types) < 2:
            continue
        types: dict[tuple[int, str], set[str | None]] = {}
        for end in channel.ends:
            types.setdefault((id(end.node), end.kind), set()).add(end.type)
        found = by_types(channel.servers, channel.clients, partial(_differ, types))
        for (offered, requested), ends in found.items():
            takers = set(channel.clients)
            clients = [end for end in ends if end in takers]
            servers = [end for end in ends if end not in takers]
            wrong = next((end for end in (*clients, *servers) if rule_of(end) is not None), None)
            wrong = wrong or next((end for end in (*clients, *servers) if end.in_source), clients[0])
            rule = rule_of(wrong)
            advice = "" if rule is None else f"; {wrong.original_name} is remapped to {wrong.name} here"
            others = f" and {len(clients) - 1} more" if len(clients) > 1 else ""
            yield Finding(
                at=named_at(wrong),
                message=(
                    f"{clients[0].node}{others} ({line_of(clients[0].location)}) uses {channel} as {requested}, "
                    f"but {servers[0].node} ({line_of(servers[0].location)}) offers {offered}: {consequence}; use one type in both{advice}"
                ),
                about=(channel, *ends),
                related=tuple((end.location, f"{end.node}: {end.word} of {end.type}") for end in ends),
                flow=way_to(wrong),
            )


def _differ(types: Mapping[tuple[int, str], Collection[str | None]], server: End, client: End) -> bool:
    """Whether the types differ, and neither node has an end of the other's type, too: one of them is made, as its conditions say.

    *types* has those that each node has at the channel, by its identity and the kind of end.
    """
    if server.type is None or client.type is None or server.type == client.type or server.implicit or client.implicit:
        return False
    requested, offered = types[id(client.node), client.kind], types[id(server.node), server.kind]
    return not (client.type in offered or None in offered or server.type in requested or None in requested)
