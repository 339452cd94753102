# SPDX-License-Identifier: Apache-2.0
"""Access rules: which names patterns fit, and what rules refuse."""

from __future__ import annotations

import pytest

from haros_ci.model.access import AccessRule
from haros_ci.security.access import Access, fits


@pytest.mark.parametrize(
    ("pattern", "name"),
    [
        ("/a", "/a"),
        ("/*", "/a"),
        ("/a*", "/abc"),
        ("/*_vel", "/cmd_vel"),
        ("/**", "/a"),
        ("/**", "/a/b/c"),
        ("/a/**", "/a/b/c"),
        ("/a/**", "/a"),
        ("/**/c", "/c"),
        ("/**/c", "/a/b/c"),
        ("/a/**/c", "/a/c"),
        ("/**/**/c", "/a/c"),
        ("p/*", "p/n"),
    ],
)
def test_a_pattern_fits(pattern: str, name: str) -> None:
    assert fits(pattern, name)


@pytest.mark.parametrize(
    ("pattern", "name"),
    [
        ("/a", "/a/b"),
        ("/a/b", "/a"),
        ("/*", "/a/b"),
        ("/a*", "/ba"),
        ("/A", "/a"),
        ("/**/c", "/a/c/d"),
        ("/a/**", "/ab"),
        ("/a/**", "/b/a"),
        ("p/*", "q/n"),
    ],
)
def test_a_pattern_does_not_fit(pattern: str, name: str) -> None:
    assert not fits(pattern, name)


def test_many_wildcards_take_no_time() -> None:
    assert not fits("/**" * 100 + "/b", "/a" * 100)


RULES = (
    AccessRule("publish", "/v", ("/mux", "p/safe"), 1),
    AccessRule("publish", "/**", ("/all",), 2),
    AccessRule("call", "/reset", (), 3),
    AccessRule("serve", "/reset", ("p/*",), 4),
)


@pytest.mark.parametrize(
    ("kind", "name", "node", "type", "lines"),
    [
        ("publishers", "/v", "/teleop", "p/teleop", [1, 2]),
        ("publishers", "/w", "/mux", "p/mux", [2]),
        ("clients", "/reset", "/mux", "p/mux", [3]),
        ("action_clients", "/reset", "/mux", "p/mux", [3]),
        ("clients", "/reset", "/?", "p/mux", [3]),
        ("servers", "/reset", "/a", "q/a", [4]),
        ("action_servers", "/reset", "/a", "q/a", [4]),
        ("publishers", "/v", "/mux", "p/mux", []),
        ("publishers", "/v", "/left/any", "p/safe", []),
        ("publishers", "/v", "/all", "p/all", []),
        ("publishers", "/v", "/left/?", "p/teleop", []),
        ("subscribers", "/v", "/teleop", "p/teleop", []),
        ("clients", "/other", "/mux", "p/mux", []),
        ("servers", "/reset", "/?", "p/a", []),
        ("parameters", "/v", "/teleop", "p/teleop", []),
    ],
)
def test_who_is_refused(kind: str, name: str, node: str, type: str, lines: list[int]) -> None:
    assert [rule.line for rule in Access(RULES).refusing(kind, name, node, type)] == lines
