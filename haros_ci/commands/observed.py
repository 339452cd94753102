# SPDX-License-Identifier: Apache-2.0
"""``haros-ci model --observed``: a recording held against the one configuration of a model."""

from __future__ import annotations

from pathlib import Path

from haros_ci.errors import UserError
from haros_ci.model.architecture import Architecture
from haros_ci.model.observed import ObservedTopic, compare
from haros_ci.recordings.recording import Recording
from haros_ci.report.observed import as_json, text


def compared(found: Architecture, recording: Recording, format: str) -> str:
    """What *recording* says of the only configuration of *found*; UserError if there are several."""
    if len(found.configurations) != 1:
        known = ", ".join(sorted(one.name for one in found.configurations)[:20]) or "none"
        raise UserError("a recording is of one configuration", help=f"name it: --configuration NAME; there are {known}")
    topics: dict[str, ObservedTopic] = {}
    for topic, time in recording.times():
        one = topics.get(topic)
        if one is None:
            one = topics[topic] = ObservedTopic(topic, first=time, last=time)
        one.count += 1
        one.first, one.last = min(one.first, time), max(one.last, time)
    recording.demand_messages()
    for topic, types in recording.topics.items():
        topics.setdefault(topic, ObservedTopic(topic)).types = frozenset(types)
    for topic, found_offers in recording.offers.items():
        one = topics[topic]
        one.nodes = {offer.node: offer.is_latched for offer in found_offers if offer.node is not None}
        one.qos = tuple(sorted({offer.qos for offer in found_offers if offer.qos is not None}, key=repr))
    comparison = compare(found.configurations[0], recording.name, topics, recording.notes)
    return as_json(comparison) if format == "json" else text(comparison)


def recording_at(path: str) -> Recording:
    """The recording at *path*: lines of JSON in a ``.jsonl`` file, else a bag."""
    if path.endswith((".jsonl", ".json")):
        from haros_ci.recordings.jsonl import JsonLines

        return JsonLines(Path(path))
    from haros_ci.recordings.bag import Bag

    return Bag(Path(path))
