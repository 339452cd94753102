# SPDX-License-Identifier: Apache-2.0
"""Summaries of ``os``, ``os.path``, ``pathlib`` and ``ament_index_python``."""

from __future__ import annotations

import posixpath
from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.files import READING, file_text
from haros_ci.launch.python.paths import absolute, base_name, clean, directory, joined_path, parent_path, readable
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import (
    LibraryCall,
    Native,
    Opened,
    PartialText,
    PathValue,
    Unknown,
    Value,
    phrase,
    uncertain,
    why,
)
from haros_ci.launch.python.written_files import opened_for_writing, written_text
from haros_ci.model.launch_actions import PREFIX, SHARE, Phrase, Substitution
from haros_ci.model.location import Location

Summary = Callable[[ScriptEvaluation, LibraryCall], Value]


def first(call: LibraryCall, name: str = "path") -> Value:
    """The first argument, as a text if it is a path."""
    value = call.args[0] if call.args else call.keywords.get(name)
    return value.text if isinstance(value, PathValue) else value


def on_text(work: Callable[[Value], Value]) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        value = first(call)
        return (
            work(value)
            if isinstance(value, (str, PartialText))
            else run.unknown(f"the path is not known: {why(value)}", call.location)
        )

    return summary


def exists(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """True for a file of the workspace; what is not there may be made by a build."""
    path = readable(first(call))
    if isinstance(path, Unknown):
        return run.unknown(path.reason, call.location)
    return (
        True
        if file_text(run, path) is not None
        else run.unknown(f"whether {path} is there is not known", call.location)
    )


def split(run: ScriptEvaluation, call: LibraryCall) -> Value:
    text = first(call)
    return (
        (directory(text), base_name(text))
        if isinstance(text, (str, PartialText))
        else run.unknown(why(text), call.location)
    )


def split_extension(text: Value) -> Value:
    return posixpath.splitext(text) if isinstance(text, str) else Unknown(why(text))


def is_absolute(text: Value) -> Value:
    if isinstance(text, str):
        return absolute(text)
    return Unknown(why(text), None)


def share(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return package_directory(SHARE, "find-pkg-share", first(call, "package_name"), call.location)


def prefix(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return package_directory(PREFIX, "find-pkg-prefix", first(call, "package_name"), call.location)


def package_directory(marker: str, kind: str, package: Value, place: Location) -> Value:
    """The marker of a package's directory, or a substitution where its name is not known."""
    if isinstance(package, str):
        return marker.format(package)
    return PartialText((Substitution(kind, (phrase(package),), place),))


def share_path(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return PathValue(share(run, call))


def get_environment(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``os.getenv``/``os.environ.get``: the value; without one a substitution with the default, if there is one."""
    bound = call.bind("key default")
    key = bound.get("key")
    if not isinstance(key, str):
        return run.unknown(why(key), call.location)
    if key in run.environment:
        return run.environment[key]
    default = bound.get("default")
    if isinstance(default, (str, PartialText)):
        arguments: tuple[Phrase, ...] = ((key,), phrase(default))
        return PartialText((Substitution("env", arguments, call.location),))
    return run.unknown(f"the environment variable {key} is not known", call.location)


def make_path(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``Path(a, b)``."""
    return PathValue(joined_path(list(call.args)) if call.args else ".")


def join(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return run.made(joined_path(list(call.args)), call.location)


def split_path(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return run.unknown(f"what {call.name} gives is not known", call.location)


SUMMARIES: dict[str, Summary] = {
    "os.path.join": join,
    "os.path.dirname": on_text(directory),
    "os.path.basename": on_text(base_name),
    "os.path.abspath": on_text(clean),
    "os.path.realpath": on_text(clean),
    "os.path.normpath": on_text(clean),
    "os.path.expanduser": split_path,
    "os.path.expandvars": split_path,
    "os.path.exists": exists,
    "os.path.isfile": exists,
    "os.path.isdir": exists,
    "os.path.split": split,
    "os.path.splitext": on_text(split_extension),
    "os.path.isabs": on_text(is_absolute),
    "os.fspath": on_text(lambda text: text),
    "os.getenv": get_environment,
    "os.environ.get": get_environment,
    "pathlib.Path": make_path,
    "pathlib.PurePath": make_path,
    "pathlib.PosixPath": make_path,
    "pathlib.PurePosixPath": make_path,
    "ament_index_python.get_package_share_directory": share,
    "ament_index_python.get_package_prefix": prefix,
    "ament_index_python.get_package_share_path": share_path,
}


def path_attribute(run: ScriptEvaluation, path: PathValue, name: str, place: Location) -> Value:
    """An attribute or a method of a Path."""
    text = path.text
    if name == "parent":
        return parent_path(path)
    if name == "name":
        return base_name(text)
    if name in ("stem", "suffix"):
        base = base_name(text)
        if not isinstance(base, str):
            return run.unknown(why(base), place)
        return posixpath.splitext(base)[0 if name == "stem" else 1]
    if name == "parents":
        return Native("parents", lambda run, call: path)
    work = METHODS.get(name)
    if work is None:
        return run.unknown(f"Path.{name} is not followed", place)
    return Native(name, lambda run, call: work(run, path, call))


def open_path(run: ScriptEvaluation, path: PathValue, call: LibraryCall) -> Value:
    mode = call.bind("mode").get("mode", "r")
    return Opened(path) if mode in READING else opened_for_writing(run, path, mode, call.location)


def read_text(run: ScriptEvaluation, path: PathValue, call: LibraryCall) -> Value:
    return run.call(run, Native("read", lambda run, call: read_opened(run, Opened(path), call.location)), call)


def read_opened(run: ScriptEvaluation, file: Opened, place: Location) -> Value:
    """``file.read()``."""
    path = readable(file.path)
    if isinstance(path, Unknown):
        return run.unknown(path.reason, place)
    text = file_text(run, path)
    return run.unknown(f"{path} is not in the workspace", place) if text is None else run.made(text, place)


def with_suffix(run: ScriptEvaluation, path: PathValue, call: LibraryCall) -> Value:
    text, suffix = path.text, first(call, "suffix")
    if uncertain(text) or not isinstance(suffix, str):
        return run.unknown(why(text), call.location)
    return PathValue(posixpath.splitext(text)[0] + suffix)


METHODS: dict[str, Callable[[ScriptEvaluation, PathValue, LibraryCall], Any]] = {
    "joinpath": lambda run, path, call: PathValue(joined_path([path, *call.args])),
    "resolve": lambda run, path, call: PathValue(clean(path.text)),
    "absolute": lambda run, path, call: PathValue(clean(path.text)),
    "expanduser": lambda run, path, call: run.unknown(
        "the path begins in the home directory of the user who launches it", call.location
    ),
    "as_posix": lambda run, path, call: path.text,
    "__str__": lambda run, path, call: path.text,
    "exists": lambda run, path, call: exists(
        run, LibraryCall(name="exists", location=call.location, args=(path,), keywords={})
    ),
    "is_file": lambda run, path, call: exists(
        run, LibraryCall(name="exists", location=call.location, args=(path,), keywords={})
    ),
    "open": open_path,
    "read_text": read_text,
    "write_text": written_text,
    "with_suffix": with_suffix,
    "with_name": lambda run, path, call: PathValue(joined_path([parent_path(path), first(call, "name")])),
    "is_absolute": lambda run, path, call: is_absolute(path.text),
}
