# SPDX-License-Identifier: Apache-2.0
"""Methods that a Python class defines twice: the second takes the place of the first."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Project


def check(project: Project) -> Iterator[Finding]:
    for path, program in sorted(project.programs.items()):
        if program.language != "python" or path.endswith(".pyi") or program.problems:
            continue
        classes = [class_.name for class_ in program.classes]
        columns = {class_.name: class_.column for class_ in program.classes}
        methods: dict[str, list[tuple[int, bool]]] = {}
        for function in program.functions:
            owner, _, last = function.name.rpartition(".")
            if (
                owner
                and owner == function.owner
                and classes.count(owner) == 1
                and function.kind == "function"
                and last != "_"
            ):
                is_plain = not function.decorators and function.column <= columns[owner] + 8
                methods.setdefault(function.name, []).append((function.line, is_plain))
        for name, found in methods.items():
            if len(found) < 2 or not all(is_plain for _, is_plain in found):
                continue
            lines = sorted(line for line, _ in found)
            owner, _, last = name.rpartition(".")
            text = project.text(path).split("\n")
            start = next(class_.line for class_ in program.classes if class_.name == owner)
            if {_indent(text[line - 1]) for line in lines if line <= len(text)} != {_indent_of_body(text, start)}:
                continue  # one of them stands under a condition
            yield Finding(
                at=Location(path, lines[-1]),
                message=f"{owner} defines {last}() again, so that the one in line {lines[-2]} never runs; rename or remove one of them",
                about=(path, name),
                related=((Location(path, lines[-2]), "the first one"),),
                apart=(name,),
            )


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _indent_of_body(text: list[str], start: int) -> int:
    """The indentation of the first statement of the class that begins in line *start*."""
    is_open = True
    for line in text[start - 1 :]:
        code = line.partition("#")[0].rstrip()
        if is_open:
            is_open = not code.endswith(":")
        elif code:
            return _indent(line)
    return -1


CHECK = Check(
    id="method-defined-twice",
    summary="Method that a class defines twice.",
    level=Level.WARNING,
    tags=("python",),
    project=check,
)
