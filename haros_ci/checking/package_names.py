# SPDX-License-Identifier: Apache-2.0
"""Names of packages that do not exist, and which package is meant by one."""

from __future__ import annotations

from collections.abc import Collection
from functools import cache

from haros_ci.checking.likeness import is_letter_slip, is_slip
from haros_ci.checking.outside_targets import OF_CMAKE
from haros_ci.knowledge.knowledge import knowledge
from haros_ci.regex import regex

#: How many packages of a workspace begin alike where that is their prefix.
_COMMON = 4
#: Shorter names are too much alike, but for a slip in one that nearly all workspaces use.
_LONG, _SHORT = 7, 4
_OF_ALL = tuple(
    """amcl controller_manager gazebo_ros gmapping joint_state_publisher joy map_server move_base nodelet rclcpp rclpy robot_state_publisher
    ros_gz_sim rosbag roscpp rospy rqt_graph rviz rviz2 slam_toolbox std_msgs tf2_ros urdf xacro""".split()
)

#: Names that a package can have (REP 144, with the capitals of older ones), and a version behind a name.
_PACKAGE = regex(r"[A-Za-z]\w*")
_VERSION = regex(r"(?:[\s._-]{1,8}v?)?\d[\d.\s]{0,20}$")


def stem_of_system(name: str) -> str:
    """The name of a library without a version, in small letters: ``opencv`` for ``opencv2`` and ``OpenCV 3.4.12``."""
    return _VERSION.sub("", name[:100]).lower()


def is_of_system(name: str) -> bool:
    """Whether a name that nobody knows is no name of a package, or that of a library that CMake finds by itself, with a version or other letters."""
    return _PACKAGE.fullmatch(name) is None or stem_of_system(name) in OF_CMAKE


def meant_here(name: str, names: Collection[str], declared: Collection[str] = ()) -> str | None:
    """The package of a workspace with these *names* that is meant: misspelt, or with the prefix that many packages there have; else one that
    its manifests have (*declared*), misspelt.

    A name that a distribution has, or may have, is a package of its own, however much it is like one here.
    """
    if len(name) < 5 or (knowledge().is_there and knowledge().is_package(name) is not False):
        return None
    for other in names:
        prefix = other.removesuffix(name)
        if is_slip(name, other) or (prefix != other and prefix.endswith("_") and _is_common(prefix, names)):
            return other
    return min((other for other in declared if is_slip(name, other)), default=None)


def meant_released(name: str) -> str | None:
    """The package of a distribution that is meant by a name that no package has."""
    if len(name) < _SHORT or knowledge().is_package(name) is not False:
        return None
    of_all = [other for other in _OF_ALL if name[0] == other[0] and is_letter_slip(name, other)]
    if len(of_all) == 1:
        return of_all[0]
    if len(name) < _LONG:
        return None
    near = [other for other in knowledge().packages() if abs(len(other) - len(name)) < 3 and is_slip(name, other)]
    return next((other for other in near if not _has_words_of_others(name, other)), None)


def _has_words_of_others(name: str, other: str) -> bool:
    """Whether *name* differs from *other* by a word that packages are made of, too: ``robot_description`` is no slip of ``rosbot_description``.

    One letter ``s`` at the end of a word is left out by those who mean the other, whatever other packages are called.
    """
    words, others = name.split("_"), other.split("_")
    if len(words) != len(others):
        return False
    apart = [(one, two) for one, two in zip(words, others) if one != two]
    return bool(apart) and all(one.rstrip("s") != two.rstrip("s") and _is_word(one) for one, two in apart)


@cache
def _is_word(word: str) -> bool:
    """Whether several released packages have *word* in their names, between underscores."""
    count = 0
    for name in knowledge().packages():
        count += word in name and word in name.split("_")
        if count >= _COMMON:
            return True
    return False


def _is_common(prefix: str, names: Collection[str]) -> bool:
    return sum(other.startswith(prefix) for other in names) >= _COMMON
