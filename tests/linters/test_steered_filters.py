# SPDX-License-Identifier: Apache-2.0
"""Filters of findings look at code: a comment or text that reads as their evidence, or code of another form, leaves the finding as it is."""

from __future__ import annotations

import pytest

from haros_ci.linters import cppcheck_doubts, pylint_doubts
from haros_ci.linters.decorated import decorators
from haros_ci.linters.duplicates import drop_unfounded
from haros_ci.linters.python_defaults import is_only_read
from haros_ci.model.location import Location
from haros_ci.results.result import Result
from haros_ci.results.rule import Level

THROW = "Unhandled exception thrown in function declared 'noexcept'."
LEAK = "Resource leak: file"
FORMAT = "%d in format string (no. 1) requires 'int' but the argument type is 'double'."
ADDRESS = "Address of local auto-variable assigned to a function parameter."
INNER = "Opposite inner 'if' condition leads to a dead code block."
OBJECTS = "Comparing pointers that point to different objects"
TEMPORARY = "Using pointer to temporary."
REFERENCE = "Using reference to dangling temporary."
KEPT = "Non-local variable 'saved' will use pointer to local variable 'local'."
RETURN = "Found an exit path from function with non-void return type that has missing return statement"
SWITCH = "enum class Mode { Off, Slow = 3, Fast };\nint f(Mode mode)\n{\n  switch (mode) {\n    case Mode::Off: return 0;\n    case Mode::Slow: return 1;\n"
LEAKING = "FILE * file = fopen(name, mode);\nif (%s) {\n  return 1;\n"
TEXTS = "const char * texts[2];\ntexts[0] = (name + 'a').c_str();\nputs(texts[0]);"
MADE = "const int & made = %s;\nreturn made + 1;"
KEEP = "void keep()\n{\n  int local = 1;\n  saved = same(&local);"


@pytest.mark.parametrize(
    ("rule", "message", "text"),
    [
        ("throwInNoexceptFunction", THROW, "#define FAIL throw 1\nvoid stop() noexcept\n{\n  FAIL;"),
        ("throwInNoexceptFunction", THROW, "#define FAIL(x) do { \\\n  throw x; } while (0)\nFAIL(1);"),
        ("autoVariables", ADDRESS, "// better a std::array<int, 3> cells;\nint cells[3];\n*out = cells;"),
        ("autoVariables", ADDRESS, 'puts("std::array<int, 3> cells;");\nint cells[3];\n*out = cells;'),
        ("invalidPrintfArgType_sint", FORMAT, '// it is using double = eight bytes\nprintf("%d", value);'),
        ("invalidPrintfArgType_sint", FORMAT, 'puts("typedef x double;");\nprintf("%d", value);'),
        ("oppositeInnerCondition", INNER, "if (a < 3) {  // not 18446744073709551615"),
        ("comparePointers", OBJECTS, "extern int one;\nint one[2];\nreturn &one[0] < &two[1];"),
        ("comparePointers", OBJECTS, "/*\nextern int one[];\n*/\nreturn &one[0] < &two[1];"),
        ("danglingTemporaryLifetime", TEMPORARY, f"// like vector<string> texts\n{TEXTS}"),
        ("danglingTempReference", REFERENCE, MADE % "same((box)->value + 1)"),
        ("danglingTempReference", REFERENCE, MADE % "same(made()[0]->value)"),
        ("danglingTempReference", REFERENCE, MADE % "(box)->value + 1"),
        ("danglingLifetime", KEPT, "int * same(int * p)\n{\n  return p;\n}\n" + KEEP),
        ("resourceLeak", LEAK, LEAKING % "(file == nullptr) == false"),
        ("resourceLeak", LEAK, LEAKING % "!(!file) && name[0] == 0"),
        ("resourceLeak", LEAK, LEAKING % "!(file == nullptr)"),
        ("resourceLeak", LEAK, LEAKING % "(file == nullptr) != true"),
        ("missingReturn", RETURN, SWITCH),
    ],
)
def test_of_cppcheck_it_stays(rule: str, message: str, text: str) -> None:
    line = 4 if rule == "missingReturn" else text.count("\n") + 1
    assert not cppcheck_doubts.is_refuted(rule, message, line, f"{text}\n  }}\n}}\n")


@pytest.mark.parametrize(
    ("rule", "message", "text"),
    [
        ("throwInNoexceptFunction", THROW, "#define FAIL throw 1\nvoid stop() noexcept\n{\n  halt();"),
        ("throwInNoexceptFunction", THROW, "#define LOG(x) write(x)\n#define FAIL throw 1\n  LOG(1);"),
        ("autoVariables", ADDRESS, "std::array<int, 3> cells;\n*out = cells;"),
        ("invalidPrintfArgType_sint", FORMAT, 'using double = other;\nprintf("%d", value);'),
        ("comparePointers", OBJECTS, "extern int one[];\nreturn &one[0] < &two[1];"),
        ("comparePointers", OBJECTS, "extern char _end[];\nint count;\nreturn &_end[0] < &two[1];"),
        ("danglingTemporaryLifetime", TEMPORARY, "vector<string> texts;\n" + TEXTS.partition("\n")[2]),
        ("danglingTempReference", REFERENCE, MADE % "found()[0]->value"),
        ("danglingTempReference", REFERENCE, MADE % "all[at(1)]->part.value[2]"),
        ("danglingTempReference", REFERENCE, MADE % "(*box)->value(1)"),
        ("danglingLifetime", KEPT, "int * same(int * p);\n" + KEEP),
        ("danglingLifetime", KEPT, KEEP),
        ("resourceLeak", LEAK, LEAKING % "file == nullptr"),
        ("resourceLeak", LEAK, LEAKING % "!file"),
        ("resourceLeak", LEAK, LEAKING % "!(file)"),
        ("resourceLeak", LEAK, LEAKING % "(file = fopen(name)) == NULL"),
        ("resourceLeak", LEAK, LEAKING % "NULL == file && verbose"),
        ("missingReturn", RETURN, SWITCH + "    case Mode::Fast: return 2;\n"),
        ("missingReturn", RETURN, SWITCH.partition("\n")[2].replace("int f", "\nint f")),
        ("missingReturn", RETURN, SWITCH.replace("class Mode", "class Other")),
    ],
)
def test_of_cppcheck_it_is_refuted(rule: str, message: str, text: str) -> None:
    line = 4 if rule == "missingReturn" else text.count("\n") + 1
    assert cppcheck_doubts.is_refuted(rule, message, line, f"{text}\n  }}\n}}\n")


PART = "def part(one):\n    return one\n\n\n"
CALL = "def part():\n    call = None\n    call()\n"
ROWS = "import numpy\nROWS = [1, 2]\nprint(ROWS['a'], ROWS[numpy.argmin(ROWS)])\n"


@pytest.mark.parametrize(
    ("rule", "text", "at"),
    [
        ("too-many-function-args", f"{PART}print(part(1, 2))  # like x.reshape(1, 2)\n", "part(1"),
        (
            "no-value-for-parameter",
            f'"""Use it so::\n\n    @wrap\n    def part(one):\n"""\n{PART}print(part())\n',
            "part())",
        ),
        ("not-callable", f"{CALL}    if call:\n        print(call)\n", "call()"),
        (
            "not-callable",
            CALL.replace("call = N", '"""Whether\n    call is None at first\n    """\n    call = N'),
            "call()",
        ),
        ("invalid-sequence-index", ROWS, "ROWS['a']"),
        ("pointless-statement", "one == 2  # keep it at two\n", "one"),
        ("condition-evals-to-constant", "if a == 'x or True':\n    pass\n", "a =="),
        (
            "possibly-used-before-assignment",
            "def f():\n    part\n'''\nif __name__ == '__main__':\n    part = 1\n'''\n",
            "part\n'",
        ),
    ],
)
def test_of_pylint_it_stays(rule: str, text: str, at: str) -> None:
    before = text[: text.index(at)]
    assert not pylint_doubts.is_refuted(rule, before.count("\n") + 1, len(before) - before.rfind("\n") - 1, text)


@pytest.mark.parametrize(
    ("rule", "text", "at"),
    [
        ("too-many-function-args", f"{PART}print(part.reshape(1, 2))  # as it is\n", "part.re"),
        ("no-value-for-parameter", f"@wrap\n{PART}print(part())\n", "part())"),
        ("not-callable", CALL.replace("    call()", "    if call:\n        call()"), "call()"),
        ("not-callable", CALL.replace("    call()", "    call and call()"), "call()"),
        ("invalid-sequence-index", ROWS, "ROWS[numpy"),
        ("pointless-statement", "self.part  # keep a reference\n", "self"),
        (
            "possibly-used-before-assignment",
            "def f():\n    part\nif __name__ == '__main__':\n    part = 1\n",
            "part\ni",
        ),
    ],
)
def test_of_pylint_it_is_refuted(rule: str, text: str, at: str) -> None:
    before = text[: text.index(at)]
    assert pylint_doubts.is_refuted(rule, before.count("\n") + 1, len(before) - before.rfind("\n") - 1, text)


@pytest.mark.parametrize("change", ["heapq.heappush(one, 1)", "operator.iadd(one, [1])", "random.shuffle(one)"])
def test_a_default_that_the_standard_library_changes(change: str) -> None:
    assert not is_only_read(f"def part(one=[]):\n    {change}\n", 1)
    assert is_only_read("def part(one=[]):\n    total(one)\n    sorted(one)\n", 1)


@pytest.mark.parametrize(
    ("text", "is_kept"),
    [
        ("from numpy import *\npart\n", False),
        ("from numpy import (*)\npart\n", False),
        ('"""\nfrom numpy import *\n"""\npart\n', True),
        ("# from numpy import *\npart\n", True),
        ("from numpy import array\npart\n", True),
    ],
)
def test_a_wildcard_import(text: str, is_kept: bool) -> None:
    said = Result("pylint", "undefined-variable", Level.ERROR, "Undefined variable 'part'", Location("a.py", 2))
    assert bool(drop_unfounded([said], lambda path: text)) is is_kept


def test_decorators_in_texts() -> None:
    assert decorators('"""\n@wrap\ndef part(one):\n"""\n', "part") == []
    assert decorators("@wrap\ndef part(one):\n", "part") == [["wrap"]]
