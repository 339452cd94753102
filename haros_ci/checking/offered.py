# SPDX-License-Identifier: Apache-2.0
"""Services and actions whose server and clients disagree on the type."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from haros_ci.checking.check import Finding
from haros_ci.checking.remapping import named_at, rule_of, way_to
from haros_ci.checking.system import Channel, End
from haros_ci.checking.wording import line_of


def type_mismatches(channels: Iterable[Channel], consequence: str) -> Iterator[Finding]:
    """One finding for each two types that meet at one of *channels*, at the end that was remapped, else at a client."""
    for channel in channels:
        if len(channel.types) < 2:
            continue
        found: dict[tuple[str, str], dict[End, None]] = {}
        for server, client in channel.pairs():
            if server.type is None or client.type is None or server.type == client.type:
                continue
            if server.implicit or client.implicit or _has_other(server, client.type) or _has_other(client, server.type):
                continue
            found.setdefault((server.type, client.type), {}).update({server: None, client: None})
        for (given, wanted), ends in found.items():
            clients = [end for end in ends if end in channel.clients]
            servers = [end for end in ends if end in channel.servers]
            wrong = next((end for end in (*clients, *servers) if rule_of(end) is not None), None)
            wrong = wrong or next((end for end in (*clients, *servers) if end.in_source), clients[0])
            rule = rule_of(wrong)
            advice = "" if rule is None else f"; {wrong.original_name} is remapped to {wrong.name} here"
            others = f" and {len(clients) - 1} more" if len(clients) > 1 else ""
            yield Finding(
                at=named_at(wrong),
                message=(
                    f"{clients[0].node}{others} ({line_of(clients[0].location)}) uses {channel} as {wanted}, "
                    f"but {servers[0].node} ({line_of(servers[0].location)}) offers {given}: {consequence}; use one type in both{advice}"
                ),
                about=(channel, *ends),
                related=tuple((end.location, f"{end.node}: {end.word} of {end.type}") for end in ends),
                flow=way_to(wrong),
            )


def _has_other(end: End, kind: str) -> bool:
    """Whether the node has an end of that *kind* of type, too: one of them is made, as its conditions say."""
    return any(other.name == end.name and other.type in (kind, None) for other in end.node.of(end.kind))
