# SPDX-License-Identifier: Apache-2.0
"""Types as names: aliases resolved, smart pointers looked through, names qualified as far as the workspace tells."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci import syntax
from haros_ci.index import open_names
from haros_ci.index.common_messages import COMMON
from haros_ci.index.index import Index, Source, pointed_class
from haros_ci.index.macros import class_named, space_named
from haros_ci.syntax import Argument, Type
from haros_ci.syntax.codec import plain

NO_TYPE = syntax.NOTHING
#: Types inside of one, aliases among them, that are resolved for it: those of metaprogramming multiply.
MOST = 300
SMART_POINTERS = frozenset(
    f"{space}::{name}"
    for space in ("boost", "std")
    for name in ("shared_ptr", "scoped_ptr", "unique_ptr", "auto_ptr", "weak_ptr", "intrusive_ptr", "optional")
)
SMART_POINTERS = SMART_POINTERS | {"cv::Ptr"}
SEQUENCES = frozenset(
    ("std::vector", "std::list", "std::deque", "std::array", "std::set", "boost::ptr_vector", "boost::array")
)
MAPS = frozenset(("std::map", "std::unordered_map", "boost::unordered_map"))
STRINGS = frozenset(
    "std::string string std::basic_string str boost::filesystem::path std::string_view boost::string_view absl::string_view QString".split()
)
INTEGERS = frozenset(
    "int long short char unsigned size_t std::size_t ssize_t uint signed byte".split()
    + [
        f"{space}{sign}int{bits}_t"
        for space in ("", "std::", "boost::")
        for sign in ("", "u")
        for bits in (8, 16, 32, 64)
    ]
)
REALS = frozenset(("double", "float", "long double"))
#: What RCLCPP_SMART_PTR_DEFINITIONS and the message generator add to a class (rclcpp/macros.hpp, rosidl_generator_cpp).
ROS2_POINTERS = frozenset(
    f"{const}{kind}{last}"
    for const in ("", "Const")
    for kind in ("Shared", "Unique", "Weak")
    for last in ("Ptr", "PtrWithInfo")
)
#: Names of ``std`` that something is known of, for ``using namespace std``.
STANDARD = frozenset(
    "string string_view vector map list set deque array pair unordered_map shared_ptr unique_ptr weak_ptr optional function "
    "stringstream ostringstream istringstream ifstream ofstream fstream reference_wrapper numeric_limits to_string "
    "make_shared make_unique make_pair move forward ref cref bind getline swap find find_if static_pointer_cast "
    "dynamic_pointer_cast const_pointer_cast".split()
)


_STRING: Type = syntax.Type("std::string")
#: Type definitions of ros/datatypes.h and nodelet/nodelet.h.
_TYPEDEFS: dict[str, tuple[str, tuple[Type, ...]]] = {
    f"{space}::{short}": target
    for space in ("ros", "nodelet")
    for short, target in (("V_string", ("std::vector", (_STRING,))), ("M_string", ("std::map", (_STRING, _STRING))))
}


#: ``std::tuple_element_t<1, std::tuple<A, B>>`` and ``typename std::tuple_element<…>::type`` (en.cppreference.com/w/cpp/utility/tuple_element).
_ELEMENTS = ("tuple_element", "tuple_element_t", "variant_alternative", "variant_alternative_t")


def _element(arguments: tuple[Argument, ...], templates: Mapping[str, Argument]) -> Type | None:
    """The element of a tuple's type, both *arguments* of a look-up of one; None where they do not tell."""
    number, of = arguments if len(arguments) == 2 else (None, None)
    if isinstance(number, (syntax.Name, Type)):
        number = templates.get(number.name)
    if type(number) is not syntax.Number or not isinstance(of, Type) or not isinstance(number.value, int):
        return None
    element = of.arguments[number.value] if 0 <= number.value < len(of.arguments) else None
    return element if isinstance(element, Type) else None


def resolve_type(  # noqa: C901 - the order of the rules of name lookup
    index: Index,
    kind: Type,
    scope: str,
    source: Source,
    files: frozenset[str],
    templates: Mapping[str, Argument],
    depth: int = 0,
) -> Type:
    """*kind* with its aliases and template parameters replaced, all names qualified as far as the workspace tells."""
    name, arguments, marks = kind.name, kind.arguments, kind.marks
    index.resolving = index.resolving + 1 if depth else 0
    if not name or depth > 20 or index.resolving > MOST:
        return syntax.Type(name, (), marks)
    pointer, of_pointer, rest = name.partition("::element_type")
    held = kind.of(0)
    if of_pointer and pointer in SMART_POINTERS and held is not None and rest[:2] in ("", "::"):
        pointed = resolve_type(index, held, scope, source, files, templates, depth + 1)
        if not rest:
            return pointed.marked(marks)
        member = syntax.Type(pointed.name + rest, pointed.arguments, marks)
        return resolve_type(index, member, scope, source, files, {}, depth + 1)

    def inner(item: Argument) -> Argument:
        if isinstance(item, Type):
            number = templates.get(item.name) if templates else None
            if type(number) is syntax.Number:
                return number
            return resolve_type(index, item, scope, source, files, templates, depth + 1)
        return item

    resolved = tuple([inner(item) for item in arguments])
    if name.startswith("::"):  # from the global namespace on ([basic.lookup.qual])
        name, scope, templates = name[2:], "", {}
    if name.removeprefix("std::").removesuffix("::type") in _ELEMENTS:
        element = _element(resolved, templates)
        return element.marked(marks) if element is not None else syntax.Type(name, resolved, marks)
    bound = templates.get(name)
    if bound is not None and not isinstance(bound, Type):
        return syntax.Type(name, resolved, marks)
    if bound is not None:
        return bound.marked(marks)
    head, colons, tail = name.partition("::")
    around_it = templates.get(head) if colons else None
    if isinstance(around_it, Type):
        member = syntax.Type(f"{around_it.name}::{tail}", resolved or around_it.arguments, marks)
        return resolve_type(index, member, scope, source, files, {}, depth + 1)
    hidden: Type | None = None
    for candidate in index.scopes(name, scope, source):
        if index.classes.get(candidate):
            if index.includes(source, index.classes[candidate]):
                return syntax.Type(candidate, resolved, marks)
            hidden = hidden or syntax.Type(candidate, resolved, marks)
            continue
        targets = []
        for where, alias in index.near(index.aliases, candidate, source, files):
            if alias.type.name in (name, candidate):  # typedef struct X X
                continue
            around = candidate.rpartition("::")[0]
            bindings: Mapping[str, Argument] = dict(zip(alias.templates, resolved, strict=False))
            own = resolved
            if not alias.templates and (owners := index.classes.get(around)) and owners[0][1].templates:
                of_class = dict(zip(owners[0][1].templates, resolved, strict=False))
                bindings, own = of_class if colons else templates, ()
            target = resolve_type(index, alias.type, around, where, files, bindings, depth + 1)
            targets.append(_with_arguments(target, alias, own))
        if targets:
            target = targets[0]
            if any(plain(pointee(other)) != plain(pointee(target)) for other in targets):
                target = syntax.Type(candidate, resolved)  # one of several, under an #if
            if index.includes(source, index.aliases[candidate]):
                return target.marked(marks)
            hidden = hidden or target.marked(marks)
    if not colons and hidden is None and (macro := class_named(index, name, source, files)) is not None:
        target = resolve_type(index, syntax.Type(macro[1]), scope, macro[0], files, {}, depth + 1)
        return target.marked(marks)
    if colons and hidden is None and (space := space_named(index, head, source, files)) is not None:
        target = syntax.Type(f"{space}::{tail}", resolved, marks)
        return resolve_type(index, target, scope, source, files, {}, depth + 1)
    if colons:
        for candidate in index.scopes(head, scope, source):
            for where, alias in index.near(index.aliases, candidate, source, files)[:1]:
                around = candidate.rpartition("::")[0]
                target = resolve_type(index, alias.type.bare(), around, where, files, {}, depth + 1)
                if target.name not in (head, name):
                    member = syntax.Type(f"{target.name}::{tail}", resolved or target.arguments, marks)
                    return resolve_type(index, member, scope, source, files, {}, depth + 1)
    if source.program.language != "python":
        owner = pointed_class(index, name, scope, source) if hidden is None else None
        if owner is not None:
            return syntax.Type("std::shared_ptr", (syntax.Type(owner, resolved),), marks)
        local = index.local.get(source.path, {}).get(name) if not colons and not _foreign(index, source) else None
        if local is not None:
            around = local.name.rpartition("::")[0].rpartition("::")[0]
            target = resolve_type(index, local.type, around, source, files, templates, depth + 1)
            return _with_arguments(target, local, resolved).marked(marks)
        if not colons:
            found = _by_include(index, name, source, scope)
            if hidden is not None and found == name:
                return hidden
            name = found
        elif hidden is not None:
            return hidden
        else:
            spaces = {*index.opened(source)}
            name = open_names.inside_interfaces(index, name, source, spaces.union(open_names.around(scope)))
            name = open_names.through(index, name, source)
            whole = _by_include(index, head, source, scope) if head != head.lower() else head
            if whole == head and head not in spaces and name.startswith(f"{head}::"):
                name = _of_library(index, name, spaces, scope)
            name = f"{whole}::{tail}" if whole != head else name
        if name in _TYPEDEFS:
            name, resolved = _TYPEDEFS[name]
        return _pointer(name, resolved, marks)
    return hidden or syntax.Type(name, resolved, marks)


def _with_arguments(target: Type, alias: syntax.Alias, arguments: tuple[Argument, ...]) -> Type:
    """*target* of an *alias* with the *arguments* that its name is given: a using-declaration brings the template itself ([namespace.udecl])."""
    is_brought = alias.name.rpartition("::")[2] == alias.type.name.rpartition("::")[2] and not alias.templates
    if not is_brought or alias.type.arguments or target.arguments:
        return target
    return syntax.Type(target.name, arguments, target.marks)


def _foreign(index: Index, source: Source) -> bool:
    """Whether names may come out of namespaces that the workspace does not define."""
    return any(space.partition("::")[0] not in ("std", "ros", "boost") for space in index.opened(source))


def _pointer(name: str, arguments: tuple[Argument, ...], marks: str) -> Type:
    """``ros::NodeHandlePtr``, ``pkg::Message::ConstPtr``: the smart pointers that ROS packages give their classes."""
    head, _, last = name.rpartition("::")
    if last in ROS2_POINTERS and "::" in head:
        return syntax.Type("std::shared_ptr", (syntax.Type(head, arguments),), marks)
    for suffix in ("ConstPtr", "Ptr"):
        if last == suffix and "::" in head:
            return syntax.Type("boost::shared_ptr", (syntax.Type(head, arguments),), marks)
        if last.endswith(suffix) and last != suffix and head and head != "cv":
            pointed = syntax.Type(f"{head}::{last.removesuffix(suffix)}", arguments)
            return syntax.Type("boost::shared_ptr", (pointed,), marks)
    return syntax.Type(name, arguments, marks)


def _by_include(index: Index, name: str, source: Source, scope: str) -> str:
    """An unqualified name of an open namespace: the header of that name says which one it is from."""
    spaces = {*index.opened(source)} | {scope.partition("::")[0]} - {""}
    if not spaces:
        return name
    included = index.messages(source) if name != name.lower() else {}  # REP 144: packages are in lower case
    for suffix in ("", "ConstPtr", "Ptr", "Request", "Response"):
        found = included.get(name.removesuffix(suffix))
        if found and found.partition("::")[0] in spaces:
            return found + (suffix if name.endswith(suffix) else "")
    bare = name.removesuffix("ConstPtr") if name.endswith("ConstPtr") else name.removesuffix("Ptr")
    interface = open_names.of_interfaces(index, bare, source, spaces)
    if interface is not None:
        return interface + name[len(bare) :]
    homes = [space for space in sorted(spaces) if bare in COMMON.get(space, ())]
    if len(homes) == 1:
        return f"{homes[0]}::{name}"
    return _of_library(index, name, spaces, scope)


def _of_library(index: Index, name: str, spaces: set[str], scope: str) -> str:
    """A name that is not of the workspace, qualified with the one open namespace that is known to have it."""
    if "std" in spaces and name.partition("::")[0] in STANDARD:
        return f"std::{name}"
    bare = name.removesuffix("Ptr")
    either = {space: {f"{space}::{name}", f"{space}::{bare}"} for space in sorted(spaces)}
    homes = [space for space, names in either.items() if not names.isdisjoint(index.library)]
    is_inherited = name[:1].islower() and any(class_.bases for _, class_ in index.classes.get(scope, ()))
    return f"{homes[0]}::{name}" if len(homes) == 1 and not is_inherited else name


def pointee(kind: Type) -> Type:
    """What a pointer or smart pointer points to; the type itself otherwise. Const, references and pointers are dropped."""
    while kind.name in SMART_POINTERS and (inner := kind.of(0)) is not None:
        kind = inner
    return kind.bare()


def is_smart_pointer(kind: Type | None) -> bool:
    return kind is not None and kind.name in SMART_POINTERS
