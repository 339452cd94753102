# SPDX-License-Identifier: Apache-2.0
"""An element of a ROS 2 launch file before it is understood, the same for XML and YAML; YAML within fixed limits."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any

from haros_ci.bounded_yaml import MAX_NUMBER, TAG, YamlFault, YamlLimits, nodes, scalar_value
from haros_ci.model.location import Location
from haros_ci.records import dataclass

LIMITS = YamlLimits(values=100_000)


@dataclass(frozen=True, slots=True)
class Entity:
    """A tag with its *attributes*: texts in XML; None, bool, int, float, str or lists of them in YAML (*is_typed*).

    *children* are the tags in it; in YAML the entries of ``children`` and of attributes that are lists of maps, as
    ``param`` is.
    """

    tag: str
    location: Location
    attributes: tuple[tuple[str, Any], ...] = ()
    children: tuple[Entity, ...] = ()
    is_typed: bool = False

    def get(self, name: str) -> Any:
        """The attribute *name*; None if it is not there."""
        return next((value for key, value in self.attributes if key == name), None)

    def all(self, *tags: str) -> tuple[Entity, ...]:
        return tuple(child for child in self.children if child.tag in tags)


def compose(text: str) -> Any:
    """The node graph of the first document in *text*, None if it is empty; YamlFault for what is refused."""
    return next(nodes(text, LIMITS), None)


def scalar(node: Any) -> Any:
    """The value of a scalar node as ``yaml.safe_load`` makes it; its text where that is none of the plain types."""
    kind = node.tag.removeprefix(TAG)
    try:
        return scalar_value(kind, node.value) if kind in ("int", "float", "bool", "null") else str(node.value)
    except ValueError:
        return str(node.value)


def loaded(text: str) -> Any:
    """A value that stands in an XML attribute as YAML: a scalar or a flat list; *text* itself if it is none of them."""
    if not text or (text[0].isalpha() and text.isidentifier() and text.lower() not in _WORDS):
        return text
    try:
        node = compose(text)
    except YamlFault:
        return text
    if node is None or node.id == "mapping":
        return text
    if node.id == "scalar":
        return scalar(node)
    if all(item.id == "scalar" for item in node.value):
        return [scalar(item) for item in node.value]
    return text


_WORDS = frozenset(("y", "n", "yes", "no", "on", "off", "true", "false", "null"))


#: How a sentence begins on a tag that an extension may have (entry points ``launch.frontend.launch_extension``, ``expose_action``).
EXTENSION = "launch itself has no"
#: Tags that launch and launch_ros read inside others only.
_INSIDE = frozenset(("param", "remap", "env", "composable_node", "extra_arg", "keep"))


def unknown_tag(tag: str, known: Iterable[str]) -> str:
    """What is wrong with a tag that is none of the *known* ones of launch: it may be one of an extension, unless it is like one that launch has."""
    near = [] if tag in _INSIDE or len(tag) > MAX_NUMBER else get_close_matches(tag.replace("-", "_"), known, 1, 0.75)
    if near or tag in _INSIDE:
        return (
            f"launch knows no <{tag}> here; {f'did you mean <{near[0]}>?' if near else 'move it to where it belongs'}"
        )
    return f"{EXTENSION} <{tag}>: ros2 launch refuses the file, unless an installed package registers the tag; correct its name, or declare that package"
