# SPDX-License-Identifier: Apache-2.0
"""Launch files that shut launch down: at once is a problem, when something has happened is what it is for."""

from __future__ import annotations

import pytest
from launching_kit import MAIN, launch

from haros_ci.launch.ros2.run import SHUT_DOWN

NODE = '<node pkg="p" exec="e"/>'


@pytest.mark.parametrize(
    "body", [f"<shutdown/>{NODE}", f"{NODE}<shutdown reason='done'/>", f"<group>{NODE}<shutdown/></group>"]
)
def test_at_once(body: str) -> None:
    found = launch(body)
    assert [(problem.path, problem.message) for problem in found.problems] == [(MAIN, SHUT_DOWN)]
    assert len(found.nodes) == 1


@pytest.mark.parametrize(
    "body",
    [
        NODE,
        f"{NODE}<timer period='5.0'><shutdown/></timer>",
        f"<arg name='end' default='false'/>{NODE}<shutdown if='$(var end)'/>",
        f"{NODE}<shutdown if='$(env END)'/>",
        f"{NODE}<shutdown unless='true'/>",
        f"{NODE}<group if='false'><shutdown/></group>",
    ],
)
def test_later_or_never(body: str) -> None:
    assert SHUT_DOWN not in [problem.message for problem in launch(body).problems]
