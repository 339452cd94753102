# SPDX-License-Identifier: Apache-2.0
"""``haros-ci monitor --generate``: monitors that run beside a system, a file for each configuration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from haros_ci.analysis.monitored import Chosen, Monitored
from haros_ci.config.on_violation import actions_in
from haros_ci.errors import UserError
from haros_ci.model.architecture import Qos
from haros_ci.monitor_files.classes import Described
from haros_ci.monitor_files.monitor_file import Watched, monitor_file, plain_name, type_name
from haros_ci.report.escape import terminal
from haros_ci.writing import put_below


def check_flags(flags: Mapping[str, Any]) -> None:
    """UserError for flags that are about recordings."""
    if any(flags[name] is not None for name in ("bag", "jsonl", "export")) or flags["output"]:
        raise UserError(
            "--generate reads no recording and has no other output",
            help="leave --bag, --jsonl, --export and --output out",
        )


def write_files(directory: str, every: Sequence[Chosen], project: Mapping[str, Any]) -> int:
    """Write a file for each of *every* that has properties; *project* is the project file as plain data. Exit code 0."""
    made: dict[str, str] = {}
    for picked in every:
        for note in picked.notes:
            click.echo(f"note: {terminal(note)}", err=True)
        watched = watched_in(picked, project)
        text, left_out = monitor_file(watched, map(_described, picked.properties))
        for sentence in left_out:
            click.echo(f"warning: {terminal(sentence)}", err=True)
        for topic, name in watched.topics.items():
            if not name and watched.ros == 2:
                click.echo(
                    f"warning: {terminal(topic)}: its type is not known, so its properties will be undecided", err=True
                )
        if text:
            made[_free(f"monitor_{plain_name(picked.configuration)}", made)] = text
    if not made:
        raise UserError(
            "there are no properties", help="state them in the project file under hpl, or give --property 'globally: …'"
        )
    put_below(Path(directory), {f"{name}.py": text for name, text in made.items()})
    for name in made:
        click.echo(terminal(str(Path(directory, f"{name}.py"))), err=True)
    return 0


def watched_in(picked: Chosen, project: Mapping[str, Any]) -> Watched:
    """What is known of a configuration; UserError where an action cannot be done."""
    topics = sorted({topic for item in picked.properties for topic in item.monitor.topics})
    return Watched(
        picked.configuration,
        picked.ros,
        {topic: type_name(picked.types.get(topic), picked.ros) for topic in topics},
        {topic: tuple((one.node, one.location.path, one.location.line or 1) for one in picked.publishers[topic]) for topic in topics if topic in picked.publishers},
        _actions(picked, project),
        {topic: qos for topic in topics if (qos := requested(picked.qos.get(topic, ())))} if picked.ros == 2 else {},
    )  # fmt: skip


def requested(offered: Sequence[Qos | None]) -> dict[str, str]:
    """What a subscription can ask for that all of these publishers certainly offer: reliability where they are reliable (the default of rclcpp and rclpy),
    and what was sent before where they keep it. {} is what each publisher can serve."""
    found: dict[str, str] = {}
    if offered and all(qos is not None and qos.reliability in (None, "reliable") for qos in offered):
        found["reliability"] = "reliable"
    if found and all(qos is not None and qos.durability == "transient_local" for qos in offered):
        found["durability"] = "transient_local"
    return found


def _described(item: Monitored) -> Described:
    at = item.location
    place = () if at is None else (at.path, at.line or 1, at.column or 1)
    return Described(
        item.monitor, item.title, item.text, str(item.stated.owner), item.node, item.stated.is_axiom, place
    )


def _free(name: str, taken: Mapping[str, str]) -> str:
    """*name*, with a number behind it where another configuration has it."""
    number = 1
    while (found := name if number == 1 else f"{name}_{number}") in taken:
        number += 1
    return found


def _actions(picked: Chosen, project: Mapping[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """The actions with their types; those that the project file does not say are those of the model."""
    stated = actions_in(project, picked.configuration)
    titles = {item.title for item in picked.properties}
    found: dict[str, list[dict[str, Any]]] = {}
    for title, actions in stated.items():
        if title not in titles and title != "*":
            click.echo(f"warning: on_violation names {terminal(title)}, and no property has this id", err=True)
            continue
        found[title] = [_typed(action, picked) for action in actions]
    return found


def _typed(action: dict[str, Any], picked: Chosen) -> dict[str, Any]:
    if "log" in action:
        return action
    verb, of, kind = ("publish", picked.types, "msg") if "publish" in action else ("call", picked.services, "srv")
    known = (action["type"],) if "type" in action else of.get(action[verb])
    name = type_name(known, picked.ros, kind)
    if not name:
        raise UserError(
            f"on_violation of {terminal(picked.configuration)}: the type of {terminal(action[verb])} is not known",
            help="write type: package/Type beside it",
        )
    return {verb: action[verb], "type": name, "message": action.get("message", {})}
