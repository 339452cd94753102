# SPDX-License-Identifier: Apache-2.0
"""Images that map_server's YAML files name, and that are not there."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.api.testing import said
from haros_ci.checking.page import Example
from haros_ci.registry import checks

MANIFEST = (
    '<package format="3"><name>heron</name><version>1.0.0</version><description>d</description><maintainer email="a@b.cd">m</maintainer>'
    "<license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend><export><build_type>ament_cmake</build_type></export></package>\n"
)
CMAKE = "project(heron)\nfind_package(ament_cmake REQUIRED)\ninstall(DIRECTORY maps launch DESTINATION share/heron)\nament_package()\n"
MAP = "image: {}\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
LAUNCH = '<launch><node pkg="nav2_map_server" exec="map_server"><param name="yaml_filename" value="$(find-pkg-share heron)/maps/hall.yaml"/></node></launch>\n'


def found(files: dict[str, str], folder: Path) -> list[tuple[str, str]]:
    check = next(check for check in checks() if check.id == "share-file-missing")
    every = {"package.xml": MANIFEST, "CMakeLists.txt": CMAKE, "launch/a.launch.xml": LAUNCH, **files}
    return [(result.level.value, result.message) for result in said(check, Example("", True, every), folder)]


@pytest.mark.parametrize(
    ("files", "level", "words"),
    [
        ({"maps/hall.yaml": MAP.format("hall.pgm")}, "warning", "maps/hall.pgm, which does not exist"),
        ({"maps/hall.yaml": MAP.format('"hall.png"  # of Monday')}, "warning", "maps/hall.png, which does not exist"),
        ({"maps/attic.yaml": MAP.format("attic.pgm")}, "note", "maps/attic.pgm, which does not exist"),
        (
            {"maps/hall.yaml": MAP.format("maps/hall.pgm"), "maps/hall.pgm": "P5"},
            "warning",
            "the name counts from the directory of the YAML file on: write hall.pgm",
        ),
        (
            {"maps/hall.yaml": MAP.format("hall.pgm"), "maps/hall.png": "P"},
            "warning",
            "did you mean 'hall.png'?",
        ),
        (
            {"maps/hall.yaml": MAP.format("hall.pgm"), "maps/Hall.pgm": "P"},
            "warning",
            "did you mean 'Hall.pgm'?",
        ),
    ],
)
def test_an_image_that_is_not_there(files: dict[str, str], level: str, words: str, tmp_path: Path) -> None:
    ((told, message),) = found(files, tmp_path)
    assert told == level and words in message


HALL = MAP.format("hall.pgm")


@pytest.mark.parametrize(
    "files",
    [
        {"maps/hall.yaml": HALL, "maps/hall.pgm": "P5"},
        {"maps/hall.yaml": MAP.format("../images/hall.pgm"), "images/hall.pgm": "P5"},
        {"maps/hall.yaml": HALL, ".gitignore": "*.pgm\n"},
        {"maps/hall.yaml": HALL, "maps/.gitignore": "hall.pgm\n"},
        {"maps/hall.yaml": HALL, "save.sh": "rosrun map_server map_saver -f maps/hall\n"},
        {"maps/hall.yaml": HALL, "README.md": "ros2 run nav2_map_server map_saver_cli -f maps/hall\n"},
        {"maps/hall.yaml": HALL, "README.md": "Download maps/hall.pgm from the page of the hall.\n"},
        {"maps/hall.yaml": HALL, "draw.py": "import cv2\ncv2.imwrite('hall.pgm', grid)\n"},
        {
            "maps/hall.yaml": HALL,
            ".gitmodules": '[submodule "maps"]\n\tpath = maps\n\turl = https://example.org/maps\n',
        },
        {"maps/hall.yaml": MAP.format("/opt/maps/hall.pgm")},
        {"maps/hall.yaml": MAP.format("~/maps/hall.pgm")},
        {"maps/hall.yaml": MAP.format("$(find heron)/maps/hall.pgm")},
        {"maps/hall.yaml": MAP.format("https://example.org/hall.pgm")},
        {"maps/hall.yaml": MAP.format("../../maps/hall.pgm")},
        {"maps/hall.yaml": "image: hall.pgm\n"},
        {"maps/hall.yaml": "image: hall.pgm\nresolution: 0.05\n"},
        {"maps/hall.yaml": "services:\n  robot:\n    image: hall.pgm\n    resolution: 1\n    origin: 2\n"},
        {"maps/hall.yaml": HALL.replace("image:", "# image:")},
        {"maps/hall.yaml": MAP.format("")},
        {"test/hall.yaml": HALL},
        {"maps/invalid_image.yaml": HALL},
        {"maps/hall.yaml.in": HALL},
    ],
)
def test_stays_quiet(files: dict[str, str], tmp_path: Path) -> None:
    assert found(files, tmp_path) == []
