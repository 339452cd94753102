# SPDX-License-Identifier: Apache-2.0
"""Nodes, containers and composable nodes as launch_ros starts them: names, remaps, parameters and arguments."""

from __future__ import annotations

import re
from dataclasses import replace

from haros_ci.graph.remap_rules import written_rule
from haros_ci.graph.ros2_process import from_arguments, ros_arguments
from haros_ci.graph.words import shell_words
from haros_ci.launch.ros2 import python_programs
from haros_ci.launch.ros2.context import NAMESPACE, Context
from haros_ci.launch.ros2.in_shells import commands
from haros_ci.launch.ros2.parameter_files import Component, file_rules, missing
from haros_ci.launch.ros2.parameters import node_rules
from haros_ci.launch.ros2.substitutions import truth_of
from haros_ci.model.architecture import Condition, RemapRule, Unknown
from haros_ci.model.launch import LaunchedNode, ParameterRule
from haros_ci.model.launch_actions import Action, Substitution
from haros_ci.model.location import Location
from haros_ci.regex import regex
from haros_ci.substitutions.names import MARK, Text, literal, quoted, unknown

_KINDS = {"node": "node", "lifecycle-node": "lifecycle", "container": "container", "component": "component"}
#: The executable of a package, as ExecutableInPackage gives it.
_IN_PACKAGE = regex(r"\$\(find-pkg-prefix ([^\s()]+)\)/lib/\1/([^/]+)")
#: Verbs of ``ros2 control`` that load a controller (ros2controlcli).
LOADING = frozenset(("load_controller", "load_start_controller", "load_configure_controller"))
#: Commands of ``ros2`` that have a node, with the package that brings each.
TOOLS = {
    **dict.fromkeys((("bag", "play"), ("bag", "record")), "ros2bag"),
    **dict.fromkeys((("topic", command) for command in ("pub", "echo", "hz", "bw", "delay")), "ros2topic"),
    ("service", "call"): "ros2service",
    ("action", "send_goal"): "ros2action",
}
#: What ends the words of a command in a shell.
SHELL = regex(r"[;&|<>]|[12]>|.*;\Z")
#: A package, a program of it, how many words say so, and its file where it is no program of the package.
_Started = tuple[str, str, int, str]
_Remaps = tuple[tuple[str, str, Location], ...]


def joined_namespace(base: Text | None, own: Text | None) -> Text | None:
    """*own* below *base* unless it is absolute (launch_ros ``prefix_namespace``, ``make_namespace_absolute``)."""
    if own is None:
        made = base
    elif base is None or not base.raw or own.raw.startswith("/"):
        made = own
    else:
        # What begins unknown may be absolute: then nothing of *base* is left.
        start = Text("", ()) if base.raw == "/" else base
        doubtful = own.raw.startswith(MARK)
        made = own if doubtful else Text(f"{start.raw}/{own.raw}", start.reasons + own.reasons)
    if made is None:
        return None
    raw = made.raw if made.raw == "/" else made.raw.rstrip("/")
    return Text(raw if raw.startswith("/") else "/" + raw, made.reasons)


def node(context: Context, action: Action, conditions: tuple[Condition, ...]) -> LaunchedNode:
    """The process of a node or container *action*."""
    made = _started(context, action, conditions, None)
    args = _text(context, action, "args").raw
    if action.get("package") is None:
        made, args = _without_package(context, made, _text(context, action, "executable").raw, args)
    arguments, in_arguments = split_arguments(args)
    text = " ".join(part for part in (in_arguments, _text(context, action, "ros_args").raw) if part)
    unknowns = list(made.unknowns)
    for name, field in (("args", "arguments"), ("ros_args", "ros_arguments"), ("launch-prefix", "launch_prefix")):
        unknowns.extend(_text(context, action, name).unknown(field, action.location))
    environment = tuple((context.text(name), context.text(value)) for name, value in action.environment)
    for variable, value in environment:
        unknowns.extend(Text("", variable.reasons + value.reasons).unknown("environment", action.location))
    return replace(
        made,
        arguments=_shown(arguments),
        ros_arguments=_shown(text),
        parameters=(*argument_rules(context, text, action.location), *made.parameters),
        environment=_environment(context, environment),
        launch_prefix=_text(context, action, "launch-prefix").shown,
        respawn=truth_of(_text(context, action, "respawn")) is True,
        unknowns=tuple(unknowns),
    )


def _without_package(context: Context, made: LaunchedNode, executable: str, args: str) -> tuple[LaunchedNode, str]:
    """A node whose executable is searched for as a command is (launch_ros/actions/node.py): as the program that it starts, with the arguments of that."""
    words = [executable, *shell_words(args)]
    started = _program(context, words) or _file(context, words)
    if started is None:
        return made, args
    return replace(made, package=started[0], type=started[1], path=started[3]), _line(words[started[2] :])


def component(context: Context, action: Action, conditions: tuple[Condition, ...], container: Text) -> LaunchedNode:
    """The composable node *action*, loaded into *container*."""
    made = _started(context, action, conditions, container)
    return replace(made, unknowns=(*made.unknowns, *container.unknown("container", action.location)))


def full_name(started: LaunchedNode) -> str:
    """Namespace and name of a container; a name that the program itself gives is ``?``."""
    return f"{(started.namespace or '').rstrip('/')}/{started.name if started.name is not None else '?'}"


def processes(context: Context, action: Action, conditions: tuple[Condition, ...]) -> tuple[LaunchedNode, ...]:
    """The nodes that a process is, or starts: ``ros2 run package executable ...``, also in a line of a shell, or a package's executable by its path."""
    cmd = command_of(context, action)
    every = (_process(context, action, conditions, cmd, words) for words in commands(shell_words(cmd.raw), shell_words))
    return tuple(node for node in every if node is not None)


def _process(
    context: Context, action: Action, conditions: tuple[Condition, ...], cmd: Text, words: list[str]
) -> LaunchedNode | None:
    tool = TOOLS.get((words[1], words[2])) if words[:1] == ["ros2"] and len(words) > 2 else None
    if tool is not None:
        words = words[: next((number for number, word in enumerate(words) if SHELL.match(word)), None)]
    started: _Started | None = (tool, words[2], 3, "") if tool is not None else _program(context, words)
    if started is None:
        started = _file(context, words)
        if started is None or not python_programs.is_of_ros(context.places, started[3]):
            reason = python_programs.why_not(context.places, words)
            if reason:
                shown = quoted(_shown(" ".join(words[:4])))
                context.problem(action.location, f"starts {shown}: {reason}; what it starts is unknown")
            return None
    package, type_, count, path = started
    arguments, text = split_arguments(_line(words[count:])) if tool is None else (_line(words[count:]), "")
    environment = tuple((context.text(name), context.text(value)) for name, value in action.environment)
    return LaunchedNode(
        kind="node",
        package=_shown(package),
        type=_shown(type_),
        location=action.location,
        name=None if tool is None else _node_name(words[count:]),
        arguments=_shown(arguments),
        ros_arguments=_shown(text),
        parameters=argument_rules(context, text, action.location),
        conditions=conditions,
        presence=context.presence,
        environment=_environment(context, environment),
        unknowns=cmd.unknown("arguments", action.location),
        path=path,
    )


def _file(context: Context, words: list[str]) -> _Started | None:
    """The file of the workspace that the interpreter of Python is given by *words*, and that is no program of a package under another name."""
    path, count = python_programs.file_of(context.places, words)
    owner = next((file.package for file in context.places.workspace.files if file.path == path), None) if path else None
    start = context.places.files.directories.get(owner or "")
    if owner is None or start is None:
        return None
    return owner, path if start == "." else path[len(start) + 1 :], count, path


def command_of(context: Context, action: Action) -> Text:
    """The words of a process; a program that is looked for by its name is that name."""
    phrase = action.get("cmd") or ()
    quote = phrase[:1] if phrase[:1] == ("'",) else ()  # of a description in Python, where it is one word
    program = phrase[len(quote)] if len(phrase) > len(quote) else None
    if isinstance(program, Substitution) and program.kind == "find-exec" and program.arguments:
        phrase = (*quote, *program.arguments[0], *phrase[len(quote) + 1 :])
    return context.text(phrase)


def loading(context: Context, action: Action, conditions: tuple[Condition, ...]) -> LaunchedNode | None:
    """What ``ros2 control load_controller ...`` asks a controller manager for, of kind ``loading``; None for other commands."""
    words = shell_words(command_of(context, action).raw)
    if words[:2] != ["ros2", "control"] or len(words) < 3 or words[2] not in LOADING:
        return None
    end = next((number for number, word in enumerate(words) if SHELL.match(word)), len(words))
    return LaunchedNode(
        kind="loading",
        package="controller_manager",
        type=words[2],
        location=action.location,
        arguments=_shown(_line(words[3:end])),
        conditions=conditions,
        presence=context.presence,
    )


def _node_name(words: list[str]) -> str | None:
    """What ``--node-name`` of ``ros2 bag`` and ``ros2 topic`` calls the node."""
    for number, word in enumerate(words):
        name, equals, value = word.partition("=")
        if name in ("--node-name", "-n"):
            text = value if equals else words[number + 1] if number + 1 < len(words) else ""
            return _shown(text) if re.fullmatch(r"\w+", text) else None
    return None


def _program(context: Context, words: list[str]) -> _Started | None:
    """Package and executable that *words* start, and how many of them say so; None for a program of no package.

    ``ros2 run`` finds what is in ``lib/<package>`` below the package's prefix; so does ExecutableInPackage.
    """
    start = 0
    if words[:2] == ["ros2", "run"]:
        start = 2
        while len(words) > start and words[start].startswith("-"):
            start += 2 if words[start] == "--prefix" else 1
        return (words[start], words[start + 1], start + 2, "") if len(words) > start + 1 else None
    if words[:1] in (["gazebo"], ["gzserver"]) and any(word.startswith("libgazebo_ros_") for word in words):
        return "gazebo_ros", words[0], 1, ""
    if words[:1] and words[0] in python_programs.INTERPRETERS:
        start = next((number for number, word in enumerate(words[1:], 1) if word not in python_programs.FLAGS), 1)
    if start and words[start : start + 1] == ["-m"] and len(words) > start + 1:
        module = python_programs.of_module(context.places, words[start + 1])
        return (*module, start + 2, "") if module is not None else None
    match = _IN_PACKAGE.fullmatch(words[start]) if len(words) > start else None
    if match is None and len(words) > start:
        file = python_programs.of_file(context.places, words[start])
        return (*file, start + 1, "") if file is not None else None
    return (match[1], match[2], start + 1, "") if match is not None else None


def split_arguments(text: str) -> tuple[str, str]:
    """Arguments of the program, and those between ``--ros-args`` and ``--`` (rcl's arguments)."""
    if "--ros-args" not in text:
        return text, ""
    own: list[str] = []
    ros: list[str] = []
    within = False
    for word in shell_words(text):
        if word == "--ros-args":
            within = True
        elif word == "--" and within:
            within = False
        else:
            (ros if within else own).append(word)
    return _line(own), _line(ros)


def argument_rules(context: Context, text: str, location: Location) -> tuple[ParameterRule, ...]:
    """The parameters of ROS arguments, in order; on the command line they stand before those of the launch file."""
    found: list[ParameterRule] = []
    flag = ""
    for word in shell_words(text):
        if flag == "--params-file":
            path = unknown("a part of the path is not known") if MARK in word else literal(word)
            found.extend(file_rules(context, path, False, location))
        elif flag in ("-p", "--param"):
            found.extend(from_arguments(ros_arguments(("--ros-args", flag, _shown(word))), location))
        elif not flag and MARK in word:  # there may be anything in it
            found.append(missing("a part of the command line is not known", location))
        flag = word if not flag and word in ("--params-file", "-p", "--param", "-r", "--remap") else ""
    return tuple(found)


def _line(words: list[str]) -> str:
    """*words* in a row, quoted where they need it to be parted again."""
    return " ".join(
        word if word and shell_words(word) == [word] else "'" + word.replace("'", "'\"'\"'") + "'" for word in words
    )


def _text(context: Context, action: Action, name: str) -> Text:
    phrase = action.get(name)
    return literal("") if phrase is None else context.text(phrase)


def _optional(context: Context, action: Action, name: str) -> Text | None:
    phrase = action.get(name)
    return None if phrase is None else context.text(phrase)


def _shown(raw: str) -> str:
    return raw.replace(MARK, "?")


def _environment(context: Context, own: tuple[tuple[Text, Text], ...]) -> tuple[tuple[str, str], ...]:
    """What the launch description has set before, and the node's own variables."""
    found = {name: text.shown for name, text in context.scope.environment.items() if context.initial.get(name) != text}
    found.update((name.shown, value.shown) for name, value in own)
    return tuple(sorted(found.items()))


def _started(
    context: Context, action: Action, conditions: tuple[Condition, ...], container: Text | None
) -> LaunchedNode:
    context.spend(20)
    is_component = container is not None
    place = action.location
    name = _optional(context, action, "name")
    namespace = joined_namespace(context.get(NAMESPACE), _optional(context, action, "namespace"))
    package = _text(context, action, "package")
    type_ = _text(context, action, "plugin" if is_component else "executable")
    unknowns: list[Unknown] = []
    for field, text in (("name", name), ("namespace", namespace), ("package", package), ("type", type_)):
        unknowns.extend(text.unknown(field, place) if text is not None else ())
    remaps, rules, doubts = _remaps(context, action)
    unknowns.extend(doubts)
    own = None
    if is_component:
        start = namespace.shown.rstrip("/") if namespace is not None else ""
        own = Component(f"{start}/{name.shown if name is not None else ''}")
    key = "/**"
    if not is_component and name is not None and namespace is not None:
        key = f"{namespace.shown.rstrip('/')}/{name.shown}"
    parameters: tuple[ParameterRule, ...] = node_rules(context, action.parameters, own, key)
    return LaunchedNode(
        kind=_KINDS[action.kind],
        package=package.shown,
        type=type_.shown,
        location=place,
        name=None if name is None else name.shown,
        namespace=None if namespace is None else namespace.shown,
        container=None if container is None else container.shown,
        parameters=parameters,
        remaps=remaps,
        rules=rules,
        conditions=conditions,
        presence=context.presence,
        unknowns=tuple(unknowns),
    )


def _remaps(context: Context, action: Action) -> tuple[_Remaps, tuple[RemapRule, ...], list[Unknown]]:
    """Rules set for all nodes first, then the node's own; a rule under an undecided condition leads to ``?``."""
    found: list[tuple[str, str, Location]] = []
    rules: list[RemapRule] = []
    unknowns: list[Unknown] = []
    for rule in context.scope.remaps or ():
        target = "?" if rule.conditions else rule.target.shown
        found.append((rule.source.shown, target, rule.location))
        rules.append(
            written_rule(
                rule.source.shown, rule.target.shown, rule.location, conditions=rule.conditions, is_global=True
            )
        )
        if rule.conditions:
            reason = f"it is set under the condition '{rule.conditions[-1].condition}', which is not decided"
            unknowns.append(Unknown("remaps", reason, rule.location))
        else:
            unknowns.extend(Text("", rule.source.reasons + rule.target.reasons).unknown("remaps", rule.location))
    for source, target_phrase, location in action.remaps:
        one, other = context.text(source), context.text(target_phrase)
        found.append((one.shown, other.shown, location))
        rules.append(written_rule(one.shown, other.shown, location))
        unknowns.extend(Text("", one.reasons + other.reasons).unknown("remaps", location))
    return tuple(found), tuple(rules), unknowns
