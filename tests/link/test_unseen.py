# SPDX-License-Identifier: Apache-2.0
"""Library classes that make more than a row can tell: what they make for certain, and that there is more."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

OUTSIDE = (
    "#include <controller_manager/controller_manager.h>\n#include <costmap_2d/costmap_2d_ros.h>\n"
    "struct Robot {}; tf2_ros::Buffer* buffer();\n"
)
SERVICES = ("list_controller_types", "list_controllers", "load_controller", "reload_controller_libraries")
SERVICES = (*SERVICES, "switch_controller", "unload_controller")
#: Code of ``main``, the services that it offers, and why there may be more endpoints.
CASES = (
    ("Robot r; controller_manager::ControllerManager cm(&r);", "/", "controllers are loaded when the system runs"),
    ("Robot r; controller_manager::ControllerManager cm(&r, nh);", "/", "controllers are loaded when the system runs"),
    (
        'Robot r; controller_manager::ControllerManager cm(&r, ros::NodeHandle("arm"));',
        "/arm/",
        "controllers are loaded when the system runs",
    ),
    (
        "Robot r; controller_manager::ControllerManager* cm = new controller_manager::ControllerManager(&r);",
        "/",
        "controllers are loaded when the system runs",
    ),
    ('costmap_2d::Costmap2DROS c("local", *buffer());', None, "a costmap and its layers are made"),
    ("controller_manager::ControllerManager* cm = NULL;", None, None),
    ("costmap_2d::Costmap2DROS* c;", None, None),
    ("costmap_2d::Costmap2D c;", None, None),
)


@pytest.mark.parametrize(("code", "above", "why"), CASES)
def test_what_is_made_and_that_there_is_more(code: str, above: str | None, why: str | None) -> None:
    found = cpp('ADV("base", 1); ' + code, OUTSIDE)
    expected = [] if above is None else [f"{above}controller_manager/{service}" for service in SERVICES]
    assert names(found, "servers") == expected
    assert [each.reason for each in found.unknowns if each.field == "endpoints"] == ([why] if why else [])
