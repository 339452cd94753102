# SPDX-License-Identifier: Apache-2.0
"""Our own keys of a project file: what they mean, and what is said of mistakes."""

from __future__ import annotations

import pytest

from haros_ci.config.project import MAX_PATH_GLOBS, MAX_SELECTORS, read_project
from haros_ci.config.settings import LinterSettings, PathPolicy, Policy
from haros_ci.errors import UserError
from haros_ci.results.rule import Level

NAME = ".haros-ci.yaml"


def values(text: str, *, trust: bool = False) -> dict[str, object]:
    """What *text* sets, without what every file sets to nothing."""
    read = read_project(text.encode(), NAME, trust_config=trust).values
    empty: tuple[object, ...] = (Policy(), (), {})
    return {key: value for key, value in read.items() if key != "project" and value not in empty}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", {}),
        ("# nothing\n", {}),
        ("---\n", {}),
        ("profile:\nexclude:\nlevels:\nlinters:\nper-path:\nfail-on:\nbaseline:\nplugins:\n", {}),
        ("select: []\nignore: []\nlevels: {}\nper-path: {}\nlinters: {}", {}),
        ("profile: bugs-only", {"profile": "bugs-only"}),
        ("select: [a, 'b/*']\nignore: [c]", {"policy": Policy(select=("a", "b/*"), ignore=("c",))}),
        (
            "levels: {a: error, b: off, c: 'off', d: note}",
            {"policy": Policy(levels=(("a", Level.ERROR), ("b", None), ("c", None), ("d", Level.NOTE)))},
        ),
        (
            "per-path: {'test/**, doc': {profile: all, select: [x], ignore: [y], levels: {z: warning}}}",
            {
                "per_path": (
                    PathPolicy(
                        globs=("test/**", "doc"),
                        profile="all",
                        policy=Policy(select=("x",), ignore=("y",), levels=(("z", Level.WARNING),)),
                    ),
                )
            },
        ),
        ("per-path: {b: {}, a: {}}", {"per_path": tuple(PathPolicy(globs=(g,), policy=Policy()) for g in "ba")}),
        ("exclude: [third_party, '*.gen.py']", {"exclude": ("third_party", "*.gen.py")}),
        (
            "linters: {ruff: on, radon: no}",
            {"linters": (("radon", LinterSettings(enabled=False)), ("ruff", LinterSettings(enabled=True)))},
        ),
        ("linters: {pylint: {timeout: 9}}", {"linters": (("pylint", LinterSettings(timeout=9.0)),)}),
        ("fail-on: error", {"fail_on": Level.ERROR}),
        ("fail-on: never", {"fail_on": None}),
        ("max-file-size: 5", {"max_file_size": 5}),
        ("compile-database: build", {"compile_database": "build"}),
        ("baseline: ci/known.jsonl", {"baseline": "ci/known.jsonl"}),
        (
            "base: &b [x]\nproject: p".replace("base", "select") + "\nignore: *b",
            {"policy": Policy(select=("x",), ignore=("x",))},
        ),
        (
            "per-path: {a: &e {ignore: [x]}, b: *e}",
            {"per_path": tuple(PathPolicy(globs=(g,), policy=Policy(ignore=("x",))) for g in "ab")},
        ),
    ],
)
def test_values(text: str, expected: dict[str, object]) -> None:
    assert values(text) == expected


@pytest.mark.parametrize(
    ("text", "message", "help_"),
    [
        ("\n\nexlude: [a]", "3: unknown key 'exlude'", "did you mean 'exclude'?"),
        ("exlude:", "1: unknown key 'exlude'", "did you mean 'exclude'?"),
        ("fail_on: error", "1: unknown key 'fail_on'", "did you mean 'fail-on'?"),
        ("zzz: 1", "1: unknown key 'zzz'", "one of: profile, select, "),
        ("profile: ros\nprofile: all", "2: key 'profile' stands here again, first on line 1", "keep one"),
        ("[a]", "1: a project file must be a map, not a list", "keys such as"),
        ("text", "1: a project file must be a map, not a text", "keys such as"),
        ("1: a", "1: key 1 in a project file must be text", "quotes"),
        ("on: a", "1: key true in a project file must be text", "quotes"),
        ("profile: Ros", "1: 'profile' cannot be 'Ros'", "did you mean 'ros'?"),
        ("profile: bugs", "1: 'profile' cannot be 'bugs'", "did you mean 'bugs-only'?"),
        ("profile: 3", "1: 'profile' cannot be 3", "one of: ros, strict"),
        ("profile: [ros]", "1: 'profile' cannot be a list", "one of: ros"),
        ("profile: {a: b}", "1: 'profile' cannot be a map", "one of: ros"),
        ("select: unused-import", "1: 'select' must be a list, not a text", "write select: ['unused-import']"),
        ("select: {a: b}", "1: 'select' must be a list, not a map", "write select: […]"),
        ("select:\n- a\n- 3", "3: an entry of 'select' must be text, not a number", "quotes"),
        ("select: [true]", "1: an entry of 'select' must be text, not true (true or false)", "quotes"),
        ("select: ['']", "1: an entry of 'select' is empty", "leave it out"),
        ("select: [[a]]", "1: an entry of 'select' must be text, not a list", "quotes"),
        ("select: [*]", "1: not valid YAML", "quote"),
        ("ignore: 1", "1: 'ignore' must be a list, not a number", "write ignore: […]"),
        ("ignore: [{a: b}]", "1: an entry of 'ignore' must be text, not a map", "quotes"),
        ("levels: [a]", "1: 'levels' must be a map, not a list", "write levels: {"),
        ("levels:\n  a: errors", "2: the level of 'a' cannot be 'errors'", "did you mean 'error'?"),
        ("levels: {a: on}", "1: the level of 'a' cannot be true", "one of: error, warning, note, off"),
        ("levels: {a: 1}", "1: the level of 'a' cannot be 1", "one of: error"),
        ("levels: {a: [error]}", "1: the level of 'a' cannot be a list", "one of: error"),
        ("levels: {1: error}", "1: key 1 in 'levels' must be text", "quotes"),
        ("per-path: [a]", "1: 'per-path' must be a map, not a list", "write per-path: {"),
        ("per-path: {a: [b]}", "1: per-path 'a' must be a map, not a list", "ignore"),
        ("per-path:\n  a:\n    ignored: [b]", "3: unknown key 'ignored'", "did you mean 'ignore'?"),
        ("per-path: {a: {profile: roz}}", "1: 'profile' cannot be 'roz'", "did you mean 'ros'?"),
        ("per-path: {'!a': {}}", "1: '!a': '!' has a meaning in 'exclude' only", "leave it out"),
        ("per-path: {'a, ../b': {}}", "1: '../b': globs are relative", "write it like"),
        ("per-path: {'a,': {}}", "1: '': an empty glob", "write it like"),
        ("exclude: src", "1: 'exclude' must be a list, not a text", "write exclude: ['src']"),
        ("exclude:\n  - a\n  - ../b", "3: '../b': globs are relative", "write it like"),
        ("exclude: [1]", "1: an entry of 'exclude' must be text, not a number", "quotes"),
        ("linters: [ruff]", "1: 'linters' must be a map, not a list", "write linters: {"),
        ("linters: {ruff: yes please}", "1: linter 'ruff' must be true, false or a map", "write ruff: {"),
        ("linters: {ruff: {time: 3}}", "1: unknown key 'time'", "did you mean 'timeout'?"),
        (
            "linters: {ruff: {enabled: 1}}",
            "1: 'enabled' of linter 'ruff' must be true or false, not a number",
            "true or",
        ),
        (
            "linters: {ruff: {timeout: long}}",
            "1: 'timeout' of linter 'ruff' must be a number of seconds, not a text",
            "bare",
        ),
        ("linters: {ruff: {timeout: yes}}", "1: 'timeout' of linter 'ruff' must be a number", "bare"),
        ("linters: {ruff: {timeout: 0}}", "1: 'timeout' of linter 'ruff' must be above 0, not 0", "seconds"),
        ("linters: {ruff: {timeout: -.inf}}", "1: 'timeout' of linter 'ruff' must be above 0", "seconds"),
        ("linters: {ruff: {timeout: .nan}}", "1: 'timeout' of linter 'ruff' must be above 0", "seconds"),
        ("linters: {ruff: {arguments: -v}}", "1: 'arguments' must be a list, not a text", "write arguments: ['-v']"),
        ("fail-on: warnings", "1: 'fail-on' cannot be 'warnings'", "did you mean 'warning'?"),
        ("fail-on: off", "1: 'fail-on' cannot be false", "one of: error, warning, note, never"),
        ("max-file-size: 2 MB", "1: 'max-file-size' must be a number of bytes, not a text", "bare"),
        ("max-file-size: 1.5", "1: 'max-file-size' must be a whole number", "fraction"),
        ("max-file-size: -1", "1: 'max-file-size' must be above 0", "bytes"),
        ("max-file-size: true", "1: 'max-file-size' must be a number", "bare"),
        ("compile-database: [a]", "1: 'compile-database' must be text, not a list", "quotes"),
        ("compile-database: ../build", "1: 'compile-database' must lie in the workspace", "--trust-config"),
        ("baseline: /etc/passwd", "1: 'baseline' must lie in the workspace, not at '/etc/passwd'", "--trust-config"),
        ("baseline: ~/known", "1: 'baseline' must lie in the workspace", "--trust-config"),
        ("baseline: 7", "1: 'baseline' must be text, not a number", "quotes"),
        ("baseline: ' '", "1: 'baseline' is empty", "leave it out"),
        ("plugins: mine", "1: 'plugins' must be a list, not a text", "write plugins: ['mine']"),
        ("plugins: [1]", "1: an entry of 'plugins' must be text, not a number", "quotes"),
    ],
)
def test_mistakes(text: str, message: str, help_: str) -> None:
    with pytest.raises(UserError) as caught:
        values(text)
    assert caught.value.message.startswith(f"{NAME}:{message}")
    assert help_ in (caught.value.help or "")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("exclude: [" + "a, " * 1001 + "]", f"{NAME}:1: 'exclude' has more than 1000 entries"),
        (
            "per-path:\n" + "".join(f"  p{i}: {{ignore: [r{i}]}}\n" for i in range(MAX_SELECTORS + 1)),
            f"{NAME}: more than {MAX_SELECTORS} selectors",
        ),
        (
            "per-path:\n" + "".join(f"  p{i}: {{}}\n" for i in range(MAX_PATH_GLOBS + 1)),
            f"{NAME}: more than {MAX_PATH_GLOBS} globs in 'per-path'",
        ),
    ],
)
def test_endless_lists(text: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        values(text)
    assert caught.value.message == message


def test_what_only_a_trusted_file_may_say() -> None:
    text = "plugins: [mine]\nbaseline: ../known.jsonl\nlinters: {pylint: {arguments: [-v]}}"
    trusted = read_project(text.encode(), NAME, trust_config=True)
    assert trusted.values["plugins"] == ("mine",)
    assert trusted.values["baseline"] == "../known.jsonl"
    assert trusted.notes == ()

    wary = read_project(text.replace("../", "").encode(), NAME)
    assert "plugins" not in wary.values
    assert wary.notes == (
        f"{NAME}:3: arguments reach 'pylint' only with --trust-config",
        f"{NAME}:1: plugins are loaded only with --trust-config",
    )


def test_origins_name_lines() -> None:
    origins = dict(read_project(b"profile: ros\nselect:\n  - a\n  - b\nper-path:\n  x:\n    ignore: [c]", NAME).origins)
    assert origins == {
        "profile": f"{NAME}:1",
        "select": f"{NAME}:2",
        "selector a": f"{NAME}:3",
        "selector b": f"{NAME}:4",
        "per-path": f"{NAME}:5",
        "selector c": f"{NAME}:7",
    }


def test_long_and_odd_words_are_cut_in_messages() -> None:
    with pytest.raises(UserError) as caught:
        values("profile: " + "x" * 5000)
    assert len(caught.value.message) < 150
