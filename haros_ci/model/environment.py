# SPDX-License-Identifier: Apache-2.0
"""The environment variables that launch files see: what is given, and what the workspace itself sets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from haros_ci.records import dataclass, field


@dataclass(frozen=True, slots=True)
class Environment(Mapping[str, str]):
    """Variables with their values. *lost* are set as well, to what is not known; each has the reason. *chosen* are names of variables whose
    value is a default, which another environment may have otherwise.
    """

    given: Mapping[str, str] = field(default_factory=dict)
    lost: Mapping[str, str] = field(default_factory=dict)
    chosen: frozenset[str] = frozenset()

    def __getitem__(self, name: str) -> str:
        return self.given[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.given)

    def __len__(self) -> int:
        return len(self.given)

    def __bool__(self) -> bool:
        return bool(self.given or self.lost)

    def over(self, *layers: Mapping[str, str] | None) -> Environment:
        """The same with what each of *layers* sets, the later ones before the earlier."""
        values, lost, chosen = dict(self.given), dict(self.lost), set(self.chosen)
        for layer in layers:
            if not layer:
                continue
            more, doubts = dict(layer), lost_of(layer)
            for name in (*more, *doubts):
                values.pop(name, None)
                lost.pop(name, None)
                chosen.discard(name)
            values.update(more)
            lost.update(doubts)
            chosen |= chosen_of(layer)
        return Environment(values, lost, frozenset(chosen))

    @property
    def key(self) -> tuple[object, ...]:
        """What tells it from another one."""
        return tuple(sorted(self.given.items())), tuple(sorted(self.lost.items())), tuple(sorted(self.chosen))


#: No variable at all.
NOTHING = Environment()


def lost_of(environment: Mapping[str, str]) -> Mapping[str, str]:
    """The variables that are set to what is not known, with the reason of each."""
    return environment.lost if isinstance(environment, Environment) else {}


def chosen_of(environment: Mapping[str, str]) -> frozenset[str]:
    """The variables whose value is a default."""
    return environment.chosen if isinstance(environment, Environment) else frozenset()


def key_of(environment: Mapping[str, str]) -> tuple[object, ...]:
    """What tells an environment from another one, to look up what was made for it."""
    return environment.key if isinstance(environment, Environment) else Environment(environment).key
