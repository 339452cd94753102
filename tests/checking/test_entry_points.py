# SPDX-License-Identifier: Apache-2.0
"""python-package-incomplete: console scripts whose line names no function, or whose text setup.py puts together."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>demo</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.cd">m</maintainer><license>MIT</license><exec_depend>rclpy</exec_depend>'
    "<export><build_type>{}</build_type></export></package>\n"
)
SETUP = """from setuptools import setup
package_name = 'demo'
{}
setup(name=package_name, packages=['demo'],
      data_files=[('share/ament_index/resource_index/packages', ['resource/demo']), ('share/demo', ['package.xml'])],
      entry_points={{'console_scripts': {}}})
"""
CFG = "[develop]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n"
FILES = {
    "setup.cfg": CFG,
    "resource/demo": "",
    "demo/__init__.py": "",
    "demo/walk.py": "def main():\n    pass\n",
    "demo/two.py": "def a():\n    pass\n\n\ndef b():\n    pass\n",
}


def messages(scripts: str, tmp_path: Path, before: str = "", build: str = "ament_python") -> list[str]:
    files = {"package.xml": MANIFEST.format(build), "setup.py": SETUP.format(before, scripts), **FILES}
    check = next(check for check in checks() if check.id == "python-package-incomplete")
    return [result.message for result in said(check, Example("", True, files), tmp_path)]


@pytest.mark.parametrize(
    ("scripts", "words"),
    [
        ("['x = demo.walk']", "names a module and no function: x fails when it is started, for a module cannot be called; write 'x = demo.walk:main'"),
        ("['x = demo.walk.main']", "names a module and no function: x fails when it is started, for a module cannot be called; write 'x = demo.walk:main'"),
        ("['x = demo.two']", "names a module and no function: x fails when it is started, for a module cannot be called"),
        ("['x = demo.walk:main()']", "is not of the form 'name = module:function': the build stops at it; write 'x = demo.walk:main'"),
        ("['x = demo/walk.py:main']", "the build stops at it; write 'x = demo.walk:main'"),
        ("['x = demo-walk.a:main']", "is not of the form 'name = module:function': the build stops at it"),
        ("['demo.walk:main']", "is not of the form 'name = module:function': the build stops at it"),
        ("['x = demo.walk:main' 'y = demo.walk:main']", "is several lines in one, as a comma is missing between them"),
        ("['x = ' + package_name + '.gone:main']", "the module demo.gone does not exist"),
        ("['x = {}.gone:main'.format(package_name)]", "the module demo.gone does not exist"),
        ("['x = %s.gone:main' % package_name]", "the module demo.gone does not exist"),
        ("['%s = %s.gone:main' % ('x', package_name)]", "the module demo.gone does not exist"),
        ("[f'{n} = demo.{n}:main' for n in ['walk', 'gone']]", "program gone of package demo cannot start"),
        ("[computed(), 'x = demo.gone:main']", "the module demo.gone does not exist"),
        ("['x = demo.walk:main'] + ['y = ' + package_name + '.gone:main']", "the module demo.gone does not exist"),
        ("['x = older_name.walk:main']", "the module older_name.walk does not exist; write demo.walk"),
    ],
)  # fmt: skip
def test_fires(scripts: str, words: str, tmp_path: Path) -> None:
    (message,) = messages(scripts, tmp_path)
    assert words in message


@pytest.mark.parametrize(
    "scripts",
    [
        "[]",
        "''",
        "['']",
        "['x = demo.walk:main']",
        "['x = demo.walk:main [extra]']",
        "['x=demo.walk:main']",
        "['x y = demo.walk:main']",
        "['x = ' + package_name + '.walk:main']",
        "['x = {}.walk:main'.format(package_name)]",
        "['x = {0}.gone:main'.format(package_name)]",
        "['x = {:s}.gone:main'.format(package_name)]",
        "['x = {}.gone:main'.format(name_of())]",
        "['x = %s.walk:main' % package_name]",
        "['x = %d.gone:main' % 1]",
        "['x = %s.gone:main' % name_of()]",
        "[f'{n} = demo.{n}:main' for n in ['walk']]",
        "[f'{n} = demo.{n}:main' for n in names()]",
        "[f'{n} = demo.{n}:main' for n in ['gone'] if wanted(n)]",
        "['x = ' + name_of()]",
        "[computed(), 'x = demo.walk:main']",
        "[*more(), 'x = demo.gone:main']",
        "more() + ['x = demo.gone:main']",
        "'''\\n# x = demo.gone\\nx = demo.walk:main\\n'''",
        "['x = json.tool:main']",
        "['x = numpy.walk:main', 'y = rclpy.walk:main']",
        "['x = elsewhere.run:main']",
        "['x = uvicorn.walk:main']",
    ],
)
def test_quiet(scripts: str, tmp_path: Path) -> None:
    assert messages(scripts, tmp_path) == []


def test_lines_that_are_appended(tmp_path: Path) -> None:
    before = "lines = ['x = demo.walk:main']\nlines.append('y = demo.walk')"
    (message,) = messages("lines", tmp_path, before)
    assert "'y = demo.walk' of package demo names a module and no function" in message


def test_what_cmake_installs_is_left_over(tmp_path: Path) -> None:
    assert messages("['x = demo.walk']", tmp_path, build="ament_cmake") == []


def test_a_module_of_what_is_required(tmp_path: Path) -> None:
    assert messages("['x = fast_tool.walk:main']", tmp_path, "requires = ['fast-tool>=1']") == []
