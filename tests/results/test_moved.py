# SPDX-License-Identifier: Apache-2.0
"""A known finding in another file: moved with its code it is known; mended in one file and made in another it is new."""

from __future__ import annotations

import pytest
from test_matching import BASE, LINE, OTHER, START, Files, compare, edit, verdicts, whole

MENDED = LINE.replace("eval", "compute")
TURN = OTHER.replace("{\n", "{\n" + START, 1)
SAFE = OTHER.replace("{\n", "{\n" + START.replace(LINE, MENDED), 1)
PYTHON = '"""Parts."""\n\n\ndef part(name):\n    """Give a part."""\n    value = name + 1\n    return eval(value)\n'
PY_OTHER = '"""Others."""\n\n\ndef other():\n    """Do nothing."""\n    return 1\n'
PART = PYTHON[PYTHON.index("\n\ndef part") :]


#: name, before, after
MADE: list[tuple[str, Files, Files]] = [
    ("mended in its line", {**whole(BASE), "b.cpp": OTHER}, {**edit((LINE, MENDED)), "b.cpp": TURN}),
    ("its function written anew", {**whole(BASE), "b.cpp": OTHER},
     {**edit((START, "int start(int a)\n{\n  return -a;\n}\n")), "b.cpp": TURN}),
    ("in a line that was there", {**whole(BASE), "b.cpp": SAFE}, {"b.cpp": TURN}),
    ("in lines that were there, mended in its line", {**whole(BASE), "b.cpp": SAFE},
     {**edit((LINE, MENDED)), "b.cpp": TURN}),
    ("in a function of the same name", whole(BASE) | {"b.cpp": OTHER},
     {"b.cpp": OTHER.replace("{\n", "{\nint start(int b)\n{\n  int first = b + 1;\n" + LINE + "  stop(x);\n  return b;\n}\n", 1)}),
    ("the last line of a file", {"a.py": PYTHON, "b.py": PY_OTHER},
     {"a.py": PYTHON.replace("eval(value)", "value"), "b.py": PY_OTHER + PART}),
    ("another text about the function", {"a.py": PYTHON, "b.py": PY_OTHER},
     {"b.py": PY_OTHER + PART.replace("Give a part", "Publish").replace("    value = name + 1\n", "").replace("def", "\ndef")}),
]  # fmt: skip
KNOWN: list[tuple[str, Files, Files]] = [
    ("the function moves", {**whole(BASE), "b.cpp": OTHER}, {**edit((START, "")), "b.cpp": TURN}),
    ("the function moves to the end", {"a.py": PYTHON, "b.py": PY_OTHER}, {"a.py": '"""Parts."""\n', "b.py": PY_OTHER + PART}),
    ("the file is gone", {"a.py": PYTHON, "b.py": PY_OTHER}, {"b.py": PY_OTHER + PART}),
    ("the function moves, and another line of it is edited", {**whole(BASE), "b.cpp": OTHER},
     {**edit((START, "")), "b.cpp": TURN.replace("publish(x)", "publish(x, now())")}),
    ("the function moves, and another takes its place", {**whole(BASE), "b.cpp": OTHER},
     {**edit((START, "int begin(int a)\n{\n  return a;\n}\n")), "b.cpp": TURN}),
    ("the function moves, and its calls stay", {**edit(("  publish(second);\n", "  publish(start(second));\n")), "b.cpp": OTHER},
     {**edit(("  publish(second);\n", "  publish(start(second));\n"), (START, "int start(int a);\n")), "b.cpp": TURN}),
    ("the function moves to a new file", whole(BASE), {**edit((START, "")), "c.cpp": f"namespace walker\n{{\n{START}}}\n"}),
    ("the file moves", whole(BASE), {"c.cpp": BASE}),
    ("the file moves and is edited", whole(BASE), {"c.cpp": BASE.replace("publish(x)", "send(x, 1)")}),
    ("the file is renamed, and the line edited", whole(BASE), {"c/a.cpp": BASE.replace("eval(first)", "eval(first) + 1")}),
    ("the file is taken into another", whole(BASE) | {"b.cpp": OTHER}, {"b.cpp": BASE + OTHER}),
    ("the function moves and is indented", {**whole(BASE), "b.cpp": OTHER},
     {**edit((START, "")), "b.cpp": OTHER.replace("{\n", "{\n" + START.replace("\n  ", "\n    "), 1)}),
    ("the function moves within its file", whole(BASE), whole(BASE.replace(START, "").replace("}  // namespace", START + "}  // namespace"))),
]  # fmt: skip


@pytest.mark.parametrize(("name", "before", "after"), MADE, ids=[case[0] for case in MADE])
def test_it_is_new(name: str, before: Files, after: Files) -> None:
    assert verdicts(compare("revision", before, after)) == "1 N 1 A"


@pytest.mark.parametrize(("name", "before", "after"), KNOWN, ids=[case[0] for case in KNOWN])
@pytest.mark.parametrize("kind", ["revision", "sarif"])
def test_it_is_known(name: str, before: Files, after: Files, kind: str) -> None:
    assert verdicts(compare(kind, before, after)) == "1 O"


def test_large_files_are_compared_once() -> None:
    before = {"a.cpp": "\n".join(START.replace("start", f"start{n}") for n in range(300)), "b.cpp": OTHER}
    after = {"a.cpp": before["a.cpp"].replace("eval", "compute"), "b.cpp": OTHER + before["a.cpp"]}
    assert verdicts(compare("revision", before, after)) == "300 N 300 A"
