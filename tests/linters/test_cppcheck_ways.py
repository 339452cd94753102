# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck on ways that nobody takes, and those that stand."""

from __future__ import annotations

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted

LEAK = "Resource leak: file"


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("  return chain.joint(0);", True),
        ("  auto twist = twistOf(i); // may throw", True),
        ('  log("no throw");', True),
        ("  throw std::out_of_range(name);", False),
        ("  if (i > size_) { throw Error(); }", False),
        ("    throw;", False),
    ],
)
def test_a_check_that_fails_elsewhere(line: str, expected: bool) -> None:
    assert (
        is_refuted("throwInNoexceptFunction", "Exception thrown in function declared not to throw.", 1, line)
        is expected
    )


@pytest.mark.parametrize(
    "condition",
    [
        "file <= 0",
        "file == NULL",
        "file==nullptr",
        "!file",
        "NULL == file",
        "0 >= file",
        'file < 0 && path != ""',
        "(file = open(path)) == NULL",
        "!(file = open(path))",
        "file == INVALID_HANDLE_VALUE",
    ],
)
@pytest.mark.parametrize(
    "branch", ["if ({}) {{\n  log(path);\n  return 1;", "if ({})\n{{\n  log();\n  return 1;", "if ({})\n  return 1;"]
)
def test_a_handle_that_is_not_open(condition: str, branch: str) -> None:
    text = "FILE * file = open(path);\n" + branch.format(condition)
    assert is_refuted("resourceLeak", LEAK, text.count("\n") + 1, text)


@pytest.mark.parametrize(
    "text",
    [
        "if (file != NULL) {\n  return 1;",
        "if (file) {\n  return 1;",
        "if (file == NULL || size == 0) {\n  return 1;",
        "if (other == NULL) {\n  return 1;",
        "if (!file->ok) {\n  return 1;",
        "if (!ok(file)) {\n  return 1;",
        "if (file == 0x3) {\n  return 1;",
        "if (file == NULL) {\n  log();\n}\nreturn 1;",
        "if (file == NULL) {\n  log();\n} else {\n  return 1;",
        "while (file == NULL) {\n  return 1;",
        "if (size > 0) { // !file\n  return 1;",
        "return 1;",
        "",
    ],
)
def test_a_handle_that_may_be_open(text: str) -> None:
    assert not is_refuted("resourceLeak", LEAK, text.count("\n") + 1, text)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("val > MAX_VALUE? val = MAX_VALUE : val;", True),
        ("if (MAX_VALUE < val)", True),
        ("if (val > limits::MAX_VALUE) {", True),
        ("if (val > 255) {", False),
        ("if (val > 255 && MAX_VALUE > 3) {", False),
        ("if (val > limit) {", False),
        ("if (val > 0xFF) { // MAX_VALUE", False),
        ("", False),
    ],
)
def test_a_limit_that_has_a_name(line: str, expected: bool) -> None:
    message = "Comparing expression of type 'unsigned char' against value 255. Condition is always false."
    assert is_refuted("compareValueOutOfTypeRangeError", message, 1, line) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("switch (i) {\n  case 3:\n    ball_ = ball_;\n    break;", True),
        ("switch (i) {\n  case 1: ball_ = other; break;\n  case kOwn: ball_ = ball_; break;", True),
        ("switch (i) {\n  default:\n    ball_ = ball_;\n    break;", True),
        ("switch (i) {\n  case 3:\n    ball_ = ball_;\n    other();\n    break;", False),
        ("if (i == 3) {\n    ball_ = ball_;\n    break;", False),
        ("if (i == 3)\n{\n    ball_ = ball_;\n}\nelse\n{\n    ball_ = other;\n}", True),
        ("if (i == 3) {\n    ball_ = ball_;\n} else\n    ball_ += other;\n", True),
        ("if (i == 3) {\n    ball_ = ball_;\n} else {\n    other = ball_;\n}", False),
        ("if (i == 3) {\n    walk();\n    ball_ = ball_;\n} else {\n    ball_ = other;\n}", False),
        ("int a;\nint ball_ = qh ball_;\n// ball_ = ball_", True),
        ("ball_ = ball_;", False),
    ],
)
def test_a_case_that_changes_nothing(text: str, expected: bool) -> None:
    line = next(number for number, item in enumerate(text.split("\n"), 1) if " ball_;" in item)
    assert is_refuted("selfAssignment", "Redundant assignment of 'ball_' to itself.", line, text) is expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("m.block(0, 0, 1, 4) << 1.0f,\n    0.0f, 0.33f, 0.0f;", True),
        ("a = b;\nm << 1,\n  2,\n  3;", True),
        ("m << 1;\na, b;", False),
        ("// m << 1,\na, b;", False),
        ("a,\nb;", False),
    ],
)
def test_values_of_a_matrix_over_several_lines(text: str, expected: bool) -> None:
    message = "Found suspicious operator ',', result is not used."
    assert is_refuted("constStatement", message, text.count("\n") + 1, text) is expected
    assert not is_refuted(
        "constStatement", "Found suspicious operator '+', result is not used.", text.count("\n") + 1, text
    )


DIVIDED = "Either the condition '{}' is redundant or there is division by zero at line 3."


@pytest.mark.parametrize(
    ("condition", "text", "expected"),
    [
        ("step>0", "if(step > 0)\n  return a / step;\nreturn b / step;", True),
        ("step<0", "if (step < 0) {\n  return a % step; }\nreturn b / step;", True),
        ("s.step>=0.0", "if (s.step >= 0.0)\n  n = a / s.step; else\n  n = b / s.step;", True),
        ("step>0", "if (step > 0)\n  return a;\nreturn b / step;", False),
        ("step>0", "n = a / step;\nif (step > 0)\n  return b / step;", False),
        ("step!=0", "if (step != 0)\n  return a / step;\nreturn b / step;", False),
        ("step==0", "if (step == 0)\n  return a / step;\nreturn b / step;", False),
        ("step>0", "if (step > 0)  // a / step\n  return a;\nreturn b / step;", False),
        ("step>0", "if (step > 0)\n  return a / step.size();\nreturn b / step;", False),
        ("step>0", "if (other > 0)\n  return a / step;\nreturn b / step;", False),
        ("step>0", "", False),
    ],
)
def test_a_divisor_of_which_the_sign_is_asked(condition: str, text: str, expected: bool) -> None:
    line = 1 if text.startswith("n = ") else 3
    assert is_refuted("zerodivcond", DIVIDED.format(condition), line, text) is expected
