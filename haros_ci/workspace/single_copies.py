# SPDX-License-Identifier: Apache-2.0
"""Single files that a project has copied from another one: their heads name an owner and a licence that nothing else in the project names."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterable
from functools import cached_property

from haros_ci.model.copyright_owners import owner_lines, owners_in, words
from haros_ci.model.package import SourceFile
from haros_ci.regex import regex
from haros_ci.workspace.generated import leading_comment
from haros_ci.workspace.judged import Judged

#: Fewer lines have no libraries.
SHORTEST = 100
#: Files of a package beside a copy that tell who writes the package.
OTHERS = 5
#: Files that one library is copied as.
MOST = 3
#: Characters of a first comment that are looked at.
_HEAD = 8_192
_LICENCES = {
    "mit": regex(
        r"permission is hereby granted, free of charge|\bmit\b.{0,20}\blicen[cs]e|identifier: mit\b", re.IGNORECASE
    ),
    "bsd": regex(r"redistribution and use in source and binary forms|\bbsd\b", re.IGNORECASE),
    "gpl": regex(r"\bgnu (?:lesser |library |affero )?general public licen[cs]e|\b[al]?gpl", re.IGNORECASE),
    "apache": regex(r"\bapache\b.{0,20}\blicen[cs]e|\bapache[- ]?2|\bapache\b", re.IGNORECASE),
    "mpl": regex(r"\bmozilla public licen[cs]e|\bmpl\b", re.IGNORECASE),
    "boost": regex(r"\bboost software licen[cs]e|\bbsl\b", re.IGNORECASE),
    "zlib": regex(r"this software is provided 'as-is'|\bzlib\b", re.IGNORECASE),
    "isc": regex(r"permission to use, copy, modify,? and(?:/or)? distribute|\bisc\b", re.IGNORECASE),
}
#: Who has changed what somebody else wrote goes on to write it.
_CHANGED = regex(
    r"\b(?:contributions? (?:by|copyright)|adapted|modified (?:by|for|from|version)|modifications? (?:by|copyright)|ported (?:by|from|to)|port of)\b",
    re.IGNORECASE,
)
#: Makers of chips, boards, sensors and devices, as copyright lines name them, and what manifests of their own have of them.
_MAKERS = tuple(
    (regex(name, re.IGNORECASE), regex(own, re.IGNORECASE))
    for name, own in (
        (r"texas instruments", r"texas instruments|[@.]ti\.com\b"),
        (r"stmicroelectronics", r"stmicroelectronics|[@.]st\.com\b"),
        (r"\b(?:nxp|freescale) semiconductors?\b", r"\bnxp\b|\bfreescale\b"),
        (r"\bnvidia corporation\b", r"\bnvidia\b"),
        (r"nordic semiconductor", r"nordic semiconductor|[@.]nordicsemi\."),
        (r"espressif systems", r"\bespressif\b"),
        (r"microchip technology|\batmel corporation\b", r"\bmicrochip\b|\batmel\b"),
        (r"infineon technologies|\bcypress semiconductor\b", r"\binfineon\b|\bcypress\b"),
        (r"renesas electronics", r"\brenesas\b"),
        (r"bosch sensortec", r"\bbosch\b"),
        (r"\binvensense\b", r"\binvensense\b|\btdk\b"),
        (r"\bnaturalpoint\b", r"\bnaturalpoint\b"),
        (r"\bleap motion\b|\bultraleap\b", r"\bleapmotion\b|\bleap motion\b|\bultraleap\b"),
        (r"\bintel corporation\b", r"\bintel\b"),
        (r"\bstereolabs\b", r"\bstereolabs\b"),
        (r"\bxsens\b|\bmovella\b", r"\bxsens\b|\bmovella\b"),
        (r"\borbbec\b", r"\borbbec\b"),
        (r"\bvicon motion systems\b", r"\bvicon\b"),
        (r"\bqualisys\b", r"\bqualisys\b"),
        (r"\bvectornav technologies\b", r"\bvectornav\b"),
        (r"\bslamtec\b|\brobopeak\b", r"\bslamtec\b|\brobopeak\b"),
        (r"\brobotis\b", r"\brobotis\b"),
    )
)
#: A licence of a maker's own.
_CONTRACT = regex(r"\beula\b|\blicen[cs]e agreement\b|\b(?:software|plugins?) licen[cs]e\b", re.IGNORECASE)
OF_ROS = regex(
    r"\b(?:rospy|rclpy|rclcpp\w*|roslib|roscpp|rosbag\w*|nodelet|pluginlib|cv_bridge|dynamic_reconfigure|ament_\w+|catkin\w*|\w+_(?:msgs|srvs|interfaces))\b"
    r"|[<\"]ros/|\b(?:from|import)[ \t]+(?:launch(?:_ros)?\b|[\w.]+\.(?:msg|srv|action)[ \t]+import\b)"
)
_PARTS = regex(
    r"^[ \t]*(?:#[ \t]*include[ \t]*[<\"]([^>\"\n]{1,200})|from[ \t]+\.*([\w.]*)[ \t]+import\b[ \t]*(\w*)|import[ \t]+([\w., \t]{1,200}))",
    re.MULTILINE,
)
_MANIFESTS = ("package.xml", "setup.py", "setup.cfg", "pyproject.toml")


class SingleCopies(Judged):
    """Which files are copies of another project's library of one file, or of a few that lie beside each other.

    The first comment of such a file has a copyright line and a licence. No manifest, and no other first comment of the workspace, has a
    word of the owner's name; no other file of the package, nor its manifest, has that licence; and there are several others.
    The file uses nothing of ROS and nothing of the workspace, and does not say that it has been changed.

    Of a maker of chips, boards or devices that no manifest names every file with its copyright and a licence, which may be a contract of the maker's own, is one, however many there are.
    """

    def _judge(self, files: Collection[SourceFile]) -> Iterable[str]:
        return [file.path for file in files if self._is_copy(file)]

    def _is_copy(self, file: SourceFile) -> bool:
        head = self._head(file)
        owner, licences = owners_in(head), _first_licence(head)
        is_of_maker = bool(licences or _CONTRACT.search(head)) and self._is_of_maker(head)
        if not owner or not (licences or is_of_maker) or file.lines < SHORTEST or not self._workspace.packages:
            return False
        text = self._workspace.text(file.path)
        if _CHANGED.search(head):
            return False
        if OF_ROS.search(text) or not owner.isdisjoint(self._people):
            return False
        if is_of_maker:
            return True
        own = [other_file for other_file in self._code if not owner.isdisjoint(self._heads[other_file.path])]
        directory = posixpath.dirname(file.path)
        beside = [other_file for other_file in own if posixpath.dirname(other_file.path) == directory]
        if len(beside) > MOST or any(not self._is_again(other_file, beside) for other_file in own):
            return False
        group = {other_file.path for other_file in own}
        if any(
            not owners_in(self._head(other_file)) & owner or _first_licence(self._head(other_file)) != licences
            for other_file in own
        ):
            return False
        others = [
            other_file
            for other_file in self._code
            if other_file.package == file.package and other_file.path not in group
        ]
        if len(others) < OTHERS or any(_licences(self._head(other)) & licences for other in others):
            return False
        return not self._of_package(file.package) & licences and not self._uses_others(text, others)

    def _is_of_maker(self, head: str) -> bool:
        """Whether all copyright lines of *head* are of one maker of chips that no manifest names: what comes with the hardware."""
        lines = owner_lines(head)
        named = [own for name, own in _MAKERS if lines and all(name.search(line) for line in lines)]
        return bool(named) and not any(own.search(text) for own in named for text in self._manifests)

    def _is_again(self, file: SourceFile, beside: Collection[SourceFile]) -> bool:
        """Whether *file* is one of those *beside* the copy, or one of them word for word: somebody has put the library in twice."""
        return any(
            file is other_file
            or (
                posixpath.basename(file.path) == posixpath.basename(other_file.path)
                and self._workspace.text(file.path) == self._workspace.text(other_file.path)
            )
            for other_file in beside
        )

    def _head(self, file: SourceFile) -> str:
        if file.language not in ("cpp", "python"):
            return ""
        return leading_comment(file.language, self._workspace.text(file.path)[:_HEAD].encode("utf-8", "replace"))

    @cached_property
    def _code(self) -> list[SourceFile]:
        """The code that is the project's own, as far as is known."""
        return [file for file in self._workspace.files if file.language in ("cpp", "python") and not file.third_party]

    @cached_property
    def _heads(self) -> dict[str, frozenset[str]]:
        return {file.path: words(self._head(file)) for file in self._code}

    @cached_property
    def _people(self) -> frozenset[str]:
        """The words of all manifests: who maintains and has written what, and where they work."""
        return frozenset(word for text in self._manifests for word in words(text))

    @cached_property
    def _manifests(self) -> tuple[str, ...]:
        names = (path for path in self._workspace.names if posixpath.basename(path) in _MANIFESTS)
        return tuple(map(self._workspace.text, names))

    def _of_package(self, name: str | None) -> frozenset[str]:
        """The licences that the package's manifest has, those of all where the file is in none."""
        found: set[str] = set()
        for package in self._workspace.packages:
            if name in (None, package.name):
                manifest = self._workspace.text(posixpath.normpath(posixpath.join(package.path, "package.xml")))
                for licence in re.findall(r"<license\b[^>]{0,200}>([^<]{1,200})<", manifest):
                    found |= _licences(licence)
        return frozenset(found)

    def _uses_others(self, text: str, others: Iterable[SourceFile]) -> bool:
        """Whether *text* includes or imports one of *others*, or something of a package of the workspace."""
        known = {package.name for package in self._workspace.packages}
        for other in others:
            known.add(posixpath.basename(other.path))
            known.add(posixpath.splitext(posixpath.basename(other.path))[0])
        known -= {"__init__", "__main__", "setup"}
        for included, module, name, modules in _PARTS.findall(text):
            used = {included.partition("/")[0], posixpath.basename(included)}
            used |= {*module.split("."), name, *re.findall(r"\w+", modules)}
            if not known.isdisjoint(used - {""}):
                return True
        return False


def _licences(head: str) -> frozenset[str]:
    plain = re.sub(r"[\s#*/]+", " ", head)
    return frozenset(name for name, pattern in _LICENCES.items() if pattern.search(plain))


def _first_licence(head: str) -> frozenset[str]:
    """The licence that *head* names first: others may be in its history."""
    plain = re.sub(r"[\s#*/]+", " ", head)
    places = {name: found.start() for name, pattern in _LICENCES.items() if (found := pattern.search(plain))}
    return frozenset(sorted(places, key=lambda name: places[name])[:1])
