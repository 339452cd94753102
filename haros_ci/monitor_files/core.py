# SPDX-License-Identifier: Apache-2.0
"""The core of a generated file: the properties as classes, and of ``parts/`` what they stand on.

    text, left_out = core_text(described)

makes a module of Python that defines ``PROPERTIES``, the classes, and ``Monitors``, which takes messages (``parts/suite.py`` says how).
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path

from haros_ci.monitor_files.classes import Described, TooDeep, class_text

#: What a core can consist of, and what a program has besides.
CORE = ("values", "functions", "monitors", "patterns", "suite")
PROGRAM = ("program", "ros1", "ros2")
#: What every core has.
_ROOTS = ("Monitors", "as_json")
_IMPORTS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("argparse", ()),
    ("json", ()),
    ("math", ()),
    ("sys", ()),
    ("threading", ()),
    ("time", ()),
    ("collections.abc", ("Callable", "Iterable", "Iterator", "Mapping", "Sequence")),
    ("contextlib", ("suppress",)),
    ("dataclasses", ("dataclass", "field")),
    ("typing", ("Any",)),
)
TOO_DEEP = "is left out: more than 30 operators stand within each other in a predicate"


def core_text(described: Iterable[Described]) -> tuple[str, tuple[str, ...]]:
    """A module that defines the core for these properties, and a sentence for each that is left out."""
    own, left_out = properties_text(described)
    return module_text(CORE, _ROOTS, own), left_out


def properties_text(described: Iterable[Described]) -> tuple[str, tuple[str, ...]]:
    """The classes of the properties and the list of them, and a sentence for each that is left out."""
    classes: list[str] = []
    left_out: list[str] = []
    for one in described:
        try:
            classes.append(class_text(f"Property{len(classes) + 1}", one))
        except TooDeep:
            left_out.append(f"{one.title} {TOO_DEEP}")
    names = "".join(f"    Property{number},\n" for number in range(1, len(classes) + 1))
    return "\n\n".join((*classes, f"PROPERTIES: list[type[Property]] = [\n{names}]\n")), tuple(left_out)


def module_text(parts: Sequence[str], roots: Iterable[str], own: str) -> str:
    """A module of *own*, with the definitions of *parts* that it and *roots* need before it, and the imports before them."""
    code = f"{copied(parts, (*roots, *mentioned(own)))}\n\n{own}"
    return f"{imports_of(code)}\n\n{code}"


def imports_of(code: str) -> str:
    """The imports that a text of Python needs."""
    names = mentioned(code)
    lines = ["from __future__ import annotations", ""]
    for module, parts in _IMPORTS:
        if not parts and module in names:
            lines.append(f"import {module}")
        elif found := [part for part in parts if part in names]:
            lines.append(f"from {module} import {', '.join(found)}")
    return "".join(f"{line}\n" for line in lines)


def copied(parts: Sequence[str], names: Iterable[str]) -> str:
    """The definitions of *parts* that *names* need, themselves and by others, in their order, as they stand there."""
    found = {name: text for part in parts for name, text in definitions(part).items()}
    needed: set[str] = set()
    rest = [name for name in names if name in found]
    while rest:
        name = rest.pop()
        if name not in needed:
            needed.add(name)
            rest.extend(other for other in mentioned(found[name]) if other in found)
    texts = dict.fromkeys(text for name, text in found.items() if name in needed)
    whole = ""
    was_block = False
    for text in texts:
        is_block = re.search(r"^(?:def|class|@)", text, re.MULTILINE) is not None
        whole += ("\n\n\n" if is_block or was_block else "\n") * bool(whole) + text
        was_block = is_block
    return f"{whole}\n"


@cache
def definitions(part: str) -> Mapping[str, str]:
    """The definitions of a module of ``parts/`` by their names, each with the comment in front of it."""
    text = Path(__file__).with_name("parts").joinpath(f"{part}.py").read_text(encoding="utf-8")
    lines = text.splitlines()
    found: dict[str, str] = {}
    for node in ast.parse(text).body:
        names = _names(node)
        first = min(part.lineno for part in (node, *getattr(node, "decorator_list", ()))) - 1
        while first and lines[first - 1].startswith("#:"):
            first -= 1
        for name in names:
            found[name] = "\n".join(lines[first : node.end_lineno])
    return found


def _names(node: ast.stmt) -> list[str]:
    if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
        return [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else [node.target] if isinstance(node, ast.AnnAssign) else []
    return [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]


def mentioned(text: str) -> set[str]:
    """The names that a text of Python mentions."""
    return {node.id for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Name)}
