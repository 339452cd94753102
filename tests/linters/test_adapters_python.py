# SPDX-License-Identifier: Apache-2.0
"""What the adapters of the Python tools that are asked for make of captured output, recorded from the tools themselves."""

from __future__ import annotations

import json
from pathlib import Path
from types import ModuleType

import pytest
from linter_samples import workspace
from test_adapters import brief

from haros_ci.linters import bandit, black, codespell, flake8, isort, mypy, vulture
from haros_ci.linters.linter import Batch, Finding, GaveUp, LintOptions, Output
from haros_ci.results.rule import Level

PY2 = "print 'x'\n"
GROUPS = {vulture: '[null, ""]'}


def parse(
    tool: ModuleType, root: Path, files: dict[str, str], stdout: str, stderr: str = "", code: int = 0
) -> list[Finding | GaveUp]:
    """*stdout* may have ``{root}`` for the workspace."""
    space = workspace(root, files)
    chosen = tuple(f for f in space.files if f.language in tool.LANGUAGES)
    batch = Batch(space, chosen, LintOptions(), root, GROUPS.get(tool, ""))
    out = stdout.replace("{root}", str(root))
    return list(tool.parse(Output(out.encode(), stderr.encode(), code), batch))


FLAKE8 = [
    ("./a.py\t1\t1\tF401\t'os' imported but unused", "import os\n", [("a.py", "F401", "a.py:1:1")]),
    ("./a.py\t1\t10\tE401\tmultiple imports", "import os, é\n", [("a.py", "E401", "a.py:1:10")]),
    ("./a.py\t1\t8\tF841\tlocal", 'é = 1; y = ""\n', [("a.py", "F841", "a.py:1:7")]),  # bytes
    ("./a.py\t1\t8\tE702\ttwo", 'é = 1; y = ""\n', [("a.py", "E702", "a.py:1:8")]),  # code points
    ("./a.py\t1\t1\tX100\ta\ttab: b", "é\n", [("a.py", "X100", "a.py:1:1")]),
    ("./a.py\t1\t99\tE999\tSyntaxError: no", "def f(:\n", [("a.py", "E999", "a.py:1")]),
    ("./a.py\t1\t2\tE999\tSyntaxError: no\n./a.py\t1\t3\tE225\tx", PY2, [("a.py", "it is Python 2", 1)]),
    ("./a.py\t0\t1\tE902\tOSError: no", PY2, [("a.py", "it is Python 2", None)]),
    ("", "", []),
]


@pytest.mark.parametrize(("out", "text", "said"), FLAKE8)
def test_flake8(tmp_path: Path, out: str, text: str, said: list[object]) -> None:
    assert brief(parse(flake8, tmp_path, {"a.py": text}, out + "\n")) == said


def problem(**changes: object) -> dict[str, object]:
    plain = {"filename": "././a.py", "line_number": 2, "line_range": [2], "col_offset": 0, "end_col_offset": 4}
    told = {"test_id": "B602", "issue_severity": "HIGH", "issue_text": "shell", "issue_cwe": {"id": 78}}
    return {**plain, **told, **changes}


def bandits(*results: dict[str, object], errors: tuple[dict[str, str], ...] = ()) -> str:
    return json.dumps({"results": results, "errors": errors, "metrics": {}})


BANDIT = [
    (problem(), "a.py:2:1-2:3", Level.ERROR),
    (problem(col_offset=7, end_col_offset=9), "a.py:2:6-2:8", Level.ERROR),  # bytes
    (problem(line_range=[2, 3], col_offset=0), "a.py:2:1-3:5", Level.ERROR),
    (problem(line_range=[1, 2, 3]), "a.py:2:1-None:None", Level.ERROR),  # the range is of what it stands in
    (problem(end_col_offset=0), "a.py:2:1-None:None", Level.ERROR),
    (problem(col_offset=-1), "a.py:2-None:None", Level.ERROR),
    (problem(issue_severity="LOW", filename="./a.py"), "a.py:2:1-2:3", Level.NOTE),
]


@pytest.mark.parametrize(("said", "place", "level"), BANDIT)
def test_bandit(tmp_path: Path, said: dict[str, object], place: str, level: Level) -> None:
    (found,) = parse(bandit, tmp_path, {"a.py": "import os\néé + os\nlast line\n"}, bandits(said))
    assert isinstance(found, Finding)
    where = found.result.location
    assert (f"{where}-{where.end_line}:{where.end_column}", found.result.level) == (place, level)


def test_bandit_on_what_it_cannot_read(tmp_path: Path) -> None:
    errors = ({"filename": "./a.py", "reason": "syntax error while parsing AST from file"},)
    assert brief(parse(bandit, tmp_path, {"a.py": PY2}, bandits(errors=errors))) == [("a.py", "it is Python 2", None)]


DIFF = """--- {name}\t2024-01-01 00:00:00+00:00
+++ {name}\t2024-01-02 00:00:00+00:00
@@ -{start},4 +1,4 @@
 import os
 
-x = 'a'
+x = "a"
--- b.py\t2024
+++ b.py\t2024
@@ -10,3 +11,3 @@
+more
"""


@pytest.mark.parametrize(
    ("tool", "name", "code"), [(black, "a.py", 0), (black, "./a.py", 123), (isort, "{root}/a.py:before", 1)]
)
def test_formatters_point_at_the_first_line_that_changes(
    tmp_path: Path, tool: ModuleType, name: str, code: int
) -> None:
    diff = DIFF.replace("{name}", name).replace("{start}", "7")
    if tool is isort:
        diff = diff.replace("b.py\t", "{root}/b.py:before\t")
    stderr = "error: cannot parse: c.py:3:6\n    print 'x'\n" if code == 123 else ""
    said = brief(parse(tool, tmp_path, {"a.py": "", "b.py": "", "c.py": PY2}, diff, stderr, code))
    gave_up: list[tuple[object, ...]] = [("c.py", "it is Python 2", 3)] if code == 123 else []
    rule = "would-reformat" if tool is black else "unsorted-imports"
    assert said == [*gave_up, ("a.py", rule, "a.py:9"), ("b.py", rule, "b.py:10")]


def test_black_s_words_of_other_versions(tmp_path: Path) -> None:
    stderr = "error: cannot format a.py: Cannot parse for target version Python 3.11: 5:6: print 'x'\n"
    assert brief(parse(black, tmp_path, {"a.py": PY2}, "", stderr, 123)) == [("a.py", "it is Python 2", 5)]


VULTURE = [
    ("a.py:1: unused import 'os' (90% confidence)", ("a.py", "unused-import", "a.py:1:8")),
    ("./a.py:2: unused function 'f' (60% confidence, 3 lines)", ("a.py", "unused-function", "a.py:2:5")),
    ("a.py:2: unused variable 'gone' (100% confidence)", ("a.py", "unused-variable", "a.py:2")),
    ("a.py:2: unreachable code after 'return' (100% confidence)", ("a.py", "unreachable-code", "a.py:2")),
    ("a.py:2: unsatisfiable 'if' condition (100% confidence)", ("a.py", "unreachable-code", "a.py:2")),
]


@pytest.mark.parametrize(("line", "said"), VULTURE)
def test_vulture(tmp_path: Path, line: str, said: tuple[object, ...]) -> None:
    stderr = "b.py:7: Missing parentheses in call to 'print' at \"print 'x'\"\n"
    files = {"a.py": "import os\ndef f():\n", "b.py": PY2}
    assert brief(parse(vulture, tmp_path, files, line + "\n", stderr, 3)) == [("b.py", "it is Python 2", 7), said]


CODESPELL = [
    ("{root}/a.md:1: teh ==> the\n{root}/a.md:1: teh ==> the", ["a.md:1:5", "a.md:1:9"], "'teh' should be 'the'."),
    ("{root}/a.md:2: ue ==> use, due", ["a.md:2:3"], "'ue' should be one of: use, due."),
    ("{root}/a.md:2: ue ==> use, due,  | why", ["a.md:2:3"], "'ue' should be one of: use, due (why)."),
    ("{root}/a.md:3: gone ==> went", ["a.md:3"], "'gone' should be 'went'."),
]


@pytest.mark.parametrize(("out", "places", "message"), CODESPELL)
def test_codespell(tmp_path: Path, out: str, places: list[str], message: str) -> None:
    said = parse(codespell, tmp_path, {"a.md": "é, 'teh teh'\né ue\n\n".replace("é, '", "é ' ")}, out + "\n", code=65)
    assert [(str(s.result.location), s.result.message) for s in said if isinstance(s, Finding)] == [
        (place, message) for place in places
    ]


def told(**changes: object) -> str:
    plain = {"file": "a.py", "line": 1, "column": 4, "end_line": 1, "end_column": 7, "code": "arg-type"}
    return json.dumps({**plain, "message": "m", "hint": None, "severity": "error", **changes})


MYPY = [
    (told(), [("a.py", "arg-type", "a.py:1:5")]),
    (told(line=2), [("a.py", "arg-type", "a.py:2")]),  # not ASCII: versions count differently
    (told(line=-1, column=-1), [("a.py", "arg-type", "a.py")]),
    (told(column=99), [("a.py", "arg-type", "a.py:1")]),
    (told(code=None), [("a.py", "misc", "a.py:1:5")]),
    (told(severity="note"), []),
    (told(file="elsewhere.py"), []),
    (told(code="valid-type", message='Variable "p.X" is not valid as a type'), []),
    (told(message="Unsupported left operand type for - (FloatArray?)"), []),
    (told(message="Argument 1 has incompatible type \"Literal['a']?\""), [("a.py", "arg-type", "a.py:1:5")]),
    (told(code="attr-defined", message='Module "q" has no attribute "msg"'), []),  # q may get it when it is built
    (told(code="attr-defined", message='Module "os" has no attribute "x"'), [("a.py", "attr-defined", "a.py:1:5")]),
    (json.dumps({"file": "a.py", "line": 3, "gave_up": "Duplicate"}), [("a.py", "Duplicate", 3)]),
    (json.dumps({"file": "b.py", "line": 0, "gave_up": "syntax"}), [("b.py", "it is Python 2", None)]),
]


@pytest.mark.parametrize(("line", "said"), MYPY)
def test_mypy(tmp_path: Path, line: str, said: list[object]) -> None:
    files = {"a.py": "x = abc\né = abc\n", "b.py": PY2, "q/__init__.py": ""}
    assert brief(parse(mypy, tmp_path, files, line + '\n{"done": true}\n')) == said


NONSENSE = [
    *((flake8, text, code) for text, code in (("", 1), ("./b.py\t1\t1\tF401\tx\n", 0), ("a.py:1\n", 0), ("\0", 0))),
    *(
        (bandit, text, code)
        for text, code in (("", 0), ("{}", 0), (bandits(problem(line_number="1")), 0), (bandits(), 2))
    ),
    *((bandit, bandits(problem(filename="b.py")), 0), (bandit, bandits(problem(issue_severity="WORSE")), 0)),
    *((black, text, code) for text, code in (("", 1), ("", 123), (DIFF.replace("{start}", "1"), 0))),
    *((isort, text, code) for text, code in (("", 1), ("", 2), (DIFF.replace("{start}", "1"), 1))),
    *(
        (vulture, text, code)
        for text, code in (("", 2), ("Traceback\n", 3), ("b.py:1: unused import 'x' (90% confidence)\n", 3))
    ),
    *(
        (codespell, text, code)
        for text, code in (("", 64), ("a\n", 65), ("./b.md:1: teh ==> the\n", 65), ("x:1: y\n", 65))
    ),
    *((mypy, text, code) for text, code in (("", 0), ("{}\n", 0), (told() + "\n", 1), ('x\n{"done": true}\n', 0))),
]


@pytest.mark.parametrize(("tool", "out", "code"), NONSENSE)
def test_nonsense_is_refused(tmp_path: Path, tool: ModuleType, out: str, code: int) -> None:
    with pytest.raises((ValueError, KeyError, TypeError, IndexError, AttributeError)):
        parse(tool, tmp_path, {"a.py": "x\n"}, out, code=code)
