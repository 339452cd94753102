#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Build haros_ci/knowledge/facts.dat: which packages exist, what they need and provide. Names only, no text of the sources.

    python tools/build_knowledge.py --rosdistro DIR --overlay DIR --clones DIR

*rosdistro* is a clone of github:ros/rosdistro, *overlay* one of github:lopsided98/nix-ros-overlay (with history), *clones* a folder of
clones named ``owner+name``; of these, the ones that the index names are read, at the branch of each distribution in USED. The
packages of Debian are those that apt has on this machine.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import defaultdict
from pathlib import Path
from typing import Any

import yaml

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1])]

from knowledge_git import clones, commit, paths, texts  # noqa: E402
from knowledge_index import DISTRIBUTIONS, Index, Source, overlay_rows, read_index  # noqa: E402
from knowledge_system import System, modules, read_system  # noqa: E402
from knowledge_trees import Tree, brought, older, read_tree, shortened  # noqa: E402

from haros_ci.knowledge.facts import FACTS, write_facts  # noqa: E402
from haros_ci.knowledge.knowledge import ROS_1  # noqa: E402
from haros_ci.model.package import Package  # noqa: E402

#: Whose branches are read.
USED = ("kinetic", "melodic", "noetic", "foxy", "humble", "iron", "jazzy", "kilted", "lyrical", "rolling")
#: Repositories that the index does not name, and whose packages others of them depend on.
BESIDES = (Source("tier4/tier4_autoware_msgs", "tier4/universe", "humble"),)
_TABLE = Path(__file__).with_name("system_names.yaml")

Rows = dict[str, set[str]]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--rosdistro", type=Path, required=True)
    parser.add_argument("--overlay", type=Path, required=True)
    parser.add_argument("--clones", type=Path, required=True)
    parser.add_argument("--out", type=Path, default=FACTS)
    options = parser.parse_args()
    index = read_index(options.rosdistro)
    system = read_system(options.rosdistro)
    found = clones(options.clones)
    names = {repository: _package_names(clone) for repository, clone in found.items()}
    _moved(index, found, names)
    trees = _trees(index, found)
    used = {repository for repository, _, _ in trees}
    earlier = [package for repository in sorted(used) for package in older(found[repository])]
    # such packages exist, whether they are in the index or not
    index.repositories |= {name for each in names.values() for name in each}
    table = yaml.safe_load(_TABLE.read_text(encoding="utf-8"))
    sections = _sections(index, system, trees, table, list(overlay_rows(options.overlay)), earlier)
    sources = {
        "distributions": list(DISTRIBUTIONS),
        "sources": {
            "github:ros/rosdistro": commit(options.rosdistro, "HEAD")[:12],
            "github:lopsided98/nix-ros-overlay": commit(options.overlay, "HEAD")[:12],
            "package index of Debian": "apt-cache dumpavail",
            "repositories that the index names": sorted({repository for repository, _, _ in trees}),
        },
    }
    write_facts(options.out, sources, sections)
    print(
        f"{options.out}: {options.out.stat().st_size} bytes; " + ", ".join(f"{n} {len(r)}" for n, r in sections.items())
    )


def _package_names(clone: Path) -> set[str]:
    """The names of the packages of a clone."""
    files = paths(clone, "HEAD")
    manifests = [sha for path, sha in files.items() if path.rpartition("/")[2] == "package.xml"]
    matches = (re.search(r"<name>\s*([A-Za-z]\w*)\s*</name>", text) for text in texts(clone, manifests))
    return {match[1] for match in matches if match}


def _moved(index: Index, found: dict[str, Path], names: dict[str, set[str]]) -> None:
    """Repositories change owners: one of the same name with packages of the row's is the row's."""
    for source in index.sources:
        if source.repository not in found:
            name = source.repository.partition("/")[2]
            same = (each for each in found if each.endswith(f"/{name}") and names.get(each, set()) & source.packages)
            source.repository = next(same, source.repository)


def _trees(index: Index, found: dict[str, Path]) -> dict[tuple[str, str, int], Tree]:
    """The revisions of repositories that distributions in USED have, each read once for ROS 1 or ROS 2."""
    trees: dict[tuple[str, str, int], Tree] = {}
    for source in (*index.sources, *BESIDES):
        clone = found.get(source.repository)
        if clone is None or source.distribution not in USED:
            continue
        revision = commit(clone, source.branch) or commit(clone, "HEAD")
        key = (source.repository, revision, 1 if source.distribution in ROS_1 else 2)
        if revision and key not in trees:
            trees[key] = read_tree(clone, *key[1:])
    return trees


def _sections(
    index: Index,
    system: System,
    trees: dict[tuple[str, str, int], Tree],
    table: Any,
    overlay: list[tuple[str, str, tuple[str, ...]]],
    earlier: list[Package],
) -> dict[str, dict[str, str]]:
    packages = {name: sum(1 << DISTRIBUTIONS.index(each) for each in where) for name, where in index.packages.items()}
    for tree in trees.values():
        for name in tree.packages:
            packages.setdefault(name, 0)
    chosen, direct, keys = _keys(system, table)
    requires = _requires(packages, keys, direct, system, trees, overlay)
    _add_older(requires, earlier, {*packages, *keys})
    headers, cmake, found_modules, interfaces, plugins = _provided(trees, packages)
    for kind, rows in (("headers", headers), ("cmake", cmake), ("modules", found_modules)):
        for debian, names in table.get(kind, {}).items() if kind != "modules" else ():
            for name in names:
                rows[name] |= direct.get(debian, set())
        for package, names in table["ros"].get(kind, {}).items():
            for name in names:
                if package in packages:
                    rows[name].add(package)
    for module, key, names in modules(system, table["modules"]):
        found_modules[module] |= {key, *(chosen[name] for name in names if name in chosen)}
    short = {name: " ".join(sorted(row)) for name, row in headers.items()}
    lower: Rows = defaultdict(set)
    for name, row in found_modules.items():
        lower[name.lower()] |= row
    return {
        "packages": {name: f"{mask:x}" for name, mask in packages.items()},
        "others": dict.fromkeys(sorted(index.repositories - set(packages)), ""),
        "metapackages": _by_ros(trees, True),
        "plain": _by_ros(trees, False),
        "keys": {name: " ".join(sorted(row)) for name, row in keys.items()},
        **{f"requires{ros}": {n: " ".join(sorted(row)) for n, row in requires[ros].items()} for ros in (1, 2)},
        "headers": short,
        "cmake": {name: " ".join(sorted(row)) for name, row in cmake.items() if row - {name}},
        "modules": {name: " ".join(sorted(row)) for name, row in lower.items() if row - {name}},
        "interfaces": {name: " ".join(sorted(row)) for name, row in interfaces.items()},
        "plugins": {name: " ".join(sorted(row)) for name, row in plugins.items()},
    }


def _by_ros(trees: dict[tuple[str, str, int], Tree], is_metapackage: bool) -> dict[str, str]:
    """The packages that are metapackages, or that are not, with the digits of the ROS they are so in."""
    found: dict[str, str] = {}
    for (_, _, ros), tree in trees.items():
        for name, package in tree.packages.items():
            if package.is_metapackage == is_metapackage:
                found[name] = "".join(sorted({*found.get(name, ""), str(ros)}))
    return found


def _keys(system: System, table: Any) -> tuple[dict[str, str], dict[str, set[str]], Rows]:
    """For each package of Debian that matters: one key that stands for it, and all that do; then what every key brings.

    ``?`` among what a key brings: it stands for a package that is not in the index, so that there may be more.
    """
    wanted = {name for kind in ("headers", "cmake", "modules") for name in table[kind]}
    wanted |= {name for names in system.keys.values() for name in names if name.startswith("python3-")}
    direct: dict[str, set[str]] = defaultdict(set)
    for key, names in system.keys.items():
        for name in names & wanted:
            direct[name].add(key)
    chosen = {name: min(keys, key=lambda k: (len(system.keys[k]), len(k), k)) for name, keys in direct.items()}
    brings: Rows = {}
    for key, names in system.keys.items():
        closed = {each for name in names for each in system.brought(name)}
        brings[key] = {chosen[name] for name in closed if name in chosen} - {key}
        if not any(name in system.depends for name in names) and not key.startswith("python"):
            brings[key].add("?")
    return chosen, direct, brings


def _requires(
    packages: dict[str, int],
    keys: Rows,
    direct: dict[str, set[str]],
    system: System,
    trees: dict[tuple[str, str, int], Tree],
    overlay: list[tuple[str, str, tuple[str, ...]]],
) -> dict[int, Rows]:
    """What each package brings, by the ROS it is of; union over distributions."""
    plain = {name.replace("_", "-").lower(): name for name in packages}
    there = {(distribution, package) for distribution, package, _ in overlay}
    by_nix: dict[str, set[str]] = defaultdict(set)
    useful = {key for row in direct.values() for key in row}
    for key, attributes in system.nix.items():
        for name in attributes if key in useful else ():
            by_nix[name].add(key)
    found: dict[int, Rows] = {1: defaultdict(set), 2: defaultdict(set)}
    for distribution, package, names in overlay:
        row = found[1 if distribution in ROS_1 else 2][plain.get(package.replace("_", "-").lower(), package)]
        for name in names:
            general = (
                ".".join(("pythonPackages", name.partition(".")[2]))
                if name.startswith("python") and "." in name
                else name
            )
            if name in plain and {(distribution, name), (distribution, plain[name])} & there:
                row.add(plain[name])
            row |= by_nix.get(general, set())
    for (_, _, ros), tree in trees.items():
        for made in tree.packages.values():
            found[ros][made.name].update(each for each in brought(made) if each in packages or each in keys)
    return found


def _add_older(requires: dict[int, Rows], earlier: list[Package], known: set[str]) -> None:
    """A workspace may be built with earlier releases, so what these brought counts as brought."""
    for package in earlier:
        for ros in (1, 2) if package.ros is None else (package.ros,):
            if package.name in requires[ros]:
                requires[ros][package.name].update(each for each in brought(package) if each in known)


def _provided(trees: dict[tuple[str, str, int], Tree], packages: dict[str, int]) -> tuple[Rows, Rows, Rows, Rows, Rows]:
    """Headers, CMake packages, modules, interfaces and plug-ins with who provides them."""
    every = list(trees.values())
    tables: list[Rows] = [defaultdict(set) for _ in range(5)]
    headers, cmake, found_modules, interfaces, plugins = tables
    listed = {pair for tree in every for pair in tree.headers}
    for name, names in shortened(listed, packages).items():
        headers[name] |= set(names)
    seen = {name for tree in every for name in tree.packages}
    generated = {name for tree in every for name, _, _ in tree.interfaces}
    for name, row in headers.items():
        top = name.partition("/")[0]
        if row and name == f"{top}/" and top in packages and (top in generated or top not in seen):
            row.add(top)
    for tree in every:
        for name, package in tree.modules:
            found_modules[name].add(package)
        for name, package in tree.cmake:
            if name in packages:
                cmake[name] |= {package, name}
        for package, kind, name in tree.interfaces:
            interfaces[package].add(f"{kind}/{name}")
        for name, base, package in tree.plugins:
            plugins[name].add(f"{package}|{base}")
    for name, row in found_modules.items():
        if name in packages and name not in row and name not in seen:
            row.add(name)
    return headers, cmake, found_modules, interfaces, plugins


if __name__ == "__main__":
    main()
