# SPDX-License-Identifier: Apache-2.0
"""Runs written down as values, and what HAROS's exporter would make of them as a schema (haros_contract.json)."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import jsonschema

from haros_ci.haros_json.documents import Input, documents
from haros_ci.model.architecture import Architecture, Condition, Configuration, Endpoint, Node, Parameter, Unknown
from haros_ci.model.location import Location
from haros_ci.model.package import Dependency, Package, SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.results.result import Report, Result, Run, Tool
from haros_ci.results.rule import Level, Rule

CONTRACT = json.loads(Path(__file__).with_name("haros_contract.json").read_text(encoding="utf-8"))
HERE = Location("base/src/base.cpp", 7, 3)
THERE = Location("base/launch/base.launch", 2, 5)

COMPLEX = Rule(
    "max-cyclomatic-complexity-15", "At most 15.", tags=("metrics", "kth"), aliases=("max_cyclomatic_complexity_15",)
)
BRACES = Rule(
    "whitespace/braces",
    "Braces.",
    tags=("code-standards", "formatting"),
    aliases=("haros_plugin_cpplint:opening_curly_brace", "haros_plugin_cpplint:whitespace_open_brace"),
)
UNUSED = Rule("unused-import", "An import is used.", tags=("code-standards",), aliases=("haros_plugin_pylint:warning",))
DEAD = Rule("unreachable", "Code is reached.", tags=("code-standards",), aliases=("haros_plugin_pylint:warning",))
MISMATCH = Rule("topic-type-mismatch", "Both ends agree.", tags=("architecture",), aliases=("G06",))
QUERY = Rule("user:crowded", "One publisher", tags=("query",))
DOCUMENTED = (
    ("metrics", COMPLEX),
    ("cpplint", BRACES),
    ("pylint", UNUSED),
    ("pylint", DEAD),
    ("haros-ci", MISMATCH),
)
CROWDED = {
    "project": "Fleet",
    "rules": {
        "crowded": {
            "name": "One publisher",
            "description": "d",
            "tags": ["mine"],
            "scope": "configuration",
            "query": "topics[len(self.publishers) > 1]",
        }
    },
}


class Texts:
    """A reader of files that stand in the test."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self.texts = texts

    def text(self, path: str) -> str:
        return self.texts.get(path, "")

    def head(self, path: str, length: int) -> bytes:
        return b""


def end(kind: str, name: str, type: str | None = "std_msgs/String", **more: Any) -> Endpoint:
    given = {"location": HERE, "original_name": name, **more}
    return Endpoint(kind=kind, name=name, type=type, **given)


def system(name: str = "base/launch/base.launch", *, topic: str = "/chatter", node: str = "/talker") -> Configuration:
    """Two talkers and a listener; a conditional service, an action, parameters, a name that is not known."""
    listener = Node(
        name="/listener",
        kind="nodelet",
        package="base",
        type="Listener",
        remaps=(("/in", topic),),
        location=THERE,
        endpoints=(
            end("subscribers", topic, "std_msgs/Int32", queue_size=5),
            end("subscribers", "/ns/?", unknowns=(Unknown("name", "a loop", HERE),)),
            end("servers", "/reset", "std_srvs/Empty", conditions=(Condition("if", "x < 0", HERE),)),
            end("action_servers", "/dock", "base/Dock"),
            end("getters", "/listener/rate", "double", value=5.0),
            end("publishers", "/rosout", implicit=True),
        ),
    )
    talkers = tuple(
        Node(
            name=name,
            kind="node",
            package="base",
            type="talker",
            arguments="--fast",
            location=THERE,
            endpoints=(
                end("publishers", topic, queue_size=10, latched=True),
                end("clients", "/reset", None),
                end("action_clients", "/dock", "base/Dock"),
                end("setters", "/listener/rate", "double", value=2.0),
            ),
        )
        for name in (node, "/other")
    )
    rate = Parameter(name="/listener/rate", type="double", value=1.5, location=THERE)
    return Configuration(name=name, launch=("base/launch/base.launch",), nodes=(*talkers, listener), parameters=(rate,))


def result(rule: Rule, tool: str, message: str = "Said.", path: str = "base/src/base.cpp", **more: Any) -> Result:
    return Result(tool, rule.id, Level.WARNING, message, more.pop("location", Location(path, 7, 3)), **more)


def mismatch(graph: str = "base/launch/base.launch") -> Result:
    edges = (("node:/talker", "topic:/chatter"), ("topic:/chatter", "node:/listener"))
    return result(
        MISMATCH, "haros-ci", "Types differ.", subject=("/chatter", "/listener", "/talker"), graph=graph, edges=edges
    )


def runs(results: Iterable[Result]) -> tuple[Run, ...]:
    """A run for each tool of *results*, with the rules that they refer to."""
    made = []
    rules = {rule.id: rule for rule in (COMPLEX, BRACES, UNUSED, DEAD, MISMATCH, QUERY)}
    results = tuple(results)
    for tool in sorted({one.tool for one in results}):
        own = tuple(one for one in results if one.tool == tool)
        known = tuple(rules[id] for id in sorted({one.rule for one in own}) if id in rules)
        made.append(Run(Tool(tool), rules=known, results=own))
    return tuple(made)


def given(
    results: Iterable[Result] = (),
    systems: Iterable[Configuration] | None = None,
    packages: Iterable[Package] | None = None,
    **more: Any,
) -> Input:
    """A workspace with the packages base and extra, and a script outside any."""
    if packages is None:
        depends = (
            Dependency("roscpp", "build_depend"),
            Dependency("extra", "exec_depend"),
            Dependency("gtest", "test_depend"),
        )
        packages = (Package("base", "base", version="1.0.0", dependencies=depends), Package("extra", "extra"))
    texts = {
        "base/src/base.cpp": "int a;\n\nint b;\n",
        "base/launch/base.launch": "<launch/>\n",
        "base/scripts/run.py": "pass\n",
        "base/msg/A.msg": "int32 a\n",
        "extra/package.xml": "<package/>\n",
        "tool.py": "pass\n",
    }
    kinds = {"cpp": "cpp", "launch": "launch", "py": "python", "msg": "interface", "xml": "package"}
    home = {one.path: one.name for one in packages}
    files = tuple(
        SourceFile(
            path, kinds[path.rpartition(".")[2]], len(text), "", home.get(path.partition("/")[0]), text.count("\n")
        )
        for path, text in sorted(texts.items())
    )
    rules = more.pop("documented", DOCUMENTED)
    project = more.pop("project", {})
    scopes = {"haros-ci:topic-type-mismatch": "configuration", "haros-ci:user:crowded": "configuration"}
    queries = {"haros-ci:user:crowded": "topics[len(self.publishers) > 1]"} if "rules" in project else {}
    return Input(
        report=Report(runs(results)),
        workspace=Workspace(Path("/ws"), tuple(packages), files, Texts(texts), **more.pop("workspace", {})),
        architecture=Architecture(
            configurations=(system(),) if systems is None else tuple(systems), packages=tuple(packages)
        ),
        documented=rules,
        scopes=scopes,
        queries=queries,
        project=project,
        **more,
    )


def read(texts: Mapping[str, str]) -> dict[str, Any]:
    """The files as data, each held against the contract."""
    found = {path: json.loads(text) for path, text in texts.items()}
    for path, data in found.items():
        validator = jsonschema.Draft202012Validator({**CONTRACT, "$ref": f"#/$defs/{kind(path)}"})
        faults = [f"{path}{one.json_path[1:]}: {one.message[:200]}" for one in validator.iter_errors(data)]
        assert not faults, faults[:3]
    return found


def made(one: Input) -> dict[str, Any]:
    """The files of *one* as data, by their path below the project's directory."""
    found = read(documents(one))
    return {path.partition("/")[2] or path: data for path, data in found.items()}


def kind(path: str) -> str:
    """The definition of the contract that the file at *path* is held against."""
    for part, name in (
        ("/compliance/source/", "source"),
        ("/compliance/runtime/", "runtime"),
        ("/metrics/", "measurements"),
    ):
        if part in path:
            return name
    return path.rpartition("/")[2].removesuffix(".json")
