# SPDX-License-Identifier: Apache-2.0
"""Questions about packages that are not in the workspace. None is "not known"; nothing is guessed."""

from __future__ import annotations

import re
from functools import cache

from haros_ci.knowledge.facts import Facts
from haros_ci.records import dataclass, field

#: The distributions of ROS 1 that the index has.
ROS_1 = ("groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic", "noetic")
#: Those of ROS 2 (REP 2000), in their order.
ROS_2 = tuple("ardent bouncy crystal dashing eloquent foxy galactic humble iron jazzy kilted lyrical rolling".split())
#: Those of ROS 1 whose packages are still to be had: who adds a dependency today adds one of them.
_CURRENT = ("melodic", "noetic")
_UNSURE = "?"
#: Messages that an action stands for in ROS 1 (genaction of actionlib_msgs).
_PARTS = ("ActionGoal", "ActionResult", "ActionFeedback", "Action", "Goal", "Result", "Feedback")


@dataclass(frozen=True, slots=True)
class Knowledge:
    """What distributions of ROS have, by the facts of one file.

    Providers are names that a manifest can depend on: packages of ROS, or keys of rosdep where these stand for a system's package.
    """

    facts: Facts = field(default_factory=Facts)
    #: What comes with a name in a version of ROS, for the next one who asks.
    _depends: dict[tuple[str, int | None], frozenset[str] | None] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def is_package(self, name: str, distribution: str | None = None) -> bool | None:
        """Whether *distribution*, or any, has a package of this name; None where the facts are too few to say no.

        Too few they are for repositories that were never released: some hold a package of their name; and for one
        distribution's packages that were seen in a repository only.
        """
        mask = self.facts.section("packages").get(name)
        if distribution is None:
            if mask is not None:
                return True
            return None if not self.is_there or name in self.facts.section("others") else False
        names = self.facts.about.get("distributions", ())
        if distribution not in names:
            return None
        if mask is None:
            return self.is_package(name)
        if not int(mask, 16):
            return None
        return bool(int(mask, 16) >> names.index(distribution) & 1)

    def is_known(self, name: str) -> bool:
        """Whether there is anything of this name: a package, a repository that may have one, a key of rosdep."""
        sections = ("packages", "others", "keys")
        return (
            any(name in self.facts.section(section) for section in sections) or "-" in name
        )  # REP 144: no package has that

    def is_in(self, name: str, ros: int | None) -> bool:
        """Whether a distribution of *ros* 1 or 2 (None: of either) has the package, or rosdep the key."""
        mask = self.facts.section("packages").get(name)
        if mask is None or ros is None or not int(mask, 16):
            return mask is not None or self.is_key(name)
        bits = int(mask, 16)
        distributions = self.facts.about["distributions"]
        return any(
            bits >> at & 1 and (distribution in ROS_1) == (ros == 1) for at, distribution in enumerate(distributions)
        )

    def is_current(self, name: str, ros: int | None) -> bool:
        """Whether a distribution of *ros* that is not long gone has the package, or rosdep the key: of ROS 1 Melodic or Noetic, of ROS 2 any."""
        mask = self.facts.section("packages").get(name)
        if mask is None or not int(mask, 16) or self.is_key(name):
            return self.is_in(name, ros)
        bits, distributions = int(mask, 16), self.facts.about["distributions"]
        alive = [
            distribution
            for at, distribution in enumerate(distributions)
            if bits >> at & 1 and (distribution not in ROS_1 or distribution in _CURRENT)
        ]
        return any(ros is None or (item in ROS_1) == (ros == 1) for item in alive)

    def last_of_the_past(self, name: str) -> str | None:
        """The last distribution of ROS 2 that has the package, if none from Humble on has it; None where one has, or that is not known."""
        mask = self.facts.section("packages").get(name)
        bits, distributions = int(mask or "0", 16), self.facts.about.get("distributions", ())
        having = {distribution for at, distribution in enumerate(distributions) if bits >> at & 1}
        known = [distribution for distribution in ROS_2 if distribution in having]
        return known[-1] if known and ROS_2.index(known[-1]) < ROS_2.index("humble") else None

    @property
    def is_there(self) -> bool:
        """Whether there are facts at all."""
        return bool(self.facts.about)

    def packages(self) -> tuple[str, ...]:
        """The names of all packages that any distribution has."""
        return tuple(self.facts.section("packages"))

    def is_key(self, name: str) -> bool:
        """Whether rosdep has a key of this name, which stands for packages of the system."""
        return name in self.facts.section("keys")

    def keys_like(self, beginning: str) -> frozenset[str]:
        """The keys of rosdep that begin with the pattern *beginning*."""
        pattern = re.compile(beginning)
        return frozenset(key for key in self.facts.section("keys") if pattern.match(key))

    def is_metapackage(self, name: str, ros: int | None = None) -> bool | None:
        """Whether the package is one that has nothing but dependencies; None where its manifest was not seen.

        Some are in ROS 1 and none in ROS 2, so without *ros* 1 or 2 they are not known, either.
        """
        versions = set("12") if ros is None else {str(ros)}
        is_meta, is_plain = (
            bool(versions & set(self.facts.section(item).get(name, ""))) for item in ("metapackages", "plain")
        )
        return is_meta if is_meta != is_plain else None

    def depends(self, name: str, ros: int | None = None) -> frozenset[str] | None:
        """What comes with *name* once it is installed, in any distribution of *ros* 1 or 2 (None: of both)."""
        if (name, ros) not in self._depends:
            found = [self.facts.words(f"requires{number}", name) for number in ((ros,) if ros in (1, 2) else (1, 2))]
            found.append(self.facts.words("keys", name))
            rows = [row for row in found if row is not None]
            self._depends[name, ros] = frozenset().union(*rows) - {_UNSURE} if rows else None
        return self._depends[name, ros]

    def is_whole(self, name: str) -> bool:
        """Whether all that comes with *name* is known. It is not for keys of packages that only some systems have."""
        words = self.facts.words("keys", name)
        return words is None or _UNSURE not in words

    def provider_of_header(self, path: str) -> frozenset[str] | None:
        """Who installs the header ``tf2_ros/buffer.h``: by what is listed, else by the folder that is named after its package."""
        row = self._header_row(path)
        if row is not None:
            return frozenset(row.split()) or None
        top, slash, _ = path.partition("/")
        return frozenset((top,)) if slash and self._is_plain(top) else None

    def lists_header(self, path: str) -> bool:
        """Whether it is listed who installs the header, or one of its folders, so that the folder's name need not tell."""
        return self._header_row(path) is not None

    def _header_row(self, path: str) -> str | None:
        rows = self.facts.section("headers")
        folder = path
        while folder:
            row = rows.get(folder)
            if row is not None:
                return row
            folder = "/".join(folder.rstrip("/").split("/")[:-1])
            folder = f"{folder}/" if folder else ""
        return None

    def provider_of_module(self, name: str) -> frozenset[str] | None:
        """Who installs the top-level Python module *name*."""
        top = name.partition(".")[0]
        row = self.facts.words("modules", top.lower())
        if row is not None:
            return row
        return frozenset((top,)) if self._is_plain(top) else None

    def provider_of_cmake(self, name: str) -> frozenset[str] | None:
        """Whose installation find_package(*name*) finds."""
        row = self.facts.words("cmake", name)
        if row is not None:
            return row
        return frozenset((name,)) if self.is_package(name) else None

    def provides_interface(self, name: str, kind: str) -> bool | None:
        """Whether a package has the definition ``pkg/T`` of *kind* msg, srv or action; None if its definitions are not known."""
        package, _, short = name.partition("/")
        row = self.facts.words("interfaces", package)
        if row is None:
            return None
        if f"{kind}/{short}" in row:
            return True
        base = next((short[: -len(part)] for part in _PARTS if kind == "msg" and short.endswith(part)), "")
        return bool(base) and f"action/{base}" in row

    def interfaces(self, name: str) -> frozenset[str]:
        """The definitions of a package, as ``msg/T``; none if they are not known."""
        return self.facts.words("interfaces", name) or frozenset()

    def has_interfaces(self, name: str) -> bool:
        """Whether the package is known to define messages, services or actions."""
        return bool(self.facts.words("interfaces", name))

    def plugins(self, name: str) -> frozenset[tuple[str, str]] | None:
        """``(package, base class)`` of those that export a plug-in with this look-up name or C++ type."""
        words = self.facts.words("plugins", name)
        if words is None:
            return None
        return frozenset((word.partition("|")[0], word.partition("|")[2]) for word in words)

    def plugin_names(self) -> tuple[str, ...]:
        """All look-up names and C++ types of plug-ins that are known, of any distribution."""
        return tuple(self.facts.section("plugins"))

    def _is_plain(self, name: str) -> bool:
        return bool(self.is_package(name)) and not self.is_metapackage(name)


@cache
def knowledge() -> Knowledge:
    """That of the file that comes with the program."""
    return Knowledge()
