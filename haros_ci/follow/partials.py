# SPDX-License-Identifier: Apache-2.0
"""functools.partial: a function with some of its arguments (docs.python.org/3/library/functools.html)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from haros_ci.follow import call_arguments
from haros_ci.follow.libraries import bind
from haros_ci.values.abstract import NONE, Callable, Cell, Known, Mapped, Object, Opaque, Sequence, Value

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

PARTIAL = "functools.partial"
_FUNCTION = "[function]"


def partial(function: Value, args: tuple[PassedArgument, ...]) -> Value:
    """*function* with *args*: a bound function, or an object where it is a library's or keywords are given."""
    if isinstance(function, Object) and function.name == PARTIAL:
        function, args = called(function, args)
    if isinstance(function, Callable) and not any(argument.keyword for argument in args):
        return replace(function, bound=(*function.bound, *(argument.value for argument in args)))
    fields = {_FUNCTION: Cell(function)}
    for number, argument in enumerate(args):
        fields[argument.keyword or str(number)] = Cell(argument.value, argument.type)
    return Object(PARTIAL, fields=fields)


def called(value: Object, args: tuple[PassedArgument, ...]) -> tuple[Value, tuple[PassedArgument, ...]]:
    """What a call of a partial object calls, and with what: keywords that are given anew count."""
    anew = {argument.keyword for argument in args}
    first: list[PassedArgument] = []
    named: list[PassedArgument] = []
    for name, cell in value.fields.items():
        if name == _FUNCTION or name in anew:
            continue
        if name.isdigit():
            first.append(call_arguments.PassedArgument(cell.value, None, cell.type))
        else:
            named.append(call_arguments.PassedArgument(cell.value, None, cell.type, name))
    return value.fields[_FUNCTION].value, (*first, *args, *named)


#: Where functions that call back take a tuple of arguments for that and a dictionary of keywords, by the last part of the call: two places and names
#: (docs.python.org/3/library/threading.html, multiprocessing.html).
_PACKED = {
    "Timer": (2, "args", 3, "kwargs"),
    "apply": (1, "args", 2, "kwds"),
    "apply_async": (1, "args", 2, "kwds"),
    **dict.fromkeys(("Thread", "Process", "ForkProcess", "SpawnProcess", "BaseProcess"), (3, "args", 4, "kwargs")),
}
#: How the names of these begin, which other libraries have, too.
_LIBRARIES = ("threading.", "multiprocessing.")
#: concurrent.futures.html
_SUBMIT, _ZIPPED = "concurrent.futures.Executor.submit", "concurrent.futures.Executor.map"
#: Functions that call back once for every item of what they are given beside the function.
_EACH = frozenset(f"multiprocessing.pool.Pool.{name}" for name in ("map", "map_async", "imap", "imap_unordered"))
#: Items up to which each call is followed by itself.
_ITEMS = 20
#: Where a subscriber takes what its callback is given after the message (rospy/topics.py).
_AFTER = {"rospy.Subscriber": 3}
#: Threads of C++ call a function with what stands behind it (en.cppreference.com/w/cpp/thread/thread/thread).
BEHIND = frozenset(("std::thread", "std::jthread", "boost::thread", "std::async", "pthread_create"))


def given(call: str, function: Value, args: tuple[PassedArgument, ...]) -> tuple[Value, ...]:
    """*function* as the *call* that it is given to calls it back, with the arguments that this takes for it; once for each such call."""
    places = _PACKED.get(call.rpartition(".")[2]) if call.startswith(_LIBRARIES) else None
    if places is not None:
        first, second = _argument(args, places[1], places[0]), _argument(args, places[3], places[2])
        return (_with(function, (*_positional(first), *_keywords(second))),)
    if call in BEHIND and isinstance(function, Callable):
        return (_with_rest(function, args),)
    if call == _SUBMIT:
        return (_with(function, args[1:]),)
    if call in _EACH or call == _ZIPPED:
        given_items = [argument.value for argument in args if not argument.keyword][1:]
        return _for_each(function, given_items if call == _ZIPPED else given_items[:1])
    after = _argument(args, "callback_args", _AFTER[call]) if call in _AFTER else None
    if after is None or after == NONE or not isinstance(function, Callable):
        return (function,)
    return (replace(function, bound=(*function.bound, None, after)),)


def _with_rest(function: Callable, args: tuple[PassedArgument, ...]) -> Value:
    """*function*, one of *args*, with those behind it, of which the first may be the object of a method."""
    place = next((number for number, argument in enumerate(args) if argument.value is function), len(args))
    rest = args[place + 1 :]
    if not rest or function.bound:
        return function
    if function.function.is_static or not function.function.owner or function.frame is not None:
        return partial(function, rest)
    return bind.bound((call_arguments.PassedArgument(function), *rest))


def _for_each(function: Value, iterables: list[Value]) -> tuple[Value, ...]:
    """*function* with an item of each of *iterables*, as often as there are some; once with what is not known where one is not known."""
    items = [_positional(iterable) for iterable in iterables]
    if not items or any(not 0 < len(some) <= _ITEMS or some[0].keyword for some in items):
        return (_with(function, tuple(call_arguments.PassedArgument(Opaque(call_arguments.UNPACKED)) for _ in items)),)
    return tuple(_with(function, passed) for passed in zip(*items, strict=False))


def _with(function: Value, passed: tuple[PassedArgument, ...]) -> Value:
    return partial(function, passed) if passed and isinstance(function, (Callable, Object)) else function


def _argument(args: tuple[PassedArgument, ...], name: str, number: int) -> Value | None:
    positional = [argument for argument in args if not argument.keyword]
    named = next((argument.value for argument in args if argument.keyword == name), None)
    return named if named is not None else positional[number].value if number < len(positional) else None


def _positional(value: Value | None) -> tuple[PassedArgument, ...]:
    if value is None or value == NONE:
        return ()
    cells = value.content.value if isinstance(value, Sequence) else None
    if isinstance(cells, tuple):
        return tuple(call_arguments.PassedArgument(cell.value, None, cell.type) for cell in cells)
    if isinstance(value, Known) and isinstance(value.value, (list, tuple)):
        return tuple(call_arguments.PassedArgument(Known(item)) for item in value.value)
    return (call_arguments.PassedArgument(Opaque(call_arguments.UNPACKED), keyword="*"),)


def _keywords(value: Value | None) -> tuple[PassedArgument, ...]:
    if value is None or value == NONE:
        return ()
    pairs = value.content.value if isinstance(value, Mapped) else None
    if isinstance(pairs, dict) and all(isinstance(key, str) for key in pairs):
        return tuple(
            call_arguments.PassedArgument(cell.value, None, cell.type, str(key)) for key, cell in pairs.items()
        )
    if isinstance(value, Known) and isinstance(value.value, dict):
        return tuple(call_arguments.PassedArgument(Known(item), keyword=str(key)) for key, item in value.value.items())
    return (call_arguments.PassedArgument(Opaque(call_arguments.UNPACKED), keyword="**"),)


def callback(value: Object) -> Value | None:
    """The function that a partial object is when it is called back; None where a keyword has no place in it."""
    function, args = called(value, ())
    if not isinstance(function, Callable) or (function.function.owner and function.this is None):
        return None
    names = [parameter.name for parameter in function.function.parameters]
    names = names[: next((number for number, name in enumerate(names) if name.startswith("*")), len(names))]
    bound: list[Value | None] = [*function.bound, *(argument.value for argument in args if not argument.keyword)]
    named = {argument.keyword: argument.value for argument in args if argument.keyword}
    free = names[len(bound) :]
    if not named.keys().isdisjoint(("*", "**")) and len(names) == len(function.function.parameters):
        return replace(function, bound=(*bound, *(Opaque(call_arguments.UNPACKED) for _ in free)))
    if not named.keys() <= set(free):
        return None
    return replace(function, bound=(*bound, *(named.get(name) for name in free)))
