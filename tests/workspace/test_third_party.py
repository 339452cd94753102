# SPDX-License-Identifier: Apache-2.0
"""Which directories hold copies of other projects."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.workspace.discover import discover
from haros_ci.workspace.third_party import ThirdParty, around

PACKAGES = {
    "src/demo_backup": "demo",
    "src/demo (no usado)": "demo",
    "src/walk2 (unused)": "walk",
    "src/walk_unused": "run",
    "src/demo_unused": "demo",
    "src/demo_废弃": "demo",
    "src/demo_usado": "demo",
    "src/arm_OLD": "arm",
    "src/state_backup": "state_backup",
    "src/demo": "demo",
    "src/pkg_not_use/arm": "arm_more",
    "src/Not Used/more/arm": "arm_less",
    "src/knot_used/arm": "arm_knot",
    "src/used/arm": "arm_used",
    "src/eigen": "eigen3",
    "ws-1.2.0/src/robot": "robot",
}
EIGEN = "src/demo/include/Eigen"
CHIP = "fw/stm32f4xx_lib"


def eigen(root: str = EIGEN) -> tuple[str, ...]:
    return (f"{root}/Core", f"{root}/Dense", f"{root}/src/Core/util/Macros.h")


#: Path, other files, directories asked about, and the directory of the copy.
YOLOP = ("models/YOLOP.py", "models/common.py", "core/evaluate.py")
TENSORRTX = ("plugin/yololayer.h", "plugin/yololayer.cu", "include/cuda_utils.h", "src/calibrator.cpp")
IKFOM = ("esekfom/esekfom.hpp", "mtk/build_manifold.hpp", "mtk/types/S2.hpp")
FIRES = [
    (
        "src/demo/net/utils/plots.py",
        ("src/demo/net/utils/general.py", "src/demo/net/utils/torch_utils.py"),
        (),
        "src/demo/net/utils",
    ),
    (
        "src/demo/models/yolo.py",
        ("src/demo/models/common.py", "src/demo/models/experimental.py"),
        (),
        "src/demo/models",
    ),
    ("third_party/json/json.hpp", (), (), "third_party"),
    ("src/demo_backup/src/a.cpp", (), (), "src/demo_backup"),
    ("src/demo (no usado)/src/a.cpp", (), (), "src/demo (no usado)"),
    ("src/demo_unused/src/a.cpp", (), (), "src/demo_unused"),
    ("src/walk2 (unused)/src/a.cpp", (), (), "src/walk2 (unused)"),
    ("src/demo_废弃/src/a.cpp", (), (), "src/demo_废弃"),
    ("src/arm_OLD/src/a.cpp", (), (), "src/arm_OLD"),
    ("3rd/json/json.hpp", (), (), "3rd"),
    (
        "src/sdk-python2.7/lib/python2.7/site-packages/qi/path.py",
        (),
        (),
        "src/sdk-python2.7/lib/python2.7/site-packages",
    ),
    ("src/sdk/lib/python3/dist-packages/geometry_msgs/msg/_Pose.py", (), (), "src/sdk/lib/python3/dist-packages"),
    ("src/demo/3rdparty/a.cpp", (), (), "src/demo/3rdparty"),
    ("src/Vendor/a/b/c.cpp", (), (), "src/Vendor"),
    ("external/planner_ros/src/a.cpp", (), (), "external"),
    ("src/demo/external_library/json/a.cpp", (), (), "src/demo/external_library"),
    ("src/demo/external_libs/a.cpp", (), (), "src/demo/external_libs"),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/LICENSE",), (), "src/demo/lib/solver"),
    ("src/demo/lib/solver/x/a.c", ("src/demo/lib/solver/COPYING.LESSER",), (), "src/demo/lib/solver"),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/license-mit.txt",), (), "src/demo/lib/solver"),
    # a package's own directory by name alone, with the root of a project or without code that is called like the package
    ("src/demo/src/a.cpp", ("src/demo/src/LICENSE",), (), "src/demo/src"),
    ("src/demo/src/demos.cpp", ("src/demo/src/LICENSE",), (), "src/demo/src"),
    ("src/demo/src/demo.cpp", ("src/demo/src/LICENSE", "src/demo/src/README.md"), (), "src/demo/src"),
    ("src/demo/src/demo.cpp", ("src/demo/src/LICENSE", "src/demo/src/CMakeLists.txt"), (), "src/demo/src"),
    ("src/demo/src/a.cpp", ("src/demo/src/LICENSE", "src/demo/src/demo.txt"), (), "src/demo/src"),
    ("src/demo/src/a.cpp", ("src/demo/src/LICENSE", "src/demo/src/sub/demo.cpp"), (), "src/demo/src"),
    ("src/demo/lib/demo.cpp", ("src/demo/lib/LICENSE",), (), "src/demo/lib"),
    ("src/demo/a/src/demo.cpp", ("src/demo/a/src/LICENSE",), (), "src/demo/a/src"),
    ("src/pkg_not_use/arm/src/a.cpp", (), (), "src/pkg_not_use"),
    ("src/Not Used/more/arm/src/a.cpp", (), (), "src/Not Used"),
    ("src/demo/vendor/a.cpp", (), ("src/demo",), "src/demo/vendor"),
    ("hw/libcam-x86_64-1.3.6/usb/a.c", ("hw/libcam-x86_64-1.3.6/release-notes.txt",), (), "hw/libcam-x86_64-1.3.6"),
    ("solver-3.2/src/a.c", ("solver-3.2/COPYING",), (), "solver-3.2"),
    ("solver-master/src/a.c", ("solver-master/COPYING", "solver-master/README.md"), (), "solver-master"),
    (
        "src/labs-libcam-70c2caecb930/usb/a.c",
        ("src/labs-libcam-70c2caecb930/AUTHORS",),
        (),
        "src/labs-libcam-70c2caecb930",
    ),
    ("src/libcam-main/usb/a.c", ("src/libcam-main/AUTHORS",), (), "src/libcam-main"),
    ("src/demo/solver_v3.2.1/a.c", ("src/demo/solver_v3.2.1/configure.ac",), (), "src/demo/solver_v3.2.1"),
    (f"{EIGEN}/src/LU/LU.h", eigen(), (), EIGEN),
    (f"{CHIP}/src/stm32f4xx_gpio.c", (f"{CHIP}/inc/stm32f4xx_gpio.h",), (), CHIP),
    (f"{CHIP}/Src/stm32f4xx_hal_gpio.c", (f"{CHIP}/Inc/stm32f4xx_hal_gpio.h",), (), CHIP),
    ("yolo/darknet/src/gemm.c", ("yolo/darknet/include/darknet.h", "yolo/darknet/src/network.c"), (), "yolo/darknet"),
    ("fw/os/tasks.c", ("fw/os/queue.c", "fw/os/list.c", "fw/os/include/FreeRTOS.h"), (), "fw/os"),
    ("src/demo/lib/a.py", tuple(f"src/demo/lib/{name}" for name in YOLOP), (), "src/demo/lib"),
    ("src/demo/yolov7/src/block.cpp", tuple(f"src/demo/yolov7/{name}" for name in TENSORRTX), (), "src/demo/yolov7"),
    (
        "src/demo/trt/block.cpp",
        tuple(f"src/demo/trt/{name.rpartition('/')[2]}" for name in TENSORRTX),
        (),
        "src/demo/trt",
    ),
    (
        "src/demo/include/IKFoM_toolkit/mtk/types/S2.hpp",
        tuple(f"src/demo/include/IKFoM_toolkit/{name}" for name in IKFOM),
        (),
        "src/demo/include/IKFoM_toolkit",
    ),
]
QUIET = [
    ("src/demo/src/block.cpp", tuple(f"src/demo/{name}" for name in TENSORRTX), ()),
    ("src/demo/yolov7/src/block.cpp", tuple(f"src/demo/yolov7/{name}" for name in TENSORRTX[1:]), ()),
    ("src/demo/src/block.cpp", tuple(f"src/demo/yolov7/{name}" for name in TENSORRTX), ()),
    ("src/demo/lib/a.py", tuple(f"src/demo/lib/{name}" for name in YOLOP[1:]), ()),
    ("src/demo/include/ikfom/a.hpp", tuple(f"src/demo/include/ikfom/{name}" for name in IKFOM), ()),
    ("src/demo/pointpillars/nms.h", ("src/demo/pointpillars/pointpillars.h",), ()),
    ("src/demo/src/a.cpp", ("src/demo/LICENSE",), ()),
    ("src/demo/src/a.cpp", ("LICENSE", "src/LICENSE"), ()),
    ("src/other/a.cpp", ("src/other/LICENSE",), ()),
    ("src/state_backup/src/a.cpp", (), ()),
    ("src/other_old/src/a.cpp", (), ()),
    ("src/other (no usado)/src/a.cpp", (), ()),
    ("src/demo_usado/src/a.cpp", (), ()),
    ("src/walk_unused/src/a.cpp", (), ()),
    ("src/demo/darknet/src/gemm.c", ("src/demo/darknet/include/darknet.h",), ()),
    ("src/demo_backup/src/a.cpp", (), ("src/demo_backup",)),
    ("src/demo/src/demo.cpp", ("src/demo/src/license.txt",), ()),
    ("src/demo/src/api.py", ("src/demo/src/license.txt", "src/demo/src/demo_node.py", "src/demo/src/__init__.py"), ()),
    ("src/demo/src/sub/a.cpp", ("src/demo/src/license.txt", "src/demo/src/demo.cpp"), ()),
    ("src/demo/demo/api.py", ("src/demo/demo/LICENSE", "src/demo/demo/demo_node.py"), ()),
    ("src/demo/include/demo.h", ("src/demo/include/COPYING",), ()),
    ("src/demo/scripts/demo.py", ("src/demo/scripts/LICENSE", "src/demo/scripts/sub/README.md"), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/license.py",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/License.hpp",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/licenses/MIT.txt",), ()),
    ("src/demo/src/a.cpp", ("src/demo/src/sub/LICENSE",), ()),
    ("src/demo/not_used/a.cpp", (), ()),
    ("src/knot_used/arm/a.cpp", (), ()),
    ("src/used/arm/a.cpp", (), ()),
    ("src/pkg_not_use/arm/src/a.cpp", (), ("src/pkg_not_use/arm",)),
    ("src/demo_vendor/a.cpp", (), ()),
    ("src/vendors/a.cpp", (), ()),
    ("vendor.cpp", (), ()),
    ("external", (), ()),
    ("third_party/json/a.cpp", (), ("third_party/json",)),
    ("third_party/json/a.cpp", (), ("third_party",)),
    ("src/demo/lib/solver/a.c", ("src/demo/lib/solver/LICENSE",), ("src/demo/lib/solver",)),
    ("solver-3.2.1/src/a.c", ("solver-3.2.1/README.md", "solver-3.2.1/src/COPYING"), ()),
    ("solver-master/src/a.c", ("solver-master/README.md",), ()),
    ("solver-master/a.c", ("solver-master/COPYING",), ("solver-master",)),
    ("solver-master/a.c", ("solver-master/COPYING",), ("solver-master/solve",)),
    ("demo-master/a.c", ("demo-master/COPYING",), ()),
    ("robot_firmware-main/a.c", ("robot_firmware-main/COPYING",), ()),
    ("master/a.c", ("master/COPYING",), ()),
    ("motor_master/a.c", ("motor_master/COPYING",), ()),
    ("solver-2023051/a.c", ("solver-2023051/COPYING",), ()),
    ("solver-facade/a.c", ("solver-facade/COPYING",), ()),
    ("solver-deadbeef/a.c", ("solver-deadbeef/COPYING",), ()),
    ("solver-masters/a.c", ("solver-masters/COPYING",), ()),
    ("solver-3/src/a.c", ("solver-3/COPYING",), ()),
    ("solver-3.2.1/a.c", ("solver-3.2.1/COPYING",), ("solver-3.2.1",)),
    ("demo-1.2.0/a.c", ("demo-1.2.0/COPYING",), ()),
    ("arm_firmware-1.2.0/a.c", ("arm_firmware-1.2.0/CHANGELOG.md",), ()),
    ("firmware_v1.2/a.c", ("firmware_v1.2/LICENSE",), ()),
    ("ws-1.2.0/tools/a.py", ("ws-1.2.0/LICENSE",), ()),
    ("1.2.0/a.py", ("1.2.0/LICENSE",), ()),
    ("src/eigen/include/Eigen/src/LU/LU.h", eigen("src/eigen/include/Eigen"), ()),
    ("src/demo/include/eigen/src/LU/LU.h", eigen("src/demo/include/eigen"), ()),
    ("src/demo/include/Eigen/Plugin.h", (f"{EIGEN}/Core", f"{EIGEN}/Dense"), ()),
    ("src/demo/include/demo/a.h", eigen(), ()),
    ("fw/board/src/a.c", ("fw/board/src/stm32f4xx_gpio.c", "fw/board/inc/stm32f4xx_gpio.h"), ()),
    ("fw/stm32f4xx_lib/src/a.c", ("fw/stm32f4xx_lib/inc/stm32f4xx_gpio.h",), ()),
    ("fw/os/tasks.c", ("fw/os/queue.c", "fw/os/list.c"), ()),
    ("src/demo/utils/plots.py", ("src/demo/utils/general.py",), ()),
    (
        "src/demo/detect.py",
        ("src/demo/models/yolo.py", "src/demo/models/common.py", "src/demo/models/experimental.py"),
        (),
    ),
]


@pytest.mark.parametrize(("path", "others", "asked", "directory"), FIRES)
def test_is_a_copy(path: str, others: tuple[str, ...], asked: tuple[str, ...], directory: str) -> None:
    assert ThirdParty((path, *others), PACKAGES, asked).directory(path) == directory


@pytest.mark.parametrize(("path", "others", "asked"), QUIET)
def test_is_none(path: str, others: tuple[str, ...], asked: tuple[str, ...]) -> None:
    assert ThirdParty((path, *others), PACKAGES, asked).directory(path) == ""


@pytest.mark.parametrize("sign", "-_.a")
def test_long_names_take_no_time(sign: str) -> None:
    """A pattern that goes back over its steps would not end."""
    for name in (f"LICENSE{sign * 5000}!", f"LICENSE{(sign + 'a') * 2500}!"):
        assert ThirdParty((f"src/demo/lib/{name}",), PACKAGES).directory("src/demo/lib/a.cpp") == ""


def test_around() -> None:
    assert around("a/b/c/d.cpp", {"a/b", "x"}) == "a/b"
    assert around("a/bc/d.cpp", {"a/b"}) == around("a", {"a"}) == ""


def test_files_without_packages_are_none() -> None:
    """Who checks a library itself has no packages."""
    root = "lib/Eigen"
    assert ThirdParty((*eigen(root), f"{root}/a.h"), {}).directory(f"{root}/a.h") == ""
    assert ThirdParty(("solver-1.2/a.c", "solver-1.2/COPYING"), {}).directory("solver-1.2/a.c") == ""


def test_a_vendor_package_wraps() -> None:
    names = (*eigen("src/e/include/Eigen"), "src/e/include/Eigen/src/a.h")
    assert ThirdParty(names, {"src/e": "eigen_vendor"}).directory(names[-1]) == "src/e/include/Eigen"


def test_a_known_file_in_the_tree_of_its_library_is_a_copy_by_itself(tmp_path: Path) -> None:
    """A package that keeps it is not what others are to declare for it."""
    copied = "// JSON for Modern C++ version 3.11.2\n" + "int f();\n" * 200
    files = {
        "drive/package.xml": "<package format='3'><name>drive</name></package>\n",
        "drive/include/nlohmann/json.hpp": copied,
        "drive/include/nlohmann/adl_serializer.hpp": "int g();\n",
        "drive/include/nlohmann/detail/exceptions.hpp": "int h();\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    found = {file.path: file.third_party for file in discover(tmp_path, (".",)).files}
    assert found["drive/include/nlohmann/json.hpp"] == "drive/include/nlohmann/json.hpp"
    assert found["drive/include/nlohmann/detail/exceptions.hpp"] == "drive/include/nlohmann"


PHOENIX = tuple(
    f"rover/include/ctre/phoenix/{name}" for name in ("ErrorCode.h", "paramEnum.h", "motorcontrol/can/TalonSRX.h")
)


@pytest.mark.parametrize(
    ("names", "package", "expected"),
    [
        (PHOENIX, "rover", "rover/include/ctre/phoenix"),
        (PHOENIX, "phoenix_vendor", "rover/include/ctre/phoenix"),
        (PHOENIX, "phoenix", ""),
        (PHOENIX[:2], "rover", ""),
        (tuple(name.replace("phoenix", "drive") for name in PHOENIX), "rover", ""),
    ],
)
def test_headers_of_a_maker(names: tuple[str, ...], package: str, expected: str) -> None:
    assert ThirdParty(names, {"rover": package}).directory(names[0]) == expected
