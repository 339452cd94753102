# SPDX-License-Identifier: Apache-2.0
"""ROS 2: controllers and hardware components of the workspace, loaded by a controller manager or by themselves."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from follow_kit import ROS2_CMAKE, ROS2_HEAD, Nothing, explicit, workspace

from haros_ci.analysis.architecture import architecture
from haros_ci.config.settings import Settings
from haros_ci.model.architecture import Architecture, Configuration, Endpoint, Node

HEAD = ROS2_HEAD + (
    "#include <controller_interface/controller_interface.hpp>\n#include <realtime_tools/realtime_publisher.hpp>\n"
    "#include <std_srvs/srv/trigger.hpp>\nusing controller_interface::CallbackReturn;\n"
)
CONTROLLER = "controller_interface::ControllerInterface"
CHAINABLE = "controller_interface::ChainableControllerInterface"
#: The methods of a controller, with the code that stands in each.
METHODS = {
    "on_init": "CallbackReturn on_init() override {{ {} return CallbackReturn::SUCCESS; }}",
    "on_configure": "CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {{ {} return CallbackReturn::SUCCESS; }}",
    "on_activate": "CallbackReturn on_activate(const rclcpp_lifecycle::State &) override {{ {} return CallbackReturn::SUCCESS; }}",
    "update": "controller_interface::return_type update(const rclcpp::Time &, const rclcpp::Duration &) override {{ {} }}",
}
REST = (
    "controller_interface::InterfaceConfiguration command_interface_configuration() const override { return {}; }\n"
    "controller_interface::InterfaceConfiguration state_interface_configuration() const override { return {}; }\n"
)
FILE = '<param from="$(find-pkg-share arm)/config/c.yaml"/>'
MANAGER = f'<node pkg="controller_manager" exec="ros2_control_node">{FILE}</node>'
SPAWNER = '<node pkg="controller_manager" exec="spawner" args="{}"/>'
TYPED = "controller_manager:\n  ros__parameters:\n    lift: {type: arm/Lift}\n"


def controller(members: str = "", base: str = CONTROLLER, **bodies: str) -> str:
    """The class ``arm::Lift`` with this code in its methods."""
    methods = "\n".join(METHODS[name].format(code) for name, code in bodies.items())
    return f"namespace arm {{\nclass Lift : public {base} {{\npublic:\n{methods}\n{REST}private:\n{members}\nint a_;\n}};\n}}\n"


def followed(
    code: str,
    launch: str = "",
    config: str = TYPED,
    base: str = CONTROLLER,
    described: str = '<class name="arm/Lift" type="arm::Lift" base_class_type="{}"/>',
    more: Mapping[str, str] | None = None,
) -> Architecture:
    """The architecture of the package ``arm`` with that controller, and perhaps a launch file with this in it."""
    cmake = ROS2_CMAKE.format("arm") + (
        "ament_auto_add_library(arm_lib SHARED src/lift.cpp)\n"
        "pluginlib_export_plugin_description_file(controller_interface plugins.xml)\n"
        "ament_auto_package(INSTALL_TO_SHARE launch config)\n"
    )
    texts = {
        "arm/CMakeLists.txt": cmake,
        "arm/plugins.xml": f'<library path="arm_lib">{described.format(base)}</library>',
        "arm/src/lift.cpp": HEAD + code,
        "arm/config/c.yaml": config,
        **(more or {}),
    }
    if launch:
        texts["arm/launch/l.launch.xml"] = f"<launch>{launch}</launch>"
    return architecture(
        workspace(texts, 2), Settings(root=Path("/nowhere")), Nothing(), environment={}, known_nodes=True
    )


def alone(code: str, base: str = CONTROLLER) -> Configuration:
    """The only configuration, in which nothing loads the controller."""
    (found,) = followed(code, base=base).configurations
    return found


def lift(found: Configuration) -> Node:
    (node,) = (node for node in found.nodes if node.type == "arm/Lift")
    return node


def names(node: Node, kind: str = "publishers") -> list[str]:
    return sorted(end.name for end in explicit(node, kind))


def implicit(node: Node, kind: str) -> set[str]:
    return {end.name for end in node.endpoints if end.kind == kind and end.implicit}


PUB = 'get_node()->create_publisher<String>("{}", rclcpp::SystemDefaultsQoS());'
SUB = 'get_node()->create_subscription<String>("~/in", 5, [this](const String::SharedPtr msg) {{ {} }});'


@pytest.mark.parametrize("base", [CONTROLLER, CHAINABLE])
def test_a_class_that_nothing_loads_has_a_configuration_of_its_own(base: str) -> None:
    code = controller(base=base, on_init=PUB.format("~/a"), on_configure=PUB.format("b"), on_activate=PUB.format("/c"))
    found = alone(code, base=base)
    node = lift(found)
    assert (found.name, node.name, node.kind, node.package) == ("arm/Lift (plug-ins)", "/?", "lifecycle", "arm")
    assert (node.class_name, node.process) == ("arm::Lift", "/?")
    assert names(node) == ["/?/a", "/b", "/c"]
    assert {(u.field, u.reason) for u in node.unknowns} == {("name", "a controller is called as whoever loads it says")}


def test_a_class_that_a_manager_loads_is_its_node_under_that_manager() -> None:
    code = controller(on_configure=PUB.format("~/state") + PUB.format("all"))
    (found,) = followed(code, MANAGER + SPAWNER.format("lift")).configurations
    node = lift(found)
    assert (node.name, node.kind, node.container, node.process) == (
        "/lift",
        "lifecycle",
        "/controller_manager",
        "/controller_manager",
    )
    assert (node.package, node.class_name, node.unknowns) == ("arm", "arm::Lift", ())
    assert names(node) == ["/all", "/lift/state"]


def test_one_class_under_two_names_and_parameters() -> None:
    config = (
        "controller_manager:\n  ros__parameters:\n    left: {type: arm/Lift}\n    right: {type: arm/Lift}\n"
        "left:\n  ros__parameters: {topic: l}\nright:\n  ros__parameters: {topic: r}\n"
    )
    code = controller(
        on_init='auto_declare<std::string>("topic", "t");',
        on_configure='get_node()->create_publisher<String>(get_node()->get_parameter("topic").as_string(), 1);',
    )
    (found,) = followed(code, MANAGER + SPAWNER.format("left right"), config).configurations
    made = {node.name: names(node) for node in found.nodes if node.type == "arm/Lift"}
    assert made == {"/left": ["/l"], "/right": ["/r"]}
    (alone_found,) = followed(code, "").configurations
    assert names(lift(alone_found)) == ["/t"]


def test_another_node_that_is_made_with_the_options_of_a_controller_s_node() -> None:
    name = 'std::string(get_node()->get_name()) + "_more"'
    made = f"auto more = std::make_shared<rclcpp::Node>({name}, get_node()->get_namespace(), get_node()->get_node_options());\n"
    code = controller(on_init=made + 'more->create_publisher<String>("~/m", 1);' + PUB.format("~/a"))
    (found,) = followed(code, MANAGER + SPAWNER.format("lift")).configurations
    nodes = {node.name: names(node) for node in found.nodes if node.type == "arm/Lift"}
    assert nodes == {"/lift": ["/lift/a"], "/lift_more": ["/lift_more/m"]}


def test_the_manager_s_namespace_and_remappings_of_the_spawner() -> None:
    args = "lift -c /a/controller_manager --controller-ros-args '-r ~/state:=/seen'"
    manager = MANAGER.replace("exec", 'namespace="a" exec')
    config = TYPED.replace("controller_manager", "/a/controller_manager")
    code = controller(on_configure=PUB.format("~/state") + PUB.format("near"))
    (found,) = followed(code, manager + SPAWNER.format(args), config).configurations
    assert (lift(found).name, names(lift(found))) == ("/a/lift", ["/a/near", "/seen"])


def loaded_as(name: str, described: str) -> Node:
    """The controller that a manager loads by its look-up *name*."""
    code = controller(on_configure=PUB.format("~/state"))
    config = TYPED.replace("arm/Lift", f'"{name}"')
    (found,) = followed(code, MANAGER + SPAWNER.format("lift"), config, described=described).configurations
    (node,) = (node for node in found.nodes if node.type == name)
    return node


def test_a_package_that_the_look_up_name_does_not_begin_with() -> None:
    described = '<class name="hoist/Lift" type="arm::Lift" base_class_type="{}"/>'
    node = loaded_as("hoist/Lift", described)
    assert (node.package, names(node)) == ("arm", ["/lift/state"])
    (by_itself,) = followed(controller(on_configure=PUB.format("~/state")), described=described).configurations
    assert by_itself.name == "arm/hoist/Lift (plug-ins)"


def test_one_class_under_two_look_up_names_has_one_configuration() -> None:
    one = '<class name="arm/{}" type="arm::Lift" base_class_type="{{}}"/>'
    described = one.format("Lift") + one.format("Raise").format(CONTROLLER)
    found = followed(controller(on_configure=PUB.format("~/state")), described=described)
    assert [each.name for each in found.configurations] == ["arm/Lift (plug-ins)"]


def test_a_class_that_is_known_by_its_type_alone() -> None:
    node = loaded_as("arm::Lift", '<class type="arm::Lift" base_class_type="{}"/>')
    assert (node.name, names(node)) == ("/lift", ["/lift/state"])


def test_what_real_time_publishers_lambdas_services_and_actions_are_made_of() -> None:
    code = controller(
        "std::shared_ptr<realtime_tools::RealtimePublisher<String>> pub_;\nrclcpp::Service<std_srvs::srv::Trigger>::SharedPtr srv_;\n"
        "void stop(const std_srvs::srv::Trigger::Request::SharedPtr, std_srvs::srv::Trigger::Response::SharedPtr) {}\n",
        on_configure="pub_ = std::make_shared<realtime_tools::RealtimePublisher<String>>("
        + PUB.format("~/state")[:-1]
        + ");"
        "srv_ = get_node()->create_service<std_srvs::srv::Trigger>("
        '"~/stop", std::bind(&Lift::stop, this, std::placeholders::_1, std::placeholders::_2));'
        + SUB.format(PUB.format("~/echo")),
        update='if (pub_ && pub_->trylock()) { pub_->msg_.data = "a"; pub_->unlockAndPublish(); }',
    )
    node = lift(alone(code))
    assert names(node) == ["/?/echo", "/?/state"]
    assert [(end.name, end.type) for end in explicit(node, "subscribers")] == [("/?/in", "std_msgs/msg/String")]
    assert [(end.name, end.type) for end in explicit(node, "servers")] == [("/?/stop", "std_srvs/srv/Trigger")]


def test_what_methods_of_the_loop_make_is_made_after_configuration() -> None:
    code = controller("std::string word_;", on_configure='word_ = "late";', update=PUB.replace('"{}"', "word_"))
    assert names(lift(alone(code))) == ["/late"]


def test_methods_that_are_defined_in_full_within_their_own_namespace() -> None:
    code = (
        f"namespace arm {{\nclass Lift : public {CONTROLLER} {{\npublic:\nCallbackReturn on_init() override;\n"
        "CallbackReturn on_configure(const rclcpp_lifecycle::State &) override;\nint a_;\n};\n"
        "CallbackReturn Lift::on_init() { " + PUB.format("~/a") + " }\n"
        "CallbackReturn arm::Lift::on_configure(const rclcpp_lifecycle::State &) { " + PUB.format("~/b") + " }\n}\n"
    )
    assert names(lift(alone(code))) == ["/?/a", "/?/b"]


def test_a_base_class_of_the_workspace_and_one_of_others() -> None:
    base = f"class Base : public {CONTROLLER} {{ public: CallbackReturn on_init() override {{ {PUB.format('~/of_base')} }} int b_; }};\n"
    node = lift(alone(base + controller(base="Base", on_configure=PUB.format("~/own"))))
    assert names(node) == ["/?/of_base", "/?/own"]
    assert [u.field for u in node.unknowns] == ["name"]
    other = lift(alone(controller(base="hoists::Common", on_configure=PUB.format("~/own"))))
    assert names(other) == ["/?/own"]
    assert "the base class hoists::Common is not in the workspace: what it makes and calls is not known" in {
        u.reason for u in other.unknowns if u.field == "endpoints"
    }


def test_a_parameter_library() -> None:
    library = "lift:\n  speed: {type: double, default_value: 0.5}\n  names: {type: string_array, default_value: []}\n"
    code = "#include <arm/lift_parameters.hpp>\n" + controller(
        "std::shared_ptr<lift::ParamListener> listener_;\nlift::Params params_;",
        on_init="listener_ = std::make_shared<lift::ParamListener>(get_node()); params_ = listener_->get_params();",
        on_configure="if (params_.speed > 0.1) " + PUB.format("~/fast"),
    )
    more = {
        "arm/src/lift.yaml": library,
        "arm/CMakeLists.txt": ROS2_CMAKE.format("arm")
        + "find_package(generate_parameter_library REQUIRED)\ngenerate_parameter_library(lift_parameters src/lift.yaml)\n"
        "ament_auto_add_library(arm_lib SHARED src/lift.cpp)\ntarget_link_libraries(arm_lib lift_parameters)\n"
        "pluginlib_export_plugin_description_file(controller_interface plugins.xml)\n"
        "ament_auto_package(INSTALL_TO_SHARE launch config)\n",
    }
    config = TYPED + "lift:\n  ros__parameters: {speed: 2.5}\n"
    (found,) = followed(code, MANAGER + SPAWNER.format("lift"), config, more=more).configurations
    node = lift(found)
    values = {end.name: (end.value, end.effective) for end in explicit(node, "parameters")}
    assert values["/lift:speed"] == (0.5, 2.5) and values["/lift:names"] == ([], [])
    assert names(node) == ["/lift/fast"]


def unsure(end: Endpoint) -> list[str]:
    return [unknown.reason for unknown in end.unknowns if unknown.field == "conditions"]


def test_what_every_controller_has_and_what_none_has() -> None:
    node = lift(alone(controller(on_init="")))
    found = {end.name: unsure(end) for end in explicit(node, "parameters")}
    assert found == {"/?:is_async": ["only from Iron on"], "/?:update_rate": ["only from Humble on"]}
    assert "/?/set_parameters" in implicit(node, "servers")
    assert not {name for name in implicit(node, "servers") if name.endswith("_state")}  # nobody offers them
    assert not {name for name in implicit(node, "publishers") if name.endswith("transition_event")}
    assert node.takes_undeclared


def test_a_known_controller_of_others_has_no_life_cycle_services_either() -> None:
    config = TYPED.replace("arm/Lift", "joint_state_broadcaster/JointStateBroadcaster")
    found = followed(controller(on_init=""), MANAGER + SPAWNER.format("lift"), config)
    node = next(node for one in found.configurations for node in one.nodes if node.name == "/lift")
    assert not {name for name in implicit(node, "servers") if name.endswith("_state")}


def test_another_node_of_a_controller_is_not_renamed_with_it() -> None:
    code = controller(
        "rclcpp::Node::SharedPtr other_;",
        on_configure='other_ = std::make_shared<rclcpp::Node>("helper"); other_->create_publisher<String>("~/a", 1);'
        + PUB.format("~/b"),
    )
    (found,) = followed(code, MANAGER + SPAWNER.format("lift")).configurations
    made = {node.name: names(node) for node in found.nodes if node.type == "arm/Lift"}
    assert made == {"/lift": ["/lift/b"], "/helper": ["/helper/a"]}


def test_a_member_of_the_name_that_the_framework_s_has() -> None:
    code = controller(
        "rclcpp::Node::SharedPtr node_;",
        on_configure='node_ = std::make_shared<rclcpp::Node>("helper"); node_->create_publisher<String>("~/a", 1);'
        + PUB.format("~/b"),
    )
    made = {node.name: names(node) for node in alone(code).nodes}
    assert made == {"/?": ["/?/b"], "/helper": ["/helper/a"]}


FRAMEWORK = """
namespace controller_interface {
class ControllerInterfaceBase {
public:
  std::shared_ptr<rclcpp_lifecycle::LifecycleNode> get_node() { if (!node_) { throw 1; } return node_; }
  virtual CallbackReturn on_init() = 0;
protected:
  std::shared_ptr<rclcpp_lifecycle::LifecycleNode> node_;
};
class ControllerInterface : public ControllerInterfaceBase { int b_; };
}
"""


def test_the_framework_itself_in_the_workspace() -> None:
    more = {"controller_interface/include/controller_interface/controller_interface.hpp": FRAMEWORK}
    (found,) = followed(
        controller(on_configure=PUB.format("~/a")), MANAGER + SPAWNER.format("lift"), more=more
    ).configurations
    assert names(lift(found)) == ["/lift/a"]


COMPONENT = """
namespace arm {
class Lift : public hardware_interface::SystemInterface {
public:
  CallbackReturn on_init(const hardware_interface::HardwareInfo & info) override {
    if (hardware_interface::SystemInterface::on_init(info) != CallbackReturn::SUCCESS) { return CallbackReturn::ERROR; }
    %s
    return CallbackReturn::SUCCESS;
  }
  CallbackReturn on_activate(const rclcpp_lifecycle::State &) override { %s return CallbackReturn::SUCCESS; }
  hardware_interface::return_type read(const rclcpp::Time &, const rclcpp::Duration &) override { %s }
  rclcpp::Node::SharedPtr own_;
};
}
"""
OWN = 'own_ = std::make_shared<rclcpp::Node>("lift_state");'


@pytest.mark.parametrize("kind", ["System", "Actuator", "Sensor"])
def test_a_hardware_component_with_a_node_of_its_own(kind: str) -> None:
    base = f"hardware_interface::{kind}Interface"
    code = COMPONENT.replace("hardware_interface::SystemInterface", base) % (
        OWN,
        'own_->create_publisher<String>("~/a", 1);',
        "",
    )
    found = alone(code, base=base)
    assert found.name == "arm/Lift (plug-ins)"
    assert {node.name: names(node) for node in found.nodes} == {"/lift_state": ["/lift_state/a"]}


def test_a_hardware_component_on_the_node_of_the_framework() -> None:
    found = alone(COMPONENT % ("", PUB.format("~/a"), ""), base="hardware_interface::SystemInterface")
    (node,) = found.nodes
    assert (node.name, names(node)) == ("/?", ["/?/a"])
    assert "a hardware component is called as the robot description says" in {u.reason for u in node.unknowns}


@pytest.mark.parametrize(
    ("code", "base", "described"),
    [
        pytest.param(
            COMPONENT % ("", "", ""), "hardware_interface::SystemInterface", None, id="hardware makes nothing"
        ),
        pytest.param(controller(on_init=PUB.format("a")), CONTROLLER, "", id="no description names it"),
        pytest.param(
            controller(on_init=PUB.format("a")),
            CONTROLLER,
            '<class name="arm/Gone" type="arm::Gone" base_class_type="{}"/>',
            id="a class that is not there",
        ),
    ],
)
def test_no_configuration(code: str, base: str, described: str | None) -> None:
    found = followed(code, base=base) if described is None else followed(code, base=base, described=described)
    assert found.configurations == ()


@pytest.mark.parametrize(
    "launch",
    [
        MANAGER + SPAWNER.format("lift"),
        SPAWNER.format("lift -t arm/Lift"),
        MANAGER + SPAWNER.format("lift --inactive"),
    ],
)
def test_what_is_loaded_somewhere_has_no_configuration_of_its_own(launch: str) -> None:
    found = followed(controller(on_init=PUB.format("a")), launch)
    assert [one.name for one in found.configurations] == ["arm/launch/l.launch.xml"]


@pytest.mark.parametrize(
    "launch",
    [
        MANAGER,
        MANAGER + SPAWNER.format("other"),
        '<node pkg="other" exec="spawner" args="lift"/>',
        '<node pkg="arm" exec="arm/Lift"/>',
    ],
)
def test_what_is_not_loaded_has_one(launch: str) -> None:
    found = followed(controller(on_init=PUB.format("a")), launch)
    assert [one.name for one in found.configurations if "(plug-ins)" in one.name] == ["arm/Lift (plug-ins)"]
    started = next(one for one in found.configurations if one.launch)
    assert not [node for node in started.nodes if names(node) == ["/a"]]


def test_a_class_of_ros1_is_not_one() -> None:
    texts = {
        "arm/CMakeLists.txt": "project(arm)\nfind_package(catkin REQUIRED)\ncatkin_package()\nadd_library(arm_lib src/lift.cpp)\n",
        "arm/package.xml": '<package><name>arm</name><export><controller_interface plugin="${prefix}/plugins.xml"/></export></package>',
        "arm/plugins.xml": f'<library path="arm_lib"><class name="arm/Lift" type="arm::Lift" base_class_type="{CONTROLLER}"/></library>',
        "arm/src/lift.cpp": HEAD + controller(on_init=PUB.format("a")),
    }
    found = architecture(workspace(texts, 1), Settings(root=Path("/nowhere")), Nothing(), environment={})
    assert found.configurations == ()


LOADING = '<executable cmd="{}"/>'


@pytest.mark.parametrize(
    "command",
    [
        "ros2 control load_controller lift",
        "ros2 control load_controller --set-state active lift",
        "ros2 control load_controller lift --set-state=inactive --use-sim-time",
        "ros2 control load_controller -c controller_manager lift",
        "ros2 control load_start_controller lift",
        "ros2 control load_controller lift $(find-pkg-share arm)/config/c.yaml",
        "ros2 control load_controller lift &amp;&amp; ros2 control list_controllers",
    ],
)
def test_a_command_that_loads_a_controller(command: str) -> None:
    (found,) = followed(controller(on_configure=PUB.format("~/a")), MANAGER + LOADING.format(command)).configurations
    assert [node.type for node in found.nodes] == ["ros2_control_node", "arm/Lift"]
    assert (lift(found).name, lift(found).container, names(lift(found))) == (
        "/lift",
        "/controller_manager",
        ["/lift/a"],
    )


@pytest.mark.parametrize(
    "command",
    [
        "ros2 control list_controllers",
        "ros2 control load_controller",
        "ros2 control load_controller --set-state active",
        "ros2 control set_controller_state lift active",
        "ros2 control switch_controllers --activate lift",
        "ros2 run arm load_controller lift",
        "echo ros2 control load_controller lift",
    ],
)
def test_a_command_that_loads_none(command: str) -> None:
    found = followed(controller(on_configure=PUB.format("~/a")), MANAGER + LOADING.format(command))
    started = next(one for one in found.configurations if one.launch)
    assert not [node for node in started.nodes if node.container is not None]


def test_a_controller_that_a_command_loads_in_python() -> None:
    text = (
        "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
        "from launch.substitutions import FindExecutable\nfrom launch_ros.actions import Node\n"
        "def generate_launch_description():\n    return LaunchDescription([\n"
        "        Node(package='controller_manager', executable='ros2_control_node', parameters=[{'lift.type': 'arm/Lift'}]),\n"
        "        ExecuteProcess(cmd=[FindExecutable(name='ros2'), 'control', 'load_controller', '--set-state', 'active', 'lift']),\n"
        "    ])\n"
    )
    more = {"arm/launch/l.launch.py": text}
    (found,) = followed(controller(on_configure=PUB.format("~/a")), more=more).configurations
    assert names(lift(found)) == ["/lift/a"]


def test_the_interface_of_older_releases() -> None:
    foxy = (
        f"namespace arm {{\nclass Lift : public {CONTROLLER} {{\npublic:\n"
        "controller_interface::return_type init(const std::string & controller_name) override {\n"
        f"  auto ret = {CONTROLLER}::init(controller_name);\n"
        "  if (ret != controller_interface::return_type::OK) { return ret; }\n"
        '  get_node()->declare_parameter<std::string>("topic", "t");\n  return ret;\n}\n'
        "CallbackReturn on_configure(const rclcpp_lifecycle::State &) override {\n"
        '  node_->create_publisher<String>("~/a", 1); return CallbackReturn::SUCCESS;\n}\nint a_;\n};\n}\n'
    )
    node = lift(alone(foxy))
    assert names(node) == ["/?/a"]
    assert "/?:topic" in names(node, "parameters")


def test_a_template_under_another_name() -> None:
    code = (
        f"namespace arm {{\ntemplate <class T>\nclass Hoist : public {CONTROLLER} {{\npublic:\n"
        f"CallbackReturn on_init() override {{ {PUB.format('~/a')} return CallbackReturn::SUCCESS; }}\nint a_;\n}};\n"
        "using Lift = Hoist<double>;\n}\n"
    )
    assert names(lift(alone(code))) == ["/?/a"]


def test_a_configuration_that_fails_with_defaults_is_told_with_that_reason() -> None:
    code = controller(
        on_init='auto_declare<std::string>("joint", "");',
        on_configure='if (get_node()->get_parameter("joint").as_string().empty()) { return CallbackReturn::ERROR; }'
        + PUB.format("~/a"),
    )
    (end,) = explicit(lift(alone(code)))
    assert unsure(end) == ["as things are, the code returns before it comes to this"]
    config = TYPED + "lift:\n  ros__parameters: {joint: j}\n"
    (found,) = followed(code, MANAGER + SPAWNER.format("lift"), config).configurations
    (end,) = explicit(lift(found))
    assert unsure(end) == []
