# SPDX-License-Identifier: Apache-2.0
"""Which rules are on, where, and at what level."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType

import pytest
from hypothesis import given
from hypothesis import strategies as st

from haros_ci.config.selection import Selection
from haros_ci.config.selector import NO_MATCH, best_rank, rank
from haros_ci.config.settings import PackagePolicy, PathPolicy, Policy, Settings
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level, Rule

ERROR, WARNING, NOTE = Level.ERROR, Level.WARNING, Level.NOTE

UNUSED = Rule(
    "unused-import", "", profiles=("ros", "strict"), tags=("cleanup", "style"), deprecated_ids=("unused-module",)
)
BUG = Rule("used-before-assignment", "", level=ERROR, profiles=("ros", "strict", "bugs-only"), tags=("bugs",))
IMPORT = Rule("import-error", "", level=ERROR)
TAB = Rule(
    "whitespace/tab",
    "",
    level=NOTE,
    profiles=("google",),
    tags=("formatting",),
    aliases=("haros_plugin_cpplint:two_space_indent", "ros-style-indent"),
)
CC = Rule("max-cyclomatic-complexity-10", "", tags=("his",), aliases=("max_cyclomatic_complexity_10",))
CATALOGUE = {
    "pylint": {r.id: r for r in (UNUSED, BUG, IMPORT)},
    "cpplint": {TAB.id: TAB, "unused-import": Rule("unused-import", "", profiles=("ros",))},
    "metrics": {CC.id: CC},
}


def selection(
    profile: str = "ros",
    *,
    per_path: tuple[PathPolicy, ...] = (),
    command_line: Policy | None = None,
    select: tuple[str, ...] = (),
    ignore: tuple[str, ...] = (),
    levels: dict[str, Level | None] | None = None,
) -> Selection:
    settings = Settings(
        root=Path("/"),
        profile=profile,
        policy=Policy(select=select, ignore=ignore, levels=tuple((levels or {}).items())),
        per_path=per_path,
        command_line=command_line or Policy(),
    )
    return Selection(settings, lambda tool: MappingProxyType(CATALOGUE.get(tool, {})))


@pytest.mark.parametrize(
    ("selector", "specific"),
    [
        ("pylint:unused-import", 5),
        ("pylint:unused-module", 5),
        ("unused-import", 4),
        ("unused-module", 4),
        ("haros_plugin_pylint:unused-import", 3),
        ("unused-*", 2),
        ("pylint:unused-*", 2),
        ("py*:*", 2),
        ("?nused-import", 2),
        ("pylint", 1),
        ("pylint:", 1),
        ("pylint:*", 1),
        ("haros_plugin_pylint", 1),
        ("cleanup", 1),
        ("*", 0),
    ],
)
def test_rank(selector: str, specific: int) -> None:
    assert rank(selector, "pylint", UNUSED)[0] == specific


@pytest.mark.parametrize(
    ("selector", "tool", "rule"),
    [
        ("haros_plugin_cpplint:two_space_indent", "cpplint", TAB),
        ("cpplint:two_space_indent", "cpplint", TAB),
        ("ros-style-indent", "cpplint", TAB),
        ("cpplint:ros-style-indent", "cpplint", TAB),
        ("max_cyclomatic_complexity_10", "metrics", CC),
        ("metrics:max_cyclomatic_complexity_10", "metrics", CC),
    ],
)
def test_aliases(selector: str, tool: str, rule: Rule) -> None:
    assert rank(selector, tool, rule)[0] == 3


@pytest.mark.parametrize(
    "selector",
    [
        "",
        ":",
        "unused",
        "Unused-Import",
        "cpplint:unused-import",
        "unused-import:pylint",
        "pylint:cleanup",
        "PYLINT",
        "Cleanup",
        "pylint:unused",
        "ruff:*",
        "haros_plugin_cpplint:unused-import",
        "used-*",
        "ros",
        "pylint:pylint:unused-import",
        "unused-import ",
        "two_space_indent",
    ],
)
def test_names_something_else(selector: str) -> None:
    assert rank(selector, "pylint", UNUSED) == NO_MATCH


RULES = [(tool, rule) for tool, rules in CATALOGUE.items() for rule in rules.values()]
WORDS = sorted(
    {word for tool, rule in RULES for word in (tool, rule.id, *rule.aliases, *rule.tags, *rule.deprecated_ids)}
)
SELECTORS = st.one_of(
    st.sampled_from(WORDS),
    st.builds("{}:{}".format, st.sampled_from([*CATALOGUE, "haros_plugin_pylint"]), st.sampled_from([*WORDS, "*", ""])),
    st.builds(lambda word, end: word[:end] + "*", st.sampled_from(WORDS), st.integers(0, 9)),
    st.sampled_from(["", "*", ":", "haros_plugin_cpplint", "haros_plugin_metrics", "?[a-z]*", "nothing"]),
)


@given(st.lists(SELECTORS, max_size=6).map(tuple), st.sampled_from(RULES))
def test_the_best_of_several(selectors: tuple[str, ...], of: tuple[str, Rule]) -> None:
    one_by_one = max((rank(selector, *of) for selector in selectors), default=NO_MATCH)
    assert best_rank(selectors, *of) == one_by_one


@pytest.mark.parametrize(
    ("profile", "on"),
    [
        ("ros", {"unused-import", "used-before-assignment"}),
        ("strict", {"unused-import", "used-before-assignment"}),
        ("bugs-only", {"used-before-assignment"}),
        ("google", set()),
        ("all", {"unused-import", "used-before-assignment", "import-error", "no-such-rule"}),
    ],
)
def test_profiles(profile: str, on: set[str]) -> None:
    chosen = selection(profile)
    ids = (*CATALOGUE["pylint"], "no-such-rule")
    assert {id for id in ids if chosen.wants("pylint", id, "a.py")} == on


@pytest.mark.parametrize(
    ("select", "ignore", "on"),
    [
        ((), (), True),
        (("unused-import",), (), True),
        ((), ("unused-import",), False),
        (("unused-import",), ("unused-import",), False),
        (("pylint:unused-import",), ("unused-import",), True),
        (("unused-import",), ("pylint:unused-import",), False),
        (("pylint:unused-import",), ("pylint",), True),
        (("unused-import",), ("style",), True),
        (("unused-*",), ("pylint",), True),
        (("pylint",), ("unused-*",), False),
        (("unused-imp*",), ("unused-*",), True),
        (("unused-*",), ("unused-imp*",), False),
        (("pylint",), ("style",), False),
        (("style",), ("pylint",), False),
        (("pylint:*",), ("style",), False),
        (("pylint",), ("*",), True),
        (("*",), ("pylint",), False),
        (("haros_plugin_pylint:unused-import",), ("unused-import",), False),
        ((), ("cpplint", "import-error", "formatting", "unused"), True),
    ],
)
def test_the_most_specific_wins(select: tuple[str, ...], ignore: tuple[str, ...], on: bool) -> None:
    assert selection(select=select, ignore=ignore).wants("pylint", "unused-import", "a.py") is on
    assert selection(select=select[::-1], ignore=ignore[::-1]).wants("pylint", "unused-import", "a.py") is on


@pytest.mark.parametrize(
    ("levels", "level"),
    [
        ({}, WARNING),
        ({"unused-import": ERROR}, ERROR),
        ({"pylint": NOTE}, NOTE),
        ({"pylint:unused-import": ERROR, "pylint": NOTE}, ERROR),
        ({"pylint": NOTE, "pylint:unused-import": ERROR}, ERROR),
        ({"pylint": NOTE, "style": ERROR}, ERROR),
        ({"style": ERROR, "pylint": NOTE}, NOTE),
        ({"pylint": None}, None),
        ({"pylint": None, "unused-import": ERROR}, ERROR),
        ({"pylint": ERROR, "unused-import": None}, None),
        ({"cpplint": None, "import-error": ERROR}, WARNING),
    ],
)
def test_levels(levels: dict[str, Level | None], level: Level | None) -> None:
    assert selection(levels=levels).decide("pylint", "unused-import", "a.py") == level


@pytest.mark.parametrize(
    ("select", "levels", "on"),
    [
        ((), {"import-error": ERROR}, False),  # a level turns nothing on
        (("import-error",), {}, True),
        (("import-error",), {"import-error": None}, False),
        (("import-error",), {"pylint": None}, True),
        (("pylint",), {"import-error": None}, False),
    ],
)
def test_off_and_select(select: tuple[str, ...], levels: dict[str, Level | None], on: bool) -> None:
    assert selection(select=select, levels=levels).wants("pylint", "import-error", "a.py") is on


def per_path(glob: str, profile: str | None = None, **policy: object) -> PathPolicy:
    return PathPolicy(globs=(glob,), profile=profile, policy=Policy(**policy))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("chosen", "path", "level"),
    [
        (selection(per_path=(per_path("test", ignore=("pylint",)),)), "test/a.py", None),
        (selection(per_path=(per_path("test", ignore=("pylint",)),)), "src/a.py", WARNING),
        (selection(per_path=(per_path("test", levels=(("pylint", NOTE),)),)), "test/a.py", NOTE),
        (selection(per_path=(per_path("test", "bugs-only"),)), "test/a.py", None),
        (selection(per_path=(per_path("test", "bugs-only"),)), "src/a.py", WARNING),
        (selection("google", per_path=(per_path("test", "ros"),)), "test/a.py", WARNING),
        (selection(per_path=(per_path("test", "bugs-only"), per_path("test/x", "ros"))), "test/x/a.py", WARNING),
        (selection(per_path=(per_path("test/x", "ros"), per_path("test", "bugs-only"))), "test/x/a.py", None),
        # a later layer beats an earlier one, however specific that is
        (selection(ignore=("pylint:unused-import",), per_path=(per_path("a.py", select=("style",)),)), "a.py", WARNING),
        (selection(select=("pylint:unused-import",), per_path=(per_path("a.py", ignore=("*",)),)), "a.py", None),
        (selection(per_path=(per_path("a.py", ignore=("*",)), per_path("*.py", select=("style",)))), "a.py", WARNING),
        (selection(ignore=("pylint",), command_line=Policy(select=("pylint",))), "a.py", WARNING),
        (selection(select=("unused-import",), command_line=Policy(ignore=("pylint",))), "a.py", None),
        (
            selection(per_path=(per_path("a.py", ignore=("*",)),), command_line=Policy(select=("style",))),
            "a.py",
            WARNING,
        ),
        (selection(ignore=("pylint",), command_line=Policy(select=("cpplint",))), "a.py", None),
        # off ends with a later select or level
        (selection(levels={"pylint": None}, command_line=Policy(select=("style",))), "a.py", WARNING),
        (selection(levels={"pylint": None}, per_path=(per_path("a.py", levels=(("style", NOTE),)),)), "a.py", NOTE),
        (selection(levels={"pylint": None}, per_path=(per_path("a.py", levels=(("cpplint", NOTE),)),)), "a.py", None),
        (selection(levels={"style": ERROR}, per_path=(per_path("a.py", levels=(("pylint", None),)),)), "a.py", None),
    ],
)
def test_layers(chosen: Selection, path: str, level: Level | None) -> None:
    assert chosen.decide("pylint", "unused-import", path) == level
    assert chosen.decide("pylint", "unused-import", path) == level  # and when remembered
    assert chosen.wants("pylint", "unused-import", path) is (level is not None)


def test_default_levels() -> None:
    chosen = selection(levels={"pylint:unused-import": NOTE})
    assert chosen.decide("pylint", "used-before-assignment", "a.py") == ERROR
    assert chosen.decide("pylint", "used-before-assignment", "a.py", WARNING) == WARNING
    assert chosen.decide("pylint", "unused-import", "a.py", ERROR) == NOTE
    assert chosen.decide("pylint", "import-error", "a.py", ERROR) is None


def test_a_rule_that_the_catalogue_lacks() -> None:
    assert selection().decide("semgrep", "x", "a.py") is None
    assert selection(select=("semgrep",)).decide("semgrep", "x", "a.py") == WARNING
    made = Selection(
        Settings(root=Path("/")), lambda tool: {}, lambda tool, id: Rule(id, tool, ERROR, profiles=("ros",))
    )
    assert made.decide("semgrep", "x", "a.py") == ERROR
    mine = Rule("x", "", level=NOTE, profiles=("ros",))
    assert selection().decide("semgrep", mine, "a.py") == NOTE
    assert selection(ignore=("semgrep:x",)).decide("semgrep", mine, "a.py") is None


def finding(rule: str, *also: str) -> Result:
    return Result("pylint", rule, WARNING, "m", Location("a.py", 1), also=also)


@pytest.mark.parametrize("selector", ["unused-import", "pylint:unused-import", "unused-*", "pylint", "style", "*"])
def test_suppression_matches(selector: str) -> None:
    assert selection().matches(selector, finding("unused-import"))


@pytest.mark.parametrize("selector", ["ruff:F401", "F401", "ruff", "unused-import"])
def test_suppression_of_a_defect_found_twice(selector: str) -> None:
    assert selection().matches(selector, finding("unused-import", "ruff:F401"))


@pytest.mark.parametrize("selector", ["", "unused", "import-error", "cpplint:unused-import", "bugs", "F401", "a.py"])
def test_suppression_of_something_else(selector: str) -> None:
    assert not selection().matches(selector, finding("unused-import"))


@pytest.mark.parametrize(
    ("pattern", "path", "ignored"),
    [
        ("*/src/gen/*", "src/gen/a.cpp", True),
        ("*/src/gen/*", "src/gen/deep/a.cpp", True),
        ("*/a.cpp", "src/a.cpp", True),
        ("rover_driver/*", "src/a.cpp", True),
        ("*.cpp", "src/a.cpp", True),
        ("[qr]over*", "src/a.cpp", True),
        ("*/src/gen", "src/gen/a.cpp", False),
        ("*/gen/*", "gen.cpp", False),
        ("/src/a.cpp", "src/a.cpp", False),
        ("*/A.cpp", "src/a.cpp", False),
        ("rover/*", "src/a.cpp", False),
    ],
)
def test_haros_file_patterns(pattern: str, path: str, ignored: bool) -> None:
    chosen = Selection(Settings(root=Path("/"), ignore_files=(pattern,)), lambda tool: {})
    assert chosen.ignores_file("rover_driver", path) is ignored
    assert not chosen.ignores_file(None, path)


# -- per-package -----------------------------------------------------------------------------------------------------

HOMES = {"src/arm/a.py": "arm_driver", "src/arm/test/b.py": "arm_driver", "src/leg/a.py": "leg_driver"}


def in_packages(profile: str = "ros", command_line: Policy | None = None, **per_path: Policy) -> Selection:
    settings = Settings(
        root=Path("/"),
        profile=profile,
        policy=Policy(ignore=("style",)),
        per_package=(
            PackagePolicy(names=("arm_*", "hand"), policy=Policy(select=("import-error",)), profile="bugs-only"),
            PackagePolicy(names=("leg_driver",), policy=Policy(select=("unused-import",), levels=(("pylint", NOTE),))),
            PackagePolicy(names=("arm_driver",), policy=Policy(ignore=("bugs",))),
        ),
        per_path=tuple(PathPolicy(globs=(glob,), policy=policy) for glob, policy in per_path.items()),
        command_line=command_line or Policy(),
    )
    return Selection(settings, lambda tool: MappingProxyType(CATALOGUE.get(tool, {})), package=HOMES.get)


@pytest.mark.parametrize(
    ("path", "rule", "level"),
    [
        ("src/arm/a.py", "import-error", ERROR),
        ("src/arm/a.py", "used-before-assignment", None),  # the later entry ignores it
        ("src/arm/a.py", "unused-import", None),
        ("src/leg/a.py", "unused-import", NOTE),  # beats the file's ignore
        ("src/leg/a.py", "used-before-assignment", NOTE),
        ("src/leg/a.py", "import-error", None),
        ("tools/a.py", "used-before-assignment", ERROR),
        ("tools/a.py", "import-error", None),
        ("tools/a.py", "unused-import", None),
    ],
)
def test_packages(path: str, rule: str, level: Level | None) -> None:
    assert in_packages().decide("pylint", rule, path) is level


def test_paths_beat_packages_and_the_command_line_both() -> None:
    chosen = in_packages(**{"**/test/**": Policy(select=("used-before-assignment",))})
    assert chosen.decide("pylint", "used-before-assignment", "src/arm/test/b.py") is ERROR
    assert chosen.decide("pylint", "used-before-assignment", "src/arm/a.py") is None
    typed = in_packages(command_line=Policy(ignore=("import-error",)))
    assert typed.decide("pylint", "import-error", "src/arm/a.py") is None


def test_another_revision_has_other_packages() -> None:
    old = in_packages().over({"src/arm/a.py": "leg_driver"}.get)
    assert old.decide("pylint", "unused-import", "src/arm/a.py") is NOTE
    assert in_packages().over(lambda path: None).decide("pylint", "import-error", "src/arm/a.py") is None


@pytest.mark.parametrize(
    ("profile", "select", "levels", "expected"),
    [
        ("strict", (), {}, NOTE),
        ("all", (), {}, NOTE),
        ("ros", ("pylint:unused-import",), {}, NOTE),
        ("ros", ("cleanup",), {"unused-import": ERROR}, ERROR),
        ("ros", (), {}, None),
        ("ros", (), {"unused-import": ERROR}, None),
        ("bugs-only", (), {}, None),
        ("ros", ("pylint:used-before-assignment",), {}, None),
    ],
)
def test_a_hint_of_a_check(
    profile: str, select: tuple[str, ...], levels: dict[str, Level], expected: Level | None
) -> None:
    made = selection(profile=profile, select=select, levels=levels)
    assert made.decide("pylint", "unused-import", "a.py", default=NOTE) is expected


def test_what_is_no_hint_is_shown() -> None:
    made = selection(profile="ros")
    assert made.decide("pylint", "unused-import", "a.py", default=ERROR) is ERROR
    assert made.decide("pylint", Rule("x", "", level=NOTE, profiles=("ros",)), "a.py", default=NOTE) is NOTE
