# SPDX-License-Identifier: Apache-2.0
"""A Python launch file as a description, by interpretation of its syntax; nothing of it is imported or executed."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from haros_ci.launch.python import written_files
from haros_ci.launch.python.attributes import attribute
from haros_ci.launch.python.definitions import call_function
from haros_ci.launch.python.entities import DESCRIPTION, actions_of, doubted, unknown_action
from haros_ci.launch.python.expressions import evaluate
from haros_ci.launch.python.heap import Budget, Heap, ScriptBudgetExhausted
from haros_ci.launch.python.imports import file_marker, module_body, parse
from haros_ci.launch.python.library import call_value, summary_of
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.statements import block
from haros_ci.launch.python.values import (
    LaunchObject,
    LibraryCall,
    ScriptFunction,
    ScriptScope,
    ScriptSource,
    Unknown,
    Value,
)
from haros_ci.model.environment import lost_of
from haros_ci.model.launch_actions import Action, Description
from haros_ci.model.location import Location

ENTRIES = ("generate_launch_description", "generate_test_description")


def interpret(
    path: str,
    text: str,
    read: Callable[[str], str | None],
    environment: Mapping[str, str],
    module: Callable[[str], tuple[str, str] | None] | None = None,
    budget: Budget | None = None,
    locate: Callable[[str], tuple[str, str] | None] | None = None,
) -> Description:
    """What ``generate_launch_description()`` of the launch file *text* at the root-relative *path* returns.

    *read* gives the text of a file of the workspace for a path that begins with a marker of ``model/launch_actions``,
    None if there is none, *locate* its root-relative path as well; *module* the path and text of a Python module of the workspace. What cannot be known is an
    action or a substitution ``?`` with its reason; nothing is raised. *budget* tells afterwards what has been used;
    each OpaqueFunction begins it anew.
    """
    used = budget if budget is not None else Budget()
    place = Location(path, 1)
    tree = parse(text)
    if tree is None:
        return Description(problems=((1, "this is not valid Python; correct the syntax"),))
    run = ScriptEvaluation(
        read=read,
        environment={**environment, **{name: Unknown(why, None) for name, why in lost_of(environment).items()}},
        module=module or (lambda _: None),
        locate=locate or (lambda _: None),
        known=lambda dotted: summary_of(dotted) is not None,
        evaluate=evaluate,
        block=block,
        call=call_value,
        attribute=attribute,
        budget=used,
        heap=Heap(used),
    )
    scope = ScriptScope({}, None, ScriptSource(path, tuple(text.splitlines())))
    scope.variables.update({"__file__": file_marker(path), "__name__": "launch_file"})
    try:
        module_body(run, scope, tree)
        entry = next((scope.variables[name] for name in ENTRIES if name in scope.variables), None)
        if entry is None:
            problem = "there is no function generate_launch_description; define it"
            return Description(problems=((1, problem),))
        return Description(actions=top(run, entry, place))
    except (ScriptBudgetExhausted, RecursionError) as error:
        reason = str(error) if isinstance(error, ScriptBudgetExhausted) else "it is nested too deep"
        return Description(actions=(unknown_action(f"the launch file is not followed to its end: {reason}", place),))


def top(run: ScriptEvaluation, entry: Value, place: Location) -> tuple[Action, ...]:
    """The actions of the description that *entry* gives; the parameters of a test's description are not known."""
    call = LibraryCall(name="generate_launch_description", location=place, keywords={})
    if isinstance(entry, ScriptFunction):
        names = [item.arg for item in entry.node.args.args][: len(entry.node.args.args) - len(entry.defaults)]
        lost = Unknown("an argument of the description of a test", place)
        call = LibraryCall(name=entry.name, location=place, keywords={}, args=tuple(lost for _ in names))
        value = call_function(run, entry, call)
    else:
        value = run.call(run, entry, call)
    if isinstance(value, tuple) and value:
        value = value[0]
    if isinstance(value, LaunchObject) and value.name == DESCRIPTION:
        value = value.fields["entities"]
    return doubted(run, (*written_files.actions(run), *actions_of(run, value, place)), place)
