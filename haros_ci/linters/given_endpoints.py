# SPDX-License-Identifier: Apache-2.0
"""Calls of ROS that somebody else is given to call: ``Thread(target=self.create_subscription, …)``. The model does not have what they make."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator

from haros_ci.linters.changed_code import Found, brought, notes
from haros_ci.linters.in_default import is_test
from haros_ci.linters.pylint_idioms import nodes
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Workspace
from haros_ci.regex import regex
from haros_ci.results.code_alone import code_alone
from haros_ci.results.python_nodes import dotted
from haros_ci.results.result import Notification

#: Places that are named; the rest is counted. Longer files are not looked at.
MOST = 10
MAX_TEXT = 300_000
_QUOTED = 80
_OF_NODES = frozenset(
    "create_publisher create_subscription create_service create_client create_timer create_lifecycle_publisher".split()
)
_OF_MODULES = frozenset(
    f"{module}.{name}"
    for module, names in (
        ("rospy", "Publisher Subscriber Service ServiceProxy Timer"),
        ("rclpy.action", "ActionServer ActionClient"),
        ("actionlib", "SimpleActionServer SimpleActionClient"),
        ("message_filters", "Subscriber"),
    )
    for name in names.split()
)
#: What asks for such a name, or takes its place, and does not call it; ``partial`` is followed.
_ASKS = frozenset(
    "partial partialmethod hasattr getattr isinstance issubclass callable type id repr str signature getsource wraps object Mock MagicMock patch spy".split()
)
#: What makes a call of the name of a method that it is given as a text, or what calls a method in another way than by brackets.
_BY_NAME = frozenset("methodcaller attrgetter __getattribute__ __getattr__ getattr_static".split())
_OF_METHODS = frozenset("__call__ __func__ __get__ __wrapped__".split())
_MAY = regex(
    r"\bcreate_(?:publisher|subscription|service|client|timer|lifecycle_publisher)\b|\brospy\b|\bActionServer\b|\bActionClient\b|\bSimpleAction|\bmessage_filters\b"
)
#: In C++ the address of such a method of a node, or of a handle.
_ADDRESS = regex(
    r"&\s*(?:::)?(?:\w+::){1,4}(create_(?:publisher|subscription|service|client|wall_timer|timer)|advertise(?:Service)?|subscribe|serviceClient|createTimer|createWallTimer)\b(?!\s*\()"
)
_HANDLES = regex(r"&\s*(?:::)?(?:rclcpp|rclcpp_lifecycle|ros)::")


def notifications(head: Workspace, base: Workspace | None) -> tuple[Notification, ...]:
    """A note for each such call of *head* that no file of *base* which changed or is gone has; none without a base."""
    if base is None:
        return ()
    rest = "calls of ROS are given to something that may call them since this change"
    return notes(brought(head, base, _look), MOST, rest)


def _look(workspace: Workspace) -> Callable[[SourceFile], Iterable[Found]]:
    effect = "is given to something that may call it: the model does not have what that makes; look at it"

    def look(file: SourceFile) -> Iterator[Found]:
        if file.language not in _LOOKS or is_test(file.path):
            return
        text = workspace.text(file.path)
        for line, name in _LOOKS[file.language](text) if len(text) <= MAX_TEXT else ():
            yield line, name, f"since this change {name} {effect}"

    return look


def given_in_python(text: str) -> Iterator[tuple[int, str]]:
    """The lines and names of such calls in Python."""
    if _MAY.search(text) is None:
        return
    every = nodes(text)
    modules: dict[str, str] = {}
    for node in every:
        if isinstance(node, ast.ImportFrom) and node.module:
            modules.update({alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names})
        elif isinstance(node, ast.Import):
            modules.update({alias.asname: alias.name for alias in node.names if alias.asname})
    for node in every:
        if (odd := _odd_use(node)) is not None:
            yield node.lineno if isinstance(node, ast.expr) else 1, odd
        if not isinstance(node, ast.Call) or _last(node.func) in _ASKS:
            continue
        pending: list[ast.expr] = [*node.args, *(word.value for word in node.keywords)]
        while pending:
            part = pending.pop()
            if isinstance(part, ast.List | ast.Tuple | ast.Set):
                pending += part.elts
            elif isinstance(part, ast.Dict):
                pending += part.values
            elif isinstance(part, ast.Attribute | ast.Name):
                name = _name(part, modules)
                if name in _OF_MODULES or (isinstance(part, ast.Attribute) and part.attr in _OF_NODES):
                    yield part.lineno, (dotted(part) or _last(part))[:_QUOTED]


def _odd_use(node: ast.AST) -> str | None:
    """The method that *node* takes by its name as a text, or calls by what a method has; None for anything else."""
    given: ast.expr | None = None
    if isinstance(node, ast.Call) and _last(node.func) in _BY_NAME:
        given = next((one for one in node.args if isinstance(one, ast.Constant) and one.value in _OF_NODES), None)
    elif isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Load):
        own = node.value.func if isinstance(node.value, ast.Call) else node.value
        given = node.slice if _last(own) in ("vars", "__dict__") else None
    elif isinstance(node, ast.Attribute) and node.attr in _OF_METHODS and _last(node.value) in _OF_NODES:
        return f"{_last(node.value)}.{node.attr}"
    if isinstance(given, ast.Constant) and isinstance(given.value, str) and given.value in _OF_NODES:
        return given.value
    return None


def given_in_cpp(text: str) -> Iterator[tuple[int, str]]:
    """The lines and names of such calls in C++."""
    if "&" not in text or _ADDRESS.search(text) is None:
        return
    code = code_alone(text, "c")
    for match in _ADDRESS.finditer(code):
        if match[1].startswith("create_") or _HANDLES.match(match[0]):
            yield code.count("\n", 0, match.start()) + 1, "".join(match[0][1:].split())


def _last(function: ast.expr) -> str:
    return (
        function.attr if isinstance(function, ast.Attribute) else function.id if isinstance(function, ast.Name) else ""
    )


def _name(part: ast.expr, modules: dict[str, str]) -> str:
    """The whole name of *part*, as far as imports of the file tell."""
    first, dot, rest = dotted(part).partition(".")
    return f"{modules.get(first, first)}{dot}{rest}"


_LOOKS = {"python": given_in_python, "cpp": given_in_cpp}
