# SPDX-License-Identifier: Apache-2.0
"""A system of ROS 1 under test: a master of its own on loopback, the nodes that a launch file starts, and the topics of the tests.

Nothing is started but rosmaster and those nodes. Where tests run under rostest (``PROPERTY_TESTS_ATTACH``) nothing is started at all.
"""

from __future__ import annotations

import os
import shutil
import socket
import sys
import tempfile
import time
import xmlrpc.client
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from haros_ci.test_files.property_tests.processes import Processes
from haros_ci.test_files.property_tests.ros1_messages import class_of, filled, plain
from haros_ci.test_files.property_tests.trials import Driver, NotReady

#: Where Debian keeps rospy; it is looked at last.
DEBIAN = "/usr/lib/python3/dist-packages"
#: Seconds that nodes and their edges have to come.
PATIENCE = 20.0
NAME = "property_tests"
ATTACH = "PROPERTY_TESTS_ATTACH"


class Launch(NamedTuple):
    """A launch file in its package, with arguments as roslaunch takes them."""

    package: str
    path: str
    arguments: Sequence[str] = ()


class Edge(NamedTuple):
    """*node* (the name of its process) subscribes to *topic*, or (*publishes*) publishes on it."""

    node: str
    topic: str
    publishes: bool


class Start(NamedTuple):
    """How a node is started: its *name*, the *command* and what it needs in its environment."""

    name: str
    command: Sequence[str]
    env: Mapping[str, str]


class Plan(NamedTuple):
    """What launch files come to: *parameters* with their values, and the *nodes* to start."""

    parameters: Sequence[tuple[str, Any]]
    nodes: Sequence[Start]


class Ros1(Driver):
    """*nodes* of the launch files: () for all. *inputs* are the topics on which the tests publish, *outputs* those that they watch, with types.

    rospy knows one master and one node in a process, so that drivers share them; the nodes of one driver at a time are up.
    """

    ros: _Ros | None = None
    active: Ros1 | None = None
    latest: Ros1 | None = None
    processes = Processes()

    def __init__(
        self,
        launches: Sequence[Launch],
        nodes: Sequence[str],
        inputs: dict[str, str],
        outputs: dict[str, str],
        edges: Sequence[Edge],
    ) -> None:
        self.launches, self.nodes, self.edges = launches, nodes, edges
        self.inputs, self.outputs = inputs, outputs
        self.restarts = ATTACH not in os.environ
        self.plan: Plan | None = None
        self.take: Callable[[str, Any], None] | None = None
        self.came = 0.0
        self.publishers: dict[str, Any] = {}
        self.subscribers: list[Any] = []

    @property
    def running(self) -> bool:
        return Ros1.active is self

    def start(self) -> None:
        if Ros1.ros is None:
            Ros1.ros = _Ros(self.processes if self.restarts else None)
        if Ros1.active is not None:
            Ros1.active.stop()
        if Ros1.latest is not None and Ros1.latest is not self:
            Ros1.latest.close()
        Ros1.latest = self
        if not self.publishers and not self.subscribers:
            self.subscribers = [Ros1.ros.subscribe(topic, kind, self._came) for topic, kind in self.outputs.items()]
            self.publishers = {topic: Ros1.ros.publisher(topic, kind) for topic, kind in self.inputs.items()}
        if self.restarts:
            if self.plan is None:
                self.plan = Ros1.ros.plan(self.launches, self.nodes)
            Ros1.ros.launch(self.processes, self.plan)
        Ros1.ros.wait_for(self.edges, self.ended)
        Ros1.active = self

    def stop(self) -> None:
        """End the nodes; the master stays."""
        names = [name for name in self.processes.running if name != _MASTER]
        self.processes.end(names)
        if Ros1.ros is not None:
            for name in names:
                Ros1.ros.forget(name)
        Ros1.active = None

    def close(self) -> None:
        """Leave the topics, for the driver of other tests."""
        for end in (*self.publishers.values(), *self.subscribers):
            end.unregister()
        self.publishers, self.subscribers = {}, []

    def _came(self, topic: str, message: Any) -> None:
        self.came = time.monotonic()
        take = self.take
        if take is not None:
            take(topic, message)

    def reset(self) -> bool:
        try:
            from hooks import reset  # type: ignore[import-not-found]  # a file of the team's own, beside the tests
        except ImportError:
            return False
        reset(self)
        return True

    def send(self, topic: str, message: Any) -> None:
        publisher = self.publishers[topic]
        publisher.publish(filled(publisher.data_class, message))

    def listen(self, take: Callable[[str, Any], None] | None) -> None:
        self.take = take

    def last(self) -> float:
        return self.came

    def ended(self) -> list[str]:
        return self.processes.ended()


_MASTER = "the master"


class _Ros:
    """rospy, and the master that it talks to. With *processes* the master is started here."""

    def __init__(self, processes: Processes | None) -> None:
        self.folder = tempfile.mkdtemp(prefix="property_tests_")
        self.output = os.path.join(self.folder, "output.log")
        self.env = _environment()
        if processes is not None:
            port = _free_port()
            local = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1", "ROS_LOG_DIR": self.folder}
            for env in (self.env, os.environ):
                env.update(local)
                env.pop("ROS_HOSTNAME", None)
            rosmaster = shutil.which("rosmaster")
            if rosmaster is None:
                raise NotReady("there is no rosmaster; source the setup file of ROS 1, or install python3-rosmaster")
            processes.start(_MASTER, [rosmaster, "--core", "-p", str(port)], self.env, self.output)
        self.uri = os.environ["ROS_MASTER_URI"]
        self.master: Any = xmlrpc.client.ServerProxy(self.uri)
        self.rospy = _rospy()  # while the master comes up
        self._wait_for_master()
        self.rospy.init_node(NAME, anonymous=True, disable_signals=True, disable_rosout=True)
        self.name: str = self.rospy.get_name()
        self.own = self.call("lookupNode", self.name)

    def call(self, method: str, *arguments: Any) -> Any:
        """Ask the master; None where it has nothing to say."""
        code, _, value = getattr(self.master, method)(f"/{NAME}", *arguments)
        return value if code == 1 else None

    def _wait_for_master(self) -> None:
        until = time.monotonic() + PATIENCE
        while True:
            try:
                self.call("getPid")
                return
            except OSError as err:
                if time.monotonic() > until:
                    raise NotReady(f"no master at {self.uri}") from err
                time.sleep(0.02)

    def subscribe(self, topic: str, kind: str, came: Callable[[str, Any], None]) -> Any:
        return self.rospy.Subscriber(
            topic, class_of(kind), lambda message: came(topic, plain(message)), queue_size=1000, tcp_nodelay=True
        )

    def publisher(self, topic: str, kind: str) -> Any:
        return self.rospy.Publisher(topic, class_of(kind), queue_size=1000, tcp_nodelay=True)

    def launch(self, processes: Processes, plan: Plan) -> None:
        """Set the parameters of the launch files anew, and start their nodes, or only those of *plan*."""
        for name in self.call("getParamNames") or ():
            self.call("deleteParam", name)
        for key, value in plan.parameters:
            self.call("setParam", key, value)
        for start in plan.nodes:
            processes.start(start.name, start.command, {**self.env, **start.env}, self.output)

    def plan(self, launches: Sequence[Launch], nodes: Sequence[str]) -> Plan:
        """What roslaunch makes of the launch files, of all nodes or only these; it asks catkin for each program, which takes longer than the rest."""
        from roslaunch.config import load_config_default
        from roslaunch.node_args import create_local_process_args

        files = [(_file_of(item), list(item.arguments)) for item in launches]
        config = load_config_default(files, int(self.uri.rpartition(":")[2].strip("/")))
        found = []
        for node in config.nodes:
            name = f"{node.namespace}{node.name}"
            if nodes and name not in nodes:
                continue
            there = node.machine
            if there is not None and there.name and there.address not in ("localhost", "127.0.0.1", ""):
                raise NotReady(f"{name} is for another machine, {there.address}")
            env = {"ROS_NAMESPACE": node.namespace.rstrip("/") or "/", **dict(node.env_args)}
            found.append(Start(name, tuple(create_local_process_args(node, there)), env))
        if not found:
            raise NotReady(f"the launch file starts none of {', '.join(nodes) or 'its nodes'}")
        return Plan(tuple((key, parameter.value) for key, parameter in config.params.items()), tuple(found))

    def forget(self, node: str) -> None:
        """Take what a node that has been ended has left out of the master's tables."""
        uri = self.call("lookupNode", node)
        if uri is None:
            return
        for table, method in zip(
            self.call("getSystemState") or (), ("unregisterPublisher", "unregisterSubscriber", "unregisterService")
        ):
            for name, users in table:
                if node in users:
                    address = uri if method != "unregisterService" else self.call("lookupService", name)
                    getattr(self.master, method)(node, name, address or "")

    def wait_for(self, edges: Sequence[Edge], ended: Callable[[], list[str]]) -> None:
        """Wait until every edge is there in both directions, as both ends of it say."""
        until = time.monotonic() + PATIENCE
        missing = list(edges)
        while True:
            dead = ended()
            if dead:
                raise NotReady(f"{'; '.join(dead)}{self._tail()}")
            missing = self._missing(missing)
            if not missing:
                return
            if time.monotonic() > until:
                shown = ", ".join(
                    f"{edge.node} {'publishes' if edge.publishes else 'subscribes to'} {edge.topic}" for edge in missing
                )
                raise NotReady(f"not so after {PATIENCE:.0f} s: {shown}{self._tail()}")
            time.sleep(0.01)

    def _missing(self, edges: Sequence[Edge]) -> list[Edge]:
        us = frozenset((self.name, self.own.rstrip("/")))
        ours = _links(self.own)
        uris = {node: self.call("lookupNode", node) for node in {edge.node for edge in edges}}
        theirs = {node: [] if uri is None else _links(uri) for node, uri in uris.items()}
        return [
            edge
            for edge in edges
            if uris[edge.node] is None
            or not _is_up(edge, theirs[edge.node], us, ours, frozenset((edge.node, uris[edge.node].rstrip("/"))))
        ]

    def _tail(self) -> str:
        """The last lines that processes have printed."""
        try:
            with open(self.output, encoding="utf-8", errors="replace") as file:
                last = file.read()[-2000:].strip()
        except OSError:
            return ""
        return f"\n{last}" if last else ""


def _file_of(item: Launch) -> str:
    import rospkg

    try:
        path: str = os.path.join(rospkg.RosPack().get_path(item.package), item.path)
    except rospkg.ResourceNotFound as err:
        raise NotReady(f"there is no package {item.package}: source the setup file of the built workspace") from err
    if not os.path.isfile(path):
        raise NotReady(f"{item.package} has no {item.path}: is this the workspace that was built?")
    return path


def _links(uri: str) -> list[tuple[str, str, str]]:
    """The links that a node says that it has: direction (``i``, ``o``), topic, and the name or address of the other end."""
    try:
        node: Any = xmlrpc.client.ServerProxy(uri)
        code, _, links = node.getBusInfo(f"/{NAME}")
    except (OSError, xmlrpc.client.Error):
        return []
    return [
        (str(link[2]), str(link[4]), str(link[1]).rstrip("/"))
        for link in links
        if code == 1 and len(link) > 5 and link[5]
    ]


def _is_up(
    edge: Edge,
    theirs: list[tuple[str, str, str]],
    us: frozenset[str],
    ours: list[tuple[str, str, str]],
    them: frozenset[str],
) -> bool:
    """An edge is up if the node has its link to us, and we have the one to it: what is published before is lost."""
    direction, opposite = ("o", "i") if edge.publishes else ("i", "o")
    there = any(way == direction and topic == edge.topic and other in us for way, topic, other in theirs)
    here = any(way == opposite and topic == edge.topic and other in them for way, topic, other in ours)
    return there and here


def _environment() -> dict[str, str]:
    """The environment of nodes. Where rospy is Debian's and this Python is another one, nodes in Python find it, too."""
    env = dict(os.environ)
    if os.path.isdir(os.path.join(DEBIAN, "rospy")) and DEBIAN not in env.get("PYTHONPATH", ""):
        env["PYTHONPATH"] = os.pathsep.join(filter(None, (env.get("PYTHONPATH"), DEBIAN)))
    return env


def _rospy() -> Any:
    try:
        import rospy
    except ImportError:
        sys.path.append(DEBIAN)
        import rospy
    return rospy


def _free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])
