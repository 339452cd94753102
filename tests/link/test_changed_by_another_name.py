# SPDX-License-Identifier: Apache-2.0
"""Functions that make nothing, and change something of others by a variable of their own: they are followed, or what they change is not known."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names, python

PYTHON = """
class Box:
    pass
g = ["a"]
d = {{"k": ["a"]}}
class A:
    def __init__(self):
        self.names = ["a"]
        self.table = {{"k": "a"}}
        self.lists = [["a"], ["a"]]
        self.box = Box()
        self.box.inner = ["a"]
        self.change()
        rospy.Subscriber("x", String, self.heard)
    def change(self):
        {}
    def heard(self, m):
        rospy.Publisher({}, String, queue_size=1)
A()
"""


@pytest.mark.parametrize(
    ("change", "used"),
    [
        ("v = self.names; v[0] = 'b'", "self.names[0]"),
        ("v = self.names; v.clear(); v.append('b')", "self.names[0]"),
        ("v = self.names; w = v; w[0] = 'b'", "self.names[0]"),
        ("v = self.table; v['k'] = 'b'", "self.table['k']"),
        ("v = self.table; v.update(k='b')", "self.table['k']"),
        ("v = self.lists[0]; v[0] = 'b'", "self.lists[0][0]"),
        ("v = self.box.inner; v[0] = 'b'", "self.box.inner[0]"),
        ("v = g; v[0] = 'b'", "g[0]"),
        ("v = d['k']; v[0] = 'b'", "d['k'][0]"),
        ("for v in self.lists: v[0] = 'b'", "self.lists[1][0]"),
    ],
)
def test_what_is_changed_by_another_name_is_changed(change: str, used: str) -> None:
    assert names(python(PYTHON.format(change, used))) == ["/b"]


@pytest.mark.parametrize(
    ("change", "used"),
    [
        ("v = self.names; v = ['b']", "self.names[0]"),
        ("v = list(self.names); v[0] = 'b'", "self.names[0]"),
        ("v = self.names[:]; v[0] = 'b'", "self.names[0]"),
        ("v = self.table.copy(); v['k'] = 'b'", "self.table['k']"),
        ("v = dict(self.table); v['k'] = 'b'", "self.table['k']"),
        ("v = self.names; len(v)", "self.names[0]"),
        ("v = self.names; x = v[0] + 'b'", "self.names[0]"),
        ("v = sorted(g); v.append('b')", "g[0]"),
        ("v = g; v += []", "g[0]"),
        ("names = ['b']; names.append('c')", "self.names[0]"),
    ],
)
def test_what_is_not_keeps_what_it_has(change: str, used: str) -> None:
    assert names(python(PYTHON.format(change, used))) == ["/a"]


CPP = 'struct A {{ std::vector<std::string> names_{{"a"}}; void change() {{ {} }} }};\nstd::map<std::string, std::string> table{{{{"k", "a"}}}};\n'


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ('auto & v = names_; v[0] = "b";', "/b"),
        ('std::vector<std::string> & v = names_; v.clear(); v.push_back("b");', "/b"),
        ('for (auto & v : names_) v = "b";', "/b"),
        ('auto v = names_; v[0] = "b";', "/a"),
        ("const auto & v = names_; v.size();", "/a"),
        ('for (auto v : names_) v = "b";', "/a"),
    ],
)
def test_references_of_cpp(change: str, expected: str) -> None:
    made = "A a; a.change(); nh.advertise<std_msgs::String>(a.names_[0], 1);"
    assert names(cpp(made, "#include <map>\n#include <vector>\n" + CPP.format(change))) == [expected]
