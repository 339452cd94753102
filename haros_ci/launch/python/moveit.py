# SPDX-License-Identifier: Apache-2.0
"""MoveItConfigsBuilder and launch_param_builder's ParameterBuilder, as far as what they load is data."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.container_methods import update
from haros_ci.launch.python.files import file_text, yaml_file
from haros_ci.launch.python.path_methods import package_directory
from haros_ci.launch.python.paths import joined_path, readable
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LaunchObject, LibraryCall, Native, PathValue, Rest, Unknown, Value, why
from haros_ci.launch.python.xacro_documents import MADE
from haros_ci.launch.python.xacro_documents import described as xacro_text
from haros_ci.model.launch_actions import SHARE
from haros_ci.model.location import Location

CONFIGS = "moveit_configs_utils.MoveItConfigs"
BUILDER = "moveit_configs_utils.MoveItConfigsBuilder"
PARAMETERS = "launch_param_builder.ParameterBuilder"
OWN = "$(find-pkg-share moveit_configs_utils)/default_configs"
#: The pipelines that moveit_configs_utils has defaults for; which others a package has is not known.
PIPELINES = ("chomp", "ompl", "pilz_industrial_motion_planner", "stomp")
PARTS = (
    "robot_description",
    "robot_description_semantic",
    "robot_description_kinematics",
    "planning_pipelines",
    "trajectory_execution",
    "planning_scene_monitor",
    "sensors_3d",
    "joint_limits",
    "moveit_cpp",
)
SCENE = (
    "publish_planning_scene",
    "publish_geometry_updates",
    "publish_state_updates",
    "publish_transforms_updates",
    "publish_robot_description",
    "publish_robot_description_semantic",
)

Step = Callable[[ScriptEvaluation, LaunchObject, LibraryCall], None]


def builder(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``MoveItConfigsBuilder(robot_name, robot_description, package_name)``."""
    bound = call.bind("robot_name robot_description package_name")
    robot, package = bound.get("robot_name"), bound.get("package_name")
    if package is None:
        package = f"{robot}_moveit_config" if isinstance(robot, str) else Unknown(why(robot), call.location)
    path = PathValue(package_directory(SHARE, "find-pkg-share", package, call.location))
    word = bound.get("robot_description", "robot_description")
    configs: dict[str, Value] = {name: {} for name in (*PARTS, "pilz_cartesian_limits")}
    configs["move_group_capabilities"] = {"capabilities": "", "disable_capabilities": ""}
    configs["package_path"] = path
    return LaunchObject(
        BUILDER,
        call.location,
        {
            "robot": robot,
            "word": word if isinstance(word, str) else "robot_description",
            "path": path,
            "made": LaunchObject(CONFIGS, call.location, configs),
            "parameters": {},
        },
    )


def parameter_builder(run: ScriptEvaluation, call: LibraryCall) -> Value:
    package = call.bind("package_name").get("package_name")
    path = PathValue(package_directory(SHARE, "find-pkg-share", package, call.location))
    return LaunchObject(PARAMETERS, call.location, {"path": path, "parameters": {}})


def load(run: ScriptEvaluation, made: LaunchObject, file: Value, call: LibraryCall) -> dict[Any, Value]:
    """The data of a YAML file of the package; of one that is not in the workspace nothing is known."""
    path = PathValue(joined_path([made.fields["path"], file]))
    data = yaml_file(run, path, call)
    if isinstance(data, dict):
        return data
    reason = why(data) if isinstance(data, Unknown) else "the YAML is no map"
    lost = Rest(reason, call.location)
    return {lost: lost}


def there(run: ScriptEvaluation, made: LaunchObject, file: str) -> bool:
    path = readable(PathValue(joined_path([made.fields["path"], file])))
    return isinstance(path, str) and file_text(run, path) is not None


def put(run: ScriptEvaluation, made: LaunchObject, part: str, value: Value) -> None:
    configs = made.fields["made"].fields
    run.heap.touch(configs)
    configs[part] = value


def described(part: str, suffix: str) -> Step:
    """robot_description and its semantics are made by xacro of a file; which one, that is not named, is not looked up."""

    def step(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
        bound = call.bind("file_path mappings")
        text: Value = Unknown(MADE, call.location)
        if bound.get("file_path") is not None and not call.unknown:
            path = PathValue(joined_path([made.fields["path"], bound["file_path"]]))
            text = xacro_text(run, path, bound.get("mappings"), call.location)
        put(run, made, part, {made.fields["word"] + suffix: text})

    return step


def loaded(part: str, suffix: str, file: str) -> Step:
    """A part that is a file's data below a key."""

    def step(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
        provided = call.bind("file_path").get("file_path")
        data = load(run, made, file if provided is None else provided, call)
        put(run, made, part, {made.fields["word"] + suffix: data} if suffix else data)

    return step


def sensors(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    provided = call.bind("file_path").get("file_path")
    data = load(run, made, "config/sensors_3d.yaml" if provided is None else provided, call)
    found = data.get("sensors")
    if isinstance(found, list) and not (found and found[0]):
        return
    put(run, made, "sensors_3d", data)


def execution(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    """The controllers: a file that is named, or one of those that are usual."""
    bound = call.bind("file_path moveit_manage_controllers")
    file = bound.get("file_path")
    result: dict[Any, Value] = {"moveit_manage_controllers": bound.get("moveit_manage_controllers", True)}
    if file is None:
        names = ("moveit", "moveit2", made.fields["robot"])
        found = [f"config/{name}_controllers.yaml" for name in names if isinstance(name, str)]
        file = next((item for item in found if there(run, made, item)), None)
    if file is None:
        lost = Rest("which file has the controllers is not known", call.location)
        result[lost] = lost
    else:
        result.update(load(run, made, file, call))
    put(run, made, "trajectory_execution", result)


def scene(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    bound = call.bind(" ".join(SCENE))
    put(
        run,
        made,
        "planning_scene_monitor",
        {name: bound.get(name, not name.startswith("publish_robot")) for name in SCENE},
    )


def pipelines(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    """The planners' files, the package's own or the default; without a list which they are is not known."""
    bound = call.bind("default_planning_pipeline pipelines load_all")
    names, default = bound.get("pipelines"), bound.get("default_planning_pipeline")
    every = bound.get("load_all", True)
    result: dict[Any, Value] = {}
    if isinstance(names, (list, tuple)) and all(isinstance(name, str) for name in names):
        known = list(names)
        result["planning_pipelines"] = known
    else:
        known = [n for n in PIPELINES if every is True or there(run, made, f"config/{n}_planning.yaml")]
        lost = Rest("which planning pipelines there are is known from a directory only", call.location)
        result = {"planning_pipelines": Unknown(lost.reason, call.location), lost: lost}
    if not default:
        default = (
            "ompl"
            if "ompl" in known
            else (
                known[0]
                if known and isinstance(names, (list, tuple))
                else Unknown("which planning pipeline is the default is not known", call.location)
            )
        )
    result["default_planning_pipeline"] = default
    for name in known:
        own = f"config/{name}_planning.yaml"
        result[name] = load(run, made, own if there(run, made, own) else f"{OWN}/{name}_planning.yaml", call)
    ompl = result.get("ompl")
    if isinstance(ompl, dict) and "planner_configs" not in ompl:
        ompl.update(load(run, made, f"{OWN}/ompl_defaults.yaml", call))
    put(run, made, "planning_pipelines", result)


def finished(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> LaunchObject:
    """``to_moveit_configs()``: what has not been asked for is loaded by default."""
    configs = made.fields["made"].fields
    plain = LibraryCall(name=call.name, location=call.location, keywords={})
    for part in PARTS:
        if part != "moveit_cpp" and not configs[part]:
            STEPS[part](run, made, plain)
    if "pilz_industrial_motion_planner" in configs["planning_pipelines"] and not configs["pilz_cartesian_limits"]:
        STEPS["pilz_cartesian_limits"](run, made, plain)
    done: LaunchObject = made.fields["made"]
    return done


def as_dictionary(run: ScriptEvaluation, made: LaunchObject) -> dict[Any, Value]:
    """``MoveItConfigs.to_dict()``."""
    result: dict[Any, Value] = {}
    for part in PARTS:
        value = made.fields[part]
        lost = Rest(why(value), made.location)
        result.update(value if isinstance(value, dict) else {lost: lost})
    limits = made.fields["pilz_cartesian_limits"]
    if isinstance(limits, dict) and isinstance(limits.get("robot_description_planning"), dict):
        planning = result.get("robot_description_planning")
        if isinstance(planning, dict):
            result["robot_description_planning"] = {**planning, **limits["robot_description_planning"]}
    run.budget.take(len(result))
    return result


def yaml_parameters(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    """``ParameterBuilder.yaml(file_path, parameter_namespace)``."""
    bound = call.bind("file_path parameter_namespace")
    data = load(run, made, bound.get("file_path"), call)
    space = bound.get("parameter_namespace")
    target = made.fields["parameters"]
    run.heap.touch(target)
    if isinstance(space, str):
        old = target.get(space)
        target[space] = {**old, **data} if isinstance(old, dict) else data
    else:
        target.update(data)


def one_parameter(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    bound = call.bind("parameter_name parameter_value")
    target = made.fields["parameters"]
    run.heap.touch(target)
    name = bound.get("parameter_name")
    update(
        run,
        target,
        LibraryCall(name="update", location=call.location, args=([(name, bound.get("parameter_value"))],), keywords={}),
    )


def made_parameter(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> None:
    """A parameter that is a file's text, or what xacro makes of it."""
    lost = Unknown("a parameter that is a file's text", call.location)
    one_parameter(
        run, made, LibraryCall(name=call.name, location=call.location, args=(*call.args[:1], lost), keywords={})
    )


STEPS: dict[str, Step] = {
    "robot_description": described("robot_description", ""),
    "robot_description_semantic": described("robot_description_semantic", "_semantic"),
    "robot_description_kinematics": loaded("robot_description_kinematics", "_kinematics", "config/kinematics.yaml"),
    "joint_limits": loaded("joint_limits", "_planning", "config/joint_limits.yaml"),
    "moveit_cpp": loaded("moveit_cpp", "", "config/moveit_cpp.yaml"),
    "pilz_cartesian_limits": loaded("pilz_cartesian_limits", "_planning", "config/pilz_cartesian_limits.yaml"),
    "sensors_3d": sensors,
    "trajectory_execution": execution,
    "planning_scene_monitor": scene,
    "planning_pipelines": pipelines,
    "yaml": yaml_parameters,
    "parameter": one_parameter,
    "xacro_parameter": made_parameter,
    "file_parameter": made_parameter,
}


def moveit_attribute(run: ScriptEvaluation, made: LaunchObject, name: str, place: Location) -> Value:
    """A step of a builder, which gives the builder again, or what comes at its end."""
    if made.name == CONFIGS:
        if name == "to_dict":
            return Native(name, lambda run, call: as_dictionary(run, made))
        return made.fields[name] if name in made.fields else run.unknown(f"MoveItConfigs.{name} is not followed", place)
    if name == "to_moveit_configs" and made.name == BUILDER:
        return Native(name, lambda run, call: finished(run, made, call))
    if name == "to_dict":
        return Native(name, lambda run, call: all_parameters(run, made, call))
    if name not in STEPS:
        return run.unknown(f"{made.name.rpartition('.')[2]}.{name} is not followed", place)

    def step(run: ScriptEvaluation, call: LibraryCall) -> Value:
        STEPS[name](run, made, call)
        return made

    return Native(name, step)


def all_parameters(run: ScriptEvaluation, made: LaunchObject, call: LibraryCall) -> Value:
    result = dict(made.fields["parameters"])
    include = call.bind("include_moveit_configs").get("include_moveit_configs", True)
    if made.name == BUILDER and include is not False:
        result.update(as_dictionary(run, finished(run, made, call)))
    return result


def load_yaml(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """``launch_param_builder.load_yaml(path)``."""
    return yaml_file(run, call.bind("file_path").get("file_path"), call)


SUMMARIES: dict[str, Summary] = {
    BUILDER: builder,
    PARAMETERS: parameter_builder,
    "launch_param_builder.load_yaml": load_yaml,
}


def made_by_moveit(value: LaunchObject) -> bool:
    return value.name in (BUILDER, PARAMETERS, CONFIGS)
