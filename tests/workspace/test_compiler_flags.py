# SPDX-License-Identifier: Apache-2.0
"""Flags of compilers outside of CMake's lists are recognised; usual settings of builds are none."""

from __future__ import annotations

import pytest

from haros_ci.workspace.compiler_flags import has_flags, may_have_flags

NAMES = ["CMakePresets.json", "CMakeUserPresets.json", "arm-presets.json", "colcon.pkg", "a.meta", "defaults.yaml"]
NAMES += ["colcon_defaults.yaml", ".colcon-defaults.yml", "Dockerfile", "Dockerfile.dev", "arm.dockerfile"]
OTHERS = ["package.json", "colcon.md", "params.yaml", "CMakeLists.txt", "presets.yaml", "a.metadata", "meta", "a.cpp"]
FLAGS = [
    '{"cacheVariables": {"CMAKE_CXX_FLAGS": "-include src/part.txt"}}',
    '{"environment": {"CXXFLAGS": "-O2"}}',
    '{"cmake-args": ["-DCMAKE_CXX_FLAGS=-DX"]}',
    '{"cmake-args": ["-DWITH_ARM=ON"]}',
    "build:\n  cmake-args: [-D, WITH_ARM=ON]\n  cmake-args: -DCMAKE_PROJECT_INCLUDE=part.txt\n",
    "ENV CPPFLAGS=-DX",
    "RUN g++ --include part.txt a.cpp",
    '{"CMAKE_TOOLCHAIN_FILE": "part.txt"}',
    '{"\\u0043MAKE_CXX_FLAG\\u0053": "x"}',
]
PLAIN = [
    "",
    '{"cmake-args": ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF"]}',
    '{"cacheVariables": {"CMAKE_BUILD_TYPE": "Debug", "WITH_ARM": "ON"}}',
    "build:\n  symlink-install: true\n  cmake-args: [-DCMAKE_EXPORT_COMPILE_COMMANDS=ON]\n",
    '{"name": "arm", "dependencies": ["rclcpp"]}',
    "FROM ros:jazzy\nENV DEBIAN_FRONTEND=noninteractive\nRUN colcon build --symlink-install\n",
    "RUN colcon build --cmake-args -DPYTHON_EXECUTABLE=/usr/bin/python3\n",
    "RUN apt-get install -y --no-install-recommends python3-dev\n",
    '{"include": ["other.json"]}',
    "RUN wget --no-include=a b\n",
]


@pytest.mark.parametrize("name", NAMES)
def test_names(name: str) -> None:
    assert may_have_flags(name)


@pytest.mark.parametrize("name", OTHERS)
def test_other_names(name: str) -> None:
    assert not may_have_flags(name)


@pytest.mark.parametrize("text", FLAGS)
def test_flags(text: str) -> None:
    assert has_flags(text)


@pytest.mark.parametrize("text", PLAIN)
def test_usual_settings(text: str) -> None:
    assert not has_flags(text)
