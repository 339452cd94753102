# SPDX-License-Identifier: Apache-2.0
"""roscpp (ROS 1, C++): node handles, topics, services, parameters, timers, names."""

from __future__ import annotations

# fmt: off
ROWS: tuple[dict[str, object], ...] = (
    # ros/init.h, wiki.ros.org/roscpp/Overview/Initialization and Shutdown: three forms, the name is text in each.
    # Flags without ros::init_options::AnonymousName do not make a name anonymous.
    {"call": "ros::init", "args": [2], "makes": [{"kind": "node", "name": "{1}", "anonymous": False}]},
    {"call": "ros::init", "args": [3], "when": {"2": "string"},
     "makes": [{"kind": "node", "name": "{2}", "anonymous": False}]},
    {"call": "ros::init", "args": [3], "when": {"1": "string", "2": "int"},
     "makes": [{"kind": "node", "name": "{1}", "anonymous": "{2}"}]},
    {"call": "ros::init", "args": [3], "makes": [{"kind": "node", "name": "{2}", "anonymous": False}]},
    {"call": "ros::init", "args": [4], "makes": [{"kind": "node", "name": "{2}", "anonymous": "{3}"}]},

    # ros/node_handle.h, wiki.ros.org/roscpp/Overview/NodeHandles. A handle with remappings of its own (M_string) has
    # no row: what its names are mapped to is not known.
    {"call": "ros::NodeHandle", "args": [0], "makes": [{"kind": "handle"}]},
    {"call": "ros::NodeHandle", "args": [1], "when": {"0": "ros::NodeHandle"},
     "makes": [{"kind": "handle", "parent": "{0}"}]},
    {"call": "ros::NodeHandle", "args": [1], "makes": [{"kind": "handle", "namespace": "{0}"}]},
    {"call": "ros::NodeHandle", "args": [2], "when": {"0": "ros::NodeHandle"},
     "makes": [{"kind": "handle", "parent": "{0}", "namespace": "{1}"}]},
    {"call": "ros::NodeHandle::getNamespace", "args": [0], "returns": "{this.namespace}"},
    {"call": "ros::NodeHandle::resolveName", "args": [1, 2], "returns": "{resolve(0,1)}"},

    # ros/node_handle.h: advertise. Three arguments are a latch or a callback, six end in the latch.
    {"call": "ros::NodeHandle::advertise", "args": [1],
     "makes": [{"kind": "publishers", "name": "{0.topic}", "type": "{0.datatype}", "queue_size": "{0.queue_size}",
                "latched": "{0.latch}"}],
     "returns": "ros::Publisher", "fills": {"topic": "{resolve(0.topic)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [2],
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": False}],
     "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [3], "when": {"2": "function"},
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": False}],
     "calls": ["2"], "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [3], "when": {"2": "ros::SubscriberStatusCallback"},
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": False}],
     "calls": ["2"], "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [3],
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": "{2}"}],
     "calls": ["2"], "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [4, 5],
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": False}],
     "calls": ["2", "3"], "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertise", "args": [6],
     "makes": [{"kind": "publishers", "name": "{0}", "type": "{<0>}", "queue_size": "{1}", "latched": "{5}"}],
     "calls": ["2", "3"], "returns": "ros::Publisher", "fills": {"topic": "{resolve(0)}"}},

    # ros/publisher.h, subscriber.h, service_server.h, service_client.h: the resolved name.
    {"call": "ros::Publisher::getTopic", "args": [0], "returns": "{this.topic}"},
    {"call": "ros::Subscriber::getTopic", "args": [0], "returns": "{this.topic}"},
    {"call": "ros::ServiceServer::getService", "args": [0], "returns": "{this.service}"},
    {"call": "ros::ServiceClient::getService", "args": [0], "returns": "{this.service}"},

    # ros/advertise_options.h
    {"call": "ros::AdvertiseOptions", "args": [0], "fills": {"latch": "false"}},
    {"call": "ros::AdvertiseOptions", "args": [5, 6, 7],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{3}", "latch": "false"}, "calls": ["5", "6"]},
    {"call": "ros::AdvertiseOptions::init", "args": [2, 3, 4],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{<0>}"}, "calls": ["2", "3"]},
    {"call": "ros::AdvertiseOptions::create", "args": [6],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{<0>}", "latch": "false"}, "calls": ["2", "3"],
     "returns": "ros::AdvertiseOptions"},

    # ros/node_handle.h: subscribe with a function, a method and its object, a boost::function, with or without hints.
    {"call": "ros::NodeHandle::subscribe", "args": [1],
     "makes": [{"kind": "subscribers", "name": "{0.topic}", "type": "{0.datatype}", "queue_size": "{0.queue_size}"}],
     "returns": "ros::Subscriber", "fills": {"topic": "{resolve(0.topic)}"}},
    {"call": "ros::NodeHandle::subscribe", "args": [3, 4, 5],
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{<0>|callback(2)}", "queue_size": "{1}"}],
     "calls": ["2"], "returns": "ros::Subscriber", "fills": {"topic": "{resolve(0)}"}},

    # ros/subscribe_options.h
    {"call": "ros::SubscribeOptions", "args": [0], "fills": {"queue_size": "1"}},
    {"call": "ros::SubscribeOptions", "args": [4],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{3}"}},
    {"call": "ros::SubscribeOptions::init", "args": [3, 4],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{<0>}"}, "calls": ["2"]},
    {"call": "ros::SubscribeOptions::initByFullCallbackType", "args": [3, 4],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{<0>|callback(2)}"}, "calls": ["2"]},
    {"call": "ros::SubscribeOptions::create", "args": [5],
     "fills": {"topic": "{0}", "queue_size": "{1}", "datatype": "{<0>}"}, "calls": ["2"],
     "returns": "ros::SubscribeOptions"},

    # ros/topic.h: subscribes with a queue of one while it waits.
    {"call": "ros::topic::waitForMessage", "args": [2, 3], "when": {"1": "ros::NodeHandle"},
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{<0>}", "queue_size": 1, "namespace": "{1}"}],
     "returns": "{<0>}"},
    {"call": "ros::topic::waitForMessage", "args": [2], "when": {"1": "ros::Duration"},
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{<0>}", "queue_size": 1}],
     "returns": "{<0>}"},
    {"call": "ros::topic::waitForMessage", "args": [1],
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{<0>}", "queue_size": 1}],
     "returns": "{<0>}"},
    {"call": "ros::topic::waitForMessage", "args": [2, 3],
     "makes": [{"kind": "subscribers", "name": "{0}", "type": "{<0>}", "queue_size": 1, "namespace": "{1}"}],
     "returns": "{<0>}"},

    # ros/node_handle.h: advertiseService. With three arguments the first template argument may be the object's class.
    {"call": "ros::NodeHandle::advertiseService", "args": [1],
     "makes": [{"kind": "servers", "name": "{0.service}", "type": "{0.datatype}"}],
     "returns": "ros::ServiceServer", "fills": {"service": "{resolve(0.service)}"}},
    {"call": "ros::NodeHandle::advertiseService", "args": [2],
     "makes": [{"kind": "servers", "name": "{0}", "type": "{<0>|callback(1)}"}],
     "calls": ["1"], "returns": "ros::ServiceServer", "fills": {"service": "{resolve(0)}"}},
    {"call": "ros::NodeHandle::advertiseService", "args": [3],
     "makes": [{"kind": "servers", "name": "{0}", "type": "{callback(1)}"}],
     "calls": ["1"], "returns": "ros::ServiceServer", "fills": {"service": "{resolve(0)}"}},

    # ros/advertise_service_options.h; a Spec is a type of callback, such as ros::ServiceEvent.
    {"call": "ros::AdvertiseServiceOptions::init", "args": [2],
     "fills": {"service": "{0}", "datatype": "{<0>|callback(1)}"}, "calls": ["1"]},
    {"call": "ros::AdvertiseServiceOptions::initBySpecType", "args": [2],
     "fills": {"service": "{0}", "datatype": "{callback(1)}"}, "calls": ["1"]},
    {"call": "ros::AdvertiseServiceOptions::create", "args": [4],
     "fills": {"service": "{0}", "datatype": "{<0>}"}, "calls": ["1"], "returns": "ros::AdvertiseServiceOptions"},

    # ros/node_handle.h: serviceClient<Service> and serviceClient<Request, Response>
    {"call": "ros::NodeHandle::serviceClient", "args": [1], "when": {"0": "ros::ServiceClientOptions"},
     "makes": [{"kind": "clients", "name": "{0.service}", "type": "{0.datatype}"}],
     "returns": "ros::ServiceClient", "fills": {"service": "{resolve(0.service)}"}},
    {"call": "ros::NodeHandle::serviceClient", "args": [1, 2, 3],
     "makes": [{"kind": "clients", "name": "{0}", "type": "{<0>}"}],
     "returns": "ros::ServiceClient", "fills": {"service": "{resolve(0)}"}},

    # ros/service_client_options.h: made with a checksum, the type is not known.
    {"call": "ros::ServiceClientOptions", "args": [4], "fills": {"service": "{0}"}},
    {"call": "ros::ServiceClientOptions::init", "args": [3], "fills": {"service": "{0}", "datatype": "{<0>}"}},

    # ros/service.h: call is a client for one call; waiting and asking make no client.
    {"call": "ros::service::call", "args": [2, 3],
     "makes": [{"kind": "clients", "name": "{0}", "type": "{<0>|typename(1)}"}]},
    {"call": "ros::service::createClient", "args": [1, 2, 3],
     "makes": [{"kind": "clients", "name": "{0}", "type": "{<0>}"}],
     "returns": "ros::ServiceClient"},
    {"call": "ros::service::waitForService", "args": [1, 2]},
    {"call": "ros::service::exists", "args": [2]},

    # ros/node_handle.h, wiki.ros.org/roscpp/Overview/Parameter Server. getParamNames reads no parameter.
    {"call": "ros::NodeHandle::param", "args": [3],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1|2)}", "value": "{2}"}],
     "sets": {"1": "{parameter}"}},
    {"call": "ros::NodeHandle::param", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1)}", "value": "{1}"}],
     "returns": "{parameter}"},
    {"call": "ros::NodeHandle::getParam", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(1)}"}], "sets": {"1": "{parameter}"}},
    {"call": "ros::NodeHandle::getParamCached", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(1)}"}], "sets": {"1": "{parameter}"}},
    {"call": "ros::NodeHandle::hasParam", "args": [1], "makes": [{"kind": "getters", "name": "{0}"}]},
    {"call": "ros::NodeHandle::searchParam", "args": [2],
     "makes": [{"kind": "getters", "name": "{search(0)}"}], "sets": {"1": "{search(0)}"}},
    {"call": "ros::NodeHandle::setParam", "args": [2],
     "makes": [{"kind": "setters", "name": "{0}", "type": "{typeof(1)}", "value": "{1}"}]},
    {"call": "ros::NodeHandle::deleteParam", "args": [1], "makes": [{"kind": "setters", "name": "{0}"}]},

    # ros/param.h: names are in the node's namespace; search starts at the node's own name.
    {"call": "ros::param::param", "args": [3],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1|2)}", "value": "{2}"}],
     "sets": {"1": "{parameter}"}},
    {"call": "ros::param::param", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(<0>|1)}", "value": "{1}"}],
     "returns": "{parameter}"},
    {"call": "ros::param::get", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(1)}"}], "sets": {"1": "{parameter}"}},
    {"call": "ros::param::getCached", "args": [2],
     "makes": [{"kind": "getters", "name": "{0}", "type": "{typeof(1)}"}], "sets": {"1": "{parameter}"}},
    {"call": "ros::param::has", "args": [1], "makes": [{"kind": "getters", "name": "{0}"}]},
    {"call": "ros::param::search", "args": [2],
     "makes": [{"kind": "getters", "name": "{search(0)}", "namespace": "~"}], "sets": {"1": "{search(0)}"}},
    {"call": "ros::param::search", "args": [3],
     "makes": [{"kind": "getters", "name": "{search(1)}", "namespace": "{0}"}], "sets": {"2": "{search(1)}"}},
    {"call": "ros::param::set", "args": [2],
     "makes": [{"kind": "setters", "name": "{0}", "type": "{typeof(1)}", "value": "{1}"}]},
    {"call": "ros::param::del", "args": [1], "makes": [{"kind": "setters", "name": "{0}"}]},

    # ros/node_handle.h, ros/timer_options.h, wiki.ros.org/roscpp/Overview/Timers
    {"call": "ros::NodeHandle::createTimer", "args": [2, 3, 4, 5], "when": {"0": "ros::Rate"},
     "makes": [{"kind": "timer", "frequency": "{0.frequency}"}], "calls": ["1"], "returns": "ros::Timer"},
    {"call": "ros::NodeHandle::createTimer", "args": [2, 3, 4, 5],
     "makes": [{"kind": "timer", "period": "{0.seconds}"}], "calls": ["1"], "returns": "ros::Timer"},
    {"call": "ros::NodeHandle::createTimer", "args": [1],
     "makes": [{"kind": "timer", "period": "{0.period.seconds}"}], "returns": "ros::Timer"},
    {"call": "ros::NodeHandle::createWallTimer", "args": [2, 3, 4, 5],
     "makes": [{"kind": "timer", "period": "{0.seconds}"}], "calls": ["1"], "returns": "ros::WallTimer"},
    {"call": "ros::NodeHandle::createWallTimer", "args": [1],
     "makes": [{"kind": "timer", "period": "{0.period.seconds}"}], "returns": "ros::WallTimer"},
    {"call": "ros::NodeHandle::createSteadyTimer", "args": [2, 3, 4, 5],
     "makes": [{"kind": "timer", "period": "{0.seconds}"}], "calls": ["1"], "returns": "ros::SteadyTimer"},
    {"call": "ros::NodeHandle::createSteadyTimer", "args": [1],
     "makes": [{"kind": "timer", "period": "{0.period.seconds}"}], "returns": "ros::SteadyTimer"},
    {"call": "ros::TimerOptions", "args": [3, 4, 5], "fills": {"period": "{0}"}, "calls": ["1"]},
    {"call": "ros::WallTimerOptions", "args": [3, 4, 5], "fills": {"period": "{0}"}, "calls": ["1"]},
    {"call": "ros::SteadyTimerOptions", "args": [3, 4, 5], "fills": {"period": "{0}"}, "calls": ["1"]},

    # ros/rate.h, ros/duration.h (roscpp_core). A Duration of seconds and nanoseconds has no row.
    {"call": "ros::Rate", "args": [1], "when": {"0": "ros::Duration"},
     "makes": [{"kind": "rate", "period": "{0.seconds}"}]},
    {"call": "ros::Rate", "args": [1],
     "makes": [{"kind": "rate", "frequency": "{0}"}], "fills": {"frequency": "{0}"}},
    {"call": "ros::WallRate", "args": [1], "when": {"0": "ros::Duration"},
     "makes": [{"kind": "rate", "period": "{0.seconds}"}]},
    {"call": "ros::WallRate", "args": [1],
     "makes": [{"kind": "rate", "frequency": "{0}"}], "fills": {"frequency": "{0}"}},
    {"call": "ros::Duration", "args": [0], "fills": {"seconds": "0"}},
    {"call": "ros::Duration", "args": [1], "fills": {"seconds": "{0}"}},
    {"call": "ros::WallDuration", "args": [0], "fills": {"seconds": "0"}},
    {"call": "ros::WallDuration", "args": [1], "fills": {"seconds": "{0}"}},
    {"call": "ros::Duration::fromSec", "args": [1], "fills": {"seconds": "{0}"}},
    {"call": "ros::Duration::toSec", "args": [0], "returns": "{this.seconds}"},
    {"call": "ros::WallDuration::fromSec", "args": [1], "fills": {"seconds": "{0}"}},
    {"call": "ros::WallDuration::toSec", "args": [0], "returns": "{this.seconds}"},

    # ros/names.h, ros/this_node.h. resolve(namespace, name) has no row: the result depends on how the name begins.
    {"call": "ros::names::resolve", "args": [1], "returns": "{resolve(0)}"},
    {"call": "ros::names::resolve", "args": [2], "when": {"1": "bool"}, "returns": "{resolve(0,1)}"},
    {"call": "ros::names::remap", "args": [1], "returns": "{remap(0)}"},
    {"call": "ros::names::clean", "args": [1], "returns": "{canonical(0)}"},
    {"call": "ros::names::append", "args": [2], "returns": "{0}/{1}"},
    {"call": "ros::this_node::getName", "args": [0], "returns": "{process.name}"},
    {"call": "ros::this_node::getNamespace", "args": [0], "returns": "{process.namespace}"},
)
