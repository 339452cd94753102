# SPDX-License-Identifier: Apache-2.0
"""Our reader of xacro beside xacro itself, on all xacro files of real repositories.

``python tests/bench/xacro_bench.py --xacro VENV/bin/python REPOSITORY…``: that Python has xacro (``pip install xacro``), which
is no dependency of ours. Each file that declares a robot is expanded by both, without arguments; ``$(find pkg)`` is the package's directory.
Counted are the files that xacro expands to at least one link: equal are those where links and joints (name, type, parent, child) are the same
sets. A certain fault of ours in a file that xacro expands is false; of the files that xacro refuses, it is counted in how many we
say so.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from xml.etree import ElementTree

from haros_ci.robot.sources import DescriptionSources, by_names
from haros_ci.robot.urdf import read_robot
from haros_ci.workspace.discover import discover

#: What runs in the other Python: a line in, path and packages; a line out, the document or why there is none.
WORKER = """
import contextlib, io, json, os, signal, sys, types
packages = {}
index = types.ModuleType("ament_index_python"); inner = types.ModuleType("ament_index_python.packages")
def share(name):
    return packages[name]
inner.get_package_share_directory = share
index.packages = inner
sys.modules["ament_index_python"] = index; sys.modules["ament_index_python.packages"] = inner
import xacro
def late(*_):
    raise TimeoutError("late")
signal.signal(signal.SIGALRM, late)
out = sys.stdout
for line in sys.stdin:
    path, given = json.loads(line)
    packages.clear(); packages.update(given)
    signal.alarm(30)
    try:
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            doc = xacro.process_file(path).toxml()
        said = ["ok", doc]
    except BaseException as err:
        said = ["no", f"{type(err).__name__}: {err}"[:300]]
    signal.alarm(0)
    out.write(json.dumps(said) + "\\n"); out.flush()
"""


def theirs(document: str) -> tuple[set[object], set[object]]:
    root = ElementTree.fromstring(document)
    joints = set()
    for joint in root.findall("joint"):
        ends = [found.get("link") if (found := joint.find(tag)) is not None else "" for tag in ("parent", "child")]
        joints.add((joint.get("name"), joint.get("type"), *ends))
    return {link.get("name") for link in root.findall("link")}, joints


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--xacro", required=True)
    options.add_argument("--show", action="store_true", help="name each file that differs")
    options.add_argument("repositories", nargs="+", type=Path)
    given = options.parse_args()
    worker = subprocess.Popen(
        [given.xacro, "-c", WORKER], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    assert worker.stdin is not None and worker.stdout is not None
    files = equal = part = false = refused = told = 0
    spent = 0.0
    for root in given.repositories:
        workspace = discover(root.resolve(), (".",))
        sources = DescriptionSources(workspace, by_names(workspace))
        packages = {name: str(root.resolve() / path) for name, path in sources.packages.items()}
        for file in workspace.files:
            if not file.path.endswith((".xacro", ".urdf", ".xml")) or "<robot" not in workspace.text(file.path):
                continue
            if "xacro" not in workspace.text(file.path):
                continue
            worker.stdin.write(json.dumps([str(root.resolve() / file.path), packages]) + "\n")
            worker.stdin.flush()
            state, said = json.loads(worker.stdout.readline())
            begun = time.perf_counter()
            robot = read_robot(sources, file.path)
            spent += time.perf_counter() - begun
            certain = [] if robot is None else [fault for fault in robot.faults if fault.certain]
            certain = [fault for fault in certain if fault.kind not in ("expression", "unprefixed")]
            if state == "no":
                refused += 1
                told += bool(certain)
                if given.show and not certain:
                    print(f"refused {root.name}/{file.path}: {said[:150]!r}")
                continue
            links, joints = theirs(said)
            if not links:
                continue
            files += 1
            if certain:
                false += 1
                print(f"false   {root.name}/{file.path}: {certain[:2]}")
            ours = (set(), set()) if robot is None else (
                {each.name for each in robot.links if each.certain},
                {(each.name, each.type or None, each.parent, each.child) for each in robot.joints if each.certain},
            )  # fmt: skip
            if ours == (links, joints):
                equal += 1
            elif robot is not None and not robot.is_whole:
                part += 1
                if given.show:
                    print(f"part    {root.name}/{file.path}: {len(ours[0])} of {len(links)} links")
            else:
                print(
                    f"differs {root.name}/{file.path}: {sorted(map(str, ours[0] ^ links))[:4]} {len(ours[1] ^ joints)}"
                )
    worker.stdin.close()
    worker.wait()
    print(
        f"{files} files with links that xacro expands: {equal} equal ({equal / max(files, 1):.1%}), {part} known in part"
    )
    print(f"{false} of them with a fault that is none; {told} of {refused} refused files told; {spent:.1f} s of ours")
    return 0 if not false and equal >= 0.95 * files else 1


if __name__ == "__main__":
    sys.exit(main())
