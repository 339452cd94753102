# SPDX-License-Identifier: Apache-2.0
"""``access`` of a project file: what it says, and what is said of mistakes in it."""

from __future__ import annotations

import pytest

from haros_ci.config.access import MAX_NODES, MAX_RULES
from haros_ci.config.describe import describe
from haros_ci.config.project import read_project
from haros_ci.config.settings import Settings
from haros_ci.errors import UserError
from haros_ci.model.access import AccessRule

NAMES = (".haros-ci.yaml", "haros.yaml")


def read(text: str, name: str = "haros.yaml") -> tuple[AccessRule, ...]:
    found = read_project(text.encode(), name).values["access"]
    assert isinstance(found, tuple)
    return found


@pytest.mark.parametrize("name", NAMES)
def test_lists_are_rules_with_their_lines(name: str) -> None:
    text = "access:\n  call:\n    /reset: ['@all', /c]\n  groups:\n    all: [/a, p/b]\n  publish:\n    /v: []\n    /*/v: [p/*]\n"
    assert read(text, name) == (
        AccessRule("publish", "/v", (), 7),
        AccessRule("publish", "/*/v", ("p/*",), 8),
        AccessRule("call", "/reset", ("/a", "p/b", "/c"), 3),
    )


@pytest.mark.parametrize("text", ["", "access:", "access: {}", "access:\n  publish:\n  groups: {}"])
def test_nothing_is_no_rule(text: str) -> None:
    assert read(text) == ()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("access: [a]", "haros.yaml:1: 'access' must be a map, not a list"),
        ("access:\n  publsh: {/a: []}", "haros.yaml:2: unknown key 'publsh' in 'access'"),
        ("access:\n  publish: [/a]", "haros.yaml:2: 'publish' of 'access' must be a map, not a list"),
        ("access:\n  publish:\n    /a: /b", "haros.yaml:3: '/a' in 'access' must have a list, not a text"),
        ("access:\n  publish:\n    /a:", "haros.yaml:3: '/a' in 'access' must have a list, not empty"),
        ("access:\n  publish:\n    a: []", "haros.yaml:3: 'a' in 'publish' of 'access' is no full name"),
        ("access:\n  publish:\n    /a**: []", "haros.yaml:3: '/a**' in 'publish' of 'access' is no full name"),
        ("access:\n  publish:\n    /a?: []", "haros.yaml:3: '/a?' in 'publish' of 'access' is no full name"),
        ("access:\n  publish:\n    '/[ab]': []", "haros.yaml:3: '/[ab]' in 'publish' of 'access' is no full name"),
        ("access:\n  serve:\n    /a: [b]", "haros.yaml:3: 'b' of '/a' in 'access' names no node"),
        ("access:\n  serve:\n    /a: [p/b/c]", "haros.yaml:3: 'p/b/c' of '/a' in 'access' names no node"),
        ("access:\n  serve:\n    /a: [3]", "haros.yaml:3: a node of '/a' in 'access' must be text, not a number"),
        ("access:\n  serve:\n    /a: ['@b']", "haros.yaml:3: there is no group 'b' in 'access'"),
        ("access:\n  groups:\n    b: ['@c']\n    c: []", "haros.yaml:3: there is no group 'c' in 'access'"),
        ("access:\n  groups:\n    3: [/a]", "haros.yaml:3: '3' is no name of a group"),
        (
            f"access:\n  call: {{{', '.join(f'/a{n}: []' for n in range(MAX_RULES + 1))}}}",
            f"haros.yaml:1: 'access' has more than {MAX_RULES} names",
        ),
        (
            f"access:\n  call:\n    /a: [{', '.join(f'/a{n}' for n in range(MAX_NODES + 1))}]",
            f"haros.yaml:3: '/a' in 'access' has more than {MAX_NODES} nodes",
        ),
    ],
)
def test_mistakes_are_errors_with_their_lines(text: str, message: str, name: str) -> None:
    with pytest.raises(UserError) as caught:
        read(text, name)
    assert caught.value.message == message.replace("haros.yaml", name)


def test_it_is_shown_with_the_settings(tmp_path: object) -> None:
    from pathlib import Path

    settings = Settings(root=Path("/"), access=(AccessRule("publish", "/v", (), 7),))
    assert any(line.startswith('access: ["publish /v"]') for line in describe(settings).splitlines())
