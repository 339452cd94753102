# SPDX-License-Identifier: Apache-2.0
"""The elements of ROS 2 launch files as actions: what each tag and attribute means, XML and YAML alike.

The rule is the ``parse`` method of each action that launch and launch_ros expose to launch files.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from haros_ci.extract.launch import ros2_gz
from haros_ci.extract.launch.ros2_entity import Entity, unknown_tag
from haros_ci.extract.launch.ros2_parameters import parameter_sources
from haros_ci.model.launch_actions import Action, Phrase, Test
from haros_ci.model.launch_phrases import read_phrase, unescaped
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

_PROCESS = (
    *("args", "ros_args", "cwd", "name", "exec_name", "launch-prefix", "output", "output_format", "respawn"),
    *("respawn_delay", "respawn_max_retries", "sigterm_timeout", "sigkill_timeout", "emulate_tty", "shell", "on_exit"),
)
_NODE = ("pkg", "exec", "namespace", "node-name", *_PROCESS)
#: How Python's launch files and ROS 1 call what has another name here.
_CALLED = {"executable": "exec", "type": "exec", "package": "pkg", "ns": "namespace", "prefix": "launch-prefix"}
_COMPONENT = ("pkg", "plugin", "name", "namespace")


@dataclass(slots=True)
class Builder:
    """Makes actions; *problems* are pairs of a line and what is wrong there."""

    problems: dict[tuple[int, str], None] = field(default_factory=dict)

    def wrong(self, entity: Entity, message: str) -> None:
        self.problems[(entity.location.line or 1, message)] = None

    def phrase(self, entity: Entity, name: str, optional: bool = False) -> Phrase | None:
        """The attribute *name* as a phrase; a problem where it is needed and not there."""
        value = entity.get(name)
        if value is None:
            if not optional:
                self.wrong(entity, f"<{entity.tag}> needs the attribute '{name}'; add it")
            return None
        return self.text(entity, value)

    def text(self, entity: Entity, value: Any) -> Phrase:
        phrase, problem = read_phrase(written(value), entity.location)
        if problem:
            self.wrong(entity, problem)
        return phrase

    def check(self, entity: Entity, attributes: tuple[str, ...], children: tuple[str, ...] | None = ()) -> None:
        """Report what launch refuses: attributes and tags that *entity* cannot have."""
        names = {name for name, _ in entity.attributes}
        spare = names.difference(attributes, ("if", "unless"), {f"{name}-sep" for name in names})
        for name in sorted(spare):
            meant = _CALLED.get(name)
            is_meant = meant in attributes and meant not in names
            remedy = f"write {meant}" if is_meant else "remove it or correct its name"
            self.wrong(entity, f"<{entity.tag}> has no attribute '{name}'; {remedy}")
        if children is not None:
            for name in sorted({child.tag for child in entity.children}.difference(children)):
                self.wrong(entity, f"<{name}> cannot stand in <{entity.tag}>; remove it or correct its name")

    def actions(self, entities: tuple[Entity, ...]) -> tuple[Action, ...]:
        return tuple(action for entity in entities if (action := self.action(entity)) is not None)

    def action(self, entity: Entity) -> Action | None:
        maker = _MAKERS.get(entity.tag) or _MAKERS.get(entity.tag.replace("-", "_"))
        if maker is None:
            self.wrong(entity, unknown_tag(entity.tag, _MAKERS))
            return None
        return maker(self, entity)

    def tests(self, entity: Entity) -> tuple[Test, ...]:
        found = []
        for kind in ("if", "unless"):
            value = entity.get(kind)
            if value is not None:
                text = written(value)
                phrases = (self.text(entity, value),)
                found.append(Test(kind=kind, phrases=phrases, text=text, location=entity.location))
        if len(found) > 1:
            self.wrong(entity, f"<{entity.tag}> has both 'if' and 'unless'; keep one")
        return tuple(found)

    def pairs(self, entity: Entity, tags: tuple[str, ...], value: str = "value") -> tuple[tuple[Phrase, Phrase], ...]:
        """Name and value of each child of one of *tags*."""
        found = []
        for child in entity.all(*tags):
            self.check(child, ("name", value))
            name, content = self.phrase(child, "name"), self.phrase(child, value)
            if name is not None and content is not None:
                found.append((name, content))
        return tuple(found)

    def remaps(self, entity: Entity) -> tuple[tuple[Phrase, Phrase, Location], ...]:
        found = []
        for child in entity.all("remap"):
            self.check(child, ("from", "to"))
            source, target = self.phrase(child, "from"), self.phrase(child, "to")
            if source is not None and target is not None:
                found.append((source, target, child.location))
        return tuple(found)

    def phrases(self, entity: Entity, names: Mapping[str, str], needed: tuple[str, ...] = ()) -> Any:
        """Pairs of an action's attribute and its phrase; *names* maps attributes of the tag to those of the action."""
        found = []
        for name, target in names.items():
            phrase = self.phrase(entity, name, optional=name not in needed)
            if phrase is not None:
                found.append((target, phrase))
        return tuple(found)


def written(value: Any) -> str:
    """The text of an attribute: in YAML true and numbers are written as launch's substitutions would read them."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return " ".join(written(item) for item in value)
    return "" if value is None else str(value)


def _simple(
    kind: str, names: Mapping[str, str] | tuple[str, ...], needed: tuple[str, ...], spare: tuple[str, ...] = ()
) -> Callable[[Builder, Entity], Action | None]:
    """The maker of an action that consists of phrases."""
    mapped = names if isinstance(names, Mapping) else {name: name for name in names}

    def make(builder: Builder, entity: Entity) -> Action | None:
        builder.check(entity, (*mapped, *spare))
        if any(entity.get(name) is None for name in needed):
            builder.phrases(entity, mapped, needed)
            return None
        phrases = builder.phrases(entity, mapped, needed)
        return Action(kind=kind, location=entity.location, phrases=phrases, tests=builder.tests(entity))

    return make


def _arg(builder: Builder, entity: Entity) -> Action | None:
    builder.check(entity, ("name", "default", "description"), ("choice",))
    name = entity.get("name")
    if name is None:
        builder.phrase(entity, "name")
        return None
    phrases: list[tuple[str, Phrase]] = [("name", (unescaped(written(name)),))]
    default = builder.phrase(entity, "default", optional=True)
    if default is not None:
        phrases.append(("default", default))
    for choice in entity.all("choice"):
        phrases.append(("choices", (unescaped(written(choice.get("value"))),)))
    return Action(kind="arg", location=entity.location, phrases=tuple(phrases), tests=builder.tests(entity))


def _group(builder: Builder, entity: Entity) -> Action:
    builder.check(entity, ("scoped", "forwarding"), None)
    children = tuple(child for child in entity.children if child.tag != "keep")
    return Action(
        kind="group",
        location=entity.location,
        phrases=builder.phrases(entity, {"scoped": "scoped", "forwarding": "forwarding"}),
        arguments=builder.pairs(entity, ("keep",)),
        tests=builder.tests(entity),
        children=builder.actions(children),
    )


def _reset(builder: Builder, entity: Entity) -> Action:
    builder.check(entity, (), ("keep",))
    keeps = builder.pairs(entity, ("keep",))
    return Action(kind="reset", location=entity.location, arguments=keeps, tests=builder.tests(entity))


def _include(builder: Builder, entity: Entity) -> Action | None:
    builder.check(entity, ("file",), ("arg", "let"))
    file = builder.phrase(entity, "file")
    if file is None:
        return None
    return Action(
        kind="include",
        location=entity.location,
        phrases=(("file", file),),
        arguments=builder.pairs(entity, ("arg", "let")),
        tests=builder.tests(entity),
    )


_NODE_PHRASES = {
    **{"pkg": "package", "exec": "executable", "name": "name", "namespace": "namespace", "args": "args"},
    **{"ros_args": "ros_args", "exec_name": "exec_name", "launch-prefix": "launch-prefix", "respawn": "respawn"},
}


def _node(kind: str) -> Callable[[Builder, Entity], Action | None]:
    def make(builder: Builder, entity: Entity) -> Action | None:
        inner = ("param", "remap", "env", *(("composable_node",) if kind == "container" else ()))
        builder.check(entity, _NODE, inner)
        phrases = builder.phrases(entity, _NODE_PHRASES, ("exec",))
        if entity.get("exec") is None:
            return None
        if entity.get("name") is None and entity.get("node-name") is not None:
            phrases += (("name", builder.text(entity, entity.get("node-name"))),)
        return Action(
            kind=kind,
            location=entity.location,
            phrases=phrases,
            parameters=parameter_sources(entity, builder.text, builder.wrong),
            remaps=builder.remaps(entity),
            environment=builder.pairs(entity, ("env",)),
            tests=builder.tests(entity),
            children=_components(builder, entity) if kind == "container" else (),
        )

    return make


def _components(builder: Builder, entity: Entity) -> tuple[Action, ...]:
    found = []
    for child in entity.all("composable_node"):
        builder.check(child, _COMPONENT, ("param", "remap", "extra_arg"))
        names = {"pkg": "package", "plugin": "plugin", "name": "name", "namespace": "namespace"}
        phrases = builder.phrases(child, names, ("pkg", "plugin", "name"))
        if child.get("pkg") is None or child.get("plugin") is None:
            continue
        found.append(
            Action(
                kind="component",
                location=child.location,
                phrases=phrases,
                parameters=parameter_sources(child, builder.text, builder.wrong),
                remaps=builder.remaps(child),
                arguments=builder.pairs(child, ("extra_arg",)),
                tests=builder.tests(child),
            )
        )
    return tuple(found)


def _load(builder: Builder, entity: Entity) -> Action | None:
    builder.check(entity, ("target",), ("composable_node",))
    target = builder.phrase(entity, "target")
    if target is None:
        return None
    return Action(
        kind="load",
        location=entity.location,
        phrases=(("target", target),),
        tests=builder.tests(entity),
        children=_components(builder, entity),
    )


def _timer(builder: Builder, entity: Entity) -> Action:
    builder.check(entity, ("period", "cancel_on_shutdown"), None)
    period = written(entity.get("period"))
    builder.phrase(entity, "period")
    return Action(
        kind="event",
        location=entity.location,
        tests=builder.tests(entity),
        children=builder.actions(entity.children),
        deferred=f"after {period} s" if period else "after some time",
    )


def _executable(builder: Builder, entity: Entity) -> Action | None:
    builder.check(entity, ("cmd", *_PROCESS), ("env",))
    cmd = builder.phrase(entity, "cmd")
    if cmd is None:
        return None
    return Action(
        kind="executable",
        location=entity.location,
        phrases=(("cmd", cmd), *builder.phrases(entity, {"launch-prefix": "launch-prefix", "respawn": "respawn"})),
        environment=builder.pairs(entity, ("env",)),
        tests=builder.tests(entity),
    )


def _remap(builder: Builder, entity: Entity) -> Action | None:
    builder.check(entity, ("from", "to"))
    source, target = builder.phrase(entity, "from"), builder.phrase(entity, "to")
    if source is None or target is None:
        return None
    remaps = ((source, target, entity.location),)
    return Action(kind="set-remap", location=entity.location, remaps=remaps, tests=builder.tests(entity))


def _parameter(kind: str) -> Callable[[Builder, Entity], Action | None]:
    def make(builder: Builder, entity: Entity) -> Action | None:
        builder.check(entity, ("name", "value") if kind == "set-parameter" else ("filename",))
        needed: tuple[str, ...]
        if kind == "set-parameter":
            needed = ("name", "value")
            attributes = tuple(pair for pair in entity.attributes if pair[0] in needed)
        else:
            needed = ("filename",)
            attributes = tuple(("from", value) for name, value in entity.attributes if name == "filename")
        if any(builder.phrase(entity, name) is None for name in needed):
            return None
        holder = Entity("node", entity.location, (), (Entity("param", entity.location, attributes),))
        sources = parameter_sources(holder, builder.text, builder.wrong)
        return Action(kind=kind, location=entity.location, parameters=sources, tests=builder.tests(entity))

    return make


def _log(builder: Builder, entity: Entity) -> Action:
    return Action(kind="log", location=entity.location, tests=builder.tests(entity))


_MAKERS: Mapping[str, Callable[[Builder, Entity], Action | None]] = {
    "arg": _arg,
    "let": _simple("let", ("name", "value"), ("name", "value")),
    "group": _group,
    "include": _include,
    "executable": _executable,
    "log": _log,
    "log_info": _log,
    "log_warning": _log,
    "log_error": _log,
    "set_env": _simple("set-env", ("name", "value"), ("name", "value")),
    "unset_env": _simple("unset-env", ("name",), ("name",)),
    "append_env": _simple("append-env", ("name", "value", "prepend", "separator"), ("name", "value")),
    "reset_env": _simple("reset-env", (), ()),
    "reset": _reset,
    "timer": _timer,
    "ros_timer": _timer,
    "shutdown": _simple("shutdown", (), (), ("reason",)),
    "node": _node("node"),
    "node_container": _node("container"),
    "lifecycle_node": _node("lifecycle-node"),
    "load_composable_node": _load,
    "push_ros_namespace": _simple("push-namespace", ("namespace",), ("namespace",)),
    "set_remap": _remap,
    "set_parameter": _parameter("set-parameter"),
    "set_parameters_from_file": _parameter("set-parameters-from-file"),
    "set_use_sim_time": _simple("set-use-sim-time", ("value",), ("value",)),
    "set_ros_log_dir": _log,
    **ros2_gz.MAKERS,
}
