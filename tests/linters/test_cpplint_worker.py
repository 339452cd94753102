# SPDX-License-Identifier: Apache-2.0
"""The short cuts of cpplint's worker: same answers as cpplint alone, for patterns and for whole files."""

from __future__ import annotations

import ast
import contextlib
import importlib
import io
import random
import re
import sys
from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters import cpplint as adapter
from haros_ci.linters import cpplint_worker, metrics_worker
from haros_ci.linters.cpplint_worker import Quick, needed_text
from haros_ci.linters.linter import Batch, GaveUp, LintOptions, Output

cpplint = pytest.importorskip("cpplint")

PIECES = [
    *"for if while else switch class struct public: private : static_cast<int> (int)x new Foo() virtual override const auto& std::map".split(),
    *'<vector> #include <map> #include "a/b.h" // /* */ R"x( )x" \'a\' "text" ; ;; {} { } ( ) [ ] , , = == != && and or TODO(x): \t \\'.split(),
    *"EXPECT_TRUE(a==b) DISALLOW_COPY_AND_ASSIGN(A); printf( strcpy( rand() std::string s_; operator<< >> explicit A(int) noexcept => ñ".split(),
    " ",
    "  ",
    "      ",
]


@pytest.mark.parametrize(
    ("pattern", "needed"),
    [
        ("abc", "abc"),
        (r"^\s*#\s*include\b", "include"),
        (r"\bif\b", "if"),
        ("a(bcd)+e", "bcd"),
        ("a(?:bcd){2}?e", "bcd"),
        ("(?s:abc)", "abc"),
        # what need not be there, or may be there in another form, is not needed
        ("ab|cd", ""),
        ("(ab|cd)", ""),
        ("(abc)?d", "d"),
        ("(abc)*", ""),
        ("[ab]", ""),
        ("(?!abc)", ""),
        ("(?<!abc)", ""),
        ("(?i)abc", ""),
        ("(?i:abc)d", "d"),
        ("ab.cd", "ab"),
        (r"(a)\1", "a"),
        ("", ""),
    ],
)
def test_what_a_pattern_needs(pattern: str, needed: str) -> None:
    assert needed_text(pattern) == needed


def test_what_is_no_pattern_is_an_error_as_with_re() -> None:
    for broken in ("(", "[", "a**"):
        with pytest.raises(re.error):
            Quick("search").find(broken, "text")


def test_more_patterns_than_are_kept() -> None:
    quick = Quick("match")
    for number in range(cpplint_worker.KEPT + 10):
        assert quick.find(f"x{number}", f"x{number}")
    assert quick.find("x1$", "x1") and not quick.find("x2", "x1")


def test_all_patterns_of_cpplint_have_the_answers_of_re() -> None:
    """Every text in cpplint's source that is a pattern, on lines put together (seed 1811)."""
    draw, quick = random.Random(1811), [(Quick(name).find, getattr(re, name)) for name in ("search", "match")]
    lines = ["".join(draw.choices(PIECES, k=draw.randrange(12))) for _ in range(150)]
    tree = ast.parse(Path(str(cpplint.__file__)).read_text(encoding="utf-8"))
    patterns = {
        str(call.args[0].value)
        for call in ast.walk(tree)
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Attribute)
        and call.func.attr in ("search", "match", "compile", "sub")
        and call.args
        and isinstance(call.args[0], ast.Constant)
    }
    assert len(patterns) > 100
    for pattern in sorted(patterns):
        for line in lines:
            for ours, theirs in quick:
                mine, own = ours(pattern, line), theirs(pattern, line)
                assert (mine and (mine.span(), mine.groups())) == (own and (own.span(), own.groups())), (pattern, line)


def _words(hastened: bool, path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """What cpplint, loaded anew, prints on *path*."""
    monkeypatch.delitem(sys.modules, "cpplint", raising=False)
    tool = importlib.import_module("cpplint")
    if hastened:
        cpplint_worker.hasten(tool)
    monkeypatch.setattr(sys, "argv", ["cpplint", "--verbose=0", f"--repository={path.parent}", str(path)])
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out), pytest.raises(SystemExit):
        tool.main()
    return out.getvalue()


@pytest.mark.parametrize("suffix", [".hpp", ".cpp"])
def test_files_get_the_same_words(suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    draw = random.Random(7)
    path = tmp_path / f"node{suffix}"
    path.write_text(
        "\n".join(" ".join(draw.choices(PIECES, k=draw.randrange(9))) for _ in range(300)), encoding="utf-8"
    )
    plain = _words(False, path, monkeypatch)
    assert plain.count("\n") > 100
    assert _words(True, path, monkeypatch) == plain


class _Tool:
    """A tool that stays with a file called slow for good."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.is_backed_up = False

    def ProcessFile(self, name: str, level: int) -> None:  # cpplint's name
        self.begun.append(name)
        self.is_backed_up = True
        while name.endswith("slow.cpp"):
            pass
        self.is_backed_up = False

    def _RestoreFilters(self) -> None:  # cpplint's name
        self.is_backed_up = False


def test_a_file_that_takes_too_long_is_left_and_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(metrics_worker, "CPU_LEAST", 0.02)
    tool = _Tool()
    cpplint_worker.bound(tool)
    for name in ("./a.cpp", "./slow.cpp", "./b.cpp"):
        tool.ProcessFile(name, 0)
        assert not tool.is_backed_up
    assert tool.begun == ["./a.cpp", "./slow.cpp", "./b.cpp"]
    assert capsys.readouterr().out == "\nStopped processing ./slow.cpp\n"


def test_what_was_left_has_no_answer(tmp_path: Path) -> None:
    space = workspace(tmp_path, {"a.cpp": "int a;\n", "b.cpp": "int b;\n"})
    batch = Batch(space, space.files, LintOptions(), tmp_path)
    output = b"Done processing ./a.cpp\n\nStopped processing ./b.cpp\n"
    assert list(adapter.parse(Output(output, b"", 1), batch)) == [
        GaveUp("b.cpp", "it takes more time than other files of its size")
    ]
    with pytest.raises(ValueError, match=r"no answer for b\.cpp"):
        list(adapter.parse(Output(b"Done processing ./a.cpp\nStopped processing ./c.cpp\n", b"", 1), batch))
