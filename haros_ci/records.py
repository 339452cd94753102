# SPDX-License-Identifier: Apache-2.0
"""Data classes that are quick to define and to make: what ``dataclasses`` compiles for seven hundred of them is half of the start of a run."""

from __future__ import annotations

import dataclasses
import reprlib
from collections.abc import Callable
from dataclasses import field
from operator import attrgetter
from types import MemberDescriptorType
from typing import TYPE_CHECKING, Any

__all__ = ["dataclass", "field"]

_MISSING = dataclasses.MISSING


def _made(cls: type, *, frozen: bool, slots: bool, eq: bool, order: bool, kw_only: bool) -> Any:
    """*cls* with its fields and their methods; each method that it defines itself stays."""
    cls.__doc__ = cls.__doc__ or cls.__name__  # the text that dataclasses would make of the signature takes long
    own = set(vars(cls))
    has_hash = "__hash__" in own and not (vars(cls)["__hash__"] is None and "__eq__" in own)
    made: Any = dataclasses.dataclass(init=False, repr=False, eq=False, slots=slots, kw_only=kw_only)(cls)
    fields = dataclasses.fields(made)
    methods: dict[str, Any] = {"__init__": _first_init(made, frozen), "__repr__": _repr}
    if eq:
        names = [f.name for f in fields if f.compare]
        methods["__eq__"] = _equal(names)
        if not has_hash:
            own.discard("__hash__")
            hashed = [f.name for f in fields if (f.compare if f.hash is None else f.hash)]
            methods["__hash__"] = _hash(hashed) if frozen else None
        if order:
            methods |= {name: _compared(_values(names), name) for name in ("__lt__", "__le__", "__gt__", "__ge__")}
    if frozen:
        methods |= _frozen(made, frozenset(f.name for f in fields))
        if slots:
            methods |= _state(made, [f.name for f in fields])
    for name, method in methods.items():
        if name not in own:
            setattr(made, name, method)
    return made


def _values(names: list[str]) -> Callable[[object], tuple[object, ...]]:
    """What gives the values of the attributes *names* of an object."""
    if len(names) > 1:
        return attrgetter(*names)
    get = attrgetter(*names) if names else None
    return (lambda self: (get(self),)) if get else (lambda _: ())


def _compared(values: Callable[[object], tuple[object, ...]], name: str) -> Callable[[object, object], object]:
    compare = getattr(tuple, name)

    def method(self: object, other: object) -> object:
        return compare(values(self), values(other)) if other.__class__ is self.__class__ else NotImplemented

    return method


def _equal(names: list[str]) -> Callable[[object, object], object]:
    if len(names) == 1:
        (get,) = map(attrgetter, names)

        def __eq__(self: object, other: object) -> object:
            if other.__class__ is not self.__class__:
                return NotImplemented
            one, two = get(self), get(other)
            return one is two or one == two  # as tuples compare what they hold
    else:
        values = _values(names)

        def __eq__(self: object, other: object) -> object:
            return values(self) == values(other) if other.__class__ is self.__class__ else NotImplemented

    return __eq__


def _hash(names: list[str]) -> Callable[[object], int]:
    if len(names) == 1:
        (get,) = map(attrgetter, names)
        return lambda self: hash((get(self),))
    values = _values(names)
    return lambda self: hash(values(self))


@reprlib.recursive_repr()
def _repr(self: Any) -> str:
    shown = (f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self) if f.repr)
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _frozen(cls: Any, names: frozenset[str]) -> dict[str, Any]:
    def __setattr__(self: object, name: str, value: object) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")
        super(cls, self).__setattr__(name, value)

    def __delattr__(self: object, name: str) -> None:
        if type(self) is cls or name in names:
            raise dataclasses.FrozenInstanceError(f"cannot delete field {name!r}")
        super(cls, self).__delattr__(name)

    return {"__setattr__": __setattr__, "__delattr__": __delattr__}


def _state(cls: type, names: list[str]) -> dict[str, Any]:
    """How objects that nothing may be assigned to are copied and sent to other processes."""
    values, put = _values(names), [getattr(cls, name).__set__ for name in names]

    def __setstate__(self: object, state: tuple[object, ...]) -> None:
        for set_value, value in zip(put, state, strict=True):
            set_value(self, value)

    return {"__getstate__": lambda self: values(self), "__setstate__": __setstate__}


def _first_init(cls: Any, frozen: bool) -> Callable[..., None]:
    """``__init__`` until the first object is made: it makes the one that stays."""

    def __init__(self: object, /, *args: object, **named: object) -> None:
        cls.__init__ = _init(cls, frozen)  # from now on this is the method of the class
        cls.__init__(self, *args, **named)

    return __init__


def _init(cls: Any, frozen: bool) -> Callable[..., None]:
    """``__init__`` of *cls*. Fields of a class that nothing may be assigned to are put by their slots, in half the time of ``object.__setattr__``."""
    names: dict[str, Any] = {"_missing": _MISSING, "_put": object.__setattr__}
    taken: list[str] = []
    named: list[str] = []
    body: list[str] = []
    for item in dataclasses.fields(cls):
        name, value = item.name, item.name
        if item.default_factory is not _MISSING:
            names[f"_make_{name}"], default = item.default_factory, "_missing"
            value = f"_make_{name}() if {name} is _missing else {name}" if item.init else f"_make_{name}()"
        elif item.default is not _MISSING:
            names[f"_default_{name}"], default = item.default, f"_default_{name}"
            value = name if item.init else default
        elif item.init:
            default = ""
        else:
            continue
        if item.init:
            (named if item.kw_only else taken).append(f"{name}={default}" if default else name)
        slot = getattr(cls, name, None)
        if not frozen:
            body.append(f"_self.{name} = {value}")
        elif isinstance(slot, MemberDescriptorType):
            names[f"_slot_{name}"] = slot.__set__
            body.append(f"_slot_{name}(_self, {value})")
        else:
            body.append(f"_put(_self, {name!r}, {value})")
    if hasattr(cls, "__post_init__"):
        body.append("_self.__post_init__()")
    parameters = ", ".join(("_self", *taken, *(("*", *named) if named else ())))
    exec(f"def __init__({parameters}):\n " + "\n ".join(body or ["pass"]), names)  # of names of fields alone
    init: Callable[..., None] = names["__init__"]
    init.__qualname__ = f"{cls.__qualname__}.__init__"
    return init


if TYPE_CHECKING:
    from dataclasses import dataclass
else:

    def dataclass(cls=None, /, *, frozen=False, slots=False, eq=True, order=False, kw_only=False):
        """As ``dataclasses.dataclass``, but for ``InitVar`` and ``inspect.signature``; ``__init__`` is compiled when the first object is made."""

        def made(cls):
            return _made(cls, frozen=frozen, slots=slots, eq=eq, order=order, kw_only=kw_only)

        return made if cls is None else made(cls)
