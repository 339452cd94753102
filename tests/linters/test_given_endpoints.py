# SPDX-License-Identifier: Apache-2.0
"""Calls of ROS that something is given to call are named where a change brings them."""

from __future__ import annotations

from pathlib import Path

import pytest
from linter_samples import workspace

from haros_ci.linters.given_endpoints import given_in_cpp, given_in_python, notifications

FIRES = [
    "Thread(target=self.create_subscription, args=(String, 'words', self.heard, 10)).start()\n",
    "pool.submit(node.create_publisher, String, 'words', 10)\n",
    "list(map(self.create_client, types, names))\n",
    "run([self.create_service])\n",
    "run({'make': self.create_timer})\n",
    "import rospy\nThread(target=rospy.Subscriber, args=('words', String, heard))\n",
    "from rospy import Publisher as P\nrun(P, 'words')\n",
    "import rospy as r\nrun(r.Timer)\n",
    "from rclpy.action import ActionServer\nrun(ActionServer, node)\n",
    "operator.methodcaller('create_subscription', String, 'words', heard, 10)(self)\n",
    "operator.attrgetter('create_publisher')(self)(String, 'words', 10)\n",
    "vars(Node)['create_client'](self, Say, 'say')\n",
    "Node.__dict__['create_client'](self, Say, 'say')\n",
    "self.create_subscription.__call__(String, 'words', heard, 10)\n",
    "self.__getattribute__('create_service')(Say, 'say', heard)\n",
    "super().__getattribute__('create_timer')(1, heard)\n",
]
QUIET = [
    "getattr(self, 'create_subscription')(String, 'words', heard, 10)\n",
    "log.info('create_subscription')\nprint({'create_publisher': 1}['create_publisher'])\n",
    "operator.attrgetter('name')(node.create_subscription(String, 'a', f, 1))\n",
    "vars(Node)['name']\nNode.__dict__['create_all']\n",
    "self.create_subscription.__doc__\nself.heard.__call__(1)\n",
    "calls['create_subscription'] = 1\nprint(self.create_subscription.__name__)\n",
    "self.create_subscription(String, 'words', self.heard, 10)\n",
    "make = self.create_subscription\nmake(String, 'words', self.heard, 10)\n",
    "partial(self.create_subscription, String)('words', self.heard, 10)\n",
    "functools.partial(self.create_subscription, String)\n",
    "hasattr(node, create_subscription)\n",
    "patch.object(Node, Node.create_publisher)\n",
    "run(self.create_subscription(String, 'words', self.heard, 10))\n",
    "run(self.create_subscriptions)\n",
    "# Thread(target=self.create_subscription)\n",
    "from other import Publisher\nrun(Publisher)\n",
    "import rospy\nrun(rospy.get_param, rospy.Time)\nx: rospy.Publisher\n",
    "isinstance(x, rospy.Publisher)\n",
    "def f(x=self.create_timer): pass\n",
]
CPP = {
    "std::thread(&rclcpp::Node::create_wall_timer, this);\n": True,
    "auto f = std::bind(&rclcpp::Node::create_publisher<M>, node, _1);\n": True,
    "std::async(&ros::NodeHandle::subscribe, &nh);\n": True,
    "std::async(&Arm::create_client, this);\n": True,
    'nh.subscribe("words", 1, &Arm::heard, this);\n': False,
    "std::bind(&Broker::subscribe, this);\n": False,
    "// std::async(&ros::NodeHandle::subscribe, &nh);\n": False,
    "x & rclcpp::Node::create_publishers;\n": False,
    'auto & p = node.create_publisher<M>("words", 1);\n': False,
}


@pytest.mark.parametrize("text", FIRES)
def test_fires(text: str) -> None:
    assert len(set(given_in_python(text))) == 1


@pytest.mark.parametrize("text", QUIET)
def test_stays_quiet(text: str) -> None:
    assert list(given_in_python(text)) == []


@pytest.mark.parametrize("text", CPP)
def test_in_cpp(text: str) -> None:
    assert bool(list(given_in_cpp(text))) is CPP[text]


def test_what_a_change_brings(tmp_path: Path) -> None:
    def said(base: dict[str, str], head: dict[str, str]) -> list[str | None]:
        places = [workspace(tmp_path / side / str(len(head)), files) for side, files in (("b", base), ("h", head))]
        return [note.path for note in notifications(places[1], places[0])]

    text = FIRES[0]
    assert said({"a.py": "x = 1\n"}, {"a.py": text}) == ["a.py"]
    assert said({"a.py": text}, {"a.py": "x = 1\n" + text}) == []
    assert said({"a.py": "x = 1\n"}, {"test/test_a.py": text, "a.py": "x = 1\n"}) == []
    assert notifications(workspace(tmp_path / "w", {"a.py": text}), None) == ()
