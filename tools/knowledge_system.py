# SPDX-License-Identifier: Apache-2.0
"""What rosdep's keys bring along: by rosdep's tables, and by what Debian's packages depend on (``apt-cache dumpavail``)."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from knowledge_index import read_yaml

_TABLES = ("rosdep/base.yaml", "rosdep/python.yaml", "rosdep/ruby.yaml")
_PYTHON = re.compile(r"^(?:python3?|python2)-(.+?)(?:-pip)?$")


@dataclass(slots=True)
class System:
    """*keys*: what each key stands for on Debian and Ubuntu; *pip*: likewise from PyPI; *nix*: names of the overlay by key."""

    keys: dict[str, set[str]] = field(default_factory=dict)
    pip: dict[str, set[str]] = field(default_factory=dict)
    nix: dict[str, set[str]] = field(default_factory=dict)
    depends: dict[str, set[str]] = field(default_factory=dict)
    _closed: dict[str, frozenset[str]] = field(default_factory=dict)

    def brought(self, package: str) -> frozenset[str]:
        """*package* of Debian, and all that comes with it."""
        if package not in self._closed:
            found, todo = {package}, [package]
            while todo:
                for name in self.depends.get(todo.pop(), ()):
                    if name not in found:
                        found.add(name)
                        todo.append(name)
            self._closed[package] = frozenset(found)
        return self._closed[package]


def read_system(rosdistro: Path) -> System:
    system = System(depends=dict(_debian()))
    for table in _TABLES:
        for key, row in read_yaml(rosdistro, table).items():
            names, pip = set[str](), set[str]()
            for platform in ("debian", "ubuntu"):
                _flatten(row.get(platform) if isinstance(row, dict) else None, names, pip, False)
            if isinstance(row, dict):
                _flatten(row.get("*"), names, pip, False)
                nix = row.get("nixos")
                listed = nix if isinstance(nix, list) else []
                system.nix[key] = {re.sub(r"^python3?\d*Packages", "pythonPackages", str(each)) for each in listed}
            system.keys[key] = names
            system.pip[key] = pip
    return system


def modules(system: System, given: dict[str, list[str]]) -> Iterator[tuple[str, str, frozenset[str]]]:
    """``(module, key, packages)``: what *given* says of Debian's packages, else a module that is named as the package.

    *packages* are those of the key that have the module: a key for several packages (Qt's two bindings) brings more than each of them.
    """
    for key in system.keys:
        found: dict[str, set[str]] = {}
        for name in (*system.keys[key], key):
            match = _PYTHON.match(name)
            for module in (*_named(match[1], given), *given.get(name, ())) if match else given.get(name, ()):
                found.setdefault(module, set()).add(name)
        for name in system.pip[key]:
            for module in _named(name, given):
                found.setdefault(module, set())
        for module, names in found.items():
            if module.isidentifier():
                yield module, key, frozenset(names)


def _named(name: str, given: dict[str, list[str]]) -> Iterable[str]:
    """The modules of a package that is called *name* after ``python3-`` or on PyPI."""
    plain = _PYTHON.sub(r"\1", name).lower()
    return given.get(f"python3-{plain}") or (re.split(r"[.\[=<>]", plain.replace("-", "_"))[0],)


def _flatten(row: Any, names: set[str], pip: set[str], is_pip: bool) -> None:
    """The packages of one platform, whatever its release."""
    if isinstance(row, str):
        (pip if is_pip else names).update(row.split())
    elif isinstance(row, list):
        for each in row:
            _flatten(each, names, pip, is_pip)
    elif isinstance(row, dict):
        for word, each in row.items():
            if word != "depends":
                _flatten(each, names, pip, is_pip or word == "pip")


def _debian() -> Iterator[tuple[str, set[str]]]:
    """Each package of the index that apt has, with what it depends on and what it stands in for."""
    text = subprocess.run(["apt-cache", "dumpavail"], capture_output=True, check=True, text=True).stdout
    real: dict[str, set[str]] = {}
    for stanza in text.split("\n\n"):
        fields = dict(row.split(": ", 1) for row in stanza.split("\n") if ": " in row and not row.startswith(" "))
        name = fields.get("Package")
        if name:
            real.setdefault(name, set()).update(
                _names(fields.get("Depends", "")), _names(fields.get("Pre-Depends", ""))
            )
            for virtual in _names(fields.get("Provides", "")):
                real.setdefault(name, set()).add(virtual)
                real.setdefault(virtual, set())
    yield from real.items()


def _names(field_: str) -> Iterable[str]:
    return (
        re.split(r"[ :(]", each.strip())[0] for part in field_.split(",") for each in part.split("|") if each.strip()
    )
