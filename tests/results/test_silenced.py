# SPDX-License-Identifier: Apache-2.0
"""Comments that silence tools: which are known, and which of them a change adds."""

from __future__ import annotations

import pytest

from haros_ci.model.location import Location
from haros_ci.results.directives import _NATIVE
from haros_ci.results.result import BaselineState, Result, Run, Silenced, Suppression, Tool
from haros_ci.results.rule import Level
from haros_ci.results.silence_words import counted, sentences
from haros_ci.results.silenced import SilencedPair, added_comments
from haros_ci.results.silencers import FORMS, silencers

FIRES = [
    ("c", "int a; // NOLINT\n", "NOLINT"),
    ("c", "int a; /* NOLINT(build/include) */\n", "NOLINT"),
    ("c", "// NOLINTNEXTLINE(a-b)\nint a;\n", "NOLINTNEXTLINE"),
    ("c", "// NOLINTBEGIN\nint a;\n// NOLINTEND\n", "NOLINTBEGIN"),
    ("c", "// LINT_C_FILE\n", "LINT_C_FILE"),
    ("c", "// cppcheck-suppress nullPointer\n*p = 1;\n", "cppcheck-suppress"),
    ("c", "/* cppcheck-suppress-begin [a, b] */\n", "cppcheck-suppress"),
    ("c", "// cppcheck-suppress-file unusedFunction\n", "cppcheck-suppress"),
    ("c", "// cppcheck-sup\\\npress nullPointer\n*p = 1;\n", "cppcheck-suppress"),
    ("c", "/* \\\ncppcheck-suppress nullPointer */\n*p = 1;\n", "cppcheck-suppress"),
    ("c", "// clang-format off\n", "clang-format off"),
    ("c", "strcpy(a, b); // Flawfinder: ignore\n", "Flawfinder: ignore"),
    ("c", "int f() { // #lizard forgives\n", "#lizard forgives"),
    ("c", "// GENERATED CODE\n", "GENERATED CODE"),
    ("python", "# yapf: disable\n", "yapf: disable"),
    ("python", "import a  # noqa\n", "noqa"),
    ("python", "import a  # NOQA:F401,E501\n", "noqa"),
    ("python", "import a  # see below # noqa: F401\n", "noqa"),
    ("python", "import a  # NoQa\n", "noqa"),
    ("python", "import a  # noqaX\n", "noqa"),
    ("python", "a = eval(b)  # nosection\n", "nosec"),
    ("python", "a = 1  # see below, pylint: disable=invalid-name\n", "pylint: disable"),
    ("c", "// vim: set filetype=c :\n", "LINT_C_FILE"),
    ("python", "# flake8: noqa\n", "flake8: noqa"),
    ("python", "# flake8: noqa: E501\n", "flake8: noqa"),
    ("python", "# ruff: noqa: F401\n", "ruff: noqa"),
    ("python", "# pylint: disable=all\n", "pylint: disable"),
    ("python", "a = 1  # pylint:disable=invalid-name,x\n", "pylint: disable"),
    ("python", "# pylint: disable-next=x\n", "pylint: disable"),
    ("python", "# pylint: skip-file\n", "pylint: disable"),
    ("python", "a = b()  # type: ignore\n", "type: ignore"),
    ("python", "a = b()  # type: ignore[attr-defined]\n", "type: ignore"),
    ("python", "#!/usr/bin/env python3\n# type: ignore\nimport a\n", "type: ignore"),
    ("python", "# mypy: ignore-errors\n", "mypy:"),
    ("python", "eval(a)  # nosec B307\n", "nosec"),
    ("python", "# fmt: off\n", "fmt: off"),
    ("python", "a = [  1]  # fmt: skip\n", "fmt: off"),
    ("python", "import a  # isort: skip\n", "isort: skip"),
    ("python", "# isort: skip_file\n", "isort: skip"),
    ("python", "# isort:off\n", "isort: skip"),
    ("shell", "# shellcheck disable=SC2086\necho $a\n", "shellcheck disable"),
    ("dockerfile", "# hadolint ignore=DL3006\nFROM a\n", "hadolint ignore"),
    ("dockerfile", "# hadolint global ignore=DL3006\nFROM a\n", "hadolint ignore"),
    ("yaml", "# yamllint disable\na: 1\n", "yamllint disable"),
    ("yaml", "a:  1  # yamllint disable-line rule:colons\n", "yamllint disable"),
    ("cmake", "project(a)\n#catkin_lint: ignore_once missing_directory\n", "catkin_lint"),
    ("xml", "<package><!-- catkin_lint: ignore missing_depend --></package>\n", "catkin_lint"),
    ("cmake", "# lint_cmake: -linelength\n", "lint_cmake"),
    ("cmake", "# cmake-lint: disable=C0103\n", "cmake-lint: disable"),
    ("cmake", "# cmake-format: off\n", "cmake-format: off"),
    ("c", "int teh; // codespell:ignore teh\n", "codespell:ignore"),
    ("yaml", "a: teh # codespell:ignore\n", "codespell:ignore"),
]

QUIET = [
    ("c", 'auto a = "// NOLINT";\n'),
    ("c", 'auto a = R"(// NOLINT\n)";\n'),
    ("c", "int NOLINT = 1;\n"),
    ("c", "// NOLINT is for tools\nint a;\n"),
    ("c", "int a; // NOLINTS\n"),
    ("c", "int a; // NOLINTEND\n"),
    ("c", "// we do not use cppcheck-suppress here\n"),
    ("c", "// clang-format on\n"),
    ("c", "// see the manual of clang-format: clang-format off\n"),
    ("c", "int a; // noqa\n"),
    ("python", 'a = "# noqa"\n'),
    ("python", '"""Use # noqa to silence; # pylint: disable=x, # type: ignore."""\n'),
    ("python", "a = '''\n# flake8: noqa\n'''\n"),
    ("python", "# noqa\na = 1\n"),
    ("python", "a = 1  # no qa\n"),
    ("c", "// vim: set filetype=cpp :\n"),
    ("python", "a = 1  # the noqa comment\n"),
    ("python", "# see the docs of flake8: noqa silences\n"),
    ("python", "# pylint: enable=x\n"),
    ("python", "# pylint is slow\n"),
    ("python", "a = 1  # type: int\n"),
    ("python", "a = 1\n# type: ignore\n"),
    ("python", "# fmt: on\n"),
    ("python", "# isort: on\n"),
    ("python", "# mypy is slow\n"),
    ("shell", "# shellcheck source=lib.sh\n. lib.sh\n"),
    ("shell", "echo '# shellcheck disable=SC2086'\n"),
    ("shell", "# shellcheck finds this\n"),
    ("yaml", "# yamllint enable\n"),
    ("yaml", 'a: "# yamllint disable"\n'),
    ("cmake", 'message("#catkin_lint: ignore x")\n'),
    ("cmake", "# lint_cmake: +linelength\n"),
    ("cmake", "# cmake-format: on\n"),
    ("xml", "<a>catkin_lint: ignore x</a>\n"),
    ("", "# noqa # NOLINT\n"),
]


@pytest.mark.parametrize(("kind", "text", "name"), FIRES)
def test_a_comment_that_silences(kind: str, text: str, name: str) -> None:
    assert [found.form.name for found in silencers(text, kind)] == [name]


@pytest.mark.parametrize(("kind", "text"), QUIET)
def test_what_silences_nothing(kind: str, text: str) -> None:
    assert list(silencers(text, kind)) == []


def test_every_form_is_tried() -> None:
    untried = {form.name for form in FORMS} - {name for _, _, name in FIRES}
    assert untried == set()
    assert {mark for mark, _ in _NATIVE.values()} <= {form.name for form in FORMS}, "those that metrics obey"


# -- what a change adds -------------------------------------------------------------------------------------------

CODE = "import os\nimport sys\n\n\ndef f(a):\n    return eval(a)\n"
QUIETED = "import os  # noqa\nimport sys\n\n\ndef f(a):\n    return eval(a)  # pylint: disable=eval-used\n"


def added(
    head: str,
    base: str | None,
    *,
    path: str = "a.py",
    gone: tuple[str, ...] = (),
    others: tuple[SilencedPair, ...] = (),
) -> list[str]:
    pairs = [SilencedPair(path, "python", head, base), *others]
    found = added_comments(pairs, [(f"gone{n}.py", "python", text) for n, text in enumerate(gone)]).silenced(())
    return [f"{place}:{name}" for place, name in found.comments]


@pytest.mark.parametrize(
    ("head", "base", "expected"),
    [
        (QUIETED, CODE, ["a.py:1:noqa", "a.py:6:pylint: disable"]),
        (QUIETED, None, ["a.py:1:noqa", "a.py:6:pylint: disable"]),
        (QUIETED.replace("# noqa", "# noqa: F401"), QUIETED, []),
        (QUIETED.replace("eval-used", "all"), QUIETED, ["a.py:6:pylint: disable"]),
        (QUIETED + "import x  # noqa\n", QUIETED, ["a.py:7:noqa"]),
        (CODE.replace("eval(a)", "exec(a)  # noqa"), "import os  # noqa\n" + CODE, ["a.py:6:noqa"]),
        ("# pylint: disable=all\n" + CODE, CODE, ["a.py:1:pylint: disable"]),
        (
            "def f(a):\n    return b\n\n\ndef g():\n    return b  # noqa\n",
            "def f(a):\n    return b  # noqa\n",
            ["a.py:6:noqa"],
        ),
        (
            "def f(a):\n    return  b\n\n\ndef g():\n    # pylint: disable=x\n    return b\n",
            "def f(a):\n    # pylint: disable=x\n    return b\n",
            ["a.py:6:pylint: disable"],
        ),
        ("import q  # noqa\nimport q  # noqa\n", "import q  # noqa\n", ["a.py:2:noqa"]),
        ("# Generated by a tool. DO NOT EDIT.\nimport q  # noqa\n", "import q\n", ["a.py:2:noqa"]),
        ("# Generated by a tool. DO NOT EDIT.\nimport q  # noqa\n", None, ["a.py:2:noqa"]),
    ],
)
def test_what_is_added(head: str, base: str | None, expected: list[str]) -> None:
    if "F401" in head:
        expected = ["a.py:1:noqa"]  # it names other rules now
    assert added(head, base) == expected


@pytest.mark.parametrize(
    ("head", "base", "gone"),
    [
        (QUIETED, QUIETED, ()),
        (CODE, QUIETED, ()),
        ("x = 1\n\n" + QUIETED, QUIETED, ()),
        (QUIETED.replace("    return", "        return"), QUIETED, ()),
        (QUIETED.replace("  # ", " #  "), QUIETED, ()),
        (QUIETED.replace("eval(a)", "eval(a, {})"), QUIETED, ()),
        ("\n".join(reversed(QUIETED.splitlines())), QUIETED, ()),
        (QUIETED.replace("\n", "\r\n"), QUIETED, ()),
        (QUIETED, None, (QUIETED,)),
        ("def f(a):\n    return eval(a)  # pylint: disable=eval-used\n", None, (CODE, QUIETED)),
        ("# Generated. Do not edit.\nimport q  # noqa\n", "# Generated. Do not edit.\nimport p\n", ()),
        (CODE, None, ()),
        ("def g():\n    return 1\n\n\ndef f(a):\n    return b  # noqa\n", "def f(a):\n    return b  # noqa\n", ()),
        (
            "def g(a):\n    c = a\n    return b  # noqa\n\n\ndef f(a):\n    return g(a)\n",
            "def f(a):\n    c = a\n    return b  # noqa\n",
            (),
        ),
        ("# pylint: disable=x\nf(a)\n", "f(a)  # pylint: disable=x\n", ()),
        ("f(a)  # pylint: disable=x\n", "# pylint: disable=x\nf(a)\n", ()),
        ("# pylint: disable=x\n\nimport a\nf(a)\n", "# pylint: disable=x\nimport a\nf(a)\n", ()),
    ],
)
def test_what_was_there(head: str, base: str | None, gone: tuple[str, ...]) -> None:
    assert added(head, base, gone=gone) == []


def test_a_comment_that_moves_to_another_changed_file() -> None:
    other = SilencedPair("b.py", "python", QUIETED, CODE)
    both = ["b.py:1:noqa", "b.py:6:pylint: disable"]
    assert added(CODE, QUIETED, others=(other,)) == both, "the code that they stood beside is still there, without them"
    assert added(CODE.replace("eval(a)", "0").replace("import os\n", ""), QUIETED, others=(other,)) == []
    copy = SilencedPair("b.py", "python", QUIETED, CODE)
    assert added(QUIETED, QUIETED, others=(copy,)) == both


def test_prose_is_not_looked_at() -> None:
    text = "<!-- NOLINT codespell:ignore -->\n"
    assert not added_comments([SilencedPair("a.md", "markdown", text, "")], ()).silenced(())


def result(line: int, *suppressions: Suppression, state: BaselineState | None = BaselineState.NEW) -> Result:
    return Result("t", "r", Level.WARNING, "m", Location("a.py", line), suppressions=suppressions, state=state)


def comment(line: int, column: int) -> Suppression:
    return Suppression("inSource", "", Location("a.py", line, column))


def test_findings_that_are_suppressed_by_the_change() -> None:
    base = "a = 1  # haros: ignore[r] old\nb = 2\n"
    head = "z = 0\na = 1  # haros: ignore[r] old\nb = 2  # haros: ignore[r] new\n"
    exception = Suppression("external", "", source="x:1")
    results = (
        result(2, comment(2, 8)),
        result(3, comment(3, 8)),
        result(3, comment(3, 8)),
        result(3, comment(3, 8), exception),
        result(3, comment(3, 8), comment(2, 8)),
        result(3),
    )
    found = added_comments([SilencedPair("a.py", "python", head, base)], ()).silenced([Run(Tool("t"), results=results)])
    assert found == Silenced(findings=2)
    assert not added_comments([SilencedPair("a.py", "python", head, head)], ()).silenced(
        [Run(Tool("t"), results=results)]
    )


def test_a_comment_that_comes_to_silence_other_code_is_new() -> None:
    base = "a = 1  # haros: ignore[r] x\nb = 2\nc = 3\nd = 4\n"
    head = "a = 1\nb = 2\nc = 3\nd = 4  # haros: ignore[r] x\n"
    runs = [Run(Tool("t"), results=(result(4, comment(4, 8)),))]
    assert added_comments([SilencedPair("a.py", "python", head, base)], ()).silenced(runs).findings == 1


def test_words() -> None:
    one = Silenced(1, ((Location("a.py", 3), "noqa"),))
    assert list(sentences(one)) == [
        "1 finding suppressed by comments that this change adds",
        "the change adds 1 comment that silences linters: a.py:3 (noqa)",
    ]
    many = Silenced(2, tuple((Location("a.py", n), "noqa") for n in range(1, 8)))
    assert list(sentences(many))[1].endswith("a.py:5 (noqa) and 2 more")
    assert counted(many) == "2 findings suppressed by this change; 7 comments that silence linters added by this change"
    assert (list(sentences(Silenced())), counted(Silenced())) == ([], "")


BEGIN, END = "// cppcheck-suppress-begin a\n", "// cppcheck-suppress-end a\n"
MACRO = "// cppcheck-suppress-macro a\n#define X 1\n"


@pytest.mark.parametrize(
    ("base", "head", "lines"),
    [
        (BEGIN + "f();\n" + END, BEGIN + "f();\ng();\n" + END, [1]),
        (BEGIN + "f();\n" + END + "g();\n", BEGIN + "f();\ng();\n" + END, [1]),
        (BEGIN + "f();\n" + END + "g();\n", BEGIN + "f();\ng();\n", [1]),
        ("// NOLINTBEGIN\nf();\n// NOLINTEND\n", "\n// NOLINTBEGIN\nf();\nf();\n// NOLINTEND\n", [2]),
        (MACRO, MACRO.replace("1", "2"), [1]),
        (MACRO, MACRO.replace("1", "\\\n  2"), [1]),
        (BEGIN + "f();\n" + END, BEGIN + "f();\n" + END, []),
        (BEGIN + "f();\n" + END, "int a;\n" + BEGIN + "  f();  // why\n" + END + "g();\n", []),
        (BEGIN + "f();\ng();\n" + END, BEGIN + "f();\n" + END, []),
        (BEGIN + "f();\n" + END, BEGIN + "{\n\n  f();\n}\n// more\n" + END, []),
        (BEGIN + "f();\n" + END, BEGIN + "f();\n" + END + BEGIN.replace("a", "b") + "g();\n", []),
        (MACRO, MACRO + "int a;\n", []),
        ("// cppcheck-suppress a\nf();\n", "// cppcheck-suppress a\nf();\ng();\n", []),
        ("f();\n", "f();\ng();\n", []),
    ],
)
def test_comments_for_a_block_that_grows(base: str, head: str, lines: list[int]) -> None:
    found = added_comments([SilencedPair("a.cpp", "cpp", head, base)], ()).silenced(())
    assert [place.line for place, _ in found.more] == lines


SUPPRESS = "// cppcheck-suppress nullPointer\n"


@pytest.mark.parametrize(
    ("path", "base", "head", "lines"),
    [
        ("a.cpp", SUPPRESS + "*p = 1;\n", SUPPRESS + "*q = one(p);\n", [1]),
        ("a.cpp", "*p = 1;  // NOLINT\n", "int a;\n*p = 2;  // NOLINT\n", [2]),
        ("a.cpp", "// NOLINTNEXTLINE(bugprone-x)\n*p = 1;\n", "// NOLINTNEXTLINE(bugprone-x)\n*p = 2;\n", [1]),
        ("a.py", "print(a)  # noqa: F821\n", "print(a, b)  # noqa: F821\n", [1]),
        ("a.py", "print(a)  # noqa\n", "print(a, b)  # noqa\n", [1]),
        (
            "a.cpp",
            "// cppcheck-suppress-file nullPointer\nf();\n",
            "// cppcheck-suppress-file nullPointer\nf();\ng();\n",
            [1],
        ),
        ("a.py", "# flake8: noqa\nf()\n", "# flake8: noqa\nf()\ng()\n", [1]),
        ("a.cpp", SUPPRESS + "*p = 1;\n", "int a;\n" + SUPPRESS + "  *p  = 1;\nint b;\n", []),
        ("a.cpp", "*p = 1;  // NOLINT(build/include_order)\n", "*p = 2;  // NOLINT(build/include_order)\n", []),
        ("a.py", "print(a)  # noqa: E501\n", "print(a, b)  # noqa: E501\n", []),
        ("a.py", "print(a)  # noqa: E501,W291\n", "print(a, b)  # noqa: E501,W291\n", []),
        (
            "a.cpp",
            "// cppcheck-suppress-file nullPointer\nf();\n",
            "// cppcheck-suppress-file nullPointer\nf( );\n// why\n",
            [],
        ),
        ("a.py", "# flake8: noqa\nf()\n", "# flake8: noqa\nf()\n# more\n", []),
        ("a.py", "a = 1  # noqa: F841\nb = 2\n", "a = 1  # noqa: F841\nb = 3\n", []),
        ("a.py", "a = 1  # pylint: disable=x\n", "a = 2  # pylint: disable=x\n", []),
    ],
)
def test_old_comments_over_code_that_changes(path: str, base: str, head: str, lines: list[int]) -> None:
    language = "cpp" if path.endswith("cpp") else "python"
    found = added_comments([SilencedPair(path, language, head, base)], ()).silenced(())
    assert [place.line for place, _ in found.more] == lines and found.comments == ()


def test_more_is_put_in_words() -> None:
    silence = Silenced(more=((Location("a.py", 4), "undefined-variable"),))
    assert list(sentences(silence)) == ["comments silence more than they did in 1 place: a.py:4 (undefined-variable)"]
    assert counted(silence) == "1 more silenced by comments" and bool(silence)
