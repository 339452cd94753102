# SPDX-License-Identifier: Apache-2.0
"""docs/configuration.md: its example loads, and it leaves out no key, profile or HAROS key."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from haros_ci.config.haros import HOME_KEYS, IGNORE_KEYS, PROJECT_KEYS
from haros_ci.config.load import load
from haros_ci.config.project import LINTER_KEYS, OWN_KEYS
from haros_ci.config.selection import Selection
from haros_ci.config.settings import PROFILES
from haros_ci.results.rule import Level

PAGE = (Path(__file__).parents[2] / "docs" / "configuration.md").read_text(encoding="utf-8")
EXAMPLE = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)


def test_the_example_means_what_it_says(tmp_path: Path) -> None:
    (text,) = EXAMPLE
    (tmp_path / ".haros-ci.yaml").write_text(text, encoding="utf-8")
    settings = load(tmp_path)
    assert settings.notes == ()
    assert settings.exclude == ("src/third_party", "*_generated.hpp")
    assert settings.packages == ("robot_driver", "robot_bringup")
    selection = Selection(settings, lambda tool: {})
    assert selection.decide("pylint", "unused-import", "src/a.py") == Level.ERROR
    assert selection.decide("pylint", "too-few-public-methods", "src/a.py") is None
    assert selection.decide("cpplint", "build/header_guard", "src/a.hpp") == Level.WARNING
    assert selection.decide("cpplint", "build/include_order", "src/a.hpp") is None
    assert selection.ignores_file("robot_driver", "src/vendor/deep/a.cpp")


def test_the_example_shows_every_key_but_plugins() -> None:
    (text,) = EXAMPLE
    shown = set(re.findall(r"^([a-z_-]+):", text, re.MULTILINE))
    assert set(OWN_KEYS) - shown == {"plugins", "plugin_whitelist"}


@pytest.mark.parametrize("key", [*OWN_KEYS, *LINTER_KEYS])
def test_every_own_key_has_a_row(key: str) -> None:
    assert re.search(rf"^\|[^|]*`{key}`", PAGE, re.MULTILINE)


@pytest.mark.parametrize("profile", PROFILES)
def test_every_profile_has_a_row(profile: str) -> None:
    assert re.search(rf"^\| `{profile}` \|", PAGE, re.MULTILINE)


@pytest.mark.parametrize("key", [*PROJECT_KEYS, *HOME_KEYS, *IGNORE_KEYS])
def test_every_haros_key_is_explained(key: str) -> None:
    table = PAGE[PAGE.index("## HAROS project files") :]
    assert re.search(rf"^\|[^|]*[`.]{key}[`.]", table, re.MULTILINE)
