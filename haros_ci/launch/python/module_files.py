# SPDX-License-Identifier: Apache-2.0
"""Modules that lie beside a launch file: ``sys.path``, importlib and what is like it; they are interpreted, never imported."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary, nothing
from haros_ci.launch.python.imports import MODULES, interpreted, module
from haros_ci.launch.python.paths import readable
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.sequences import items_of
from haros_ci.launch.python.values import Library, LibraryCall, Module, Native, Unknown, Value, why
from haros_ci.model.location import Location

#: Directories that modules are looked for in.
MAX_DIRECTORIES = 40


def is_search_path(value: Value) -> bool:
    """Whether *value* is ``sys.path``."""
    return isinstance(value, Library) and value.dotted == "sys.path"


def search(run: ScriptEvaluation, directory: Value, *, first: bool) -> None:
    """Look for modules in *directory*, too, if it is one of the workspace."""
    path = readable(directory)
    if isinstance(path, Unknown) or len(run.first) + len(run.last) >= MAX_DIRECTORIES:
        return
    if path in run.first or path in run.last:
        return
    if first:
        run.first.insert(0, path)
    else:
        run.last.append(path)


def search_also(run: ScriptEvaluation, directories: Value, place: Location) -> None:
    """``sys.path += [a, b]``, ``sys.path.extend([a, b])``."""
    items = items_of(run, directories, place)
    for item in () if isinstance(items, Unknown) else items:
        search(run, item, first=False)


def append(run: ScriptEvaluation, call: LibraryCall) -> Value:
    search(run, call.bind("directory").get("directory"), first=False)
    return None


def insert(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("index directory")
    search(run, bound.get("directory"), first=bound.get("index") in (0, 1))
    return None


def extend(run: ScriptEvaluation, call: LibraryCall) -> Value:
    search_also(run, call.bind("directories").get("directories"), call.location)
    return None


def file_module(run: ScriptEvaluation, name: Value, path: Value, call: LibraryCall) -> Value:
    """The module of the file at *path*, called *name*."""
    found = readable(path)
    if isinstance(found, Unknown):
        return run.unknown(found.reason, call.location)
    located = run.locate(found) if len(run.modules) < MODULES else None
    made = interpreted(run, name if isinstance(name, str) else found, *located) if located is not None else None
    return run.unknown(f"{found} is no Python module of the workspace", call.location) if made is None else made


def specification(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``spec_from_file_location(name, path)``, ``SourceFileLoader(name, path)``: a specification that is its own loader."""
    bound = call.bind("name path * location loader submodule_search_locations")
    path = bound.get("path", bound.get("location"))
    return specified(file_module(run, bound.get("name", bound.get("fullname")), path, call))


def specified(made: Value) -> Value:
    if not isinstance(made, Module):
        return made
    load = Native("load_module", lambda run, call: made)
    loader = Module("loader", made.path, {"exec_module": Native("exec_module", nothing), "load_module": load})
    own = {"name": made.name, "loader": loader, "origin": made.path, "*made*": made}
    return Module("spec", made.path, own | loader.variables)


def of_specification(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``module_from_spec(spec)``; what the loader does later has been done."""
    spec = call.args[0] if call.args else call.keywords.get("spec")
    if isinstance(spec, Module) and "*made*" in spec.variables:
        return spec.variables["*made*"]
    return run.unknown(why(spec), call.location)


def load_source(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``imp.load_source(name, path)``."""
    bound = call.bind("name pathname")
    return file_module(run, bound.get("name"), bound.get("pathname"), call)


def run_path(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``runpy.run_path(path)``: the names of the module."""
    made = file_module(run, None, call.bind("path_name").get("path_name"), call)
    return dict(made.variables) if isinstance(made, Module) else made


def by_name(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``importlib.import_module(name)`` with an absolute name."""
    name: Value = call.bind("name package").get("name")
    package: Value = call.bind("name package").get("package")
    if not isinstance(name, str):
        return run.unknown(f"the name of the module is not known: {why(name)}", call.location)
    if name.startswith("."):
        if not isinstance(package, str):
            return run.unknown(f"the package that {name} is relative to is not known", call.location)
        level = len(name) - len(name.lstrip("."))
        base = package.split(".")
        name = ".".join([*base[: len(base) - level + 1], *([name[level:]] if name[level:] else [])])
    return module(run, name)


def imported(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``__import__(name)``: the first package of the name."""
    name = call.bind("name").get("name")
    if not isinstance(name, str) or len(call.args) > 1 or call.keywords:
        return run.unknown("what __import__ gives is not known", call.location)
    return module(run, name.split(".")[0])


SUMMARIES: dict[str, Summary] = {
    "sys.path.append": append,
    "sys.path.insert": insert,
    "sys.path.extend": extend,
    "importlib.util.spec_from_file_location": specification,
    "importlib.machinery.SourceFileLoader": specification,
    "importlib.util.spec_from_loader": lambda run, call: (
        call.args[1] if len(call.args) > 1 else call.keywords["loader"]
    ),
    "importlib.util.module_from_spec": of_specification,
    "importlib.import_module": by_name,
    "importlib.reload": lambda run, call: call.args[0],
    "imp.load_source": load_source,
    "runpy.run_path": run_path,
    "builtins.__import__": imported,
}
