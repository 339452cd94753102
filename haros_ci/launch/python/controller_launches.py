# SPDX-License-Identifier: Apache-2.0
"""What the ``generate_*_launch_description`` functions of controller_manager's launch_utils.py launch: a spawner."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.entities import description
from haros_ci.launch.python.moveit_launches import argument, configuration, library
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LibraryCall, Rest, Unknown, Value, why

NAME, UNLOAD = "controller_manager_name", "unload_on_kill"


def _spawner(run: ScriptEvaluation, call: LibraryCall, names: Value, files: Value, more: Value) -> Value:
    """A spawner of the controllers, with two launch arguments; whether it unloads them when it ends makes no node."""
    if not isinstance(names, list):
        names = [Unknown(f"the controllers are not known: {why(names)}", call.location)]
    options: list[Value] = ["--controller-manager", configuration(call, NAME)]
    for file in files if isinstance(files, list) else [] if files is None else [files]:
        options += ["--param-file", file]
    if isinstance(more, list):
        options += more
    elif more is not None:
        options.append(Rest(why(more), call.location))
    return description(
        call.location,
        [
            argument(run, call, NAME, "controller_manager"),
            argument(run, call, UNLOAD, "false"),
            library(
                run,
                "launch_ros.actions.Node",
                call,
                package="controller_manager",
                executable="spawner",
                arguments=[*names, *options],
            ),
        ],
    )


def controllers(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``(controller_names, controller_params_files, extra_spawner_args)``."""
    bound = call.bind("controller_names controller_params_files extra_spawner_args")
    return _spawner(
        run, call, bound.get("controller_names"), bound.get("controller_params_files"), bound.get("extra_spawner_args")
    )


def from_dictionary(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``(controller_info_dict, extra_spawner_args)``: the parameter files of each controller by its name."""
    bound = call.bind("controller_info_dict extra_spawner_args")
    found = bound.get("controller_info_dict")
    if not isinstance(found, dict):
        return _spawner(run, call, found, None, bound.get("extra_spawner_args"))
    provided = [value for value in found.values() if value not in (None, "")]
    files = [item for value in provided for item in (value if isinstance(value, list) else [value])]
    return _spawner(run, call, list(found), files, bound.get("extra_spawner_args"))


def one(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``(controller_name, controller_params_file, extra_spawner_args)``; before, a type was the second argument."""
    bound = call.bind("controller_name controller_params_file extra_spawner_args")
    file, kind = bound.get("controller_params_file"), bound.get("controller_type")
    more = bound.get("extra_spawner_args")
    if kind is not None and (more is None or isinstance(more, list)):
        more = [*(more or []), "--controller-type", kind]
    return _spawner(run, call, [bound.get("controller_name")], file, more)


G = "controller_manager.launch_utils.generate_"
SUMMARIES: dict[str, Summary] = {
    f"{G}controllers_spawner_launch_description": controllers,
    f"{G}controllers_spawner_launch_description_from_dict": from_dictionary,
    f"{G}load_controller_launch_description": one,
}
