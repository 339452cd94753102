# SPDX-License-Identifier: Apache-2.0
"""What a launch file's command gives to xacro: the file, and its arguments."""

from __future__ import annotations

import shlex
from collections.abc import Mapping

from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.robot.places import as_xacro
from haros_ci.robot.unknown import UNKNOWN, UnknownValue

MAX_LENGTH = 20_000
_SPACE = "\x1f"
_DIRECTORY = regex(r"\$\(([\w-]+) ([^\s()]+)\)")


@dataclass(frozen=True, slots=True)
class XacroCommand:
    """``xacro FILE name:=value…``: *file* as the launch file has it."""

    file: str
    arguments: Mapping[str, str | UnknownValue]


def xacro_command(command: str) -> XacroCommand | None:
    """*command* (``?`` for what is not known in it), if it runs xacro on a file that is known."""
    if len(command) > MAX_LENGTH or "xacro" not in command:
        return None
    try:
        words = shlex.split(_DIRECTORY.sub(rf"$(\1{_SPACE}\2)", command))
    except ValueError:
        return None
    words = [word.replace(_SPACE, " ") for word in words]
    if words[:2] == ["ros2", "run"] or words[:1] == ["rosrun"]:
        words = words[3 if words[0] == "ros2" else 2 :]
    elif words and words[0].rpartition("/")[2].startswith("python"):
        words = words[1:]
    program = words.pop(0).rpartition("/")[2] if words else ""
    if program not in ("xacro", "xacro.py", "?") or {"|", ";", "&&", "?"} & set(words):
        return None
    files: list[str] = []
    arguments: dict[str, str | UnknownValue] = {}
    for word in words:
        name, sign, value = word.partition(":=")
        if sign:
            if "?" in name:
                return None
            arguments[name] = UNKNOWN if "?" in value else as_xacro(value)
        elif not word.startswith("-"):
            files.append(word)
    if len(files) != 1 or "?" in files[0]:
        return None
    if program == "?" and "xacro" not in files[0].rpartition("/")[2]:  # FindExecutable: where it is, nobody knows
        return None
    return XacroCommand(files[0], arguments)
