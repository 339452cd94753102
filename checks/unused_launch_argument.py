# SPDX-License-Identifier: Apache-2.0
"""Launch arguments that an include passes for nothing, and those that nothing reads."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

from haros_ci.api import (
    Check,
    Finding,
    Level,
    Location,
    System,
    all_nearest,
    alternatives,
    equally_near,
    listed,
    regex,
    spelled_out,
)
from haros_ci.api.launch import (
    ArgumentDeclaration,
    IncludeUse,
    PassedArgument,
    included_by,
    is_nested,
    meant,
    outside_file,
    owner,
)

#: A declaration is this many lines long at most.
LINES = 12
_NEXT = regex(
    r"Declare\w{0,40}Launch\w{0,40}Arg|<arg\b|<include\b|<node\b|<!--|^[ \t]*- \w+:|^[ \t]*\w+ = |^[ \t]*\w+\(", re.M
)
#: So many files make a family, whose names begin alike.
_MANY = 3
_FAMILY = regex(r"[A-Za-z0-9]+[_-]")
_COMMENT = regex(r"\s*(?:#|<!--.*-->\s*$)")
_KEPT = regex(
    r"compat(?:ib|\b)|\bdeprecated\b|\blegacy\b|\bobsolete\b|\b(?:is|are|currently|now) (?:ignored|unused)\b|\bno longer\b|\bnot (?:\w+ )?used\b"
    r"|\bunused\b(?!-)|\b(?:has no effect|does nothing|(?:has|have) been left here)\b|\bbreaking downstream\b|\breserved\b|\bplaceholder\b",
    re.I,
)
#: Comments by which something that is not seen needs the argument; the first do so below it, too.
_NOT_TO_GO = regex(r"\b(?:do not|don't|never|must not be) (?:delete|remove|deleted|removed)\b", re.I)
_NEEDED = regex(
    rf"{_NOT_TO_GO.pattern}|\b(?:required|needed|used|expected|read) (?:by|for)\b|\bkept (?:for|as|because)\b|\bkeep\b",
    re.I,
)
_NOTE = regex(r"<!--((?s:.*?))-->|#(.*)")
#: What a launch file reads and declares, and how near two names are.
_READ = regex(r"""\$\((?:arg|var)\s+([\w-]+)\s*\)|\bLaunchConfiguration\(\s*["']([\w-]+)["']""")
_DECLARED = regex(
    r"""<(?:arg|let)\b[^<>]{0,200}?\bname\s*=\s*["']([\w-]+)["']|\b(?:DeclareLaunchArgument|SetLaunchConfiguration)\(\s*(?:name\s*=\s*)?["']([\w-]+)["']"""
)
_NEAR = 0.85
#: The argument that launch files of ROS 2 pass to all others alike.
_CLOCK = "use_sim_time"
#: So many further includes are named.
_SHOWN = 3
#: So many arguments of one include are named.
_NAMED = 5
#: So many names are compared with that of an argument.
_MOST = 200
_TAG = regex(r"<arg\b(?:[^<>\"']|\"[^\"]*\"|'[^']*'){0,400}>")
_VALUES = regex(r"\"[^\"]*\"|'[^']*'")


def check(system: System) -> Iterator[Finding]:
    yield from _passed_for_nothing(system)
    yield from _passed_outside(system)
    yield from _never_read(system)


def _passed_for_nothing(system: System) -> Iterator[Finding]:
    """Arguments that are passed to a file which does not know them."""
    for use in system.facts(IncludeUse):
        known = {*use.declared, *use.read}
        free = sorted({*use.declared} - {passed.name for passed in use.passed})
        if use.ros == 1:
            unknown = [passed for passed in use.passed if passed.name not in known]
            yield from _passed_to_ros1(use, use.path or "", unknown if use.is_whole else [], free)
            continue
        for passed in use.passed if use.is_whole else ():
            if passed.name in known:
                continue
            first, *others = system.whole.passed_for_nothing.get((use.path or "", passed.name), (passed.location,))
            if passed.location != first:
                continue
            similar = all_nearest(passed.name, free, 0.7)
            key = (passed.location.path, passed.name)
            targets = system.whole.passed_with_all.get(key, ())
            if targets:
                if targets[0] == (use.path, passed.location):
                    yield _passed_with_all(use, passed, targets, similar)
                continue
            yield Finding(
                at=passed.location,
                message=f"passes {passed.name!r} to {use.path}, which does not declare it: it has no effect{meant(similar)}",
                about=(use.path or "", passed.name),
                apart=(use.path or "", passed.name),
                flow=included_by(use),
                related=tuple((place, "passes it, too") for place in others[:_SHOWN]),
                level=Level.NOTE if passed.name == _CLOCK and not similar else None,
                presence=use.presence,
            )


def _never_read(system: System) -> Iterator[Finding]:
    """Arguments that are declared and that nothing reads."""
    texts: dict[str, _Text] = {}
    for argument in system.facts(ArgumentDeclaration):
        if argument.is_used is not False:
            continue
        text = texts.get(argument.location.path)
        if text is None:
            text = texts[argument.location.path] = _Text(system, argument.location.path)
        if not _is_kept(argument, text) and not any(
            why(argument, system) for why in (_stands_in, _is_passed, _is_read_by_code)
        ):
            is_set = argument.ros == 1 and _is_set(argument, text)
            what = "is set to a fixed value" if is_set else "is declared"
            so = "" if is_set else " setting it has no effect;"
            if not is_set and argument.default is None and argument.ros == 1:
                so = " as it has no default, who includes or starts the file has to set it, for nothing;"
            yield Finding(
                at=argument.location,
                message=f"launch argument {argument.name!r} {what}, but never read:{so} {_advice(argument, text)}",
                about=(argument.name,),
                apart=(argument.name,),
                flow=included_by(argument),
                presence=argument.presence,
                level=Level.NOTE if is_set or _is_inside(argument, system) or _is_of_family(argument, system) else None,
            )


def _passed_to_ros1(use: IncludeUse, file: str, unknown: list[PassedArgument], free: list[str]) -> Iterator[Finding]:
    """One finding for the arguments that an include of ROS 1 passes and its *file* does not declare: roslaunch ends there."""
    if not unknown:
        return
    first, *others = sorted(unknown, key=lambda passed: passed.location.sort_key)
    names = [passed.name for passed in (first, *others)]
    what = f"passes {spelled_out([repr(name) for name in names])}"
    similar = all_nearest(first.name, free, 0.7) if not others else ()
    yield Finding(
        at=first.location,
        message=f"{what} to {file}, which does not declare {'them' if others else 'it'}: launch stops here{meant(similar)}",
        about=(file, *names[:_NAMED]),
        apart=(file, first.name),
        flow=included_by(use),
        related=tuple((passed.location, f"passes {passed.name!r}") for passed in others[:_NAMED]),
        level=Level.ERROR,
        presence=use.presence,
    )


def _passed_outside(system: System) -> Iterator[Finding]:
    """Arguments that are passed to a launch file outside of the workspace which does not know them."""
    for use in system.facts(IncludeUse):
        known = outside_file(use.text) if use.path is None else None
        if known is None or known.package in system.packages:
            continue
        file = known.name
        free = sorted(known.arguments - {passed.name for passed in use.passed})
        unknown = [passed for passed in use.passed if passed.name not in known.arguments]
        if known.may_differ:  # then only what is a slip of a name that is known
            unknown = [passed for passed in unknown if all_nearest(passed.name, free, 0.7)]
        if use.ros == 1:  # what pass_all_args passes stands at the include itself
            yield from _passed_to_ros1(
                use, file, [passed for passed in unknown if passed.location != use.location], free
            )
            continue
        for passed in unknown:
            similar = all_nearest(passed.name, free, 0.7)
            yield Finding(
                at=passed.location,
                message=f"passes {passed.name!r} to {file}, which does not declare it: it has no effect{meant(similar)}",
                about=(file, passed.name),
                apart=(file, passed.name),
                flow=included_by(use),
                level=Level.NOTE if passed.name == _CLOCK and not similar else None,
                presence=use.presence,
            )


def _passed_with_all(
    use: IncludeUse, passed: PassedArgument, targets: tuple[tuple[str, Location], ...], similar: tuple[str, ...]
) -> Finding:
    """One finding for an argument that a launch file passes with all its includes, some of which do not know it."""
    paths = [path for path, _ in targets]
    return Finding(
        at=passed.location,
        message=f"passes {passed.name!r} with every include, but {listed(paths)} do not declare it: it has no effect there{meant(similar)}",
        about=(*paths, passed.name),
        apart=(*paths, passed.name),
        flow=included_by(use),
        related=tuple((place, f"passes it to {path}, too") for path, place in targets[1:]),
        level=Level.NOTE if passed.name == _CLOCK and not similar else None,
        presence=use.presence,
    )


class _Text:
    """The text of a launch file, which all of its arguments are looked up in."""

    def __init__(self, system: System, path: str) -> None:
        self.whole = system.workspace.text(path) if system.workspace is not None else ""
        self.lines = self.whole.splitlines()

    @cached_property
    def undeclared(self) -> list[str]:
        """Names that it reads and does not declare."""
        return sorted({*_names(_READ, self.whole)} - {*_names(_DECLARED, self.whole)})[:_MOST]


def _is_set(argument: ArgumentDeclaration, text: _Text) -> bool:
    """Whether the ``<arg>`` of ROS 1 has a ``value``: nobody can set it."""
    at = argument.location
    lines = text.lines[max((at.line or 1) - 1, 0) :][:LINES]
    tag = _TAG.search("\n".join(lines), max((at.column or 1) - 1, 0))
    return tag is not None and re.search(r"\svalue\s*=", _VALUES.sub("''", tag[0])) is not None


def _advice(argument: ArgumentDeclaration, text: _Text) -> str:
    """What to do; with the name that the file reads without declaring it, where that is nearly the same."""
    near = alternatives([repr(name) for name in equally_near(argument.name[:100], text.undeclared, _NEAR)])
    if near:
        return f"the file reads {near}, which it does not declare: give both the same name"
    return "use it, or remove the declaration"


def _names(pattern: re.Pattern[str], text: str) -> Iterator[str]:
    return (match[1] or match[2] for match in pattern.finditer(text))


def _is_read_by_code(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether Python code that loads launch files and asks for their arguments may read it."""
    package = owner(system, argument.location)
    file = argument.location.path.rpartition("/")[2]
    return package is not None and system.whole.launch_readers.may_read(argument.name, package.path, file)


def _is_inside(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether the file is of a package that lies in another one, as it was taken over for its models."""
    package = owner(system, argument.location)
    return package is not None and is_nested(argument.location, package, system)


def _is_of_family(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether the file is one of several with the same arguments (a template, the files of one name in several packages), one of which reads it."""
    path = argument.location.path
    folder, _, name = path.rpartition("/")
    family = _FAMILY.match(name)
    same = [file.rpartition("/")[0] for file in system.whole.files_by_name.get(name, ())]
    if len(same) >= _MANY and any((item, argument.name) in system.whole.used_arguments for item in same):
        return True
    if (folder, argument.name) not in system.whole.used_arguments:
        return False
    start = f"{folder}/{family[0]}" if family is not None else path
    beside = [launch_file for launch_file in system.whole.launch_files if launch_file.startswith(start)]
    if len(beside) < _MANY:
        plain = _without_digits(path)
        beside = [file for file in system.whole.launch_files if file != path and _without_digits(file) == plain]
    return not _readers(argument.name, system).isdisjoint(beside)


def _readers(name: str, system: System) -> set[str]:
    """The launch files of all configurations that declare the argument *name* and read it."""
    return {
        fact.location.path
        for other_system in system.whole.systems
        for fact in other_system.facts(ArgumentDeclaration)
        if fact.name == name and fact.is_used
    }


def _without_digits(path: str) -> str:
    """The path of a launch file that is there for each of several robots, as they all have it: ``exp1.launch``."""
    return re.sub(r"\d+", "", path)


def _stands_in(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether *argument* is there for the sake of who includes the file: empty, and of use in a file beside it."""
    if argument.default != "":
        return False
    folder = argument.location.path.rpartition("/")[0]
    return (folder, argument.name) in system.whole.used_arguments


def _is_passed(argument: ArgumentDeclaration, system: System) -> bool:
    """Whether an include of the workspace passes *argument* to the file, or one that may be of it does: then it is an interface."""
    path = argument.location.path
    name = path.rpartition("/")[2]
    if any((place, argument.name) in system.whole.passed_arguments for place in (path, name, "")):
        return True
    return any(argument.name in passed and file.fullmatch(path) for file, passed in system.whole.chosen_files)


def _is_kept(argument: ArgumentDeclaration, text: _Text) -> bool:
    """Whether its description, or a comment beside or above it, says that it is there although nothing reads it."""
    lines = text.lines
    at = (argument.location.line or 1) - 1
    start = _comment_above(lines, at)
    first, *rest = lines[at : at + LINES] or [""]
    after = "\n".join(rest)
    following = _NEXT.search(after)
    near = "\n".join((*lines[start:at], first, after[: following.start()] if following is not None else after))
    above = "\n".join((*lines[start:at], first))
    below = lines[at + 1] if at + 1 < len(lines) and _COMMENT.match(lines[at + 1]) else ""
    return any(
        pattern.search(item)
        for pattern, item in ((_KEPT, near), (_NEEDED, _comments(above)), (_NOT_TO_GO, _comments(below)))
    )


def _comment_above(lines: list[str], at: int) -> int:
    """Where the comments begin that end just above the line *at*, as indices; those of XML may have several lines."""
    start = at
    while start > 0:
        if _COMMENT.match(lines[start - 1]):
            start -= 1
            continue
        if not lines[start - 1].rstrip().endswith("-->"):
            break
        first = next((n for n in range(start - 1, max(start - 1 - LINES, -1), -1) if "<!--" in lines[n]), None)
        if first is None or not lines[first].lstrip().startswith("<!--"):
            break
        start = first
    return start


def _comments(text: str) -> str:
    return "\n".join(match[1] or match[2] or "" for match in _NOTE.finditer(text))


CHECK = Check(
    id="unused-launch-argument",
    summary="Launch argument that is declared or passed but not read.",
    level=Level.WARNING,
    catalogue="L08",
    tags=("launch",),
    run=check,
)
