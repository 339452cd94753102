# SPDX-License-Identifier: Apache-2.0
"""The model as HAROS's plug-ins see it: plain Python objects with the names of HAROS's ``metamodel.py``."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import Any

from haros_ci.query.calls import CALLS
from haros_ci.query.values import QueryEntity, QueryList, QueryPair, QueryRecord

#: The kinds of metamodel.py by the class that they derive from there; ours are added where they fit.
KINDS: dict[str, tuple[str, ...]] = {
    "SourceObject": ("Package", "SourceFile", "Node"),
    "Resource": ("NodeInstance", "Topic", "Service", "Action", "Parameter"),
    "RosPrimitive": (
        "PublishLink", "SubscribeLink", "ServiceLink", "ClientLink", "ReadLink", "WriteLink", "DeclareLink", "ActionServerLink",
        "ActionClientLink",
    ),
    "RosPrimitiveCall": tuple(called for _, called in CALLS.values()),
    "MetamodelObject": ("Configuration",),
    "View": (
        "ResourceCollection", "DependencySet", "RosName", "SourceCondition", "Location2", "RuntimeLocation", "Qos",
        "RosPrimitiveCall",
    ),
}  # fmt: skip
ALIASES = {
    "Publication": "AdvertiseCall",
    "Subscription": "SubscribeCall",
    "ServiceServerCall": "AdvertiseServiceCall",
    "ReadParameterCall": "GetParamCall",
    "WriteParameterCall": "SetParamCall",
}


class EntityView:
    """One entity. What it has is read from the entity when it is asked for, and is the same object every time."""

    _entity: Any
    _model: Model

    def __init__(self, entity: Any, model: Model) -> None:
        self.__dict__.update(_entity=entity, _model=model)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        entity, model = self._entity, self._model
        if name in entity.ATTRIBUTES:
            value = model.shown(entity.ATTRIBUTES[name](entity))
        elif name in entity.METHODS:
            method = entity.METHODS[name][2]
            value = lambda *arguments: model.shown(method(entity, *map(model.meant, arguments)))  # noqa: E731 - one of two bodies of the same name
        else:
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")
        self.__dict__[name] = value
        return value

    def __eq__(self, other: object) -> bool:
        return bool(self._entity == (other._entity if isinstance(other, EntityView) else other))

    def __hash__(self) -> int:
        return hash(self._entity)

    def __str__(self) -> str:
        return str(self._entity.words())

    __repr__ = __str__

    def __iter__(self) -> Iterator[Any]:
        return iter(self._items())

    def __len__(self) -> int:
        return len(self._items())

    def __bool__(self) -> bool:
        return True

    def __getitem__(self, index: Any) -> Any:
        return self._items()[index]

    def __contains__(self, item: object) -> bool:
        if isinstance(item, EntityView):
            return item in self._items()
        return any(getattr(entry, "id", entry) == item for entry in self._items())

    def _items(self) -> list[Any]:
        items = self._entity.items
        if items is None:
            raise TypeError(f"'{type(self).__name__}' object is not iterable")
        return [self._model.shown(item) for item in items]

    def to_JSON_object(self) -> dict[str, Any]:
        """What of it is text or number."""
        return {
            name: value
            for name in self._entity.ATTRIBUTES
            if (value := getattr(self, name)) is None or isinstance(value, (str, int, float))
        }


class MetamodelObject(EntityView):
    """What a plug-in may report on."""


class ReportedLocation:
    """A place to report; what is not known is None."""

    def __init__(
        self, package: Any, file: Any = None, line: Any = None, col: Any = None, fun: Any = None, cls: Any = None
    ):
        self.package, self.file, self.line, self.column, self.function, self.class_ = package, file, line, col, fun, cls

    @property
    def largest_scope(self) -> Any:
        return self.package

    @property
    def smallest_scope(self) -> Any:
        return self.file or self.package

    def to_JSON_object(self) -> dict[str, Any]:
        return {
            "package": getattr(self.package, "name", None),
            "file": getattr(self.file, "full_name", None),
            "line": self.line,
            "column": self.column,
            "function": self.function,
            "class": self.class_,
        }

    def __str__(self) -> str:
        parts = [getattr(self.package, "name", None), getattr(self.file, "full_name", None)]
        text = "in " + "/".join(part for part in parts if part)
        text += f":{self.line}" if self.line is not None else ""
        text += f", in function {self.function}" if self.function else ""
        return text + (f", in class {self.class_}" if self.class_ else "")


def _language(language: str, path: str) -> str:
    """HAROS's word for it."""
    if language == "setup":
        return "python" if path.endswith(".py") else "unknown"
    return language or "unknown"


def _classes() -> dict[str, type]:
    made: dict[str, type] = {"View": EntityView, "MetamodelObject": MetamodelObject, "Location": ReportedLocation}
    for base, kinds in KINDS.items():
        if base not in made:
            made[base] = type(base, (MetamodelObject,), {})
        for kind in kinds:
            if kind not in made:
                made[kind] = type(kind, (made[base],), {})
    return {**made, **{alias: made[name] for alias, name in ALIASES.items()}}


CLASSES = _classes()


def install(modules: dict[str, ModuleType]) -> None:
    """``haros.metamodel`` for plug-ins that ask whether something is a Resource."""
    package, metamodel = ModuleType("haros"), ModuleType("haros.metamodel")
    package.__path__ = []
    for name, made in CLASSES.items():
        setattr(metamodel, name, made)
    setattr(package, "metamodel", metamodel)  # noqa: B010 - a module has no such attribute for mypy
    modules.update({"haros": package, "haros.metamodel": metamodel})


class Model:
    """Entities and their views; *root* is where the workspace lies, as plug-ins open files by themselves."""

    def __init__(self, root: str) -> None:
        self.root = root
        self._views: dict[int, tuple[Any, EntityView]] = {}

    def view(self, entity: Any) -> EntityView:
        """The view of *entity*, always the same one."""
        known = self._views.get(id(entity))
        if known is None:
            kind = getattr(entity, "kind", None) if entity.KIND == "RosPrimitiveCall" else entity.KIND
            made = CLASSES.get(str(kind), EntityView)(entity, self)
            known = self._views[id(entity)] = (entity, made)
            self._complete(made)
        return known[1]

    def shown(self, value: Any) -> Any:
        """A value of the query language as Python has it."""
        if isinstance(value, QueryEntity):
            if value.KIND == "Location":
                place: Any = value
                return ReportedLocation(self.shown(place.package), self.shown(place.file), place.line, place.column)
            return self.view(value)
        if isinstance(value, QueryList):
            return [self.shown(item) for item in value]
        if isinstance(value, QueryRecord):
            return {self.shown(key): self.shown(item) for key, item in value.items()}
        if isinstance(value, QueryPair):
            return (self.shown(value.key), self.shown(value.value))
        return str(value) if isinstance(value, str) else value

    def meant(self, value: Any) -> Any:
        """The other way: an argument that a plug-in gives."""
        return value._entity if isinstance(value, EntityView) else value

    def _complete(self, made: EntityView) -> None:
        """What plug-ins see otherwise than queries: absolute paths, HAROS's words for languages."""
        entity, own = made._entity, made.__dict__
        if entity.KIND == "SourceFile":
            own["path"] = f"{self.root}/{entity.path}"
            own["dir_path"] = own["path"].rpartition("/")[0]
            own["language"] = _language(entity.language, entity.path)
        elif entity.KIND == "Package":
            own["path"] = self.root if entity.path == "." else f"{self.root}/{entity.path}"
            own["bound_to"] = lambda other: setattr(made, "location", other)
