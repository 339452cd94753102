# SPDX-License-Identifier: Apache-2.0
"""Substitutions of launch in YAML where launch makes none (wiki roslaunch/XML/rosparam; launch_ros, ParameterFile)."""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci.api import Check, Finding, Level, Location, Parameter, Project, dataclass, regex
from haros_ci.api.packages import Element

#: By ROS. A command of the shell begins alike (``$(find . -name x)``, ``$(env -i x)``), and so do things to be filled in (``$(NAME)``).
_WRITTEN = {
    1: regex(r"\$\((?:(?:arg|find|anon) +\w+|(?:env|optenv) +\w+(?: +[\w./:-]+)?|dirname)\)"),
    2: regex(r"\$\((?:(?:var|find-pkg-share|find-pkg-prefix|env|anon) +[\w-]+(?: +[\w./:'\"-]+)?|dirname)\)"),
}
#: Code that makes the substitutions itself.
_OWN = (
    *("substitution_args", "resolve_args", "$(find", "$(var", "$(env", "$(arg", "$(dirname"),
    *("\\(find", "\\(arg", "\\(env", "\\(var", "[(]find", "[(]arg", "[(]env"),
)
_FALSE = frozenset(("", "false", "0"))
#: Longer values are robot descriptions and the like.
_LONG = 2_000
#: So many places in one file are related.
_SHOWN = 5


@dataclass(frozen=True, slots=True)
class _Kept:
    """A substitution, *written* at *at*, that the tag or call *tag* of a launch file of *ros* does not have made."""

    ros: int
    tag: Location
    at: Location
    written: str
    parameter: Parameter


def check(project: Project) -> Iterator[Finding]:
    launched = {place.partition("/")[2] for system in project.systems for place in system.launch}
    if any(not _is_one_of(path, launched) for path in project.code.mentioning(*_OWN)):
        return
    found: dict[tuple[Location, str], dict[Location, _Kept]] = {}
    for system in project.systems:
        for parameter in system.parameters:
            kept = _kept(project, system.ros, parameter)
            if kept is not None:
                found.setdefault((kept.tag, kept.at.path), {}).setdefault(kept.at, kept)
    for places in found.values():
        yield _finding(list(places.values()))


def _is_one_of(path: str, launched: set[str]) -> bool:
    """Whether the file at *path* is a launch file: one of ROS 2 in Python may write such substitutions for launch."""
    return path.endswith(("launch.py", *launched))


def _kept(project: Project, ros: int, parameter: Parameter) -> _Kept | None:
    """The substitution that stands in the value of a parameter as it is written; None if there is none, or launch may make it."""
    tag, at, value = parameter.location, parameter.origin, parameter.value
    if tag is None or at is None or parameter.source != "launch":
        return None
    written = next((item for text in _texts(value) for item in _WRITTEN[ros].findall(text)), None)
    if written is None or written not in project.text(at.path) or _is_made(project, ros, tag):
        return None  # what stands in no file is a path that a launch file has put in
    return _Kept(ros, tag, at, written, parameter)


def _finding(kept: list[_Kept]) -> Finding:
    """One for all that a tag loads from one file: the fix is in the tag."""
    first, others = kept[0], len(kept) - 1
    tag, path = first.tag, first.at.path
    if first.ros == 1:
        instead = 'add subst_value="true"'
        where = "the text of this <rosparam>" if path == tag.path else f"{path}, as <rosparam> loads it"
    else:
        instead = 'load the file with allow_substs="true" (Python: ParameterFile(…, allow_substs=True))'
        where = f"{path}, as the node is given it"
    more = f", and {others} more parameter{'s' if others > 1 else ''} likewise" if others else ""
    return Finding(
        at=tag,
        message=f"{first.written} is not substituted in {where}: the parameter {first.parameter.name} gets this text itself{more}; "
        f"{instead}",
        about=(path, *sorted({other_kept.written for other_kept in kept})),
        related=tuple(
            (other_kept.at, f"{other_kept.written} stays as it is")
            for other_kept in kept[:_SHOWN]
            if other_kept.at != tag
        ),
        presence=first.parameter.presence,
        apart=(path,),
    )


def _is_made(project: Project, ros: int, tag: Location) -> bool:
    """Whether launch makes the substitutions, or may: what a package's directory is nobody knows, so that it stands in the value as it was."""
    if ros == 2:
        return "allow_substs" in project.text(tag.path)
    root = project.element(tag.path)
    found = _at(root, tag.line) if root is not None else None
    return found is None or found.attributes.get("subst_value", "false").lower() not in _FALSE


def _at(root: Element, line: int | None) -> Element | None:
    """The one <rosparam> that stands in a line; None where there are several."""
    found, waiting = [], [root]
    while waiting:
        element = waiting.pop()
        if element.tag == "rosparam" and element.line == line:
            found.append(element)
        waiting += element.children
    return found[0] if len(found) == 1 else None


def _texts(value: object) -> Iterator[str]:
    """The texts in a value, of a list those of its items."""
    for item in value if isinstance(value, (list, tuple)) else (value,):
        if isinstance(item, str) and "$(" in item and len(item) <= _LONG:
            yield item


CHECK = Check(
    id="substitution-not-made",
    summary="Substitution in YAML that launch does not make.",
    level=Level.ERROR,
    tags=("launch", "parameters"),
    profiles=("strict",),
    project=check,
)
