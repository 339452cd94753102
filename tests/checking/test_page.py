# SPDX-License-Identifier: Apache-2.0
"""A page's examples as workspaces, and the lines that they mark."""

from __future__ import annotations

from haros_ci.checking.page import filled, read_page

TEXT = """# odd-topic

## What it finds

```python
# ## Bad
```

## Bad

```python title="a.py"
one  # expect: odd-topic
two  # expect: other-check
```

### Two files

```cpp title="b.cpp"
// expect-next: odd-topic
three();
```

```xml title="launch/b.launch.xml"
<launch/>
```

## Good

```python title="a.py"
one
```

```text
no file
```
"""


def test_examples_and_marks() -> None:
    page = read_page(TEXT)
    assert (page.title, page.sections) == ("odd-topic", ("What it finds", "Bad", "Good"))
    first, second, good = page.examples
    assert (first.title, first.is_bad, first.expected) == ("Bad", True, (("a.py", 1),))
    assert (second.title, second.is_bad, second.expected) == ("Two files", True, (("b.cpp", 2),))
    assert {"b.cpp", "launch/b.launch.xml"} < set(second.files)
    assert (good.title, good.is_bad, good.expected) == ("Good", False, ())


def test_a_package_is_filled_in() -> None:
    made = filled({"talker.cpp": "", "launch/a.launch.py": "", "listener.py": "import rclpy"})
    assert "<buildtool_depend>ament_cmake</buildtool_depend>" in made["package.xml"]
    cmake = made["CMakeLists.txt"]
    assert "install(TARGETS talker DESTINATION lib/demo)" in cmake
    assert "install(PROGRAMS listener.py DESTINATION lib/demo)" in cmake
    assert "install(DIRECTORY launch DESTINATION share/demo)" in cmake
    assert "a.launch.py" not in cmake


def test_ros_1_is_known_by_what_it_uses() -> None:
    for files in ({"a.launch": "<launch/>"}, {"a.py": "import rospy"}, {"a.cpp": "#include <ros/ros.h>"}):
        assert "<buildtool_depend>catkin</buildtool_depend>" in filled(files)["package.xml"]


def test_a_package_of_its_own_is_left_alone() -> None:
    files = {"src/robot/package.xml": "<package/>", "src/robot/a.py": ""}
    assert filled(files) == files


def test_odd_pages_have_no_examples() -> None:
    assert read_page("").examples == ()
    assert read_page('# t\n## Bad\n```python title="a.py"\nnever closed').examples == ()


CHANGE = """# odd-change

## Bad

### A field removed

```text title="msg/Pose.msg"
float64 x  # expect: odd-change
```

```text title="base/msg/Pose.msg"
float64 x  # expect: odd-change
float64 y
```

```text title="msg/New.msg"
bool is_new
```

```text title="base/msg/New.msg"
```

```text title="base/msg/Old.msg"
bool is_old
```

```text title="msg/Same.msg"
bool is_same
```

## Good

```text title="msg/Pose.msg"
float64 x
```
"""


def test_an_example_of_a_change() -> None:
    bad, good = read_page(CHANGE).examples
    assert bad.base is not None
    of_package = {"package.xml", "CMakeLists.txt"}
    assert set(bad.files) == {"msg/Pose.msg", "msg/New.msg", "msg/Same.msg"} | of_package
    assert set(bad.base) == {"msg/Pose.msg", "msg/Old.msg", "msg/Same.msg"} | of_package
    assert bad.base["msg/Pose.msg"].endswith("float64 y\n")
    assert bad.base["msg/Same.msg"] == bad.files["msg/Same.msg"]
    assert bad.expected == (("msg/Pose.msg", 1),), "what the base marks is not expected"
    assert good.base is None


def test_a_base_with_a_manifest_is_as_it_is() -> None:
    head = '## Bad\n\n```xml title="package.xml"\n<package/>\n```\n'
    (example,) = read_page(f'{head}\n```cpp title="base/a.cpp"\nint a;\n```\n').examples
    assert example.base == {"package.xml": "<package/>\n", "a.cpp": "int a;\n"}


def test_a_file_of_an_example_may_be_executable() -> None:
    text = '# t\n## Bad\n```python title="a.py" executable\npass\n```\n```python title="b.py"\npass\n```\n'
    (example,) = read_page(text).examples
    assert set(example.files) >= {"a.py", "b.py"}
    assert example.executables == {"a.py"}
