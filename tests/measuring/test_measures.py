# SPDX-License-Identifier: Apache-2.0
"""All metrics of a workspace, HAROS's rules on them, and ``haros-ci metrics``."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest
from commandline import write

from haros_ci import cli
from haros_ci.commands.limits import LIMITS
from haros_ci.config.settings import Policy, Settings
from haros_ci.linters.catalogue import UNSERVED, rules_of
from haros_ci.linters.metrics import STRUCTURE_RULES
from haros_ci.measuring import exceeded
from haros_ci.measuring.facts import from_json, to_json
from haros_ci.measuring.measures import measure, structure
from haros_ci.measuring.python import read_python
from haros_ci.measuring.totals import METRICS
from haros_ci.model.measurement import Measurement
from haros_ci.own_sources import OF_MEASURES, digest
from haros_ci.pipeline import analyse
from haros_ci.registry import check_rules
from haros_ci.report import measurements
from haros_ci.results.result import Result
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

#: HAROS's definitions.yaml.
HAROS_METRICS = (
    "comments comment_ratio coupling cyclomatic_complexity eloc function_calls function_parameters halstead_bugs"
    " halstead_time halstead_volume depth_in_tree lloc maintainability_index methods_available nested_control"
    " number_of_children ploc sloc static_path_count unique_function_calls weighted_methods"
).split()
HAROS_RULES = (
    "max_comment_ratio_30 max_comment_ratio_40 min_comment_ratio_20 max_cyclomatic_complexity_10"
    " max_cyclomatic_complexity_15 max_eloc_50 max_eloc_70 max_function_calls_7 max_function_calls_10"
    " max_function_parameters_6 max_function_length_40 max_file_length_400 max_control_nesting_4 max_control_nesting_5"
    " max_static_path_80 max_static_path_200 max_static_path_250 max_coupling_objects_5 max_immediate_children_10"
    " max_weighted_methods_50 max_weighted_methods_100 max_deepest_inheritance_5 max_methods_available_20 mi_below_20"
    " mi_below_65 halstead_volume_above_8000 halstead_bugs_above_2 no_global_names"
).split()

MANIFEST = "<package format='3'><name>{}</name></package>"
NESTED = "if (a) { for (;;) { while (b) { if (c) { switch (d) { case 1: if (e) { f(); } } } } } }"
FILES = {
    "one/package.xml": MANIFEST.format("one"),
    "one/a.h": "class A\n{\npublic:\n  void f(int x);\n  int g() { return 1; }\n};\n",
    "one/a.cpp": f'#include "a.h"\nvoid A::f(int x)\n{{\n  {NESTED}\n}}\nvoid h() {{}}\n',
    "two/package.xml": MANIFEST.format("two"),
    "two/b.py": "class B:\n    def f(self, x):\n        # why\n        return g(x) if x else h()\n",
}


def values_of(root: Path, **settings: object) -> tuple[Measurement, ...]:
    chosen = Settings(root=root, **settings)  # type: ignore[arg-type]
    return measure(discover(root, chosen.paths), chosen, MemoryCache()).values


def test_all_metrics_of_haros_are_there(tmp_path: Path) -> None:
    found = values_of(write(tmp_path, FILES))
    assert len(HAROS_METRICS) == len(set(HAROS_METRICS)) == 21
    assert {each.metric.replace("-", "_") for each in found} == set(HAROS_METRICS)
    assert {name.replace("-", "_") for name in METRICS} == set(HAROS_METRICS)
    packages = {each.metric for each in found if measurements.level(each) == "package"}
    assert packages == METRICS


def test_all_rules_of_haros_are_served() -> None:
    named = {
        alias for rules in (rules_of("metrics"), check_rules()) for rule in rules.values() for alias in rule.aliases
    }
    assert len(HAROS_RULES) == len(set(HAROS_RULES)) == 28
    assert set(HAROS_RULES) <= named
    assert not set(HAROS_RULES) & set(UNSERVED)


def test_values_of_each_level(tmp_path: Path) -> None:
    found = {
        (each.path, each.line, each.class_name, each.function, each.metric): each.value
        for each in values_of(write(tmp_path, FILES))
    }
    assert found["one/a.cpp", 2, "A", "f", "nested-control"] == 6
    assert found["one/a.cpp", 2, "A", "f", "function-parameters"] == 1
    assert found["one/a.cpp", 2, "A", "f", "cyclomatic-complexity"] == 7
    assert found["one/a.cpp", 6, "", "h", "ploc"] == 1
    assert found["one/a.h", 1, "A", "", "weighted-methods"] == 1 + 7
    assert found["one/a.h", 1, "A", "", "methods-available"] == 2
    assert found["two/b.py", 2, "B", "f", "unique-function-calls"] == 2
    assert found["one/a.cpp", 0, "", "", "nested-control"] == 6
    assert found["two/b.py", 0, "", "", "comments"] == 1
    assert found["two/b.py", 0, "", "", "comment-ratio"] == 0.25


def test_packages_are_sums_maxima_and_means(tmp_path: Path) -> None:
    every = values_of(write(tmp_path, FILES))
    found = {(each.package, each.metric): each.value for each in every if not each.path}
    files = {each.metric: [] for each in every}  # type: ignore[var-annotated]
    for each in every:
        if each.package == "one" and measurements.level(each) == "file":
            files[each.metric].append(each.value)
    assert found["one", "ploc"] == sum(files["ploc"]) > 10
    assert found["one", "nested-control"] == max(files["nested-control"])
    assert found["one", "maintainability-index"] == pytest.approx(sum(files["maintainability-index"]) / 2)
    assert found["two", "comment-ratio"] == 0.25


def test_of_a_package_that_is_measured_in_part_nothing_is_said(tmp_path: Path) -> None:
    write(tmp_path, FILES)
    found = values_of(tmp_path, paths=("one/a.cpp",))
    assert {each.path for each in found} == {"one/a.cpp"}


def test_zero_is_a_value(tmp_path: Path) -> None:
    found = values_of(write(tmp_path, {"a.py": "def f():\n    pass\n"}))
    assert {(each.metric, each.value) for each in found if each.function and not each.value} >= {
        ("function-parameters", 0), ("nested-control", 0),
    }  # fmt: skip


def test_a_broken_file_costs_nothing_else(tmp_path: Path) -> None:
    write(tmp_path, {**FILES, "one/broken.py": "def f(:\n", "one/lost.cpp": "void f() { if (a { } }\n"})
    chosen = Settings(root=tmp_path)
    made = measure(discover(tmp_path, (".",)), chosen, MemoryCache())
    assert {"one/broken.py", "one/lost.cpp"} <= {note.path for note in made.notifications}
    assert made.failed == ()
    assert any(each.path == "one/a.cpp" for each in made.values)


def test_facts_come_from_the_store_and_are_not_trusted(tmp_path: Path) -> None:
    workspace = discover(write(tmp_path, FILES), (".",))
    store = MemoryCache()
    first = structure(workspace, store, 1).facts
    assert structure(workspace, store, 1).facts == first
    file = next(each for each in workspace.files if each.path == "two/b.py")
    key = ("measured-python", file.path, f"{digest(OF_MEASURES)} {file.digest}")
    assert from_json(store.get(*key)) == first["two/b.py"]
    for nonsense in ("x", [1], [[[1]], [], []], [[], [], [["a", "b"]]], [[], [["A", 1, 1, -1, 0, []]], []]):
        store.put(*key, nonsense)
        assert structure(workspace, store, 1).facts == first


def test_facts_survive_json() -> None:
    facts = read_python(FILES["two/b.py"])
    assert from_json(json.loads(json.dumps(to_json(facts)))) == facts


# -- rules


def found_in(root: Path, *, profile: str = "strict", select: tuple[str, ...] = ()) -> tuple[Result, ...]:
    settings = Settings(root=root, profile=profile, command_line=Policy(select=select))
    report, _ = analyse(settings, MemoryCache())
    return tuple(each for each in report.results if each.tool == "metrics" and each.rule in STRUCTURE_RULES)


MANY = "\n".join(f"class C{n} : public Base {{}};" for n in range(11))
CASES = {
    "max-function-calls-7": "void f()\n{\n  a(); b(); c(); d(); e(); g(); h(); i();\n}\n",
    "max-function-calls-10": "void f()\n{\n  a(); b(); c(); d(); e(); g(); h(); i(); j(); k(); l();\n}\n",
    "max-control-nesting-4": "void f()\n{\n  if (a) { if (b) { if (c) { if (d) { if (e) {} } } } }\n}\n",
    "max-control-nesting-5": f"void f()\n{{\n  {NESTED}\n}}\n",
    "max-static-path-80": "void f()\n{\n" + "  if (a) {}\n" * 6 + "  if (a && b) {}\n}\n",
    "max-static-path-200": "void f()\n{\n" + "  if (a) {}\n" * 5 + "  if (a && b && c && d && e && f) {}\n}\n",
    "max-static-path-250": "void f()\n{\n" + "  if (a) {}\n" * 8 + "}\n",
    "max-immediate-children-10": f"class Base\n{{\n}};\n{MANY}\n",
    "max-methods-available-20": "struct A\n{\n" + "".join(f"  void f{n}();\n" for n in range(21)) + "};\n",
    "max-deepest-inheritance-5": "class A : public Out {};\n"
    + "".join(f"class {b} : public {a} {{}};\n" for a, b in zip("ABCD", "BCDE", strict=True)),
    "max-coupling-objects-5": "".join(f"class {c} {{}};\n" for c in "BCDEFG") + "class A { B b; C c; D d; E e; F f; G g; };\n",
}  # fmt: skip
CASES["max-weighted-methods-50"] = (
    "class A\n{\n"
    + "".join(f"  void f{n}() {{ if (a) {{}} if (b) {{}} if (c) {{}} if (d) {{}} }}\n" for n in range(11))
    + "};\n"
)
CASES["max-weighted-methods-100"] = CASES["max-weighted-methods-50"].replace(
    "if (d) {}", "if (d) {} " + "if (e) {} " * 5
)


@pytest.mark.parametrize("rule", STRUCTURE_RULES)
def test_every_threshold_fires(tmp_path: Path, rule: str) -> None:
    """And only its own band of the metric: the worst one alone is told."""
    found = found_in(
        write(tmp_path, {"a.cpp": CASES[rule]}),
        profile="bugs-only",
        select=tuple(f"metrics:{r}" for r in STRUCTURE_RULES),
    )
    family = rule.rpartition("-")[0]
    assert [each.rule for each in found if each.rule.startswith(family)] == [rule]


def test_every_threshold_can_be_named_as_haros_does(tmp_path: Path) -> None:
    (found,) = found_in(
        write(tmp_path, {"a.cpp": CASES["max-control-nesting-5"]}),
        profile="bugs-only",
        select=("max_control_nesting_4",),
    )
    assert found.rule == "max-control-nesting-4"


def test_it_is_told_at_the_signature(tmp_path: Path) -> None:
    (found,) = (
        each
        for each in found_in(
            write(tmp_path, {"a.cpp": "\ntemplate <class T>\nvoid\n" + CASES["max-control-nesting-5"][5:]})
        )
        if each.rule == "max-control-nesting-5"
    )
    assert (found.location.line, found.location.column) == (4, 1)
    assert found.message == "Function 'f' nests control structures 6 deep (limit 5)."
    assert (found.value, found.limit, found.scope) == (6, 5, "f")


@pytest.mark.parametrize("profile", ["ros", "bugs-only", "google"])
def test_nothing_is_measured_where_no_such_rule_is_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, profile: str
) -> None:
    def fail(*_: object) -> None:
        raise AssertionError("measured")

    monkeypatch.setattr(exceeded, "exceeded_limits", fail)
    write(tmp_path, {"a.cpp": CASES["max-control-nesting-5"]})
    assert found_in(tmp_path, profile=profile) == ()
    with pytest.raises(AssertionError, match="measured"):
        found_in(tmp_path, profile=profile, select=("max_control_nesting_5",))


def test_they_can_be_suppressed_at_the_signature(tmp_path: Path) -> None:
    text = (
        "void f()  // haros: ignore[max-control-nesting-5] a table would be longer\n"
        + CASES["max-control-nesting-5"][9:]
    )
    found = found_in(write(tmp_path, {"a.cpp": text}), select=("max_control_nesting_5",))
    assert [bool(each.suppressions) for each in found if each.rule == "max-control-nesting-5"] == [True]


@pytest.mark.parametrize(
    "text",
    [
        "void f()\n{\n  a(); b(); c(); d(); e(); g(); h(); a(); b();\n}\n",
        "void f()\n{\n  if (a) { if (b) { if (c) { if (d) {} } } }\n}\n",
        "void f()\n{\n" + "  if (a) {}\n" * 6 + "}\n",
        "void f()\n{\n" + "  if (a) {} else\n" * 60 + "  g();\n}\n",
        "class Base\n{\n};\n" + "\n".join(MANY.split("\n")[:10]) + "\n",
        "struct A\n{\n" + "".join(f"  void f{n}();\n" for n in range(20)) + " private:\n  void g();\n};\n",
        "".join(f"class {b} : public {a} {{}};\n" for a, b in zip("ABCD", "BCDE", strict=True)),
        "".join(f"class {c} {{}};\n" for c in "BCDEF") + "class A { B b; C c; D d; E e; F f; A * a; std::string s; };\n",
        'void f() { log("if (a) { if (b) { if (c) { if (d) { if (e) {}"); }\n',
    ],
)  # fmt: skip
def test_at_the_limit_nothing_is_said(tmp_path: Path, text: str) -> None:
    assert found_in(write(tmp_path, {"a.cpp": text})) == ()


# -- the command


def run(root: Path, capfd: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    code = cli.main(["metrics", str(root), "--no-cache", "--isolated", *arguments])
    out, err = capfd.readouterr()
    return code, out, err


def test_text(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(write(tmp_path, FILES), capfd, "--level", "function", "--metric", "nested_control")
    assert code == 0
    assert out == (
        "The worst 1, by value divided by limit:\n"
        "  value  limit  metric          of        what  where\n"
        "  6      4      nested-control  function  A f   one/a.cpp:2\n"
        "\n"
        "one/a.cpp:2: function A f: nested-control 6 (over 5)\n"
        "one/a.cpp:6: function h: nested-control 0\n"
        "one/a.h:5: function A g: nested-control 0\n"
        "two/b.py:2: function B f: nested-control 0\n"
    )


def test_json(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(write(tmp_path, {**FILES, "two/c.py": "def f(:\n"}), capfd, "--format", "json")
    document = json.loads(out)
    assert code == 0
    assert [each["function"] for each in document["functions"]] == ["f", "h", "g", "f"]
    assert document["functions"][0]["crossed"] == ["max-control-nesting-4", "max-control-nesting-5"]
    assert {each["package"] for each in document["packages"]} == {"one", "two"}
    assert set(document["packages"][0]["metrics"]) == METRICS
    assert {"rule": "min-comment-ratio-20", "level": "file", "metric": "comment-ratio", "min": 0.2} in document[
        "limits"
    ]
    assert len(document["limits"]) == len(LIMITS) == 27
    assert {each["path"] for each in document["notifications"]} == {"two/c.py"}


def test_csv(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(write(tmp_path, FILES), capfd, "--format", "csv", "--level", "file", "--level", "class")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert tuple(rows[0]) == measurements.COLUMNS
    assert {each["level"] for each in rows} == {"file", "class"}
    ratio = next(each for each in rows if each["path"] == "one/a.cpp" and each["metric"] == "comment-ratio")
    assert (ratio["value"], ratio["limits"], ratio["crossed"]) == ("0", ">=0.20 <=0.30 <=0.40", "min-comment-ratio-20")


def test_output_to_a_file(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "out" / "m.csv"
    code, out, _ = run(write(tmp_path / "w", FILES), capfd, "--format", "csv", "--output", str(target))
    assert (code, out) == (0, "")
    assert target.read_text(encoding="utf-8").startswith("level,package,")


def test_the_same_bytes_again(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    write(tmp_path, FILES)
    assert (
        run(tmp_path, capfd, "--format", "json", "-j", "2")[1] == run(tmp_path, capfd, "--format", "json", "-j", "1")[1]
    )


def test_an_unknown_metric_is_a_usage_error(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(write(tmp_path, FILES), capfd, "--metric", "nested-contrl")
    assert (code, out) == (2, "")
    assert "did you mean 'nested-control'?" in err


def test_nothing_to_measure(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(write(tmp_path, {"README.md": "x\n"}), capfd)[:2] == (0, "")


def test_a_tool_that_is_missing_is_trouble(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from haros_ci.linters import lizard

    monkeypatch.setattr(lizard, "locate", lambda options: None)
    code, out, err = run(write(tmp_path, FILES), capfd)
    assert code == 3
    assert "lizard is not installed" in err
    assert "nested-control 6" in out


def test_hostile_names_are_escaped(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    write(tmp_path, {"=x\x1b[31m.py": "def f():\n    pass\n", "b.py": "def g():\n    pass\n"})
    _, text, err = run(tmp_path, capfd)
    assert "\x1b" not in text + err
    assert "function g" in text
    _, table, _ = run(tmp_path, capfd, "--format", "csv")
    assert not any(row["path"].startswith("=") for row in csv.DictReader(io.StringIO(table)))
