# SPDX-License-Identifier: Apache-2.0
"""A class in a description that nothing registers: what to write there, in one finding for one mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend><depend>pluginlib</depend><depend>nav2_core</depend>"
    "<export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = (
    "project(demo)\nfind_package(ament_cmake REQUIRED)\nadd_library(gear SHARED gear.cpp)\ninstall(TARGETS gear DESTINATION lib)\n"
    "pluginlib_export_plugin_description_file(nav2_core plugins.xml)\nament_package()\n"
)


def source(*registered: tuple[str, str], classes: tuple[str, ...] = ()) -> str:
    names = [name for name, _ in registered]
    body = "".join(f"class {name.rpartition('::')[2]} {{}};\n" for name in (*names, *classes))
    macros = "".join(f"PLUGINLIB_EXPORT_CLASS({name}, {base})\n" for name, base in registered)
    return f"#include <pluginlib/class_list_macros.hpp>\nnamespace demo {{\n{body}}}\n{macros}"


def description(*classes: tuple[str, str]) -> str:
    inside = "".join(f'<class type="{name}" base_class_type="{base}"/>\n' for name, base in classes)
    return f'<library path="gear">\n{inside}</library>\n'


def messages(check_id: str, cpp: str, xml: str, folder: Path) -> list[str]:
    files = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, "gear.cpp": cpp, "plugins.xml": xml}
    check = next(check for check in checks() if check.id == check_id)
    return [result.message for result in said(check, Example("", True, files), folder)]


CONTROLLER, PLANNER = "nav2_core::Controller", "nav2_core::GlobalPlanner"


@pytest.mark.parametrize(
    ("cpp", "xml"),
    [
        (source(("demo::Low", CONTROLLER)), description(("gear", CONTROLLER))),
        (source(("demo::Low", CONTROLLER)), description(("demo::LowerGear", CONTROLLER))),
        (
            source(("demo::Low", CONTROLLER), ("demo::Way", PLANNER)),
            description(("gear", CONTROLLER), ("demo::Way", PLANNER)),
        ),
        (
            source(("demo::Low", CONTROLLER), ("demo::High", CONTROLLER)),
            description(("gear", CONTROLLER), ("demo::High", CONTROLLER)),
        ),
    ],
)
def test_the_class_that_is_registered_is_meant(cpp: str, xml: str, tmp_path: Path) -> None:
    (message,) = messages("plugin-not-loadable", cpp, xml, tmp_path / "a")
    assert message.endswith('registers demo::Low, which no description names: write type="demo::Low"')
    assert messages("plugin-not-described", cpp, xml, tmp_path / "b") == []


@pytest.mark.parametrize(
    ("cpp", "xml", "not_described"),
    [
        # the class is there, its macro is what lacks
        (
            source(("demo::Low", CONTROLLER), classes=("High",)),
            description(("demo::High", CONTROLLER)),
            1,
        ),
        # another base
        (source(("demo::Low", CONTROLLER)), description(("gear", PLANNER)), 1),
        # two that may be meant
        (source(("demo::Low", CONTROLLER), ("demo::High", CONTROLLER)), description(("gear", CONTROLLER)), 2),
        # all are described
        (
            source(("demo::Low", CONTROLLER)),
            description(("demo::Low", CONTROLLER), ("gear", CONTROLLER)),
            0,
        ),
    ],
)
def test_no_class_is_meant_for_certain(cpp: str, xml: str, not_described: int, tmp_path: Path) -> None:
    (message,) = messages("plugin-not-loadable", cpp, xml, tmp_path / "a")
    assert "write type=" not in message
    assert len(messages("plugin-not-described", cpp, xml, tmp_path / "b")) == not_described


def test_what_fits_is_quiet(tmp_path: Path) -> None:
    cpp, xml = source(("demo::Low", CONTROLLER)), description(("demo::Low", CONTROLLER))
    assert messages("plugin-not-loadable", cpp, xml, tmp_path / "a") == []
    assert messages("plugin-not-described", cpp, xml, tmp_path / "b") == []
