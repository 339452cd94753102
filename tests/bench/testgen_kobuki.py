# SPDX-License-Identifier: Apache-2.0
"""Property-based tests of Kobuki's safety controller, a nodelet, built from source: the published properties, and the published mutants of them.

    python tests/bench/testgen_kobuki.py SOURCES WORK build
    python tests/bench/testgen_kobuki.py SOURCES WORK true [--examples 30]
    python tests/bench/testgen_kobuki.py SOURCES WORK mutants [--examples 30] [--most 59] [--from 0]

SOURCES has clones of github.com/yujinrobot/{kobuki,yujin_ocs,kobuki_msgs}, github.com/stonier/{ecl_core,ecl_lite,ecl_tools} and
github.com/git-afsantos/haros-case-studies; WORK is a directory outside of them. Beside what testgen_fictibot.py needs, Debian's packages are
pluginlib-dev, libnodelet-dev, libnodeletlib-dev, libnodeletlib-tools, libactionlib-msgs-dev, libgeometry-msgs-dev, ros-std-msgs, ros-actionlib-msgs
and ros-geometry-msgs.

Three things are not as upstream has them, as Debian's pluginlib is a later one (5.2): a header has another name, for which there is one that includes
it; plug-ins are found by an index of ament, which is written here; and the file of the plug-in names its library in the newer way.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parent))
from testgen_fictibot import tested

NAME = "kobuki_safety_controller"
#: Of which branch which packages are needed, and no more.
ECL = {
    "ecl_core": (
        "release/0.62-noetic",
        ("threads", "concepts", "exceptions", "time", "utilities", "type_traits", "mpl"),
    ),
    "ecl_lite": ("release/0.61-noetic", ("config", "errors", "time_lite")),
    "ecl_tools": ("release/0.61-noetic", ("build", "license")),
}
PLUGIN = "share/kobuki_safety_controller/plugins/nodelet_plugins.xml"
MANIFEST = """<package format="2"><name>hpl_test</name><version>0.0.0</version><description>-</description>
<maintainer email="a@example.org">a</maintainer><license>-</license><buildtool_depend>catkin</buildtool_depend></package>
"""
PYTHONS = "-DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3"
#: The nodelet's loop turns ten times a second, and the published bound of 100 ms leaves nothing for a loop that turns a moment late.
SLACK = ("within 100 ms", "within 150 ms")


def built(sources: Path, work: Path) -> None:
    """A workspace with what the nodelet needs."""
    shutil.rmtree(work, ignore_errors=True)
    src, headers = work / "src", work / "headers/pluginlib"
    src.mkdir(parents=True)
    headers.mkdir(parents=True)
    (headers / "class_list_macros.h").write_text("#include <pluginlib/class_list_macros.hpp>\n")
    for name, (branch, packages) in ECL.items():
        command = [
            "git",
            "-C",
            str(sources / name),
            "archive",
            f"origin/{branch}",
            *(f"ecl_{package}" for package in packages),
        ]
        files = subprocess.run(command, check=True, capture_output=True).stdout
        subprocess.run(["tar", "x", "-C", str(src)], input=files, check=True)
    for repository, package in (("kobuki", NAME), ("yujin_ocs", "yocs_controllers"), ("", "kobuki_msgs")):
        shutil.copytree(sources / repository / package, src / package, ignore=shutil.ignore_patterns(".git"))
    launch = src / "hpl_test/launch"
    launch.mkdir(parents=True)
    (src / "hpl_test/package.xml").write_text(MANIFEST)
    (src / "hpl_test/CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.5)\nproject(hpl_test)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
    )
    for path in (sources / "haros-case-studies/academic/Kobuki/launch").glob("*.launch"):
        shutil.copy(path, launch)
    env = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}", "CPLUS_INCLUDE_PATH": str(headers.parent)}
    run = ["catkin_make", "-C", str(work), *PYTHONS.split(), "-DCMAKE_CXX_STANDARD=14", "-DCATKIN_ENABLE_TESTING=OFF"]
    with (work / "build.log").open("w") as log:
        for targets in (["kobuki_msgs_generate_messages_cpp", "kobuki_msgs_generate_messages_py"], [f"{NAME}_nodelet"]):
            subprocess.run([*run, *targets], check=True, env=env, stdout=log, stderr=subprocess.STDOUT)
    prefix = work / "prefix"
    index = prefix / "share/ament_index/resource_index"
    for kind, text in (("packages", ""), ("nodelet__pluginlib__plugin", f"{PLUGIN}\n")):
        (index / kind).mkdir(parents=True)
        (index / kind / NAME).write_text(text)
    (prefix / PLUGIN).parent.mkdir(parents=True)
    text = (src / NAME / "plugins/nodelet_plugins.xml").read_text()
    (prefix / PLUGIN).write_text(text.replace("lib/lib", ""))
    shutil.copy(src / NAME / "package.xml", (prefix / PLUGIN).parents[1])
    (prefix / "lib").symlink_to(work / "devel/lib")
    print(f"built {work}", flush=True)


def published(sources: Path) -> tuple[list[str], list[str], list[str]]:
    """The axioms, properties and mutants of the study of this node, told apart by the comments of its file."""
    path = sources / "haros-case-studies/academic/Kobuki/projects/pbt-eval.yaml"
    found: dict[str, list[str]] = {"axioms": [], "properties": [], "mutants": []}
    texts = iter(yaml.safe_load(path.read_text())["configurations"]["safety_controller_node"]["hpl"]["properties"])
    now = ""
    begin = path.read_text().index("safety_controller_node:")
    for line in path.read_text()[begin:].splitlines():
        word = line.strip(" #")
        if word in found:
            now = word
        elif line.strip().startswith('- "') and now:
            found[now].append(next(texts))
        elif "user_data:" in line:
            break
    return found["axioms"], found["properties"], found["mutants"]


def project(work: Path, properties: dict[str, str], axioms: list[str]) -> None:
    stated = "".join(f"        - |\n          # id: {key}\n          {text}\n" for key, text in properties.items())
    assumed = "".join(f"        - '{text}'\n" for text in axioms)
    (work / "src/haros.yaml").write_text(
        f"packages: [{NAME}, kobuki_msgs, hpl_test]\nconfigurations:\n  one:\n    launch: [hpl_test/launch/safety_controller_node.launch]\n"
        f"    hpl:\n      properties:\n{stated}      assumptions:\n{assumed}"
    )


def ran(work: Path, folder: Path, examples: int) -> list[dict[str, Any]]:
    prefix = str(work / "prefix")
    os.environ["AMENT_PREFIX_PATH"] = prefix
    os.environ["LD_LIBRARY_PATH"] = os.pathsep.join(filter(None, (f"{prefix}/lib", os.environ.get("LD_LIBRARY_PATH"))))
    return tested(work, folder, examples)


def study(sources: Path, work: Path, what: str, examples: int, first: int, most: int) -> None:
    axioms, true, mutants = published(sources)
    print(f"{len(axioms)} axioms, {len(true)} properties, {len(mutants)} mutants")
    stated = {f"true_{n:02}": text.replace(*SLACK) for n, text in enumerate(true, 1)}
    if what == "mutants":
        stated = {
            f"mutant_{n:02}": text.replace(*SLACK) for n, text in enumerate(mutants, 1) if first < n <= first + most
        }
    project(work, stated, axioms)
    lines = ran(work, work / f"tests_{what}_{first}", examples)
    for line in lines:
        print(
            f"{line['result']:8} {line['seconds']:7.1f} s {line['examples']:4} examples  {line['property']}", flush=True
        )
    results = [line["result"] for line in lines]
    print(
        ", ".join(
            f"{results.count(name)} {name}"
            for name in ("failed", "flaky", "passed", "skipped", "error")
            if name in results
        )
    )
    dead = [line for line in lines if line["result"] in ("failed", "flaky")]
    if dead:
        seconds, count = (statistics.median(line[key] for line in dead) for key in ("seconds", "examples"))
        print(f"a counterexample takes {seconds:.1f} s and {count:.0f} examples (medians)")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", type=Path)
    parser.add_argument("work", type=Path)
    parser.add_argument("what", choices=("build", "true", "mutants"))
    parser.add_argument("--examples", type=int, default=30)
    parser.add_argument("--from", dest="first", type=int, default=0, help="mutants that are passed over")
    parser.add_argument("--most", type=int, default=59, help="mutants")
    flags = parser.parse_args()
    sources, work = flags.sources.resolve(), flags.work.resolve()
    if flags.what == "build":
        built(sources, work)
    else:
        study(sources, work, flags.what, flags.examples, flags.first, flags.most)


if __name__ == "__main__":
    main()
