# SPDX-License-Identifier: Apache-2.0
"""An element of a ROS 2 launch file before it is understood, the same for XML and YAML; YAML within fixed limits."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from haros_ci.model.location import Location

MAX_DEPTH = 50
MAX_VALUES = 100_000
MAX_CHARACTERS = 1_000_000
#: Longer texts are no numbers.
_MAX_NUMBER = 100
_TAG = "tag:yaml.org,2002:"


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


class YamlError(Exception):
    """Not YAML, or refused; *line* is 1-based."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.line = line


def compose(text: str) -> Any:
    """The node graph of the first document in *text*, None if it is empty; YamlError for what is refused."""
    if len(text) > MAX_CHARACTERS:
        raise YamlError(f"more than {MAX_CHARACTERS} characters; split it", 1)
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    depth = 0
    try:
        for count, event in enumerate(yaml.parse(text, Loader=loader)):
            line = event.start_mark.line + 1 if event.start_mark else 1
            if isinstance(event, yaml.CollectionStartEvent):
                depth += 1
            elif isinstance(event, yaml.CollectionEndEvent):
                depth -= 1
            if depth > MAX_DEPTH:
                raise YamlError(f"nested deeper than {MAX_DEPTH} levels; flatten it", line)
            if count > MAX_VALUES:
                raise YamlError(f"more than {MAX_VALUES} values; split it", line)
        return next(iter(yaml.compose_all(text, Loader=loader)), None)
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        raise YamlError(f"not valid YAML: {err.problem}; correct it", mark.line + 1 if mark else 1) from err
    except (yaml.YAMLError, UnicodeError) as err:
        raise YamlError("not valid YAML: it holds a control character; remove it", 1) from err


def scalar(node: Any) -> Any:
    """The value of a scalar node as ``yaml.safe_load`` makes it; its text where that is none of the plain types."""
    import yaml

    kind = node.tag.removeprefix(_TAG)
    if kind not in ("int", "float", "bool", "null") or len(node.value) > _MAX_NUMBER:
        return str(node.value)
    try:
        return yaml.constructor.SafeConstructor().construct_object(node)
    except (ValueError, KeyError, IndexError, OverflowError, yaml.YAMLError):
        return str(node.value)


def loaded(text: str) -> Any:
    """A value that stands in an XML attribute as YAML: a scalar or a flat list; *text* itself if it is none of them."""
    if not text or (text[0].isalpha() and text.isidentifier() and text.lower() not in _WORDS):
        return text
    try:
        node = compose(text)
    except YamlError:
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
    near = [] if tag in _INSIDE or len(tag) > _MAX_NUMBER else get_close_matches(tag.replace("-", "_"), known, 1, 0.75)
    if near or tag in _INSIDE:
        return (
            f"launch knows no <{tag}> here; {f'did you mean <{near[0]}>?' if near else 'move it to where it belongs'}"
        )
    return f"{EXTENSION} <{tag}>: ros2 launch refuses the file, unless an installed package registers the tag; correct its name, or declare that package"
