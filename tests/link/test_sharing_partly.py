# SPDX-License-Identifier: Apache-2.0
"""What of a name or parameter counts for what a program makes, and what does not: followed once where nothing does."""

from __future__ import annotations

import pytest
from follow_kit import ros2_files
from test_sharing import COUNT, COUNTS, READ, TEXTS, TWO, follows, program, started

FLAGS = ("name='one', parameters=[{'flag': True}]", "name='two', parameters=[{'flag': False}]")
FLAG = 'flag_ = declare_parameter<bool>("flag", true);\n'
MEMBERS = """
  bool flag_;
  std::string text_;
  bool flag() {
    return flag_;
  }
  void declare_param(const std::string & name, int value) {
    declare_parameter(name, 1);
  }
"""


@pytest.mark.parametrize(
    ("body", "nodes"),
    [
        # A text of which a part is not known has marks for what is given of it.
        ('create_publisher<String>(std::string(get_namespace()) + "/" + strange(), 1);', TWO),
        ('create_publisher<String>(std::string(get_name()) + "/" + strange() + "/x", 1);', TWO),
        ('text_ = get_name() + strange(); create_publisher<String>("/" + text_, 1);', TWO),
        (READ + 'create_publisher<String>(strange() + text + "/x", 1);', TEXTS),
        ("create_publisher<String>(get_node_topics_interface()->resolve_topic_name(strange()), 1);", TWO),
        ('const auto s = get_name() + strange(); create_publisher<String>(flag_ ? s : s, 1);', TWO),
        # Braces, the beginning that is empty, and numbers of wrappers.
        ("std::string s{get_name()}; create_publisher<String>(s, 1);", TWO),
        (COUNT + 'const int other{count}; create_publisher<String>("x", 1);', COUNTS),
        ('const std::string s = get_namespace(); create_publisher<String>(s.substr(0, s.rfind("/")) + "/x", 1);',
         ("name='one', namespace='left'", "name='two', namespace='right'")),
        (COUNT + 'declare_param("other", count);', COUNTS),
        # The type of a parameter, and a value that a function returns.
        (COUNT + 'if (get_parameter("count").get_type() == rclcpp::ParameterType::PARAMETER_INTEGER) '
         '{ create_publisher<String>("x", 1); }', COUNTS),
        (FLAG + 'flag(); create_publisher<String>("x", 1);', FLAGS),
    ],
)  # fmt: skip
def test_followed_once_for_a_part(body: str, nodes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    assert follows(ros2_files(program(body, MEMBERS), started(*nodes)), monkeypatch) == 1


@pytest.mark.parametrize(
    ("body", "nodes"),
    [
        ('const auto s = get_name() + strange(); if (s.find("one") == 0) { create_publisher<String>("x", 1); }', TWO),
        ("const auto s = get_name() + strange(); create_publisher<String>(s.substr(1), 1);", TWO),
        ('const auto s = get_name() + strange(); if (s == "one") { create_publisher<String>("x", 1); }', TWO),
        ('const auto s = strange() + get_name(); create_publisher<String>(flag_ ? s : "x", 1);', TWO),
        ('const auto s = get_name() + strange(); create_publisher<String>(flag_ ? s : "one" + strange(), 1);', TWO),
        ('const auto s = get_namespace() + strange(); auto other = create_sub_node(s); other->create_publisher<String>("x", 1);',
         ("namespace='/'", "name='n', namespace='/r'")),
        ('declare_parameter(std::string(get_name()) + strange(), 1);', TWO),
        (READ + 'declare_parameter("x", text + strange());', TEXTS),
        (READ + 'RCLCPP_INFO(get_logger(), "%s", (text + strange()).c_str()); create_publisher<String>("x", 1);', TEXTS),
        (COUNT + 'declare_param("other" + std::to_string(count), count);', COUNTS),
        (COUNT + 'create_publisher<String>("x", int{count});', COUNTS),
        (COUNT + 'const double other = count; create_publisher<String>("x" + std::to_string(other), 1);', COUNTS),
        (FLAG + 'if (flag()) { create_publisher<String>("x", 1); }', FLAGS),
        (FLAG + 'const int n = flag(); create_publisher<String>("x", n);', FLAGS),
        ('const std::string s = get_namespace(); create_publisher<String>(s.substr(0, s.rfind("/")) + "/x", 1);', TWO),
        ('const std::string s = get_name(); create_publisher<String>("/x" + s.substr(0, 0), 1);', TWO),
    ],
)  # fmt: skip
def test_as_if_followed_for_each(body: str, nodes: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """How many times is not said; ``follows`` compares the model with that of following each node by itself."""
    assert follows(ros2_files(program(body, MEMBERS), started(*nodes)), monkeypatch)
