# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import math
from typing import Any

import pytest
from syntax_kit import shown

from haros_ci.extract.parameter_library import read_parameter_library as typed_library
from haros_ci.syntax import Program
from haros_ci.syntax.codec import decoded, encoded


def read_parameter_library(path: str, text: str, language: str = "cpp") -> Any:
    return shown(typed_library(path, text, language))


WHOLE = """\
arm_driver:
  joints:
    type: string_array
    default_value: [left, right]
    description: "the joints"
    read_only: true
  rate: {type: double, default_value: 5}
  pid:
    gain: {type: int, default_value: -3, validation: {bounds<>: [-5, 5]}}
    __map_joints:
      p: {type: double, default_value: 0.5, validation: {gt_eq<>: [0.0]}}
      limit: {type: double}
  frame: {type: string}
"""


def found(tree: Any, kind: str) -> list[Any]:
    """All terms of a kind, outer ones first."""
    if not isinstance(tree, tuple):
        return []
    here = [tree] if tree[:1] == (kind,) else []
    return here + [term for part in tree for term in found(part, kind)]


def written(term: Any) -> str:
    """A short text of an expression."""
    match term:
        case ("name", name):
            return str(name)
        case ("this",):
            return "this"
        case ("field", owner, name):
            return f"{written(owner)}.{name}"
        case ("index", owner, key):
            return f"{written(owner)}[{written(key)}]"
        case ("op", operator, (left, right)):
            return f"{written(left)} {operator} {written(right)}"
        case ("op", operator, (only,)):
            return f"{operator}{written(only)}"
        case ("call", callee, args, types, _, _):
            kinds = ", ".join(kind(each) for each in types)
            return f"{written(callee)}{f'<{kinds}>' if kinds else ''}({', '.join(map(written, args))})"
        case ("list", items):
            return "{" + ", ".join(map(written, items)) + "}"
        case ("format", parts):
            return "f" + "|".join(map(written, parts))
        case ("kw", name, value):
            return f"{name}={written(value)}"
        case (_, value):
            return repr(value)
    return repr(term)


def kind(written_type: Any) -> str:
    name, arguments, _ = written_type
    return f"{name}<{', '.join(map(kind, arguments))}>" if arguments else str(name)


def body(program: Program, name: str) -> Any:
    return next(function.body for function in program.functions if function.name == name)


def declared(program: Program) -> list[tuple[int, int, str]]:
    """Line, column and text of each assignment of a declared parameter."""
    name = "declare_params"
    sets = [
        term
        for function in program.functions
        if function.name.endswith(name)
        for term in found(function.body, "set")
        if found(term, "call") and "declare_parameter" in written(term[3])
    ]
    calls = [next(c for c in found(term, "call") if written(c[1]).endswith(name[:7] + "_parameter")) for term in sets]
    return [
        (call[4], call[5], f"{written(term[2])} = {written(term[3])}") for term, call in zip(sets, calls, strict=True)
    ]


def one(text: str, language: str = "cpp") -> str:
    """The declaration of the only parameter, ``p``, of these attributes."""
    program = read_parameter_library("x.yaml", f"ns:\n  p: {{{text}}}\n", language)
    assert program.problems == ()
    return declared(program)[0][2]


def test_declarations_in_cpp() -> None:
    program = read_parameter_library("x.yaml", WHOLE)
    call = "this.parameters_interface_.declare_parameter"
    assert program.problems == ()
    assert declared(program) == [
        (
            2,
            3,
            f"this.params_.joints = {call}<std::vector<std::string>>"
            "(this.prefix_ + 'joints', {'left', 'right'}, descriptor)",
        ),
        (7, 3, f"this.params_.rate = {call}<double>(this.prefix_ + 'rate', 5.0, descriptor)"),
        (9, 5, f"this.params_.pid.gain = {call}<int64_t>(this.prefix_ + 'pid.gain', -3, descriptor)"),
        (
            11,
            7,
            f"this.params_.pid.joints_map[value_1].p = {call}<double>"
            "(this.prefix_ + 'pid.' + value_1 + '.p', 0.5, descriptor)",
        ),
        (
            12,
            7,
            f"this.params_.pid.joints_map[value_1].limit = {call}<double>"
            "(this.prefix_ + 'pid.' + value_1 + '.limit', descriptor)",
        ),
        (13, 3, f"this.params_.frame = {call}<std::string>(this.prefix_ + 'frame', descriptor)"),
    ]


def test_structs_in_cpp() -> None:
    program = read_parameter_library("x.yaml", WHOLE)
    assert [
        (c.name, [(f.name, kind(f.type), f.init and written(f.init[1])) for f in c.fields]) for c in program.classes[:3]
    ] == [
        (
            "arm_driver::Params",
            [
                ("joints", "std::vector<std::string>", "{'left', 'right'}"),
                ("rate", "double", "5.0"),
                ("frame", "std::string", None),
                ("pid", "arm_driver::Params::Pid", None),
            ],
        ),
        (
            "arm_driver::Params::Pid",
            [
                ("gain", "int64_t", "-3"),
                ("joints_map", "std::map<std::string, arm_driver::Params::Pid::MapJoints>", None),
            ],
        ),
        ("arm_driver::Params::Pid::MapJoints", [("p", "double", "0.5"), ("limit", "double", None)]),
    ]
    assert program.classes[3].name == "arm_driver::ParamListener"
    assert program.aliases[0].name == "arm_driver::StackParams"


def test_constructors_and_methods_in_cpp() -> None:
    program = read_parameter_library("x.yaml", WHOLE)
    makers = [f for f in program.functions if f.kind == "constructor"]
    assert [[p.name for p in f.parameters] for f in makers] == [
        ["node", "prefix"],
        ["parameters_interface", "prefix"],
        ["parameters_interface", "logger", "prefix"],
    ]
    assert all(f.parameters[-1].default == ("str", "") for f in makers)
    kept = [written(term[3]) for f in makers for term in found(f.body, "set") if "interface" in written(term[2])]
    assert kept == ["node", "parameters_interface", "parameters_interface"]
    assert sorted(f.name.rpartition("::")[2] for f in program.functions if f.kind == "function") == [
        "clearUserCallback",
        "declare_params",
        "get_params",
        "get_stack_params",
        "is_old",
        "refresh_dynamic_parameters",
        "setUserCallback",
        "try_get_params",
        "try_update_params",
    ]
    assert body(program, "arm_driver::ParamListener::get_params") == (("return", ("field", ("this",), "params_")),)


def test_declarations_in_python() -> None:
    program = read_parameter_library("x.yaml", WHOLE, "python")
    call = "this.node_.declare_parameter"
    assert [text for _, _, text in declared(program)] == [
        f"this.params_.joints = {call}(this.prefix_ + 'joints', {{'left', 'right'}}, descriptor).value",
        f"this.params_.rate = {call}(this.prefix_ + 'rate', 5.0, descriptor).value",
        f"this.params_.pid.gain = {call}(this.prefix_ + 'pid.gain', -3, descriptor).value",
        f"entry.p = {call}(fthis.prefix_|'pid.'|value_1|'.p', 0.5, descriptor).value",
        f"entry.limit = {call}(fthis.prefix_|'pid.'|value_1|'.limit', rclpy.Parameter.Type.DOUBLE, descriptor).value",
        f"this.params_.frame = {call}(this.prefix_ + 'frame', rclpy.Parameter.Type.STRING, descriptor).value",
    ]
    assert [c.name for c in program.classes] == [
        "arm_driver",
        "arm_driver.Params",
        "arm_driver.Params.__Pid",
        "arm_driver.Params.__Pid.__MapJoints",
        "arm_driver.ParamListener",
    ]
    listener = next(f for f in program.functions if f.name == "arm_driver.ParamListener.__init__")
    assert [p.name for p in listener.parameters] == ["node", "prefix"]


@pytest.mark.parametrize(
    ("attributes", "argument"),
    [
        ("type: bool, default_value: true", "<bool>(this.prefix_ + 'p', True"),
        ("type: int, default_value: 0x10", "<int64_t>(this.prefix_ + 'p', 16"),
        ("type: double, default_value: 1", "<double>(this.prefix_ + 'p', 1.0"),
        ("type: double, default_value: .nan", "(this.prefix_ + 'p', std::numeric_limits::quiet_NaN<double>()"),
        ("type: double, default_value: -.inf", "(this.prefix_ + 'p', -std::numeric_limits::infinity<double>()"),
        ("type: string, default_value: ''", "<std::string>(this.prefix_ + 'p', ''"),
        ("type: string_fixed_25, default_value: a", "<std::string>(this.prefix_ + 'p', 'a'"),
        ("type: double_array, default_value: []", "<std::vector<double>>(this.prefix_ + 'p', {}"),
        ("type: double_array, default_value: [1, .5]", "<std::vector<double>>(this.prefix_ + 'p', {1.0, 0.5}"),
        ("type: int_array_fixed_5, default_value: [1]", "<std::vector<int64_t>>(this.prefix_ + 'p', {1}"),
        ("type: bool_array", "<std::vector<bool>>(this.prefix_ + 'p'"),
    ],
)
def test_types_and_defaults(attributes: str, argument: str) -> None:
    assert one(attributes).endswith(f"{argument}, descriptor)")


def described(attributes: str, language: str = "cpp") -> list[str]:
    program = read_parameter_library("x.yaml", f"ns:\n  p: {{{attributes}}}\n", language)
    sets = [term for f in program.functions if f.name.endswith("declare_params") for term in found(f.body, "set")]
    return [f"{written(term[2])} = {written(term[3])}" for term in sets[:-1]]


ABOVE = repr(math.nextafter(1.0, 2.0))
OPEN = repr(1.7976931348623157e308)


@pytest.mark.parametrize(
    ("attributes", "expected"),
    [
        ("type: int", []),
        ("type: int, validation: {bounds<>: [1, 9]}", ["1", "9", "integer_range"]),
        ("type: int, validation: {gt<>: [1]}", ["2", str(2**63 - 1), "integer_range"]),
        ("type: int, validation: {gt<>: [1], lt_eq<>: 8}", ["2", "8", "integer_range"]),
        ("type: int_array, validation: {lower_element_bounds<>: [1]}", ["1", str(2**63 - 1), "integer_range"]),
        ("type: double, validation: {gt<>: [1.0]}", [ABOVE, OPEN, "floating_point_range"]),
        ("type: double, validation: {upper_bounds<>: 3.5}", [f"-{OPEN}", "3.5", "floating_point_range"]),
        ("type: int, validation: {one_of<>: [[1, 2]]}", []),
        ("type: string, validation: {size_lt<>: [4]}", []),
        ("type: double_array, validation: {fixed_size<>: 3, size_gt<>: 1}", []),
        ("type: int, validation: {'own::bounded': [1, 2]}", []),
        ("type: int, validation: {bounds<>: [a, b]}", []),
        ("type: bool, validation: {gt<>: [1]}", []),
    ],
)
def test_ranges_in_the_descriptor(attributes: str, expected: list[str]) -> None:
    lines = [line for line in described(attributes) if "range" in line]
    if expected:
        lower, upper, member = expected
        assert lines == [
            f"range.from_value = {lower}",
            f"range.to_value = {upper}",
            f"descriptor.{member} = {{range}}",
        ]
    else:
        assert lines == []


def test_the_descriptor() -> None:
    attributes = "type: int, description: why, read_only: true, additional_constraints: odd"
    assert described(attributes) == [
        "descriptor.description = 'why'",
        "descriptor.read_only = True",
        "descriptor.additional_constraints = 'odd'",
    ]
    assert described("type: int, validation: {lt<>: [3]}", "python") == [
        "descriptor = ParameterDescriptor(description='', read_only=False)",
        f"descriptor.integer_range = {{IntegerRange(from_value={-(2**31) - 1}, to_value=2)}}",
    ]


NESTED = """\
ns:
  a: {type: string_array}
  in:
    b: {type: string_array}
    __map_a:
      __map_b:
        deep: {p: {type: int, default_value: 1}}
"""


def test_maps_in_maps_take_their_keys_from_the_nearest_scope() -> None:
    program = read_parameter_library("x.yaml", NESTED)
    loops = found(body(program, "ns::ParamListener::declare_params"), "each")
    assert [(loop[4], written(loop[6])) for loop in loops] == [
        ("value_1", "this.params_.a"),
        ("value_2", "this.params_.in.b"),
    ]
    assert declared(program)[-1][2] == (
        "this.params_.in.a_map[value_1].b_map[value_2].deep.p = this.parameters_interface_.declare_parameter<int64_t>"
        "(this.prefix_ + 'in.' + value_1 + '.' + value_2 + '.deep.p', 1, descriptor)"
    )


@pytest.mark.parametrize("language", ["cpp", "python"])
@pytest.mark.parametrize("text", [WHOLE, NESTED, "ns:\n  p: {type: double, default_value: .nan}\n", "", "a: ["])
def test_programs_survive_the_cache(text: str, language: str) -> None:
    program = typed_library("x.yaml", text, language)
    written = encoded(program)
    assert decoded(written) == program
    assert json.loads(written or "")


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "one key at the top"),
        ("# nothing\n", 1, "one key at the top"),
        ("[1, 2]", 1, "one key at the top"),
        ("a: {p: {type: int}}\nb: {p: {type: int}}\n", 1, "one key at the top"),
        ("1: {p: {type: int}}", 1, "is no C++ name"),
        ("a-b: {p: {type: int}}", 1, "is no C++ name"),
        ("ns: 3", 1, "ns holds no parameters"),
        ("ns: {}", 1, "ns holds no parameters"),
        ("ns:\n  p: {default_value: 1}\n", 2, "no type for the parameter p"),
        ("ns:\n  p: {type: float}\n", 2, "'float', the type of p, is not known"),
        ("ns:\n  p: {type: string_non_type}\n", 2, "is not known"),
        ("ns:\n  p: {type: int, defualt: 1}\n", 2, "'defualt' is no attribute"),
        ("ns:\n  p: {type: int, default_value: 1.5}\n", 2, "the default of p is not of the type int"),
        ("ns:\n  p: {type: int, default_value: true}\n", 2, "the default of p"),
        ("ns:\n  p: {type: int_array, default_value: 1}\n", 2, "the default of p"),
        ("ns:\n  p: {type: int_array, default_value: [1, a]}\n", 2, "the default of p"),
        ("ns:\n  p: {type: string, default_value: 1}\n", 2, "the default of p"),
        ("ns:\n  p: {validation: {gt<>: [1]}, type: int}\n", 2, "put its type first"),
        ("ns:\n  a.b: {type: int}\n", 2, "is no name of C++"),
        ("ns:\n  on: {type: int}\n", 2, "quote yes, no, on and off"),
        ("ns:\n  p: {}\n", 2, "p is empty"),
        ("ns:\n  __map_a:\n    p: {type: int}\n", 3, "no parameter 'a' before it"),
        ("ns:\n  a: {type: string_array}\n  __map_a: {b: {__map_a: {p: {type: int}}}}\n", 3, "a struct between maps"),
        ("ns:\n\tp: 1", 2, "not valid YAML"),
        ("ns: a: b", 1, "not valid YAML"),
        ("ns: *gone", 1, "define &gone before it"),
        ("ns: &a [*a]", 1, "define &a before it"),
        ("ns: {? [1] : 2}", 1, "is the key of a map"),
        ("ns:\n  p: !!int {}\n", 2, "p is empty"),
        ("ns:\n  p: {type: int, default_value: !!int x}\n", 2, "is not of its type"),
        ("ns:\n  p: {type: int, default_value: !!int ''}\n", 2, "is not of its type"),
        ("ns:\n  p: {type: int, default_value: !!bool x}\n", 2, "is not of its type"),
        ("ns: \ud800", 1, "control character"),
        ("ns: " + "1" * 101, 1, "a number that is too long"),
        ("ns: " + "[" * 60 + "]" * 60, 1, "nested deeper than 50 levels"),
        ("ns: " + "{a: " * 5_000, 1, "nested deeper than 50 levels"),
        ("ns: \x07", 1, "control character"),
        ("ns: [" + "1, " * 20_001 + "]", 1, "more than 20000 values"),
        ("a: &a [1]\nb: [" + "*a, " * 1_001 + "]", 2, "more than 1000 aliases"),
        ("a: &a [" + "1, " * 200 + "]\nb: &b [" + "*a, " * 50 + "]\nc: [" + "*b, " * 50 + "]", 3, "aliases counted"),
        ("#" + "x" * 1_000_001, 1, "more than 1000000 characters"),
    ],
)
@pytest.mark.parametrize("language", ["cpp", "python"])
def test_faults_are_problems(text: str, line: int, words: str, language: str) -> None:
    program = read_parameter_library("x.yaml", text, language)
    assert [(where, words in message) for where, message in program.problems] == [(line, True)]


def test_what_is_left_out_without_a_fault() -> None:
    text = "ns:\n  p: {type: int}\n  note: text\n  gone: {type: none}\n  list: [1]\n"
    program = read_parameter_library("x.yaml", text)
    assert program.problems == ()
    assert [text.partition(" =")[0] for _, _, text in declared(program)] == ["this.params_.p"]


def test_a_default_of_another_type_is_not_known() -> None:
    program = read_parameter_library("x.yaml", "ns:\n  p: {type: int, default_value: x}\n")
    assert found(body(program, "ns::ParamListener::declare_params"), "?") == [
        ("?", "a default of another type than the parameter's")
    ]


def test_aliases_and_merges_are_read_at_their_keys() -> None:
    text = "ns:\n  a: &a {type: int, default_value: 4}\n  b: *a\n  c:\n    <<: *a\n    default_value: 5\n"
    program = read_parameter_library("x.yaml", text)
    assert [(line, text.rpartition("+ ")[2]) for line, _, text in declared(program)] == [
        (2, "'a', 4, descriptor)"),
        (3, "'b', 4, descriptor)"),
        (4, "'c', 5, descriptor)"),
    ]


def test_whether_something_was_set_is_not_known() -> None:
    program = read_parameter_library("x.yaml", "ns:\n  p: {type: int}\n")
    for name in ("is_old", "try_get_params", "try_update_params"):
        assert found(body(program, f"ns::ParamListener::{name}"), "?") == [("?", "whether a parameter was set since")]


def test_a_namespace_in_a_namespace_is_cpp_alone() -> None:
    text = "a::b:\n  p: {type: int}\n"
    assert read_parameter_library("x.yaml", text).classes[0].name == "a::b::Params"
    assert read_parameter_library("x.yaml", text, "python").problems == (
        (1, "the namespace 'a::b' is no name of Python"),
    )
