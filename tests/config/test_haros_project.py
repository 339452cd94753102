# SPDX-License-Identifier: Apache-2.0
"""HAROS project files work as they are."""

from __future__ import annotations

import pytest

from haros_ci.config.haros import METRIC_RULES
from haros_ci.config.project import read_project
from haros_ci.config.settings import LinterSettings
from haros_ci.errors import UserError

FULL = """\
%YAML 1.1
# a robot of two packages
---
project: Rover
packages:
    - rover_driver
    - rover_bringup
repositories:
    rover:
        type: git
        url: https://example.org/rover.git
        version: main
        packages: [rover_driver]
configurations:
    short: [rover_bringup/launch/a.launch]
    long:
        launch:
            - rover_bringup/launch/b.launch
        hints:
            nodes:
                /base: {node_type: rover_driver/driver, remaps: {/a: /b}}
        hpl:
            properties: ["globally: no /odom"]
        user_data:
            haros_plugin_pyflwor:
                - name: One Publisher
                  query: "topics[len(self.publishers) > 1]"
nodes:
    rover_driver/driver:
        hpl: {properties: []}
    rover_driver/other:
rules:
    no_empty:
        name: No Empty
        description: No topic is Empty.
        tags: [code-standards]
        query: "topics[self.type = 'std_msgs/Empty']"
analysis:
    ignore:
        tags: [formatting, copyright]
        rules:
            - haros_plugin_cpplint:opening_curly_brace
            - user:no_empty
        metrics: [cyclomatic_complexity]
        files: ["src/gen/*", "*/vendor/*", "/x", "?y", "[ab]*"]
"""


def test_every_key() -> None:
    read = read_project(FULL.encode(), "haros.yaml")
    assert read.values["packages"] == ("rover_driver", "rover_bringup")
    assert read.values["policy"].ignore == (
        "formatting",
        "copyright",
        "haros_plugin_cpplint:opening_curly_brace",
        "user:no_empty",
        "max_cyclomatic_complexity_10",
        "max_cyclomatic_complexity_15",
    )
    assert read.values["ignore_files"] == ("*/src/gen/*", "*/vendor/*", "/x", "?y", "[ab]*")
    assert read.values["project"]["configurations"]["long"]["hints"]["nodes"]["/base"]["remaps"] == {"/a": "/b"}
    assert read.notes == ("haros.yaml: repositories are never cloned: 'rover'; check them out into the workspace",)
    assert ("haros formatting", "haros.yaml:40") in read.origins


def test_the_same_keys_in_our_own_file() -> None:
    assert read_project(FULL.encode(), ".haros-ci.yaml").values == read_project(FULL.encode(), "haros.yaml").values


@pytest.mark.parametrize(
    ("text", "notes"),
    [
        ("", []),
        ("packages:", []),
        ("packages: []", []),
        ("packages: rover", []),
        ("packages: {rover: , base: }", []),
        ("project: 7", []),
        ("configurations: {}\nnodes: {}\nrules: {}\nrepositories: {}\nanalysis: {}", []),
        ("configurations:\nnodes:\nrules:\nrepositories:\nanalysis:", []),
        ("analysis: {ignore: {}}", []),
        ("analysis: {ignore: {tags: [], rules: , metrics: [ploc, sloc], files: ''}}", []),
        ("analysis: {ignore: {tags: formatting}}", []),
        ("configurations: {a: [p/x.launch], b: {launch: [p/y.launch], user_data: {x: [1]}}}", []),
        ("configurations: {a: {launch: [p/x.launch], hints: {fix: {advertise@name1: /a}}}}", []),
        ("configurations: {a: {launch: [p/x.launch], hints: , hpl: , user_data: , args: , environment: }}", []),
        ("configurations: {a: {launch: [p/x.launch], hpl: {}}}\nnodes: {p/x: {hpl: {}}, p/y: {fix: {}}}", []),
        ("configurations: {a: {launch: [p/x.launch], hpl: {properties: [x], files: [y]}}}", []),
        ("nodes: {p/x: {hpl: {assumptions: [x]}}}", []),
        (
            "configurations: {a: {launch: [p/x.launch], hint: {}, launch_commands: [x]}}",
            [":1: key 'hint' has no effect; did you mean 'hints'?", ":1: key 'launch_commands' has no effect"],
        ),
        (
            "repositories:" + "".join(f"\n  r{n:02}: {{type: a, url: b, version: c, packages: d}}" for n in range(12)),
            [
                ": repositories are never cloned: 'r00', 'r01', 'r02', 'r03', 'r04', 'r05', 'r06', 'r07', 'r08', 'r09' "
                "and 2 more; check them out into the workspace"
            ],
        ),
        ("environment: null", []),
        ("plugin_blacklist: []", []),
        (
            "workspace: /ws\nenvironment: copy\ncpp: {parser_lib: /usr/lib}",
            [": of no use here, where neither ROS nor a build is needed: workspace, environment, cpp"],
        ),
        ("version: 3", [":1: key 'version' has no effect"]),
        ("package: [a]", [":1: key 'package' has no effect; did you mean 'packages'?"]),
        ("exlude: [a]", [":1: key 'exlude' has no effect; did you mean 'exclude'?"]),
        ("7: x", [":1: key '7' has no effect"]),
        ("analysis: {ignored: {}}", [":1: key 'ignored' has no effect; did you mean 'ignore'?"]),
        ("analysis: {ignore: {tag: [x]}}", [":1: key 'tag' has no effect; did you mean 'tags'?"]),
        (
            "analysis: {ignore: {metrics: [ploc, cyclomatic_complexty]}}",
            [":1: no metric 'cyclomatic_complexty' here; did you mean 'cyclomatic_complexity'?"],
        ),
        ("plugin_blacklist: [haros_plugin_mc]", [":1: no tool here stands for the plug-in 'mc'"]),
        ("project: a\nproject: b", [":2: key 'project' stands here again, first on line 1; the last one counts"]),
    ],
)
def test_accepted(text: str, notes: list[str]) -> None:
    assert list(read_project(text.encode(), "haros.yaml").notes) == [f"haros.yaml{note}" for note in notes]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("packages: [[a]]", "1: an entry of 'packages' must be text, not a list"),
        ("configurations: [a]", "1: 'configurations' must be a map, not a list"),
        ("configurations: {a: text}", "1: configuration 'a' must be a map, not a text"),
        ("configurations:\n  a:\n    hints: {}", "2: configuration 'a' has no 'launch'"),
        ("configurations: {a: {launch: p/x.launch}}", "1: 'launch' must be a list, not a text"),
        ("configurations:\n  a:\n    - x.launch", "3: a launch file is named as package/path"),
        ("configurations: {a: [3]}", "1: a launch file is named as package/path"),
        (
            "configurations: {a: {launch: [p/x], hints: [b]}}",
            "1: 'hints' of configuration 'a' must be a map, not a list",
        ),
        ("nodes: [a]", "1: 'nodes' must be a map, not a list"),
        ("nodes: {driver: {a: b}}", "1: node 'driver' must be named as package/executable"),
        ("nodes: {a/b/c: {a: b}}", "1: node 'a/b/c' must be named as package/executable"),
        ("nodes: {a/b: [c]}", "1: node 'a/b' must be a map, not a list"),
        ("rules: [a]", "1: 'rules' must be a map, not a list"),
        ("rules: {a: {name: n}}", "1: 'a' in 'rules' lacks description, tags"),
        ("repositories: {a: {type: git, url: u}}", "1: 'a' in 'repositories' lacks version, packages"),
        ("analysis: [a]", "1: 'analysis' must be a map, not a list"),
        ("analysis: {ignore: [a]}", "1: 'ignore' must be a map, not a list"),
        ("analysis: {ignore: {tags: [{a: b}]}}", "1: an entry of 'tags' must be text, not a map"),
        ("plugin_blacklist: [[a]]", "1: an entry of 'plugin_blacklist' must be text, not a list"),
        ("- a", "1: a project file must be a map, not a list"),
    ],
)
def test_refused_as_by_haros(text: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        read_project(text.encode(), "haros.yaml")
    assert caught.value.message == f"haros.yaml:{message}"


@pytest.mark.parametrize(
    ("text", "enabled"),
    [
        ("plugin_blacklist: [haros_plugin_cpplint, radon, pbt_gen]", {"cpplint": False, "radon": False}),
        ("plugin_blacklist: [radon]\nlinters: {radon: true}", {"radon": True}),
        ("plugin_blacklist: lizard", {"lizard": False}),
        ("plugin_blacklist: []", {}),
    ],
)
def test_blacklist(text: str, enabled: dict[str, bool]) -> None:
    linters = read_project(text.encode(), "haros.yaml").values["linters"]
    assert linters == tuple((tool, LinterSettings(enabled=on)) for tool, on in sorted(enabled.items()))


def test_notes_have_an_end() -> None:
    text = "".join(f"key{i}: 1\n" for i in range(5000))
    notes = read_project(text.encode(), "haros.yaml").notes
    assert len(notes) == 21
    assert notes[-1] == "haros.yaml: and 4980 more notes"


def test_every_haros_metric_has_its_row() -> None:
    assert len(METRIC_RULES) == 21
    assert (
        sum(map(len, METRIC_RULES.values())) == len({rule for rules in METRIC_RULES.values() for rule in rules}) == 27
    )
