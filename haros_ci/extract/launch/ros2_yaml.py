# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch files in YAML as actions (launch_yaml): the same elements as in XML, with typed values."""

from __future__ import annotations

from typing import Any

from haros_ci.bounded_yaml import MERGE, YamlFault
from haros_ci.extract.launch.ros2_actions import Builder
from haros_ci.extract.launch.ros2_entity import Entity, compose, scalar
from haros_ci.model.launch_actions import Description
from haros_ci.model.location import Location
from haros_ci.records import dataclass, field

#: How deep elements may be nested, and how many there may be once aliases are followed.
MAX_DEPTH = 40
MAX_ENTITIES = 50_000


def read_ros2_yaml(text: str, path: str) -> Description | None:
    """The actions of the launch file *text* at *path*: a map whose one key is ``launch``; never raises.

    An element that launch refuses is left out, with a problem; the rest is kept. None for a map of something else.
    """
    reader = _LaunchYamlReader(path)
    try:
        root = compose(text)
        if root is not None and is_other_data(root, path):
            return None
        if root is None or root.id != "mapping" or len(root.value) != 1 or root.value[0][0].value != "launch":
            line = 1 if root is None else root.start_mark.line + 1
            return Description(problems=((line, "not a launch file: it needs the one key 'launch', with a list"),))
        key, content = root.value[0]
        top = reader.entity("launch", content, key, 0)
    except YamlFault as err:
        fault = str(err)
        return Description(problems=((err.line, f"the launch file is {fault}" if fault.startswith("not ") else fault),))
    actions = reader.builder.actions(top.children)
    return Description(actions=actions, problems=tuple(reader.builder.problems))


def is_other_data(root: Any, path: str) -> bool:
    """Whether the YAML node *root* of the file at *path* is a map of something else, though its name is that of a launch file.

    Parameter files of nodes that are called so (``driver_launch.yaml``) have nodes as keys; only ``x.launch.yaml`` says what it is.
    """
    if root.id != "mapping" or not root.value or any(key.value == "launch" for key, _ in root.value):
        return False
    return not path.endswith((".launch.yaml", ".launch.yml")) or _has_parameters(root)


def _has_parameters(root: Any) -> bool:
    """Whether some map in *root*, or *root* itself, has the parameters of a node."""
    waiting, seen = [root], {id(root)}  # aliases may lead to the same map many times, and back
    while waiting:
        for key, value in waiting.pop().value:
            if key.value == "ros__parameters":
                return True
            if value.id == "mapping" and id(value) not in seen:
                seen.add(id(value))
                waiting.append(value)
    return False


@dataclass(slots=True)
class _LaunchYamlReader:
    path: str
    builder: Builder = field(default_factory=Builder)
    entities: int = 0

    def entity(self, tag: str, node: Any, at: Any, depth: int) -> Entity:
        """The element *tag* that *node* says, at the place of its key *at*."""
        mark = at.start_mark
        location = Location(self.path, mark.line + 1, mark.column + 1)
        self.entities += 1
        if depth > MAX_DEPTH or self.entities > MAX_ENTITIES:
            message = "the elements are nested too deeply, or are too many; flatten or split the file"
            raise YamlFault(message, mark.line + 1)
        attributes: list[tuple[str, Any]] = []
        children: list[Entity] = []
        if node.id == "sequence":
            self.elements(children, node, depth)
        elif node.id == "mapping":
            for name, (key, value) in self.pairs(node, mark.line + 1).items():
                if name == "children" and value.id == "sequence":
                    self.elements(children, value, depth)
                elif value.id == "scalar":
                    attributes.append((name, scalar(value)))
                elif value.id == "sequence" and value.value and all(item.id == "mapping" for item in value.value):
                    children.extend(self.entity(name, item, item, depth + 1) for item in value.value)
                elif value.id == "sequence" and all(item.id == "scalar" for item in value.value):
                    attributes.append((name, [scalar(item) for item in value.value]))
                else:
                    self.problem(key, f"'{name}' of '{tag}' is neither a value nor a list; correct it")
        elif scalar(node) is not None:
            self.problem(node, f"'{tag}' needs a map of its attributes")
        return Entity(tag, location, tuple(attributes), tuple(children), is_typed=True)

    def pairs(self, node: Any, line: int, merges: int = 0) -> dict[str, tuple[Any, Any]]:
        """The keys of a map and their values, as ``yaml.safe_load`` has them: the last of two keys counts, and one that is merged in only where there is no other."""
        merged: dict[str, tuple[Any, Any]] = {}
        own: dict[str, tuple[Any, Any]] = {}
        for key, value in node.value:
            self.entities += merges > 0
            if merges > MAX_DEPTH or self.entities > MAX_ENTITIES:
                raise YamlFault("too much is merged into a map; write it out", line)
            if key.tag != MERGE:
                own[str(key.value) if key.id == "scalar" else ""] = (key, value)
                continue
            parts = [one for one in (value.value if value.id == "sequence" else [value]) if one.id == "mapping"]
            for part in reversed(parts):
                merged.update(self.pairs(part, line, merges + 1))
            if not parts:
                self.problem(key, "'<<' merges a map, or a list of maps, into this one; correct it")
        return {**merged, **own}

    def elements(self, found: list[Entity], node: Any, depth: int) -> None:
        for item in node.value:
            if item.id != "mapping" or len(item.value) != 1 or item.value[0][0].id != "scalar":
                self.problem(item, "each item of a list must be a map with one key, the tag; split this item")
            else:
                key, content = item.value[0]
                found.append(self.entity(str(key.value), content, key, depth + 1))

    def problem(self, node: Any, message: str) -> None:
        self.builder.problems[(node.start_mark.line + 1, message)] = None
