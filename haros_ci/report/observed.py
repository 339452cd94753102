# SPDX-License-Identifier: Apache-2.0
"""A recording beside a configuration, for a person at a terminal and as data."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from haros_ci.model.architecture import Qos
from haros_ci.model.observed import ComparedTopic, Comparison
from haros_ci.model.rates import Rate
from haros_ci.report.escape import json_document, log_line, terminal
from haros_ci.report.summary import plural

NOT_ALL = "a recording does not have everything: what it lacks may be unrecorded, or not have happened"


def text(found: Comparison) -> str:
    """Plain text: what the model lacks first, then what the recording lacks."""
    lacking = [one for one in found.topics if one.lacks]
    lines = [f"{found.recording} beside {found.configuration}: {plural(len(found.topics), 'topic')} recorded"]
    lines += [f"note: {note}" for note in found.notes]
    if lacking:
        lines.append("  what the recording has and the model lacks:")
        lines += [f"    {one.observed.name} ({_recorded(one)}): {'; '.join(one.lacks)}" for one in lacking]
    agreed = [one for one in found.topics if not one.lacks]
    if agreed:
        lines.append("  what both have:")
        lines += [f"    {one.observed.name} ({_recorded(one)}){_modelled(one)}" for one in agreed]
    if found.unrecorded:
        lines.append(f"  what the model has and the recording lacks ({NOT_ALL}):")
        lines += [f"    {name}, published by {', '.join(nodes)}" for name, nodes in found.unrecorded]
    return "\n".join(map(log_line, lines)) + "\n"


def _recorded(one: ComparedTopic) -> str:
    seen = one.observed
    parts = [*sorted(seen.types), plural(seen.count, "message")]
    parts += [f"{seen.rate:.3g} Hz"] if seen.rate is not None else []
    return ", ".join([*parts, *dict.fromkeys(words for qos in seen.qos if (words := _qos(qos)))])


def _qos(qos: Qos) -> str:
    """Reliability and durability, as far as they are known."""
    return " ".join(word for word in (qos.reliability, qos.durability) if word is not None)


def _modelled(one: ComparedTopic) -> str:
    nodes = f": published by {', '.join(one.publishers)}" if one.publishers else ""
    return (
        f"{nodes}{', ' if nodes else ': '}{one.rate} in the model"
        if one.rate is not None and one.rate.is_known
        else nodes
    )


def as_json(found: Comparison) -> str:
    """The same as data; rates are in hertz, null where they are not known."""
    return json_document(
        {
            "configuration": found.configuration,
            "recording": found.recording,
            "notes": [terminal(note) for note in found.notes],
            "topics": [_topic(one) for one in found.topics],
            "unrecorded": [{"name": terminal(name), "publishers": list(nodes)} for name, nodes in found.unrecorded],
        },
        2,
    ) + "\n"  # fmt: skip


def _topic(one: ComparedTopic) -> dict[str, Any]:
    seen = one.observed
    return {
        "name": terminal(seen.name),
        "types": sorted(map(terminal, seen.types)),
        "count": seen.count,
        "rate": seen.rate,
        "publishers": [{"node": terminal(node), "latched": latched} for node, latched in sorted(seen.nodes.items())],
        "qos": [asdict(qos) for qos in seen.qos],
        "model": {
            "publishers": list(one.publishers),
            "subscribers": list(one.subscribers),
            "types": list(one.types),
            "qos": [asdict(qos) for qos in one.qos],
            "rate": _rate(one.rate),
        },
        "lacks": [terminal(text) for text in one.lacks],
    }


def _rate(rate: Rate | None) -> dict[str, Any] | None:
    return None if rate is None or not rate.is_known else {"low": rate.low, "high": rate.high}
