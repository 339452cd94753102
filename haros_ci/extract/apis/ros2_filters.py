# SPDX-License-Identifier: Apache-2.0
"""Message filters (ROS 2, C++): subscribers that feed caches, sequencers, synchronisers and transform filters."""

from __future__ import annotations

from collections.abc import Mapping

from haros_ci.extract.apis.ros2_endpoints import events

SIMPLE = "message_filters::SimpleFilter"
# fmt: off
ROWS: tuple[Mapping[str, object], ...] = (
    # message_filters/subscriber.hpp: a node by pointer, a topic, the quality of service (also as rmw_qos_profile_t),
    # options. subscribe() without arguments subscribes again to the same topic: it makes nothing new.
    {"class": "message_filters::Subscriber", "bases": [SIMPLE]},
    {"call": "message_filters::Subscriber", "args": [2, 3, 4],
     "makes": [{"kind": "subscribers", "name": "{1}", "type": "{<0>}", "qos": "{2?rmw_qos_profile_default}",
                "options": "{3}", "namespace": "{0}"}],
     "calls": events(3)},
    {"call": "message_filters::Subscriber::subscribe", "args": [0]},
    {"call": "message_filters::Subscriber::unsubscribe", "args": [0]},
    {"call": "message_filters::Subscriber::subscribe", "args": [2, 3, 4],
     "makes": [{"kind": "subscribers", "name": "{1}", "type": "{this<0>}", "qos": "{2?rmw_qos_profile_default}",
                "options": "{3}", "namespace": "{0}"}],
     "calls": events(3)},

    # message_filters/simple_filter.hpp: with a function, or a method and its object.
    {"call": f"{SIMPLE}::registerCallback", "args": [1, 2], "calls": ["0"],
     "returns": "message_filters::Connection"},

    # message_filters/cache.hpp, chain.hpp, pass_through.hpp, time_sequencer.hpp, input_aligner.hpp
    *({"class": f"message_filters::{name}", "bases": [SIMPLE]}
      for name in ("Cache", "Chain", "PassThrough", "TimeSequencer")),
    {"call": "message_filters::InputAligner::registerCallback", "args": [1, 2, 3], "calls": ["0", "1"],
     "returns": "message_filters::Connection"},

    # message_filters/synchronizer.hpp, time_synchronizer.hpp
    {"class": "message_filters::TimeSynchronizer", "bases": ["message_filters::Synchronizer"]},
    {"call": "message_filters::Synchronizer::registerCallback", "args": [1, 2], "calls": ["0"],
     "returns": "message_filters::Connection"},
    {"call": "message_filters::Synchronizer::connectInput", "args": [1, 2, 3, 4, 5, 6, 7, 8, 9]},
    *({"call": f"message_filters::Synchronizer::{name}", "args": [1]}
      for name in ("setMaxIntervalDuration", "setAgePenalty", "setInterMessageLowerBound", "setName")),

    # tf2_ros/message_filter.h
    {"class": "tf2_ros::MessageFilter", "bases": ["tf2_ros::MessageFilterBase", SIMPLE]},
    {"call": "tf2_ros::MessageFilter::registerFailureCallback", "args": [1], "calls": ["0"],
     "returns": "message_filters::Connection"},
    *({"call": f"tf2_ros::MessageFilter::{name}", "args": [1]}
      for name in ("connectInput", "setTargetFrame", "setTargetFrames", "setTolerance")),
)
