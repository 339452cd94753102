# SPDX-License-Identifier: Apache-2.0
"""A run written down as values, and the page that is made of it."""

from __future__ import annotations

import importlib.util
import json
from collections.abc import Mapping
from dataclasses import replace
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema

from haros_ci.behaviour.declared import Owner, in_file
from haros_ci.checking.system import SystemNode, systems
from haros_ci.checking.transforms import Broadcast
from haros_ci.html_page.data import Input, data_of
from haros_ci.html_page.document import page
from haros_ci.html_page.properties import Held
from haros_ci.html_page.verdicts import Recorded, recorded
from haros_ci.model import dependence as causal
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Qos, Unknown
from haros_ci.model.build import Build, Interface, InterfaceField
from haros_ci.model.changes import ADDED, REMOVED, Change, Changes, Edge
from haros_ci.model.launch_facts import ArgumentDeclaration, IncludeUse, PassedArgument
from haros_ci.model.location import Location
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import Dependency, Package, SourceFile
from haros_ci.model.presence import choice
from haros_ci.model.rates import Rates, TopicRate, exactly, unknown
from haros_ci.model.workspace import Workspace
from haros_ci.report.measurements import Limit
from haros_ci.results.result import Baseline, BaselineState, Identity, Provenance, Related, Report, Result, Run, Tool
from haros_ci.results.rule import Level, Rule

SCHEMA = json.loads((files("haros_ci.html_page") / "html-schema.json").read_text(encoding="utf-8"))
PROJECT = "haros.yaml"
LAUNCH, INNER, CODE = "base/launch/base.launch.py", "base/launch/inner.launch.py", "base/src/base.cpp"
SOURCE = {
    PROJECT: "".join(f"line {n}\n" for n in range(1, 30)),
    CODE: "".join(f"int line_{n} = {n};  // é <b>\n" for n in range(1, 40)),
    LAUNCH: "a = 1\nb = 2\nc = 3\n",
}
NAME = f"base/{LAUNCH.partition('/')[2]}"
#: Texts that a page could take for markup, code or an address.
HOSTILE = (
    "<img src=x onerror=window.hacked=1>",
    "</script><script>window.hacked=1</script>",
    "</title><svg onload=window.hacked=1>",
    "javascript:window.hacked=1",
    '"><script>window.hacked=1</script>',
    "'-window.hacked=1-'",
    "${window.hacked=1}`",
    "<!--<script>",
    "]]><script>window.hacked=1</script>",
    "__proto__",
    "constructor",
    "\x00\x1b[2J\u202egpj.exe\u2028\ud800",
    "a\n::error::b",
    "&lt;script&gt;",
    "{policy}{data}%s%(x)s",
    "/?" * 30,
    "x" * 5000,
)


class Texts:
    """A reader of files that stand in the test."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self.texts = texts

    def text(self, path: str) -> str:
        return self.texts.get(path, "")

    def data(self, path: str) -> bytes | None:
        return None

    def head(self, path: str, length: int) -> bytes:
        return b""


def end(kind: str, name: str, type: str | None = "std_msgs/msg/String", line: int = 7, **more: Any) -> Endpoint:
    return Endpoint(
        kind=kind, name=name, type=type, **{"location": Location(CODE, line, 3), "original_name": name, **more}
    )


def node(name: str, *ends: Endpoint, line: int = 2, **more: Any) -> Node:
    given = {"kind": "node", "package": "base", "type": name.rpartition("/")[2], "location": Location(LAUNCH, line, 5)}
    return Node(name=name, endpoints=ends, ros=2, **{**given, **more})


def configuration(word: str = "", name: str = NAME) -> Configuration:
    """A camera, a filter in a container, a driver in a namespace, a conditional node, and what is not known; *word* in every text."""
    best = Qos(history="keep_last", depth=5, reliability="best_effort", durability="volatile")
    sure = Qos(history="keep_last", depth=1, reliability="reliable", durability="volatile")
    around = Condition("if", f"debug{word}", Location(CODE, 3))
    return Configuration(
        name=name,
        launch=(NAME,),
        arguments=((f"robot{word}", f"one{word}"), ("watch", "true")),
        nodes=(
            node(f"/camera{word}", end("publishers", f"/image{word}", qos=best), end("publishers", "/rosout", implicit=True)),
            node("/box/container", end("servers", "/box/container/load"), end("publishers", "/rosout", implicit=True)),
            node(
                "/box/filter",
                end("subscribers", f"/image{word}", qos=sure),
                end("publishers", "/box/found", conditions=(around,)),
                end("parameters", "/box/filter/rate", "double", value=2.0, effective=5.0, range=(0.0, 10.0, None)),
                container="/box/container",
                kind="component",
                class_name=f"base::Filter{word}",
            ),
            node("/arm/driver", end("subscribers", "/box/found"), end("publishers", "/arm/state"), end("servers", "/arm/stop", "std_srvs/srv/Trigger"), remaps=((f"/a{word}", "/b"),)),
            node("/arm/watch", end("subscribers", "/arm/state"), end("clients", "/arm/stop", "std_srvs/srv/Trigger"), end("action_clients", "/go", f"base/action/Go{word}"), presence=(choice("watch", "true", boolean=True),)),
            node(
                "/odd",
                end("subscribers", "/box/?", None, unknowns=(Unknown("name", f"what strip{word} returns is not known"),)),
                end("action_servers", "/go", "base/action/Go"),
                conditions=(around,),
                unknowns=(Unknown("endpoints", f"a call{word}", Location(CODE, 9)),),
            ),
        ),
        parameters=(Parameter(name="/box/filter/rate", type="double", value=5.0, location=Location(LAUNCH, 3), origin=Location("base/config/p.yaml", 4)), Parameter(name=f"/camera/unread{word}", type="str", value=f"v{word}")),
        rates=Rates(
            (
                TopicRate(f"/camera{word}", f"/image{word}", Location(CODE, 7), exactly(30.0), ()),
                TopicRate("/arm/driver", "/arm/state", None, unknown(f"the sleep{word} is not known"), ()),
            ),
            ((f"/image{word}", exactly(30.0)), ("/arm/state", unknown(f"the sleep{word} is not known"))),
        ),
        dependence=dependence(word),
        alternatives=(node("/simulator", end("publishers", f"/image{word}"), end("publishers", "/arm/state"), presence=(choice("sim", f"true{word}"),)),),
        launch_facts=(
            ArgumentDeclaration(location=Location(LAUNCH, 1), name=f"robot{word}", default=f"one{word}", choices=("one", "two")),
            IncludeUse(location=Location(LAUNCH, 2), text=f"inner{word}", path=INNER, passed=(PassedArgument("x", Location(LAUNCH, 2)),)),
            IncludeUse(location=Location(INNER, 4), included=(Location(LAUNCH, 2),), text="away", path=None),
        ),
    )  # fmt: skip


def dependence(word: str = "") -> causal.Dependence:
    """What the nodes of ``configuration`` do with their inputs: the filter passes on images under a condition, the driver does not tell all."""
    image = causal.Input("subscription", f"/image{word}", Location(CODE, 7, 3))
    found = causal.Input("subscription", "/box/found", Location(CODE, 7, 3))
    timer = causal.Cause("timer", "", Location(CODE, 4), "direct", is_each=True)
    passed = causal.Cause(
        "subscription",
        f"/image{word}",
        Location(CODE, 7, 3),
        "state",
        (f"last_{word}",),
        (causal.When(f"debug{word}", False, Location(CODE, 3), (f"parameter rate{word}",)),),
        ((Location(CODE, 8), f"Filter::on_image{word} is the callback"), (Location(CODE, 9), "Filter::tick sends it")),
    )
    return causal.Dependence(
        (
            causal.NodeDependence(f"/camera{word}", (causal.Input("timer", "", Location(CODE, 4)),), (causal.Output("publishers", f"/image{word}", Location(CODE, 7, 3), (), (timer,)),)),
            causal.NodeDependence("/box/container", (causal.Input("service", "/box/container/load", None),), ()),
            causal.NodeDependence("/box/filter", (image,), (causal.Output("publishers", "/box/found", Location(CODE, 7, 3), (), (passed,)),)),
            causal.NodeDependence("/arm/driver", (found, causal.Input("service", "/arm/stop", Location(CODE, 7, 3))), (causal.Output("publishers", "/arm/state", Location(CODE, 7, 3), (), (), True),)),
            causal.NodeDependence("/arm/watch", (causal.Input("subscription", "/arm/state", Location(CODE, 7, 3)),), (causal.Output("clients", "/arm/stop", None, (), (), reason=f"setup{word} gives it to others"),)),
            causal.NodeDependence("/odd", (), (), f"a call{word}"),
        )
    )  # fmt: skip


def broadcasts(one: Configuration, word: str = "") -> tuple[Broadcast, ...]:
    """A tree of frames with two that are at odds: a robot's, a static one, and two in code."""
    nodes = next(iter(systems(Architecture(configurations=(one,))))).nodes
    by_name = {one.name.removesuffix(word): one for one in nodes}
    if "/camera" not in by_name:
        return ()
    camera, driver = by_name["/camera"], by_name["/arm/driver"]

    def said(
        child: str, parent: str | None, of: SystemNode, line: int, *, static: bool = False, topic: str = "/tf"
    ) -> Broadcast:
        what = f"{of} publishes the joint {child}{word}"
        return Broadcast(
            f"{child}{word}", parent and f"{parent}{word}", static, of, Location(CODE, line), what, topic, str(line)
        )

    return (
        said("base_link", "odom", driver, 5),
        said("base_link", "map", camera, 6),
        said("lens", "base_link", camera, 7, static=True),
        said("odom", "map", camera, 8),
        said("loose", None, camera, 9),
        said("lens", "stand", camera, 10, topic="/other/tf"),
    )


def properties(word: str = "") -> tuple[Held, ...]:
    """A promise, an assumption, and a text that is none."""
    head = f'# id: stops\n# title: "stops{quoted(word)}"\n'
    texts = (
        f"{head}globally: /stop causes /arm/state within 100 ms\n",
        "globally: no /image {data = 1}\n",
        f"globally no{word}\n",
    )
    found = []
    for number, text in enumerate(texts):
        for one in in_file(
            text,
            PROJECT,
            Owner("configuration", f"{NAME}{word}") if number else Owner("node", f"base/driver{word}"),
            is_axiom=number == 1,
        ):
            at = replace(one.location, line=10 * number + 3, end_line=10 * number + 4)
            found.append(
                Held(replace(one, location=at), ((f"/stop{word}", (f"/arm/stop{word}",)), ("/away", ())), (NAME,))
            )
    return tuple(found)


def verdicts(word: str = "") -> Recorded:
    """A recording that violates the first of ``properties``, with messages that two nodes publish, and one that it was asked of alone."""

    def message(role: str, topic: str, time: float, node: str) -> dict[str, Any]:
        publishers = [{"node": f"{node}{word}", "path": CODE, "line": 7}] if node else []
        return {"role": role, "topic": f"{topic}{word}", "number": int(time * 10), "time": time, "values": {f"data{word}": f"1{word}"}, "publishers": publishers}  # fmt: skip

    def judged(verdict: str, text: str, **more: Any) -> dict[str, Any]:
        return {"id": f"stops{word}", "text": text, "owner": "node base/driver", "node": f"/arm/driver{word}", "axiom": False, "path": None, "line": None, "column": None, "verdict": verdict, "reason": f"why{word}", "time": None, "witnesses": [], "scopes": 1, "triggers": 2, "behaviours": 0, **more}  # fmt: skip

    witnesses = [message("trigger", "/image", 10.5, "/camera"), message("behaviour", "/box/found", 11.25, "")]
    document = {
        "recording": {"name": f"drive.mcap{word}", "messages": 1234, "begin": 10.0, "end": 40.0, "topics": {}, "notes": []},
        "configuration": f"{NAME}",
        "clock": "log",
        "properties": [
            judged("violated", "globally: /stop causes /arm/state within 100 ms", path=PROJECT, line=3, time=12.0, witnesses=witnesses),
            judged("held", f"globally: no /other{word}", node=None),
        ],
    }  # fmt: skip
    return recorded(json.dumps(document), "verdicts.json")


def quoted(word: str) -> str:
    return "".join(letter for letter in word if letter.isalnum() or letter in "<>/= ")[:200]


def report(word: str = "", results: int = 3) -> Report:
    """Findings of two tools in every state, compared with a base revision."""
    rule = Rule(
        "uninit",
        f"A member{word} is set.",
        help=f"# uninit\nA **member**{word} `x`.\n\n- one\n- two\n\n| a | b |\n|---|---|\n| 1 | {word} |\n\n    code{word}\n",
    )
    check = Rule("topic-type-mismatch", "Both ends agree.", tags=("architecture", f"tag{word}"))
    found = [
        Result("cppcheck", "uninit", Level.WARNING, f"Member {n}{word} is not set", Location(CODE, n % 38 + 1, 5, n % 38 + 1, 9), related=(Related(Location(CODE, 2), f"declared{word}"),), identity=Identity(text=f"{n:016x}", snippet="int"), state=BaselineState.NEW)
        for n in range(results)
    ]  # fmt: skip
    mismatch = Result(
        "haros-ci", "topic-type-mismatch", Level.ERROR, f"/odd and /box/filter{word} differ", Location(CODE, 7, 3), subject=("/box/found", "/box/filter"), graph=NAME, flow=(Related(Location(CODE, 1), "first"), Related(Location(LAUNCH, 2), "then")), state=BaselineState.NEW,
    )  # fmt: skip
    old = Result(
        "cppcheck",
        "uninit",
        Level.NOTE,
        "An old one",
        Location(CODE, 30),
        state=BaselineState.UNCHANGED,
        reason=f"same text{word}",
    )
    gone = Result("cppcheck", "uninit", Level.ERROR, "A gone one", Location(CODE, 31), state=BaselineState.ABSENT)
    changes = Changes(
        changes=(
            Change(what="publisher", action=ADDED, names=(f"/image{word}",), nodes=(f"/camera{word}",), configurations=(NAME,), after=f"std_msgs/msg/String{word}", head=Location(CODE, 7)),
            Change(what="node", action=REMOVED, names=("/old",), configurations=(NAME,), base=Location(LAUNCH, 9)),
        ),
        edges=(Edge(node=f"/camera{word}", channel=f"/image{word}", kind="topic", is_giver=True, state=ADDED), Edge(node="/old", channel=f"/image{word}", kind="topic", is_giver=False, state=REMOVED), Edge(node="/box/filter", channel=f"/image{word}", kind="topic", is_giver=False)),
        not_known=1,
    )  # fmt: skip
    hpl = Result(
        "haros-ci",
        "hpl-unknown-topic",
        Level.WARNING,
        f"No node has /away{word}",
        Location(PROJECT, 3, 4),
        state=BaselineState.NEW,
    )
    own = Run(Tool("haros-ci", "1"), (check,), (mismatch, hpl), changes=changes)
    return Report(
        (own, Run(Tool("cppcheck", "2"), (rule,), (*found, old, gone))),
        baseline=Baseline("revision", f"main{word}"),
        provenance=Provenance("", "ab" * 20, f"branch{word}"),
    )


def given(word: str = "", *, results: int = 3, configurations: tuple[Configuration, ...] | None = None) -> Input:
    """Everything that the page can show; *word* stands in every text that a workspace brings."""
    packages = (
        Package(
            "base",
            "base",
            version="1.0.0",
            build_type="ament_cmake",
            ros=2,
            dependencies=(Dependency("tools", "depend"), Dependency("rclcpp", "depend")),
        ),
        Package(f"tools{word}x", "tools", ros=2, dependencies=(Dependency("base", "depend"),)),
        Package("tools", "tools2", ros=2, dependencies=(Dependency("base", "build_depend"),)),
    )
    listed = (SourceFile(CODE, "cpp", 900, "d1", "base", 39), SourceFile(LAUNCH, "python", 30, "d2", "base", 3))
    go = Interface(
        name="base/Go",
        kind="action",
        path="base/action/Go.action",
        sections=((InterfaceField(name=f"goal{word}", type="int32", line=1),), (), ()),
    )
    return Input(
        report=report(word, results),
        workspace=Workspace(Path("/nowhere"), packages, listed, Texts({**SOURCE, CODE: f"{SOURCE[CODE]}// {word}\n"})),
        configurations=configurations if configurations is not None else (configuration(word), configuration(name="tool/alone")),
        properties=properties(word),
        verdicts=(verdicts(word),),
        broadcasts={one.name: broadcasts(one, word) for one in (configurations or (configuration(word),))[:1]},
        builds={"base": Build(package="base", interfaces=(go,))},
        measurements=[Measurement("base", CODE, n, "", f"f{n}{word}", "cyclomatic-complexity", float(n % 17 + 1)) for n in range(1, 80)],
        limits=(Limit("max-cyclomatic-complexity-10", "function", "cyclomatic-complexity", 10),),
        name=f"fleet{word}",
        history=(("2024-01-01-00-00", 100, 10, 7, 3, 2, 2.5, 12), ("2024-02-01-00-00", 1200, 20, 5, 2, 1, 2.25, 11)),
        date="2024-01-01 00:00 UTC",
    )  # fmt: skip


def checked(made: Input) -> dict[str, Any]:
    """The data of *made* as JSON gives it back, held against the schema."""
    data: dict[str, Any] = json.loads(json.dumps(data_of(made)))
    jsonschema.validate(data, SCHEMA)
    return data


def written(made: Input) -> str:
    return page(f"{made.name} – haros-ci", data_of(made))


class Parts(HTMLParser):
    """What an HTML parser sees: the tags with their attributes, and the text of scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.texts: dict[str, list[str]] = {}
        self._in = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        self._in = tag
        self.texts.setdefault(tag, []).append("")

    def handle_endtag(self, tag: str) -> None:
        self._in = ""

    def handle_data(self, data: str) -> None:
        if self._in:
            self.texts[self._in][-1] += data


def samples() -> Any:
    """The reports of tests/report, hostile ones among them."""
    path = Path(__file__).resolve().parent.parent / "report" / "report_samples.py"
    spec = importlib.util.spec_from_file_location("report_samples_of_pages", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
