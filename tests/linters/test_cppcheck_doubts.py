# SPDX-License-Identifier: Apache-2.0
"""Findings of cppcheck that the text refutes, and those that it does not."""

from __future__ import annotations

import time

import pytest

from haros_ci.linters.cppcheck_doubts import is_refuted
from haros_ci.linters.cppcheck_initializers import self_initialized_line

UNREAD = "Variable 'kFirst' is assigned a value that is never used."
REFUTED = [
    ("unreadVariable", UNREAD, "const int kFirst = 1;\nswitch (a) {\n  case kFirst: return 1;\n}"),
    ("unreadVariable", UNREAD, "const int kFirst = 1;\nswitch (a) {\n  case (kBase + kFirst):\n    return 1;\n}"),
    ("unreadVariable", UNREAD, "const int kFirst = 1;\ncase\n  kFirst: return 1;\n"),
    ("unreadVariable", "Variable 'pose(2)' is assigned a value that is never used.", "pose(2) = turn(pose(2));"),
    ("unreadVariable", "Variable 'H(1,jy)' is assigned a value that is never used.", "H(1,jy) = 0.5;"),
    ("unreadVariable", UNREAD, "kFirst = 1; }\nvoid before(Eigen::Ref<Vector3d> kFirst) {}\n"),
    ("unreadVariable", UNREAD, "kFirst = 1;\n auto kFirst = matrix.row(2);\n"),
    ("unreadVariable", UNREAD, "kFirst = 1;\n cv::Mat kFirst(image, box);\n"),
    ("unreadVariable", UNREAD, "kFirst = 1;\n std::span<double> kFirst;\n"),
    ("unreadVariable", UNREAD, "auto & [kFirst, second] = pair;\n"),
    ("unreadVariable", UNREAD, "auto [first, kFirst] = pair;\n"),
    ("unusedVariable", "Unused variable: part", "for (const auto & [part, value] : parts) use(value);\n"),
    ("unreadVariable", UNREAD, 'int kFirst = 1;\n// printf("%d", kFirst);\n'),
    ("unreadVariable", UNREAD, "int kFirst = 1;\n/* std::cout << kFirst\n * << 1; */\n"),
    ("unusedVariable", "Unused variable: tmp", "float tmp;\n//  get(&tmp);\n"),
    ("unusedVariable", "Unused variable: tmp.", "float tmp;\n#ifdef SLOW\nget(&tmp);\n#endif\n"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\n#ifndef NDEBUG\n  check(kFirst);\n#endif\n"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", 'm.def("f", &f, "on"_a = false);'),
    ("selfAssignment", "Redundant assignment of '\"a\"' to itself.", 'm.def("f", &f, "a"_a="a");'),
]
UNUSED_ACCESS = "Redundant code: Found unused member access."
OBJECTS = "Comparing pointers that point to different objects"
SYMBOLS = "extern uint32_t _data, _edata;\nextern char _end[];\n"
REFUTED += [
    ("constStatement", UNUSED_ACCESS, "  i2cPort->SR2; // un-stretch the clock\n"),
    ("constStatement", UNUSED_ACCESS, "(void) ports[2]->DR;\n"),
    ("constStatement", UNUSED_ACCESS, "device->port->STATUS.reg;\n"),
    ("comparePointers", OBJECTS, "for (; to < &_edata;) *to++ = 0;\n" + SYMBOLS),
    ("comparePointers", OBJECTS, "if (&_data != from)\n" + SYMBOLS),
    ("subtractPointers", OBJECTS, "size_t n = _end - start;\n" + SYMBOLS),
]
MOVED = "Non-local variable 'waiting_' will use object that points to local variable 'task'."
REFUTED += [
    ("danglingLifetime", MOVED, "waiting_.insert(std::make_pair(task.get(), std::move(task)));\n"),
    ("danglingLifetime", MOVED, "waiting_.emplace(task . get(), std::move( task ));\n"),
]


@pytest.mark.parametrize(
    "text",
    [
        "waiting_.insert(task.get());\n",
        "waiting_.insert(std::make_pair(task.get(), std::move(other)));\n",
        "waiting_.insert(std::make_pair(other.get(), &task));\n",
        "waiting_.push_back(&task); std::move(task);\n",
    ],
)
def test_what_stays_where_it_is(text: str) -> None:
    assert not is_refuted("danglingLifetime", MOVED, 1, text)


CAST = "Redundant code: Found unused cast in expression 'static_cast<T*>(ptr)'."
REFUTED += [
    ("constStatement", CAST, "new (static_cast<T*>(ptr) ) T (val);\n"),
    ("constStatement", CAST, "::new(static_cast<void*>(ptr)) std::vector<int>{1};\n"),
]


@pytest.mark.parametrize(
    "text", ["static_cast<T*>(ptr);\n", "T * n = new T(1); static_cast<T*>(n);\n", "new_one(ptr);\n", "(int) a;\n"]
)
def test_values_that_are_dropped(text: str) -> None:
    assert not is_refuted("constStatement", CAST, 1, text)


RAW = "Memory is allocated but not initialized: cells"
REFUTED += [
    ("uninitdata", RAW, "  delete[] cells;\n"),
    ("uninitdata", RAW, "  delete [] cells; cells = nullptr;\n"),
    ("uninitdata", RAW, "  delete cells;\n"),
    ("uninitdata", RAW, "  if (cells) delete[] cells;\n"),
    ("uninitdata", RAW, "  if (cells != NULL) { delete[] (cells); }\n"),
    ("uninitdata", RAW + ".", "  free(cells);\n"),
    ("uninitdata", RAW, "  std::free( cells );\n"),
]
RAW_AND_READ = [
    "  use(cells);\n",
    "  use(cells); delete[] cells;\n",
    "  delete[] cells[2];\n",
    "  delete cells->next;\n",
    "  x = cells[1]; delete[] cells;\n",
    "  if (cells[0]) delete[] others;\n",
    "  delete[] others;\n",
    "  return cells;\n",
    "  memcpy(copy, cells, 3);\n",
    "",
]


@pytest.mark.parametrize("text", RAW_AND_READ)
def test_memory_that_is_read_without_a_value(text: str) -> None:
    assert not is_refuted("uninitdata", RAW, 1, text)


KEPT = "Non-local variable 'handle' will use pointer to local variable 'name'."
POINTS = "Returning object that points to local variable 'view' that will be invalid when returning."
ITSELF = "Redundant assignment of 'low' to itself."
REFUTED += [
    ("danglingLifetime", KEPT, "handle = connect_to(name.data(), 5);\n"),
    ("danglingLifetime", KEPT, "handle = lib::open(name.data());\n"),
    ("returnDanglingLifetime", POINTS, "auto view = table(); const auto & e = view.data[i]; return out;\n"),
    ("selfAssignment", ITSELF, "(low > a) ? low = a : low = low;\n"),
    ("selfAssignment", ITSELF, "if (a) low = 1; else low = low;\n"),
    ("selfAssignment", ITSELF, "else if (a > -f(2) && a <= 3) {low = low;}\n"),
]
SAME = "Same expression on both sides of '{}'."
REFUTED += [
    ("duplicateExpression", SAME.format("-"), "double m = X(1-1) - X(2-1);\n"),
    ("duplicateExpression", SAME.format("-"), "m[1 - 1] = 0;\n"),
    ("duplicateExpression", SAME.format("/"), "rate = 1.0 / 1.0;\n"),
    ("duplicateExpression", SAME.format("|"), "flags = 0x1 | 0x1;\n"),
]
COST = "Uninitialized variable: made.cost"
REFUTED += [("uninitvar", COST, "return made;\n"), ("uninitvar", COST, "    return made ;\n")]
SWITCH = "switch (kind)\n{\n  case Kind::A:\n    return 1;\n  case Kind::B: { return 2; }\n}\n"
EXIT = "Found an exit path from function with non-void return type that has missing return statement."
REFUTED += [
    ("missingReturn", EXIT, SWITCH),
    ("missingReturn", EXIT, SWITCH.replace(")\n{", ") {")),
    ("missingReturn", EXIT, SWITCH.replace("Kind::", "robot::Kind::")),
]
THROWN = "Return value of function std::string().at() is not used."
REFUTED += [
    ("missingReturn", EXIT, "std::rethrow_exception(e);\n  }\n"),
    ("missingReturn", EXIT, "    std::abort();\n}\n"),
    ("missingReturn", EXIT, "  rethrow_exception(\n    std::current_exception());\n}\n"),
    ("ignoredReturnValue", THROWN, "EXPECT_THROW(text.at(1), std::out_of_range);\n"),
    ("unusedScopedObject", "Instance of 'A' object is destroyed", "ASSERT_THROW(A(1), std::runtime_error);\n"),
    ("constStatement", "Unused variable value 'i'.", "  for (i; i < 3; ++i) {\n"),
    ("memleak", "Memory leak: leaked_maps", "leaked_maps);\n"),
    ("memleak", "Memory leak: maps", "// They leak on purpose: the library frees them twice.\nreturn (void)maps;\n"),
    ("memleak", "Memory leak: maps", "/* intentionally\n * leaked */\nauto * maps = new Maps;\nreturn (void)maps;\n"),
]
REFUTED += [
    ("missingReturn", EXIT, 'JSON_THROW(make(401, "a;b", this));\n}\n'),
    ("missingReturn", EXIT, "  ROS_ASSERT(false);\n}\n"),
    ("missingReturn", EXIT, "  ABSL_UNREACHABLE();\n}\n"),
    ("missingReturn", EXIT, "  UNREACHABLE;\n}\n"),
    ("missingReturn", EXIT, "  THROW_ERROR(a,\n    b(1));\n}\n"),
]
STANDS = [
    ("danglingLifetime", KEPT, "handle = name.data();\n"),
    ("danglingLifetime", KEPT, "handle = &name;\n"),
    ("danglingLifetime", KEPT, "handle = std::addressof(name);\n"),
    ("danglingLifetime", KEPT, "handle = open_it(other);\n"),
    ("returnDanglingLifetime", POINTS, "Table view; const auto & e = view.data[i]; return out;\n"),
    ("returnDanglingLifetime", POINTS, "auto view = table(); return &view;\n"),
    ("selfAssignment", ITSELF, "low = low;\n"),
    ("selfAssignment", ITSELF, "if (a) low = low;\n"),
    ("constStatement", UNUSED_ACCESS, "  message->data;\n"),
    ("constStatement", UNUSED_ACCESS, "  point.X;\n"),
    ("constStatement", UNUSED_ACCESS, "  port->SR2 == 1;\n"),
    ("comparePointers", OBJECTS, "if (first < &second)\nint second;\n" + SYMBOLS),
    ("comparePointers", OBJECTS, "if ((uint32_t *)a < b)\n" + SYMBOLS),
    ("nullPointer", "Null pointer dereference: _end", "*_end = 0;\n" + SYMBOLS),
    ("duplicateExpression", SAME.format("-"), "m = x - x;\n"),
    ("duplicateExpression", SAME.format("-"), "m = a1 - a1 + f(1);\n"),
    ("duplicateExpression", SAME.format("-"), "m = x[1] - x[1];\n"),
    ("duplicateExpression", SAME.format("&&"), "if (a && a) f(1-1);\n"),
    ("duplicateExpression", SAME.format("-"), "m = 1 - 12 + x - x;\n"),
    ("missingReturn", EXIT, "  ROS_ERROR(1);\n}\n"),
    ("missingReturn", EXIT, '  RCLCPP_ERROR_STREAM(log, "no" << a);\n}\n'),
    ("missingReturn", EXIT, "  ROS_FATAL(1);\n}\n"),
    ("missingReturn", EXIT, "  MY_LOG_INFO(1);\n}\n"),
    ("missingReturn", EXIT, "  LOG(1);\n}\n"),
    ("missingReturn", EXIT, "  Throw(1);\n}\n"),
    ("missingReturn", EXIT, "  a = THROW(1);\n}\n"),
    ("missingReturn", EXIT, "if (a)\n  MY_THROW(1);\n}\n"),
    ("missingReturn", EXIT, "store_exception(e);\n}\n"),
    ("missingReturn", EXIT, "std::rethrow_if_nested(e);\n}\n"),
    ("missingReturn", EXIT, "my_abort();\n}\n"),
    ("ignoredReturnValue", THROWN, "text.at(1);\n"),
    ("ignoredReturnValue", THROWN, "MY_THROW(text.at(1));\n"),
    ("constStatement", "Unused variable value 'i'.", "  i;\n"),
    ("memleak", "Memory leak: maps", "return maps->size();\n"),
    ("memleak", "Memory leak: maps", "// a leak of oil is no reason to stop\nreturn maps->size();\n"),
    ("constStatement", "Unused variable value 'i'.", "  for (i = 0; i < 3; ++i) { j; }\n"),
    ("uninitvar", COST, "return made.cost;\n"),
    ("uninitvar", COST, "return other;\n"),
    ("uninitvar", COST, "return made + 1;\n"),
    ("uninitvar", COST, "use(made);\n"),
    ("uninitvar", "Uninitialized variable: made", "return made;\n"),
    ("nullPointer", "Null pointer dereference: made.cost", "return made;\n"),
    ("missingReturn", EXIT, SWITCH.replace("Kind::", "")),
    ("missingReturn", EXIT, SWITCH.replace("Kind::A", "1").replace("Kind::B", "2")),
    ("missingReturn", EXIT, SWITCH.replace("case Kind::B", "default")),
    ("missingReturn", EXIT, "if (a) {\n" + SWITCH + "}\n"),
    ("missingReturn", EXIT, "if (a)\n{\n  return 1;\n}\n"),
    ("missingReturn", EXIT, "switch (kind) {\n  case Kind::A:\n"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case 1: return kSecond; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case kFirstOfAll: return 1; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\nswitch (a) { case 1: kFirst = 2; }"),
    ("unreadVariable", UNREAD, "int kFirst = 1; // in this lowercase kFirst\n"),
    ("unreadVariable", UNREAD, "int kFirst = 1; // kFirst (the first) comes first\n"),
    ("unreadVariable", UNREAD, 'int kFirst = 1;\n// printf("%d", kFirstOfAll);\n'),
    ("unreadVariable", UNREAD, "#ifndef A_H\n#define A_H\nint kFirst = 1;\n#endif\n"),
    ("unreadVariable", UNREAD, "int kFirst = 1;\n#ifdef SLOW\nget(&other);\n#endif\n"),
    ("unreadVariable", UNREAD, "void f() {\nint kFirst = 1;\n}\nvoid g() {\n// use(kFirst);\n}\n"),
    ("unreadVariable", UNREAD, "auto kFirst = matrix.rows();\n"),
    ("unreadVariable", UNREAD, "std::string kFirst = data[0];\n"),
    ("unreadVariable", "Variable 'a[0]' is assigned a value that is never used.", "a[0] = 1;\n"),
    ("unusedVariable", "Unused variable: tmp", "float tmp;\nget(&temp);\n"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", "int* p = false;"),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", 'p = "a"_s == b;'),
    ("assignBoolToPointer", "Boolean value assigned to pointer.", ""),
    ("nullPointer", "Null pointer dereference: 'p'", 'f("on"_a = *p);'),
]


ALWAYS = 'Conversion of string literal "no solution" to bool always evaluates to true.'
REFUTED += [
    ("incorrectStringBooleanError", ALWAYS, 'assert(a.isApprox(b) && "no solution" && __LINE__);'),
    ("incorrectStringBooleanError", ALWAYS, 'ROS_ASSERT(a && "no solution" && b);'),
]
STANDS += [
    ("incorrectStringBooleanError", ALWAYS, 'if (a && "no solution" && b) {'),
    ("incorrectStringBooleanError", ALWAYS, 'assert("no solution");'),
    ("incorrectStringBooleanError", ALWAYS, 'check = a && "no solution";'),
]


@pytest.mark.parametrize(("rule", "message", "text"), REFUTED)
def test_refuted(rule: str, message: str, text: str) -> None:
    assert is_refuted(rule, message, _line(message, text), text)


@pytest.mark.parametrize(("rule", "message", "text"), STANDS)
def test_stands(rule: str, message: str, text: str) -> None:
    assert not is_refuted(rule, message, _line(message, text), text)


def _line(message: str, text: str) -> int:
    """The first line of *text* with the name that *message* ends or begins with."""
    if message is EXIT:
        return text[: max(text.find("{"), 0)].count("\n") + 1
    name = "kFirst" if message is UNREAD else message.rstrip(".").rpartition(" ")[2]
    return text[: max(text.find(name), 0)].count("\n") + 1


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("A(const A& a) :\n  a_(a_) {}", 2),
        ("A(const A& a) : b_(0),\n  a_{a_} {}", 2),
        ("A(const A& a) : a_(a_),\n  a_(a_) {}", 1),
        ("A(const A& a) :\n  b_(a_) {}", 1),
        ("A", 1),
    ],
)
def test_the_line_of_an_initializer(text: str, line: int) -> None:
    assert self_initialized_line("Member variable 'a_' is initialized by itself.", 1, text) == line


ENDED = [
    "int f() {\n  fail();\n  JSON_THROW(make(1,\n    two()));\n",
    "int f() {\n  if (a) return 1;\n  else\n    MY_FAIL(a);  // never back\n",
    "  switch (a) {\n    default: PANIC(a);\n",
]
OPEN = [
    "int f() {\n  if (a)\n    MY_THROW(1);\n",
    "int f() {\n  if (a) {\n    MY_THROW(1);\n  }\n",
    "int f() {\n  MY_THROW(1);\n  a = 1;\n",
    "int f() {\n  // MY_THROW(1);\n",
]


@pytest.mark.parametrize("text", ENDED)
def test_the_bracket_behind_a_macro(text: str) -> None:
    assert is_refuted("missingReturn", EXIT, text.count("\n") + 1, text + "}\n")


@pytest.mark.parametrize("text", OPEN)
def test_the_bracket_behind_another_path(text: str) -> None:
    assert not is_refuted("missingReturn", EXIT, text.count("\n") + 1, text + "}\n")


FLOAT = "%g in format string (no. 1) requires 'double' but the argument type is '{}'."
NAMED = [
    ("invalidPrintfArgType_float", "number_t", "print(x);\nusing number_t = Number;\n"),
    ("invalidPrintfArgType_float", "const number_t", "print(x);\ntypedef Number number_t;\n"),
    ("invalidPrintfArgType_float", "T", "print(x);\ntemplate <class A, typename T>\n"),
]
KNOWN = [
    ("invalidPrintfArgType_float", "int", "print(x);\nusing number_t = Number;\n"),
    ("invalidPrintfArgType_float", "size_t {aka unsigned long}", "print(x);\n"),
    ("invalidPrintfArgType_float", "std::string", "print(x);\nusing string = A;\n"),
    ("invalidPrintfArgType_s", "number_t", "print(x);\nusing number_t = Number;\n"),
]


@pytest.mark.parametrize(("rule", "of", "text"), NAMED)
def test_a_name_for_a_type_of_elsewhere(rule: str, of: str, text: str) -> None:
    assert is_refuted(rule, FLOAT.format(of), 1, text)


@pytest.mark.parametrize(("rule", "of", "text"), KNOWN)
def test_a_known_type(rule: str, of: str, text: str) -> None:
    assert not is_refuted(rule, FLOAT.format(of), 1, text)


SWITCH_ON = "void plan() {\n  const bool fast = true;\n  bool smooth = true;\n  bool draw{false};\n  if (fast) {\n    %s\n  }\n}\n"
BY_HAND = ["if (smooth) {", "if (!draw) {", "if (smooth && fast) {", "} else if ((smooth)) {", "if (smooth == true) {"]
BY_CODE = [
    "smooth = turn(); if (smooth) {",
    "turn(smooth); if (smooth) {",
    "turn(&smooth); if (smooth) {",
    "in >> smooth; if (smooth) {",
    "smooth |= turn(); if (smooth) {",
    "if (count > 0) {",
    "if (fast && count) {",
    "if (smooth && turn()) {",
    "if (this->smooth) {",
    "if (robot.smooth) {",
    "bool smooth = true; if (smooth) {",
    "if (other) {",
    "turn(a, smooth); if (smooth) {",
]


@pytest.mark.parametrize("rule", ["identicalInnerCondition", "duplicateCondition"])
@pytest.mark.parametrize("inner", BY_HAND)
def test_switches_that_are_set_by_hand(rule: str, inner: str) -> None:
    assert is_refuted(rule, "Identical inner 'if' condition is always true.", 6, SWITCH_ON % inner)


@pytest.mark.parametrize("inner", BY_CODE)
def test_what_code_sets_is_no_switch(inner: str) -> None:
    text = SWITCH_ON % inner
    assert not is_refuted("identicalInnerCondition", "Identical inner 'if' condition is always true.", 6, text)
    elsewhere = f"{SWITCH_ON % ';'}void act(bool smooth) {{\n  if (smooth) {{\n    if (smooth) {{}}\n  }}\n}}\n"
    assert not is_refuted("duplicateCondition", "", elsewhere.count("\n") - 2, elsewhere)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("next = (next + 1) % kCount;", True),
        ("next %= kCount;", True),
        ("next = (next + 1) %\n  (count);", True),
        ("next = (next + 1) % 1;", False),
        ("next %= 1;", False),
        ("next = (next % 1) % kCount;", False),
    ],
)
def test_the_modulo_of_a_named_one(line: str, expected: bool) -> None:
    assert is_refuted("moduloofone", "Modulo of one is always equal to zero.", 1, line) is expected


NEVER = "Logical disjunction always evaluates to true: {0} < 0 || {0} > {1}."


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        ("0xFFFFFFFFFFFFFFFF", True),
        ("0xffffffffffffffffULL", True),
        ("0xFFFF'FFFF'FFFF'FFFF", True),
        ("0x8000000000000000u", True),
        ("18446744073709551615", True),
        ("9223372036854775808ull", True),
        ("0x7FFFFFFFFFFFFFFF", False),
        ("9223372036854775807", False),
        ("0xFFFFFFFF", False),
        ("-1", False),
        ("2.5e30", False),
        ("id0xFFFFFFFFFFFFFFFF", False),
        ("0", False),
    ],
)
def test_constants_that_cppcheck_takes_for_negative_ones(number: str, expected: bool) -> None:
    line = f"if (n < 0 || n > {number}) {{\n"
    assert is_refuted("incorrectLogicOperator", NEVER.format("n", number), 1, line) is expected
    assert is_refuted("knownConditionTrueFalse", "Condition is always true", 1, line) is expected
    assert is_refuted("incorrectLogicOperator", NEVER.format("n", number), 2, line) is expected  # it is in the message
    assert not is_refuted("nullPointer", "Null pointer dereference: n", 1, line)


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("smooth && !(fast)", True),
        ("!(smooth) && fast", True),
        ("smooth || fast", True),
        ("smooth && !(smooth)", False),
        ("speed > 3 && speed < 1", False),
        ("smooth && speed < 1", False),
        ("a.smooth && !(a.fast)", False),
        ("smooth() && !(fast)", False),
        ("smooth && !(fast) && slow", False),
    ],
)
def test_conditions_that_join_two_switches(condition: str, expected: bool) -> None:
    message = f"Logical conjunction always evaluates to false: {condition}."
    assert is_refuted("incorrectLogicOperator", message, 1, "if (smooth && !fast) {\n") is expected


OPPOSITE = "Expression is always true because 'else if' condition is opposite to previous condition at line 1."


@pytest.mark.parametrize(
    "after",
    [
        "{ b(); }\nc();\n",
        "{\n  if (d) { b(); } else { c(); }\n}\n}\n",
        '{\n  b("}");  // } else {\n}\n\n}\n',
        "b();\nc();\n",
        "\n  b();\n}\n",
        "{ b('{'); } /* else */ c();\n",
    ],
)
def test_a_condition_that_is_spelled_out(after: str) -> None:
    assert is_refuted("multiCondition", OPPOSITE, 3, f"if (n == -1) {{\n  a();\n}} else if (n != -1) {after}")
    assert is_refuted("multiCondition", OPPOSITE, 4, f"if (n == -1) {{\n  a();\n}} else\n  if (n != -1) {after}")


@pytest.mark.parametrize(
    ("message", "after"),
    [
        (OPPOSITE, "{ b(); } else { c(); }\n"),
        (OPPOSITE, "{\n  b();\n}\n// never\nelse {\n  c();\n}\n"),
        (OPPOSITE, "b();\nelse\n  c();\n"),
        (OPPOSITE, "{ b(); } else if (m) { c(); }\n"),
        (OPPOSITE, "{ b();"),
        (OPPOSITE.replace("opposite to", "matches"), "{ b(); }\nc();\n"),
        (
            "Expression is always false because 'else if' condition matches previous condition at line 1.",
            "{ b(); }\n}\n",
        ),
    ],
)
def test_a_condition_that_leaves_code_dead(message: str, after: str) -> None:
    assert not is_refuted("multiCondition", message, 3, f"if (n == -1) {{\n  a();\n}} else if (n != -1) {after}")


FEOF = "Using feof() as a loop condition causes the last line to be processed twice."


@pytest.mark.parametrize(
    "body",
    [
        "  if (fgets(buffer, 80, pipe) != NULL) {\n    text += buffer;\n  }\n",
        "  if (fgets(buffer, 80, pipe)) text += buffer;\n",
        "  char line[80];\n  if (!std::fgets(line, 80, pipe)) break;\n  use(line);\n",
        "  if (NULL == fgets(line, 80, pipe)) { break; }\n  use(line);\n",
        '  if (2 != fscanf(pipe, "%d}{", &a, &b)) break;\n',
        "  size_t n = fread(buffer, 1, 80, pipe);\n  if (n == 0) break;\n  use(buffer, n);\n",
        "  char * line = (char *)fgets(buffer, 80, pipe);\n  // next\n  if (line != NULL) use(line);\n",
        "  c = fgetc(pipe);\n  if (c == EOF) { break; }\n",
        '  fscanf(pipe, "%lf\\t%lf\\n", &p.x, &p.y);\n  points.push_back(p);\n',
        '  std::fscanf(it->pipe, "%d ", &a);\n  use(a);\n',
        '  fscanf(pipe, "%d,"\n    "%d\\r\\n", &a, &b);\n  use(a);\n',
    ],
)
def test_a_read_that_is_checked(body: str) -> None:
    assert is_refuted("wrongfeofUsage", FEOF, 2, f"open();\nwhile (!feof(pipe)) {{\n{body}}}\n")
    assert is_refuted("wrongfeofUsage", FEOF, 2, f"open();\n  while (ok() && !std::feof(it->pipe))\n  {{\n{body}}}\n")


@pytest.mark.parametrize(
    "body",
    [
        "  fgets(buffer, 80, pipe);\n  text += buffer;\n",
        '  fscanf(pipe, "%d", &a);\n  if (a > 1) use(a);\n',
        "  c = fgetc(pipe);\n  use(c);\n",
        "  // if (fgets(buffer, 80, pipe) != NULL)\n  fgets(buffer, 80, pipe);\n",
        "  n = fread(buffer, 1, 80, pipe);\n  use(buffer, n);\n}\nif (n == 0) {\n",
        "  use(buffer);\n}\nif (fgets(buffer, 80, pipe)) {\n",
        "  if (a) { fgets(buffer, 80, pipe); }\n",
        '  puts("if (fgets(x))");\n  fgets(buffer, 80, pipe);\n',
        '  fscanf(pipe, "%d\\n", &a);\n  fgets(buffer, 80, pipe);\n  use(a);\n',
        '  fscanf(pipe, "%d\\n%d", &a, &b);\n  use(a);\n',
        '  fscanf(pipe, "%dn", &a);\n  use(a);\n',
        '  fscanf(pipe, format, &a, "\\n");\n  use(a);\n',
        '  // fscanf(pipe, "%d\\n", &a);\n  fscanf(pipe, "%d", &a);\n  use(a);\n',
    ],
)
def test_a_read_that_is_not_checked(body: str) -> None:
    assert not is_refuted("wrongfeofUsage", FEOF, 2, f"open();\nwhile (!feof(pipe)) {{\n{body}}}\n")


def test_no_loop_there() -> None:
    assert not is_refuted("wrongfeofUsage", FEOF, 1, "open();\nwhile (!feof(pipe)) {\n  if (fgets(a, 1, b)) c();\n}\n")
    assert not is_refuted("wrongfeofUsage", FEOF, 9, "open();\n")


TEMPORARY = "Using object that is a temporary."
REPLY = "void go(){{\n  {}\n  {}\n  int a = 1;\n  send(reply, a);\n}}\n"
GIVEN = 'reply["map"]["file"] = (name + ".yaml").c_str();'


@pytest.mark.parametrize(
    "kind",
    [
        "json reply;",
        "nlohmann::json reply;",
        "Json::Value reply;",
        "YAML::Node & reply = all;",
        "XmlRpc::XmlRpcValue reply;",
    ]
    + ["std::map<std::string, std::string> reply;", "std::vector<std::string> reply(3);"],
)
def test_a_text_that_is_copied(kind: str) -> None:
    for given in (GIVEN, "this->" + GIVEN, "reply[0] = text().c_str();", "reply[i] = make(1).data();"):
        assert is_refuted("danglingTemporaryLifetime", TEMPORARY, 5, REPLY.format(kind, given))


@pytest.mark.parametrize(
    ("kind", "given"),
    [
        ("const char * reply[2];", GIVEN),
        ("std::map<std::string, const char *> reply;", GIVEN),
        ("std::map<std::string, std::string_view> reply;", GIVEN),
        ("std::vector<const char *> reply(3);", GIVEN),
        ("", GIVEN),
        ("auto reply = make();", GIVEN),
        ("json other;", GIVEN),
        ("json reply;", GIVEN.replace("reply", "other")),
        ("json reply;", "const char * text = name().c_str();"),
        ("json * reply;", "reply = name().data();"),
    ],
)
def test_a_text_that_may_be_gone(kind: str, given: str) -> None:
    assert not is_refuted("danglingTemporaryLifetime", TEMPORARY, 5, REPLY.format(kind, given))


FIELDS = "void f() {{\n  {0}\n  {1}\n  msg.header.stamp = now;\n}}\n"


@pytest.mark.parametrize(
    ("kind", "given", "expected"),
    [
        ("geometry_msgs::msg::TransformStamped msg;", "msg.header.frame_id = (a + b).c_str();", True),
        ("geometry_msgs::TransformStamped msg;", "msg.header.frame_id = (a + b)\n    .c_str();", True),
        ("demo::msg::Frame msg;", "msg.frame = std::string(a).data();", True),
        ("auto x = demo::msg::Frame(); Frame msg;", "msg.frame = std::string(a).data();", False),
        ("Frame msg;", "msg.frame = (a + b).c_str();", False),
        ("geometry_msgs::msg::TransformStamped msg;", "const char * frame = (a + b).c_str();", False),
        ("geometry_msgs::msg::TransformStamped other;", "other.child_frame_id = (a + b).c_str();", False),
        ("geometry_msgs::msg::TransformStamped msg;", "view.header.frame_id = (a + b).c_str();", False),
    ],
)
def test_a_text_of_a_message(kind: str, given: str, expected: bool) -> None:
    line = 4 + given.count("\n")
    assert is_refuted("danglingTemporaryLifetime", TEMPORARY, line, FIELDS.format(kind, given)) is expected


def test_a_text_of_another_function() -> None:
    text = (
        REPLY.format("json reply;", GIVEN) + "void more() {\n  const char * reply = f().c_str();\n  send(reply);\n}\n"
    )
    assert not is_refuted("danglingTemporaryLifetime", TEMPORARY, 9, text)


@pytest.mark.parametrize("filler", ["while (!feof(a)) { ", "if (", "a = ", "reply[a]", "'", "{ "])
def test_long_bodies_take_no_time(filler: str) -> None:
    start = time.monotonic()
    text = "while (!feof(a)) {\n" + filler * 20000
    assert not is_refuted("wrongfeofUsage", FEOF, 1, text)
    assert not is_refuted("danglingTemporaryLifetime", TEMPORARY, 2, text)
    assert time.monotonic() - start < 2


POINTED = [
    "const auto & det = map.entries()[0]->part;\nuse(det);\n",
    "const auto& det = node()->part;\nuse(det.size());\n",
    "auto & first = map.entries()[0]->part;\nconst auto & det = std::get<A>(*first);\nuse(det);\n",
]
TEMPORARY = [
    "const auto & det = map.entries()[0].part;\nuse(det);\n",
    "const auto & det = make().part();\nuse(det);\n",
    "const auto & det = std::make_unique<A>()->part;\nuse(det);\n",
    "const auto & det = createNode()->part;\nuse(det);\n",
    "const auto & other = map.entries()[0]->part;\nauto & det = text().front();\nuse(det);\n",
]


@pytest.mark.parametrize("text", POINTED)
def test_a_reference_to_what_a_pointer_points_to(text: str) -> None:
    assert is_refuted("danglingTempReference", "Using reference to dangling temporary.", text.count("\n"), text)


@pytest.mark.parametrize("text", TEMPORARY)
def test_a_reference_to_a_temporary(text: str) -> None:
    assert not is_refuted("danglingTempReference", "Using reference to dangling temporary.", text.count("\n"), text)


UNUSED = "Unused variable: angles"
MEANT = [
    "void f() {\n  Angles angles; // This should compile\n}\n",
    "void f() {\n  // must still compile without arguments\n  Angles angles;\n}\n",
    "void f() {\n  Angles angles; /* left alone on purpose */\n}\n",
    "void f() {\n  // Intentionally not read.\n  Angles angles;\n}\n",
    "TEST(Angles, compiles) {\n  Angles angles;\n}\n",
    "TEST_F(Angles, Compiles)\n{\n  using A = Angles;\n  A first(1, 2);\n  std::vector<Angles> angles{};\n}\n",
    "TEST(Angles, one) { Angles angles; }\nint x() { return 1; }\n",
]
UNMEANT = [
    "void f() {\n  Angles angles;\n}\n",
    "void f() {\n  Angles angles; // unused\n}\n",
    "void f() {\n  // the angles to build the message\n  Angles angles;\n}\n",
    "void f() {\n  int a; // should compile\n  Angles angles;\n}\n",
    "void f() {\n  // compile the list of all angles\n  Angles angles;\n}\n",
    'void f() {\n  Angles angles; say("on purpose");\n}\n',
    "TEST(Angles, one) {\n  Angles angles;\n  EXPECT_EQ(1, 1);\n}\n",
    "TEST(Angles, one) {\n  Angles angles;\n  run();\n}\n",
    "TEST(Angles, one) {\n}\nvoid f() {\n  Angles angles;\n}\n",
    "TEST(Angles, one) {\n  int a = 3;\n  Angles angles;\n}\n",
]


def _declared(text: str) -> int:
    return 1 + next(i for i, each in enumerate(text.split("\n")) if "angles;" in each or "angles{}" in each)


@pytest.mark.parametrize("text", MEANT)
def test_a_declaration_that_is_meant(text: str) -> None:
    assert is_refuted("unusedVariable", UNUSED, _declared(text), text)


@pytest.mark.parametrize("text", UNMEANT)
def test_a_declaration_that_is_left_over(text: str) -> None:
    assert not is_refuted("unusedVariable", UNUSED, _declared(text), text)


@pytest.mark.parametrize("filler", ["a ", "a::", "* ", "a<", "a<b> ", "(", "TEST(", "/*", "a b;"])
def test_long_tests_take_no_time(filler: str) -> None:
    text = "TEST(A, b) {\n" + filler * 4000 + "\n  Angles angles;\n}\n"
    start = time.monotonic()
    is_refuted("unusedVariable", UNUSED, 3, text)
    assert time.monotonic() - start < 2


BOOL = "Boolean value assigned to pointer."


@pytest.mark.parametrize(
    "line",
    [
        "f_action act = action_db[a];",
        "act = this->table[i];",
        "act = &Arm::home;",
        "Handler handler = handlers.at_key;",
    ],
)
def test_a_pointer_that_gets_no_truth_value(line: str) -> None:
    assert is_refuted("assignBoolToPointer", BOOL, 3, f"void f()\n{{\n  {line}\n}}\n")


@pytest.mark.parametrize(
    "line",
    [
        "act = false;",
        "int * p = true;",
        "p = a == b;",
        "p = !q;",
        "p = is_on(a);",
        "p = a && b;",
        "p = a < b;",
        "p = not q;",
        "p == false;",
        "if (a == b) {",
        "",
    ],
)
def test_a_pointer_that_may_get_a_truth_value(line: str) -> None:
    assert not is_refuted("assignBoolToPointer", BOOL, 3, f"void f()\n{{\n  {line}\n}}\n")


AUTO = "Address of local auto-variable assigned to a function parameter."


@pytest.mark.parametrize(
    "declared",
    [
        "const std::array<std::uint32_t, 2> bytes{1, 2};",
        "std::array<int, 2> bytes;",
        "array<std::array<int, 3>, 2> bytes = {};",
    ],
)
def test_a_local_array_that_is_copied(declared: str) -> None:
    assert is_refuted(
        "autoVariables", AUTO, 3, f"void f(std::array<int, 2> * out) {{\n  {declared}\n  *out = bytes;\n}}\n"
    )


@pytest.mark.parametrize(
    ("declared", "use"),
    [
        ("int bytes[2];", "*out = bytes;"),
        ("std::array<int, 2> bytes;", "*out = &bytes;"),
        ("std::array<int, 2> bytes;", "*out = bytes.data();"),
        ("std::array<int, 2> others; int bytes[2];", "*out = bytes;"),
        ("std::vector<int> bytes;", "out = bytes;"),
        ("", "*out = bytes;"),
        ("std::array<int, 2> bytes;", ""),
    ],
)
def test_the_address_of_a_local_variable(declared: str, use: str) -> None:
    assert not is_refuted("autoVariables", AUTO, 3, f"void f(int ** out) {{\n  {declared}\n  {use}\n}}\n")


FIELD = "Non-local variable 'res.res' will use object that points to local variable 'buffer'."


@pytest.mark.parametrize(
    ("parameter", "expected"),
    [
        ("robotiq_ft_sensor::sensor_accessor::Response& res", True),
        ("demo::Get::Response &res", True),
        ("std::shared_ptr<demo::srv::Get::Response> res", False),
        ("const demo_msgs::msg::Text::SharedPtr res", True),
        ("demo_msgs::Text & res", True),
        ("Result & res", False),
        ("demo::Holder & res", False),
        ("demo::Get::Response & other", False),
    ],
)
def test_fields_of_messages_copy_what_they_are_given(parameter: str, expected: bool) -> None:
    text = f"bool go({parameter}) {{\n  char buffer[100];\n  res.res = buffer;\n}}\n"
    assert is_refuted("danglingLifetime", FIELD, 3, text) is expected
