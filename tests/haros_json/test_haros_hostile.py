# SPDX-License-Identifier: Apache-2.0
"""Whatever stands in the workspace, the files keep to the contract, to their directory, and to text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import PurePosixPath
from typing import Any

import haros_kit as kit
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from haros_ci.haros_json.documents import documents
from haros_ci.haros_json.texts import link
from haros_ci.model.architecture import Condition, Parameter
from haros_ci.model.location import Location
from haros_ci.model.manifest import Manifest
from haros_ci.model.measurement import Measurement
from haros_ci.model.package import Dependency, Package
from haros_ci.results.rule import Rule

EVIL = "<img src=x onerror=alert(1)>\"'&\x00\x1b[2J\u202e\ud800"
TEXTS = st.one_of(
    st.sampled_from(("..", "../../x", "/", "", EVIL, "a" * 5000, "constructor", "__proto__", "</script>", "a\nb")),
    st.text(max_size=30),
)
#: What the visualizer does not put into its pages: data alone.
DATA = ("value", "query", "id", "rule", "properties", "assumptions", "uid", "node_uid", "violations")
LAST = re.compile(r"<br>")


def strings(data: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """Every text with the key that it is under."""
    if isinstance(data, str):
        yield key, data
    elif isinstance(data, dict):
        for name, item in data.items():
            yield from strings(item, name if name not in DATA and key not in DATA else "value")
    elif isinstance(data, list):
        for item in data:
            yield from strings(item, key)


def hold(one: Any) -> None:
    """The whole of what is promised, of the files that *one* gives."""
    texts = documents(one)
    found = kit.read(texts)
    for path in texts:
        pure = PurePosixPath(path)
        assert not pure.is_absolute() and ".." not in pure.parts and len(pure.parts) <= 4
        assert all(part and len(part.encode()) < 250 and part[0] not in "-." for part in pure.parts)
        assert "\0" not in path and "\\" not in path
    assert len({path.casefold() for path in texts}) == len(texts)
    for path, data in found.items():
        for key, text in strings(data):
            if key != "value":
                assert not re.search("[<>\"']|&(?!(amp|lt|gt|quot|#x27);)", text.replace("<br>", "")), (path, key, text)
                assert not re.search("[\x00-\x08\x1b\u202e]", text), (path, key)
    project = next(iter(found["projects.json"]))
    home = project["id"]
    rules = {rule["id"] for rule in found[f"{home}/rules.json"]}
    assert project["packages"] == [one["id"] for one in found[f"{home}/packages.json"]]
    for id in project["packages"]:
        assert {issue["rule"] for issue in found[f"{home}/compliance/source/{id}.json"]} <= rules
        assert f"{home}/metrics/{id}.json" in found
    for system in found[f"{home}/configurations.json"]:
        assert {issue["rule"] for issue in found[f"{home}/compliance/runtime/{system['id']}.json"]} <= rules
        uids = [one["uid"] for kind in ("nodes", "topics", "services", "parameters") for one in system[kind]]
        assert len(set(uids)) == len(uids)
        said = [text for key in ("links", "queries") for text in strings_of_uids(system[key])]
        assert set(said) <= set(uids)


def strings_of_uids(data: Any) -> Iterator[str]:
    if isinstance(data, dict):
        yield from (value for key, value in data.items() if key.endswith("uid"))
        for item in data.values():
            yield from strings_of_uids(item)
    elif isinstance(data, list):
        for item in data:
            yield from strings_of_uids(item)


@settings(max_examples=25, deadline=None)
@given(st.data())
def test_any_text_anywhere(data: st.DataObject) -> None:
    def draw() -> str:
        return data.draw(TEXTS)

    packages = (
        Package(draw(), "base", version=draw(), dependencies=(Dependency(draw(), "depend"),)),
        Package(draw(), "extra", is_metapackage=True),
    )
    made = kit.system(draw(), topic=draw(), node=draw())
    condition = Condition(draw(), draw(), Location(draw(), 1))
    node = replace(
        made.nodes[2],
        arguments=draw(),
        package=draw(),
        type=draw(),
        conditions=(condition,),
        remaps=((draw(), draw()),),
    )
    parameter = Parameter(
        name=draw(), type=draw(), value=data.draw(st.one_of(TEXTS, st.floats(), st.just({"a": [EVIL]})))
    )
    system = replace(
        made, nodes=(*made.nodes[:2], node), parameters=(*made.parameters, parameter), launch=(draw(), draw())
    )
    rule = Rule(draw() or "r", draw(), tags=(draw(),), aliases=(draw(),))
    results = [
        kit.result(
            rule, data.draw(st.sampled_from(("evil", "haros-ci", ""))), draw(), draw(), scope=draw(), also=(draw(),)
        ),
        replace(kit.mismatch(system.name), message=draw(), subject=(draw(), node.name)),
    ]
    measurement = Measurement(
        draw(), data.draw(st.sampled_from(("", "base/src/base.cpp"))), 1, draw(), draw(), "ploc", 1.0
    )
    texts = Manifest(description=draw(), authors=(draw(),), website=draw(), repository=draw())
    project = {
        "project": draw(),
        "repositories": {draw(): {}},
        "configurations": {system.name: {"environment": {draw(): 1}}},
    }
    hold(
        kit.given(
            results,
            systems=(system, replace(system, launch=())),
            packages=packages,
            measurements=(measurement,),
            manifests={"base": texts},
            project=project,
        )
    )


def test_markup_of_a_workspace_is_shown_as_text() -> None:
    package = Package("base", "base")
    one = kit.given(
        [kit.result(kit.BRACES, "cpplint", f"Use {EVIL}")],
        systems=(kit.system("a", topic="/<b>", node="/<script>"),),
        packages=(package,),
        manifests={"base": Manifest(description=EVIL)},
    )
    hold(one)
    found = kit.made(one)
    assert "&lt;img src=x onerror=alert(1)&gt;&quot;&#x27;&amp;" in found["compliance/source/base.json"][0]["comment"]
    assert found["configurations.json"][0]["topics"][0]["name"] == "/&lt;b&gt;"
    assert found["packages.json"][0]["description"].startswith("&lt;img")


@pytest.mark.parametrize(
    "address",
    [
        "javascript:alert(1)",
        "JavaScript:alert(1)",
        "data:text/html,x",
        "//example.org",
        "http://",
        "",
        "http://a b",
        "http://[::1",
        "java\nscript:alert(1)",
    ],
)
def test_no_link_but_of_the_web(address: str) -> None:
    assert link(address) is None


@pytest.mark.parametrize("address", ["http://wiki.ros.org/kobuki", "https://example.org/a(b)?c=d"])
def test_links_of_the_web_stay(address: str) -> None:
    assert link(f" {address} ") == address


def test_much_of_everything_is_quick_enough() -> None:
    names = [f"/n{n}" for n in range(300)]
    made = kit.system("a")
    nodes = tuple(replace(made.nodes[0], name=name) for name in names)
    results = [kit.result(kit.BRACES, "cpplint", f"m{n}") for n in range(3000)]
    found = kit.made(kit.given(results, systems=(replace(made, nodes=nodes),)))
    assert len(found["configurations.json"][0]["links"]["publishers"]) == 300
    assert len(found["compliance/source/base.json"]) == 3000
