# SPDX-License-Identifier: Apache-2.0
"""What a package builds, installs and declares, beside its manifest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """An executable or library of CMake. *name* is the target's, *output* the file's name without prefix and suffix.

    *kind*: executable, library (static, shared, module), object, interface, alias. *sources* are paths relative to the workspace root,
    *links* other targets or library names as evaluated. *is_conditional* if a construct that could not be decided stands around it.
    """

    name: str
    package: str
    kind: str
    output: str
    location: Location
    sources: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    is_installed: bool = False
    is_conditional: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Installed:
    """What ``install(...)``, ``catkin_install_python`` or setup.py puts in place: root-relative *path*, *kind* program, file or directory."""

    path: str
    kind: str
    package: str
    destination: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class PluginClass:
    """A ``<class>`` of a plug-in description: look-up *name*, C++ *type*, *base*, *library* (path as written)."""

    name: str
    type: str
    base: str
    library: str
    package: str
    location: Location


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigParameter:
    """One ``gen.add(...)`` of a dynamic_reconfigure .cfg. *type* is bool, int, double or str; groups are dotted into *group*."""

    name: str
    type: str
    default: Any
    minimum: Any
    maximum: Any
    location: Location
    group: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConfigFile:
    """A .cfg file: *name* is the generated class without ``Config`` (third argument of ``gen.generate``)."""

    name: str
    package: str
    path: str
    parameters: tuple[ConfigParameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceField:
    """A field or constant: *type* as written with the package completed (``std_msgs/Header``, ``float64[3]``)."""

    name: str
    type: str
    line: int
    default: Any = None
    is_constant: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Interface:
    """A msg, srv or action definition; *sections* has 1, 2 or 3 parts. *name* is ``pkg/T``."""

    name: str
    kind: str
    path: str
    sections: tuple[tuple[InterfaceField, ...], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Build:
    """All of one package."""

    package: str
    targets: tuple[Target, ...] = ()
    installed: tuple[Installed, ...] = ()
    plugins: tuple[PluginClass, ...] = ()
    configs: tuple[ConfigFile, ...] = ()
    interfaces: tuple[Interface, ...] = ()
    scripts: tuple[str, ...] = ()
    python_roots: tuple[tuple[str, str], ...] = ()
    problems: tuple[Problem, ...] = ()
