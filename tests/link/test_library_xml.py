# SPDX-License-Identifier: Apache-2.0
"""ROS 2 C++: XML files that programs read with tinyxml2, directories that they list, parts of paths."""

from __future__ import annotations

import pytest
from follow_kit import explicit, ros2_main

XML = """<robot kind="arm"><joint topic="first"/><other/><joint topic="second">words</joint></robot>"""
READ = """
  auto node = std::make_shared<rclcpp::Node>("host");
  tinyxml2::XMLDocument doc;
  if (doc.LoadFile((%s).c_str()) != tinyxml2::XML_SUCCESS) { return 1; }
  auto root = doc.RootElement();
  auto make = [&](const std::string & topic) { node->create_publisher<std_msgs::msg::String>(topic, 1); };
"""
SHARE = 'ament_index_cpp::get_package_share_directory("p") + "/src/r.xml"'


def made(body: str, path: str = SHARE, xml: str = XML) -> list[str]:
    found = ros2_main(READ % path + body, r__xml=xml)
    return sorted(end.name for end in explicit(found.nodes[0]))


@pytest.mark.parametrize(
    ("body", "names"),
    (
        ('make(root->Attribute("kind"));', ["/arm"]),
        ("make(root->Name());", ["/robot"]),
        ('make(root->FirstChildElement()->Attribute("topic"));', ["/first"]),
        ('make(root->FirstChildElement("joint")->NextSiblingElement("joint")->GetText());', ["/words"]),
        ('make(root->FirstChildElement("joint")->NextSiblingElement()->Name());', ["/other"]),
        ('make(doc.FirstChildElement("robot")->Name());', ["/robot"]),
        ('std::string t("none"); if (auto k = root->Attribute("no")) { t = k; } make(t);', ["/none"]),
        ('std::string t("none"); if (root->FirstChildElement("no")) { t = "there"; } make(t);', ["/none"]),
        (
            'for (auto j = root->FirstChildElement("joint"); j; j = j->NextSiblingElement("joint")) '
            '{ make(j->Attribute("topic")); }',
            ["/first", "/second"],
        ),
        ("make(root->Attribute(argv[1]));", ["/?"]),
    ),
)
def test_elements(body: str, names: list[str]) -> None:
    assert made(body) == names


@pytest.mark.parametrize(
    ("path", "xml"),
    (
        ("std::string(argv[1])", XML),
        ('ament_index_cpp::get_package_share_directory("p") + "/src/other.xml"', XML),
        ('std::string("/etc/r.xml")', XML),
        (SHARE, "<robot kind="),
    ),
)
def test_files_that_are_not_known(path: str, xml: str) -> None:
    assert made('make(root->Attribute("kind"));', path, xml) == ["/?"]


def test_directories() -> None:
    body = """
  auto node = std::make_shared<rclcpp::Node>("host");
  namespace fs = std::filesystem;
  for (const auto & entry : fs::directory_iterator(ament_index_cpp::get_package_share_directory("p") + "/src/")) {
    if (entry.path().extension() != ".xml" || entry.path().string().ends_with("no.xml")) { continue; }
    node->create_publisher<std_msgs::msg::String>(entry.path().stem().string(), 1);
  }
"""
    more = {"one__xml": "<a/>", "two__xml": "<a/>", "no__xml": "<a/>", "three__txt": "a"}
    found = ros2_main(body, **more)
    assert sorted(end.name for end in explicit(found.nodes[0]) if not end.unknowns) == ["/one", "/two"]
    elsewhere = body.replace('get_package_share_directory("p")', 'get_package_share_directory("q")')
    assert [end.name for end in explicit(ros2_main(elsewhere, **more).nodes[0])] == ["/?"]
