# SPDX-License-Identifier: Apache-2.0
"""YAML as programs read it: files of the workspace, texts, streams; plug-ins by their names."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from haros_ci import syntax
from haros_ci.follow import alternatives, construct, dynamic
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import own_files
from haros_ci.follow.walk import Walk
from haros_ci.index.plugins import PluginDescription
from haros_ci.model.location import Location
from haros_ci.values.abstract import NONE, Cell, Choice, Known, Object, Opaque, Sequence, Value, opaque_of

#: Why it is not known whether what a plug-in makes is made.
ANY = "which plug-ins are loaded is a matter of parameters"
#: Plug-ins of one base class that are followed.
MOST = 32


def plugin(walk: Walk, frame: Frame, loader: Object, name: Value, location: Location) -> Value:
    """What pluginlib loads by that name; where a node is followed for its plug-ins, it may be any of that base class.

    These are loaded once at each place of the program for each base class, however often it is gone through.
    """
    of_base, base = walk.context.of_base, _base_name(loader)
    is_listed = base in walk.listed and isinstance(name, Known) and name.value in walk.context.declared.get(base, ())
    is_dead = bool(walk.dead or walk.beyond or frame.is_dead)
    if is_listed and is_dead and of_base is None:
        return NONE  # the program asks for all names, and passes this one over as things are
    named = _named(walk, frame, loader, name, location)
    if of_base is None or walk.quiet or (location, base) in walk.offered or (is_listed and not is_dead):
        return named
    walk.offered.add((location, base))
    loaded = _with_others(walk, frame, named, of_base.get(base, ())[:MOST], location)
    alternatives.mark(walk, base, loaded)
    return named if not loaded else loaded[0] if len(loaded) == 1 else Choice(tuple(loaded))


def _with_others(
    walk: Walk, frame: Frame, named: Value, plugins: Iterable[PluginDescription], location: Location
) -> list[Value]:
    """The plug-in that is named, if it is known, and an instance of each of the other *plugins*."""
    loaded: list[Value] = [named] if isinstance(named, Object) else []
    there = {(value.name, value.arguments) for value in loaded if isinstance(value, Object)}
    for found in plugins:
        if (found.definition.name, found.arguments) not in there:
            walk.gaps.setdefault(ANY, location)
            with walk.doubted(ANY):
                loaded.append(_instance(walk, frame, found, location))
    return loaded


def _base_name(loader: Object) -> str:
    kind = _base(loader)
    return kind.name if kind is not None else ""


def _base(loader: Object) -> syntax.Type | None:
    """The class whose plug-ins the loader gives."""
    found = loader.arguments[0] if loader.arguments else None
    return found if type(found) is syntax.Type else None


def _named(walk: Walk, frame: Frame, loader: Object, name: Value, location: Location) -> Value:
    """An instance of the class that pluginlib loads by that name, where it is of the workspace (wiki.ros.org/pluginlib)."""
    base = _base(loader)
    if isinstance(name, Choice):
        ways = [partial(_named, walk, frame, loader, option, location) for option in name.options]
        return walk.either_way(ways, "it is one of several plug-ins")
    if not isinstance(name, Known) or not issubclass(name.kind, str):
        why = opaque_of(name)
        message = why.reason if why is not None else "it is no text"
        dynamic.plugin(walk, None, f"its name is not known: {message}", location)
        return walk.opaque("the plug-in's name is not known", frame, location.line, base)
    found = walk.context.plugins.get(name.of(str))
    if found is None:
        dynamic.plugin(walk, name.of(str), "it is not in the workspace", location)
        return walk.opaque(f"the plug-in {name.value} is not in the workspace", frame, location.line, base)
    return _instance(walk, frame, found, location)


def _instance(walk: Walk, frame: Frame, found: PluginDescription, location: Location) -> Value:
    return construct.instance(walk, frame, (found.source, found.definition), found.arguments, (), location)


def declared(walk: Walk, loader: Object) -> Value | None:
    """What ``getDeclaredClasses`` gives: the look-up names of the base class's plug-ins, if all are the workspace's."""
    base = _base_name(loader)
    names = walk.context.declared.get(base)
    if names is None:
        return None
    walk.listed.add(base)
    text = syntax.Type("std::string")
    values = [Known(name) for name in names]
    walk.look_ups.update((id(value), value) for value in values)
    return Sequence(Cell(tuple(Cell(value, text) for value in values)), syntax.Type("std::vector", (text,)))


def is_declared(walk: Walk, loader: Object, name: Value) -> Value | None:
    """What ``isClassAvailable`` gives."""
    names = walk.context.declared.get(_base_name(loader))
    if names is None or not isinstance(name, Known):
        return None
    return Known(name.value in names)


def yaml_file(walk: Walk, path: Value) -> Value:
    if (place := own_files.in_workspace(path)) is not None:
        path = Known(place)
    if isinstance(path, Known) and issubclass(path.kind, str):
        if walk.index.trace is not None:
            walk.index.trace.read[path.of(str)] = walk.context.read_yaml.digest(path.of(str))
        found = walk.context.read_yaml(path.of(str))
        if found is not None:
            for trial in walk.trials:
                trial.is_read = trial.is_read or not isinstance(found, Opaque)
            return found
        return Opaque(f"the YAML file {path.value or '(no name)'} is not in the workspace")
    return Opaque("the name of the YAML file is not known")


def yaml_stream(walk: Walk, stream: Value) -> Value:
    if isinstance(stream, Object):
        if "[path]" in stream.fields:
            return yaml_file(walk, stream.fields["[path]"].value)
        if "[text]" in stream.fields:
            stream = stream.fields["[text]"].value
    if isinstance(stream, Known) and issubclass(stream.kind, str):
        found = walk.context.read_yaml(f"\n{stream.value}")
        if found is not None:
            return found
    return Opaque("the YAML text is not known")
