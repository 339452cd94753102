# SPDX-License-Identifier: Apache-2.0
"""A small launch context, and shorthands to interpret a launch file's text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.launch.python import Budget, interpret
from haros_ci.model.launch_actions import Action, Description, Performed, Phrase, Substitution, Test

HEAD = """
import os
from pathlib import Path
import json
import yaml
import launch
import launch_ros
from ament_index_python.packages import get_package_share_directory, get_package_share_path
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition, UnlessCondition, LaunchConfigurationEquals, LaunchConfigurationNotEquals
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import Node, LifecycleNode, ComposableNodeContainer, LoadComposableNodes, PushRosNamespace
from launch_ros.actions import SetRemap, SetParameter, SetParametersFromFile, SetUseSimTime, RosTimer
from launch_ros.descriptions import ComposableNode, ParameterFile, ParameterValue
from launch_ros.parameter_descriptions import Parameter
from launch_ros.substitutions import FindPackageShare, FindPackagePrefix, ExecutableInPackage
from nav2_common.launch import RewrittenYaml, ReplaceString, HasNodeParams, LaunchConfigAsBool
"""
PATH = "robot/launch/robot.launch.py"


class Context:
    """A launch context of configurations alone."""

    def __init__(self, **configurations: str) -> None:
        self.configurations = {name: Performed(value) for name, value in configurations.items()}
        self.is_open = False

    def perform(self, phrase: Phrase) -> Performed:
        text, reason = "", ""
        for part in phrase:
            done = Performed(part) if isinstance(part, str) else self.part(part)
            text += done.text
            reason = reason or done.reason
        return Performed(text, reason)

    def part(self, part: Substitution) -> Performed:
        given = [self.perform(argument) for argument in part.arguments]
        if part.kind == "var":
            found = self.configurations.get(given[0].text)
            return found or (given[1] if len(given) > 1 else Performed("?", f"{given[0].text} is not set"))
        if part.kind in ("find-pkg-share", "find-pkg-prefix"):
            return Performed(f"$({part.kind} {given[0].text})")
        if part.kind == "join":
            return Performed("/".join(item.text for item in given))
        return Performed("?", part.reason or f"$({part.kind})")

    def configuration(self, name: str) -> Performed | None:
        return self.configurations.get(name)

    def names_of_configurations(self) -> tuple[str, ...] | None:
        return None if self.is_open else tuple(self.configurations)

    def set_configuration(self, name: str, value: Performed) -> None:
        self.configurations[name] = value

    def set_any_configuration(self) -> None:
        self.is_open = True

    def test(self, test: Test) -> bool | None:
        if test.kind in ("if", "unless"):
            word = self.perform(test.phrases[0])
            if not word.known or word.text.lower() not in ("true", "false", "1", "0"):
                return None
            return (word.text.lower() in ("true", "1")) == (test.kind == "if")
        if test.kind in ("equals", "not-equals"):
            name, wanted = (self.perform(phrase).text for phrase in test.phrases)
            found = self.configurations.get(name)
            return None if found is None else (found.text == wanted) == (test.kind == "equals")
        return None


def describe(
    text: str,
    files: Mapping[str, str] | None = None,
    environment: Mapping[str, str] | None = None,
    modules: Mapping[str, str] | None = None,
    budget: Budget | None = None,
    asked: list[str] | None = None,
) -> Description:
    """The description of *text*; *files* by the paths that launch text has."""

    def read(path: str) -> str | None:
        if asked is not None:
            asked.append(path)
        return (files or {}).get(path)

    def module(dotted: str) -> tuple[str, str] | None:
        found = (modules or {}).get(dotted)
        return None if found is None else (f"robot/{dotted.replace('.', '/')}.py", found)

    return interpret(PATH, HEAD + text, read, environment or {}, module, budget)


def actions(body: str, before: str = "", **options: Any) -> tuple[Action, ...]:
    """The actions of a launch file whose ``generate_launch_description`` has *body*; ``ld`` is what it returns."""
    lines = "".join(f"    {line}\n" for line in body.strip("\n").splitlines())
    text = f"{before}\ndef generate_launch_description():\n    ld = LaunchDescription()\n{lines}    return ld\n"
    made = describe(text, **options)
    assert made.problems == ()
    return made.actions


def value_of(expression: str, before: str = "", body: str = "", **options: Any) -> Phrase:
    """The phrase of an expression's value, by way of a launch argument's default."""
    made = actions(
        f"{body}\nld.add_action(DeclareLaunchArgument('x', default_value=str({expression})))", before, **options
    )
    return made[-1].get("default") or ()


def unknowns(phrase: Phrase) -> list[str]:
    return [part.reason for part in phrase if isinstance(part, Substitution) and part.kind == "?"]


def var(name: str) -> tuple[str, tuple[str, ...]]:
    """What ``brief`` makes of a launch configuration."""
    return "var", (name,)


def brief(phrase: Phrase | None) -> Any:
    """A phrase without places: texts, and (kind, arguments)."""
    if phrase is None:
        return None
    made = tuple(p if isinstance(p, str) else (p.kind, tuple(brief(a) for a in p.arguments)) for p in phrase)
    return made[0] if len(made) == 1 and isinstance(made[0], str) else made
