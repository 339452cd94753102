# SPDX-License-Identifier: Apache-2.0
"""Texts of launch files as values (wiki roslaunch/XML/param, ``type``)."""

from __future__ import annotations

MAX_NUMBER = 100

#: What ``type`` may say, with the type of the value; ``auto`` tells by the text.
TYPES = {
    "auto": None,
    "str": "str",
    "string": "str",
    "int": "int",
    "double": "double",
    "bool": "bool",
    "boolean": "bool",
    "yaml": None,
}


def convert(text: str, kind: str) -> bool | int | float | str:
    """*text* as ``auto``, ``str``, ``int``, ``double`` or ``bool``, by roslaunch's rules; ValueError otherwise.

    ``auto``: a float if there is a dot and it reads as one, else an int, else true and false in any case, else text.
    """
    if kind == "auto":
        return _auto(text)
    if kind == "bool":
        return boolean(text)
    if kind in ("int", "double"):
        if len(text.strip()) > MAX_NUMBER:
            raise ValueError(text)
        return int(text) if kind == "int" else float(text)
    return text


def boolean(text: str) -> bool:
    """``true``, ``1``, ``false`` and ``0`` in any case; ValueError for anything else."""
    word = text.lower().strip()
    if word in ("true", "1"):
        return True
    if word in ("false", "0"):
        return False
    raise ValueError(text)


def type_of(value: object) -> str | None:
    """The parameter type of a ROS 1 value: bool, int, double, str, or yaml for lists and maps."""
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, int):
        return "int"
    if isinstance(value, float):
        return "double"
    if isinstance(value, str):
        return "str"
    return "yaml" if isinstance(value, (list, dict)) else None


def _auto(text: str) -> bool | int | float | str:
    if len(text) <= MAX_NUMBER:
        try:
            if "." in text:
                return float(text)
            if "_" not in text:
                return int(text)
        except ValueError:
            pass
    word = text.lower()
    return boolean(word) if word in ("true", "false") else text
