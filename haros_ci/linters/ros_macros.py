# SPDX-License-Identifier: Apache-2.0
"""Macros of ROS and its neighbours whose headers cppcheck does not see, as a header for it.

Only those that stop a parser without headers, or mislead it: declarations and statements without a semicolon,
decorations, returns, and
tests in ``#if``. What looks like a call (RCLCPP_INFO) needs no definition; without its arguments they look unused.
"""

from __future__ import annotations

from collections.abc import Iterable

from haros_ci.linters import macro_scan
from haros_ci.linters.compiler_macros import predefined
from haros_ci.model.package import SourceFile
from haros_ci.model.workspace import Store, Workspace
from haros_ci.own_sources import OF_LINTERS, digest
from haros_ci.regex import regex

#: Function-like macros that stand where a declaration or a statement does.
DECLARATIONS = """
RCLCPP_COMPONENTS_REGISTER_NODE RCLCPP_SHARED_PTR_DEFINITIONS RCLCPP_SMART_PTR_DEFINITIONS
RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE RCLCPP_SMART_PTR_ALIASES_ONLY RCLCPP_UNIQUE_PTR_DEFINITIONS
RCLCPP_WEAK_PTR_DEFINITIONS RCLCPP_DISABLE_COPY RCLCPP_COMPONENTS_REGISTER_NODE_FACTORY CLASS_LOADER_REGISTER_CLASS
PLUGINLIB_EXPORT_CLASS PLUGINLIB_DECLARE_CLASS PLUGINLIB_REGISTER_CLASS CLASS_LOADER_REGISTER_CLASS_WITH_MESSAGE
BT_REGISTER_NODES BT_REGISTER_ROS_NODES BT_REGISTER_ROS_ACTION_NODE CreateRosNodePlugin
ROS_DECLARE_MESSAGE ROS_DECLARE_MESSAGE_WITH_ALLOCATOR ROS_DEPRECATED_MSG
IMPLEMENT_TRANSPORT_TYPE MESSAGE_FILTERS_DECLARE_MESSAGE
POINT_CLOUD_REGISTER_POINT_STRUCT POINT_CLOUD_REGISTER_POINT_WRAPPER PCL_EXPORT_INST PCL_INSTANTIATE
DECLARE_TRACEPOINT TRACEPOINT_EVENT TRACEPOINT_EVENT_CLASS TRACEPOINT_EVENT_INSTANCE TP_ARGS TP_FIELDS
DYNAMIC_RECONFIGURE_DECLARE GZ_ADD_PLUGIN GZ_ADD_PLUGIN_ALIAS IGNITION_ADD_PLUGIN IGNITION_ADD_PLUGIN_ALIAS
GZ_REGISTER_MODEL_PLUGIN GZ_REGISTER_SENSOR_PLUGIN GZ_REGISTER_WORLD_PLUGIN GZ_REGISTER_SYSTEM_PLUGIN
GZ_REGISTER_VISUAL_PLUGIN CERES_GTEST_DISABLE BENCHMARK BENCHMARK_MAIN BENCHMARK_REGISTER_F
BOOST_CLASS_EXPORT BOOST_CLASS_EXPORT_KEY BOOST_CLASS_EXPORT_IMPLEMENT BOOST_SERIALIZATION_ASSUME_ABSTRACT
BOOST_GEOMETRY_REGISTER_POINT_2D BOOST_GEOMETRY_REGISTER_POINT_3D BOOST_PYTHON_MODULE_INIT
OMPL_CLASS_FORWARD MOVEIT_CLASS_FORWARD MOVEIT_STRUCT_FORWARD MOVEIT_DECLARE_PTR MOVEIT_DECLARE_PTR_MEMBER
DISALLOW_COPY_AND_ASSIGN EIGEN_EMPTY_STRUCT_CTOR EIGEN_MAKE_ALIGNED_OPERATOR_NEW_IF
ROSIDL_TYPESUPPORT_INTERFACE__LIBRARY_NAME
""".split()

#: Decorations without arguments.
DECORATIONS = """
ROS_DEPRECATED ROS_FORCE_INLINE ROSCPP_DECL ROSTIME_DECL ROSCONSOLE_DECL
EIGEN_MAKE_ALIGNED_OPERATOR_NEW EIGEN_STRONG_INLINE EIGEN_DEVICE_FUNC EIGEN_DONT_INLINE EIGEN_ALWAYS_INLINE EIGEN_UNUSED
PCL_ADD_POINT4D PCL_ADD_RGB PCL_ADD_NORMAL4D PCL_ADD_INTENSITY PCL_ADD_UNION_POINT4D PCL_DEPRECATED_NO_ARGS PCL_EXPORTS
RCUTILS_WARN_UNUSED RCL_WARN_UNUSED RMW_WARN_UNUSED
RCPPUTILS_TSA_CAPABILITY_MUTEX RCPPUTILS_TSA_SCOPED_CAPABILITY
""".split()

#: Decorations with arguments.
ATTRIBUTES = """
RCPPUTILS_TSA_GUARDED_BY RCPPUTILS_TSA_PT_GUARDED_BY RCPPUTILS_TSA_REQUIRES RCPPUTILS_TSA_CAPABILITY
RCPPUTILS_TSA_ACQUIRE RCPPUTILS_TSA_RELEASE RCPPUTILS_TSA_EXCLUDES RCLCPP_DEPRECATED EIGEN_ALIGN_TO_BOUNDARY
PCL_DEPRECATED ROS_PRINTF_ATTRIBUTE
""".split()

#: Macros that begin a function, with what they begin.
FUNCTIONS = {
    "BT_JSON_CONVERTER(type, name)": "void convertToJson(type& name)",
    "BENCHMARK_F(fixture, name)": "void fixture##_##name",
    "BENCHMARK_DEFINE_F(fixture, name)": "void fixture##_##name",
    "BENCHMARK_TEMPLATE_F(fixture, name, ...)": "void fixture##_##name",
}

#: Macros of ros2_shared for parameters of nodes, of which each file makes lists (github.com/ptrmu/ros2_shared, context_macros.hpp).
CONTEXTS = {
    "CXT_MACRO_DEFINE_MEMBERS(all)": "all",
    "CXT_MACRO_DEFINE_MEMBER(n, t, d)": "t n##_{d};",
    "CXT_MACRO_LOAD_PARAMETER(node, context, n, t, d)": "context.n##_ = node.declare_parameter(#n, context.n##_);",
    "CXT_MACRO_INIT_PARAMETERS(all, validate)": "all validate();",
    "CXT_MACRO_SET_PARAMETER(node, context, n, d)": "context.n##_ = d",
    **dict.fromkeys(
        (
            "CXT_MACRO_PARAMETER_CHANGED(...)",
            "CXT_MACRO_REGISTER_PARAMETERS_CHANGED(...)",
            "CXT_MACRO_LOG_PARAMETER(...)",
        ),
        "",
    ),
}

#: Macros of Python's C API that return from the function (docs.python.org, "C API").
RETURNS = {
    "Py_RETURN_NONE": "return Py_None",
    "Py_RETURN_TRUE": "return Py_True",
    "Py_RETURN_FALSE": "return Py_False",
    "Py_RETURN_NOTIMPLEMENTED": "return Py_NotImplemented",
    "Py_RETURN_INF(sign)": "return PyFloat_FromDouble(sign)",
    "Py_RETURN_NAN": "return PyFloat_FromDouble(0)",
    "Py_RETURN_RICHCOMPARE(a, b, op)": "return PyBool_FromLong((a) == (b) || (op))",
}

#: Macros of pybind11 that return what Python's method does; a comma may stand before the closing bracket
#: (pybind11.readthedocs.io, "Classes").
OVERRIDES = {
    f"PYBIND11_{name}(type, ...)": "return pybind11::cast<type >(overridden())"
    for name in (
        *("OVERRIDE", "OVERRIDE_NAME", "OVERRIDE_PURE", "OVERRIDE_PURE_NAME"),
        *("OVERLOAD", "OVERLOAD_NAME", "OVERLOAD_PURE", "OVERLOAD_PURE_NAME"),
    )
}

#: Macros of Qt that mean nothing else (doc.qt.io, "The Property System", "Signals & Slots"); plain names such as
#: ``slots`` are left to
#: cppcheck's own library, as only files that include Qt give them a meaning.
QT_WORDS = ("slots", "signals", "emit", "foreach", "forever")
QT = {
    **dict.fromkeys(
        "Q_OBJECT Q_SLOTS Q_EMIT Q_GADGET Q_INVOKABLE Q_SCRIPTABLE Q_DECL_EXPORT Q_DECL_IMPORT Q_DECL_DEPRECATED".split(),
        "",
    ),
    **dict.fromkeys("Q_DECL_OVERRIDE Q_DECL_FINAL Q_DECL_NOEXCEPT QT_BEGIN_NAMESPACE QT_END_NAMESPACE".split(), ""),
    **{
        f"{name}(...)": ""
        for name in "Q_PROPERTY Q_ENUM Q_ENUMS Q_FLAG Q_FLAGS Q_INTERFACES Q_PLUGIN_METADATA Q_CLASSINFO Q_DECLARE_METATYPE"
        " Q_DECLARE_FLAGS Q_DECLARE_OPERATORS_FOR_FLAGS Q_DECLARE_INTERFACE Q_PRIVATE_SLOT Q_REVISION Q_IMPORT_PLUGIN"
        " Q_DISABLE_COPY Q_DISABLE_COPY_MOVE Q_DISABLE_MOVE Q_DECLARE_TYPEINFO Q_EXPORT_PLUGIN2".split()
    },
    "Q_SIGNALS": "public",
    "Q_SIGNAL": "",
    "Q_SLOT": "",
    "Q_FOREACH(variable, container)": "for (variable : container)",
    "Q_FOREVER": "for (;;)",
}

#: GoogleTest's macros, after each of which a message can be streamed (google.github.io/googletest, "Assertions
#: Reference"); cppcheck's own
#: library has blocks for them, which nothing can follow. What is not here is read as a call.
GOOGLETEST = {
    "MOCK_METHOD(...)": "",
    **{f"MOCK_{const}METHOD{number}(...)": "" for const in ("", "CONST_") for number in range(11)},
    **{
        f"{name}(name, ...)": "template<typename T> bool name##_matcher(const T& arg, std::ostream* result_listener)"
        for name in ("MATCHER", "MATCHER_P", *(f"MATCHER_P{number}" for number in range(2, 11)))
    },
    **{
        f"{name}(suite, name)": "void suite##_##name##_test()"
        for name in ("TEST", "TEST_F", "TEST_P", "TYPED_TEST", "TYPED_TEST_P")
    },
    **dict.fromkeys(
        ("INSTANTIATE_TEST_CASE_P(...)", "INSTANTIATE_TYPED_TEST_CASE_P(...)", "INSTANTIATE_TEST_SUITE_P(...)"), ""
    ),
    "ASSERT_TRUE(condition)": "if (condition) {} else throw ::testing::Message()",
    "ASSERT_FALSE(condition)": "if (!(condition)) {} else throw ::testing::Message()",
    **{
        f"ASSERT_{name}(a, b)": f"if ((a) {operator} (b)) {{}} else throw ::testing::Message()"
        for name, operator in {"EQ": "==", "NE": "!=", "LT": "<", "LE": "<=", "GT": ">", "GE": ">="}.items()
    },
    **{
        f"{kind}_{name}": f"if (::testing::Test::HasFailure()) {{ {code} }} else ::testing::Message()"
        for kind in ("ASSERT", "EXPECT")
        for name, code in {
            "THROW(statement, type)": "try { statement; } catch (const type&) {}",
            "ANY_THROW(statement)": "try { statement; } catch (...) {}",
            "NO_THROW(statement)": "statement;",
            "NO_FATAL_FAILURE(statement)": "statement;",
            "DEATH(statement, matcher)": "statement;",
            "EXIT(statement, predicate, matcher)": "statement;",
        }.items()
    },
}

#: Catch2's macros before a block (github.com/catchorg/Catch2, docs/test-cases-and-sections.md).
CATCH2 = {
    "HAROS_CI_JOINED(a, b)": "a##b",
    "HAROS_CI_NAMED(line)": "void HAROS_CI_JOINED(test_case_, line)()",
    **{
        f"{name}(...)": "HAROS_CI_NAMED(__LINE__)"
        for name in ("SCENARIO", "TEST_CASE", "SCENARIO_METHOD", "TEST_CASE_METHOD")
    },
    **{
        f"{name}(...)": "if (Catch::getCurrentContext())"
        for name in ("GIVEN", "AND_GIVEN", "WHEN", "AND_WHEN", "THEN", "AND_THEN", "SECTION", "DYNAMIC_SECTION")
    },
}
#: The tables of test frameworks, by the names that cppcheck_libraries.py gives them: others have macros of the same
#: names with other arguments.
FRAMEWORKS = {"catch2": CATCH2, "googletest": GOOGLETEST}

#: What <cstdint> says on the platforms of ROS; headers test it to tell 32 from 64 bits.
LIMITS = {"SIZE_MAX": "18446744073709551615UL", "UINTPTR_MAX": "18446744073709551615UL"}

#: What compilers define on the platforms of ROS (GCC's manual, "Common Predefined Macros"; "Tier 1" of REP 2000): without them code that they
#: compile would not be looked at.
PLATFORM = {
    **dict.fromkeys(
        "__linux__ __linux __gnu_linux__ __unix__ __unix __ELF__ __x86_64__ __x86_64 __amd64__ __LP64__ _LP64".split(),
        "1",
    ),
    **{
        "__GNUC__": "13",
        "__GNUC_MINOR__": "2",
        "__GNUC_PATCHLEVEL__": "0",
        "__GNUG__": "13",
        "__VERSION__": '"13.2.0"',
    },
    **{
        "__CHAR_BIT__": "8",
        "__SIZEOF_SHORT__": "2",
        "__SIZEOF_INT__": "4",
        "__SIZEOF_FLOAT__": "4",
        "__SIZEOF_DOUBLE__": "8",
    },
    **dict.fromkeys("__SIZEOF_LONG__ __SIZEOF_LONG_LONG__ __SIZEOF_POINTER__ __SIZEOF_SIZE_T__".split(), "8"),
    **{
        "__INT_MAX__": "2147483647",
        "__LONG_MAX__": "9223372036854775807L",
        "__SCHAR_MAX__": "127",
        "__SHRT_MAX__": "32767",
    },
    **{"__ORDER_LITTLE_ENDIAN__": "1234", "__ORDER_BIG_ENDIAN__": "4321", "__BYTE_ORDER__": "1234"},
    **dict.fromkeys("__STDC_HOSTED__ __EXCEPTIONS __GXX_RTTI __DEPRECATED".split(), "1"),
    **predefined(),
}

#: Tests of versions in ``#if``: code is read as for a recent ROS.
TRUE_TESTS = """
RCLCPP_VERSION_GTE ROS_VERSION_MINIMUM RCUTILS_VERSION_GTE RVIZ_COMMON_VERSION_GTE IMAGE_TRANSPORT_VERSION_GTE
CV_BRIDGE_VERSION_GTE MESSAGE_FILTERS_VERSION_GTE TF2_ROS_VERSION_GTE TF2_VERSION_GTE PLUGINLIB_VERSION_GTE
RCLCPP_ACTION_VERSION_GTE RCLCPP_LIFECYCLE_VERSION_GTE RCLCPP_COMPONENTS_VERSION_GTE TF2_GEOMETRY_MSGS_VERSION_GTE
RMW_VERSION_GTE CLASS_LOADER_VERSION_GTE URDF_VERSION_GTE LASER_GEOMETRY_VERSION_GTE ROSBAG2_CPP_VERSION_GTE
HARDWARE_INTERFACE_VERSION_GTE CONTROLLER_INTERFACE_VERSION_GTE EIGEN_VERSION_AT_LEAST PCL_VERSION_COMPARE
GLIB_CHECK_VERSION GST_CHECK_VERSION GTK_CHECK_VERSION
""".split()

#: Numbers of versions to compare with, ``PCL_VERSION >= PCL_VERSION_CALC(1, 10, 0)``: as 0, which is what an unknown version counts as, so that
#: it is no older than any.
VERSION_NUMBERS = "AV_VERSION_INT KERNEL_VERSION PCL_VERSION_CALC QT_VERSION_CHECK VTK_VERSION_CHECK".split()


_MARK = regex(r"!?[dr]:[A-Z][A-Z0-9_]*")


def macro_marks(workspace: Workspace, files: Iterable[SourceFile], store: Store) -> tuple[str, ...]:
    """The marks of :mod:`macro_scan` of all *files*, sorted; those of each file come from the store, by its digest."""
    files = tuple(files)
    stored = store.get("macros", "", digest(OF_LINTERS))
    known = stored if isinstance(stored, dict) else {}
    found: dict[str, list[str]] = {}
    for file in files:
        marks = known.get(file.digest)
        if not isinstance(marks, list) or not all(isinstance(mark, str) for mark in marks):
            marks = macro_scan.marks(workspace.text(file.path))
        found[file.digest] = marks
    if found.keys() - known.keys():
        store.put("macros", "", digest(OF_LINTERS), found)
    return tuple(sorted({mark for marks in found.values() for mark in marks}))


def names(marks: Iterable[str]) -> tuple[str, ...]:
    """What a workspace with *marks* defines as nothing beside the tables, sorted: ``NAME`` and ``NAME(...)``.

    Marks come from a cache: one that is no name would be a line of its own in the header, such as an ``#include``.
    """
    marks = tuple(mark for mark in marks if _MARK.fullmatch(mark))
    tabled = {name.partition("(")[0] for name, _ in _defines()}
    empty = macro_scan.decorations(marks) - tabled
    called = macro_scan.registrations(marks) - tabled - empty
    return tuple(sorted((*empty, *(f"{name}(...)" for name in called))))


def header(more: Iterable[str], frameworks: Iterable[str] = (), undefined: Iterable[str] = ()) -> str:
    """A header with the tables above, and with *more* names, which mean nothing; what is defined already stays as it is.

    But for *undefined* names, which a library may have defined.

    Of the tables of test frameworks come those that *frameworks* name.
    It is no library file of cppcheck's: two of those that define one name are refused, and its own ones grow.
    """
    lines = []
    for define, value in sorted(
        {
            *_defines(),
            *(item for name in frameworks for item in FRAMEWORKS[name].items()),
            *((name, "") for name in more),
        }
    ):
        name = define.partition("(")[0]
        lines.append(f"#ifndef {name}\n#define {define} {value}".rstrip() + "\n#endif\n")
    return "".join((*lines, *(f"#undef {name}\n" for name in undefined)))


def empty() -> tuple[str, ...]:
    """What the tables define as nothing, test frameworks' aside: ``NAME`` and ``NAME(...)``, sorted."""
    return tuple(sorted({define for define, value in _defines() if not value}))


def stand_ins() -> frozenset[str]:
    """The names that the tables define and compilers do not, but for tests of versions: a condition on one is decided otherwise."""
    known = {name.partition("(")[0] for name, _ in _defines()}
    return frozenset(known - {*PLATFORM, *LIMITS, *TRUE_TESTS, *VERSION_NUMBERS} | {*QT_WORDS})


def _defines() -> Iterable[tuple[str, str]]:
    yield from ((f"{name}(...)", "") for name in (*DECLARATIONS, *ATTRIBUTES))
    yield from ((name, "") for name in DECORATIONS)
    yield from ((f"{name}(...)", "1") for name in TRUE_TESTS)
    yield from ((f"{name}(...)", "0") for name in VERSION_NUMBERS)
    yield from (
        *FUNCTIONS.items(),
        *CONTEXTS.items(),
        *LIMITS.items(),
        *PLATFORM.items(),
        *RETURNS.items(),
        *OVERRIDES.items(),
        *QT.items(),
    )
