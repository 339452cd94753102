# SPDX-License-Identifier: Apache-2.0
"""Our metrics beside those of other tools on the same files: equal, within one, different.

    haros-ci metrics ROOT --format json --output metrics.json
    python tests/bench/metrics_agreement.py metrics.json ROOT --with lizard --with pmccabe --with cccc --with pylint

Each tool must be installed for the Python that runs this, or on PATH. ``--show N`` lists the first N differences of each
metric. It needs nothing of haros-ci, so that it runs where the other tools are.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

#: What a tool said: metric of ours, path, line (0 where it does not tell), name, value.
Said = tuple[str, str, int, str, float]
#: In batches of so many files, for command lines are bounded.
BATCH = 400


def batches(files: list[str]) -> Iterator[list[str]]:
    for start in range(0, len(files), BATCH):
        yield files[start : start + BATCH]


def lizard(root: Path, files: list[str]) -> Iterator[Said]:
    """Complexity, parameters and the nested structures of its extension ``ns``."""
    import lizard as tool  # type: ignore[import-not-found,import-untyped,unused-ignore]

    analyzer = tool.FileAnalyzer(tool.get_extensions(["ns"]))
    for path in files:
        if path.endswith(".py"):  # counts self, and its levels of Python blocks add up over a file
            continue
        for function in analyzer(str(root / path)).function_list:
            for metric, value in (
                ("cyclomatic-complexity", function.cyclomatic_complexity),
                ("function-parameters", function.parameter_count),
                ("nested-control", function.max_nested_structures),
            ):
                yield metric, path, function.start_line, last(function.name), value


def radon(root: Path, files: list[str]) -> Iterator[Said]:
    """Complexity of Python functions, and of the methods of each class together."""
    from radon.complexity import cc_visit  # type: ignore[import-not-found,import-untyped,unused-ignore]

    for path in files:
        if not path.endswith(".py"):
            continue
        try:
            blocks = cc_visit((root / path).read_text(encoding="utf-8"), no_assert=True)
        except (SyntaxError, UnicodeDecodeError):
            continue
        for block in blocks:
            if hasattr(block, "methods"):
                yield "weighted-methods", path, block.lineno, block.name, sum(m.complexity for m in block.methods)
            else:
                yield "cyclomatic-complexity", path, 0, block.name, block.complexity


def pmccabe(root: Path, files: list[str]) -> Iterator[Said]:
    sources = [path for path in files if not path.endswith(".py")]
    for batch in batches(sources):
        done = subprocess.run(["pmccabe", *batch], cwd=root, capture_output=True, text=True, errors="replace")
        for row in done.stdout.splitlines():
            columns = row.split("\t")
            if len(columns) >= 6:
                place, _, name = columns[5].partition(": ")
                path = place.partition("(")[0]
                yield "cyclomatic-complexity", path, 0, last(name), float(columns[1])


def pylint(root: Path, files: list[str]) -> Iterator[Said]:
    """Nested blocks of functions, public methods of classes, and ancestors, all as messages with a limit of nothing."""
    import astroid  # type: ignore[import-not-found,import-untyped,unused-ignore]
    from astroid import nodes

    for path in files:
        if not path.endswith(".py"):
            continue
        try:
            module = astroid.parse((root / path).read_text(encoding="utf-8"))
        except Exception:  # noqa: BLE001 (a file of Python 2)
            continue
        for function in module.nodes_of_class(nodes.FunctionDef):
            inner = [n for each in function.body for n in each.nodes_of_class(nodes.Call, nodes.FunctionDef)]
            yield "function-calls", path, function.fromlineno, function.name, len(inner)
    names = [path for path in files if path.endswith(".py")]
    options = (
        "--disable=all --enable=too-many-nested-blocks,too-many-public-methods,too-many-ancestors --max-nested-blocks=0"
        " --max-public-methods=0 --max-parents=0 --persistent=n --score=n --msg-template={path}:{line}:{symbol}:{obj}:{msg}"
    ).split()
    for batch in batches(names):
        command = [sys.executable, "-m", "pylint", *options, *batch]
        done = subprocess.run(command, cwd=root, capture_output=True, text=True, errors="replace")
        deepest: dict[tuple[str, str], float] = defaultdict(float)
        for row in done.stdout.splitlines():
            parts = row.split(":", 4)
            found = re.search(r"\((\d+)/0\)", parts[-1])
            if len(parts) < 5 or found is None:
                continue
            path, line, symbol, name = parts[0], int(parts[1]), parts[2], parts[3]
            if symbol == "too-many-nested-blocks":
                deepest[path, name] = max(deepest[path, name], float(found.group(1)))
            elif symbol == "too-many-public-methods":
                yield "methods-available", path, line, last(name), float(found.group(1))
        for (path, name), value in deepest.items():
            yield "nested-control", path, 0, last(name), value


def cccc(root: Path, files: list[str]) -> Iterator[Said]:
    """Classes by their bare names: depth without the class itself, children, and couplings in both directions."""
    names = {"depth_of_inheritance_tree": "depth-in-tree", "number_of_children": "number-of-children"}
    names["coupling_between_objects"] = "coupling"
    sources = [path for path in files if not path.endswith(".py")]
    with tempfile.TemporaryDirectory() as directory:
        command = ["cccc", "--lang=c++", f"--outdir={directory}", *sources]
        subprocess.run(command, cwd=root, capture_output=True)
        tree = ElementTree.parse(Path(directory, "cccc.xml"))
    for module in tree.iterfind("oo_design/module"):
        name = module.findtext("name") or ""
        for tag, metric in names.items():
            found = module.find(tag)
            if found is not None:
                value = float(found.get("value", "0"))
                yield metric, "", 0, last(name), value + (metric == "depth-in-tree")


TOOLS = {"lizard": lizard, "radon": radon, "pmccabe": pmccabe, "pylint": pylint, "cccc": cccc}


def last(name: str) -> str:
    """The last part of a name, without template arguments and blanks; of a macro's call the macro."""
    bare = re.sub(r"\s+", "", re.sub(r"<[^<>]*>", "", name)) if "operator" not in name else name.replace(" ", "")
    return re.split(r"::|\.", bare.partition("(")[0] if "operator" not in bare else bare)[-1]


class Ours:
    """Our values by metric, for look-up by place, by name in a file, and by name alone."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.at: dict[tuple[str, str, int], list[float]] = defaultdict(list)
        self.named: dict[tuple[str, str, str], list[float]] = defaultdict(list)
        self.anywhere: dict[tuple[str, str], list[float]] = defaultdict(list)
        for each in (*document["functions"], *document["classes"]):
            name = last(each.get("function") or each["class"])
            for metric, value in each["metrics"].items():
                self.at[metric, each["path"], each["line"]].append(value)
                self.named[metric, each["path"], name].append(value)
                self.anywhere[metric, name].append(value)

    def of(self, metric: str, path: str, line: int, name: str) -> float | None:
        """The one value that is meant; None where there is none, or not one for sure."""
        found = self.at.get((metric, path, line)) if line else None
        if not found:
            found = self.named.get((metric, path, name)) if path else self.anywhere.get((metric, name))
        return found[0] if found and len(found) == 1 else None


def compare(ours: Ours, said: Iterable[Said], tool: str, show: int) -> None:
    counts: dict[str, list[int]] = defaultdict(lambda: [0, 0, 0, 0])
    differences: dict[str, list[str]] = defaultdict(list)
    for metric, path, line, name, value in said:
        own = ours.of(metric, path, line, name)
        if own is None:
            counts[metric][3] += 1
            continue
        kind = 0 if own == value else 1 if abs(own - value) <= 1 else 2
        counts[metric][kind] += 1
        if kind:
            differences[metric].append(f"    {path}:{line} {name}: ours {own:g}, {tool} {value:g}")
    print(f"{'tool':9} {'metric':24} {'equal':>7} {'by one':>7} {'more':>7} {'unpaired':>9}")
    for metric, (equal, near, far, alone) in sorted(counts.items()):
        print(f"{tool:9} {metric:24} {equal:7} {near:7} {far:7} {alone:9}")
        for text in sorted(differences[metric])[:show]:
            print(text)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("metrics", type=Path)
    parser.add_argument("root", type=Path)
    parser.add_argument("--with", dest="tools", action="append", choices=sorted(TOOLS), required=True)
    parser.add_argument("--show", type=int, default=0)
    arguments = parser.parse_args()
    document = json.loads(arguments.metrics.read_text(encoding="utf-8"))
    files = sorted({each["path"] for each in document["files"]})
    ours = Ours(document)
    for tool in arguments.tools:
        compare(ours, TOOLS[tool](arguments.root, files), tool, arguments.show)


if __name__ == "__main__":
    main()
