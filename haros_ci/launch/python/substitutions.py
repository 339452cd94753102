# SPDX-License-Identifier: Apache-2.0
"""Summaries of the substitutions of ``launch``, ``launch_ros`` and ``nav2_common.launch``."""

from __future__ import annotations

from haros_ci.launch.python.builtin_functions import Summary
from haros_ci.launch.python.run import ScriptEvaluation
from haros_ci.launch.python.values import LibraryCall, Sub, Unknown, Value, merged, mystery, phrase, why
from haros_ci.model.launch_actions import Phrase, Substitution


def word(call: LibraryCall) -> str:
    return call.name.rpartition(".")[2]


def of_kind(kind: str, names: str, needed: int) -> Summary:
    """A substitution with the parameters *names* of which the first *needed* must be given."""

    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        bound = call.bind(names)
        arguments: list[Phrase] = []
        for index, name in enumerate(names.replace("*", " ").split()):
            if name not in bound or (bound[name] is None and index >= needed):
                if index < needed:
                    return run.unknown(f"{word(call)} is given no {name}", call.location)
                break
            arguments.append(phrase(bound[name]))
        return Sub((Substitution(kind, tuple(arguments), call.location),), word(call))

    return summary


def text(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return Sub(phrase(call.bind("text").get("text")), word(call))


def path_join(run: ScriptEvaluation, call: LibraryCall) -> Value:
    parts = call.bind("substitutions").get("substitutions")
    if isinstance(parts, Unknown) or not isinstance(parts, (list, tuple)):
        return Sub((mystery(why(parts), call.location),), word(call))
    return Sub((Substitution("join", tuple(phrase(part) for part in parts), call.location),), word(call))


def any_or_all(kind: str) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        return Sub((Substitution(kind, tuple(phrase(item) for item in call.args), call.location),), word(call))

    return summary


def expression(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """PythonExpression: its text; modules other than math are not known to it."""
    bound = call.bind("expression python_modules")
    return Sub((Substitution("eval", (phrase(bound.get("expression")),), call.location),), word(call))


def choice(run: ScriptEvaluation, call: LibraryCall) -> Value:
    bound = call.bind("condition if_value else_value")
    arguments = (phrase(bound.get("condition")), phrase(bound.get("if_value", "")), phrase(bound.get("else_value", "")))
    return Sub((Substitution("if", arguments, call.location),), word(call))


def mysterious(reason: str) -> Summary:
    def summary(run: ScriptEvaluation, call: LibraryCall) -> Value:
        return Sub((mystery(reason, call.location),), word(call))

    return summary


def boolean_configuration(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """LaunchConfigAsBool: ``True`` or ``False`` by the words of nav2_common."""
    name = call.bind("name").get("name")
    value = Substitution("var", (phrase(name),), call.location)
    requested: Phrase = ("'", value, "'.strip().lower() in ['true', '1', 'yes', 'on']")
    return Sub((Substitution("eval", (requested,), call.location),), word(call))


def pairs(run: ScriptEvaluation, value: Value, call: LibraryCall) -> tuple[tuple[Phrase, Phrase], ...]:
    """A dictionary's items as pairs of phrases; one that is not known is a pair that is not."""
    if value is None:
        return ()
    if not isinstance(value, dict):
        lost = (mystery(why(value), call.location),)
        return ((lost, lost),)
    return tuple((phrase(key), phrase(item)) for key, item in value.items())


def rewritten(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """RewrittenYaml: the file, and how it is rewritten (nav2_common/launch/rewritten_yaml.py)."""
    bound = call.bind("source_file param_rewrites root_key key_rewrites value_rewrites convert_types")
    convert = bound.get("convert_types", False)
    source = phrase(bound.get("source_file"))
    data = {
        "source": source,
        "rewrites": pairs(run, bound.get("param_rewrites"), call),
        "root_key": None if bound.get("root_key") is None else phrase(bound["root_key"]),
        "key_rewrites": pairs(run, bound.get("key_rewrites"), call),
        "value_rewrites": pairs(run, bound.get("value_rewrites"), call),
        "convert_types": convert if isinstance(convert, bool) else False,
    }
    return Sub((Substitution("rewritten", (source,), call.location, data=data),), word(call))


def replaced(run: ScriptEvaluation, call: LibraryCall) -> Value:
    """ReplaceString: a text file with other texts; what it is rewritten to is not followed."""
    bound = call.bind("source_file replacements condition")
    source = phrase(bound.get("source_file"))
    data = {"source": source, "replacements": pairs(run, bound.get("replacements"), call)}
    reason = "a file rewritten by ReplaceString"
    return Sub((Substitution("?", (source,), call.location, reason, data),), word(call))


def robots(run: ScriptEvaluation, call: LibraryCall) -> Value:
    return run.unknown("the command line's robots are not known", call.location)


L = "launch.substitutions."
R = "launch_ros.substitutions."
N = "nav2_common.launch."
SUMMARIES: dict[str, Summary] = {
    f"{L}LaunchConfiguration": of_kind("var", "variable_name * default", 1),
    f"{L}EnvironmentVariable": of_kind("env", "name * default_value", 1),
    f"{L}TextSubstitution": text,
    f"{L}PathJoinSubstitution": path_join,
    f"{L}PathSubstitution": text,
    f"{L}PythonExpression": expression,
    f"{L}Command": of_kind("command", "command * on_stderr", 1),
    f"{L}FindExecutable": of_kind("find-exec", "name", 1),
    f"{L}AnonName": of_kind("anon", "name", 1),
    f"{L}ThisLaunchFile": of_kind("filename", "", 0),
    f"{L}ThisLaunchFileDir": of_kind("dirname", "", 0),
    f"{L}LaunchLogDir": of_kind("launch_log_dir", "", 0),
    f"{L}FileContent": of_kind("file-content", "path", 1),
    f"{L}NotSubstitution": of_kind("not", "value", 1),
    f"{L}AndSubstitution": of_kind("and", "left right", 2),
    f"{L}OrSubstitution": of_kind("or", "left right", 2),
    f"{L}AnySubstitution": any_or_all("any"),
    f"{L}AllSubstitution": any_or_all("all"),
    f"{L}EqualsSubstitution": of_kind("equals", "left right", 2),
    f"{L}NotEqualsSubstitution": of_kind("not-equals", "left right", 2),
    f"{L}IfElseSubstitution": choice,
    f"{L}LocalSubstitution": mysterious("LocalSubstitution is known at run time only"),
    f"{L}StringJoinSubstitution": mysterious("StringJoinSubstitution is not followed"),
    f"{R}FindPackageShare": of_kind("find-pkg-share", "package", 1),
    f"{R}FindPackagePrefix": of_kind("find-pkg-prefix", "package", 1),
    f"{R}FindPackage": of_kind("find-pkg-prefix", "package", 1),
    f"{R}ExecutableInPackage": of_kind("exec-in-pkg", "executable package", 2),
    f"{R}Parameter": of_kind("param", "name * default", 1),
    f"{N}RewrittenYaml": rewritten,
    f"{N}ReplaceString": replaced,
    f"{N}HasNodeParams": mysterious("HasNodeParams asks whether a file has a node's parameters"),
    f"{N}LaunchConfigAsBool": boolean_configuration,
    f"{N}ParseMultiRobotPose": robots,
}


def joined(parts: list[Phrase]) -> Phrase:
    """Words with a blank between them."""
    return merged(piece for index, part in enumerate(parts) for piece in (((" ",) if index else ()) + part))
