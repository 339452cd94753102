# SPDX-License-Identifier: Apache-2.0
"""Targets that include headers generated in their own package, and are not made after them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from haros_ci.api import Check, Edit, Finding, Fix, Level, Location, Project, ProjectPackage, listed, regex
from haros_ci.api.packages import Target

_PARTS = {
    "msg": ("",),
    "srv": ("", "Request", "Response"),
    "action": ("Action", "ActionGoal", "ActionFeedback", "ActionResult", "Goal", "Feedback", "Result"),
}
#: Targets that stand for the headers of messages, services and actions (genmsg, rosbuild's name too).
_MESSAGES = ("generate_messages", "generate_messages_cpp", "gencpp", "genmsg", "EXPORTED_TARGETS")
#: Names that are meant for targets of generated code: ``pkg_messages_cpp``, ``pkg_gencpp``.
_LIKE_GENERATED = regex(r"_(?:generate\w*|gen\w+|messages?(?:_cpp)?|msgs?_cpp|cfg|EXPORTED_TARGETS)$")
#: The languages that targets of generated code may be for, which make no headers (genlisp, geneus, gennodejs, genpy).
_OTHER_LANGUAGES = {"eus": "EusLisp", "lisp": "Lisp", "nodejs": "JavaScript", "py": "Python"}
#: A reference to the targets of generated code of other packages, which stands for whole names.
_OF_OTHERS = regex(r"\$\{\w+_EXPORTED_TARGETS\}")
#: Commands that generate headers.
_GENERATORS = ("generate_messages", "generate_dynamic_reconfigure_options", "rosidl_generate_interfaces")
_CONFIGS = ("gencfg", "EXPORTED_TARGETS")


def check(project: Project) -> Iterator[Finding]:
    for package in project.packages:
        if not package.cmake.is_whole:
            continue
        if package.ros == 1:
            yield from _catkin(package)
        elif package.ros == 2:
            yield from _ament(package)


def _catkin(package: ProjectPackage) -> Iterator[Finding]:
    """ROS 1: genmsg and dynamic_reconfigure."""
    name, kinds = package.name, dict[str, str]()
    if package.commands("generate_messages"):
        for interface in package.build.interfaces:
            if interface.is_generated:
                kinds |= {f"{interface.name}{part}.h": "messages" for part in _PARTS.get(interface.kind, ())}
    for config in package.build.configs:
        kinds[f"{name}/{config.name}Config.h"] = "configs"
    others = _generated_elsewhere(package)
    reported: set[str] = set()
    for target in _targets(package):
        awaited = package.cmake.awaited(target.name)
        if any("${" in word and not _OF_OTHERS.fullmatch(word) for word in awaited):
            continue  # as in ${a}${b}: which names come of it depends on how many each of them has
        included = package.included.of(target)
        uses: dict[str, Location] = {}
        for kind, ends in (("messages", _MESSAGES), ("configs", _CONFIGS)):
            if not any(word.startswith(f"{name}_") and word.endswith(ends) for word in awaited):
                uses |= {header: place for header, place in included.items() if kinds.get(header) == kind}
        if uses and not any(other.name in reported for other in package.cmake.linked(target.name)):
            reported.add(target.name)
            yield _finding(package, target, uses, _dependency(package, target))
        elif "${catkin_EXPORTED_TARGETS}" not in awaited:
            theirs = {header: place for header, place in included.items() if header in others}
            waits = {word.strip("${}") for word in awaited}
            missing = {h: p for h, p in theirs.items() if not any(word.startswith(f"{others[h]}_") for word in waits)}
            if missing and not any(other.name in reported for other in package.cmake.linked(target.name)):
                reported.add(target.name)
                yield _elsewhere(package, target, others, missing)


def _generated_elsewhere(package: ProjectPackage) -> dict[str, str]:
    """The headers of messages that other packages of the workspace generate and that this one depends on."""
    found: dict[str, str] = {}
    for name in package.declared - {package.name}:
        other = package.project.package(name)
        if other is not None and other.ros == 1 and other.commands("generate_messages"):
            for interface in other.build.interfaces:
                if interface.is_generated:
                    found |= {f"{interface.name}{part}.h": name for part in _PARTS.get(interface.kind, ())}
    return found


def _elsewhere(
    package: ProjectPackage, target: Target, others: Mapping[str, str], uses: Mapping[str, Location]
) -> Finding:
    header, place = next(iter(uses.items()))
    name = target.name
    return Finding(
        at=target.location,
        message=f"target {name} includes {header}, which package {others[header]} generates, but does not depend on the "
        f"generation: catkin_make may compile {name} before the header exists; add add_dependencies({name} "
        f"${{catkin_EXPORTED_TARGETS}})",
        about=(package.name, name),
        apart=(name, header),
        related=((place, f"includes {header}"),),
        level=Level.NOTE,
    )


def _targets(package: ProjectPackage) -> Iterator[Target]:
    """Those that are compiled, and that no command which is not known here may link or order."""
    for target in package.cmake.targets.values():
        is_code = target.kind in ("executable", "library", "object") and target.sources and not target.component
        if is_code and _is_made_beside(package, target) and not package.cmake.may_change(target.name):
            yield target


def _is_made_beside(package: ProjectPackage, target: Target) -> bool:
    """Whether the generation is certain wherever the target is made: neither is under a condition, or the target alone, as under ``if(QT_FOUND)``."""
    return not (target.is_conditional and any(command.is_conditional for command in package.commands(*_GENERATORS)))


def _dependency(package: ProjectPackage, target: Target) -> Fix | None:
    """add_dependencies() on the line behind the one that makes the target, where that is one line."""
    text = package.project.text(target.location.path)
    number = target.location.line or 0
    line = (text.splitlines() or [""])[number - 1] if 0 < number <= len(text.splitlines()) else ""
    made = re.match(r"([ \t]*)(?:add_executable|add_library)\([^()#]*\)[ \t]*$", line)
    if made is None or not package.commands("generate_messages", "generate_dynamic_reconfigure_options"):
        return None
    end = "\r\n" if "\r\n" in text else "\n"
    command = f"{made[1]}add_dependencies({target.name} ${{${{PROJECT_NAME}}_EXPORTED_TARGETS}})"
    point = (number, len(line) + 1)
    makers = package.commands("generate_messages", "generate_dynamic_reconfigure_options")
    if any(m.location.path != target.location.path or (m.location.line or 0) > number for m in makers):
        return None
    return Fix(
        f"make {target.name} after the generated headers", (Edit(target.location.path, point, point, end + command),)
    )


def _ament(package: ProjectPackage) -> Iterator[Finding]:
    """ROS 2: rosidl."""
    made = [command for command in package.commands("rosidl_generate_interfaces") if command.arguments]
    if not made or any(command.is_conditional for command in made):
        return
    generated = {command.arguments[0] for command in made}
    header = re.compile(rf"{re.escape(package.name)}/(?:msg|srv|action)/\w+\.hp?p?")
    for target in _targets(package):
        if _is_supported(package, target, generated):
            continue
        uses = {name: place for name, place in package.included.of(target).items() if header.fullmatch(name)}
        if uses:
            yield _finding(package, target, uses, None)


def _is_supported(package: ProjectPackage, target: Target, generated: set[str]) -> bool:
    """Whether the target is, or may be, compiled with the generated headers."""
    cmake = package.cmake
    names = {target.name, *(other_target.name for other_target in cmake.linked(target.name))}
    if generated & cmake.awaited(target.name) or any("${BUILD}" in word for word in cmake.include_words(target)):
        return True
    for name in names:
        if name in cmake.mentioned:
            return True
        for link in cmake.links.get(name, ()):
            word = link.word
            if any(word.startswith(item) or word.startswith(f"{package.name}::{item}") for item in generated):
                return True
            if "typesupport" in word or (link.is_package and word == package.name) or _is_unknown(word):
                return True
    return any(
        command.arguments[:1] and command.arguments[0] in names
        for command in package.commands("rosidl_target_interfaces")
    )


def _awaited_for_nothing(package: ProjectPackage, target: Target) -> tuple[str, ...]:
    """The names that add_dependencies() has for *target*, that look like those of generated code, and that are no targets."""
    words = sorted(package.cmake.awaited(target.name) - package.cmake.targets.keys())
    return tuple(word for word in words if _LIKE_GENERATED.search(word) is not None and "$" not in word)


def _of_another_language(package: ProjectPackage, word: str) -> str:
    """The language whose code of the package's messages the target *word* makes; "" for any other."""
    name = word.removeprefix(f"{package.name}_")
    made = re.fullmatch(r"(?:generate_messages_|gen)(\w+)", name) if name != word else None
    return _OTHER_LANGUAGES.get(made[1], "") if made is not None and package.commands("generate_messages") else ""


def _generator(package: ProjectPackage) -> str:
    """The last command of the package that makes targets of generated code."""
    makers = package.commands("generate_messages", "generate_dynamic_reconfigure_options")
    return makers[-1].name if makers else "generate_messages"


def _is_unknown(word: str) -> bool:
    """Whether a link may bring anything: a variable that is not one of a package's own."""
    return "${" in word and not re.fullmatch(r"\$\{\w+_(?:LIBRARIES|TARGETS|LIBS|LIBRARY)\}", word)


def _finding(package: ProjectPackage, target: Target, uses: Mapping[str, Location], fix: Fix | None) -> Finding:
    header, place = next(iter(uses.items()))
    more = f" and {len(uses) - 1} more, which are" if len(uses) > 1 else ", which is"
    name = target.name
    wrong = _awaited_for_nothing(package, target) if package.ros == 1 else ()
    languages = [_of_another_language(package, word) for word in wrong]
    if wrong and all(languages):
        what = f"makes the code in {languages[0]}" if len(wrong) == 1 else f"make the code in {listed(languages)}"
        then = f"{listed(wrong)} {what} and no headers of C++, so that a clean parallel build may compile it before the header exists"
        remedy = f"write ${{${{PROJECT_NAME}}_EXPORTED_TARGETS}} instead of {listed(wrong)}"
        fix = None
    elif wrong:
        wrong = tuple(word for word, language in zip(wrong, languages, strict=True) if not language)
        them = "a name that no target has" if len(wrong) == 1 else "names that no target has"
        then = f"add_dependencies({name} {' '.join(wrong)}) has {them}, so that a clean parallel build may compile it before the header exists"
        remedy = f"write ${{${{PROJECT_NAME}}_EXPORTED_TARGETS}} instead of {listed(wrong)}"
        fix = None
    elif package.ros == 1:
        then = "a clean parallel build may compile it before the header exists"
        remedy = f"add add_dependencies({name} ${{${{PROJECT_NAME}}_EXPORTED_TARGETS}}) after {_generator(package)}()"
    else:
        then = "the compiler does not find the header"
        remedy = (
            "add rosidl_get_typesupport_target(support ${PROJECT_NAME} rosidl_typesupport_cpp) and "
            f'target_link_libraries({name} "${{support}}")'
        )
    return Finding(
        at=target.location,
        message=f"target {name} includes {header}{more} generated in {package.name}, but does not depend on the "
        f"generation: {then}; {remedy}",
        about=(package.name, name),
        apart=(name, header),
        related=((place, f"includes {header}"),),
        fixes=(fix,) if fix is not None else (),
    )


CHECK = Check(
    id="generation-not-awaited",
    summary="Target that may be compiled before the message headers that it includes are generated.",
    level=Level.ERROR,
    catalogue="B02",
    tags=("build",),
    project=check,
)
