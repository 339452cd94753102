# SPDX-License-Identifier: Apache-2.0
"""Programs, components and nodelets that launch files start, and that their packages do not have."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, System, alternatives, is_slip, listed
from haros_ci.api.launch import ProgramUse, included_by, meant

_WORDS = {
    "executable": "builds or installs no program",
    "component": "registers no component",
    "nodelet": "exports no nodelet",
}
_KINDS = {"executable": "program", "component": "component", "nodelet": "nodelet"}


def check(system: System) -> Iterator[Finding]:
    for use in system.facts(ProgramUse):
        message = _message(use, system)
        if message:
            yield Finding(
                at=use.location,
                message=message,
                about=(f"{use.package}/{use.program}",),
                flow=included_by(use),
                apart=(use.program,),
                level=Level.WARNING if use.is_found is None else None,
                presence=use.presence,
            )


def _message(use: ProgramUse, system: System) -> str:
    """What is wrong with what is started; "" where it is there, or may be."""
    if use.is_found is None:
        near = tuple(name for name in use.similar if is_slip(name, use.program))
        what = f"package {use.package} is not in the workspace, and haros-ci knows no {_KINDS[use.kind]} {use.program!r} of it"
        return f"{what}: this node probably cannot start{meant(near)}" if near else ""
    if use.is_found:
        return ""
    if use.is_library:
        return f"{use.program!r} of package {use.package} is a library, not a program: this node cannot start{_instead(use)}"
    hint = (
        _as_module(use)
        or _as_script(use, system)
        or meant(use.similar)
        or "; correct the name, or build and install it"
    )
    return f"package {use.package} {_WORDS[use.kind]} {use.program!r}: this node cannot start{hint}"


def _as_module(use: ProgramUse) -> str:
    """What to write where setup.py makes programs of other names of the module that is asked for."""
    names = [repr(name) for name in use.similar] if use.is_module else []
    what = "program" if len(names) == 1 else "programs"
    made = f"; setup.py makes the {what} {listed(names)} of module {use.program.removesuffix('.py')}"
    return "" if not names else f"{made}: write {alternatives(names)}" if alternatives(names) else made


def _as_script(use: ProgramUse, system: System) -> str:
    """What to do where the package has a script of the name, with its ending: whether it is installed, and as what, decides what is meant."""
    script = f"{use.program}.py"
    if use.kind != "executable" or use.similar[:1] != (script,):
        return ""
    package = system.packages.get(use.package)
    if package is not None and package.build_type == "ament_python":
        return (
            f"; the package has {script}, but setup.py makes no program of it: add '{use.program} = MODULE:main' to console_scripts "
            "in entry_points"
        )
    return f"; the package has {script}: start it by that name if it is installed so, or install it with RENAME {use.program}"


def _instead(use: ProgramUse) -> str:
    if use.similar:
        return meant(use.similar)
    or_load = ", or load its component into a container" if use.ros == 2 else ""
    return f"; name a program that links it{or_load}"


CHECK = Check(
    id="unknown-executable",
    summary="Node, component or nodelet that its package does not provide.",
    level=Level.ERROR,
    catalogue="L03",
    tags=("launch",),
    run=check,
)
