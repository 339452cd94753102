# SPDX-License-Identifier: Apache-2.0
"""YAML as programs read it: files of the workspace, texts, streams; plug-ins by their names."""

from __future__ import annotations

from functools import partial

from haros_ci.link import construct, dynamic
from haros_ci.link.run import Frame, Run
from haros_ci.link.values import (
    Choice,
    Known,
    Object,
    Opaque,
    Value,
    opaque_of,
)
from haros_ci.model.location import Location


def plugin(run: Run, frame: Frame, loader: Object, name: Value, location: Location) -> Value:
    """An instance of the class that pluginlib loads by that name, where it is of the workspace (wiki.ros.org/pluginlib)."""
    base = loader.arguments[0] if loader.arguments else None
    if isinstance(name, Choice):
        ways = [partial(plugin, run, frame, loader, option, location) for option in name.options]
        return run.either_way(ways, "it is one of several plug-ins")
    if not isinstance(name, Known) or not isinstance(name.value, str):
        why = opaque_of(name)
        said = why.reason if why is not None else "it is no text"
        dynamic.plugin(run, None, f"its name is not known: {said}", location)
        return run.opaque("the plug-in's name is not known", frame, location.line, base)
    found = run.context.plugins.get(name.value)
    if found is None:
        dynamic.plugin(run, name.value, "it is not in the workspace", location)
        return run.opaque(f"the plug-in {name.value} is not in the workspace", frame, location.line, base)
    return construct.instance(run, frame, found, (), (), location)


def yaml_file(run: Run, path: Value) -> Value:
    if isinstance(path, Known) and isinstance(path.value, str):
        if run.index.trace is not None:
            run.index.trace.is_whole = False
        found = run.context.read_yaml(path.value)
        if found is not None:
            return found
        return Opaque(f"the YAML file {path.value or '(no name)'} is not in the workspace")
    return Opaque("the name of the YAML file is not known")


def yaml_stream(run: Run, stream: Value) -> Value:
    if isinstance(stream, Object):
        if "[path]" in stream.fields:
            return yaml_file(run, stream.fields["[path]"].value)
        if "[text]" in stream.fields:
            stream = stream.fields["[text]"].value
    if isinstance(stream, Known) and isinstance(stream.value, str):
        found = run.context.read_yaml(f"\n{stream.value}")
        if found is not None:
            return found
    return Opaque("the YAML text is not known")
