# SPDX-License-Identifier: Apache-2.0
"""``import``: a module of the workspace is interpreted, any other is a library's name."""

from __future__ import annotations

import ast
import warnings

from haros_ci.launch.python.assignments import set_name
from haros_ci.launch.python.forks import settle
from haros_ci.launch.python.run import ScriptEvaluation, ScriptFrame
from haros_ci.launch.python.values import Library, Module, ScriptScope, ScriptSource, Value
from haros_ci.model.launch_actions import WORKSPACE

#: Libraries with summaries: never interpreted, even if they are in the workspace.
SUMMARISED = frozenset(
    """launch launch_ros launch_xml launch_yaml launch_testing launch_testing_ros launch_testing_ament_cmake nav2_common
    moveit_configs_utils launch_param_builder ament_index_python xacro os sys pathlib yaml json copy math itertools
    functools collections typing re logging tempfile time random shutil subprocess glob platform dataclasses enum abc
    unittest pytest rclpy numpy webots_ros2_driver string textwrap datetime threading socket argparse contextlib operator""".split()
)
MODULES = 40


def import_names(run: ScriptEvaluation, scope: ScriptScope, node: ast.Import) -> None:
    for alias in node.names:
        if alias.asname:
            set_name(run, scope, alias.asname, module(run, alias.name))
        else:
            root = alias.name.split(".")[0]
            set_name(run, scope, root, module(run, root))


def import_from(run: ScriptEvaluation, scope: ScriptScope, node: ast.ImportFrom) -> None:
    origin = node.module or ""
    if node.level:
        package = scope.source.package.split(".")
        origin = ".".join([*package[: len(package) - node.level + 1], *([origin] if origin else [])])
    found = module(run, origin)
    for alias in node.names:
        if alias.name == "*":
            star(run, scope, found, origin)
            continue
        set_name(run, scope, alias.asname or alias.name, member(run, found, origin, alias.name))


def star(run: ScriptEvaluation, scope: ScriptScope, found: Value, origin: str) -> None:
    if isinstance(found, Module):
        for name, value in list(found.variables.items()):
            if not name.startswith("_") and name != "*":
                set_name(run, scope, name, value)
    else:
        set_name(run, scope.module, "*", (*scope.module.variables.get("*", ()), origin))


def member(run: ScriptEvaluation, found: Value, origin: str, name: str) -> Value:
    if isinstance(found, Module):
        if name in found.variables:
            return found.variables[name]
        inner = module(run, f"{origin}.{name}")
        return inner if isinstance(inner, Module) else run.unknown(f"`{name}` is not in {origin}", None)
    return Library(f"{origin}.{name}")


def module(run: ScriptEvaluation, dotted: str) -> Value:
    """The module *dotted*: of the workspace, interpreted once; else a library."""
    if dotted in run.modules:
        return run.modules[dotted]
    if dotted.split(".")[0] in SUMMARISED or not dotted or len(run.modules) >= MODULES:
        return Library(dotted)
    found = beside(run, run.first, dotted) or run.module(dotted) or beside(run, run.last, dotted)
    made = None if found is None else interpreted(run, dotted, *found)
    return Library(dotted) if made is None else made


def beside(run: ScriptEvaluation, directories: list[str], dotted: str) -> tuple[str, str] | None:
    """The path and text of the module *dotted* in the first of *directories* (as ``readable`` gives them) that has it."""
    inner = dotted.replace(".", "/")
    for directory in directories:
        run.budget.step()
        found = run.locate(f"{directory}/{inner}.py") or run.locate(f"{directory}/{inner}/__init__.py")
        if found is not None:
            return found
    return None


def interpreted(run: ScriptEvaluation, dotted: str, path: str, text: str) -> Module | None:
    """The module *dotted* of the file at *path*, its statements done once; None if it is no Python."""
    known = next((made for made in run.modules.values() if made.path == path), None)
    if known is not None:
        run.modules[dotted] = known
        return known
    if path not in run.trees:
        run.trees[path] = parse(text)
    tree = run.trees[path]
    if tree is None:
        return None
    package = dotted if path.endswith("__init__.py") else dotted.rpartition(".")[0]
    source = ScriptSource(path, tuple(text.splitlines()), package)
    scope = ScriptScope({}, None, source)
    scope.variables.update({"__file__": file_marker(path), "__name__": dotted})
    run.modules[dotted] = made = Module(dotted, path, scope.variables)
    module_body(run, scope, tree)
    return made


def module_body(run: ScriptEvaluation, scope: ScriptScope, tree: ast.Module) -> None:
    """Do the statements of a module."""
    frame = ScriptFrame()
    run.frames.append(frame)
    run.block(run, scope, tree.body)
    settle(run, frame, 0)
    run.frames.pop()


def file_marker(path: str) -> str:
    """``__file__`` of a file of the workspace."""
    folder, _, name = path.rpartition("/")
    return f"{WORKSPACE.format(folder or '.')}/{name}"


def parse(text: str) -> ast.Module | None:
    """The syntax of *text*; None if it has none."""
    if len(text) > 1_000_000:
        return None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None
