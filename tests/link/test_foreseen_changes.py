# SPDX-License-Identifier: Apache-2.0
"""What loops have changed before is foreseen where it is right, and nowhere else: models are the same with and without it."""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from follow_kit import cpp, names, python

from haros_ci.follow import foreseen
from haros_ci.follow.frames import Frame
from haros_ci.follow.walk import Walk
from haros_ci.model.architecture import Node
from haros_ci.syntax import Program
from haros_ci.syntax.source import Source
from haros_ci.values.abstract import Cell, Known, Object, Sequence

HEAD = """
bool cond();
int count();
void make(std::string s) { ros::NodeHandle nh; nh.advertise<std_msgs::String>(s, 1); }
void grow(std::string s, bool on) { std::string t = "a"; while (cond()) { make(s + t); if (on) t = "b"; } }
void add(std::string s, bool on) { std::vector<std::string> v; v.push_back("a"); while (cond()) { make(s + v[0]); if (on) v.push_back("b"); else v[0] = "c"; } }
void until(std::string s) { int i = 0; while (cond()) { if (count() > i) { make(s + std::to_string(i)); break; } i++; } }
struct Flag {
  bool on = false; std::string last = "a"; Flag* next = nullptr;
  void run(std::string s, bool other) { while (cond()) { make(s + last); if (other) last = "b"; else on = true; } }
  void chain(std::string s) { while (cond()) { make(s + last); if (next) next->last = "c"; } }
  void once(std::string s) { while (cond()) { if (!on) make(s + last); if (on) last = "d"; } }
};
void machine(std::string s, int state) { while (cond()) { switch (state) { case 0: state = 1; break; default: break; } make(s + std::to_string(state)); } }
void lazy(std::string s, Flag* kept) { while (cond()) { if (kept == nullptr) kept = new Flag(); make(s + kept->last); } }
void fill(std::string s, std::map<std::string, int> m) { while (cond()) { if (m.count("k") == 0) m["k"] = 1; make(s + std::to_string(m.size())); } }
void outer(std::string s) { int n = 0; while (cond()) { grow(s, true); for (int i = 0; i < count(); ++i) make(s + std::to_string(n)); n = count(); } }
"""

#: Code of ``main``, and the names that it makes: of each pair of calls the second changes what the first did, or does not.
SAME: Mapping[str, str] = {
    'grow("x", true); grow("y", true);': "/x? /y?",
    'grow("x", true); grow("y", false);': "/x? /ya",
    'grow("y", false); grow("x", true);': "/x? /ya",
    'grow("x", true); grow("y", cond());': "/x? /y?",
    'grow("x", cond()); grow("y", false); grow("z", true);': "/x? /ya /z?",
    'add("x", true); add("y", true);': "/x? /y?",
    'add("x", true); add("y", false);': "/x? /y?",
    'until("x"); until("y");': "/x? /y?",
    'Flag f; f.run("x", true); Flag g; g.run("y", false);': "/x? /ya",
    'Flag f; f.run("x", false); f.run("y", true); f.run("z", true);': "/xa /y? /z?",
    'Flag f; Flag g; f.next = &g; f.chain("x"); g.chain("y"); g.next = &f; g.chain("z");': "/xa /y? /z?",
    'Flag f; f.run("x", true); Flag g; g.once("y"); g.on = true; g.once("z");': "/x? /ya /z?",
    'Flag f; f.on = true; f.once("x"); Flag g; g.once("y");': "/x? /ya",
    'outer("x"); outer("y");': "/x? /y?",
    'machine("x", 0); machine("y", 5);': "/x? /y5",
    'Flag f; lazy("x", nullptr); lazy("y", &f);': "/x? /ya",
    'std::map<std::string, int> m; fill("x", m); m["k"] = 1; fill("y", m);': "/x? /y1",
    'while (cond()) { grow("x", true); grow("y", false); }': "/x? /ya",
    'Flag f; auto t = nh.createTimer(ros::Duration(1), [&](const ros::TimerEvent&) { f.run("x", true); }); f.run("y", false);': "/x? /ya",
}
PYTHON: Mapping[str, str] = {
    'grow("x", True)\ngrow("y", True)': "/x? /y?",
    'grow("x", True)\ngrow("y", False)': "/x? /ya",
    'grow("y", False)\ngrow("x", True)\ngrow("z", outside())': "/x? /ya /z?",
}
SCRIPT = """def grow(s, on):
    t = "a"
    while outside():
        rospy.Publisher(s + t, String, queue_size=1)
        if on:
            t = "b"
"""


def _ends(node: Node) -> list[object]:
    return [(end.kind, end.name, end.conditions, end.unknowns) for end in node.endpoints]


@pytest.mark.parametrize(("code", "expected"), SAME.items())
def test_models_are_the_same_without_it(code: str, expected: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found = cpp(code, HEAD)
    assert names(found) == expected.split()
    monkeypatch.setattr(foreseen, "changes", lambda *loop: {})
    assert _ends(cpp(code, HEAD)) == _ends(found)


@pytest.mark.parametrize(("code", "expected"), PYTHON.items())
def test_so_are_those_of_python(code: str, expected: str, monkeypatch: pytest.MonkeyPatch) -> None:
    found = python(SCRIPT + code)
    assert names(found) == expected.split()
    monkeypatch.setattr(foreseen, "changes", lambda *loop: {})
    assert _ends(python(SCRIPT + code)) == _ends(found)


def _steps(code: str, monkeypatch: pytest.MonkeyPatch) -> int:
    taken, step = [0], Walk.step

    def counted(walk: Walk) -> None:
        taken[0] += 1
        step(walk)

    with monkeypatch.context() as inside:
        inside.setattr(Walk, "step", counted)
        cpp(code, HEAD)
    return taken[0]


@pytest.mark.parametrize(
    "code", ['grow("x", true); grow("y", true);', 'until("x"); until("y");', 'outer("x"); outer("y");']
)
def test_a_loop_that_changes_the_same_again_takes_a_turn_less(code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    taken = _steps(code, monkeypatch)
    monkeypatch.setattr(foreseen, "changes", lambda *loop: {})
    assert taken < _steps(code, monkeypatch)


def test_what_was_wrong_to_foresee_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    first = 'grow("x", true); '
    more = [_steps(first + 'grow("y", false); ' * count, monkeypatch) for count in (1, 2, 3)]
    assert more[1] - more[0] == more[2] - more[1]
    monkeypatch.setattr(foreseen, "changes", lambda *loop: {})
    without = [_steps(first + 'grow("y", false); ' * count, monkeypatch) for count in (1, 2)]
    assert more[1] - more[0] == without[1] - without[0]


def test_members_of_what_a_function_knows_are_places() -> None:
    inner = Object("I", fields={"x": Cell(Known(1))})
    this = Object("T", fields={"inner": Cell(inner), "list": Cell(Sequence(Cell(())))})
    frame = Frame(Source("n.cpp", "p", Program("cpp")), "", this=this, scopes=[{"n": Cell(Known(2))}])
    places = dict(foreseen._places(frame))
    assert [path for _, path in places] == [
        ("n",),
        ("this", "inner"),
        ("this", "list"),
        ("this", "inner", "x"),
        ("this", "list", "[]"),
    ]
    assert all(foreseen._cell(frame, place) is cell for place, cell in places.items())
    assert foreseen._cell(frame, (0, ("n", "x"))) is foreseen._cell(frame, (1, ("n",))) is None
