# SPDX-License-Identifier: Apache-2.0
"""Early ways out of a function or a turn of a loop: what stands behind one is made where it is not taken.

``if (!enabled) return;`` puts what follows under the ``else`` of that ``if``, to the end of the block; a block that holds such a
way puts what stands behind it under the opposite of all that leads there. No condition is

- a way after which there is no node that runs: an exception that nobody catches, ``exit``, ``return`` of ``main``, one after
  ``shutdown``, and that of a failure from what a framework starts a node with, or from a function whose caller ends the program then;
- a way that asks whether the program goes on (``ok()``, ``is_shutdown()``), or whether something is there (a null pointer).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import conversions, expressions
from haros_ci.follow.libraries import harmless
from haros_ci.index.types import is_smart_pointer
from haros_ci.model.architecture import Condition
from haros_ci.records import dataclass
from haros_ci.syntax import Block, Expression, Statement
from haros_ci.values.abstract import NONE, Callable, Choice, Known, Library, Object, Opaque, Pointer, Value

if TYPE_CHECKING:
    from haros_ci.follow.frames import Frame, Loop
    from haros_ci.follow.thrown import Trial
    from haros_ci.follow.walk import Walk

#: Conditions around one call that are kept, and characters of one that is put together.
MOST, LONGEST = 40, 400
#: Why not all conditions are recorded.
SEVERAL = "an early way out stands before it, under conditions that are not put together"
MANY = "more early ways out stand before it than are kept"
#: Functions that ask whether the program goes on (roscpp init.h, rclcpp utilities.hpp, rospy core.py, rclpy utilities.py), and what they say then.
RUNNING = {
    "ros::ok": True,
    "ros::isInitialized": True,
    "ros::isStarted": True,
    "ros::isShuttingDown": False,
    "rclcpp::ok": True,
    "rclcpp::is_initialized": True,
    "rospy.is_shutdown": False,
    "rospy.core.is_shutdown": False,
    "rospy.core.is_initialized": True,
    "rclpy.ok": True,
}
#: Functions after which the node is taken down.
SHUTDOWNS = frozenset(
    "ros::shutdown ros::requestShutdown rclcpp::shutdown rospy.signal_shutdown rclpy.shutdown rclpy.try_shutdown "
    "ROS_BREAK ROS_ISSUE_BREAK raise std::raise kill os.kill".split()
)
#: Methods by which a framework starts what it loads, and which tell it of a failure: of life cycles and controllers
#: (rclcpp_lifecycle, controller_interface, hardware_interface, ros_control).
STARTS = frozenset("on_init on_configure on_activate init initRequest initialize configure".split())


@dataclass(frozen=True, slots=True, eq=False)
class Exit:
    """A way out: the *conditions* around it, from the entry on; *ends* is the loop of which it ends a turn, or the ``try``
    whose block it leaves, None where it is the function; *is_dead* if it is not taken as things are."""

    conditions: tuple[Condition, ...]
    ends: Loop | Trial | None = None
    is_dead: bool = False


def returns(walk: Walk, frame: Frame, value: Value, is_bare: bool) -> None:
    """A ``return`` of *value* is followed; *is_bare* if nothing is written behind it."""
    if is_over(walk, frame):
        return
    # The value is asked last: a parameter that does not matter here may be another one for the next node (decision 0023).
    is_failed = (frame.is_start or (not is_bare and _is_start(walk, frame))) and is_failure(value)
    if not is_failed:
        frame.early.append(Exit(tuple(walk.conditions), None, frame.is_dead))


def ends_turn(walk: Walk, frame: Frame, loop: Loop) -> None:
    """A ``break`` or ``continue`` of *loop* is followed."""
    frame.early.append(Exit(tuple(walk.conditions), loop, frame.is_dead))


def throws(walk: Walk, frame: Frame, trial: Trial) -> None:
    """An exception is thrown in the block of a ``try`` of this function, after which it goes on."""
    if not any(_ends(walk, frame, handler.body) for handler in trial.handlers):
        frame.early.append(Exit(tuple(walk.conditions), trial))


def forget(frame: Frame, known: int, ended: Loop | Trial) -> None:
    """The turn of a loop or the block of a ``try`` is over; ways that lead there lead to what follows."""
    left = {(way.conditions, id(way.ends)): way for way in frame.early[known:] if way.ends is not ended}
    frame.early[known:] = left.values()


def drop(frame: Frame, since: int) -> None:
    """The ways recorded from the number *since* on are no conditions of what follows."""
    del frame.early[since:]


def compiled(frame: Frame, since: int, depth: int, verdict: bool | None) -> None:
    """The ways recorded since then are in a branch of ``#if``, their condition at *depth*: gone if no build has it, else free of it if all have."""
    if verdict is False:
        drop(frame, since)
    elif verdict:
        for number, way in enumerate(frame.early[since:], start=since):
            frame.early[number] = Exit(way.conditions[:depth] + way.conditions[depth + 1 :], way.ends, way.is_dead)


def stand_behind(walk: Walk, frame: Frame, known: int) -> None:
    """What follows in this block stands behind the ways recorded after the first *known*."""
    depth = len(walk.conditions)
    for way in frame.early[known:]:
        added = _stand_behind(walk, frame, way.conditions[depth:], depth)
        walk.holding += added and way.is_dead


def _stand_behind(walk: Walk, frame: Frame, path: tuple[Condition, ...], depth: int) -> bool:
    """The same of one way, behind which not all of *path* holds; a doubt where that is not put together. Whether there is one more condition."""
    if not path:
        return False
    since = walk.conditions[depth:]
    behind = _behind(walk, frame, path, since)
    if behind is not None and len(walk.conditions) < MOST:
        walk.conditions += [behind] if behind not in since else []
        return behind not in since
    reason = SEVERAL if behind is None else MANY
    walk.doubts += [reason] if reason not in walk.doubts else []
    return False


def _behind(walk: Walk, frame: Frame, path: tuple[Condition, ...], since: list[Condition]) -> Condition | None:
    """What holds where not all of *path* does but all of *since*; None where no condition says it."""
    path = tuple(item for item in path if not (item.is_early and item.statement == "catch"))
    words = {condition.statement for condition in path}
    if words == {"switch"} and len(path) == 1:
        return replace(path[0], is_early=True)
    if "catch" in words:  # no statement says that nothing is thrown
        return replace(next(item for item in path if item.statement == "catch"), is_early=True)
    left = [item for item in path if item not in since and item.statement in ("if", "else")]
    return _opposite(walk, frame, left) if left and not words & {"switch", "#if"} else None


def _opposite(walk: Walk, frame: Frame, path: list[Condition]) -> Condition | None:
    """What holds where not all of the branches *path* are taken; None where that is too long."""
    if len(path) == 1:
        (one,) = path
        place = walk.pairs.setdefault(one.location, one.location)
        return Condition("if" if one.statement == "else" else "else", one.condition, place, is_early=True)
    python = frame.source.separator == "."
    parts = [_negated(item.condition, python) if item.statement == "else" else item.condition for item in path]
    text = (" and " if python else " && ").join(map(_in_brackets, parts))
    return Condition("else", text, path[-1].location, is_early=True) if len(text) <= LONGEST else None


def _negated(text: str, python: bool) -> str:
    return f"not ({text})" if python else f"!({text})"


def _in_brackets(text: str) -> str:
    """A condition as an operand of "and": in brackets where it is made of several."""
    is_joined = any(word in text for word in ("||", "&&", "?", " or ", " and ", " if ", "="))
    return f"({text})" if is_joined and not text.startswith(("!(", "not (")) else text


def is_aside(walk: Walk, frame: Frame, test: Expression, branch: bool) -> bool:
    """Whether a test that comes to *branch* asks only whether the program goes on, or whether something is there."""
    usual = _usual(walk, frame, test)
    return usual is not None and usual is not branch


class _Either:
    """What a test is usually where it asks whether something is there: it may be or not."""


_EITHER = _Either()


def _usual(walk: Walk, frame: Frame, test: Expression) -> bool | _Either | None:
    """What a test is while a node runs; None where that says something of it."""
    if type(test) is syntax.Call:
        return _is_running(walk, frame, test.callee)
    if type(test) is syntax.Name or type(test) is syntax.Member:
        return _EITHER if _is_made(walk, frame, test, is_tested=True) else None
    if type(test) is not syntax.Operation:
        return None
    parts = test.operands
    if test.operator == "!":
        usual = _usual(walk, frame, parts[0])
        return not usual if isinstance(usual, bool) else usual
    if test.operator in ("&&", "||"):
        return _joined([_usual(walk, frame, part) for part in parts], test.operator == "||")
    if test.operator in ("==", "!=", "is", "is not") and len(parts) == 2:
        return _compared(walk, frame, test.operator in ("==", "is"), parts[0], parts[1])
    return None


def _is_running(walk: Walk, frame: Frame, callee: Expression) -> bool | None:
    """What a function says while a node runs that asks whether it does; None of any other."""
    if type(callee) is syntax.Member and not isinstance(callee.object, (syntax.Name, syntax.Member)):
        return None
    if type(callee) is not syntax.Name and type(callee) is not syntax.Member:
        return None
    called = expressions.evaluate(walk, frame, callee)
    if not isinstance(called, Library):
        return None
    if isinstance(called.this, Object) and called.this.name.endswith("NodeHandle"):
        return True if _last(called.name) == "ok" else None
    return RUNNING.get(called.name.removeprefix("::"))


def _joined(every: list[bool | _Either | None], decides: bool) -> bool | _Either | None:
    """The same of several, of which one that is *decides* decides."""
    if any(usual is decides for usual in every):
        return decides
    return None if None in every else next((usual for usual in every if isinstance(usual, _Either)), not decides)


def _compared(walk: Walk, frame: Frame, same: bool, one: Expression, other: Expression) -> bool | _Either | None:
    """The same of a comparison with a null pointer, or with true or false."""
    if isinstance(one, (syntax.Null, syntax.Boolean)):
        one, other = other, one
    if type(other) is syntax.Boolean:
        usual = _usual(walk, frame, one)
        return (usual is other.value) is same if isinstance(usual, bool) else usual
    is_name = isinstance(one, (syntax.Name, syntax.Member)) and type(other) is syntax.Null
    return _EITHER if is_name and _is_made(walk, frame, one, is_tested=False) else None


def _is_made(walk: Walk, frame: Frame, name: Expression, is_tested: bool) -> bool:
    """Whether a variable is a pointer or holds an object that is made, or none: not a setting."""
    cell = expressions.cell_of(walk, frame, name)
    if cell is None:
        return False
    value = cell.value
    options = [option for option in (value.options if isinstance(value, Choice) else (value,)) if option != NONE]
    kinds = (cell.type, value.type if isinstance(value, Opaque) else None)
    if (value == NONE and not is_tested) or any(map(_is_pointer, filter(None, kinds))):
        return True
    is_object = all(isinstance(option, (Object, Pointer, Callable)) for option in options)
    return bool(options) and is_object and not (is_tested and len(options) == 1 and _has_a_say(options[0]))


def _is_pointer(kind: syntax.Type) -> bool:
    return is_smart_pointer(kind) or "*" in kind.marks or expressions.POINTER.search(kind.name) is not None


def _has_a_say(value: Value) -> bool:
    """Whether an object has a say in whether it is true."""
    return isinstance(value, Object) and conversions.truth(value) is None


def is_over(walk: Walk, frame: Frame) -> bool:
    """Whether a ``return`` ends the program: that of the function that it begins with."""
    function = frame.function
    if function is None or len(walk.active) != 1 or walk.is_called_back:
        return False
    return function is walk.entry or function.name.rpartition(frame.source.separator)[2] == "main"


def _is_start(walk: Walk, frame: Frame) -> bool:
    """Whether a failure that this function returns is one to start."""
    if frame.is_start:
        return True
    function = frame.function
    return function is not None and len(walk.active) == 1 and _last(function.name) in STARTS


def is_failure(value: Value) -> bool:
    """Whether a function that returns this says that it has failed."""
    if isinstance(value, Library):
        return value.name.upper().endswith(("FAILURE", "ERROR"))
    if not isinstance(value, Known):
        return False
    return value == NONE or (issubclass(value.kind, (bool, int)) and _is_failing(value))


def _is_failing(value: Known) -> bool:
    if issubclass(value.kind, bool):
        return not value.ask("truth")
    return value.__class__ is Known and isinstance(value.value, int) and value.value < 0


def _last(name: str) -> str:
    return name.rpartition("::")[2].rpartition(".")[2]


def judged(walk: Walk, frame: Frame, test: Expression, then: Block, other: Block) -> bool:
    """Whether *test* asks if a call has failed, and the program ends where it has."""
    if type(test) is syntax.Operation and test.operator in ("!", "==", "!=", "<"):
        return any(map(_is_call, test.operands)) and (_ends(walk, frame, then) or _ends(walk, frame, other))
    return _is_call(test) and bool(other) and _ends(walk, frame, other)


def judged_next(walk: Walk, frame: Frame, statement: Statement, following: Statement) -> bool:
    """Whether *statement* sets a variable to what a call returns, and the program ends where what follows finds it false."""
    if type(following) is not syntax.If or type(following.test) is not syntax.Operation:
        return False
    name, values = "", tuple[Expression, ...]()
    if type(statement) is syntax.Variable:
        name, values = statement.name, syntax.started(statement.init)
    elif type(statement) is syntax.Do and type(statement.value) is syntax.Assignment:
        name, values = syntax.name_of(statement.value.target), (statement.value.value,)
    if not name or len(values) != 1 or not _is_call(values[0]):
        return False
    tested = following.test
    return any(syntax.name_of(part) == name for part in tested.operands) and _ends(walk, frame, following.then)


def _is_call(expression: Expression) -> bool:
    return type(expression) is syntax.Call


def _ends(walk: Walk, frame: Frame, block: Block) -> bool:
    """Whether nothing of the program comes after *block*, as far as its statements tell."""
    if not block:
        return False
    last = block[-1]
    if type(last) is syntax.Throw or any(map(shuts_down, block)):
        return True
    if type(last) is syntax.Return:
        is_start = frame.is_start or (last.value is not None and _is_start(walk, frame))
        return is_over(walk, frame) or (is_start and _is_written_failure(last.value))
    return type(last) is syntax.Do and _called(last) in harmless.ENDING


def _is_written_failure(value: Expression | None) -> bool:
    if type(value) is syntax.Boolean:
        return not value.value
    if type(value) is syntax.Operation:
        return value.operator == "-"
    return value is None or type(value) is syntax.Null or _last(syntax.name_of(value)).endswith(("FAILURE", "ERROR"))


def shuts_down(statement: Statement) -> bool:
    """Whether a statement is a call that takes the node down."""
    return type(statement) is syntax.Do and _called(statement) in SHUTDOWNS


def _called(statement: syntax.Do) -> str:
    """The full name of what a statement calls, as written."""
    callee = statement.value.callee if type(statement.value) is syntax.Call else None
    if type(callee) is syntax.Member and type(callee.object) is syntax.Name:
        return f"{callee.object.name}.{callee.name}"
    return callee.name.removeprefix("::") if type(callee) is syntax.Name else ""
