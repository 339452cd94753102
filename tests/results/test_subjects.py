# SPDX-License-Identifier: Apache-2.0
"""Findings of the architecture before and after a change: their ROS names say which is which, not their lines."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass, replace

import pytest

from haros_ci.model.location import Location
from haros_ci.report.sarif import render
from haros_ci.results.compact import BaselineFormatError, read_compact, write_compact
from haros_ci.results.fingerprint import fingerprint, partial_fingerprints
from haros_ci.results.known import ComparedFiles, KnownFinding, known_from_results, known_from_sarif, names_in
from haros_ci.results.matching import match
from haros_ci.results.result import Graph, Related, Report, Result, Run, Tool, Vertex
from haros_ci.results.rule import Level
from haros_ci.results.sarif_reader import read_sarif
from haros_ci.results.upkeep import prune, update

Files = dict[str, str]
KINDS = ("revision", "sarif", "compact")
TYPES = {"cpp": "cpp", "launch": "launch"}


@dataclass(frozen=True)
class End:
    """A call in the code of a kind of node, as one node makes it."""

    role: str
    kind: str
    node: str
    topic: str
    type: str
    place: Location  # of the remap, else of the call
    launched: Location


def check(files: Files) -> Run:
    """A toy of the real thing: ``*.launch`` starts nodes, each of whose kind ``<kind>.cpp`` publishes and subscribes.

    A launch file is a system. Topics with two types are found, at the remap that brings the subscriber there or else
    at its call.
    """
    results, graphs = [], []
    for path in sorted(files):
        if path.endswith(".launch"):
            ends = list(_ends(path, files))
            names = sorted({(name, kind) for end in ends for name, kind in ((end.node, "node"), (end.topic, "topic"))})
            graphs.append(Graph(path, tuple(Vertex(f"{kind}:{name}", name, kind) for name, kind in names)))
            for sub in (end for end in ends if end.role == "subscribe"):
                for pub in (end for end in ends if end.role == "publish" and end.topic == sub.topic):
                    if pub.type != sub.type:
                        results.append(_mismatch(path, pub, sub))
    analysed = frozenset(files)
    run = Run(Tool("haros-ci"), results=tuple(sorted(results, key=lambda r: r.sort_key)), analysed=analysed)
    return replace(fingerprint((run,), files.__getitem__, _language)[0], graphs=tuple(graphs))


def _mismatch(graph: str, pub: End, sub: End) -> Result:
    return Result(
        "haros-ci",
        "topic-type-mismatch",
        Level.ERROR,
        f"Topic '{sub.topic}' has {pub.type} of {pub.node} and {sub.type} of {sub.node}.",
        sub.place,
        related=(Related(pub.place, "publisher"), Related(sub.launched, "node"), Related(pub.launched, "node")),
        subject=(sub.topic, pub.node, sub.node),
        roles=(f"publisher:{pub.kind}", f"subscriber:{sub.kind}"),
        graph=graph,
    )


def _ends(launch: str, files: Files) -> list[End]:
    remaps = {}
    for number, line in enumerate(files[launch].splitlines(), 1):
        if found := re.search(r'<remap node="(.*)" from="(.*)" to="(.*)"', line):
            remaps[found[1], found[2]] = found[3], Location(launch, number)
    ends = []
    for number, line in enumerate(files[launch].splitlines(), 1):
        for node, kind in re.findall(r'<node name="(.*)" kind="(\w+)"', line):
            [code] = [path for path in files if path.endswith(f"{kind}.cpp")]
            for at, text in enumerate(files[code].splitlines(), 1):
                for role, name, type in re.findall(r'(publish|subscribe)\("(.*)", (\w+)', text):
                    own = name.replace("~", node) if name[0] in "~/" else f"/{name}"
                    topic, place = remaps.get((node, name), (own, Location(code, at)))
                    ends.append(End(role, kind, node, topic, type, place, Location(launch, number)))
    return ends


def _language(path: str) -> str:
    return TYPES[path.rpartition(".")[2]]


TALKER = """\
void Talker::start()
{
  prepare_the_wheels();
  publish("odom", Odometry);
  wait_for_the_wheels();
}
"""
LISTENER = """\
void Listener::start()
{
  prepare_the_map();
  read_the_parameters();
  announce_the_start();
  subscribe("odom", Pose);
  wait_for_the_map();
  publish("path", Path);
}
"""
LAUNCH = """\
<launch>
  <param name="rate_of_the_wheels"/>
  <node name="/driver" kind="talker"/>
  <param name="size_of_the_map"/>
  <param name="frame_of_the_map"/>
  <node name="/viewer" kind="listener"/>
  <param name="colour_of_the_map"/>
</launch>
"""
REMAPPED = LAUNCH.replace(
    '  <param name="colour',
    '  <remap node="/viewer" from="odom" to="/wheels"/>\n  <remap node="/driver" from="odom" to="/wheels"/>\n'
    '  <param name="colour',
)
FILES = {"a/talker.cpp": TALKER, "a/listener.cpp": LISTENER, "a/robot.launch": LAUNCH}
AT_REMAP = {**FILES, "a/robot.launch": REMAPPED}
#: One kind of node many times, each with a defect of its own.
CAMERAS = "".join(
    f'  <node name="/cam{n}" kind="talker"/>\n  <remap node="/cam{n}" from="odom" to="/cam{n}/odom"/>\n'
    f'  <node name="/view{n}" kind="listener"/>\n  <remap node="/view{n}" from="odom" to="/cam{n}/odom"/>\n'
    for n in range(1, 5)
)
MANY = {**FILES, "a/robot.launch": f"<launch>\n{CAMERAS}</launch>\n"}


def edited(files: Files, *changes: tuple[str, str, str]) -> Files:
    """The files with every occurrence of an old text in a file replaced: (path, old, new)."""
    made = dict(files)
    for path, old, new in changes:
        assert old in made[path], (path, old)
        made[path] = made[path].replace(old, new)
    return made


def moved(files: Files, old: str, new: str) -> Files:
    return {path.replace(old, new): text for path, text in files.items()}


def compared(before: Files, after: Files, kind: str, renames: dict[str, str] | None = None) -> tuple[Result, ...]:
    """The results after a change, with their states against a baseline of that kind."""
    past, now = check(before), check(after)
    return match(now.results, known(past, before, kind), sides(before, after, past, now, kind, renames))


def known(past: Run, before: Files, kind: str) -> tuple[KnownFinding, ...]:
    if kind == "sarif":
        log = render(Report((past,)), source=lambda path: before.get(path, ""))
        return known_from_sarif(read_sarif(log.encode(), "base.sarif"))
    found = known_from_results(past.results)
    return found if kind == "revision" else read_compact(write_compact(found).encode(), "base.jsonl")


def sides(
    before: Files, after: Files, past: Run, now: Run, kind: str, renames: dict[str, str] | None = None
) -> ComparedFiles:
    with_base = kind == "revision"
    return ComparedFiles(
        head=lambda path: after.get(path, ""),
        language=_language,
        exists=after.__contains__,
        base=(lambda path: before.get(path, "")) if with_base else None,
        renames=renames or {} if with_base else {},
        head_names=names_in([now]),
        base_names=names_in([past]) if with_base else None,
    )


def states(results: tuple[Result, ...]) -> str:
    return " ".join(sorted(r.state.value if r.state else "?" for r in results))


RENAMED_TOPIC = (
    ("a/talker.cpp", '"odom"', '"pose"'),
    ("a/listener.cpp", '"odom"', '"pose"'),
)
RENAMED_NODE = (("a/robot.launch", '"/driver"', '"/base"'),)
SECOND = ("a/robot.launch", "</launch>", '  <node name="/second" kind="listener"/>\n</launch>')

#: What leaves the one finding old: (before, after, its state).
OLD: dict[str, tuple[Files, Files, str]] = {
    "nothing changed": (FILES, FILES, "unchanged"),
    "lines above": (FILES, edited(FILES, ("a/listener.cpp", "void", "// more\n" * 9 + "void")), "unchanged"),
    "the call is edited": (FILES, edited(FILES, ("a/listener.cpp", "Pose)", "Pose, 10, callback)")), "updated"),
    "the call stands in another line": (
        FILES,
        edited(
            FILES,
            ("a/listener.cpp", '  subscribe("odom", Pose);\n', ""),
            ("a/listener.cpp", '  publish("path"', '  auto s = this->subscribe("odom", Pose, 5);\n  publish("path"'),
        ),
        "updated",
    ),
    "the call stands in another function": (
        FILES,
        edited(
            FILES,
            ("a/listener.cpp", '  subscribe("odom", Pose);\n', ""),
            ("a/listener.cpp", "void Listener", 'void Other::make()\n{\n  subscribe("odom", Pose);\n}\n\nvoid Listener'),
        ),
        "unchanged",
    ),
    "the type that the message names is another": (
        FILES, edited(FILES, ("a/talker.cpp", "Odometry", "Twist")), "updated"),
    "the finding moves from the call to a new remap": (
        FILES,
        edited(FILES, ("a/robot.launch", "</launch>", '  <remap node="/viewer" from="odom" to="/odom"/>\n</launch>')),
        "updated",
    ),
    "the launch file is renamed": (AT_REMAP, moved(AT_REMAP, "robot.launch", "base.launch"), "updated"),
    "the launch file is renamed and edited": (
        AT_REMAP,
        moved(edited(AT_REMAP, ("a/robot.launch", "  <param", '  <arg name="x"/>\n  <param')), "robot.", "base."),
        "updated",
    ),
    "the remap is edited": (
        AT_REMAP,
        edited(AT_REMAP, ("a/robot.launch", 'from="odom" to="/wheels"/>', 'from="odom" to="/wheels" if="yes"/>')),
        "updated",
    ),
    "the directory is renamed": (FILES, moved(FILES, "a/", "b/"), "updated"),
    "the topic is renamed in the code": (FILES, edited(FILES, *RENAMED_TOPIC), "updated"),
    "the topic is renamed in the launch file": (
        AT_REMAP, edited(AT_REMAP, ("a/robot.launch", "/wheels", "/joints")), "updated"),
    "the other node is renamed": (FILES, edited(FILES, *RENAMED_NODE), "updated"),
    "its own node is renamed": (AT_REMAP, edited(AT_REMAP, ("a/robot.launch", "/viewer", "/screen")), "updated"),
    "a topic with two subscribers is renamed": (
        edited(FILES, SECOND), edited(FILES, SECOND, *RENAMED_TOPIC), "updated updated"),
    "a node that two listen to is renamed": (
        edited(FILES, SECOND), edited(FILES, SECOND, *RENAMED_NODE), "updated updated"),
    "a node is renamed and lines are added": (
        FILES,
        edited(FILES, *RENAMED_NODE, ("a/listener.cpp", "void", "// more\nvoid"), ("a/robot.launch", "<launch>", "<launch>\n")),
        "updated",
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", OLD)
def test_old(name: str, kind: str) -> None:
    before, after, state = OLD[name]
    results = compared(before, after, kind)
    assert states(results) == state, [r.reason for r in results]


#: The same, of changes that only the past's files can tell from others.
ONLY_BY_REVISION: dict[str, tuple[Files, Files]] = {
    "a node and the topic are renamed": (FILES, edited(FILES, *RENAMED_TOPIC, *RENAMED_NODE)),
    "a namespace is renamed, of many nodes": (
        MANY, edited(MANY, ("a/robot.launch", "/cam3", "/left"), ("a/robot.launch", "/view3", "/left_view"))),
}  # fmt: skip


@pytest.mark.parametrize("name", ONLY_BY_REVISION)
def test_old_by_revision(name: str) -> None:
    results = compared(*ONLY_BY_REVISION[name], "revision")
    assert {"new", "absent"}.isdisjoint(states(results).split()), [r.reason for r in results]
    assert states(results).count("updated") == 1


@pytest.mark.parametrize("name", ONLY_BY_REVISION)
@pytest.mark.parametrize("kind", ("sarif", "compact"))
def test_without_a_revision_too_much_changed(name: str, kind: str) -> None:
    results = compared(*ONLY_BY_REVISION[name], kind)
    assert states(results).replace("unchanged ", "").split() in (["absent", "new"], ["absent", "new", "unchanged"])


def cameras(*numbers: int) -> str:
    """The launch file with those cameras, in that order."""
    blocks = dict(zip("1234", re.findall("(?:.*\n){4}", CAMERAS), strict=True))
    more = {"6": blocks["3"].replace("cam3", "cam6").replace("view3", "view6")}
    return "<launch>\n" + "".join({**blocks, **more}[str(n)] for n in numbers) + "</launch>\n"


#: A node that has no part in the finding, at the same topic.
KEEPER = {"a/keeper.cpp": 'void Keeper::start()\n{\n  publish("/wheels", Pose);\n}\n'}
KEPT = REMAPPED.replace("</launch>", '  <node name="/keeper" kind="keeper"/>\n</launch>')


def crowd(*numbers: int) -> str:
    """Many talkers at one topic."""
    nodes = "".join(f'  <node name="/cam{n}" kind="talker"/>\n  <param name="of_camera_{n}"/>\n' for n in numbers)
    return LAUNCH.replace('  <node name="/driver" kind="talker"/>\n', nodes)


ALSO = '  subscribe("odom", Pose);\n'
#: A second defect of the same roles in the same system, between names of which some are old.
SPARE = {
    "a/robot.launch": LAUNCH.replace("</launch>", '  <node name="/spare" kind="talker"/>\n</launch>'),
    "a/talker.cpp": TALKER,
    "a/listener.cpp": LISTENER.replace(ALSO, ""),
}

#: What makes a finding that counts: (before, after, states).
NEW: dict[str, tuple[Files, Files, str]] = {
    "the first one ever": ({**FILES, "a/listener.cpp": LISTENER.replace("Pose", "Odometry")}, FILES, "new"),
    "a second subscriber": (
        FILES,
        edited(FILES, SECOND),
        "new unchanged",
    ),
    "a second call about the same names": (
        FILES, edited(FILES, ("a/listener.cpp", ALSO, ALSO + ALSO)), "new unchanged"),
    "one mended by a remap, one made in the same line by another": (
        AT_REMAP,
        edited(AT_REMAP, ("a/robot.launch", 'node="/viewer" from="odom" to="/wheels"', 'node="/viewer" from="odom" to="/odom"'),
               ("a/robot.launch", "</launch>", '  <node name="/spare" kind="talker"/>\n</launch>')),
        "absent new",
    ),
    "one mended and one made of the same roles, and the old node is still there": (
        edited(MANY, ("a/robot.launch", '<remap node="/view2" from="odom" to="/cam2/odom"/>', "<!-- nothing -->")),
        edited(MANY, ("a/robot.launch", '<remap node="/view3" from="odom" to="/cam3/odom"/>', "<!-- nothing -->")),
        "absent new unchanged unchanged",
    ),
    "one mended by taking a node away, another of its kind added elsewhere in the file": (
        {**FILES, "a/robot.launch": cameras(1, 2, 3, 4)},
        {**FILES, "a/robot.launch": cameras(1, 2, 4, 6)},
        "absent new unchanged unchanged unchanged",
    ),
    "one of many nodes at one topic is taken away, another added elsewhere in the file": (
        {**FILES, "a/robot.launch": crowd(1, 2, 3)},
        {**FILES, "a/robot.launch": crowd(6, 1, 2)},
        "absent new unchanged unchanged",
    ),
    "the old name is in the system still": (
        {**AT_REMAP, **KEEPER, "a/robot.launch": KEPT},
        {**AT_REMAP, **KEEPER, "a/robot.launch": KEPT.replace('from="odom" to="/wheels"', 'from="odom" to="/joints"')},
        "absent new",
    ),
    "a name that was in the system before": (
        {**SPARE, "a/listener.cpp": LISTENER.replace('"odom"', '"/far"'), "a/talker.cpp": TALKER.replace('"odom"', '"~/o"'),
         "a/robot.launch": SPARE["a/robot.launch"].replace("</launch>", '  <remap node="/viewer" from="/far" to="/driver/o"/>\n</launch>')},
        {**SPARE, "a/listener.cpp": LISTENER.replace('"odom"', '"/far"'), "a/talker.cpp": TALKER.replace('"odom"', '"~/o"'),
         "a/robot.launch": SPARE["a/robot.launch"].replace("</launch>", '  <remap node="/viewer" from="/far" to="/spare/o"/>\n</launch>')},
        "absent new",
    ),
    "other kinds of nodes": (
        {**FILES, "a/chatter.cpp": TALKER.replace("Talker", "Chatter")},
        {**FILES, "a/chatter.cpp": TALKER.replace("Talker", "Chatter"),
         "a/robot.launch": LAUNCH.replace('"/driver" kind="talker"', '"/base" kind="chatter"')},
        "absent new",
    ),
    "another system has the finding, too": (FILES, {**FILES, "a/other.launch": LAUNCH}, "new unchanged"),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", NEW)
def test_new(name: str, kind: str) -> None:
    before, after, expected = NEW[name]
    results = compared(before, after, kind)
    assert states(results) == expected, [r.reason for r in results]


#: A renaming and more at once: a file of known findings cannot tell which of two is which, so all count.
BOTH: dict[str, tuple[Files, Files, str]] = {
    "one renamed, another mended": (
        edited(FILES, SECOND),
        edited(FILES, ("a/robot.launch", "/viewer", "/screen")),
        "absent updated",
    ),
    "more names than before": (
        FILES,
        edited(FILES, *RENAMED_NODE, ("a/robot.launch", "</launch>", '  <node name="/third" kind="talker"/>\n</launch>')),
        "new updated",
    ),
    "one renamed, another made": (
        FILES,
        edited(FILES, *RENAMED_NODE, ("a/robot.launch", "</launch>", '  <node name="/third" kind="listener"/>\n</launch>')),
        "new updated",
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", BOTH)
def test_a_renaming_and_more(name: str, kind: str) -> None:
    before, after, by_revision = BOTH[name]
    without = "absent absent new" if "mended" in name else "absent new new"
    assert states(compared(before, after, kind)) == (by_revision if kind == "revision" else without)


MENDED: dict[str, Callable[[Files], Files]] = {
    "the type": lambda files: edited(files, ("a/listener.cpp", "Pose", "Odometry")),
    "the name": lambda files: edited(files, ("a/listener.cpp", '"odom"', '"pose"')),
    "the node": lambda files: edited(files, ("a/robot.launch", '  <node name="/viewer" kind="listener"/>\n', "")),
    "the file": lambda files: {path: text for path, text in files.items() if path != "a/robot.launch"},
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", MENDED)
def test_absent(name: str, kind: str) -> None:
    results = compared(FILES, MENDED[name](FILES), kind)
    assert states(results) == "absent"
    assert results[0].subject and set(results[0].subject) == {"/driver", "/odom", "/viewer"}


def test_a_rename_that_git_knows() -> None:
    after = moved(edited(AT_REMAP, ("a/robot.launch", "/wheels", "/joints")), "robot.launch", "base.launch")
    assert states(compared(AT_REMAP, after, "revision", {"a/robot.launch": "a/base.launch"})) == "updated"
    assert states(compared(AT_REMAP, after, "revision")) == "absent new"


def test_exact_names_go_first() -> None:
    """A finding that is there as it was is not taken for the one that is gone."""
    before = edited(MANY, ("a/robot.launch", "/view3", "/viewer"))
    results = compared(before, edited(before, ("a/robot.launch", "/cam2/odom", "/cam3/odom")), "revision")
    by_names = {" ".join(sorted(r.subject)): r.state.value for r in results if r.state}
    assert by_names["/cam3 /cam3/odom /viewer"] == "unchanged"
    assert by_names["/cam2 /cam2/odom /view2"] == "absent"


def about(*subjects: str) -> Run:
    """One finding for each of the *subjects*, which are names with blanks between, at one place."""
    past = check(FILES)
    [result] = past.results
    results = tuple(replace(result, subject=tuple(names.split())) for names in subjects)
    return fingerprint((replace(past, results=results, graphs=()),), FILES.__getitem__, _language)[0]


def turned(before: Run, after: Run, kind: str) -> str:
    """The states against a baseline of that kind, of results that stand in the same files."""
    entries = known(before, FILES, kind)
    return states(match(after.results, entries, sides(FILES, FILES, before, after, kind)))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("names", ["/pose /driver /viewer /more", "/pose /driver", "/odom", "/driver", "/pose"])
def test_more_or_fewer_names_are_no_renaming(kind: str, names: str) -> None:
    assert turned(about("/odom /driver /viewer"), about(names), kind) == "absent new"


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (["/t /a /b /c"], ["/t /a /b"], "updated"),
        (["/t /a /b /c"], ["/t /c"], "updated"),
        (["/t /a /b /c", "/t /a /b"], ["/t /a /b"], "absent unchanged"),
        (["/t /a /b /c", "/u /a /b"], ["/t /a /b", "/u /a /b"], "unchanged updated"),
        (["/t /a /b /c", "/t /a /b /c /d"], ["/t /a /b"], "absent updated"),
    ],
)
def test_partly_mended(kind: str, before: list[str], after: list[str], expected: str) -> None:
    assert turned(about(*before), about(*after), kind) == expected


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (["/t /a /b"], ["/t /a /b /c"], "absent new"),
        (["/t /a /b"], ["/t"], "absent new"),
        (["/t /a /b /c"], ["/t /a /x"], "absent new"),
        (["/t /a /b /c"], ["/t /a", "/t /b"], "new updated"),
        (["/t /a /b", "/t /c /d"], ["/t /a /c"], "absent absent new"),
    ],
)
def test_not_partly_mended(kind: str, before: list[str], after: list[str], expected: str) -> None:
    assert turned(about(*before), about(*after), kind) == expected


def test_partly_mended_in_another_file_is_new() -> None:
    before, after = about("/t /a /b /c"), about("/t /a /b")
    elsewhere = replace(after.results[0], location=Location("a/talker.cpp", 4))
    after = fingerprint((replace(after, results=(elsewhere,)),), FILES.__getitem__, _language)[0]
    assert turned(before, after, "compact") == "absent new"


def test_the_reason_tells_what_was_mended() -> None:
    before, after = about("/t /a /b /c"), about("/t /a /b")
    [result] = match(after.results, known(before, FILES, "compact"), sides(FILES, FILES, before, after, "compact"))
    assert "names mended: /c" in result.reason


def test_the_reason_tells_the_names() -> None:
    [result] = compared(FILES, edited(FILES, *RENAMED_TOPIC), "revision")
    assert "names changed: /odom → /pose" in result.reason
    assert "same roles at its mapped line" in result.reason
    [_, result] = sorted(
        compared(*NEW["a second subscriber"][:2], "revision"), key=lambda r: r.state.value if r.state else ""
    )[::-1]
    assert "no earlier 'topic-type-mismatch' is about '/driver', '/odom', '/second'" in result.reason


def test_a_file_that_was_not_analysed_keeps_its_finding() -> None:
    past, now = check(AT_REMAP), check(moved(AT_REMAP, "robot.launch", "base.launch"))
    after = {**AT_REMAP, **moved(AT_REMAP, "robot.launch", "base.launch")}
    found = replace(
        sides(AT_REMAP, after, past, now, "compact"), partial=True, analysed=lambda tool, path: "robot" not in path
    )
    assert states(match(now.results, known(past, AT_REMAP, "compact"), found)) == "new"


@pytest.mark.parametrize("kind", KINDS)
def test_a_run_that_did_not_look_at_the_architecture_takes_nothing_for_gone(kind: str) -> None:
    past = check(FILES)
    none = replace(past, results=(), graphs=())
    about = sides(FILES, FILES, past, none, kind)
    entries = known(past, FILES, kind)
    assert states(match((), entries, about)) == "absent"
    assert match((), entries, replace(about, architecture=False)) == ()
    assert update(entries, (), replace(about, architecture=False)) == entries
    assert prune(entries, (), replace(about, architecture=False)) == entries
    assert prune(entries, (), about) == ()
    plain = [replace(entry, names="", roles="", subject=()) for entry in entries]
    assert states(match((), plain, replace(about, architecture=False))) == "absent"


class TestFingerprints:
    def test_names_and_roles_alone_make_them(self) -> None:
        [one] = check(FILES).results
        [other] = check(
            edited(FILES, ("a/listener.cpp", "Pose)", "Pose, 10)"), ("a/robot.launch", "<l", "\n<l"))
        ).results
        for name in ("harosCiSubject/v1", "harosCiRoles/v1"):
            assert partial_fingerprints(one)[name] == partial_fingerprints(other)[name]
        [renamed] = check(edited(FILES, *RENAMED_TOPIC)).results
        assert partial_fingerprints(renamed)["harosCiSubject/v1"] != partial_fingerprints(one)["harosCiSubject/v1"]
        assert partial_fingerprints(renamed)["harosCiRoles/v1"] == partial_fingerprints(one)["harosCiRoles/v1"]

    def test_a_finding_without_names_has_none(self) -> None:
        plain = replace(check(FILES).results[0], subject=(), roles=())
        [result] = fingerprint((Run(Tool("t"), results=(plain,)),), FILES.__getitem__, _language)[0].results
        assert {"harosCiSubject/v1", "harosCiRoles/v1"}.isdisjoint(partial_fingerprints(result))

    def test_order_of_names_does_not_count(self) -> None:
        [result] = check(FILES).results
        turned = replace(result, subject=result.subject[::-1], roles=result.roles[::-1])
        [again] = fingerprint((Run(Tool("t"), results=(turned,)),), FILES.__getitem__, _language)[0].results
        assert again.identity == result.identity

    def test_a_log_restores_them(self) -> None:
        past = check(FILES)
        [entry] = known(past, FILES, "sarif")
        [result] = past.results
        assert result.identity and (entry.names, entry.roles) == (result.identity.names, result.identity.roles)
        assert entry.subject == tuple(sorted(result.subject))


class TestCompact:
    def test_the_file_has_names_and_roles_and_nothing_that_moves(self) -> None:
        [line] = write_compact(known_from_results(check(FILES).results)).splitlines()[1:]
        entry = json.loads(line)
        assert entry["subject"] == ["/driver", "/odom", "/viewer"]
        assert re.fullmatch("[0-9a-f]{16}", entry["roles"])
        assert not {"line", "related", "graph", "names"} & set(entry)

    def test_a_file_without_them_is_read_and_matched_by_its_lines(self) -> None:
        past = check(FILES)
        old = [replace(entry, names="", roles="", subject=()) for entry in known_from_results(past.results)]
        entries = read_compact(write_compact(old).encode(), "base.jsonl")
        assert states(match(past.results, entries, sides(FILES, FILES, past, past, "compact"))) == "unchanged"

    @pytest.mark.parametrize("value", ['"/a"', "[1]", '["/a", ""]', "{}", "null", json.dumps(["/n"] * 1001)])
    def test_what_is_no_list_of_names(self, value: str) -> None:
        line = f'{{"path": "a", "tool": "t", "rule": "r", "subject": {value}}}'
        with pytest.raises(BaselineFormatError, match="line 2: 'subject'"):
            read_compact(f'{{"haros-ci-baseline": 1}}\n{line}\n'.encode(), "b")

    def test_more_names_than_are_kept(self) -> None:
        [result] = check(FILES).results
        crowd = replace(result, subject=tuple(f"/n{n}" for n in range(3000)))
        [run] = fingerprint((Run(Tool("haros-ci"), results=(crowd,)),), FILES.__getitem__, _language)
        entries = read_compact(write_compact(known_from_results(run.results)).encode(), "b")
        now = replace(check(FILES), results=run.results)
        assert states(match(run.results, entries, sides(FILES, FILES, now, now, "compact"))) == "unchanged"

    def test_update_follows_a_renaming(self) -> None:
        after = edited(FILES, *RENAMED_TOPIC)
        past, now = check(FILES), check(after)
        [old] = known(past, FILES, "compact")
        about = sides(FILES, after, past, now, "compact")
        [entry] = update((replace(old, reason="known"),), now.results, about)
        assert entry.subject == ("/driver", "/pose", "/viewer") and entry.reason == "known"
        assert prune((old,), now.results, about) == (old,)
