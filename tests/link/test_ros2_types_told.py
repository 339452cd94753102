# SPDX-License-Identifier: Apache-2.0
"""rclpy: the type of a parameter that is set is what ``Parameter(name, Parameter.Type.X, value)`` says, whatever the value is."""

from __future__ import annotations

import pytest
from follow_kit import explicit, follow

from haros_ci.model.architecture import Endpoint

HEAD = "import rclpy\nfrom rclpy.node import Node\nfrom rclpy.parameter import Parameter\nfrom other import x\n"
PROGRAM = """
class N(Node):
    def __init__(self):
        super().__init__("n")
        %s
def main():
    rclpy.init()
    rclpy.spin(N())
"""


def setter(body: str) -> Endpoint:
    setup = "from setuptools import setup\nsetup(name='p', packages=['p'],\n"
    files = {
        "p/setup.py": setup + "    entry_points={'console_scripts': ['n = p.n:main']})\n",
        "p/p/__init__.py": "",
        "p/p/n.py": HEAD + PROGRAM % body.replace("\n", "\n        "),
    }
    (found,) = explicit(follow(files, 2).configurations[0].nodes[0], "setters")
    return found


@pytest.mark.parametrize("call", ["set_parameters", "set_parameters_atomically"])
@pytest.mark.parametrize(
    ("parameter", "kind", "value"),
    [
        ("Parameter('a', Parameter.Type.INTEGER, x())", "int", None),
        ("Parameter('a', rclpy.Parameter.Type.DOUBLE, x())", "double", None),
        ("rclpy.parameter.Parameter('a', rclpy.parameter.Parameter.Type.STRING, x())", "str", None),
        ("Parameter(name='a', type_=Parameter.Type.BOOL, value=x())", "bool", None),
        ("Parameter('a', type_=Parameter.Type.STRING_ARRAY, value=[x()])", "str[]", None),
        ("Parameter('a', Parameter.Type.INTEGER, 3)", "int", 3),
        ("Parameter('a', Parameter.Type.DOUBLE, 3.0)", "double", 3.0),
        ("Parameter('a', value=2.5)", "double", 2.5),
    ],
)
def test_types(call: str, parameter: str, kind: str, value: object) -> None:
    for body in (f"self.{call}([{parameter}])", f"made = {parameter}\nevery = [made]\nself.{call}(every)"):
        found = setter(body)
        assert (found.name, found.type, found.value) == ("/n:a", kind, value)
        assert all(unknown.field != "type" for unknown in found.unknowns)


@pytest.mark.parametrize(
    "parameter",
    ["Parameter('a', value=x())", "Parameter('a', x(), x())", "Parameter('a', Parameter.Type.NOT_SET, x())", "x('a')"],
)
def test_types_that_are_not_known(parameter: str) -> None:
    found = setter(f"self.set_parameters([{parameter}])")
    assert found.type is None
    assert "type" in {unknown.field for unknown in found.unknowns}
