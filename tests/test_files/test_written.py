# SPDX-License-Identifier: Apache-2.0
"""The files of tests: what is drawn from which predicates, in which order it is sent, and that nothing of the workspace runs in them."""

from __future__ import annotations

import ast
import io
import re
import sys
import tokenize
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, find, given, settings
from hypothesis.errors import NoSuchExample, Unsatisfiable
from test_files.suites import TOPICS, TYPES, messages, suite

from haros_ci.test_files.names import identifier
from haros_ci.test_files.suite import Suite
from haros_ci.test_files.types import path_of
from haros_ci.test_files.written import Written, written

FEW = settings(max_examples=200, database=None, derandomize=True)
#: Messages that are looked at for many conditions; what is special to a predicate is drawn often, and is among them.
SAMPLE = settings(
    max_examples=60,
    database=None,
    derandomize=True,
    phases=(Phase.generate,),
    deadline=None,
    suppress_health_check=list(HealthCheck),
)


@contextmanager
def imported(made: Written, folder: Path) -> Iterator[dict[str, Any]]:
    """The names of the test module of a suite of one file, imported as pytest does it."""
    for name, text in made.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    (name,) = [name for name in made.files if name.startswith("test_")]
    before = set(sys.modules)
    sys.path.insert(0, str(folder))
    try:
        names: dict[str, Any] = {"__name__": "generated", "__file__": str(folder / name)}
        exec(compile(made.files[name], name, "exec"), names)
        yield names
    finally:
        sys.path.remove(str(folder))
        for module in set(sys.modules) - before:
            if module.split(".")[0].startswith(("property_tests", "monitors_")):
                del sys.modules[module]


def module_of(made: Written) -> str:
    (text,) = [text for name, text in made.files.items() if name.startswith("test_")]
    return text


def drawn(strategy: Any, condition: Any = lambda value: True) -> Any:
    try:
        return find(strategy, condition, settings=FEW)
    except (NoSuchExample, Unsatisfiable):
        return None


def sample(inputs: Any) -> list[Any]:
    """Messages of all *inputs*, as Hypothesis draws them first."""
    found: list[Any] = []
    for item in inputs:

        @SAMPLE
        @given(item.strategy({}))
        def take(message: Any) -> None:
            found.append(message)

        try:
            take()
        except Unsatisfiable:
            pass
    return found


def can_be(inputs: Any, condition: Any) -> bool:
    """Whether one of *inputs* can be a message for which *condition* holds."""
    return any(drawn(item.strategy({}), condition) is not None for item in inputs)


def holds_in(condition: str, messages: list[Any]) -> bool:
    return any(eval(condition, {"m": m}) for m in messages)


@pytest.mark.parametrize(
    ("text", "sent", "not_sent"),
    [
        ("globally: /level {data <= 32} causes /stop within 1 s", ["m['data'] == 32", "m['data'] == -128", "m['data'] == 0"], ["m['data'] == 33"]),
        ("globally: /level {data in [10 to 20]} causes /stop within 1 s", ["m['data'] == 10", "m['data'] == 20"], ["m['data'] == 21"]),
        ("globally: /level {data in {3, 5}} causes /stop within 1 s", ["m['data'] == 3", "m['data'] == 5"], ["m['data'] == 4"]),
        ("globally: /level {data != 0} causes /stop within 1 s", ["m['data'] == 1", "m['data'] == -1"], ["m['data'] == 0"]),
        ("globally: /level {data * data > 100} causes /stop within 1 s", ["m['data'] > 10"], ["m['data'] == 10"]),
        ("globally: /bumper {left or right} causes /stop within 1 s", ["m['left'] and not m['right']", "m['right']"], ["not m['left'] and not m['right']"]),
        ("globally: /bumper {left and not right} causes /stop within 1 s", ["m['left'] and not m['right']"], ["m['right']"]),
        ("globally: /command {speed > MAX} causes /stop within 1 s", ["1.5 < m['speed'] < 1.5000000001"], ["m['speed'] == 1.5"]),
        ("globally: /command {speed >= MAX} causes /stop within 1 s", ["m['speed'] == 1.5"], ["m['speed'] < 1.5"]),
        ("globally: /command {speed = -1.0} causes /stop within 1 s", ["m['speed'] == -1.0"], ["m['speed'] != -1.0"]),
        ("globally: /command {mode = \"go\"} causes /stop within 1 s", ["m['mode'] == 'go'"], ["m['mode'] != 'go'"]),
        ("globally: /command {mode != \"go\"} causes /stop within 1 s", ["m['mode'] == ''"], ["m['mode'] == 'go'"]),
        ("globally: /scan {len(ranges) >= 3} causes /stop within 1 s", ["len(m['ranges']) == 3"], ["len(m['ranges']) < 3"]),
        ("globally: /scan {ranges[2] > 0} causes /stop within 1 s", ["m['ranges'][2] > 0"], ["len(m['ranges']) < 3"]),
        ("globally: /scan {commands[1].speed > 2} causes /stop within 1 s", ["m['commands'][1]['speed'] > 2"], ["len(m['commands']) < 2"]),
        ("globally: /deep {level = HIGH} causes /stop within 1 s", ["m['level'] == 7"], ["m['level'] != 7"]),
        ("globally: /scan {forall i in colour: colour[@i] < 9} causes /stop within 1 s", ["max(m['colour']) < 9"], ["max(m['colour']) >= 9"]),
    ],
)  # fmt: skip
def test_messages_match_the_predicate_and_others_do_not(
    text: str, sent: list[str], not_sent: list[str], tmp_path: Path
) -> None:
    topic = text.split()[1]
    with imported(written([suite(text, inputs=(topic,))]), tmp_path) as names:
        triggers, others = sample(names["TRIGGERS_1"]), sample(names.get("OTHERS_1", ()))
        for condition in sent:
            rare = lambda m, condition=condition: eval(condition, {"m": m})  # noqa: E731  # asked for where the sample lacks it
            assert holds_in(condition, triggers) or can_be(names["TRIGGERS_1"], rare), condition
            assert not holds_in(condition, others), condition
        for condition in not_sent:
            assert triggers and not holds_in(condition, triggers), condition


def test_each_operand_of_or_is_tried_alone(tmp_path: Path) -> None:
    text = "globally: /bumper {left or not right} causes /stop within 1 s"
    made = written([suite(text, inputs=("/bumper",))])
    (found,) = re.findall(r"st\.one_of\((.*?)\n        \)", module_of(made), re.DOTALL)
    first, second = [line.strip() for line in found.strip().splitlines()][:2]
    assert first == "having(demo_bumper(), {('left',): st.just(True), ('right',): st.just(True)}),"
    assert second == "having(demo_bumper(), {('left',): st.just(False), ('right',): st.just(False)}),"


@pytest.mark.parametrize(
    ("assumption", "condition"),
    [
        ("globally: no /level {data < 0}", "m['data'] < 0"),
        ("globally: no /level {not data in [0 to 127]}", "m['data'] < 0"),
        ("globally: no /level {data * data > 9999}", "m['data'] == 100"),
        ("globally: no (/level {data = 5} or /bumper)", "m['data'] == 5"),
    ],
)
def test_nothing_is_sent_that_an_assumption_excludes(assumption: str, condition: str, tmp_path: Path) -> None:
    made = written([suite("globally: /level {data <= 32} causes /stop within 1 s", assumptions=(assumption,))])
    with imported(made, tmp_path) as names:
        for role in ("TRIGGERS_1", "OTHERS_1"):
            messages_sent = sample([item for item in names[role] if item.topic == "/level"])
            assert messages_sent and not holds_in(condition, messages_sent)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("globally: no /out {data > 3}", ["between(1, 3, *OTHERS_1)"]),
        ("globally: some /out within 1 s", ["between(0, 2, *OTHERS_1)", "settled()"]),
        (
            "globally: /level {data = 1} causes /stop within 1 s",
            ["between(0, 2, *OTHERS_1)", "between(1, 2, *TRIGGERS_1)", "between(0, 2, *OTHERS_1)", "settled()"],
        ),
        (
            "globally: /out causes /stop within 1 s",
            ["between(0, 2, *OTHERS_1)", "between(1, 4, *OTHERS_1)", "between(0, 2, *OTHERS_1)", "settled()"],
        ),
        (
            "globally: /level {data = 1} forbids /stop within 1 s",
            ["between(0, 2, *OTHERS_1)", "between(1, 2, *TRIGGERS_1)", "between(0, 3, *OTHERS_1)"],
        ),
        (
            "globally: /stop requires /level {data = 1} within 1 s",
            [
                "either(between(1, 3, *OTHERS_1), in_order(one(*TRIGGERS_1), between(0, 2, *OTHERS_1)), "
                "in_order(one(*TRIGGERS_1), pause(1.0), between(1, 3, *OTHERS_1)))"
            ],
        ),
        (
            "globally: /stop requires /level {data = 1}",
            ["either(between(1, 3, *OTHERS_1), in_order(one(*TRIGGERS_1), between(0, 2, *OTHERS_1)))"],
        ),
        (
            "after /bumper {left}: no /out",
            ["between(0, 1, *OTHERS_1)", "one(*ACTIVATORS_1)", "between(1, 3, *OTHERS_1)"],
        ),
        (
            "until /bumper {left}: no /out",
            ["between(1, 3, *OTHERS_1)", "perhaps(pause(0.15), one(*TERMINATORS_1), between(0, 2, *OTHERS_1))"],
        ),
        (
            "after /level {data = 1} until /bumper {left}: /level {data = 2} causes /stop within 1 s",
            [
                "between(0, 1, *OTHERS_1)", "one(*ACTIVATORS_1)", "between(0, 2, *OTHERS_1)", "between(1, 2, *TRIGGERS_1)",
                "between(0, 2, *OTHERS_1)", "settled()",
                "perhaps(settled(), one(*TERMINATORS_1), between(0, 2, *OTHERS_1, *TRIGGERS_1), "
                "perhaps(one(*ACTIVATORS_1), between(0, 2, *OTHERS_1), between(1, 2, *TRIGGERS_1), between(0, 2, *OTHERS_1), settled()))",
            ],
        ),
        ("after /out until /stop: no /out {data > 3}", ["between(0, 1, *OTHERS_1)", "between(1, 3, *OTHERS_1)"]),
    ],
)  # fmt: skip
def test_what_is_sent_in_which_order(text: str, parts: list[str]) -> None:
    module = module_of(written([suite(text)]))
    assert re.findall(r"^PARTS_1 = \[\n(.*?)^\]", module, re.DOTALL | re.MULTILINE) == [
        "".join(f"    {part},\n" for part in parts)
    ]


@pytest.mark.parametrize(
    ("assumption", "spacing"),
    [
        ("globally: /level forbids /level within 1 s", "Spacing('/level', '/level', 1.0, None, None)"),
        (
            "globally: /bumper {left} forbids /level within 100 ms",
            "Spacing('/bumper', '/level', 0.1, is_property2_1, None)",
        ),
        ("globally: /level forbids /level", ""),
        ("globally: /out forbids /level within 1 s", ""),
        ("after /bumper: /level forbids /level within 1 s", ""),
    ],
)
def test_rates_that_are_assumed(assumption: str, spacing: str) -> None:
    module = module_of(
        written([suite("globally: /level {data = 1} causes /stop within 1 s", assumptions=(assumption,))])
    )
    found = re.findall(r"^SPACINGS = \[(.*?)\]", module, re.DOTALL | re.MULTILINE)
    assert [item.strip().rstrip(",") for item in found] == [spacing]


def test_a_value_of_an_earlier_message_can_be_asked_for(tmp_path: Path) -> None:
    text = "after /bumper as B {left}: /level {data > 3 and @B.right} causes /stop within 1 s"
    with imported(written([suite(text)]), tmp_path) as names:
        (level,) = names["TRIGGERS_1"]
        assert drawn(level.strategy({"B": {"left": True, "right": True}})) == {"data": 4}
        assert drawn(level.strategy({"B": {"left": True, "right": False}})) is None


def test_types_become_functions(tmp_path: Path) -> None:
    made = written([suite("globally: /deep causes /stop within 1 s", inputs=("/deep",))])
    with imported(made, tmp_path) as names:
        simplest = drawn(names["demo_deep"]())
        assert simplest == {
            "scan": {
                "header": {"seq": 0, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": ""},
                "ranges": [],
                "colour": [0, 0, 0],
                "commands": [],
            },
            "at": {"secs": 0, "nsecs": 0},
            "took": {"secs": 0, "nsecs": 0},
            "level": 0,
        }
    assert "'level': whole(-128, 127, near=(-3, 7))," in module_of(made)


@pytest.mark.parametrize(("non_finite", "found"), [(False, False), (True, True)])
def test_numbers_are_finite_unless_asked_for(non_finite: bool, found: bool, tmp_path: Path) -> None:
    made = written([suite("globally: /command causes /stop within 1 s", inputs=("/command",))], non_finite=non_finite)
    with imported(made, tmp_path) as names:
        assert can_be(names["TRIGGERS_1"], lambda m: m["speed"] != m["speed"]) is found
        assert can_be(names["TRIGGERS_1"], lambda m: m["turn"] in (float("inf"), float("-inf"))) is found


@pytest.mark.parametrize(
    ("types", "reason"),
    [
        (("demo/msg/Level\tdemo/Unknown inner",), "the definition of demo/Unknown is not known"),
        (("demo/msg/Level\tdemo/Level inner",), "too many types"),
        (("demo/msg/Level\tuint8[3000] data",), "3000 items"),
    ],
)
def test_what_no_message_can_be_made_of_is_named(types: tuple[str, ...], reason: str) -> None:
    known = messages(types)
    topics = {"/level": "demo/Level", "/other": "std_msgs/Int8", "/stop": "std_msgs/Empty"}
    made = written(
        [suite("globally: /other causes /stop within 1 s", inputs=("/level", "/other"), known=known, topics=topics)]
    )
    assert any("/level" in note and reason in note for note in made.notes)
    assert "Input('/level'" not in module_of(made)


def test_the_same_suite_gives_the_same_bytes() -> None:
    texts = ("globally: /level {data = 1} causes /stop within 1 s", "globally: no /out {data > 3}")
    assert written([suite(*texts)]) == written([suite(*texts)])


@pytest.mark.parametrize("ros", [1, 2])
def test_nothing_of_haros_ci_is_imported_and_python_3_8_reads_it(ros: int) -> None:
    made = written([suite("globally: /level {data = 1} causes /stop within 1 s", ros=ros)])
    assert len(made.files) > 8
    for name, text in made.files.items():
        assert text.isascii() or name.startswith("property_tests/"), name
        tree = ast.parse(text, feature_version=(3, 8))
        for node in ast.walk(tree):
            modules = (
                [alias.name for alias in node.names]
                if isinstance(node, ast.Import)
                else [node.module or ""]
                if isinstance(node, ast.ImportFrom)
                else []
            )
            assert not any(module.startswith("haros_ci") for module in modules)
        assert not list(_evaluated(tree)), name


def _evaluated(tree: ast.AST) -> Iterator[str]:
    """Generic types that are evaluated when the module is imported, which Python 3.8 cannot: those outside of annotations."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            continue
        if isinstance(node, ast.Subscript) and ast.unparse(node.value) in (
            "dict",
            "list",
            "tuple",
            "set",
            "type",
            "Callable",
            "Sequence",
            "Mapping",
        ):
            yield ast.unparse(node)
        for field in ("annotation", "returns"):
            if getattr(node, field, None) is not None:
                setattr(node, field, None)
        yield from _evaluated(node)


#: Texts that would do something if they got out of their literals.
HOSTILE = (
    '");import os;os.system("x")#',
    "'''",
    '"""',
    "\\",
    "\n",
    "{0}",
    "\u202e\u2028",
    "__import__('os')",
    "\x00",
    "é",
)


@pytest.mark.parametrize("hostile", HOSTILE)
def test_hostile_names_stay_literals(hostile: str) -> None:
    known = messages((*TYPES, "demo/msg/Odd\tbool left"))
    topics = {**TOPICS, "/odd": "demo/Bumper"}
    plain = suite(
        "globally: /bumper {left} causes /stop within 1 s", inputs=("/bumper", "/odd"), known=known, topics=topics
    )
    evil = _with(plain, hostile)
    for name, text in written([evil]).files.items():
        if not name.startswith("property_tests/"):
            tree = ast.parse(text)
            assert text.isascii()
            names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
            assert names <= {
                node.id for other in _plain(plain) for node in ast.walk(ast.parse(other)) if isinstance(node, ast.Name)
            } | {"is_property1_1"}
            assert not [
                token
                for token in tokenize.generate_tokens(io.StringIO(text).readline)
                if token.type == tokenize.COMMENT and "system" in token.string
            ]


def _with(plain: Suite, hostile: str) -> Suite:
    """The same suite with this text wherever a workspace has one."""
    from dataclasses import replace

    properties = tuple(replace(item, title=hostile, where=hostile, text=hostile) for item in plain.properties)
    launches = tuple(replace(item, package=hostile, path=hostile, arguments=(hostile,)) for item in plain.launches)
    inputs = tuple(replace(topic, name=hostile) if topic.name == "/odd" else topic for topic in plain.inputs)
    edges = ((hostile, hostile, True),)
    return replace(
        plain,
        configuration=hostile,
        node=hostile,
        nodes=(hostile,),
        properties=properties,
        launches=launches,
        inputs=inputs,
        edges=edges,
    )


def _plain(suite_: Suite) -> list[str]:
    return [text for name, text in written([suite_]).files.items() if not name.startswith("property_tests/")]


@pytest.mark.parametrize(
    ("term", "path"),
    [
        ("data", ("data",)),
        ("a.b", ("a", "b")),
        ("a[0]", ("a", 0)),
        ("a[0].b", ("a", 0, "b")),
        ("len(a)", ("a", "len()")),
        ("len(a.b)", ("a", "b", "len()")),
        ("a[@i]", None),
        ("a[i]", None),
        ("@A.x", None),
        ("[0]", None),
        (".a", None),
        ("len(len(a))", None),
        ("a b", None),
        ("", None),
    ],
)
def test_terms_are_paths(term: str, path: Any) -> None:
    assert path_of(term) == path


@pytest.mark.parametrize("text", [*HOSTILE, "", "a", "globally: no /x", "9", "a" * 500, "Ünïcode"])
def test_identifiers_are_identifiers(text: str) -> None:
    taken: set[str] = set()
    first, second = identifier(text, taken), identifier(text, taken)
    assert f"test_{first}".isidentifier() and first != second and len(first) <= 60


def test_two_files_have_two_names() -> None:
    made = written(
        [suite("globally: no /out {data > 3}", node="/a/b"), suite("globally: no /out {data > 3}", node="/a_b")]
    )
    assert [name for name in made.files if name.startswith("test_")] == ["test_robot_a_b.py", "test_robot_a_b_2.py"]
