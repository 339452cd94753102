# SPDX-License-Identifier: Apache-2.0
"""Topics, services, actions and timers (ROS 2, C++), as methods of a node and as functions that are given one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

SERVICES, DEFAULT = "rmw_qos_profile_services_default", "rmw_qos_profile_default"
PUBLISHER, SUBSCRIPTION = "rclcpp::Publisher", "rclcpp::Subscription"
SERVICE, CLIENT = "rclcpp::Service", "rclcpp::Client"


#: Members of ``event_callbacks`` in the options of publishers and subscriptions (rclcpp/event_handler.hpp).
EVENTS = ("deadline", "liveliness", "incompatible_qos", "incompatible_type", "message_lost", "matched")


def events(options: int) -> list[str]:
    """Selectors of the functions that are called on events, as argument *options* says."""
    return [f"{options}.event_callbacks.{event}_callback" for event in EVENTS]


def _row(call: str, args: list[int], kind: str, name: int, **more: Any) -> dict[str, object]:
    """A call that makes one *kind* of endpoint, named by argument *name*; *more* are keys of it and of the row."""
    outer: dict[str, Any] = {key: more.pop(key) for key in ("when", "calls", "returns", "fills") if key in more}
    return {"call": call, "args": args, "makes": [{"kind": kind, "name": f"{{{name}}}", **more}], **outer}


def _topic(call: str, args: list[int], name: int, generic: bool = False, **more: Any) -> list[dict[str, object]]:
    """A publisher, ``name, [type,] qos, options``."""
    qos = name + 1 + generic
    kind = {"type": f"{{{name + 1}}}"} if generic else {"type": "{<0>}"}
    keys = {**kind, "qos": f"{{{qos}}}", "options": f"{{{qos + 1}}}", **more}
    returns = "rclcpp::GenericPublisher" if generic else PUBLISHER
    fills = {"topic": f"{{resolve({name})}}"}
    return [_row(call, args, "publishers", name, **keys, calls=events(qos + 1), fills=fills, returns=returns)]


def _subscription(call: str, args: list[int], name: int, generic: bool = False, **more: Any) -> list[dict[str, object]]:
    """A subscription, ``name, [type,] qos, callback, options, strategy``."""
    qos = name + 1 + generic
    kind = {"type": f"{{{name + 1}}}"} if generic else {"type": f"{{<0>|callback({qos + 1})}}"}
    keys = {**kind, "qos": f"{{{qos}}}", "options": f"{{{qos + 2}}}", **more}
    fills = {"topic": f"{{resolve({name})}}"}
    returns = "rclcpp::GenericSubscription" if generic else SUBSCRIPTION
    calls = [str(qos + 1), *events(qos + 2)]
    return [_row(call, args, "subscribers", name, **keys, calls=calls, fills=fills, returns=returns)]


def _service(call: str, args: list[int], name: int, generic: bool = False, **more: Any) -> list[dict[str, object]]:
    """A service, ``name, [type,] callback, qos, group``."""
    callback = name + 1 + generic
    kind = {"type": f"{{{name + 1}}}"} if generic else {"type": f"{{<0>|callback({callback})}}"}
    keys = {**kind, "qos": f"{{{callback + 1}?{SERVICES}}}", **more}
    returns = "rclcpp::GenericService" if generic else SERVICE
    fills = {"service": f"{{resolve({name})}}"}
    return [_row(call, args, "servers", name, **keys, calls=[str(callback)], fills=fills, returns=returns)]


def _client(call: str, args: list[int], name: int, generic: bool = False, **more: Any) -> list[dict[str, object]]:
    """A client, ``name, [type,] qos, group``."""
    qos = name + 1 + generic
    kind = {"type": f"{{{name + 1}}}"} if generic else {"type": "{<0>}"}
    returns = "rclcpp::GenericClient" if generic else CLIENT
    fills = {"service": f"{{resolve({name})}}"}
    keys = {**kind, "qos": f"{{{qos}?{SERVICES}}}", **more}
    return [_row(call, args, "clients", name, **keys, fills=fills, returns=returns)]


NODE: dict[str, Any] = {"namespace": "{0}"}
# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # rclcpp/node.hpp: methods of a node; up to ROS 2 Crystal a quality of service comes last, or is the default.
    _row("rclcpp::Node::create_publisher", [1], "publishers", 0, type="{<0>}", qos=f"{{1?{DEFAULT}}}",
         fills={"topic": "{resolve(0)}"}, returns=PUBLISHER),
    _row("rclcpp::Node::create_subscription", [2, 3, 4, 5], "subscribers", 0, when={"1": "function"},
         type="{<0>|callback(1)}", qos=f"{{2?{DEFAULT}}}", calls=["1"], fills={"topic": "{resolve(0)}"},
         returns=SUBSCRIPTION),
    *_topic("rclcpp::Node::create_publisher", [2, 3], 0),
    *_subscription("rclcpp::Node::create_subscription", [3, 4, 5], 0),
    *_service("rclcpp::Node::create_service", [2, 3, 4], 0),
    *_client("rclcpp::Node::create_client", [1, 2, 3], 0),
    *_topic("rclcpp::Node::create_generic_publisher", [3, 4], 0, True),
    *_subscription("rclcpp::Node::create_generic_subscription", [4, 5], 0, True),
    *_service("rclcpp::Node::create_generic_service", [3, 4, 5], 0, True),
    *_client("rclcpp::Node::create_generic_client", [2, 3, 4], 0, True),

    # rclcpp/create_publisher.hpp, create_subscription.hpp: a node, or its interfaces for parameters and topics.
    *_topic("rclcpp::create_publisher", [4, 5], 2, when={"2": "string"}, **NODE),
    *_topic("rclcpp::create_publisher", [3, 4], 1, **NODE),
    *_topic("rclcpp::create_publisher", [5], 2, **NODE),
    *_subscription("rclcpp::create_subscription", [5, 6, 7], 2, when={"2": "string"}, **NODE),
    *_subscription("rclcpp::create_subscription", [4, 5, 6], 1, **NODE),
    *_subscription("rclcpp::create_subscription", [7], 2, **NODE),

    # rclcpp/create_service.hpp, create_client.hpp, create_generic_*.hpp
    *_service("rclcpp::create_service", [4, 5, 6], 2, **NODE),
    *_client("rclcpp::create_client", [4, 5, 6], 3, **NODE),
    *_topic("rclcpp::create_generic_publisher", [4, 5], 1, True, **NODE),
    *_subscription("rclcpp::create_generic_subscription", [5, 6], 1, True, **NODE),
    *_service("rclcpp::create_generic_service", [6, 7], 1, True, when={"1": "string"}, **NODE),
    *_service("rclcpp::create_generic_service", [7], 2, True, **NODE),
    *_client("rclcpp::create_generic_client", [3, 4, 5], 1, True, when={"1": "string"}, **NODE),
    *_client("rclcpp::create_generic_client", [5, 6, 7], 3, True, **NODE),

    # rclcpp/publisher_base.hpp, subscription_base.hpp, rclcpp/wait_for_message.hpp
    *({"class": f"rclcpp::{name}", "bases": ["rclcpp::PublisherBase"]} for name in ("Publisher", "GenericPublisher")),
    *({"class": f"rclcpp::{name}", "bases": ["rclcpp::SubscriptionBase"]}
      for name in ("Subscription", "GenericSubscription")),
    {"call": "rclcpp::PublisherBase::get_topic_name", "args": [0], "returns": "{this.topic}"},
    {"call": "rclcpp::SubscriptionBase::get_topic_name", "args": [0], "returns": "{this.topic}"},
    # rclcpp/service.hpp, client.hpp
    *({"class": f"rclcpp::{name}", "bases": ["rclcpp::ServiceBase"]} for name in ("Service", "GenericService")),
    *({"class": f"rclcpp::{name}", "bases": ["rclcpp::ClientBase"]} for name in ("Client", "GenericClient")),
    *({"call": f"rclcpp::{name}::get_service_name", "args": [0], "returns": "{this.service}"}
      for name in ("ServiceBase", "ClientBase")),
    {"call": "rclcpp::wait_for_message", "args": [3, 4], "when": {"2": "string"},
     "makes": [{"kind": "subscribers", "name": "{2}", "type": "{<0>|typename(0)}", "qos": 1, "namespace": "{1}"}],
     "sets": {"0": "{parameter}"}},
    {"call": "rclcpp::Client::async_send_request", "args": [1, 2], "calls": ["1"]},

    # rclcpp_action/create_server.hpp, create_client.hpp: a node, or four of its interfaces.
    {"call": "rclcpp_action::create_server", "args": [5, 6, 7],
     "makes": [{"kind": "action_servers", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}],
     "calls": ["2", "3", "4"], "returns": "rclcpp_action::Server"},
    {"call": "rclcpp_action::create_server", "args": [8, 9, 10],
     "makes": [{"kind": "action_servers", "name": "{4}", "type": "{<0>}", "namespace": "{0}"}],
     "calls": ["5", "6", "7"], "returns": "rclcpp_action::Server"},
    {"call": "rclcpp_action::create_client", "args": [2, 3, 4],
     "makes": [{"kind": "action_clients", "name": "{1}", "type": "{<0>}", "namespace": "{0}"}],
     "returns": "rclcpp_action::Client"},
    {"call": "rclcpp_action::create_client", "args": [5, 6, 7],
     "makes": [{"kind": "action_clients", "name": "{4}", "type": "{<0>}", "namespace": "{0}"}],
     "returns": "rclcpp_action::Client"},
    {"call": "rclcpp_action::Client::async_send_goal", "args": [1, 2]},

    # rclcpp/node.hpp, rclcpp/create_timer.hpp, rclcpp/timer.hpp
    {"call": "rclcpp::Node::create_wall_timer", "args": [2, 3, 4], "makes": [{"kind": "timer", "period": "{0}"}],
     "calls": ["1"], "returns": "rclcpp::TimerBase"},
    {"call": "rclcpp::Node::create_timer", "args": [2, 3, 4], "makes": [{"kind": "timer", "period": "{0}"}],
     "calls": ["1"], "returns": "rclcpp::TimerBase"},
    {"call": "rclcpp::create_timer", "args": [4, 5, 6, 7], "makes": [{"kind": "timer"}], "calls": ["2", "3", "4"],
     "returns": "rclcpp::TimerBase"},
    {"call": "rclcpp::create_wall_timer", "args": [5, 6], "makes": [{"kind": "timer", "period": "{0}"}],
     "calls": ["1"], "returns": "rclcpp::TimerBase"},
    {"call": "rclcpp::GenericTimer", "args": [4, 5], "makes": [{"kind": "timer", "period": "{1}"}], "calls": ["2"]},
    {"call": "rclcpp::WallTimer", "args": [3, 4], "makes": [{"kind": "timer", "period": "{0}"}], "calls": ["1"]},
    {"call": "rclcpp::GenericTimer::make_shared", "args": [4, 5], "makes": [{"kind": "timer", "period": "{1}"}],
     "calls": ["2"], "returns": "rclcpp::TimerBase"},
    {"call": "rclcpp::WallTimer::make_shared", "args": [3, 4], "makes": [{"kind": "timer", "period": "{0}"}],
     "calls": ["1"], "returns": "rclcpp::TimerBase"},
)
