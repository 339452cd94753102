# SPDX-License-Identifier: Apache-2.0
"""A bad and a good example for the rules that are met most: what haros-ci explain shows of tools that have none of their own."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Pair:
    """Two pieces of code in one *language*: with the defect, and without it."""

    bad: str
    good: str
    language: str = "python"


_CPP = "cpp"

#: By rule id; rules of several tools that find the same defect share a pair.
PAIRS: dict[tuple[str, ...], Pair] = {
    ("unused-import", "F401"): Pair("import os  # nothing uses it\nimport rospy\n\nrospy.init_node('lamp')", "import rospy\n\nrospy.init_node('lamp')"),
    ("unused-variable", "F841"): Pair("def reading(message):\n    scaled = message.data * 2\n    return message.data", "def reading(message):\n    scaled = message.data * 2\n    return scaled"),
    ("undefined-variable", "F821"): Pair("def stop(publisher):\n    publisher.publish(mesage)", "def stop(publisher, message):\n    publisher.publish(message)"),
    ("dangerous-default-value", "B006"): Pair("def add(item, queue=[]):  # one list for all calls\n    queue.append(item)", "def add(item, queue=None):\n    queue = [] if queue is None else queue\n    queue.append(item)"),
    ("bare-except", "E722"): Pair("try:\n    port.open()\nexcept:  # Ctrl-C ends up here, too\n    pass", "try:\n    port.open()\nexcept SerialException as err:\n    node.get_logger().error(str(err))"),
    ("broad-exception-caught", "BLE001"): Pair("try:\n    buffer.lookup_transform(a, b, now)\nexcept Exception:\n    return", "try:\n    buffer.lookup_transform(a, b, now)\nexcept TransformException:\n    return"),
    ("unspecified-encoding",): Pair("with open(path) as stream:", "with open(path, encoding='utf-8') as stream:"),
    ("redefined-outer-name",): Pair("rate = 10\n\ndef spin(rate):\n    return rate", "RATE = 10\n\ndef spin(rate):\n    return rate"),
    ("attribute-defined-outside-init",): Pair("class Lamp:\n    def on(self):\n        self.state = True", "class Lamp:\n    def __init__(self):\n        self.state = False\n\n    def on(self):\n        self.state = True"),
    ("singleton-comparison", "E711"): Pair("if goal == None:", "if goal is None:"),
    ("E712",): Pair("if enabled == True:", "if enabled:"),
    ("E713",): Pair("if not name in joints:", "if name not in joints:"),
    ("F541", "f-string-without-interpolation"): Pair("log.info(f'ready')", "log.info('ready')"),
    ("line-too-long", "E501"): Pair("self.pub = self.create_publisher(OccupancyGrid, 'map', QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))", "latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)\nself.pub = self.create_publisher(OccupancyGrid, 'map', latched)"),
    ("unused-argument",): Pair("def on_timer(self, event):\n    self.publish()", "def on_timer(self, _event):\n    self.publish()"),
    ("no-else-return",): Pair("if ready:\n    return 1\nelse:\n    return 0", "if ready:\n    return 1\nreturn 0"),
    ("consider-using-f-string",): Pair("'%s/odom' % name", "f'{name}/odom'"),
    ("wildcard-import", "F403"): Pair("from std_msgs.msg import *", "from std_msgs.msg import Bool, String"),
    ("used-before-assignment",): Pair("def stop(publisher):\n    publisher.publish(speed)\n    speed = 0", "def stop(publisher):\n    speed = 0\n    publisher.publish(speed)"),
    ("possibly-used-before-assignment",): Pair("if sim:\n    clock = SimClock()\nclock.start()", "clock = SimClock() if sim else Clock()\nclock.start()"),
    ("no-self-argument",): Pair("class Lamp:\n    def on(state):\n        ...", "class Lamp:\n    def on(self, state):\n        ..."),
    ("subprocess-run-check", "PLW1510"): Pair("subprocess.run(['rosbag', 'record', '-a'])", "subprocess.run(['rosbag', 'record', '-a'], check=True)"),
    ("runtime/explicit", "noExplicitConstructor", "google-explicit-constructor"): Pair("class Lamp {\n public:\n  Lamp(int pin);  // f(3) makes a Lamp of 3\n};", "class Lamp {\n public:\n  explicit Lamp(int pin);\n};", _CPP),
    ("build/namespaces",): Pair("using namespace std;  // in a header: for all that include it", "std::string name;", _CPP),
    ("build/include_what_you_use",): Pair("std::vector<double> ranges;  // <vector> comes by chance", "#include <vector>\n\nstd::vector<double> ranges;", _CPP),
    ("build/header_guard",): Pair("// lamp.hpp, without a guard\nclass Lamp;", "#ifndef ROBOT__LAMP_HPP_\n#define ROBOT__LAMP_HPP_\nclass Lamp;\n#endif  // ROBOT__LAMP_HPP_", _CPP),
    ("runtime/int",): Pair("long counter;  // 32 bits here, 64 there", "std::int64_t counter;", _CPP),
    ("runtime/printf",): Pair("char text[8];\nsprintf(text, \"%s\", name);", "char text[8];\nsnprintf(text, sizeof(text), \"%s\", name);", _CPP),
    ("runtime/references",): Pair("void read(Scan & scan);", "void read(Scan * scan);", _CPP),
    ("cstyleCast",): Pair("char * text = (char *)name;  // name is const", "const char * text = name;", _CPP),
    ("readability/casting",): Pair("auto ratio = (double)ticks / 1024;", "auto ratio = static_cast<double>(ticks) / 1024;", _CPP),
    ("resourceLeak",): Pair("FILE * file = fopen(path, \"r\");\nif (fgetc(file) == '#') {\n  return false;  // never closed\n}\nfclose(file);", "std::ifstream file(path);\nif (file.get() == '#') {\n  return false;  // closed by the destructor\n}", _CPP),
    ("memleak", "clang-analyzer-cplusplus.NewDeleteLeaks"): Pair("auto * buffer = new char[size];\nif (size < 4) {\n  return;\n}\ndelete[] buffer;", "std::vector<char> buffer(size);\nif (size < 4) {\n  return;\n}", _CPP),
    ("uninitvar",): Pair("int speed;\nif (enabled) {\n  speed = 3;\n}\ndrive(speed);", "int speed = 0;\nif (enabled) {\n  speed = 3;\n}\ndrive(speed);", _CPP),
    ("legacyUninitvar",): Pair("int count;\ncount += 1;\nshow(count);", "int count = 0;\ncount += 1;\nshow(count);", _CPP),
    ("clang-analyzer-core.uninitialized.Assign",): Pair("int flags;\nflags |= 0x04;", "int flags = 0;\nflags |= 0x04;", _CPP),
    ("uninitMemberVar",): Pair("class Lamp {\n public:\n  Lamp() {}\n  bool on_;\n};", "class Lamp {\n public:\n  Lamp() {}\n  bool on_ = false;\n};", _CPP),
    ("nullPointer",): Pair("Goal * goal = is_set ? &next : nullptr;\nlog(goal->text);", "Goal * goal = is_set ? &next : nullptr;\nif (goal) {\n  log(goal->text);\n}", _CPP),
    ("nullPointerRedundantCheck", "clang-analyzer-core.NullDereference"): Pair("Goal * goal = find(id);\nif (!goal) {\n  log(goal->text);\n}", "Goal * goal = find(id);\nif (!goal) {\n  log(\"no goal\");\n  return;\n}", _CPP),
    ("arrayIndexOutOfBounds",): Pair("double joints[6];\njoints[6] = 0.0;", "std::array<double, 6> joints{};\njoints.at(5) = 0.0;", _CPP),
    ("variableScope",): Pair("double share;\nif (cells > 0) {\n  share = 1.0 / cells;\n  use(share);\n}", "if (cells > 0) {\n  const double share = 1.0 / cells;\n  use(share);\n}", _CPP),
    ("passedByValue", "performance-unnecessary-value-param"): Pair("void show(std::string text) {\n  print(text.size());\n}", "void show(const std::string & text) {\n  print(text.size());\n}", _CPP),
    ("incorrectLogicOperator",): Pair("if (cell < 0 && cell > 100) {  // never", "if (cell < 0 || cell > 100) {", _CPP),
    ("bugprone-use-after-move", "accessMoved"): Pair("publisher->publish(std::move(message));\nlog(message->data);", "log(message->data);\npublisher->publish(std::move(message));", _CPP),
    ("performance-for-range-copy", "iterateByValue"): Pair("for (const Pose pose : path.poses) {", "for (const Pose & pose : path.poses) {", _CPP),
    ("modernize-use-override", "missingOverride"): Pair("class Arm : public Part {\n  virtual void stop();\n};", "class Arm : public Part {\n  void stop() override;\n};", _CPP),
    ("unusedVariable",): Pair("int count;  // left over\nreset();", "reset();", _CPP),
    ("unreadVariable",): Pair("int count = size();  // nothing reads it\nreset();", "reset();", _CPP),
    ("SC2086",): Pair("rm -r $WORKSPACE/build", "rm -r \"$WORKSPACE/build\"", "sh"),
    ("SC2164",): Pair("cd build\nrm -rf *", "cd build || exit 1\nrm -rf *", "sh"),
    ("missingReturn",): Pair("int gear(int speed) {\n  if (speed > 3) {\n    return 2;\n  }\n}", "int gear(int speed) {\n  return speed > 3 ? 2 : 1;\n}", _CPP),
    ("unassignedVariable",): Pair("double limit;\nreturn speed * limit;", "double limit = 0.5;\nreturn speed * limit;", _CPP),
    ("selfAssignment",): Pair("void set(double speed) { speed = speed; }", "void set(double speed) { speed_ = speed; }", _CPP),
    ("badBitmaskCheck",): Pair("if (status | 0x04) {  // always", "if (status & 0x04) {", _CPP),
    ("multiCondition",): Pair("if (flags & 0x07) {\n  warn();\n} else if (flags & 0x03) {  // never\n  stop();\n}", "if (flags & 0x03) {\n  stop();\n} else if (flags & 0x07) {\n  warn();\n}", _CPP),
    ("exceptRethrowCopy",): Pair("catch (const std::exception & err) {\n  close();\n  throw err;\n}", "catch (const std::exception &) {\n  close();\n  throw;\n}", _CPP),
    ("memleakOnRealloc",): Pair("data = (char *)realloc(data, size);", "char * larger = static_cast<char *>(realloc(data, size));\nif (larger) {\n  data = larger;\n}", _CPP),
    ("constStatement",): Pair("controller.stop;", "controller.stop();", _CPP),
    ("assertWithSideEffect",): Pair("assert(port.open());  // not opened with NDEBUG", "[[maybe_unused]] const bool is_open = port.open();\nassert(is_open);", _CPP),
    ("mismatchAllocDealloc",): Pair("auto * scan = new float[360];\ndelete scan;", "std::vector<float> scan(360);", _CPP),
    ("catchExceptionByValue",): Pair("catch (std::exception err) {", "catch (const std::exception & err) {", _CPP),
    ("unsignedLessThanZero",): Pair("unsigned left = total - used;\nif (left < 0) {  // never", "if (used > total) {", _CPP),
    ("eraseDereference",): Pair("std::set<int>::iterator it = goals.begin();\ngoals.erase(it);\nshow(*it);", "std::set<int>::iterator it = goals.begin();\nshow(*it);\nit = goals.erase(it);", _CPP),
    ("unusedScopedObject",): Pair("std::lock_guard<std::mutex>{mutex_};  // unlocked at once\ncount_++;", "std::lock_guard<std::mutex> lock{mutex_};\ncount_++;", _CPP),
    ("stlcstr",): Pair("const char * name() {\n  std::string text = \"arm\";\n  return text.c_str();\n}", "std::string name() {\n  return \"arm\";\n}", _CPP),
    ("pointless-statement",): Pair("self.ready == True", "self.ready = True"),
    ("trailing-comma-tuple",): Pair("rate = 10,", "rate = 10"),
    ("missing-kwoa",): Pair("def move(speed, *, frame):\n    ...\n\nmove(1.0)", "def move(speed, *, frame):\n    ...\n\nmove(1.0, frame='odom')"),
    ("duplicate-key",): Pair("limits = {'elbow': 1.5, 'elbow': 2.0}", "limits = {'elbow': 1.5, 'wrist': 2.0}"),
    ("not-callable",): Pair("rate = 10\nrate().sleep()", "rate = node.create_rate(10)\nrate.sleep()"),
    ("implicit-str-concat",): Pair("joints = ['elbow' 'wrist']  # one name", "joints = ['elbow', 'wrist']"),
    ("comparison-with-itself",): Pair("if goal == goal:", "if goal == last_goal:"),
    ("too-few-format-args",): Pair("print('%s at %s' % (name,))", "print('%s at %s' % (name, pose))"),
    ("too-many-format-args",): Pair("print('%s' % (name, pose))", "print('%s at %s' % (name, pose))"),
}  # fmt: skip

BY_RULE: dict[str, Pair] = {rule: pair for rules, pair in PAIRS.items() for rule in rules}
