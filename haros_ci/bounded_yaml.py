# SPDX-License-Identifier: Apache-2.0
"""YAML of unknown origin, within limits: what the parser says is counted before anything is made of it.

Nothing is constructed but what YAML itself knows. Aliases are not followed here: whoever walks through nodes or data counts what
is visited, as an alias may stand for much, or for itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import yaml


@dataclass(frozen=True, slots=True)
class Limits:
    """How much a text may hold: characters, collections within each other, values, and aliases."""

    characters: int = 1_000_000
    depth: int = 50
    values: int = 1_000_000
    aliases: int = 1_000_000


class YamlFault(Exception):
    """The text is not plain YAML: *message* says why and what to do, *problem* why alone, *line* where: 1 if that is not known (*is_placed*)."""

    def __init__(self, problem: str, line: int | None = None, *, message: str = "") -> None:
        super().__init__(message or problem)
        self.problem = problem
        self.message = message or problem
        self.line = line or 1
        self.is_placed = line is not None


class TooMuch(YamlFault):
    """It may be YAML, but is over a limit."""


def check(text: str, limits: Limits) -> None:
    """YamlFault if *text* is no YAML, or over a limit."""
    if len(text) > limits.characters:
        raise TooMuch(f"more than {limits.characters} characters; split it")
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
                    raise TooMuch(f"nested deeper than {limits.depth} levels; flatten it", line)
                if values > limits.values:
                    raise TooMuch(f"more than {limits.values} values; split it", line)
                if aliases > limits.aliases:
                    raise TooMuch(f"more than {limits.aliases} aliases; write them out", line)


def nodes(text: str, limits: Limits) -> Iterator[yaml.Node]:
    """The documents of *text* as nodes, those that are empty left out; YamlFault as ``check``, when one is asked for."""
    check(text, limits)
    import yaml

    with _faults():
        for node in yaml.compose_all(text, Loader=_loader()):
            if node is not None:
                yield node


def data(text: str, limits: Limits) -> object:
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


def _loader() -> type[yaml.SafeLoader]:
    """libyaml where PyYAML has it."""
    import yaml

    loader: type[yaml.SafeLoader] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return loader


@contextmanager
def _faults() -> Iterator[None]:
    """What PyYAML refuses, as faults."""
    import yaml

    try:
        yield
    except yaml.MarkedYAMLError as err:
        mark = err.problem_mark or err.context_mark
        problem = str(err.problem or err.context or "it is cut off")
        message = f"not valid YAML: {problem}; correct it"
        raise YamlFault(problem, mark.line + 1 if mark else None, message=message) from err
    except (yaml.YAMLError, UnicodeError) as err:
        problem = "it holds a control character"
        raise YamlFault(problem, message=f"not valid YAML: {problem}; remove it") from err
