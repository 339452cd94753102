# SPDX-License-Identifier: Apache-2.0
"""Which interface a header or a Python name means."""

from __future__ import annotations

import pytest

from haros_ci.interfaces.references import Reference, of_import, of_include, references_to


@pytest.mark.parametrize(
    ("written", "kind", "name", "ros"),
    [
        ("demo/msg/battery_state.hpp", "msg", "BatteryState", 2),
        ("demo/msg/battery_state.h", "msg", "BatteryState", 2),
        ("demo/msg/detail/battery_state__struct.hpp", "msg", "BatteryState", 2),
        ("demo/msg/pose2_d.hpp", "msg", "Pose2D", 2),
        ("demo/srv/reset.hpp", "srv", "Reset", 2),
        ("demo/action/drive.hpp", "action", "Drive", 2),
        ("demo/BatteryState.h", "msg", "BatteryState", 1),
        ("demo/ResetRequest.h", "srv", "Reset", 1),
        ("demo/DriveActionGoal.h", "action", "Drive", 1),
        ("demo.msg.BatteryState", "msg", "BatteryState", 2),
        ("demo.srv.Reset", "srv", "Reset", 1),
        ("demo.srv.ResetResponse", "srv", "Reset", 1),
        ("demo.msg.DriveAction", "action", "Drive", 1),
        ("demo.action.Drive", "action", "Drive", 2),
    ],
)
def test_what_is_meant(written: str, kind: str, name: str, ros: int) -> None:
    found = of_include(written) if "/" in written else of_import(written)
    assert found is not None and found in references_to("demo", kind, name, ros)
    assert found not in references_to("other", kind, name, ros)
    assert found not in references_to("demo", kind, f"{name}Stamped", ros)


@pytest.mark.parametrize(
    "written",
    [
        "demo/demo.hpp",
        "demo/state.h",
        "demo/msg/state.hxx",
        "msg/state.hpp",
        "demo/messages/state.hpp",
        "demo/sub/State.h",
        "State.h",
        "",
    ],
)
def test_headers_that_mean_none(written: str) -> None:
    assert of_include(written) is None


@pytest.mark.parametrize(
    "written", ["demo.msg", "demo.State", "demo.msg._State", "demo.msg.state", "a.b.msg.State", ""]
)
def test_names_that_mean_none(written: str) -> None:
    assert of_import(written) is None


def test_kinds_are_apart_in_ros_2() -> None:
    assert Reference("demo", "msg", "reset") not in references_to("demo", "srv", "Reset", 2)
    assert Reference("demo", "", "reset") not in references_to("demo", "msg", "Reset", 2)
