# SPDX-License-Identifier: Apache-2.0
"""Processes that launch files again: ``ros2 launch package file name:=value``, each with nothing but its own arguments and the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING

from haros_ci.graph.words import shell_words
from haros_ci.launch.ros2.context import Context, GroupScope
from haros_ci.launch.ros2.in_shells import commands
from haros_ci.launch.ros2.including import STEPS
from haros_ci.launch.ros2.node import SHELL, command_of
from haros_ci.launch.ros2.outside import include_known
from haros_ci.model.architecture import Condition
from haros_ci.model.launch_actions import Action, Phrase
from haros_ci.substitutions.names import MARK, Text, literal, quoted, unknown

if TYPE_CHECKING:
    from haros_ci.launch.ros2.run import LaunchEvaluation

_ENDINGS = (".py", ".xml", ".yaml", ".yml", ".launch")
#: Options of ``ros2 launch`` that take a value.
_VALUED = ("--launch-prefix", "--launch-prefix-filter")


def launched(run: LaunchEvaluation, action: Action, conditions: tuple[Condition, ...]) -> None:
    """Perform what the process *action* launches."""
    for words in commands(shell_words(command_of(run.context, action).raw), shell_words):
        if words[:2] == ["ros2", "launch"]:
            end = next((number for number, word in enumerate(words) if SHELL.match(word)), None)
            _launch(run, action, conditions, _without_options(words[2:end]))


def _without_options(words: list[str]) -> list[str]:
    found: list[str] = []
    is_value = False
    for word in words:
        if not is_value and not word.startswith("-"):
            found.append(word)
        is_value = not is_value and word in _VALUED
    return found


def _launch(run: LaunchEvaluation, action: Action, conditions: tuple[Condition, ...], words: list[str]) -> None:
    context = run.context
    context.spend(STEPS)
    is_path = bool(words) and words[0].endswith(_ENDINGS)
    if not words or not (is_path or (len(words) > 1 and words[1].endswith(_ENDINGS))):
        return
    file = words[0] if is_path else f"$(find-pkg-share {words[0]})/launch/{words[1]}"
    path, why = _by_path(context, file) if is_path else _in_package(context, words[0], words[1])
    pairs = (word.partition(":=") for word in words[1 if is_path else 2 :])
    passed = {name: literal(value) if MARK not in value else unknown(_PART) for name, sign, value in pairs if sign}
    around = context.scope, context.included
    context.scope = GroupScope(dict(passed), dict(context.scope.environment))
    context.included = context.facts.chain(context.included, action.location)
    if path is not None:
        _perform(run, action, conditions, path)
    else:
        phrases: list[tuple[Text, Phrase]] = [
            (literal(name), (text.raw,)) for name, text in passed.items() if text.known
        ]
        if MARK in file or not include_known(run, action, literal(file), phrases, conditions):
            shown = _shown(" ".join(words[: 1 if is_path else 2]))
            context.problem(action.location, f"launches {quoted(shown)}: {why}; what it starts is unknown")
    context.scope, context.included = around


_PART = "a part of the command line is not known"


def _perform(run: LaunchEvaluation, action: Action, conditions: tuple[Condition, ...], path: str) -> None:
    found = run.description(path)
    if found is None:
        run.context.problem(action.location, f"launches {path}, which is no ROS 2 launch file; correct the path")
        return
    run.included.add(path)
    if any(path == other for other, _ in run.chain):
        run.context.problem(
            action.location, f"launches {path}, which launches this again, without end; break the cycle"
        )
        return
    run.inside(path, found.actions, conditions)


def _by_path(context: Context, file: str) -> tuple[str | None, str]:
    place = context.places.find(file)
    if place.path is None or not context.places.files.has(place.path):
        return None, place.reason or "it is not in the workspace"
    return place.path, ""


def _in_package(context: Context, package: str, name: str) -> tuple[str | None, str]:
    """The only file of that *name* in what *package* shares, as ros2launch looks for it in all directories."""
    if MARK in package or MARK in name:
        return None, _PART
    if package not in context.places.files.directories:
        return None, f"package {quoted(package)} is not in the workspace"
    files = context.places.workspace.files
    found = [one.path for one in files if one.package == package and one.path.rpartition("/")[2] == name]
    if len(found) == 1:
        return found[0], ""
    return None, f"the package has {'several files' if found else 'no file'} of that name"


def _shown(file: str) -> str:
    return file.replace(MARK, "?")
