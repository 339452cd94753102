# SPDX-License-Identifier: Apache-2.0
"""Variables of launch files by which nodes of ROS 2 do not find each other."""

from __future__ import annotations

import pytest

from haros_ci.linters.other_domains import variables

HEAD = "from launch.actions import SetEnvironmentVariable\n"
NAMED = [
    ("python", HEAD + "x = SetEnvironmentVariable('ROS_DOMAIN_ID', '7')\n", [(2, "ROS_DOMAIN_ID")]),
    ("python", HEAD + "x = Node(additional_env={'ROS_LOCALHOST_ONLY': '1'})\n", [(2, "ROS_LOCALHOST_ONLY")]),
    ("launch", '<launch>\n<set_env name="RMW_IMPLEMENTATION" value="a"/>\n</launch>', [(2, "RMW_IMPLEMENTATION")]),
    ("yaml", "launch:\n- set_env: {name: ROS_DOMAIN_ID, value: '1'}\n", [(2, "ROS_DOMAIN_ID")]),
    ("python", HEAD + "a = 'ROS_DOMAIN_ID'\nb = 'ROS_DOMAIN_ID'\n", [(2, "ROS_DOMAIN_ID"), (3, "ROS_DOMAIN_ID")]),
]
QUIET = [
    ("python", "import os\nx = os.environ['ROS_DOMAIN_ID']\n"),
    ("python", HEAD + "# ROS_DOMAIN_ID\n"),
    ("python", HEAD + "x = 'MY_ROS_DOMAIN_ID'\n"),
    ("python", HEAD + "x = 'ROS_DOMAIN_IDS'\n"),
    ("launch", "<launch><!-- ROS_DOMAIN_ID --></launch>"),
    ("launch", '<launch><set_env name="ROS_LOG_DIR" value="a"/></launch>'),
    ("yaml", "launch:\n# ROS_DOMAIN_ID\n- let: {name: a, value: b}\n"),
    ("yaml", ""),
]


@pytest.mark.parametrize(("language", "text", "found"), NAMED)
def test_named(language: str, text: str, found: list[tuple[int, str]]) -> None:
    assert [*variables(text, language)] == found


@pytest.mark.parametrize(("language", "text"), QUIET)
def test_quiet(language: str, text: str) -> None:
    assert [*variables(text, language)] == []
