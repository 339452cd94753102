# SPDX-License-Identifier: Apache-2.0
"""Content of messages that is run: as a command, as code, or by unpickling it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from haros_ci.api import Check, Finding, Level, Project, syntax
from haros_ci.api.code import (
    Call,
    Callback,
    Codebase,
    FunctionParameter,
    Routine,
    call_place,
    callbacks,
    called,
    carried,
    dotted,
    followed,
    is_local,
    ros_type,
)

SHELLS = frozenset(
    "os.system os.popen commands.getoutput commands.getstatusoutput subprocess.getoutput subprocess.getstatusoutput".split()
)
PROCESSES = frozenset(f"subprocess.{name}" for name in ("run", "call", "check_call", "check_output", "Popen"))
LOADS = frozenset(
    "pickle.loads cPickle.loads dill.loads marshal.loads yaml.unsafe_load yaml.unsafe_load_all jsonpickle.decode".split()
)
SAFE = frozenset(("SafeLoader", "CSafeLoader", "BaseLoader", "CBaseLoader"))
NUMBERS = frozenset(
    "bool byte char int8 uint8 int16 uint16 int32 uint32 int64 uint64 float32 float64 time duration builtin_interfaces/Time "
    "builtin_interfaces/Duration".split()
)
STANDARD = {"std_msgs/String": {"data": "string"}, "std_msgs/Header": {"frame_id": "string"}}
STANDARD |= {
    f"std_msgs/{name}": {"data": name.lower()}
    for name in "Bool Byte Char Int8 UInt8 Int16 UInt16 Int32 UInt32 Int64 UInt64 Float32 Float64".split()
}
KINDS = frozenset(("subscription", "service"))


def check(project: Project) -> Iterator[Finding]:
    code = project.code
    words = ("system", "popen", "subprocess", "eval(", "exec(", "yaml.", "pickle", "marshal", "getoutput", "jsonpickle")
    paths = code.mentioning(*words)
    packages = {code.by_path[path].package for path in paths if path in code.by_path}
    seen: set[int] = set()
    for callback in callbacks(code):
        parameters = callback.routine.function.parameters
        if (
            callback.kind not in KINDS
            or callback.maker.source.package not in packages
            or not parameters
            or _is_bound(callback)
        ):
            continue
        start = {_content(parameters).name: frozenset([()])}
        for routine, call, marks, way in followed(
            code, callback.routine, start, 2 if callback.routine.function.kind == "lambda" else 1
        ):
            if routine.path not in paths or id(call) in seen:
                continue
            found = _sink(code, routine, call)
            if found is None:
                continue
            value, what, needs_text = found
            content = frozenset(path for path in carried(value, marks) if path)  # the text of a whole message is quoted
            content = frozenset(path for path in content if not _is_number(project, callback, path))
            if not content or (needs_text and not _is_text(project, callback, content, value)):
                continue
            seen.add(id(call))
            title = callback.routine.title
            flow = [(callback.location, f"{title} receives a message")]
            flow += [(call_place(*step), f"{step[0].title} passes it to {step[1].name}") for step in way]
            yield Finding(
                at=call_place(routine, call),
                message=f"content of the message that {title} receives {what}: any node that publishes or calls can run commands "
                f"on this machine; {_advice(what)}",
                about=(title, routine.title, call.name),
                flow=(*flow, (call_place(routine, call), "executed here")),
            )


def _content(parameters: Sequence[FunctionParameter]) -> FunctionParameter:
    """The parameter with what came: of services of rclcpp the header of the request, and the service, may stand before it
    (any_service_callback.hpp: SharedPtrWithRequestHeaderCallback, SharedPtrDeferResponseCallback).
    """
    headers = [at for at, parameter in enumerate(parameters) if "rmw_request_id_t" in str(parameter.type)]
    return parameters[headers[0] + 1] if headers and headers[0] + 1 < len(parameters) else parameters[0]


def _advice(what: str) -> str:
    if "shell" in what:
        return "choose from a fixed list of commands, and pass arguments as a list without a shell"
    return "parse it with a parser for plain data (json, ast.literal_eval, yaml.safe_load)"


def _is_bound(callback: Callback) -> bool:
    """Whether the first parameter may be given where the callback is registered."""
    if not callback.maker.is_python:
        return False
    values = [argument.value if isinstance(argument, syntax.Keyword) else argument for argument in callback.call.args]
    return any(isinstance(value, syntax.Call) for value in values)


def _sink(code: Codebase, routine: Routine, call: Call) -> tuple[syntax.Expression, str, bool] | None:
    """What a call runs, how, and whether it has to be known to be text."""
    if not call.args or called(code, routine, call.whole):
        return None
    first = call.args[0]
    if not routine.is_python:
        name = call.callee.name.removeprefix("::") if isinstance(call.callee, syntax.Name) else ""
        return (first, "is run by a shell", True) if name in ("system", "std::system", "popen") else None
    name = dotted(code, routine, call.callee)
    if name in SHELLS:
        return first, "is run by a shell", True
    if name in PROCESSES:
        is_shell = any(argument == syntax.Keyword("shell", syntax.Boolean(True)) for argument in call.args)
        return (first, "is run by a shell", True) if is_shell and not isinstance(first, syntax.ListLiteral) else None
    if name in ("eval", "exec") and not is_local(code, routine, name):
        return first, "is run as code", False
    if name in LOADS:
        return (
            first,
            "is unpickled" if "pickle" in name or "dill" in name else "is deserialised into objects of any class",
            False,
        )
    if name == "yaml.load":
        loader = call.argument(1, "Loader")
        if any(isinstance(argument, syntax.DoubleStar) for argument in call.args):
            return None
        if loader is None or (
            isinstance(loader, syntax.Member) and loader.name in ("Loader", "UnsafeLoader", "CLoader")
        ):
            return first, "is loaded by a YAML loader that creates objects of any class", False
    return None


def _is_text(
    project: Project, callback: Callback, content: frozenset[tuple[str, ...]], value: syntax.Expression
) -> bool:
    """Whether one of the members is surely a text; numbers run nothing."""
    kind = _message(project.code, callback)
    return kind is not None and any(
        _plain(_field(project, kind, _members(path), callback.kind)) == "string" for path in content
    )


def _is_number(project: Project, callback: Callback, path: tuple[str, ...]) -> bool:
    """Whether what *path* leads to is surely a number, a truth value or a time: no array, which may be bytes of anything."""
    kind, members = _message(project.code, callback), _members(path)
    if kind is None:
        return False
    return any(
        _field(project, kind, members[:length], callback.kind) in NUMBERS for length in range(1, len(members) + 1)
    )


def _members(path: tuple[str, ...]) -> tuple[str, ...]:
    """*path* without what is no member of a message: the request that holds it, and how its text is had."""
    path = path[1:] if path[:1] == ("request",) else path
    while path[-1:] in (("c_str",), ("",)):
        path = path[:-1]
    return path


def _plain(kind: str | None) -> str | None:
    """A type without the bounds of its array or text."""
    return kind.partition("[")[0].partition("<")[0] if kind is not None else None


def _message(code: Codebase, callback: Callback) -> str | None:
    """``pkg/T`` of what the callback is given."""
    maker, call = callback.maker, callback.call
    if maker.is_python:
        position = {"Subscriber": 1, "Service": 1}.get(call.name, 0)
        value = call.argument(position, {"Subscriber": "data_class", "Service": "service_class"}.get(call.name, ""))
        found = dotted(code, maker, value) if value is not None else ""
        return ros_type(found)
    kind = call.templates[0] if call.templates else None
    if isinstance(kind, syntax.Type):
        return ros_type(kind.name)
    return ros_type(str(callback.routine.function.parameters[0].type.name))


def _field(project: Project, kind: str, path: tuple[str, ...], role: str) -> str | None:
    """The type of a member of a message or request, as its definition says, with its bounds."""
    at: str | None = kind
    for name in path:
        at = _plain(at)
        if at is None:
            return None
        known = STANDARD.get(at, {}).get(name)
        found = project.interfaces.get((at, "srv" if role == "service" and at == kind else "msg"))
        if known is None and found is not None and found.sections:
            known = next(
                (field.type for field in found.sections[0] if field.name == name and not field.is_constant), None
            )
        at = known
    return at


CHECK = Check(
    id="message-runs-code",
    summary="Message content executed as a command or as code.",
    level=Level.ERROR,
    catalogue="S02",
    tags=("code", "security"),
    project=check,
)
