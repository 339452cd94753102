# SPDX-License-Identifier: Apache-2.0
"""The scope that a tag stands in: its namespace, args, remaps and conditions."""

from __future__ import annotations

from dataclasses import replace

from haros_ci.model.architecture import Condition, Parameter, RemapRule
from haros_ci.model.launch import LaunchElement
from haros_ci.model.location import Location
from haros_ci.model.presence import Presence
from haros_ci.records import dataclass, field
from haros_ci.substitutions.names import Text


@dataclass(frozen=True, slots=True)
class Private:
    """A ``~name`` param of a scope: every node declared after it gets one."""

    name: Text
    parameter: Parameter


@dataclass(frozen=True, slots=True)
class Remap:
    """A ``<remap>`` tag; its target is unknown where it is undecided whether it holds. *rule* is what is written."""

    source: Text
    target: Text
    location: Location
    rule: RemapRule


@dataclass(slots=True, kw_only=True)
class LoaderScope:
    """Where a tag stands, as roslaunch's loader context. *declared* maps args to the line of their tag; *doubtful* are
    those that an undecided condition may have set; *missing* those declared that nothing sets."""

    path: str
    namespace: Text
    directory: str
    args: dict[str, Text] = field(default_factory=dict)
    declared: dict[str, int] = field(default_factory=dict)
    missing: dict[str, int] = field(default_factory=dict)
    doubtful: set[str] = field(default_factory=set)
    overrides_allowed: bool = False
    privates: list[Private] = field(default_factory=list)
    remaps: tuple[Remap, ...] = ()
    environment: tuple[tuple[Text, Text], ...] = ()
    conditions: tuple[Condition, ...] = ()
    chain: tuple[tuple[object, ...], ...] = ()
    included_at: Location | None = None
    depth: int = 0
    #: The includes that lead here, outermost first.
    includes: tuple[Location, ...] = ()
    #: Under which launch arguments that is done which is being evaluated.
    presence: Presence = ()
    #: Args that are set with other args of the top level only.
    unset: dict[str, Text] = field(default_factory=dict)
    #: Whether what is set here counts for all nodes of the scope, not for one.
    is_shared: bool = True

    def isolated(self) -> LoaderScope:
        """A copy of which nothing that is done in it is seen outside."""
        return replace(
            self.child(self.namespace, self.conditions), overrides_allowed=self.overrides_allowed, depth=self.depth
        )

    def child(self, namespace: Text, conditions: tuple[Condition, ...]) -> LoaderScope:
        """A scope inside this one; what is set in it stays in it."""
        return replace(
            self,
            namespace=namespace,
            args=dict(self.args),
            declared=dict(self.declared),
            missing=dict(self.missing),
            doubtful=set(self.doubtful),
            unset=dict(self.unset),
            overrides_allowed=False,
            privates=list(self.privates),
            conditions=conditions,
            depth=self.depth + 1,
        )

    def add_remap(self, remap: Remap) -> None:
        """A later one with the same source replaces an earlier one (roslaunch compares them as written)."""
        same = [old for old in self.remaps if old.source.raw == remap.source.raw and old.source.known]
        self.remaps = (*(old for old in self.remaps if old not in same), remap)


def location(scope: LoaderScope, tag: LaunchElement) -> Location:
    return Location(scope.path, tag.line, tag.column)
