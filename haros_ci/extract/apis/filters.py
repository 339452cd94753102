# SPDX-License-Identifier: Apache-2.0
"""Message filters (ROS 1, C++): subscribers that feed caches, sequencers, synchronisers and transform filters."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # message_filters/subscriber.h, wiki.ros.org/message_filters. subscribe() without arguments subscribes again to the
    # same topic: it makes nothing new.
    {"class": "message_filters::Subscriber", "bases": ["message_filters::SimpleFilter"]},
    {"call": "message_filters::Subscriber", "args": [3, 4, 5],
     "makes": [{"kind": "subscribers", "name": "{1}", "type": "{<0>}", "queue_size": "{2}", "namespace": "{0}"}]},
    {"call": "message_filters::Subscriber::subscribe", "args": [0]},
    {"call": "message_filters::Subscriber::subscribe", "args": [3, 4, 5],
     "makes": [{"kind": "subscribers", "name": "{1}", "type": "{this<0>}", "queue_size": "{2}",
                "namespace": "{0}"}]},

    # message_filters/simple_filter.h: with a function, or a method and its object.
    {"call": "message_filters::SimpleFilter::registerCallback", "args": [1, 2], "calls": ["0"],
     "returns": "message_filters::Connection"},

    # message_filters/cache.h, chain.h, pass_through.h, time_sequencer.h
    {"class": "message_filters::Cache", "bases": ["message_filters::SimpleFilter"]},
    {"class": "message_filters::Chain", "bases": ["message_filters::SimpleFilter"]},
    {"class": "message_filters::PassThrough", "bases": ["message_filters::SimpleFilter"]},
    {"class": "message_filters::TimeSequencer", "bases": ["message_filters::SimpleFilter"]},

    # message_filters/synchronizer.h, time_synchronizer.h
    {"class": "message_filters::TimeSynchronizer", "bases": ["message_filters::Synchronizer"]},
    {"call": "message_filters::Synchronizer::registerCallback", "args": [1, 2], "calls": ["0"],
     "returns": "message_filters::Connection"},

    # tf/message_filter.h, tf2_ros/message_filter.h
    {"class": "tf::MessageFilter", "bases": ["tf::MessageFilterBase", "message_filters::SimpleFilter"]},
    {"call": "tf::MessageFilter::registerFailureCallback", "args": [1], "calls": ["0"],
     "returns": "message_filters::Connection"},
    {"class": "tf2_ros::MessageFilter", "bases": ["tf2_ros::MessageFilterBase", "message_filters::SimpleFilter"]},
    {"call": "tf2_ros::MessageFilter::registerFailureCallback", "args": [1], "calls": ["0"],
     "returns": "message_filters::Connection"},

    # filters/filter_chain.h: reads the chain below the name given, and at it where there is none below.
    {"call": "filters::FilterChain::configure", "args": [1], "when": {"0": "string"},
     "makes": [{"kind": "getters", "name": "{0}/filter_chain", "type": "yaml"},
               {"kind": "getters", "name": "{0}", "type": "yaml"}]},
    {"call": "filters::FilterChain::configure", "args": [2], "when": {"1": "ros::NodeHandle"},
     "makes": [{"kind": "getters", "name": "{0}/filter_chain", "type": "yaml", "namespace": "{1}"},
               {"kind": "getters", "name": "{0}", "type": "yaml", "namespace": "{1}"}]},
    {"call": "filters::MultiChannelFilterChain::configure", "args": [2], "when": {"1": "string"},
     "makes": [{"kind": "getters", "name": "{1}/filter_chain", "type": "yaml"},
               {"kind": "getters", "name": "{1}", "type": "yaml"}]},
    {"call": "filters::MultiChannelFilterChain::configure", "args": [3], "when": {"2": "ros::NodeHandle"},
     "makes": [{"kind": "getters", "name": "{1}/filter_chain", "type": "yaml", "namespace": "{2}"},
               {"kind": "getters", "name": "{1}", "type": "yaml", "namespace": "{2}"}]},
)
