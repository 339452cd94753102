# SPDX-License-Identifier: Apache-2.0
"""C++: objects of classes with a base class that the workspace does not have: its library may call what nothing else is seen to."""

from __future__ import annotations

import pytest
from follow_kit import conditions, cpp, ends

HEAD = (
    "#include <out/executor.h>\nclass Work : public Executor { public: Work(int a) : Executor(a) {}\nvirtual void start() %s\n"
    'void other() { ros::NodeHandle n; n.advertise<std_msgs::String>("o", 1); } };\nstd::map<std::string, Executor*> every;\n'
)
MAKING = '{ ros::NodeHandle n; n.advertise<std_msgs::String>("x", 1); }'
DOUBT = "the base class Executor is not in the workspace: its library may call the object"


@pytest.mark.parametrize(
    ("body", "around"),
    [
        ('every["a"] = new Work(1);', []),
        ('if (f()) { every["a"] = new Work(1); }', ["f()"]),
        ("auto w = std::make_shared<Work>(1);", []),
        ("std::shared_ptr<Executor> w(new Work(1));", []),
        ("auto w = std::make_unique<Work>(1);", []),
    ],
)
def test_what_a_library_may_call(body: str, around: list[str]) -> None:
    (end,) = ends(cpp(body, HEAD % MAKING))
    assert (end.name, [text for _, text, _, _ in conditions(end)]) == ("/x", around)
    assert [unknown.reason for unknown in end.unknowns if unknown.field == "conditions"] == [DOUBT]


@pytest.mark.parametrize(
    ("body", "around"), [("Work w(1); w.start();", []), ("auto w = new Work(1); if (f()) { w->start(); }", ["f()"])]
)
def test_what_the_program_calls_itself_is_certain(body: str, around: list[str]) -> None:
    (end,) = ends(cpp(body, HEAD % MAKING))
    assert (end.name, [text for _, text, _, _ in conditions(end)], end.unknowns) == ("/x", around, ())


@pytest.mark.parametrize(
    ("body", "head"),
    [
        ("f();", HEAD % MAKING),
        ("Work w(1);", HEAD % MAKING),
        ("auto w = new Work(1);", HEAD % "{ }"),
        ("auto w = new Work(1);", (HEAD % MAKING).replace("virtual void start", "void helper")),
        (
            "auto w = new Work(1);",
            (HEAD % MAKING).replace("public Executor", "public std::enable_shared_from_this<Work>"),
        ),
        ("auto w = new Work(1);", (HEAD % MAKING).replace("public Executor", "public boost::noncopyable")),
        ("auto w = new Work(1);", (HEAD % MAKING).replace("public Executor", "public QThread")),
        ("auto w = new Work(1);", (HEAD % MAKING).replace(": public Executor ", "").replace(" : Executor(a)", "")),
        (
            "auto w = new Work(1);",
            "class Executor { public: Executor(int) {} virtual void start() {} };\n" + HEAD % MAKING,
        ),
        ("Work* w = nullptr;", HEAD % MAKING),
    ],
)
def test_what_no_library_calls(body: str, head: str) -> None:
    assert ends(cpp(body, head)) == []
