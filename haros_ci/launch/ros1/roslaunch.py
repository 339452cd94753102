# SPDX-License-Identifier: Apache-2.0
"""ROS 1 launch files evaluated as roslaunch does (wiki roslaunch/XML): which nodes start, which parameters are set."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from haros_ci.launch.facts import ros1
from haros_ci.launch.facts.memory import Memo, steps_for, take
from haros_ci.launch.facts.record import Recorder
from haros_ci.launch.ros1 import outside
from haros_ci.launch.ros1.arg import arg, passed_arg
from haros_ci.launch.ros1.node import environment as environment_tag
from haros_ci.launch.ros1.node import machine, node, remap
from haros_ci.launch.ros1.param import scope_param
from haros_ci.launch.ros1.presence import perform
from haros_ci.launch.ros1.rosparam import rosparam
from haros_ci.launch.ros1.scope import LoaderScope, location
from haros_ci.launch.ros1.state import RoslaunchBudgetExhausted, RoslaunchState, check_clear_params, inner_namespace
from haros_ci.model.architecture import Condition, Parameter
from haros_ci.model.environment import key_of
from haros_ci.model.faults import FAULTS, fault
from haros_ci.model.launch import Launched, LaunchElement, LaunchFile
from haros_ci.model.location import Location
from haros_ci.model.workspace import Problem, Workspace
from haros_ci.substitutions.files import files_of
from haros_ci.substitutions.names import Text, literal, quoted
from haros_ci.substitutions.presence import LaunchArguments

#: How deep groups and includes may be nested, together.
MAX_DEPTH = 60

_Handler = Callable[[RoslaunchState, LoaderScope, LaunchElement, tuple[Condition, ...]], None]


def evaluate(
    launch_paths: Sequence[str],
    workspace: Workspace,
    load: Callable[[str], LaunchFile | None],
    arguments: Mapping[str, str],
    environment: Mapping[str, str],
    alternatives: bool = False,
    memo: Memo | None = None,
) -> Launched:
    """What the launch files at *launch_paths*, root-relative, start and set together, in order.

    *load* gives the facts of a launch file, *workspace* packages and texts of other files; *arguments* are set for
    each of the files, as on roslaunch's command line, and *environment* is all that ``$(env)`` and ``$(optenv)`` see.
    A tag that roslaunch refuses is left out with a problem; what stays undecided is kept with its condition. With
    *alternatives* all has its presence, and what is started and set with other arguments is in the result, too. With a *memo* what has been
    evaluated before is not evaluated again.
    """
    key = (
        "roslaunch",
        *launch_paths,
        tuple(sorted(arguments.items())),
        key_of(environment),
        alternatives,
    )
    if memo is not None and key in memo:
        before: Launched = memo[key]
        return before
    state = RoslaunchState(files=files_of(workspace), load=load, environment=environment)
    budget, spare = steps_for(memo, state.budget), steps_for(memo, state.spare)
    state.budget, state.spare = budget, spare
    state.arguments = LaunchArguments() if alternatives else None
    provided = {name: literal(value) for name, value in sorted(arguments.items())}
    declared: set[str] = set()
    try:
        for path in launch_paths:
            declared |= _top_level(state, path, provided)
    except RoslaunchBudgetExhausted:
        message = "the launch files include and set more than can be evaluated; what is left is unknown"
        state.problems[Problem(launch_paths[0], message)] = None
    else:
        for name in (name for name in provided if name not in declared and launch_paths):
            state.problem(launch_paths[0], None, f"argument {quoted(name)} is set, but not declared; correct its name")
    parameters = tuple(parameter for _, together in sorted(state.parameters.items()) for parameter in together)
    _check_parents(state, parameters)
    _check_machines(state)
    launched = Launched(
        nodes=tuple(state.nodes),
        parameters=parameters,
        arguments=tuple(state.arguments_shown.items()),
        files=tuple(sorted(state.read)),
        includes=tuple(sorted(state.included)),
        problems=(*state.problems, *_assumed_problems(state)),
        alternatives=tuple(state.alternatives),
        alternative_parameters=tuple(state.alternative_parameters),
        facts=tuple(state.facts.found.values()),
    )
    take(memo, budget - max(state.budget, 0) + spare - max(state.spare, 0))
    if memo is not None:
        memo[key] = launched
    return launched


def _assumed_problems(state: RoslaunchState) -> list[Problem]:
    """What is wrong with other args alone, each with the first of them."""
    return [
        Problem(problem.path, f"{problem.message} (with {words})", problem.line)
        for problem, words in state.assumed_problems.items()
        if problem not in state.problems
    ]


def _top_level(state: RoslaunchState, path: str, provided: Mapping[str, Text]) -> set[str]:
    """Evaluate one file and return the names of the args that it declares."""
    root = _root(state, path, None)
    if root is None:
        return set(provided)
    scope = LoaderScope(path=path, namespace=Text("/"), directory=state.files.directory_of(path), args=dict(provided))
    scope.chain = ((path, _frozen(scope.args)),)
    _walk(state, scope, root.children)
    for name in scope.declared:
        state.arguments_shown[name] = scope.args[name].shown if name in scope.args else "?"
    return set(scope.declared)


def _root(
    state: RoslaunchState, path: str, included_by: tuple[LoaderScope, LaunchElement] | None
) -> LaunchElement | None:
    """The ``<launch>`` of the file at *path*; None, with a problem, if there is none."""
    launch = state.load(path)
    if launch is None:
        if included_by is None:
            state.problem(path, None, "no such launch file in the workspace; correct its path")
        else:
            message = f"includes {path}, which is no launch file of the workspace; correct the path"
            state.wrong(*included_by, message, certain=True)
        return None
    state.read.add(path)
    scope = included_by[0] if included_by is not None else None
    ros1.foreign(state, scope, path, launch)
    for line, message in launch.problems:
        state.problem(path, line, message)
    if launch.root is None:
        return None
    if launch.root.tag != "launch":
        state.problem(path, launch.root.line, f"not a launch file: its root is <{launch.root.tag}>, not <launch>")
        return None
    deprecated = launch.root.get("deprecated")
    if deprecated and included_by is not None:
        state.wrong(*included_by, f"includes {path}, which is deprecated: {quoted(deprecated)}")
    return launch.root


def _walk(state: RoslaunchState, scope: LoaderScope, tags: tuple[LaunchElement, ...]) -> None:
    for tag in tags:
        state.spend(5)
        handler = _HANDLERS.get(tag.tag)
        if handler is None:
            if tag.tag != "master":
                state.wrong(scope, tag, f"roslaunch knows no <{tag.tag}> here; remove it or correct its name")
                ros1.ignored(state, scope, tag)
            continue
        before = state.presence, state.assumed, state.assumptions, state.is_asking, state.is_spare
        try:
            perform(state, scope, tag, handler)
        except FAULTS as err:
            state.presence, state.assumed, state.assumptions, state.is_asking, state.is_spare = before
            state.wrong(scope, tag, fault("what this starts could not be followed", err))
            state.is_partial = True


def _group(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    state.check_attributes(scope, tag, ("ns", "clear_params"))
    namespace = inner_namespace(state, scope, tag)
    if namespace is None or not check_clear_params(state, scope, tag):
        return
    inner = scope.child(namespace, conditions)
    if inner.depth > MAX_DEPTH:
        state.wrong(scope, tag, f"groups and includes are nested deeper than {MAX_DEPTH}; what is inside is left out")
        return
    state.spend(len(scope.args) // 4 + len(scope.privates) // 4)
    _walk(state, inner, tag.children)


def _include(state: RoslaunchState, scope: LoaderScope, tag: LaunchElement, conditions: tuple[Condition, ...]) -> None:
    state.spend(100)
    state.check_attributes(scope, tag, ("file", "ns", "clear_params", "pass_all_args"))
    needed = state.required(scope, tag, "file")
    if needed is None:
        return
    pass_all = state.truth(scope, tag, "pass_all_args")
    namespace = inner_namespace(state, scope, tag)
    if namespace is None or not check_clear_params(state, scope, tag):
        return
    inner = scope.child(namespace, conditions)
    passed = dict(scope.args) if pass_all else {}
    state.spend(len(scope.args) // 4)
    doubtful: set[str] = set()
    named: set[str] = set()
    for child in tag.children:
        _include_child(state, inner, child, passed, doubtful, set() if pass_all else named)
    entered = replace(
        inner,
        args=passed,
        declared={},
        missing={},
        doubtful=doubtful,
        unset=dict(scope.unset) if pass_all else {},
        overrides_allowed=pass_all is True,
        included_at=location(scope, tag),
        includes=state.facts.chain(scope.includes, location(scope, tag)),
    )
    place = state.files.place(needed[0])
    if place.path is not None:
        _inside(state, scope, entered, tag, needed[0], place.path, pass_all)
        return
    known = outside.known(needed[0], tag) if place.outside and inner.depth <= MAX_DEPTH else None
    if known is not None:
        _outside(state, scope, entered, tag, needed[0], known)
        return
    shown = quoted(needed[0].shown)
    state.wrong(scope, tag, f"includes {shown}: {place.reason}; what it starts is unknown")
    state.is_partial = True
    ros1.included(state, scope, tag, needed[0], passed=passed)


def _inside(
    state: RoslaunchState,
    scope: LoaderScope,
    entered: LoaderScope,
    tag: LaunchElement,
    file: Text,
    path: str,
    pass_all: bool | None,
) -> None:
    """Evaluate the launch file at the root-relative *path*, in the scope *entered*, which has the arguments that are passed."""
    link = (path, _frozen(entered.args))
    if link in scope.chain:
        state.wrong(scope, tag, f"includes {path}, which includes this again, without end; break the cycle")
        return
    if entered.depth > MAX_DEPTH:
        state.wrong(scope, tag, f"groups and includes are nested deeper than {MAX_DEPTH}; {path} is left out")
        return
    root = _root(state, path, (scope, tag))
    if root is None:
        state.is_partial = True
        ros1.included(state, scope, tag, file, passed=entered.args)
        return
    state.included.add(path)
    names = tuple(entered.args)
    inner = replace(
        entered,
        path=path,
        directory=state.files.directory_of(path),
        privates=scope.privates if scope.privates else [],  # roslaunch shares this list, once there is something in it
        chain=(*scope.chain, link),
    )
    _walk(state, inner, root.children)
    own = () if pass_all else names
    ros1.included(state, scope, tag, file, path, own, inner.declared, is_whole=pass_all is False)
    unused = [name for name in names if name not in inner.declared]
    if unused and pass_all is False:
        listed = ", ".join(quoted(name) for name in unused[:5])
        state.wrong(scope, tag, f"passes {listed}, which {path} does not declare; remove it, or declare it there")


def _outside(
    state: RoslaunchState, scope: LoaderScope, entered: LoaderScope, tag: LaunchElement, file: Text, root: LaunchElement
) -> None:
    """Evaluate the *root* of a launch file outside the workspace; what it says by itself is no fact of the workspace."""
    passed = tuple(entered.args)
    facts = state.facts
    state.facts = Recorder()
    try:
        _walk(state, entered, root.children)
    finally:
        state.facts = facts
    ros1.included(state, scope, tag, file, passed=passed)


def _include_child(
    state: RoslaunchState,
    inner: LoaderScope,
    child: LaunchElement,
    passed: dict[str, Text],
    doubtful: set[str],
    named: set[str],
) -> None:
    """An ``<arg>`` or ``<env>`` inside an ``<include>``."""
    state.spend(5)
    kind = child.tag.lower()
    if kind not in ("arg", "env"):
        state.wrong(inner, child, f"<{child.tag}> cannot stand in <include>; remove it")
        ros1.ignored(state, inner, child, "include")
        return
    conditions = state.conditions(inner, child)
    if conditions is None:
        return
    if kind == "env":
        environment_tag(state, inner, child, conditions)
        return
    name = passed_arg(state, inner, child, conditions, passed)
    if name is None:
        return
    if len(conditions) > len(inner.conditions):
        doubtful.add(name)
    elif name in named:
        state.wrong(inner, child, f"argument {quoted(name)} is passed twice; keep one")
    else:
        named.add(name)


def _frozen(args: Mapping[str, Text]) -> tuple[tuple[str, Text], ...]:
    return tuple(sorted(args.items(), key=lambda item: item[0]))


def _check_parents(state: RoslaunchState, parameters: tuple[Parameter, ...]) -> None:
    """A parameter with a value cannot hold others; roslaunch warns of it."""
    values = {parameter.name: parameter for parameter in parameters if not parameter.conditions}
    values = {name: parameter for name, parameter in values.items() if "?" not in name}
    for name, parameter in values.items():
        pieces = name.split("/")
        for count in range(2, min(len(pieces), 50)):
            above = values.get("/".join(pieces[:count]))
            if above is not None and above.location is not None and parameter.location is not None:
                message = f"parameter {quoted(name)} lies below {quoted(above.name)}, which has a value"
                at: Location = parameter.location
                state.problem(at.path, at.line, f"{message} ({above.location.path}:{above.location.line}); rename one")


def _check_machines(state: RoslaunchState) -> None:
    """A node's machine must be declared; where an include cannot be read, it may be there."""
    for started in () if state.is_partial else state.nodes:
        machine_name = started.machine
        if machine_name and "?" not in machine_name and machine_name not in state.machines:
            at = started.location
            state.problem(at.path, at.line, f"machine {quoted(machine_name)} is not declared; add a <machine> for it")


_HANDLERS: Mapping[str, _Handler] = {
    "arg": arg,
    "env": environment_tag,
    "group": _group,
    "include": _include,
    "machine": machine,
    "node": node,
    "param": scope_param,
    "remap": remap,
    "rosparam": rosparam,
    "test": node,
}
