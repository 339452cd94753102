# SPDX-License-Identifier: Apache-2.0
"""ROS 2 Python: rclpy's nodes, their endpoints, parameters and timers (docs.ros.org/en/rolling/p/rclpy).

A timer's period is in seconds. What every node has by itself, its parameter services and ``/rosout``, has no row.
"""

from __future__ import annotations

from collections.abc import Mapping

NODE = "rclpy.node.Node"
#: The quality of service of a service's ends that are given none.
SERVICES = "rclpy.qos.qos_profile_services_default"
#: Methods of a managed node that its state machine calls (rclpy/lifecycle/managed_entity.py).
TRANSITIONS = ["on_configure", "on_cleanup", "on_shutdown", "on_activate", "on_deactivate", "on_error"]
#: Members of a ParameterValue (rcl_interfaces/msg/ParameterValue).
VALUES = "bool integer double string byte_array bool_array integer_array double_array string_array"
QOS_EVENTS = ["deadline", "liveliness", "incompatible_qos", "incompatible_type", "message_lost", "matched"]


def of_type(kind: str, where: str) -> dict[str, object]:
    """A parameter that is declared by a member of the enumeration *kind*, which is the argument *where*."""
    return {
        "call": f"{NODE}.declare_parameter",
        "when": {where: kind},
        "makes": [
            {"kind": "parameters", "name": "{0|name}", "type": f"{{{where}}}", "descriptor": "{2|descriptor}"},
        ],
        "returns": "rclpy.parameter.Parameter",
        "fills": {"name": "{0|name}", "value": "{parameter}"},
    }


# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # rclpy/node.py, rclpy/__init__.py: all options are keywords.
    {"call": NODE,
     "makes": [{"kind": "node", "name": "{0|node_name}", "namespace": "{namespace}", "options": "{keywords}"}]},
    {"call": "rclpy.create_node",
     "makes": [{"kind": "node", "name": "{0|node_name}", "namespace": "{namespace}", "options": "{keywords}"}],
     "returns": NODE},

    # rclpy/lifecycle/node.py. The mixin is for classes that are nodes otherwise.
    {"class": "rclpy.lifecycle.LifecycleNodeMixin", "entry": TRANSITIONS},
    {"call": "rclpy.lifecycle.LifecycleNodeMixin"},
    {"class": "rclpy.lifecycle.LifecycleNode", "bases": ["rclpy.lifecycle.LifecycleNodeMixin", NODE],
     "entry": TRANSITIONS},
    {"call": "rclpy.lifecycle.LifecycleNode",
     "makes": [{"kind": "node", "name": "{0|node_name}", "namespace": "{namespace}", "options": "{keywords}",
                "lifecycle": True}]},
    {"class": "rclpy.lifecycle.LifecyclePublisher", "bases": ["rclpy.publisher.Publisher"]},

    # rclpy/node.py: endpoints. A number for the QoS is a depth.
    {"call": f"{NODE}.create_publisher",
     "makes": [{"kind": "publishers", "name": "{1|topic}", "type": "{typename(0|msg_type)}",
                "qos": "{2|qos_profile}", "options": "{qos_overriding_options}"}],
     "returns": "rclpy.publisher.Publisher", "fills": {"topic": "{1|topic}", "topic_name": "{resolve(1|topic)}"}},
    {"call": "rclpy.lifecycle.LifecycleNodeMixin.create_lifecycle_publisher",
     "makes": [{"kind": "publishers", "name": "{1|topic}", "type": "{typename(0|msg_type)}",
                "qos": "{2|qos_profile}", "options": "{qos_overriding_options}"}],
     "returns": "rclpy.lifecycle.LifecyclePublisher",
     "fills": {"topic": "{1|topic}", "topic_name": "{resolve(1|topic)}"}},
    {"call": f"{NODE}.create_subscription",
     "makes": [{"kind": "subscribers", "name": "{1|topic}", "type": "{typename(0|msg_type)}",
                "qos": "{3|qos_profile}", "options": "{qos_overriding_options}"}],
     "calls": ["2", "callback"],
     "returns": "rclpy.subscription.Subscription",
     "fills": {"topic": "{1|topic}", "topic_name": "{resolve(1|topic)}"}},
    {"call": f"{NODE}.create_service",
     "makes": [{"kind": "servers", "name": "{1|srv_name}", "type": "{typename(0|srv_type)}",
                "qos": f"{{qos_profile?{SERVICES}}}"}],
     "calls": ["2", "callback"],
     "returns": "rclpy.service.Service",
     "fills": {"srv_name": "{1|srv_name}", "service_name": "{resolve(1|srv_name)}"}},
    {"call": f"{NODE}.create_client",
     "makes": [{"kind": "clients", "name": "{1|srv_name}", "type": "{typename(0|srv_type)}",
                "qos": f"{{qos_profile?{SERVICES}}}"}],
     "returns": "rclpy.client.Client",
     "fills": {"srv_name": "{1|srv_name}", "service_name": "{resolve(1|srv_name)}"}},

    # rclpy/node.py: timers, rates, guard conditions.
    {"call": f"{NODE}.create_timer", "makes": [{"kind": "timer", "period": "{0|timer_period_sec}"}],
     "calls": ["1", "callback"], "returns": "rclpy.timer.Timer"},
    {"call": f"{NODE}.create_rate", "makes": [{"kind": "rate", "frequency": "{0|frequency}"}],
     "returns": "rclpy.timer.Rate"},
    {"call": f"{NODE}.create_guard_condition", "calls": ["0", "callback"],
     "returns": "rclpy.guard_condition.GuardCondition"},

    # rclpy/node.py: parameters. Of declare_parameters each tuple is a name, a default or type, and a descriptor; the
    # name is below the namespace, with a dot, unless that is empty. A type in place of a default is a member of Type.
    *(of_type(kind, where)
      for kind in ("rclpy.parameter.Parameter.Type", "rclpy.Parameter.Type") for where in ("1", "value")),
    {"call": f"{NODE}.declare_parameter",
     "makes": [{"kind": "parameters", "name": "{0|name}", "type": "{typeof(1|value)}", "value": "{1|value}",
                "descriptor": "{2|descriptor}"}],
     "returns": "rclpy.parameter.Parameter", "fills": {"name": "{0|name}", "value": "{parameter}"}},
    {"call": f"{NODE}.declare_parameters",
     "makes": [{"kind": "parameters", "each": "items(1|parameters)", "name": "{0|namespace}.{item.name}",
                "type": "{item.type}", "value": "{item.default}", "descriptor": "{item.descriptor}"}]},
    {"call": f"{NODE}.get_parameter", "makes": [{"kind": "getters", "name": "{0|name}", "strict": True}],
     "returns": "rclpy.parameter.Parameter", "fills": {"name": "{0|name}", "value": "{parameter}"}},
    {"call": f"{NODE}.get_parameter_or",
     "makes": [{"kind": "getters", "name": "{0|name}", "value": "{1.value|alternative_value.value}"}],
     "returns": "rclpy.parameter.Parameter", "fills": {"name": "{0|name}", "value": "{parameter}"}},
    {"call": f"{NODE}.get_parameters",
     "makes": [{"kind": "getters", "each": "items(0|names)", "name": "{item.name}", "strict": True}],
     "returns": "{parameter}"},
    {"call": f"{NODE}.get_parameter_types",
     "makes": [{"kind": "getters", "each": "items(0|names)", "name": "{item.name}", "strict": True}]},
    {"call": f"{NODE}.get_parameter_type", "makes": [{"kind": "getters", "name": "{0|name}", "strict": True}]},
    {"call": f"{NODE}.get_parameters_by_prefix"},
    {"call": f"{NODE}.list_parameters"},
    {"call": f"{NODE}.describe_parameter"},
    {"call": f"{NODE}.describe_parameters"},
    {"call": f"{NODE}.set_descriptor"},
    {"call": f"{NODE}.has_parameter", "returns": "{declared(0|name)}"},
    {"call": f"{NODE}.set_parameters",
     "makes": [{"kind": "setters", "each": "items(0|parameter_list)", "name": "{item.name}", "type": "{item.type}",
                "value": "{item.default}"}]},
    {"call": f"{NODE}.set_parameters_atomically",
     "makes": [{"kind": "setters", "each": "items(0|parameter_list)", "name": "{item.name}", "type": "{item.type}",
                "value": "{item.default}"}]},
    {"call": f"{NODE}.undeclare_parameter", "makes": [{"kind": "setters", "name": "{0|name}"}]},
    {"call": f"{NODE}.add_pre_set_parameters_callback", "calls": ["0", "callback"]},
    {"call": f"{NODE}.add_on_set_parameters_callback", "calls": ["0", "callback"]},
    {"call": f"{NODE}.add_post_set_parameters_callback", "calls": ["0", "callback"]},
    # Before ROS 2 Foxy.
    {"call": f"{NODE}.set_parameters_callback", "calls": ["0", "callback"]},

    # rclpy/node.py: names. A name that is only expanded makes nothing.
    {"call": f"{NODE}.get_name", "args": [0], "returns": "{node.base_name}"},
    {"call": f"{NODE}.get_namespace", "args": [0], "returns": "{node.namespace}"},
    {"call": f"{NODE}.get_fully_qualified_name", "args": [0], "returns": "{node.name}"},
    {"call": f"{NODE}.resolve_topic_name", "args": [1], "returns": "{resolve(0|topic)}"},
    {"call": f"{NODE}.resolve_service_name", "args": [1], "returns": "{resolve(0|service)}"},

    # rclpy/node.py: the rest of a node.
    {"call": f"{NODE}.get_logger", "returns": "rclpy.impl.rcutils_logger.RcutilsLogger"},
    {"call": f"{NODE}.get_clock", "returns": "rclpy.clock.Clock"},
    {"call": f"{NODE}.add_waitable"},

    # rclpy/parameter.py
    {"call": "rclpy.parameter.Parameter",
     "fills": {"name": "{0|name}", "type_": "{1|type_}", "value": "{2|value}"}},
    {"call": "rclpy.parameter.Parameter.get_parameter_value", "returns": "rcl_interfaces.msg.ParameterValue",
     "fills": {**{f"{kind}_value": "{this.value}" for kind in VALUES.split()}, "of": "{this}"}},
    {"call": "rclpy.parameter.Parameter.to_parameter_msg", "returns": "rcl_interfaces.msg.Parameter",
     "fills": {"name": "{this.name}", "value": "{this}"}},

    # rcl_interfaces/msg: ParameterDescriptor, its ranges, and what requests to other nodes are made of.
    {"call": "rcl_interfaces.msg.ParameterDescriptor",
     "fills": {name: f"{{{name}}}" for name in (
         "name", "type", "description", "additional_constraints", "read_only", "dynamic_typing",
         "floating_point_range", "integer_range")}},
    {"call": "rcl_interfaces.msg.FloatingPointRange",
     "fills": {name: f"{{{at}|{name}?0.0}}" for at, name in enumerate(("from_value", "to_value", "step"))}},
    {"call": "rcl_interfaces.msg.IntegerRange",
     "fills": {name: f"{{{at}|{name}?0}}" for at, name in enumerate(("from_value", "to_value", "step"))}},

    # rclpy/parameter_client.py: clients of the other node's parameter services.
    {"call": "rclpy.parameter_client.AsyncParameterClient",
     "makes": [{"kind": "clients", "name": f"{{1|remote_node_name}}/{name}", "type": f"rcl_interfaces/srv/{kind}",
                "qos": f"{{2|qos_profile?{SERVICES}}}", "namespace": "{0|node}"}
               for name, kind in (("get_parameters", "GetParameters"), ("list_parameters", "ListParameters"),
                                  ("set_parameters", "SetParameters"),
                                  ("get_parameter_types", "GetParameterTypes"),
                                  ("describe_parameters", "DescribeParameters"),
                                  ("set_parameters_atomically", "SetParametersAtomically"))]},

    # rclpy/parameter_event_handler.py
    {"call": "rclpy.parameter_event_handler.ParameterEventHandler",
     "makes": [{"kind": "subscribers", "name": "/parameter_events", "type": "rcl_interfaces/msg/ParameterEvent",
                "qos": "{1|qos_profile?rclpy.qos.qos_profile_parameter_events}", "namespace": "{0|node}",
                "options": "{4|qos_overriding_options}"}]},
    {"call": "rclpy.parameter_event_handler.ParameterEventHandler.add_parameter_callback",
     "calls": ["2", "callback"]},
    {"call": "rclpy.parameter_event_handler.ParameterEventHandler.add_parameter_event_callback",
     "calls": ["0", "callback"]},

    # rclpy/wait_for_message.py: a subscription while it waits. Before ROS 2 Jazzy it had no qos_profile.
    {"call": "rclpy.wait_for_message.wait_for_message",
     "makes": [{"kind": "subscribers", "name": "{2|topic}", "type": "{typename(0|msg_type)}", "qos": "{qos_profile?1}",
                "namespace": "{1|node}"}]},

    # rclpy/action/server.py, rclpy/action/client.py
    {"call": "rclpy.action.ActionServer",
     "makes": [{"kind": "action_servers", "name": "{2|action_name}", "type": "{typename(1|action_type)}",
                "namespace": "{0|node}"}],
     "calls": ["3", "execute_callback", "goal_callback", "handle_accepted_callback", "cancel_callback"]},
    {"call": "rclpy.action.ActionServer.register_execute_callback", "calls": ["0", "execute_callback"]},
    {"call": "rclpy.action.ActionServer.register_goal_callback", "calls": ["0", "goal_callback"]},
    {"call": "rclpy.action.ActionServer.register_cancel_callback", "calls": ["0", "cancel_callback"]},
    {"call": "rclpy.action.ActionServer.register_handle_accepted_callback",
     "calls": ["0", "handle_accepted_callback"]},
    {"call": "rclpy.action.server.ServerGoalHandle.execute", "calls": ["0", "execute_callback"]},
    {"call": "rclpy.action.ActionClient",
     "makes": [{"kind": "action_clients", "name": "{2|action_name}", "type": "{typename(1|action_type)}",
                "namespace": "{0|node}"}]},
    {"call": "rclpy.action.ActionClient.send_goal_async", "calls": ["1", "feedback_callback"],
     "returns": "rclpy.task.Future"},
    {"call": "rclpy.action.ActionClient.send_goal", "calls": ["feedback_callback"]},
    {"call": "rclpy.action.client.ClientGoalHandle.get_result_async", "returns": "rclpy.task.Future"},
    {"call": "rclpy.action.client.ClientGoalHandle.cancel_goal_async", "returns": "rclpy.task.Future"},

    # rclpy/client.py, rclpy/task.py, rclpy/executors.py, rclpy/context.py, rclpy/clock.py, rclpy/timer.py
    {"call": "rclpy.client.Client.call_async", "returns": "rclpy.task.Future"},
    {"call": "rclpy.client.Client.configure_introspection", "unseen": "the events of a service are published"},
    {"call": "rclpy.service.Service.configure_introspection", "unseen": "the events of a service are published"},
    {"call": "rclpy.task.Future"},
    {"call": "rclpy.task.Future.add_done_callback", "calls": ["0", "callback"]},
    {"class": "rclpy.task.Task", "bases": ["rclpy.task.Future"]},
    {"call": "rclpy.executors.Executor"},
    {"call": "rclpy.executors.Executor.create_task", "calls": ["0", "callback"], "returns": "rclpy.task.Task"},
    {"class": "rclpy.executors.SingleThreadedExecutor", "bases": ["rclpy.executors.Executor"]},
    {"call": "rclpy.executors.SingleThreadedExecutor"},
    {"class": "rclpy.executors.MultiThreadedExecutor", "bases": ["rclpy.executors.Executor"]},
    {"call": "rclpy.executors.MultiThreadedExecutor"},
    {"call": "rclpy.callback_groups.MutuallyExclusiveCallbackGroup"},
    {"call": "rclpy.callback_groups.ReentrantCallbackGroup"},
    {"call": "rclpy.context.Context"},
    {"call": "rclpy.context.Context.on_shutdown", "calls": ["0", "callback"]},
    {"call": "rclpy.clock.Clock"},
    {"call": "rclpy.clock.ROSClock"},
    {"class": "rclpy.clock.ROSClock", "bases": ["rclpy.clock.Clock"]},
    {"call": "rclpy.clock.Clock.now", "returns": "rclpy.time.Time"},
    {"call": "rclpy.clock.Clock.create_jump_callback", "calls": ["pre_callback", "post_callback"]},
    {"call": "rclpy.timer.Timer", "calls": ["0", "callback"]},

    # rclpy/event_handler.py, rclpy/qos_event.py before ROS 2 Iron
    {"call": "rclpy.event_handler.PublisherEventCallbacks", "calls": QOS_EVENTS},
    {"call": "rclpy.event_handler.SubscriptionEventCallbacks", "calls": QOS_EVENTS},
    {"call": "rclpy.qos_event.PublisherEventCallbacks", "calls": QOS_EVENTS},
    {"call": "rclpy.qos_event.SubscriptionEventCallbacks", "calls": QOS_EVENTS},

    # rclpy/__init__.py, rclpy/utilities.py, rclpy/logging.py: nothing of these is an endpoint.
    {"call": "rclpy.utilities.get_default_context", "returns": "rclpy.context.Context"},
    {"call": "rclpy.get_default_context", "returns": "rclpy.context.Context"},
    {"call": "rclpy.get_global_executor", "returns": "rclpy.executors.SingleThreadedExecutor"},
    {"call": "rclpy.logging.get_logger", "returns": "rclpy.impl.rcutils_logger.RcutilsLogger"},
    {"call": "rclpy.impl.rcutils_logger.RcutilsLogger.get_child",
     "returns": "rclpy.impl.rcutils_logger.RcutilsLogger"},

    # ament_index_python/packages.py: a text that stands for the directory, wherever it is.
    {"call": "ament_index_python.packages.get_package_share_directory",
     "returns": "$(find-pkg-share {0|package_name})"},
    {"call": "ament_index_python.get_package_share_directory", "returns": "$(find-pkg-share {0|package_name})"},
    {"call": "ament_index_python.packages.get_package_share_path", "returns": "$(find-pkg-share {0|package_name})"},
    {"call": "ament_index_python.get_package_share_path", "returns": "$(find-pkg-share {0|package_name})"},
    {"call": "ament_index_python.packages.get_package_prefix", "returns": "$(find-pkg-prefix {0|package_name})"},
    {"call": "ament_index_python.get_package_prefix", "returns": "$(find-pkg-prefix {0|package_name})"},
)
# fmt: on

#: Functions and methods that make, call and change nothing in the model.
SILENT = {
    "rclpy": "init shutdown try_shutdown ok spin spin_once spin_until_future_complete",
    "rclpy.utilities": "ok shutdown try_shutdown",
    "rclpy.logging": "initialize shutdown set_logger_level get_logger_level get_logger_effective_level",
    "rclpy.impl.rcutils_logger.RcutilsLogger": "debug info warn warning error fatal log set_level is_enabled_for",
    NODE: "destroy_node destroy_publisher destroy_subscription destroy_client destroy_service destroy_timer destroy_rate "
    "destroy_guard_condition count_publishers count_subscribers count_clients count_services wait_for_node "
    "get_topic_names_and_types get_service_names_and_types get_node_names get_node_names_and_namespaces "
    "get_publishers_info_by_topic get_subscriptions_info_by_topic remove_on_set_parameters_callback",
    "rclpy.publisher.Publisher": "publish get_subscription_count assert_liveliness wait_for_all_acked destroy",
    "rclpy.subscription.Subscription": "destroy",
    "rclpy.service.Service": "destroy send_response",
    "rclpy.client.Client": "call wait_for_service service_is_ready remove_pending_request destroy",
    "rclpy.action.ActionClient": "wait_for_server server_is_ready destroy",
    "rclpy.action.ActionServer": "destroy",
    "rclpy.parameter_client.AsyncParameterClient": "services_are_ready wait_for_services",
    "rclpy.task.Future": "done result exception cancel cancelled set_result set_exception",
    "rclpy.executors.Executor": "add_node remove_node get_nodes wake shutdown spin spin_once "
    "spin_until_future_complete spin_once_until_future_complete",
    "rclpy.context.Context": "init ok shutdown try_shutdown",
    "rclpy.timer.Timer": "cancel reset is_canceled is_ready time_until_next_call time_since_last_call destroy",
    "rclpy.timer.Rate": "sleep destroy",
    "rclpy.guard_condition.GuardCondition": "trigger destroy",
    "rclpy.clock.Clock": "sleep_until sleep_for",
}
#: Other names under which the packages have their classes.
NAMES = {
    "rclpy.parameter.Parameter": ("rclpy.Parameter", "rclpy.node.Parameter"),
    "rclpy.context.Context": ("rclpy.Context",),
    "rclpy.task.Future": ("rclpy.Future",),
    "rclpy.action.ActionServer": ("rclpy.action.server.ActionServer",),
    "rclpy.action.ActionClient": ("rclpy.action.client.ActionClient",),
    "rclpy.lifecycle.LifecycleNode": ("rclpy.lifecycle.Node", "rclpy.lifecycle.node.LifecycleNode"),
    "rclpy.lifecycle.LifecycleNodeMixin": ("rclpy.lifecycle.NodeMixin", "rclpy.lifecycle.node.LifecycleNodeMixin"),
    "rclpy.lifecycle.LifecyclePublisher": (
        "rclpy.lifecycle.Publisher",
        "rclpy.lifecycle.publisher.LifecyclePublisher",
    ),
}


def silent(names: Mapping[str, str]) -> tuple[dict[str, object], ...]:
    """A row that says nothing for each of these names of classes and modules."""
    return tuple({"call": f"{owner}.{name}"} for owner, text in names.items() for name in text.split())


def renamed(rows: tuple[dict[str, object], ...], names: Mapping[str, tuple[str, ...]]) -> tuple[dict[str, object], ...]:
    """The rows for other names of classes: their constructors again, and what they have from the class itself."""
    found: list[dict[str, object]] = []
    for name, others in names.items():
        entries = [{"entry": row["entry"]} for row in rows if row.get("class") == name and "entry" in row]
        for other in others:
            found.append({"class": other, "bases": [name], **(entries[0] if entries else {})})
            found += [row | {"call": other} for row in rows if row.get("call") == name]
    return tuple(found)


ROWS += silent(SILENT)
ROWS += renamed(ROWS, NAMES)
