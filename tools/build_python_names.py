#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Build haros_ci/knowledge/python.dat: the names that the modules of Python's standard library have, in any version and on any system.

    python tools/build_python_names.py --stubs DIR PYTHON...

*stubs* are those of the standard library in typeshed (in mypy: ``mypy/typeshed/stdlib``), with the names of all systems and of the newest
versions; each *PYTHON* is an interpreter that is asked for what its own modules have: 2.7, and 3.6 on. Names alone are written.
"""

from __future__ import annotations

import argparse
import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from haros_ci.knowledge.facts import PYTHON, write_facts

#: Modules that do something when they are imported, or are for Python itself.
LEFT_OUT = frozenset(
    "antigravity this idlelib lib2to3 test turtledemo ensurepip pydoc_data distutils encodings venv msilib".split()
)
#: What other Pythons have (PyPy, Jython), a frozen program, a virtual environment, Python 2 once it is loaded again, and shells.
BESIDES = {
    "sys": "pypy_version_info pypy_translation_info frozen real_prefix setdefaultencoding gettotalrefcount getobjects registry builtins",
    "array": "zeros",
    "builtins": "profile display get_ipython reveal_type unicode long xrange raw_input basestring unichr file cmp reduce reload execfile",
}
#: Asks an interpreter (also one of Python 2) for the names of modules, one a line.
ASK = """
import sys, pkgutil
for name in sys.argv[1].split():
    try:
        module = __import__(name, {}, {}, ['x'])
    except Exception:
        continue
    names = set(dir(module)) | set(one[1] for one in pkgutil.iter_modules(getattr(module, '__path__', [])))
    sys.stdout.write(name + '\\t' + ' '.join(sorted(names)) + '\\n')
"""
Rows = dict[str, set[str]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--stubs", type=Path, required=True, help="the stubs of the standard library")
    parser.add_argument("pythons", nargs="+", metavar="PYTHON", help="interpreters")
    options = parser.parse_args()
    rows = of_stubs(options.stubs)
    for name, names in BESIDES.items():
        rows[name].update(names.split())
    versions = []
    for python in options.pythons:
        done = subprocess.run([python, "-c", ASK, " ".join(sorted(rows))], capture_output=True, text=True, check=True)
        for line in done.stdout.splitlines():
            name, _, names = line.partition("\t")
            rows[name].update(names.split())
        asked = [python, "-c", "import sys; sys.stdout.write('%d.%d' % sys.version_info[:2])"]
        versions.append(subprocess.run(asked, capture_output=True, text=True, check=True).stdout)
    public = {name: " ".join(sorted(one for one in names if not one.startswith("_"))) for name, names in rows.items()}
    write_facts(PYTHON, {"pythons": versions}, {"modules": public})
    print(f"{len(public)} modules, {PYTHON.stat().st_size} bytes")


def of_stubs(folder: Path) -> Rows:
    """The modules of the stubs, each with all names of any version and system, and with the modules in it."""
    rows: Rows = {}
    trees: dict[str, ast.Module] = {}
    for path in sorted(folder.rglob("*.pyi")):
        parts = path.relative_to(folder).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        if parts[0] in LEFT_OUT or any(one.startswith("_") for one in name.split(".")):
            continue
        trees[name] = ast.parse(path.read_text(encoding="utf-8"))
        rows.setdefault(name, set())
        package, _, last = name.rpartition(".")
        if package:
            rows.setdefault(package, set()).add(last)
    for name, tree in trees.items():
        rows[name] |= set(bound(folder, tree, name))
    return {name: names for name, names in rows.items() if "__getattr__" not in names}


def bound(folder: Path, tree: ast.Module, name: str) -> Iterator[str]:
    """The names that a stub binds in any branch, and those that it has from others by a star."""
    todo: list[ast.AST] = [tree]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
            continue
        todo += ast.iter_child_nodes(node)
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            yield node.id
        elif isinstance(node, ast.Import):
            yield from ((one.asname or one.name).partition(".")[0] for one in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (one.asname or one.name for one in node.names if one.name != "*")
            if any(one.name == "*" for one in node.names):
                above = name.split(".")[: -node.level + 1] if node.level > 1 else name.split(".")
                module = ".".join((*(above if node.level else ()), *(node.module or "").split(".")))
                for path in (
                    folder / f"{module.replace('.', '/')}.pyi",
                    folder / module.replace(".", "/") / "__init__.pyi",
                ):
                    if path.exists():
                        yield from bound(folder, ast.parse(path.read_text(encoding="utf-8")), module)


if __name__ == "__main__":
    main()
