# SPDX-License-Identifier: Apache-2.0
"""Flags of compilers outside of CMake's lists are recognised; usual settings of builds are none."""

from __future__ import annotations

import pytest

from haros_ci.workspace.compiler_flags import has_flags, may_have_flags

NAMES = ["CMakePresets.json", "CMakeUserPresets.json", "arm-presets.json", "colcon.pkg", "a.meta", "defaults.yaml"]
NAMES += [
    "colcon_defaults.yaml",
    ".colcon-defaults.yml",
    "Dockerfile",
    "Dockerfile.dev",
    "arm.dockerfile",
    "part.pc",
    "part.pc.in",
]
OTHERS = [
    "package.json",
    "colcon.md",
    "params.yaml",
    "CMakeLists.txt",
    "presets.yaml",
    "a.metadata",
    "meta",
    "a.cpp",
    "a.pcd",
    "pc",
]
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
    assert has_flags("Dockerfile", text)


@pytest.mark.parametrize("text", PLAIN)
def test_usual_settings(text: str) -> None:
    assert not has_flags("Dockerfile", text)


@pytest.mark.parametrize(
    "text",
    [
        "Name: part\nCflags: -include ${pcfiledir}/part.glsl\n",
        "more=-include part.glsl\nCflags: ${more}\n",
        "Cflags: -I${includedir} \\\n  -Dkept=local\n",
        "Cflags.private: -imacros part.glsl\n",
    ],
)
def test_flags_of_a_package(text: str) -> None:
    assert has_flags("part.pc", text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "prefix=/usr\nincludedir=${prefix}/include\nCflags: -I${includedir}/part -DPART_STATIC -pthread -std=c++17\n",
        "prefix=@CMAKE_INSTALL_PREFIX@\nCflags: -I@INCLUDES@ @CFLAGS@ -DA=1\nLibs: -L${libdir} -lpart -Wl,-rpath,${libdir}\n",
        "Name: part\nDescription: a part - see --include, kept=local\nVersion: 1.2-3\nRequires: other >= 2, eigen3\n",
        "# Cflags: -include part.glsl\n",
    ],
)
def test_usual_flags_of_a_package(text: str) -> None:
    assert not has_flags("part.pc.in", text)
