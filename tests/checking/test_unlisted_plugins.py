# SPDX-License-Identifier: Apache-2.0
"""Sections of plug-ins that the list of names beside them does not have, and those of which that cannot be said."""

from __future__ import annotations

import pytest

from haros_ci.checking.plugin_uses import unlisted_plugins

A = "  a: {plugin: demo/A}\n"
B = "  b:\n    plugin: demo/B\n    rate: 3\n"


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("s:\n  plugins: [a]\n" + A + B, [5]),
        ("s:\n" + A + B + "  tool_plugins:\n    - a\n", [4]),
        ("s:\n  tool_plugins: [\n    # x\n    a,\n  ]\n" + B, [7]),
        ("s:\n  plugins: [a, b]\n" + A + B, []),
        ("s:\n  tool_plugins: [a]\n  other_plugin: b\n" + A + B, []),
        ("s:\n  tool_plugins: [a]\n  other_plugins: [b]\n" + A + B, []),
        ("s:\n  other_plugin: a\n" + A + B, []),
        ("s:\n  plugins: []\n" + B, []),
        ("s:\n  plugins: [$(var list)]\n" + B, []),
        ("s:\n  plugins: [demo/A]\n" + B, []),
        ("s:\n  ids: [a]\n" + B, []),
        ("s:\n  inner:\n    plugins: [a]\n" + B, []),
        ("s:\n" + A + B, []),
        ("plugins: [a\n" + B, []),
        ("plugin", []),
        ("&x [plugin, *x]", []),
    ],
)
def test_sections(text: str, lines: list[int]) -> None:
    assert sorted(unlisted_plugins(text)) == lines
