# SPDX-License-Identifier: Apache-2.0
"""Whether sources that nothing builds or starts change the model of what is built.

    python tests/bench/beside.py CHECKOUT...

The C++ and Python sources of each checkout are copied, with other texts in all their literals, into a package that builds nothing, and once more
beside themselves, where the package's CMake and setup.py name their files one by one. No node that there was may change.
The exit code is 1 if one did; what differs is printed.
"""

from __future__ import annotations

import json
import posixpath
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.report.model_json import render
from haros_ci.workspace.cache import MemoryCache
from haros_ci.workspace.discover import discover

PACKAGE = (
    '<package format="2"><name>zz_beside</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">m</maintainer><license>MIT</license></package>\n'
)
SUFFIXES = (".cpp", ".cc", ".py")
LITERAL = re.compile(r"\"([A-Za-z/~][^\"\n\\]*)\"|'([A-Za-z/~][^'\n\\]*)'")
INCLUDE = re.compile(r"^\s*#\s*include")
#: CMake and setup.py that take every file that there is.
ALL = re.compile(
    r"GLOB|aux_source_directory|AUX_SOURCE|DIRECTORY\s+(?:src|scripts|nodes|\.|\$\{)|glob\(", re.IGNORECASE
)
ENDS = ("publishers", "subscribers", "servers", "clients", "getters", "setters", "parameters", "transforms")


def other_texts(text: str) -> str:
    """*text* with ``zz_`` before what its literals say."""

    def changed(match: re.Match[str]) -> str:
        quote, inner = match[0][0], match[1] or match[2]
        return f"{quote}zz_{inner}{quote}"

    return "\n".join(line if INCLUDE.match(line) else LITERAL.sub(changed, line) for line in text.split("\n"))


def nodes(root: Path) -> Mapping[str, Any]:
    """What the model says of each node of each configuration."""
    workspace = discover(root, ())
    found = json.loads(render(architecture(workspace, Settings(root=root), MemoryCache(), environment={})))
    return {
        f"{configuration['name']} {node['name']}": {key: node.get(key) for key in node}
        for configuration in found["configurations"]
        for node in configuration["nodes"]
    }


def sources(root: Path) -> Iterator[Path]:
    return (p for p in sorted(root.rglob("*")) if p.suffix in SUFFIXES and p.is_file() and ".git" not in p.parts)


def is_listed(root: Path, path: Path) -> bool:
    """Whether the build files of the directories above a file name files one by one."""
    for above in path.parents:
        for name in ("CMakeLists.txt", "setup.py"):
            file = above / name
            if file.is_file() and ALL.search(file.read_text(errors="replace")):
                return False
        if above == root:
            return True
    return True


def compare(before: Mapping[str, Any], after: Mapping[str, Any], what: str) -> int:
    found = 0
    for key, node in before.items():
        new = after.get(key)
        if new == node:
            continue
        found += 1
        print(f"  {what}: {key}" + (" is gone" if new is None else ""))
        for part in node if new is not None else ():
            one, two = node[part], new[part]
            if one != two:
                if isinstance(one, list) and isinstance(two, list):
                    print(f"    {part}: only before {[x for x in one if x not in two][:3]}")
                    print(f"    {part}: only after  {[x for x in two if x not in one][:3]}")
                else:
                    print(f"    {part}: {str(one)[:300]} / {str(two)[:300]}")
    return found


def main(checkouts: list[str]) -> int:
    total = 0
    for checkout in checkouts:
        with tempfile.TemporaryDirectory() as name:
            root = Path(name) / posixpath.basename(checkout.rstrip("/"))
            shutil.copytree(checkout, root, symlinks=True, ignore=shutil.ignore_patterns(".git"))
            before = nodes(root)
            files = list(sources(root))
            apart = root / "zz_beside"
            for number, path in enumerate(files):
                target = apart / "src" / f"d{number}" / path.name
                target.parent.mkdir(parents=True)
                target.write_text(other_texts(path.read_text(errors="replace")))
            apart.mkdir(exist_ok=True)
            (apart / "package.xml").write_text(PACKAGE)
            found = compare(before, nodes(root), "in a package of their own")
            shutil.rmtree(apart)
            for path in files:
                if path.suffix != ".py" and is_listed(root, path):
                    (path.parent / f"zz_{path.name}").write_text(other_texts(path.read_text(errors="replace")))
            found += compare(before, nodes(root), "beside themselves")
            total += found
            print(f"{checkout}: {len(before)} nodes, {len(files)} sources, {found} changed", flush=True)
    return 1 if total else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
