# SPDX-License-Identifier: Apache-2.0
"""Models of C++ libraries: std::string and containers, streams, bind, smart pointers, yaml-cpp, XmlRpcValue, ros::package."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from haros_ci import syntax
from haros_ci.follow import construct, conversions, methods, uncalled
from haros_ci.follow.frames import Frame
from haros_ci.follow.libraries import (
    algorithms,
    cpp_data,
    flags,
    formats,
    given_away,
    moves,
    patterns,
    qt_texts,
    texts,
    traits,
    tuples,
)
from haros_ci.follow.libraries import bind as library_bind
from haros_ci.follow.libraries import containers as library_containers
from haros_ci.follow.libraries import gazebo as library_gazebo
from haros_ci.follow.libraries import numbers as library_numbers
from haros_ci.follow.libraries import xml as library_xml
from haros_ci.follow.libraries import yaml as library_yaml
from haros_ci.follow.ros import loaders, ros2_selectors
from haros_ci.follow.walk import Walk
from haros_ci.index.mentions import LOADERS
from haros_ci.index.types import INTEGERS, REALS, STRINGS, pointee
from haros_ci.model.location import Location
from haros_ci.syntax import Type
from haros_ci.values.abstract import (
    FALSE,
    NONE,
    TRUE,
    Cell,
    Choice,
    Entries,
    Known,
    Library,
    Mapped,
    Object,
    Opaque,
    Sequence,
    Text,
    Value,
    concatenate,
    converted_to_text,
)

if TYPE_CHECKING:
    from haros_ci.follow.call_arguments import PassedArgument

XMLRPC = "XmlRpc::XmlRpcValue"
STREAMS = frozenset(
    ("std::stringstream", "std::ostringstream", "std::istringstream", "stringstream", "ostringstream", "istringstream")
)
FILES = frozenset(("std::ifstream", "std::fstream", "ifstream", "fstream"))
MANIPULATORS = frozenset(("setw", "setfill", "setprecision", "setbase", "setiosflags", "resetiosflags", "put_time"))
NUMBERS = INTEGERS | REALS | {"bool"}
LIMITS = "std::numeric_limits::"
BINDERS = frozenset(("boost::bind", "std::bind", "bind"))
MAKERS = frozenset(
    f"{space}::{name}"
    for space in ("boost", "std")
    for name in ("make_shared", "make_unique", "make_optional", "shared_ptr", "unique_ptr", "weak_ptr")
)
TRANSPARENT = frozenset(
    "std::move std::forward std::ref std::cref boost::ref boost::cref std::string string boost::shared_ptr "
    "boost::static_pointer_cast std::static_pointer_cast boost::dynamic_pointer_cast std::dynamic_pointer_cast "
    "std::const_pointer_cast ros::names::clean boost::filesystem::path std::to_string boost::to_string "
    "boost::lexical_cast std::function boost::function CHECK_NOTNULL DCHECK_NOTNULL "
    "GazeboRosPtr gazebo::GazeboRosPtr FMT_COMPILE FMT_STRING fmt::runtime".split()
)


def instance(walk: Walk, frame: Frame, kind: Type, args: tuple[PassedArgument, ...]) -> Value | None:
    """An instance of a modelled class."""
    name = kind.name
    if name in STREAMS:
        stream = Object(name, fields={"[text]": Cell(Known(""))})
        if args:
            texts.start(walk, stream, args[0].value)
        return stream
    if name == DESCRIPTOR and not args and walk.context.process is not None:
        flag: dict[str, Cell] = {"read_only": Cell(FALSE, syntax.Type("bool"))}
        ranges: dict[str, Cell] = {item: Cell(Sequence(Cell(()))) for item in ("floating_point_range", "integer_range")}
        return Object(name, fields={**flag, **ranges})
    if name in FILES:
        return Object(name, fields={"[path]": Cell(args[0].value if args else NONE)})
    if name == "YAML::Parser":
        return Object(name, fields={"[stream]": Cell(args[0].value if args else NONE)})
    if name in ("YAML::Node", XMLRPC):
        return conversions.converted(args[0].value, kind) if args else NONE
    if name == f"{XMLRPC}::ValueStruct":
        held: Entries = args[0].value.content.value if args and isinstance(args[0].value, Mapped) else {}
        copied: Entries = (
            {key: Cell(cell.value, cell.type) for key, cell in held.items()} if isinstance(held, dict) else held
        )
        return Mapped(Cell(copied))
    if name == f"{XMLRPC}::ValueArray":
        return construct.create(
            walk, frame, syntax.Type("std::vector", (syntax.Type(XMLRPC),), ""), args, Location(frame.source.path)
        )
    if name in ("std::pair",) and len(args) == 2:
        return Object(name, fields={"first": Cell(args[0].value), "second": Cell(args[1].value)})
    return library_gazebo.instance(name, args)


def function(  # noqa: C901 - one branch for each modelled function
    walk: Walk,
    frame: Frame,
    name: str,
    args: tuple[PassedArgument, ...],
    targs: tuple[syntax.Argument, ...],
    location: Location,
) -> Value | None:
    """A modelled free function or constructor by its name."""
    name = name.removeprefix("::")
    if name.removeprefix("std::") in MANIPULATORS:
        return Library(name)
    if name == "ros::names::getRemappings" and not args:
        return loaders.remappings(walk)
    if name in NUMBERS and len(args) <= 1:  # std::size_t{1}, int(x)
        return conversions.converted(args[0].value if args else Known(0), Type(name))
    if name in BINDERS and args:
        return uncalled.keep(walk, library_bind.bind(walk, frame, name, args))
    if name.startswith(LIMITS) and len(targs) == 1 and type(targs[0]) is syntax.Type and not args:
        return library_numbers.limit(name.removeprefix(LIMITS), walk.type_in(targs[0], frame))
    if name.endswith("::directory_iterator") and args:
        return library_xml.directory(walk, args[0].value)
    if name == "std::make_pair" and len(args) == 2:
        return instance(walk, frame, Type("std::pair"), args)
    is_common = name.startswith(("std::", "boost::", "mrpt::"))
    if is_common and (text := algorithms.rewritten(walk, name, args)) is not None:
        return text
    if name in MAKERS:
        if name.endswith("_ptr"):
            return args[0].value if args else NONE
        if targs:
            kind = walk.type_in(targs[0], frame) if type(targs[0]) is syntax.Type else syntax.NOTHING
            return given_away.constructed(walk, construct.create(walk, frame, kind.bare(), args, location))
        return args[0].value if args and name.endswith("_optional") else None
    if name in TRANSPARENT and len(args) in (1, 2):
        value = args[0].value
        if name.endswith("to_string"):
            return concatenate((value,), converted_to_text)
        if name in ("std::string", "string"):
            return texts.constructed(args)
        if name == "boost::lexical_cast" and targs and type(targs[0]) is syntax.Type:
            expected = walk.type_in(targs[0], frame)
            if expected.name not in STRINGS:
                return conversions.converted(library_numbers.of_text(value), expected)
            if isinstance(value, Known) and issubclass(value.kind, float):
                is_double = args[0].type is not None and args[0].type.name == "double"
                return Known(f"{value.value:.17g}") if is_double else walk.opaque("its digits are not known", frame)
            return concatenate((value,))
        return moves.away(walk, frame, args[0]) if name == "std::move" else value
    if name == "ros::package::getPath" and args and isinstance(args[0].value, Known):
        return Known(f"$(find {args[0].value.value})")
    if name in ("ros::names::append", "ros::names::parentNamespace"):
        return concatenate((args[0].value, Known("/"), args[1].value)) if len(args) == 2 else None
    if name in ("YAML::LoadFile", "YAML::Load", "YAML::LoadAll") and args:
        read = library_yaml.yaml_file if name == "YAML::LoadFile" else library_yaml.yaml_stream
        return read(walk, args[0].value)
    if name in patterns.NAMES:
        return patterns.matched(args)
    if name in flags.PARSING:
        return flags.parsed(walk, frame, args)
    if name in ("std::find_if", "std::find") and args:
        return algorithms.found(walk, frame, args)
    if name in ("std::getline",) and len(args) >= 2 and args[1].cell is not None:
        walk.state.write(args[1].cell, walk.opaque("it is read from a stream", frame, None, args[1].cell.type))
        return walk.opaque("whether a stream has more is not known", frame, None, syntax.Type("bool"))
    if name in library_containers.SWAPS and len(args) == 2 and args[0].cell is not None:
        return library_containers.swapped(walk, name, args)
    return _put_together(walk, frame, name, args, targs)


def _put_together(
    walk: Walk, frame: Frame, name: str, args: tuple[PassedArgument, ...], targs: tuple[syntax.Argument, ...]
) -> Value | None:
    """Functions that make tuples and texts, or go through a list."""
    if name == "std::for_each" and len(args) == 3:
        return algorithms.for_each(walk, frame, args)
    if name in library_numbers.CHOOSING:
        kind = walk.type_in(targs[0], frame) if targs and type(targs[0]) is syntax.Type else syntax.NOTHING
        return library_numbers.chosen(name, (conversions.converted(argument.value, kind) for argument in args))
    if name == "std::get" and targs:
        return tuples.got(targs, args)
    if name in ("std::make_tuple", "std::forward_as_tuple"):
        return tuples.made(args)
    if name in formats.FMT and args:
        return formats.fmt(walk, frame, args)
    if name[:1] in "Qq" and (text := qt_texts.function(name, args)) is not None:
        return text
    if name in ("sprintf", "snprintf", "std::sprintf", "std::snprintf") and args and args[0].cell is not None:
        walk.state.write(args[0].cell, formats.printf(walk, frame, args[1:], name.endswith("snprintf")))
        return walk.opaque("the length of a text", frame, None, syntax.Type("int"))
    return traits.decided(walk, frame, name, targs) if targs and not args else None


def protected(walk: Walk, this: Object, name: str) -> Cell | None:
    """A data member that a library's class gives to the workspace's classes derived from it."""
    if name == "_value" and this.definition is not None and XMLRPC in methods.library_bases(walk, *this.definition):
        cell = this.fields[name] = Cell(Object("[any]"))
        return cell
    return None


def method(  # noqa: C901 - one branch for each kind of receiver
    walk: Walk,
    frame: Frame,
    receiver: Value,
    cell: Cell | None,
    name: str,
    args: tuple[PassedArgument, ...],
    location: Location,
    targs: tuple[syntax.Argument, ...] = (),
) -> Value | None:
    """A modelled method by the kind of value it is called on."""
    if isinstance(receiver, Object):
        return _object(walk, frame, receiver, name, args, location, targs)
    if (name.startswith("as_") or name == "get_value") and not args and walk.context.process is not None:
        if isinstance(receiver, (Known, Text, Sequence)) or (isinstance(receiver, Opaque) and _is_filled(cell)):
            return receiver  # what a rclcpp::Parameter that is filled by get_parameter holds
    is_text = isinstance(receiver, Text) or (isinstance(receiver, Known) and issubclass(receiver.kind, str))
    if is_text and name == "append" and cell is None and args:  # of a temporary
        return concatenate((receiver, texts.constructed(args)))
    if name == "get_type" and not args and walk.context.process is not None:  # of what a parameter holds
        result = ros2_selectors.type_constant(receiver)
        if result is not None or isinstance(receiver, (Known, Text, Sequence)):
            return result or walk.opaque("the type of a parameter is not known", frame, location.line)
    if is_text and isinstance(receiver, (Known, Text)):
        made = qt_texts.method(walk, receiver, cell, name, args)
        if made is not None:
            return made
    if isinstance(receiver, Known):
        return cpp_data.of_known(walk, frame, receiver, cell, name, args)
    if isinstance(receiver, (Text, Choice)) and name in ("begin", "end") and (at := cpp_data.of_text(cell)) is not None:
        return at
    if isinstance(receiver, (Text, Choice)) and name in ("c_str", "str", "data"):
        return receiver
    if isinstance(receiver, Text) and name in ("size", "length"):
        return walk.opaque("the length of a text", frame)
    if isinstance(receiver, Text) and name == "empty":
        if any(isinstance(part, str) for part in receiver.parts):
            return FALSE
        return walk.opaque("whether a text is empty", frame, None, syntax.Type("bool"))
    if isinstance(receiver, (Known, Text, Opaque)) and name in ("append", "push_back") and cell is not None and args:
        kind = cell.type
        if kind is not None and kind.name in STRINGS:
            return texts.changed(walk, cell, concatenate((receiver, texts.constructed(args))))
    if isinstance(receiver, Text) and cell is not None and args and name == "assign":
        return texts.changed(walk, cell, conversions.converted(concatenate((texts.constructed(args),)), cell.type))
    if isinstance(receiver, (Text, Choice)) and cell is not None and name == "clear":
        walk.state.write(cell, Known(""))
        return NONE
    if isinstance(receiver, Opaque) and name in ("c_str", "str", "data", "get"):
        return receiver
    if isinstance(receiver, Opaque) and name in OF_LOADER and receiver.type is not None:
        kind = pointee(receiver.type)
        if kind.name == LOADER:
            return _of_loader(walk, frame, Object(kind.name, kind.arguments), name, args, location)
    if isinstance(receiver, Sequence):
        return library_containers.sequence(walk, frame, receiver, name, args)
    if isinstance(receiver, Mapped):
        return library_containers.mapped(walk, frame, receiver, name, args, cell.type if cell is not None else None)
    return None


def _is_filled(cell: Cell | None) -> bool:
    """Whether a variable is a parameter's object: what it holds is the parameter's value."""
    return cell is not None and cell.type is not None and cell.type.name == "rclcpp::Parameter"


def _of_loader(
    walk: Walk, frame: Frame, loader: Object, name: str, args: tuple[PassedArgument, ...], location: Location
) -> Value | None:
    """Methods of pluginlib's loaders: instances by name, and which names there are."""
    if name == "getDeclaredClasses":
        return library_yaml.declared(walk, loader)
    if not args:
        return None
    if name == "isClassAvailable":
        return library_yaml.is_declared(walk, loader, args[0].value)
    return library_yaml.plugin(walk, frame, loader, args[0].value, location)


LOADER = "pluginlib::ClassLoader"
#: Its methods that are followed.
OF_LOADER = LOADERS | {"getDeclaredClasses", "isClassAvailable"}
DESCRIPTOR = "rcl_interfaces::msg::ParameterDescriptor"


#: Classes with models of their own.
_OF_CLASS: dict[str, Callable[..., Value | None]] = {
    **dict.fromkeys(library_xml.CLASSES, library_xml.method),
    **dict.fromkeys(library_gazebo.CLASSES, library_gazebo.method),
}


def _object(  # noqa: C901 - one branch for each modelled class
    walk: Walk,
    frame: Frame,
    receiver: Object,
    name: str,
    args: tuple[PassedArgument, ...],
    location: Location,
    targs: tuple[syntax.Argument, ...],
) -> Value | None:
    if name == "get_type" and not args and receiver.name in ros2_selectors.PARAMETERS:
        return ros2_selectors.type_constant(receiver)
    if receiver.name == LOADER and name in OF_LOADER:
        return _of_loader(walk, frame, receiver, name, args, location)
    if receiver.name in _OF_CLASS:
        return _OF_CLASS[receiver.name](walk, frame, receiver, name, args, targs)
    if receiver.name == "rclcpp::NodeOptions" and name == "arguments" and not args and name not in receiver.fields:
        return Sequence(Cell(()), syntax.Type("std::vector", (syntax.Type("std::string"),), ""))
    if receiver.name == "nodelet::Loader" and name == "load" and len(args) > 1:
        return loaders.nodelet(walk, frame, args, location)
    if receiver.name == LOADER and name == "getName" and args:
        named = args[0].value
        if isinstance(named, Known) and issubclass(named.kind, str):
            return Known(named.of(str).replace("::", "/").rpartition("/")[2])
        return walk.opaque("the plug-in's name is not known", frame, location.line)
    if receiver.name in STREAMS:
        text = receiver.fields["[text]"]
        if name == "str":
            if args:
                texts.start(walk, receiver, args[0].value)
            return text.value
        if name in ("clear", "flush"):
            return NONE
        if name in ("width", "precision", "fill", "setf", "unsetf", "flags", "imbue", "copyfmt") and args:
            texts.change(walk, receiver)
        elif name not in ("good", "fail", "bad", "eof", "width", "precision", "fill", "flags", "rdstate", "tellp"):
            walk.state.write(text, walk.opaque(f"{name} may change it", frame))
    if receiver.name in FILES and name == "open" and args:
        walk.state.write(receiver.fields["[path]"], args[0].value)
        return NONE
    if receiver.name == "YAML::Parser" and name == "GetNextDocument" and args and args[0].cell is not None:
        walk.state.write(args[0].cell, library_yaml.yaml_stream(walk, receiver.fields["[stream]"].value))
        return TRUE
    return None
