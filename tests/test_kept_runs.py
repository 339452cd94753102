# SPDX-License-Identifier: Apache-2.0
"""What is found in a whole revision is kept as long as nothing that it depends on has changed, and no longer."""

from __future__ import annotations

import struct
import subprocess
import sys
import zlib
from base64 import b64encode
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from commandline import commit, git, haros, write
from mutations import LAUNCH_XML, LISTENER_CPP, ROS2

from haros_ci import pipeline
from haros_ci.analysis import inspection, kept_runs
from haros_ci.config.settings import Settings
from haros_ci.results.result import Report, Run
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.files import TextReader

RULE = "topic-type-mismatch"
MESH, SCRIPT = "walker/meshes/body.stl", "walker/scripts/go.py"
URDF = """<robot name="walker"><link name="body"><visual><geometry>
  <mesh filename="package://walker/meshes/body.stl"/></geometry></visual></link></robot>
"""

PLUGIN = """from haros_ci.api.reports import Report
RENDERERS = {"nothing": lambda report: ""}
"""


class Runs:
    """Runs over one workspace with one cache; *made* counts how often the architecture was looked at."""

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.root = root
        self.store = MemoryCache()
        self.made = 0
        self.settings = Settings(root=root, profile="architecture")
        real = inspection.inspected

        def counted(*arguments: Any) -> Run:
            self.made += 1
            return real(*arguments)

        monkeypatch.setattr(inspection, "inspected", counted)

    def run(self) -> Report:
        return pipeline.analyse(self.settings, self.store)[0]

    def makes_anew(self) -> bool:
        """Whether a further run looks at the architecture; it must say what a run without a cache says."""
        before = self.made
        found = self.run()
        anew = self.made != before
        store, self.store = self.store, MemoryCache()
        assert self.run() == found
        self.store = store
        return anew


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Runs:
    root = write(tmp_path / "ws", {**ROS2, MESH: bytes(80) + struct.pack("<I", 0), SCRIPT: "print(1)\n"})
    found = Runs(root, monkeypatch)
    assert RULE in {result.rule for run in found.run().runs for result in run.results}
    return found


CHANGES: dict[str, Callable[[Path], object]] = {
    "a source": lambda root: write(root, {LISTENER_CPP: ROS2[LISTENER_CPP].replace("Int32", "String")}),
    "a comment": lambda root: write(root, {LISTENER_CPP: "// more\n" + ROS2[LISTENER_CPP]}),
    "a launch file": lambda root: write(root, {LAUNCH_XML: ROS2[LAUNCH_XML].replace("<launch>", "<launch>\n")}),
    "a manifest": lambda root: write(root, {"walker/package.xml": ROS2["walker/package.xml"] + "\n"}),
    "a page": lambda root: write(root, {"README.md": "# Walker\n"}),
    "the name of a file that is not read": lambda root: write(root, {"walker/maps/hall.pgm": b"P5 1 1 255\n\0"}),
    "a file less": lambda root: (root / MESH).unlink(),
    "an execute bit": lambda root: (root / SCRIPT).chmod(0o755),
    "a marker": lambda root: write(root, {"walker/COLCON_IGNORE": ""}),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_made_anew_after_a_change_of(runs: Runs, change: Callable[[Path], object]) -> None:
    change(runs.root)
    assert runs.makes_anew()


class TestKept:
    def test_where_nothing_has_changed(self, runs: Runs) -> None:
        assert not runs.makes_anew()

    def test_where_a_file_is_written_again_as_it_was(self, runs: Runs) -> None:
        write(runs.root, {LISTENER_CPP: ROS2[LISTENER_CPP]})
        assert not runs.makes_anew()

    def test_where_only_the_report_is_another(self, runs: Runs) -> None:
        runs.settings = replace(runs.settings, fail_on=None, jobs=2)
        assert not runs.makes_anew()

    def test_for_each_state_that_was_there(self, runs: Runs) -> None:
        CHANGES["a source"](runs.root)
        assert runs.makes_anew()
        write(runs.root, {LISTENER_CPP: ROS2[LISTENER_CPP]})
        assert not runs.makes_anew()

    def test_for_the_base_what_was_found_when_it_was_the_head(self, runs: Runs) -> None:
        git(runs.root, "init", "--quiet")
        commit(runs.root)
        runs.run()
        CHANGES["a source"](runs.root)
        runs.settings = replace(runs.settings, baseline_rev="HEAD")
        before = runs.made
        runs.run()
        assert runs.made == before + 1

    def test_for_both_revisions(self, runs: Runs) -> None:
        git(runs.root, "init", "--quiet")
        commit(runs.root)
        CHANGES["a source"](runs.root)
        runs.settings = replace(runs.settings, baseline_rev="HEAD")
        assert runs.makes_anew()
        assert not runs.makes_anew()


class TestNotKept:
    def test_under_other_settings(self, runs: Runs) -> None:
        runs.settings = replace(runs.settings, profile="strict")
        assert runs.makes_anew()

    def test_for_another_program(self, runs: Runs, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(kept_runs, "program_digest", lambda: "another")
        assert runs.makes_anew()

    def test_for_another_base(self, runs: Runs) -> None:
        git(runs.root, "init", "--quiet")
        commit(runs.root)
        runs.settings = replace(runs.settings, baseline_rev="HEAD")
        assert runs.makes_anew()
        CHANGES["a source"](runs.root)
        commit(runs.root)
        assert runs.makes_anew()  # the head is what the base was compared with, the base is another

    def test_with_a_plug_in(self, runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        write(tmp_path / "elsewhere", {"reads_what_it_likes.py": PLUGIN})
        monkeypatch.syspath_prepend(str(tmp_path / "elsewhere"))
        runs.settings = replace(runs.settings, plugins=("reads_what_it_likes",))
        assert runs.makes_anew()
        assert runs.makes_anew()

    def test_what_is_planted_opens_nothing_outside_and_speaks_for_no_other_tool(
        self, runs: Runs, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        kept = [value for key, value in runs.store._values.items() if key[0] == kept_runs.GROUP]
        assert len(kept) == 1
        opened: list[str] = []
        real = TextReader.head
        monkeypatch.setattr(
            TextReader, "head", lambda self, path, length: opened.append(path) or real(self, path, length)
        )
        (value,) = kept
        assert isinstance(value, dict) and value["run"]["results"]
        value["heads"] = [["../outside.stl", "0"]]
        assert runs.makes_anew()
        assert "../outside.stl" not in opened
        value["heads"] = []
        value["run"]["results"][0]["tool"] = "cppcheck"
        runs.store._values = {key: value for key in runs.store._values if key[0] == kept_runs.GROUP}
        assert runs.makes_anew()

    @pytest.mark.parametrize(
        "spoiled", [None, [], {}, {"heads": [], "run": []}, {"heads": [["../x", 1, ""]], "run": {}}]
    )
    def test_from_a_spoiled_cache(self, runs: Runs, monkeypatch: pytest.MonkeyPatch, spoiled: object) -> None:
        get = runs.store.get

        def spoiling(group: str, path: str, key: str) -> object | None:
            return spoiled if group == kept_runs.GROUP else get(group, path, key)

        monkeypatch.setattr(runs.store, "get", spoiling)
        assert runs.makes_anew()

    def test_after_the_head_of_a_mesh_has_changed(self, runs: Runs) -> None:
        write(runs.root, {"walker/urdf/walker.urdf": URDF})
        assert runs.makes_anew()
        assert not runs.makes_anew()
        write(runs.root, {MESH: b"solid" + bytes(75) + struct.pack("<I", 0)})
        assert runs.makes_anew()


class TestOutput:
    """``haros-ci model`` on files that have not changed."""

    @pytest.fixture
    def root(self, tmp_path: Path) -> Path:
        return write(tmp_path / "ws", ROS2)

    def model(self, root: Path, *arguments: str) -> tuple[str, str, bool]:
        """What is written, what is said beside it, and whether it was made anew."""
        done = haros("model", "--cache-dir", str(root.parent / "cache"), "--timings", *arguments, cwd=root)
        assert done.returncode == 0, done.stderr
        said, _, timings = done.stderr.rpartition("  wall s    CPU s  stage\n")
        return done.stdout, said, "  follow\n" in timings

    @pytest.mark.parametrize("format", ["text", "json", "dot", "mermaid"])
    def test_is_the_same(self, root: Path, format: str) -> None:
        *first, anew = self.model(root, "--format", format)
        *second, again = self.model(root, "--format", format)
        assert anew and not again
        assert first == second and first[0]

    def test_a_database_is_the_same(self, root: Path) -> None:
        places = [root.parent / name for name in ("a.db", "b.db")]
        made = [self.model(root, "--format=sqlite", f"--output={place}")[2] for place in places]
        assert made == [True, False]
        assert places[0].read_bytes() == places[1].read_bytes()

    def test_warnings_are_said_again(self, root: Path) -> None:
        write(
            root,
            {
                "walker/launch/more.launch.xml": '<launch><include file="$(find-pkg-share gone)/launch/x.launch.xml"/></launch>'
            },
        )
        _, first, _ = self.model(root)
        _, second, again = self.model(root)
        assert "gone" in first and first == second and not again

    @pytest.mark.parametrize(
        "arguments",
        [
            ["--format=json"],
            ["--no-known-nodes"],
            ["--launch", "walker/" + "launch/" + Path(LAUNCH_XML).name],
            ["--env", "A=1"],
        ],
    )
    def test_other_options_make_another(self, root: Path, arguments: list[str]) -> None:
        self.model(root)
        assert self.model(root, *arguments)[2]
        assert not self.model(root, *arguments)[2]

    def test_a_changed_file_makes_another(self, root: Path) -> None:
        before = self.model(root, "--format=json")[0]
        write(root, {LISTENER_CPP: ROS2[LISTENER_CPP].replace("Int32", "String")})
        after, _, anew = self.model(root, "--format=json")
        assert anew and after != before

    def test_text_that_a_terminal_obeys_is_not_believed(self, tmp_path: Path) -> None:
        workspace = pipeline.found(Settings(root=write(tmp_path / "ws", ROS2)), None)  # type: ignore[arg-type]
        store = MemoryCache()
        right = kept_runs.Output(b"a model\n")
        assert kept_runs.kept_output("model", lambda: right, workspace, "", store) == right
        for bad in (b"\x1b[2J", "\u202eledom".encode(), b"##[group]"):
            planted = kept_runs.kept_output(
                "other", lambda bad=bad: kept_runs.Output(bad), workspace, str(bad), MemoryCache()
            )
            ((key, _),) = store._values.items()
            store._values[key] = [[], b64encode(zlib.compress(bad)).decode()]
            assert planted.content == bad
            assert kept_runs.kept_output("model", lambda: right, workspace, "", store) == right

    @pytest.mark.parametrize("kept", [None, 1, [[], "!"], [[], ""], [[1], "eA=="], [[], "eJw="], {"a": []}])
    def test_a_spoiled_one_is_none(self, kept: object) -> None:
        assert kept_runs._unpacked(kept) is None

    def test_what_follows_nodes_is_not_loaded_for_what_is_kept(self, root: Path) -> None:
        code = "import sys; from haros_ci.cli import main; sys.argv[1:] = %r\ntry: main()\nexcept SystemExit: pass\nprint('haros_ci.follow' in sys.modules, file=sys.stderr)"
        arguments = ["model", ".", f"--cache-dir={root.parent / 'cache'}"]
        command = [sys.executable, "-c", code % (arguments,)]
        runs = [
            subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=60, check=True) for _ in range(2)
        ]
        assert [run.stderr.splitlines()[-1] for run in runs] == ["True", "False"]
        assert runs[0].stdout == runs[1].stdout and runs[0].stdout
