# SPDX-License-Identifier: Apache-2.0
"""What runs a function: callbacks, calls of others, the program's beginning, threads; and whether these are all.

It is the same for all nodes: which of the timers and subscriptions a node makes is asked for each node (``flows``).
"""

from __future__ import annotations

from collections.abc import Iterator

from haros_ci import syntax
from haros_ci.code import classes, kinds
from haros_ci.code.body import Call, last_part
from haros_ci.code.callbacks import Callback, callbacks, given_function
from haros_ci.code.calls import called, function_meant
from haros_ci.code.codebase import Codebase, Routine
from haros_ci.rates.may import may_run
from haros_ci.rates.threads import THREADS, begins_thread, in_one
from haros_ci.records import dataclass, field
from haros_ci.syntax import Expression, Record
from haros_ci.syntax.walk import everything

#: Bases that call nothing of a class but what it registers.
HARMLESS = frozenset(
    "rclcpp::Node rclcpp_lifecycle::LifecycleNode rclpy.node.Node Node object nodelet::Nodelet nav2_util::LifecycleNode "
    "rclpy.lifecycle.Node rclpy.lifecycle.LifecycleNode std::enable_shared_from_this".split()
)
#: A base that calls one method of a class alone, in a thread of its own (threading.Thread.start).
THREAD_BASE = "threading.Thread"
#: Why what a framework calls at its own times has no rate.
TRANSITION = "it is a transition of a managed node"
#: Calls that make the server of an action of a function that they are given: rclcpp_action, nav2_util, actionlib, rclpy.
ACTIONS = frozenset("create_server create_action_server SimpleActionServer ActionServer".split())
#: Methods that a framework calls once when the node starts.
STARTS = frozenset(("onInit",))
#: Methods that ROS libraries call by themselves, whatever else does.
FRAMEWORK = frozenset("on_configure on_activate on_deactivate on_cleanup on_shutdown on_error".split())
#: The reason where nothing is seen to run a function.
UNCALLED = "it is not seen who calls it"
#: Routines that mention a name and are looked at.
MOST = 4_000


@dataclass(frozen=True, slots=True, eq=False)
class Runs:
    """The *callbacks* that a routine is, the *calls* that run it, whether it is where a program or thread *begins*.

    *is_made* says that it runs whenever an object is made; *reason* why it may run at rates that these do not tell, "" if these are all.
    *hidden* is why more may run it that is none of these.
    """

    callbacks: tuple[Callback, ...] = ()
    calls: tuple[tuple[Routine, Call], ...] = ()
    begins: bool = False
    is_made: bool = False
    #: Calls of a method of that name on an object that may be of the class, so that it runs in some of them.
    perhaps: tuple[tuple[Routine, Call], ...] = ()
    #: What else makes it run, as ``flows.ASKED`` names it.
    asked: tuple[str, ...] = ()
    #: The calls that begin a thread with it.
    threads: tuple[tuple[Routine, Call], ...] = ()
    reason: str = ""
    hidden: str = ""


def runs(code: Codebase, routine: Routine) -> Runs:
    """What runs *routine*."""
    key = ("runs", id(routine))
    if key not in code.kept:
        code.kept[key] = _runs(code, routine)
    found: Runs = code.kept[key]
    return found


def _runs(code: Codebase, routine: Routine) -> Runs:
    function = routine.function
    own = _callbacks(code).get(id(routine), ())
    name = function.name.rpartition(routine.source.separator)[2]
    if function.kind == "lambda" or routine.outer is not None and not name:
        is_one = len({(one.maker, one.call.line, one.call.column) for one in own}) == 1
        return Runs(own) if is_one and function.kind == "lambda" else _unseen("it is not seen who calls the lambda")
    made = _beginning(routine, name)
    if made is not None:
        return made
    if function.kind == "destructor":
        return _unseen("it runs when an object is gone")
    if name in FRAMEWORK and routine.function.owner:
        return Runs(asked=("transition",), hidden=TRANSITION)
    return _mentioned(code, routine, name, own, outside_caller(code, routine, name))


def _beginning(routine: Routine, name: str) -> Runs | None:
    """What runs where a program begins, or an object is made; None for all else."""
    function = routine.function
    if function.kind == "module" or (name == "main" and not function.owner and not routine.is_python):
        return Runs(begins=True)
    if function.kind == "constructor" or (routine.is_python and name == "__init__"):
        return Runs(begins=True, is_made=True)
    return None


def _unseen(reason: str) -> Runs:
    return Runs(reason=reason, hidden=reason)


def _callbacks(code: Codebase) -> dict[int, tuple[Callback, ...]]:
    if "callbacks by routine" not in code.kept:
        found: dict[int, tuple[Callback, ...]] = {}
        for callback in callbacks(code):
            found[id(callback.routine)] = (*found.get(id(callback.routine), ()), callback)
        code.kept["callbacks by routine"] = found
    known: dict[int, tuple[Callback, ...]] = code.kept["callbacks by routine"]
    return known


def outside_caller(code: Codebase, routine: Routine, name: str) -> str:
    """Why somebody outside the workspace may call a method; "" if nobody may."""
    owner = classes.owner_of(code, routine)
    if owner is None:
        return "the class of the method is not known" if routine.function.owner and not routine.is_python else ""
    outside = [other for above, other in classes.bases(code, owner) if above is None and other not in HARMLESS]
    outside = [other for other in outside if other != THREAD_BASE or name == "run"]
    if not outside:
        return ""
    is_virtual = routine.is_python or any(
        function.is_virtual for _, function in code.index(routine.source).functions.get(routine.function.name, ())
    )
    return f"{outside[0]}, which is not in the workspace, may call it" if is_virtual else ""


@dataclass(slots=True)
class _Seen:
    """What is collected of the routines that mention a function; *reason* and *hidden* as ``Runs`` has them."""

    calls: list[tuple[Routine, Call]] = field(default_factory=list)
    perhaps: list[tuple[Routine, Call]] = field(default_factory=list)
    threads: list[tuple[Routine, Call]] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    reason: str = ""
    hidden: str = ""

    def is_hidden(self, why: str) -> None:
        """There is more that runs it, which is not seen."""
        self.reason, self.hidden = self.reason or why, self.hidden or why


def _mentioned(code: Codebase, routine: Routine, name: str, own: tuple[Callback, ...], outside: str) -> Runs:
    """What runs a named function, from all mentions of its name in programs of its language."""
    seen = _Seen(reason=outside, hidden=outside)
    begins = name in STARTS or (routine.is_python and name == "main" and not routine.function.owner)
    every = _mentioning(code, routine, name)
    if len(every) > MOST:
        return _unseen("its name is too common to look at every mention")
    for where in every:
        if in_one(code, where, routine):
            _in(code, where, routine, name, own, seen)
    asked = tuple(dict.fromkeys(seen.asked))
    if not (own or begins or seen.calls or seen.perhaps or seen.threads or asked):
        seen.is_hidden(UNCALLED)
    return Runs(
        own,
        tuple(seen.calls),
        begins,
        perhaps=tuple(seen.perhaps),
        asked=asked,
        threads=tuple(seen.threads),
        reason=seen.reason,
        hidden=seen.hidden,
    )


def _mentioning(code: Codebase, routine: Routine, name: str) -> list[Routine]:
    """The routines that may mean *routine* by its *name*: of tests only those that a test has."""
    every = (where for path in sorted(code.mentioning(name)) for where in _naming(code, path, name))
    is_test = routine.is_test
    return [where for where in every if where.is_python is routine.is_python and (is_test or not where.is_test)]


def _in(code: Codebase, where: Routine, routine: Routine, name: str, own: tuple[Callback, ...], seen: _Seen) -> None:
    """Add what runs *routine* in another to *seen*, and why it may be run in ways that are not seen."""
    accounted: set[int] = set()
    registered = {(one.call.line, one.call.column, one.role) for one in own if one.maker is where}
    for call in code.body(where).calls:
        if _last(call.callee) == name:
            _call(code, where, routine, call, seen)
            accounted.add(id(call.callee))
        for value in _handed_on(code, where, routine, call, registered, seen):
            accounted |= {id(node) for node in everything(value) if _last(node) == name}
    if _is_in_thread(code, where, routine):
        seen.is_hidden(f"{where.title} begins a thread with it")
    for target, _, _, _ in code.body(where).sets:
        accounted.add(id(target))
    for node in _names(code, where)[name]:
        if id(node) not in accounted and _is_given(code, where, routine, node):
            seen.is_hidden(f"{where.title} gives it to others")


def _is_in_thread(code: Codebase, where: Routine, routine: Routine) -> bool:
    """Whether a local variable is a thread that runs *routine*."""
    return any(
        variable.type.name.rpartition("::")[2] in THREADS
        and any(routine in function_meant(code, where, part) for part in variable.parts)
        for every in code.body(where).variables.values()
        for variable in every
    )


def _handed_on(
    code: Codebase, where: Routine, routine: Routine, call: Call, registered: set[tuple[int, int, str]], seen: _Seen
) -> Iterator[Expression]:
    """The arguments of a call by which it is known to run *routine*: as a callback, in a thread, or as an action."""
    for position, argument in enumerate(call.args):
        role, value = str(position), argument
        if isinstance(argument, syntax.Keyword):
            role, value = argument.name, argument.value
        if _given(code, where, routine, call, value, seen) or (call.line, call.column, role) in registered:
            yield value


def _naming(code: Codebase, path: str, name: str) -> list[Routine]:
    """The routines of a file that mention a name."""
    key = ("naming", path)
    if key not in code.kept:
        made: dict[str, list[Routine]] = {}
        for where in code.routines(path):
            for last in _names(code, where):
                made.setdefault(last, []).append(where)
        code.kept[key] = made
    found: dict[str, list[Routine]] = code.kept[key]
    return found.get(name, [])


def _call(code: Codebase, where: Routine, routine: Routine, call: Call, seen: _Seen) -> None:
    """Add a call of that name to *seen*, if it runs *routine* or may."""
    targets = called(code, where, call.whole)
    if routine in targets:
        seen.calls.append((where, call))
    elif _may_replace(code, routine, targets) or (not targets and may_run(code, where, routine, call.callee)):
        seen.perhaps.append((where, call))
        if not routine.owner:
            seen.reason = seen.reason or f"{where.title} may call it"


def _names(code: Codebase, where: Routine) -> dict[str, list[Record]]:
    """The names and members that a routine mentions, by the last part of their name."""
    key = ("names", id(where.function))
    if key not in code.kept:
        made: dict[str, list[Record]] = {}
        for node in everything((*where.function.inits, *(where.function.body or ()))):
            if last := _last(node):
                made.setdefault(last, []).append(node)
        code.kept[key] = made
        code.kept["keep", id(where)] = where
    found: dict[str, list[Record]] = code.kept[key]
    return found


def _may_replace(code: Codebase, routine: Routine, targets: tuple[Routine, ...]) -> bool:
    """Whether a method of a derived class may run where one of *targets* is called."""
    owner = classes.owner_of(code, routine) if targets else None
    return owner is not None and any(target.owner in classes.base_names(code, owner) for target in targets)


def _given(code: Codebase, where: Routine, routine: Routine, call: Call, value: Expression, seen: _Seen) -> bool:
    """Whether a call begins a thread with *routine*, or makes an action server of it, as *value* says."""
    is_thread = begins_thread(code, where, call)
    if not is_thread and last_part(call.callee) not in ACTIONS:
        return False
    if routine not in given_function(code, where, value):
        return False
    if is_thread:
        seen.threads.append((where, call))
    else:
        seen.asked.append("action")
        seen.hidden = seen.hidden or f"{where.title} gives it to others"
    return True


def _last(node: object) -> str:
    if isinstance(node, (syntax.Name, syntax.Member)):
        return node.name.rpartition("::")[2]
    return ""


def _is_given(code: Codebase, where: Routine, routine: Routine, node: object) -> bool:
    if not isinstance(node, (syntax.Name, syntax.Member)):
        return False
    meant = function_meant(code, where, node)
    if meant:
        return routine in meant
    if isinstance(node, syntax.Name):
        return not kinds.is_local(code, where, node.name) and not routine.owner
    return may_run(code, where, routine, node) and not kinds.type_name(code, where, node)
