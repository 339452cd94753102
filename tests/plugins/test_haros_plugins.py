# SPDX-License-Identifier: Apache-2.0
"""Plug-ins of HAROS run as HAROS runs them, away from us: every hook, every method, and everything that goes wrong."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from commandline import write
from plugin_cases import run, workspace

from haros_ci.config.load import load
from haros_ci.errors import UserError
from haros_ci.haros_plugins.chosen import chosen
from haros_ci.haros_plugins.manifest import read
from haros_ci.haros_plugins.views import CLASSES, Model
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node, Parameter
from haros_ci.model.location import Location
from haros_ci.model.package import Package, SourceFile
from haros_ci.query.queries import Scenes

DATA = Path(__file__).parent / "testdata"
DEMO = "haros_plugin_demo"
#: No linter of ours is started.
QUICK = ("--profile", "architecture", "--no-cache", "--fail-on", "never", "--trust-config")


def plugin(library: Path, name: str, code: str, manifest: str = "") -> Path:
    """A plug-in *name* with one rule, *odd*, in *library*."""
    head = f"name: {name}\nversion: 1\nlanguages: [python]\nrules: {{odd: {{name: Odd, scope: file, description: D, tags: []}}}}\n"
    write(library / name, {"__init__.py": "", "plugin.yaml": manifest or head, "plugin.py": code})
    return library


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, dict[str, object], dict[str, object], Path]:
    """What the fixture's plug-in says, in text, SARIF and the files that it exports."""
    home = tmp_path_factory.mktemp("demo")
    root = workspace(home / "ws")
    write(root, {"tabs.cpp": "// a comment\n\tint x = 1;\n", "setup.cfg": "[a]\n"})
    done = run(
        "check", *QUICK, "--plugin", DEMO, "--plugin-export", str(home / "out"), "--output", "text", "--output", f"sarif={home / 'o'}",
        cwd=root, path=DATA,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "NOISE" not in done.stdout
    made = [json.loads((home / "out" / DEMO / name).read_text()) for name in ("log.json", "processed.json")]
    assert sorted(path.name for path in (home / "out").rglob("*")) == [DEMO, "log.json", "processed.json"]
    runs = {each["tool"]["driver"]["name"]: each for each in json.loads((home / "o").read_text())["runs"]}
    return done.stdout, made[0], {**made[1], "run": runs[DEMO]}, root


def test_every_hook_is_called_in_haros_order(demo: tuple[str, dict[str, object], dict[str, object], Path]) -> None:
    assert demo[1]["calls"] == [
        "pre_analysis",
        "file_analysis file:demo/lamp.py",
        "file_analysis file:demo/tabs.cpp",
        "package_analysis package:demo",
        "configuration_analysis configuration:demo/lamp.py",
        "post_analysis",
    ]
    assert not Path(str(demo[1]["cwd"])).exists()  # a directory of its own, gone afterwards


def test_its_results_are_a_run(demo: tuple[str, dict[str, object], dict[str, object], Path]) -> None:
    sarif = demo[2]["run"]
    assert isinstance(sarif, dict)
    found = [
        (each["ruleId"], (p := each["locations"][0]["physicalLocation"])["artifactLocation"]["uri"], p["region"]["startLine"], each["message"]["text"])
        for each in sarif["results"]
    ]  # fmt: skip
    assert found == [
        ("bad_metric", "lamp.py", 1, "8 lines."),
        ("global_topic", "lamp.py", 9, found[1][3]),
        ("lonely_topic", "lamp.py", 9, "/batteryState; in demo/lamp.py."),
        ("lonely_topic", "lamp.py", 9, "by its publisher; in demo/lamp.py."),
        ("many_files", "package.xml", 1, f"{found[4][3].split()[0]} files."),
        ("bad_metric", "tabs.cpp", 1, "1 lines."),
        ("tab", "tabs.cpp", 2, "a tab in <b>tabs.cpp</b>."),
    ]
    assert sarif["tool"]["driver"]["version"] == "0.3"
    assert sarif["invocations"][0]["executionSuccessful"] is True


def test_what_it_logs_is_told(demo: tuple[str, dict[str, object], dict[str, object], Path]) -> None:
    for text in ("be warned", "an error", "1000 is no value of the metric tabs (least 0, most 10) and is left out"):
        assert text in demo[0]
    assert "a file of its own" not in demo[0]  # debug is said to nobody
    assert "no_such_rule" not in demo[0] and "dropped" not in demo[0]


def test_processing_sees_the_data_of_all(demo: tuple[str, dict[str, object], dict[str, object], Path]) -> None:
    violations, metrics = demo[2]["violations"], demo[2]["metrics"]
    assert isinstance(violations, list) and isinstance(metrics, list)
    assert [f"{DEMO}:tab", "file:demo/tabs.cpp", 2, "a tab<br>in <b>tabs.cpp</b>"] in violations
    assert [f"{DEMO}:lonely_topic", "configuration:demo/lamp.py", None, "/batteryState"] in violations
    assert [f"{DEMO}:tabs", "file:demo/tabs.cpp", 1] in metrics  # its own, and then those of haros-ci
    assert ["ploc", "file:demo/tabs.cpp", 1] in metrics
    assert any(metric == f"{DEMO}:files" for metric, _, _ in metrics)
    assert any(metric == f"{DEMO}:ends" for metric, _, _ in metrics)


def test_its_rules_are_rules(tmp_path: Path) -> None:
    done = run("explain", f"{DEMO}:tab", "--full", "--plugin", DEMO, cwd=tmp_path, path=DATA)
    assert "No tabs." in done.stdout and "Tags: haros, code-standards, formatting" in done.stdout
    done = run("rules", "--json", "--plugin", DEMO, cwd=tmp_path, path=DATA)
    ids = {row["id"] for row in json.loads(done.stdout) if row["id"].startswith(DEMO)}
    assert {f"{DEMO}:tab", f"{DEMO}:max_file_length_400"} <= ids


def test_ignored_rules_are_not_reported(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    write(root, {"tabs.cpp": "\tint x;\n\tint y;  // haros: ignore[haros_plugin_demo:tab] it may\n"})
    ignored = f"{DEMO}:many_files,{DEMO}:lonely_topic,bad_metric,global_topic"
    done = run("check", *QUICK, "--plugin", DEMO, "--ignore", ignored, "--statistics", cwd=root, path=DATA)
    assert done.stdout.count(f"[{DEMO}:") == 1 and "tabs.cpp:1" in done.stdout


def test_without_trust_nothing_of_it_runs(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    plugin(tmp_path / "lib", "haros_plugin_loud", "import os\nos.system('echo LOUD >&2')\n")
    quick = [each for each in QUICK if each != "--trust-config"]
    for named in (("--plugin", "haros_plugin_loud"), ("--plugin", "haros_plugin_*"), ("--plugin-whitelist", "loud")):
        done = run("check", *quick, *named, cwd=root, path=tmp_path / "lib")
        assert "HAROS plug-ins do not run without --trust-config" in done.stdout
        assert done.returncode == 0 and "LOUD" not in done.stdout + done.stderr


# -- which ones ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("names", "white", "black", "wanted"),
    [
        (("haros_plugin_a",), (), (), "a"),
        (("haros_plugin_b", "haros_plugin_a"), (), (), "ab"),
        (("haros_plugin_*",), (), (), "abc"),
        (("haros_plugin_*",), (), ("b",), "ac"),
        (("haros_plugin_*",), (), ("haros_plugin_b", "unheard_of"), "ac"),
        ((), ("a", "haros_plugin_c"), (), "ac"),
        (("haros_plugin_*",), ("a",), ("a",), "a"),  # as in HAROS the whitelist wins
        (("haros_plugin_b",), ("a",), (), "ab"),
        (("haros_plugin_b",), (), ("b",), ""),
        ((), (), ("b",), ""),
    ],
)
def test_lists_choose(
    names: tuple[str, ...], white: tuple[str, ...], black: tuple[str, ...], wanted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    for letter in "abc":
        plugin(tmp_path / "lib", f"haros_plugin_{letter}", "")
    plugin(tmp_path / "ws", "haros_plugin_evil", "1 / 0")
    monkeypatch.setattr("sys.path", [str(tmp_path / "lib"), str(tmp_path / "ws"), *sys.path])
    found = chosen(names, white, black, tmp_path / "ws")
    assert [each.name for each in found] == [f"haros_plugin_{letter}" for letter in wanted]


def test_a_project_file_has_lists_too(tmp_path: Path) -> None:
    write(
        tmp_path,
        {".haros-ci.yaml": "plugins: [a_b, haros_plugin_c]\nplugin_whitelist: [d]\nplugin_blacklist: [pylint]\n"},
    )
    settings = load(tmp_path, trust_config=True)
    assert (settings.plugins, settings.haros_plugins) == (("a_b",), ("haros_plugin_c",))
    assert (settings.plugin_whitelist, settings.plugin_blacklist) == (("d",), ("pylint",))
    settings = load(tmp_path)
    assert not (settings.plugins or settings.haros_plugins or settings.plugin_whitelist)
    assert any("HAROS plug-ins run only with --trust-config" in note for note in settings.notes)


@pytest.mark.parametrize(
    ("names", "white"),
    [
        (("haros_plugin_zz",), ()),
        (("haros_plugin_*",), ()),
        ((), ("zz",)),
        (("haros_plugin_evil",), ()),
        ((), ("evil",)),
    ],
)
def test_one_that_is_not_there_is_refused(
    names: tuple[str, ...], white: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plugin(tmp_path / "ws", "haros_plugin_evil", "1 / 0")
    monkeypatch.setattr("sys.path", [str(tmp_path / "ws"), *sys.path])
    with pytest.raises(UserError):
        chosen(names, white, (), tmp_path / "ws")


BAD = [
    ("name: haros_plugin_other\nversion: 1\n", "", "has not both"),
    ("name: haros_plugin_bad\n", "", "has not both"),
    ("- 1\n", "", "has not both"),
    ("a: [\n", "", "is no YAML"),
    ("a: !!python/object/apply:os.system [echo]\n", "", "is no YAML"),
    ("name: haros_plugin_bad\nversion: 1\nrules: [a]\n", "", "'rules' of plugin.yaml is no map"),
    ("name: haros_plugin_bad\nversion: 1\nmetrics: {a: {min: low}}\n", "", "'min' of the metric a is no number"),
    ("name: haros_plugin_bad\nversion: 1\nlanguages: cpp\n", "", "'languages' of plugin.yaml is no list"),
    ("", "def f():\n    print 'two'\n", "plugin.py:2 is no Python 3"),
    ("", "try:\n    pass\nexcept E, e:\n    pass\n", "plugin.py:3 is no Python 3"),
]  # fmt: skip


@pytest.mark.parametrize(("manifest", "code", "said"), BAD, ids=[said for _, _, said in BAD])
def test_a_malformed_one_is_refused(
    manifest: str, code: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.path", [str(plugin(tmp_path / "lib", "haros_plugin_bad", code, manifest)), *sys.path])
    with pytest.raises(UserError, match="plug-in haros_plugin_bad: ") as raised:
        read("haros_plugin_bad", tmp_path / "ws")
    assert said in raised.value.message


def test_a_manifest_is_read(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("sys.path", [str(DATA), *sys.path])
    found = read(DEMO, tmp_path)
    assert sorted(found.rules) == ["bad_metric", "global_topic", "lonely_topic", "many_files", "tab"]
    assert sorted(found.queries) == ["global_topic"]
    assert (found.metrics["tabs"].maximum, found.metrics["files"].minimum, found.metrics["ends"].minimum) == (
        10,
        0,
        None,
    )
    assert {"file_analysis", "post_process"} <= found.hooks
    assert found.all_rules()["max_file_length_400"].help != "A shared rule stays as it is."


# -- trouble ------------------------------------------------------------------------------------------------------

SAYS = "    iface.report_violation('odd', 'kept', line=1)\n"
HOOK = "def file_analysis(iface, scope):\n" + SAYS
FAILING = {
    "raises": (HOOK + "    1 / 0\n", "failed: ZeroDivisionError: division by zero (plugin.py:3)"),
    "exits": (HOOK + "    raise SystemExit(0)\n", "failed: SystemExit: 0"),
    "leaves": (HOOK + "    import os; os._exit(0)\n", "crashed: it ended with 0"),
    "killed": (HOOK + "    import os; os.kill(os.getpid(), 9)\n", "crashed: it was ended by signal 9"),
    "stuck": (HOOK + "    while True: pass\n", "was stopped after 2 s"),
    "unimportable": ("import no_such_module_of_ours\n", "cannot be imported: ModuleNotFoundError"),
    "nowhere": (
        HOOK + "    iface.report_violation('odd', 'm', scope=3)\n",
        "failed: AnalysisScopeError: invalid scope",
    ),
    "runtime": (HOOK + "    iface.report_runtime_violation('odd', 'm')\n", "must provide a Configuration scope"),
    "late": (HOOK + "def post_process(iface): iface.report_violation('odd', 'm')\n", "must provide a scope"),
}


def test_what_goes_wrong_is_trouble_of_its_own(tmp_path: Path) -> None:
    root = workspace(tmp_path / "ws")
    for name, (code, _) in FAILING.items():
        plugin(tmp_path / "lib", f"haros_plugin_{name}", code)
    plugin(tmp_path / "lib", "haros_plugin_zz_sound", HOOK)
    write(root, {".haros-ci.yaml": "linters: {haros_plugin_stuck: {timeout: 2}}\n"})
    done = run("check", *QUICK, "--plugin", "haros_plugin_*", "--output", "json", cwd=root, path=tmp_path / "lib")
    assert done.returncode == 3
    report = json.loads(done.stdout)
    said = {note["tool"]: note["message"] for note in report["notifications"] if note.get("tool")}
    for name, (_, text) in FAILING.items():
        assert text in said[f"haros_plugin_{name}"], (name, said)
    kept = {each["tool"] for each in report["results"] if "kept" in each["message"]}
    assert kept == {f"haros_plugin_{name}" for name in FAILING if name != "unimportable"} | {"haros_plugin_zz_sound"}


def test_it_does_not_see_our_process(tmp_path: Path) -> None:
    code = (
        "import os, sys\ndef file_analysis(iface, scope):\n"
        "    import haros_ci.results.rule as rule; rule.Level = None\n"
        "    print('x' * 100); sys.stdin.read(); os.chdir('/')\n"
        "    assert 'SECRET' not in os.environ and '' not in sys.path\n"
        "    iface.report_violation('odd', 'kept \\x1b[31m', line=-1)\n"
        "    iface.report_violation('odd', 'far', line=10**9)\n"
    )
    plugin(tmp_path / "lib", "haros_plugin_nosy", code)
    root = workspace(tmp_path / "ws")
    write(root, {"no_such.py": "", "json.py": "raise SystemExit('EVIL')\n"})
    done = run("check", *QUICK, "--plugin", "haros_plugin_nosy", cwd=root, path=tmp_path / "lib", SECRET="1")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "lamp.py: warning: kept" in done.stdout and "\x1b" not in done.stdout and "EVIL" not in done.stdout


# -- the metamodel ------------------------------------------------------------------------------------------------

#: What reference texts on HAROS say that plug-ins read.
ATTRIBUTES = {
    "Configuration": "id name roslaunch environment nodes topics services parameters dependencies launch_commands hpl_properties "
    "hpl_assumptions user_attributes location",
    "ResourceCollection": "all enabled unresolved conditional counter",
    "NodeInstance": "rosname id name namespace conditions enabled disabled conditional unresolved location resource_type node launch "
    "argv remaps publishers subscribers servers clients reads writes type location2 rt_outlinks",
    "Topic": "type publishers subscribers types is_disconnected",
    "Service": "type server servers clients types is_disconnected",
    "Parameter": "type value node_scope reads writes launch types location2",
    "PublishLink": "node topic rosname type queue_size topic_name source_location location2 location configuration latched",
    "SubscribeLink": "node topic rosname type queue_size topic_name source_location location2 location configuration",
    "ServiceLink": "node service rosname type topic_name",
    "ClientLink": "node service rosname type topic_name",
    "ReadLink": "node parameter rosname type value param_name",
    "WriteLink": "node parameter rosname type value param_name",
    "RosName": "full own namespace given is_global is_private is_unresolved pattern",
    "Package": "id name project repository authors maintainers is_metapackage description version licenses website vcs_url bug_url path "
    "source_files nodes size lines sloc topological_tier file_count dependencies scope location bound_to",
    "SourceFile": "id name directory full_name dir_path path package language tree size lines sloc timestamp scope location",
    "Node": "id name package rosname nodelet_class is_nodelet language node_name source_files source_tree instances advertise subscribe "
    "service client read_param write_param hpl_properties hpl_assumptions timestamp variables",
    "AdvertiseCall": "name namespace type rostype full_name conditions control_depth repeats location location2 queue_size latched",
    "GetParamCall": "name namespace type rostype full_name conditions default_value",
}  # fmt: skip


def model() -> tuple[Model, Scenes]:
    """One node that has one end of each kind."""
    place = Location("demo/src/a.cpp", 3, 1)
    kinds = ("publishers", "subscribers", "servers", "clients", "getters", "setters")
    ends = tuple(
        Endpoint(kind=kind, name=f"/{kind}", original_name=f"/{kind}", type="demo/T", location=place) for kind in kinds
    )
    node = Node(name="/n", kind="node", package="demo", type="a", endpoints=ends)
    system = Configuration(
        name="all",
        launch=("demo/launch/a.launch",),
        nodes=(node,),
        parameters=(Parameter(name="/p", type="int", value=1),),
    )
    files = [
        SourceFile("demo/src/a.cpp", "cpp", 10, "0" * 64, "demo"),
        SourceFile("demo/setup.py", "setup", 10, "0" * 64, "demo"),
    ]
    found = Architecture(configurations=(system,), packages=(Package("demo", "demo"),))
    return Model("/place/ws"), Scenes(found, files, {})


def everything(models: Model, scenes: Scenes) -> dict[str, object]:
    """One view of each kind."""
    system = models.view(scenes.systems[0])
    package = models.view(scenes.world.packages["demo"])
    (node,) = system.nodes
    first = [
        system, system.nodes, node, package, *package.source_files[:1], *package.nodes, node.rosname,
        *(collection[0] for collection in (system.topics, system.services, system.parameters)),
        *(getattr(node, name)[0] for name in ("publishers", "subscribers", "servers", "clients", "reads", "writes")),
        package.nodes[0].advertise[0], package.nodes[0].read_param[0],
    ]  # fmt: skip
    return {type(each).__name__: each for each in first}


@pytest.mark.parametrize("kind", ATTRIBUTES)
def test_attributes_have_haros_names(kind: str) -> None:
    view = everything(*model())[kind]
    for name in ATTRIBUTES[kind].split():
        getattr(view, name)
    with pytest.raises(AttributeError):
        getattr(view, "no_such_thing")  # noqa: B009
    assert isinstance(view.to_JSON_object(), dict) and str(view)  # type: ignore[attr-defined]


def test_views_are_what_haros_has() -> None:
    models, scenes = model()
    system, package = models.view(scenes.systems[0]), models.view(scenes.world.packages["demo"])
    (node,) = system.nodes
    file = next(each for each in package.source_files if each.name == "a.cpp")
    assert (file.path, file.dir_path, file.full_name) == (
        "/place/ws/demo/src/a.cpp",
        "/place/ws/demo/src",
        "src/a.cpp",
    )
    assert package.path == "/place/ws/demo"
    assert {each.language for each in package.source_files} == {"cpp", "python"}
    assert isinstance(node, CLASSES["Resource"]) and isinstance(file, CLASSES["SourceObject"])
    assert isinstance(node.publishers[0], CLASSES["RosPrimitive"]) and not isinstance(node, CLASSES["RosPrimitive"])
    kept = node.publishers
    assert node.configuration is system and node.publishers is kept, "made once"
    assert "/n" in system.nodes and node in system.nodes and len(system.nodes) == 1 and "/m" not in system.nodes
    assert system.nodes.get("/n") == node and system.nodes.get("/m") is None
    assert node.rosname == "/n" and {node: 1}[node] == 1
    assert file.location.line is None and file.location.package is package
    node.mine = 3  # plug-ins keep what they find on what they find it of
    assert system.nodes[0].mine == 3
