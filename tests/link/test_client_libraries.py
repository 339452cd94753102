# SPDX-License-Identifier: Apache-2.0
"""Client libraries whose source, or a mock of whose classes, lies in the workspace: nodes that use them have the endpoints that they have without."""

from __future__ import annotations

import pytest
from follow_kit import CMAKE, CPP_HEAD, ROS2_CMAKE, cpp_files, follow, main, python_files, script

from haros_ci.model.architecture import Architecture

ROSCPP_HEADER = """
namespace ros {
class NodeHandle { public:
  template<class M> Publisher advertise(const std::string& topic, uint32_t size) {
    AdvertiseOptions ops; ops.init<M>(topic, size); return advertise(ops); }
  Publisher advertise(AdvertiseOptions& ops);
};
void init(int& argc, char** argv, const std::string& name);
}
"""
ROSCPP_SOURCE = '#include "ros/ros.h"\nnamespace ros { Publisher NodeHandle::advertise(AdvertiseOptions& ops) { return Publisher(); } }\n'
ROSCPP = {
    "roscpp/CMakeLists.txt": CMAKE.format("roscpp") + "add_library(roscpp src/ros.cpp)\n",
    "roscpp/include/ros/ros.h": ROSCPP_HEADER,
    "roscpp/src/ros.cpp": ROSCPP_SOURCE,
}
ROSPY = {
    "rospy/CMakeLists.txt": CMAKE.format("rospy") + "catkin_python_setup()\n",
    "rospy/setup.py": "from distutils.core import setup\nsetup(packages=['rospy'], package_dir={'': 'src'})\n",
    "rospy/src/rospy/__init__.py": "from rospy.topics import Publisher\ndef init_node(name):\n    pass\n",
    "rospy/src/rospy/topics.py": "class Publisher(object):\n    def __init__(self, name, data_class, queue_size=None):\n        self.impl = name\n",
}
RCLCPP = {
    "rclcpp/CMakeLists.txt": ROS2_CMAKE.format("rclcpp") + "ament_auto_add_library(rclcpp src/node.cpp)\n",
    "rclcpp/include/rclcpp/rclcpp.hpp": """
namespace rclcpp {
class Node { public:
  explicit Node(const std::string& name);
  template<class M> std::shared_ptr<Publisher<M>> create_publisher(const std::string& topic, const QoS& qos) {
    return rclcpp::create_publisher<M>(*this, topic, qos); }
};
}
""",
    "rclcpp/src/node.cpp": '#include "rclcpp/rclcpp.hpp"\nnamespace rclcpp { Node::Node(const std::string& name) {} }\n',
}
RCLCPP_NODE = {
    "p/CMakeLists.txt": ROS2_CMAKE.format("p") + "ament_auto_add_executable(n src/main.cpp)\nament_auto_package()\n",
    "p/src/main.cpp": """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class N : public rclcpp::Node { public:
  N() : Node("n") { pub_ = create_publisher<std_msgs::msg::String>("chatter", 1); }
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr pub_;
};
int main(int argc, char** argv) { rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>()); }
""",
}
CPP = cpp_files(main('ADV("chatter", 1);'))
PYTHON = python_files(script('PUB("chatter")\n'))
MOCK = "namespace ros {\nclass NodeHandle { public: template<class M> int advertise(const std::string& name, int size) { return 0; } };\n}\n"

#: ``ros_lib`` of rosserial, for the firmware of a microcontroller (rosserial_client/src/ros_lib/ros/subscriber.h).
ROS_LIB = """
namespace ros {
template<typename MsgT, typename ObjT = void> class Subscriber : public Subscriber_ { public:
  Subscriber(const char * topic_name, void (ObjT::*cb)(const MsgT&), ObjT* obj) { advertise(topic_name); }
};
template<typename MsgT> class Subscriber<MsgT, void> : public Subscriber_ { public:
  Subscriber(const char * topic_name, void (*cb)(const MsgT&)) { advertise(topic_name); }
};
class Publisher { public: Publisher(const char* topic_name, Msg* msg) { advertise(topic_name); } int publish(const Msg* msg); };
}
"""
MEMBERS = """class Talker { public:
  Talker() { sub_ = nh_.subscribe("in", 1, &Talker::heard, this); pub_ = nh_.advertise<std_msgs::String>("out", 1); }
  void heard(const std_msgs::String::ConstPtr& msg) {}
  ros::NodeHandle nh_;
  ros::Subscriber sub_;
  ros::Publisher pub_;
};
"""


def published(found: Architecture) -> set[tuple[str, str, str]]:
    """The configuration, name and type of what nodes of the package ``p`` publish."""
    nodes = [(one.name, node) for one in found.configurations if one.name.startswith("p/") for node in one.nodes]
    return {
        (name, end.name, str(end.type))
        for name, node in nodes
        for end in node.endpoints
        if end.kind == "publishers" and not end.implicit
    }


@pytest.mark.parametrize(
    "node, library, ros",
    [(CPP, ROSCPP, 1), (PYTHON, ROSPY, 1), (RCLCPP_NODE, RCLCPP, 2)],
    ids=["roscpp", "rospy", "rclcpp"],
)
def test_the_source_of_a_client_library_beside_a_node_changes_nothing(
    node: dict[str, str], library: dict[str, str], ros: int
) -> None:
    alone = published(follow(node, ros))
    assert len(alone) == 1
    assert published(follow(node | library, ros)) == alone


def test_a_mock_of_a_library_class_in_a_test_of_another_package_is_not_the_class() -> None:
    mock = {
        "q/CMakeLists.txt": CMAKE.format("q") + "catkin_add_gtest(q_test test/mock.cpp)\n",
        "q/test/mock.cpp": MOCK,
    }
    assert published(follow(CPP | mock, 1)) == published(follow(CPP, 1))


def test_a_mock_of_a_library_class_in_a_test_of_the_same_package_is_not_the_class() -> None:
    files = CPP | {"p/test/mock.cpp": MOCK}
    files["p/CMakeLists.txt"] += "catkin_add_gtest(p_test test/mock.cpp)\n"
    assert published(follow(files, 1)) == published(follow(CPP, 1))


@pytest.mark.parametrize(
    "place",
    [
        "firmware/ros_lib/ros/subscriber.h",
        "p/arduino/libraries/ros_lib/ros/subscriber.h",
        "p/src/ros_lib/ros/subscriber.h",
        "p/include/p/mock.h",
    ],
)
def test_a_header_that_the_program_does_not_include_has_no_class_of_a_library(place: str) -> None:
    files = cpp_files(main("Talker talker;", MEMBERS))
    alone, beside = (follow(found, 1).configurations[0].nodes[0] for found in (files, files | {place: ROS_LIB}))
    assert {end.name for end in beside.endpoints if not end.implicit} >= {"/in", "/out"}
    assert beside.endpoints == alone.endpoints
    assert beside.unknowns == alone.unknowns


def test_a_header_that_a_header_of_the_program_includes_has_it() -> None:
    files = cpp_files('#include "a.h"\n' + main('ADV("chatter", 1);'), a__h='#include "mock.h"\n', mock__h=MOCK)
    assert published(follow(files, 1)) == set()


def test_a_mock_that_the_program_includes_is_the_class() -> None:
    files = cpp_files('#include "mock.h"\n' + main('ADV("chatter", 1);'), mock__h=MOCK)
    assert published(follow(files, 1)) == set()


def test_a_mock_in_the_file_itself_is_the_class() -> None:
    assert published(follow(cpp_files(main('ADV("chatter", 1);', MOCK)), 1)) == set()


def test_a_class_of_the_workspace_that_no_library_has_is_found_in_another_file() -> None:
    """The class is only in a source file that the executable links: as far as its name goes, it is the one."""
    files = cpp_files(
        main("make();", "void make();"),
        other__cpp=CPP_HEAD
        + 'class Own { public: Own() { ros::NodeHandle nh; pub = nh.advertise<std_msgs::String>("own", 1); } ros::Publisher pub; };\nvoid make() { static Own own; }\n',
    )
    assert {name for _, name, _ in published(follow(files, 1))} == {"/own"}


def test_a_program_of_a_client_library_is_followed() -> None:
    program = (
        CPP_HEAD
        + 'int main(int argc, char** argv) { ros::init(argc, argv, "own"); ros::NodeHandle nh; ros::Publisher p = nh.advertise<std_msgs::String>("own", 1); }\n'
    )
    library = ROSCPP | {"roscpp/src/tool.cpp": program}
    library["roscpp/CMakeLists.txt"] += "add_executable(tool src/tool.cpp)\n"
    found = follow(library, 1)
    assert [(one.name, end.name) for one in found.configurations for node in one.nodes for end in node.endpoints] == [
        ("roscpp/tool", "/own")
    ]


TF = {
    "tf/CMakeLists.txt": CMAKE.format("tf") + "catkin_python_setup()\n",
    "tf/setup.py": "from distutils.core import setup\nsetup(packages=['tf'], package_dir={'': 'src'})\n",
    "tf/src/tf/__init__.py": "from tf.broadcaster import TransformBroadcaster\n",
    "tf/src/tf/broadcaster.py": "class TransformBroadcaster:\n    def __init__(self, queue_size=100):\n        self.pub = None\n",
}


def test_what_the_package_of_a_described_module_imports_is_of_the_library_too() -> None:
    node = python_files(script("import tf\nbroadcaster = tf.TransformBroadcaster()\n"))
    alone = published(follow(node, 1))
    assert {name for _, name, _ in alone} == {"/tf"}
    assert published(follow(node | TF, 1)) == alone


def test_a_node_of_a_described_package_is_followed() -> None:
    program = script('PUB("own")\n')
    files = TF | {"tf/scripts/tool.py": program}
    files["tf/CMakeLists.txt"] += "catkin_install_python(PROGRAMS scripts/tool.py)\n"
    found = follow(files, 1)
    assert [end.name for one in found.configurations for node in one.nodes for end in node.endpoints] == ["/own"]


def test_a_class_of_a_described_package_that_no_row_describes_is_the_workspace_s() -> None:
    library = {
        "image_transport/CMakeLists.txt": CMAKE.format("image_transport") + "add_library(extra src/extra.cpp)\n",
        "image_transport/include/image_transport/extra.h": CPP_HEAD
        + 'namespace image_transport { class Extra { public: Extra() { ros::NodeHandle nh; pub = nh.advertise<std_msgs::String>("extra", 1); } ros::Publisher pub; }; }\n',
    }
    node = cpp_files(main("image_transport::Extra extra;", "#include <image_transport/extra.h>"))
    assert {name for _, name, _ in published(follow(node | library, 1))} == {"/extra"}


def test_nodelets_are_loaded_where_the_loader_s_source_is_in_the_workspace() -> None:
    nodelet = {
        "p/package.xml": '<package><name>p</name><export><nodelet plugin="${prefix}/n.xml"/></export></package>',
        "p/n.xml": '<library path="lib/libn"><class name="p/N" type="p::N" base_class_type="nodelet::Nodelet"/></library>',
        "p/CMakeLists.txt": CMAKE.format("p") + "add_library(n src/n.cpp)\n",
        "p/src/n.cpp": CPP_HEAD
        + '#include <nodelet/nodelet.h>\nnamespace p { class N : public nodelet::Nodelet { void onInit() { pub = getNodeHandle().advertise<std_msgs::String>("a", 1); } ros::Publisher pub; }; }\n',
        "p/launch/l.launch": '<launch><node pkg="nodelet" type="nodelet" name="me" args="load p/N m"/></launch>',
    }
    loader = {
        "nodelet/CMakeLists.txt": CMAKE.format("nodelet") + "add_executable(nodelet src/nodelet.cpp)\n",
        "nodelet/include/nodelet/nodelet.h": "namespace nodelet { class Nodelet { public: ros::NodeHandle& getNodeHandle() const { return *nh_; } virtual void onInit() = 0; NodeHandlePtr nh_; }; }\n",
        "nodelet/src/nodelet.cpp": CPP_HEAD + 'int main(int argc, char** argv) { ros::init(argc, argv, "nodelet"); }\n',
    }
    alone = published(follow(nodelet, 1))
    assert {name for _, name, _ in alone} == {"/a"}
    assert published(follow(nodelet | loader, 1)) == alone
