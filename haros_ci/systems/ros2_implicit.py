# SPDX-License-Identifier: Apache-2.0
"""What the client library makes for every ROS 2 node (docs.ros.org, rclcpp/node.hpp, lifecycle_node.hpp, component_manager.hpp)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from haros_ci.follow.ros.ros2_nodes import MANAGED
from haros_ci.model.architecture import Condition, Endpoint, Qos, Unknown
from haros_ci.model.location import Location

SERVICES = (
    ("describe_parameters", "rcl_interfaces/srv/DescribeParameters"),
    ("get_parameter_types", "rcl_interfaces/srv/GetParameterTypes"),
    ("get_parameters", "rcl_interfaces/srv/GetParameters"),
    ("list_parameters", "rcl_interfaces/srv/ListParameters"),
    ("set_parameters", "rcl_interfaces/srv/SetParameters"),
    ("set_parameters_atomically", "rcl_interfaces/srv/SetParametersAtomically"),
)
LIFECYCLE = (
    ("change_state", "lifecycle_msgs/srv/ChangeState"),
    ("get_available_states", "lifecycle_msgs/srv/GetAvailableStates"),
    ("get_available_transitions", "lifecycle_msgs/srv/GetAvailableTransitions"),
    ("get_state", "lifecycle_msgs/srv/GetState"),
    ("get_transition_graph", "lifecycle_msgs/srv/GetAvailableTransitions"),
)
CONTAINER = (
    ("list_nodes", "composition_interfaces/srv/ListNodes"),
    ("load_node", "composition_interfaces/srv/LoadNode"),
    ("unload_node", "composition_interfaces/srv/UnloadNode"),
)
EVENTS = Qos(history="keep_last", depth=1000, reliability="reliable", durability="volatile")
ROSOUT = Qos(history="keep_last", depth=1000, reliability="reliable", durability="transient_local", lifespan=10.0)
CLOCK = Qos(history="keep_last", depth=1, reliability="best_effort", durability="volatile")
SINCE_IRON = "only from Iron on"


def implicit(
    name: str,
    kind: str,
    options: Mapping[str, bool],
    use_sim_time: Any,
    location: Location | None,
    conditions: tuple[Condition, ...] = (),
) -> Iterator[Endpoint]:
    """The endpoints of the node called *name* of a *kind* (node, lifecycle, component, container) by its *options*.

    *use_sim_time* is the value that the parameter is given from outside, None for none.
    """

    def end(kind: str, full: str, type: str, qos: Qos | None = None, *unknowns: Unknown) -> Endpoint:
        return Endpoint(
            kind=kind,
            name=full,
            original_name=full,
            type=type,
            location=location,
            conditions=conditions,
            implicit=True,
            qos=qos,
            unknowns=unknowns,
        )

    if options.get("start_parameter_event_publisher", True):
        yield end("publishers", "/parameter_events", "rcl_interfaces/msg/ParameterEvent", EVENTS)
    if options.get("enable_rosout", True):
        yield end("publishers", "/rosout", "rcl_interfaces/msg/Log", ROSOUT)
    if options.get("start_parameter_services", True):
        for service, type in SERVICES:
            yield end("servers", f"{name}/{service}", type)
    unsure = Unknown("conditions", SINCE_IRON, location)
    yield end(
        "servers", f"{name}/get_type_description", "type_description_interfaces/srv/GetTypeDescription", None, unsure
    )
    if kind == "lifecycle" and options.get(MANAGED, True):
        for service, type in LIFECYCLE:
            yield end("servers", f"{name}/{service}", type)
        yield end("publishers", f"{name}/transition_event", "lifecycle_msgs/msg/TransitionEvent")
    if kind == "container":
        for service, type in CONTAINER:
            yield end("servers", f"{name}/_container/{service}", type)
    if use_sim_time is True:
        yield end("subscribers", "/clock", "rosgraph_msgs/msg/Clock", CLOCK)
    yield Endpoint(
        kind="parameters",
        name=f"{name}:use_sim_time",
        original_name=f"{name}:use_sim_time",
        type="bool",
        location=location,
        conditions=conditions,
        value=False,
        effective=use_sim_time if isinstance(use_sim_time, bool) else False,
        read_only=False,
        implicit=True,
    )
