# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin, within limits: what the parser says is counted before anything is made of it.

Nothing is constructed but what YAML itself knows. ``data`` and ``nodes`` are for who takes YAML as PyYAML does; they follow no
aliases: whoever walks through nodes or data counts what is visited, as an alias may stand for much, or for itself. ``Composer``
is for who makes values of another kind: with lines and columns, with keys that stand twice, with tags of its own; it follows
aliases and counts what they stand for. ``scalar_value`` is what PyYAML makes of a number that stands in any of them.

One reader stays apart: ``systems/known`` reads the files that come with haros-ci, which are of no unknown origin.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol, TypeVar

from haros_ci.bounded_yaml.scalars import MAX_NUMBER, TAG, Scalar, scalar_value
from haros_ci.bounded_yaml.words import explained
from haros_ci.records import dataclass

if TYPE_CHECKING:
    import yaml

__all__ = ["MAX_NUMBER", "MERGE", "TAG", "Composed", "Composer", "Scalar", "YamlFault", "YamlLimits", "YamlTooLarge"]
__all__ += ["check", "data", "events", "nodes", "scalar_value"]


@dataclass(frozen=True, slots=True)
class YamlLimits:
    """How much a text may hold: characters, collections within each other, values, and aliases."""

    characters: int = 1_000_000
    depth: int = 50
    values: int = 1_000_000
    aliases: int = 1_000_000


MERGE = TAG + "merge"


class YamlFault(Exception):
    """The text is not plain YAML: *message* says why and what to do, *problem* why alone, *line* where: 1 if that is not known (*is_placed*).

    *advice* is what to do alone, where the two are separate.
    """

    def __init__(self, problem: str, line: int | None = None, *, message: str = "", advice: str = "") -> None:
        message = message or (f"{problem}; {advice}" if advice else problem)
        super().__init__(message)
        self.problem = problem
        self.message = message
        self.advice = advice
        self.line = line or 1
        self.is_placed = line is not None


class YamlTooLarge(YamlFault):
    """It may be YAML, but is over a limit."""


def check(text: str, limits: YamlLimits) -> None:
    """YamlFault if *text* is no YAML, or over a limit."""
    for _ in events(text, limits):
        pass


def events(text: str, limits: YamlLimits) -> Iterator[yaml.Event]:
    """What PyYAML's parser says of *text*; YamlFault as ``check``, where it is reached."""
    if len(text) > limits.characters:
        raise YamlTooLarge(f"more than {limits.characters} characters; split it")
    import yaml

    depth = values = aliases = 0
    with _faults():
        for event in yaml.parse(text, Loader=_loader()):
            if isinstance(event, yaml.CollectionEndEvent):
                depth -= 1
            elif isinstance(event, yaml.NodeEvent):
                values += 1
                aliases += isinstance(event, yaml.AliasEvent)
                depth += isinstance(event, yaml.CollectionStartEvent)
                line = event.start_mark.line + 1 if event.start_mark else 1
                if depth > limits.depth:
                    raise YamlTooLarge(f"nested deeper than {limits.depth} levels; flatten it", line)
                if values > limits.values:
                    raise YamlTooLarge(f"more than {limits.values} values; split it", line)
                if aliases > limits.aliases:
                    raise YamlTooLarge(f"more than {limits.aliases} aliases; write them out", line)
            yield event


def nodes(text: str, limits: YamlLimits) -> Iterator[yaml.Node]:
    """The documents of *text* as nodes, those that are empty left out; YamlFault as ``check``, when one is asked for."""
    check(text, limits)
    import yaml

    with _faults():
        yield from (node for node in yaml.compose_all(text, Loader=_loader()) if node is not None)


def data(text: str, limits: YamlLimits) -> object:
    """What ``yaml.safe_load`` makes of *text*; YamlFault as ``check``, and for a value that is not of the type of its tag."""
    check(text, limits)
    import yaml

    with _faults():
        try:
            return yaml.load(text, Loader=_loader())
        except (KeyError, IndexError, AttributeError, TypeError) as err:  # PyYAML's constructors
            problem = "a value is not of the type that its tag (!!bool, !!int, !!timestamp) names"
            raise YamlFault(problem, message=f"{problem}; write the value without the tag") from err
        except (ValueError, OverflowError, RecursionError) as err:
            raise YamlFault((str(err).splitlines() or ["not YAML"])[0]) from err


class Composed(Protocol):
    """What a ``Composer`` makes: *data* is a scalar, a tuple or a dictionary; *size* counts the values in it."""

    @property
    def data(self) -> Any: ...

    @property
    def size(self) -> int: ...


Made = TypeVar("Made", bound=Composed)


class Composer(ABC, Generic[Made]):
    """Makes values of the events of one document; aliases and what they stand for are counted, recursion is bounded by the depth.

    Who derives from it says what a scalar is, what a value keeps of its place, and how faults are worded.
    """

    #: What is said of a fault: what it is, and what to do.
    SAYS: ClassVar[Mapping[str, tuple[str, str]]] = {
        "depth": ("nested deeper than {} levels", "flatten it"),
        "aliases": ("more than {} aliases", "write the values out"),
        "values": ("more than {} values, aliases counted", "split it"),
        "undefined": ("alias {} is not defined above", "write the value out"),
        "cycle": ("alias {} contains itself", "write the value out"),
        "key": ("a list or map cannot be a key", "use text"),
        "merge": ("'<<' merges maps only", "give it an alias of a map"),
        "collection": ("tag {} is not allowed", "write plain lists and maps"),
        "long": ("number too long", "quote it if it is text"),
        "kind": ("{} is no {}", "correct or quote it"),
        "second": ("a second document begins here", "keep one"),
    }
    SYNTAX: ClassVar[str] = "not valid YAML: {}; correct it"
    #: Whether one document alone is allowed, or what follows the first is left alone.
    is_single: ClassVar[bool] = True
    #: Whether a list or map may have YAML's own tags alone, and ``<<`` may stand before maps alone.
    is_strict: ClassVar[bool] = True

    def __init__(self, text: str, limits: YamlLimits) -> None:
        self.limits = limits
        self.source = text
        self.anchors: dict[str, Made | None] = {}
        self.aliases = 0
        self.values = 0
        self.yaml: ModuleType
        self.loader: Any

    @abstractmethod
    def scalar(self, event: Any, tag: str) -> object:
        """The value of a scalar with the tag *tag*, written or resolved."""

    @abstractmethod
    def made(self, event: Any, data: Any, size: int) -> Made:
        """*data* as a value that begins at *event*."""

    @abstractmethod
    def under(self, value: Made, event: Any) -> Made:
        """*value* as it stands under the key at *event*."""

    def again(self, value: Made, event: Any) -> Made:
        """*value* as the alias at *event* has it."""
        return value

    def twice(self, key: Any, event: Any, first: Made) -> None:
        """*key* stands at *event*, and before with *first*; the last one counts."""

    quoted: Callable[[str], str] = staticmethod(repr)  #: *text* as a message shows it

    def document(self) -> Made | None:
        """The value of the document, None if there is none; YamlFault for what is malformed, refused or over a limit."""
        if len(self.source) > self.limits.characters:
            raise YamlTooLarge(f"more than {self.limits.characters} characters; split it")
        import yaml

        self.yaml = yaml
        with _faults(self.SYNTAX):
            self.loader = _loader()(self.source)
            try:
                return self._document()
            finally:
                self.loader.dispose()

    def _document(self) -> Made | None:
        self.loader.get_event()  # the stream's start
        if isinstance(self.loader.peek_event(), self.yaml.StreamEndEvent):
            return None
        self.loader.get_event()  # the document's start
        top = self._value(0)
        if self.is_single:
            self.loader.get_event()  # its end
            if not isinstance(after := self.loader.get_event(), self.yaml.StreamEndEvent):
                raise self.fault(after, "second")
        return top

    def _value(self, depth: int) -> Made:
        event = self.loader.get_event()
        if isinstance(event, self.yaml.AliasEvent):
            return self._alias(event)
        if depth >= self.limits.depth:
            raise self.fault(event, "depth", self.limits.depth)
        self._count(event, 1)
        if event.anchor is not None:
            self.anchors[event.anchor] = None  # known, but not complete: an alias to it inside it is a cycle
        if isinstance(event, self.yaml.ScalarEvent):
            made = self.made(event, self.scalar(event, self.tag(event)), 1)
        elif isinstance(event, self.yaml.SequenceStartEvent):
            made = self._sequence(event, depth)
        else:
            made = self._mapping(event, depth)
        if event.anchor is not None:
            self.anchors[event.anchor] = made
        return made

    def _alias(self, event: Any) -> Made:
        self.aliases += 1
        if self.aliases > self.limits.aliases:
            raise self.fault(event, "aliases", self.limits.aliases)
        target = self.anchors.get(event.anchor)
        if target is None:
            raise self.fault(event, "cycle" if event.anchor in self.anchors else "undefined", self.quoted(event.anchor))
        self._count(event, target.size)
        return self.again(target, event)

    def _sequence(self, event: Any, depth: int) -> Made:
        self._check_tag(event, "seq")
        items: list[Made] = []
        while not isinstance(self.loader.peek_event(), self.yaml.SequenceEndEvent):
            items.append(self._value(depth + 1))
        self.loader.get_event()
        return self.made(event, tuple(items), 1 + sum(item.size for item in items))

    def _mapping(self, event: Any, depth: int) -> Made:
        self._check_tag(event, "map")
        own: dict[Any, Made] = {}
        merged: list[dict[Any, Made]] = []
        while not isinstance(key_event := self.loader.peek_event(), self.yaml.MappingEndEvent):
            is_merge = isinstance(key_event, self.yaml.ScalarEvent) and self._is_merge(key_event)
            key = self._value(depth + 1).data
            if isinstance(key, (dict, tuple)):
                raise self.fault(key_event, "key")
            item = self._value(depth + 1)
            if is_merge:
                merged += self._merged(key_event, item)
                continue
            if key in own:
                self.twice(key, key_event, own[key])
            own[key] = self.under(item, key_event)
        self.loader.get_event()
        # the first merged map wins, own keys win over all (yaml.org/type/merge)
        entries = {key: item for base in (*reversed(merged), own) for key, item in base.items()}
        return self.made(event, entries, 1 + sum(1 + item.size for item in entries.values()))

    def _is_merge(self, event: Any) -> bool:
        return (event.value == "<<" or event.tag is not None) and self.tag(event) == MERGE

    def _merged(self, event: Any, item: Made) -> list[dict[Any, Made]]:
        parts = item.data if isinstance(item.data, tuple) else (item,)
        maps = [part.data for part in parts if isinstance(part.data, dict)]
        if self.is_strict and len(maps) < len(parts):
            raise self.fault(event, "merge")
        return maps

    def tag(self, event: Any) -> str:
        """The tag of a scalar, as it is written, or as YAML 1.1 resolves it."""
        if event.tag is not None and event.tag != "!":
            return str(event.tag)
        return str(self.loader.resolve(self.yaml.ScalarNode, event.value, event.implicit))

    def number(self, event: Any, tag: str) -> Scalar:
        """The int, float, bool or null at *event*."""
        if len(event.value) > MAX_NUMBER:
            raise self.fault(event, "long")
        try:
            return scalar_value(tag.removeprefix(TAG), event.value)
        except ValueError as err:
            raise self.fault(event, "kind", self.quoted(event.value), tag.removeprefix(TAG)) from err

    def _check_tag(self, event: Any, kind: str) -> None:
        if self.is_strict and event.tag not in (None, "!", TAG + kind):
            raise self.fault(event, "collection", self.quoted(event.tag))

    def _count(self, event: Any, values: int) -> None:
        self.values += values
        if self.values > self.limits.values:
            raise self.fault(event, "values", self.limits.values)

    def fault(self, event: Any, key: str, *shown: object) -> YamlFault:
        """The fault *key* of ``SAYS`` at *event*."""
        problem, advice = self.SAYS[key]
        return YamlFault(problem.format(*shown), event.start_mark.line + 1, advice=advice.format(*shown))


def _loader() -> type[yaml.SafeLoader]:
    """libyaml where PyYAML has it."""
    import yaml

    loader: type[yaml.SafeLoader] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return loader


@contextmanager
def _faults(syntax: str = Composer.SYNTAX) -> Iterator[None]:
    """What PyYAML refuses, as faults."""
    import yaml

    try:
        yield
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        problem = explained(str(err.problem or err.context or "it is cut off"))
        raise YamlFault(problem, mark.line + 1 if mark else None, message=syntax.format(problem)) from err
    except (yaml.YAMLError, UnicodeError) as err:
        problem = "it holds a control character"
        raise YamlFault(problem, message=f"not valid YAML: {problem}; remove it") from err
