# SPDX-License-Identifier: Apache-2.0
"""Files of the workspace that a launch file reads: texts, YAML and JSON as data."""

from __future__ import annotations

import json
from typing import Any

from haros_ci.bounded_yaml import YamlFault, YamlLimits, YamlTooLarge, data
from haros_ci.launch.python.heap import LARGEST
from haros_ci.launch.python.paths import readable
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LibraryCall, Opened, PartialText, PathValue, Unknown, Value, why
from haros_ci.launch.python.written_files import opened_for_writing

DEEPEST = 40
#: The modes of a file that is read.
READING = ("r", "rt", "rb")
LIMITS = YamlLimits(characters=100_000_000, depth=DEEPEST, values=50_000)


def file_text(run: ScriptEvaluation, path: str) -> str | None:
    """The text of a file by a path that ``readable`` gave; each is read once."""
    if path not in run.texts:
        text = run.read(path)
        if text is not None:
            run.budget.take(min(len(text), LARGEST) // 16)
            text = text if len(text) <= LARGEST * 5 else None
        run.texts[path] = text
    return run.texts[path]


def text_in(run: ScriptEvaluation, value: Value, call: LibraryCall) -> str | Unknown:
    """The text of an opened file, or a text itself."""
    if isinstance(value, Opened):
        path = readable(value.path)
        if isinstance(path, Unknown):
            return run.unknown(path.reason, call.location)
        text = file_text(run, path)
        return run.unknown(f"{path} is not in the workspace", call.location) if text is None else text
    if isinstance(value, str):
        return value
    return run.unknown(why(value), call.location)


def yaml_load(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``yaml.safe_load`` of a file or a text, as data; what only Python can make of it is not known."""
    text = text_in(run, call.args[0] if call.args else call.keywords.get("stream"), call)
    if isinstance(text, Unknown):
        return text
    return yaml_data(run, text, call)


def yaml_file(run: ScriptEvaluation, path: Value, call: LibraryCall) -> Value:
    """The data of a YAML file by its path."""
    text = text_in(run, Opened(path), call)
    return text if isinstance(text, Unknown) else yaml_data(run, text, call)


def yaml_data(run: ScriptEvaluation, text: str, call: LibraryCall) -> Value:
    try:
        return own(run, data(text, LIMITS), call, 0)
    except YamlTooLarge:
        return run.unknown("the YAML is too large", call.location)
    except (YamlFault, RecursionError):
        return run.unknown("the YAML is not well-formed", call.location)


def own(run: ScriptEvaluation, found: Any, call: LibraryCall, depth: int) -> Value:
    """A copy of what was *found*, of the kinds that values have."""
    run.budget.take(1)
    if depth > DEEPEST:
        return run.unknown("the data is nested too deep", call.location)
    if isinstance(found, dict):
        return {
            (key if isinstance(key, (str, bool, int, float, type(None))) else str(key)): own(run, item, call, depth + 1)
            for key, item in found.items()
        }
    if isinstance(found, list):
        return [own(run, item, call, depth + 1) for item in found]
    if found is None or isinstance(found, (bool, int, float, str)):
        return run.made(found, call.location)
    return run.unknown(f"a {type(found).__name__} in YAML is not supported", call.location)


def json_load(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``json.load`` and ``json.loads``."""
    text = text_in(run, call.args[0] if call.args else None, call)
    if isinstance(text, Unknown):
        return text
    try:
        return own(run, json.loads(text), call, 0)
    except (ValueError, RecursionError):
        return run.unknown("the JSON is not well-formed", call.location)


def open_file(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``open``: for reading a file that can be read, or for writing; or Unknown."""
    bound = call.bind("file mode")
    path = bound.get("file")
    if isinstance(path, (str, PartialText, PathValue)):
        mode = bound.get("mode", "r")
        return Opened(path) if mode in READING else opened_for_writing(run, path, mode, call.location)
    return run.unknown(f"the path is not known: {why(path)}", call.location)
