# SPDX-License-Identifier: Apache-2.0
"""What is there and of no use yet, or any more: the template of an exercise beside the solution, headers of interfaces that are gone."""

from __future__ import annotations

from posixpath import basename, splitext

from haros_ci.checking.project import ProjectPackage
from haros_ci.regex import regex

#: What leaves a place of a file to whoever fills the template in, and so many of them make one.
_ASKS = regex(r"#[ \t]*TODO\b")
_MANY = 3
_SOURCES = (".cpp", ".cc", ".cxx")
#: A header that is generated of a message or service in ROS 1.
_GENERATED = regex(r"[\"<](\w+)/([A-Z]\w*)\.h[\">]")


def is_unfilled(path: str, package: ProjectPackage) -> bool:
    """Whether the script at *path* is a template with places left to fill in, and the package builds a program of its name in C++: who solves an exercise fills one of both."""
    stem = splitext(basename(path))[0]
    target = package.cmake.targets.get(stem)
    if target is None or target.kind != "executable":
        return False
    own = (file.path for file in package.files if file.path.endswith(_SOURCES))
    return any(splitext(basename(source))[0] == stem for source in own) and (
        sum(1 for _ in _ASKS.finditer(package.project.text(path))) >= _MANY
    )


def lacks_interface(path: str, package: ProjectPackage) -> bool:
    """Whether the header at *path* includes one of an interface of its own *package* of ROS 1, which defines none of this name: nobody can include it."""
    program = package.project.programs.get(path)
    if program is None or package.ros != 1 or any(interface.kind == "action" for interface in package.build.interfaces):
        return False
    made = {interface.name for interface in package.build.interfaces}
    included = (_GENERATED.fullmatch(include) for include in program.includes)
    return any(
        found is not None
        and found[1] == package.name
        and f"{found[1]}/{found[2]}" not in made
        and not package.has(f"include/{found[1]}/{found[2]}.h")
        for found in included
    )
