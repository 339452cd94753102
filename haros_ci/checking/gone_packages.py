# SPDX-License-Identifier: Apache-2.0
"""Packages of ROS 2 that newer distributions do not have, and what they are called there."""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.knowledge.knowledge import knowledge

#: By the old name what to do instead (https://docs.nav2.org/migration/Galactic.html, "Recovery To Behavior" and "Deletion of nav2_gazebo_spawner").
_INSTEAD = {
    "nav2_recoveries": "is called nav2_behaviors since Humble: rename it where it is named, too",
    "nav2_gazebo_spawner": "is in no distribution after Galactic: start spawn_entity.py of gazebo_ros instead",
}


def said_gone(names: Iterable[str], ros: int | None) -> str:
    """What to add to advice that *names* be declared, in brackets: which of them newer distributions do not have. "" if they have all."""
    found = []
    for name in names if ros == 2 else ():
        last = knowledge().last_of_the_past(name)
        if last is not None:
            found.append(f"{name} {_INSTEAD.get(name, f'is in no distribution after {last.title()}')}")
    return f" ({'; '.join(found)})" if found else ""
