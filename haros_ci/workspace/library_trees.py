# SPDX-License-Identifier: Apache-2.0
"""Directories that are a release of another project, by the version or branch in their name, or the tree of a well-known library, by its files."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from haros_ci.regex import regex
from haros_ci.workspace.known_copies import is_of_project

#: A library, as packages of it are called; how the directory is called ("" is any name); and files that are in it, all of them.
_TREES: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("eigen", "Eigen", ("Core", "Dense", "src/Core/util/Macros.h")),
    ("boost", "boost", ("version.hpp", "config.hpp", "config/compiler/gcc.hpp")),
    ("nlohmann", "nlohmann", ("json.hpp", "detail/exceptions.hpp", "adl_serializer.hpp")),
    ("spdlog", "spdlog", ("spdlog.h", "logger.h", "sinks/sink.h")),
    ("fmt", "fmt", ("format.h", "core.h", "ostream.h")),
    ("rapidjson", "rapidjson", ("rapidjson.h", "document.h", "reader.h")),
    ("pybind11", "pybind11", ("pybind11.h", "cast.h", "detail/common.h")),
    ("gtest", "gtest", ("gtest.h", "gtest-printers.h", "internal/gtest-internal.h")),
    ("gmock", "gmock", ("gmock.h", "gmock-matchers.h", "internal/gmock-internal-utils.h")),
    ("dlib", "", ("noncopyable.h", "algs.h", "matrix/matrix.h")),
    ("sophus", "sophus", ("so3.hpp", "se3.hpp", "common.hpp")),
    ("yamlcpp", "yaml-cpp", ("yaml.h", "emitter.h", "node/node.h")),
    ("glm", "glm", ("glm.hpp", "vec3.hpp", "detail/setup.hpp")),
    ("cereal", "cereal", ("cereal.hpp", "access.hpp", "archives/json.hpp")),
    ("asio", "asio", ("io_context.hpp", "buffer.hpp", "detail/config.hpp")),
    ("websocketpp", "websocketpp", ("endpoint.hpp", "connection.hpp", "config/core.hpp")),
    ("yolov5", "models", ("yolo.py", "common.py", "experimental.py")),
    ("yolov5", "utils", ("general.py", "plots.py", "torch_utils.py")),
    ("libusb", "libusb", ("libusb.h", "libusbi.h", "core.c")),
    ("lwip", "lwip", ("tcp.h", "pbuf.h", "netif.h")),
    ("phoenix", "phoenix", ("ErrorCode.h", "paramEnum.h", "motorcontrol/can/TalonSRX.h")),
    ("darknet", "darknet", ("include/darknet.h", "src/gemm.c", "src/network.c")),
    ("libsocket", "libsocket", ("socket.hpp", "inetbase.hpp", "unixbase.hpp")),
    ("ikfom", "IKFoM_toolkit", ("esekfom/esekfom.hpp", "mtk/build_manifold.hpp", "mtk/types/S2.hpp")),
    ("yolop", "lib", ("models/YOLOP.py", "models/common.py", "core/evaluate.py")),
    ("pointpillars", "pointpillars", ("pointpillars.h", "preprocess.h", "scatter.h")),
    ("pointpillar", "pointpillar", ("pointpillar.hpp", "lidar-voxelization.hpp", "common/tensor.hpp")),
    ("pointpillar", "eval", ("kitti_format.py", "kitti_common.py", "eval.py")),
    ("tensorrtx", "", ("plugin/yololayer.h", "plugin/yololayer.cu", "include/cuda_utils.h", "src/calibrator.cpp")),
    ("tensorrtx", "", ("yololayer.h", "yololayer.cu", "cuda_utils.h", "calibrator.cpp")),
    ("freertos", "", ("tasks.c", "queue.c", "list.c", "include/FreeRTOS.h")),
)
_BY_FIRST: dict[str, list[tuple[str, str, tuple[str, ...]]]] = {}
for _tree in _TREES:
    _BY_FIRST.setdefault(_tree[2][0].rpartition("/")[2], []).append(_tree)
#: The drivers of a family of microcontrollers, as its maker gives them out: ``stm32f10x_lib/inc/stm32f10x_gpio.h`` and the source beside.
_DRIVER = regex(r"(?:.{1,4000}/)?((stm32[a-z]\w{1,5}?)[^/]{0,40})/(?:inc|Inc|include)/\2_(?:hal_|ll_)?gpio\.h")
#: ``solver-3.2.1``, ``libcam-x86_64-1.3``; a version of one number is anybody's.
#: So is what is downloaded of a branch or commit, as GitHub, GitLab and Bitbucket call it: ``solver-master``, ``labs-solver-70c2caecb930``.
_RELEASE = regex(
    r"([A-Za-z][\w+-]{0,80}?)(?:[-_]v?\d{1,4}(?:\.\d{1,6}){1,3}"
    r"|-(?:master|main|develop|trunk|(?=[0-9a-f]{0,39}[a-f])(?=[0-9a-f]{0,39}\d)[0-9a-f]{7,40}))"
)
#: What a release of a project has at its root, besides a licence.
_OF_RELEASE = regex(
    r"(?:configure(?:\.ac|\.in)?|authors|install|news|changes|changelog|history|release[-_]?notes|copyright)(?:\.(?:txt|md|rst))?",
    re.IGNORECASE,
)
#: Names of what a project makes releases and variants of itself.
_OWN = frozenset(
    "archive backup board bringup build cad config data dataset demo devel docker docs firmware hardware image lib map maps model models"
    " msgs pcb release releases robot ros ros1 ros2 sdk software src test tests version world".split()
)


def library_trees(names: Iterable[str], packages: Mapping[str, str]) -> frozenset[str]:
    """The directories among the paths *names* that are the tree of a well-known library in none of its own *packages* (directory to name)."""
    known = frozenset(names)
    found: set[str] = set()
    for name in known if packages else ():
        base = name.rpartition("/")[2]
        for library, called, files in _BY_FIRST.get(base, ()):
            root = name[: -len(files[0]) - 1]
            if not root or not name.endswith(f"/{files[0]}") or called not in ("", root.rpartition("/")[2]):
                continue
            if not called and root in packages:  # whose own files are beside
                continue
            if all(f"{root}/{file}" in known for file in files) and not is_of_project(
                library, _package(root, packages)
            ):
                found.add(root)
        if base.startswith("stm32") and _DRIVER.fullmatch(name) is not None:
            root = name.rpartition("/")[0].rpartition("/")[0]
            if any(f"{root}/{item}/{base[:-2]}.c" in known for item in ("src", "Src")):
                found.add(root)
    return frozenset(found)


def releases(names: Iterable[str], licensed: Iterable[str], packages: Mapping[str, str]) -> frozenset[str]:
    """The directories with a version, or a branch as downloads have it, in their name and, at their root, a licence (*licensed*) or what else a release has.

    One with a package in it, or that is called like a package or like what projects make themselves, is none.
    """
    around = set(packages)
    for directory in packages:
        while "/" in directory:
            directory = directory.rpartition("/")[0]
            around.add(directory)
    own = {_plain(name) for name in packages.values()}
    roots = {name.rpartition("/")[0] for name in names if _OF_RELEASE.fullmatch(name.rpartition("/")[2])}
    found = set()
    for root in {*roots, *licensed} - around if packages else ():
        release = _RELEASE.fullmatch(root.rpartition("/")[2])
        if release is None or _plain(release[1]) in own:
            continue
        if _OWN.isdisjoint(re.split(r"[-_]", release[1].lower())):
            found.add(root)
    return frozenset(found)


def _package(directory: str, packages: Mapping[str, str]) -> str | None:
    while directory not in packages and "/" in directory:
        directory = directory.rpartition("/")[0]
    return packages.get(directory, packages.get("."))


def _plain(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())
