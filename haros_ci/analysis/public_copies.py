# SPDX-License-Identifier: Apache-2.0
"""Copies of public packages that a workspace keeps among its own: who has the copy does not mend its code.

Many workspaces hold what others wrote beside what they are about: ``src/amcl``, ``src/navigation2-humble``. Such packages are read, as
nodes are in them, and have no findings in a first look. Where there is anything to compare with (a baseline, a base revision) they have, as
only what is new is shown then: a change to a copy, or one that makes a package look like one, hides nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from haros_ci.analysis.foreign_projects import foreign_projects
from haros_ci.analysis.imported_copies import imported
from haros_ci.config.settings import Settings
from haros_ci.knowledge.knowledge import knowledge
from haros_ci.model.package import Package
from haros_ci.model.workspace import Workspace
from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.workspace.third_party import around

_LICENCE = regex(r"(?:licen[cs]e|copying)(?:\.(?:txt|md|rst))?", re.IGNORECASE)
_PERSON = regex(r"<(?:maintainer|author)\b([^<>]{0,300})>([^<>]{0,300})<")
_REMARK = regex(r"<!--.*?(?:-->|\Z)", re.DOTALL)
_MAIL = regex(r"email\s*=\s*[\"']([^\"'<>]{1,200})[\"']")
#: A page or repository of what the package was before it got another name: ``http://wiki.ros.org/map_server``.
_PAGE = regex(
    r"<url\b[^<>]{0,100}>\s*https?://(?:www\.)?(?:wiki\.ros\.org|ros\.org/wiki|index\.ros\.org/p|github\.com/[\w.-]{1,100})/"
    r"([\w-]{1,100})(?:\.git)?(?:/issues|/wiki)?/?\s*<"
)
#: Packages that many workspaces copy and that no distribution has, as makers publish their drivers: how they are called, and who is named in their manifests.
#: Both must fit: a name alone is anybody's.
_MAKERS = tuple(
    (regex(name), regex(people))
    for name, people in (
        (r"rplidar_ros2?|sllidar_ros2", r"@slamtec\.com"),
        (r"livox_(?:ros2?_driver2?|interfaces\d?)", r"@livoxtech\.com"),
        (r"lslidar_\w+", r"@lslidar\.com|tongsky723@sina\.com|yutongyan@lidar\.com"),
        (r"rslidar(?:_sdk|_msgs?|_driver|_pointcloud)?", r"@robosense\.cn"),
        (r"ydlidar(?:_ros2?_driver)?", r"@ydlidar\.com|@eaibot\.com"),
        (r"nvilidar_ros2?", r"@nvistar\.com"),
        (r"(?:astra_camera|orbbec_camera|orbbec_description)(?:_msgs)?", r"@orbbec\.com|jian\.dong@pobox\.com"),
        (r"rf2o_laser_odometry", r"jgmonroy@uma\.es"),
        (r"kiss_icp", r"ignaciovizzo@gmail\.com"),
        (r"lio_sam", r"shant@mit\.edu"),
        (r"darknet_ros(?:_msgs)?", r"marko\.bjelonic@|mbjelonic@"),
        (r"ldlidar(?:_\w+)?", r"@ldrobot\.com"),
        (r"robotiq_\w+", r"@robotiq\.com"),
        (r"zed_\w+|zed-ros-\w+|rviz[-_]plugin[-_]zed[-_]\w+", r"@stereolabs\.com"),
        (r"ublox_msg_filters", r"@dataspeedinc\.com"),
        (r"(?:xarm|uf)_\w+", r"@ufactory\.cc"),
        (r"phantom_omni", r"@danepowell\.com"),
        (r"ros2_control_demo_\w+|ros2_control_test_nodes", r"@stoglrobotics\.|bence\.magyar"),
        (r"ur_\w+", r"@fzi\.de|@universal-robots\.com"),
        (r"ndt_omp|fast_gicp|hdl_\w+", r"koide@|k\.koide@"),
        (r"joy_tester|articubot_one", r"josh\.newans@gmail\.com"),
        (
            r"kindr(?:_\w+)?|elevation_mapping(?:_\w+)?|any_\w+|grid_map\w*|message_logger|multi_dof_\w+|param_io|point_cloud_io|signal_handler",
            r"@anybotics\.com|@ethz\.ch",
        ),
        (r"fast_lio", r"@livoxtech\.com|zhangji@cmu\.edu"),
        (r"bspline_\w+|path_searching|plan_(?:env|manage)|ego_planner|traj_utils", r"iszhouxin@zju\.edu\.cn"),
        (r"btcpp_ros2_\w+|behaviortree_ros2", r"davide\.faconti@"),
        (r"vectornav(?:_msgs)?", r"dereck@gmail\.com|@vectornav\.com"),
        (r"vicon_bridge", r"devansh@umich\.edu|achtelik@"),
        (r"airsim_\w+", r"ratneshmadaan@"),
        (r"gem_\w+", r"hangcui1201@"),
        (r"wit_(?:ros_imu|ros2?_driver|node)", r"@wit-motion\.com"),
    )
)
#: Pages that templates put into whatever they make: the MoveIt Setup Assistant its own.
_OF_TEMPLATES = frozenset(("moveit", "moveit2", "moveit_setup_assistant"))
#: What templates put in the place of a name or an address.
_NOBODY = regex(
    r"to-?do|example\.|moveit setup assistant|assistant@moveit|jane doe|\byou(?:r|@)|^(?:user|root|ubuntu|ros|pi|robot|admin|maintainer)\b|localhost",
    re.IGNORECASE,
)
#: The version of templates: nothing that was released has it.
_UNRELEASED = ("", "0.0.0")
#: Addresses of anybody, which tell no organisation.
_OF_ANYBODY = regex(
    r"(?:g(?:oogle)?mail|hotmail|outlook|live|msn|yahoo|icloud|me|mac|aol|gmx|web|proton(?:mail)?|pm|yandex|mail|qq|1[26]3|foxmail|sina|naver|hanmail|daum|kakao"
    r"|users\.noreply\.github|noreply\.github|github|todo|example)\.[\w.]+"
)
#: Versions that packages have by chance, and directories that are no stack.
_USUAL = (*_UNRELEASED, "0.0.1", "0.1.0", "1.0.0")
_TOP = ("", "src")
#: How often the people of packages that are no copies are added to the team; beyond, nothing is a copy.
_MOST_ROUNDS = 20
#: A downloaded archive: the name of the repository and that of a branch or commit.
_ARCHIVE = regex(
    r".+-(?:master|main|devel|develop|ros[12]|[a-z]+-devel|groovy|hydro|indigo|jade|kinetic|lunar|melodic|noetic|dashing|eloquent|foxy"
    r"|galactic|humble|iron|jazzy|kilted|rolling|(?=[0-9a-f]{0,39}[a-f])(?=[0-9a-f]{0,39}\d)[0-9a-f]{7,40})"
)
#: First words that names of packages have by chance.
_COMMON = frozenset(
    "robot ros ros2 my map move nav navigation simple image camera laser joint joy teleop sensor rviz".split()
)


def quiet(workspace: Workspace, settings: Settings) -> Workspace:
    """*workspace* with the copies of public packages marked as copies of other projects, unless something is compared or asked for."""
    is_compared = settings.baseline or settings.baseline_rev or settings.base_missing
    if is_compared or settings.with_copies or workspace.targets is not None:
        return workspace
    people = _people_of(workspace)
    directories, changed = _copies(workspace, people)
    directories |= foreign_projects(workspace, people)
    if not directories:
        return workspace
    files = (
        file if file.third_party or file.path in changed else replace(file, third_party=around(file.path, directories))
        for file in workspace.files
    )
    return replace(workspace, files=tuple(files))


def copies(workspace: Workspace) -> frozenset[str]:
    """The outermost directories in which all packages are copies of public ones.

    A package is one if a distribution has its name, or that of the page or repository that it names, or it is a driver that its maker publishes, or it lies in an archive that was
    downloaded, or it was put in whole and hardly changed (imported_copies), or it was never released and stands beside one that is in all else its like; and if it names people, none of whom any other package names; outside of archives its name may not begin as one of those either. With nothing of its own a workspace is the original.
    """
    return _copies(workspace, _people_of(workspace))[0]


def _copies(workspace: Workspace, people: Mapping[str, frozenset[str]]) -> tuple[frozenset[str], frozenset[str]]:
    """These directories, and the files below them that the team has changed in packages that are no public ones; *people* are those of each package by its path."""
    put_in = imported(workspace, people, lambda package: _manifest(package, workspace))
    public = _public(workspace)
    candidates = [*public, *(one for one in workspace.packages if one.path in put_in and one not in public)]
    own = [package for package in workspace.packages if package not in candidates]
    if not own:
        return frozenset(), frozenset()
    words = {_first_word(package.name) for package in own} - _COMMON
    foreign = _by_others(candidates, own, _Own(people, frozenset(words), frozenset(put_in)))
    found = {package.path for package in foreign}
    changed = frozenset[str]().union(*(put_in.get(package.path, ()) for package in foreign if package not in public))
    return _outermost(found, [package.path for package in workspace.packages if package.path not in found]), changed


def _public(workspace: Workspace) -> list[Package]:
    """The packages that would be copies of public ones if they are by others than the team."""
    public = [package for package in workspace.packages if _may_be_public(package, workspace)]
    stacks = [package for package in workspace.packages if _is_of_a_stack(package, public, workspace)]
    in_repositories = _in_repositories(public, workspace)
    return [*public, *stacks, *(package for package in in_repositories if package not in stacks)]


@dataclass(frozen=True, slots=True)
class _Own:
    """What tells copies from the team's packages: the *people* of each package by its path, first *words* of the names of the team's, and the paths of those that were *put_in* whole."""

    people: Mapping[str, frozenset[str]]
    words: frozenset[str]
    put_in: frozenset[str]

    def is_foreign(self, package: Package, team: frozenset[str]) -> bool:
        """Whether *package* is by others than the *team*, and its name begins as none of theirs, unless it lies in an archive or was put in whole."""
        by = self.people[package.path]
        is_sure = _is_archived(package.path) or package.path in self.put_in
        return bool(by) and team.isdisjoint(by) and (is_sure or _first_word(package.name) not in self.words)


def _by_others(candidates: Sequence[Package], own: Sequence[Package], known: _Own) -> list[Package]:
    """Those of *candidates* that are by others than all packages beside: whoever has a part in one that is no copy is one of the team."""
    people = frozenset[str]().union(*(known.people[package.path] for package in own))
    for _ in range(_MOST_ROUNDS):
        foreign = [package for package in candidates if known.is_foreign(package, people)]
        if len(foreign) in (0, len(candidates)):
            return foreign
        paths = {package.path for package in foreign}
        people = people.union(*(known.people[package.path] for package in candidates if package.path not in paths))
        candidates = foreign
    return []


def _may_be_public(package: Package, workspace: Workspace) -> bool:
    if package.path == ".":
        return False
    if _is_archived(package.path) or _is_of_a_maker(package, workspace):
        return True
    is_package = knowledge().is_package
    return package.version not in _UNRELEASED and (
        is_package(package.name) is True
        or any(is_package(name) is True for name in {*_PAGE.findall(_manifest(package, workspace))} - _OF_TEMPLATES)
    )


def _is_of_a_maker(package: Package, workspace: Workspace) -> bool:
    people = next((pattern for name, pattern in _MAKERS if name.fullmatch(package.name)), None)
    named = _PERSON.findall(_manifest(package, workspace)) if people is not None else []
    return people is not None and any(people.search(attributes.lower()) for attributes, _ in named)


def _is_of_a_stack(package: Package, public: Iterable[Package], workspace: Workspace) -> bool:
    """Whether *package*, which was never released, stands in one directory with a *public* one of the same version and by one of the same people.

    The packages of a stack get a new version together; versions of templates say nothing. What lies at the top or in ``src`` is no stack.
    """
    stack = package.path.rpartition("/")[0]
    if package in public or stack.rpartition("/")[2] in _TOP or package.version in _USUAL:
        return False
    by = _people(package, workspace)
    return any(
        other.path.rpartition("/")[0] == stack
        and other.version == package.version
        and not by.isdisjoint(_people(other, workspace))
        for other in public
    )


def _in_repositories(public: Sequence[Package], workspace: Workspace) -> list[Package]:
    """The packages in one directory with a *public* one, which has a licence of its own as a repository has, by people of the same organisation, whom no package elsewhere names.

    A repository that is cloned into a workspace often has packages, too, that no distribution has: plug-ins, tests, what is new in it.
    """
    by_stack: dict[str, list[Package]] = {}
    for package in workspace.packages:
        by_stack.setdefault(package.path.rpartition("/")[0], []).append(package)
    licensed = {path.rpartition("/")[0] for path in workspace.names if _LICENCE.fullmatch(path.rpartition("/")[2])}
    organisations = {package.path: _organisations(_people(package, workspace)) for package in workspace.packages}
    found: list[Package] = []
    for stack in sorted({package.path.rpartition("/")[0] for package in public}):
        if stack not in licensed or stack.rpartition("/")[2] in _TOP:
            continue
        inside = by_stack[stack]
        of_public = frozenset[str]().union(*(organisations[package.path] for package in inside if package in public))
        outside = (organisations[package.path] for package in workspace.packages if package not in inside)
        owners = of_public.difference(*outside)
        found += (one for one in inside if one not in public and not owners.isdisjoint(organisations[one.path]))
    return found


def _organisations(people: Iterable[str]) -> frozenset[str]:
    """What addresses say of where people work: what is behind the ``@``, but for those that anybody may have."""
    places = (word.rpartition("@")[2] for word in people if "@" in word)
    return frozenset(place for place in places if place and _OF_ANYBODY.fullmatch(place) is None)


def _manifest(package: Package, workspace: Workspace) -> str:
    """The text of a manifest without comments, in which templates keep people and pages that are nobody's."""
    text = workspace.text("package.xml" if package.path == "." else f"{package.path}/package.xml")
    return _REMARK.sub("", text)


def _is_archived(path: str) -> bool:
    return any(map(_ARCHIVE.fullmatch, path.split("/")))


def _people_of(workspace: Workspace) -> Mapping[str, frozenset[str]]:
    return {package.path: _people(package, workspace) for package in workspace.packages}


def _people(package: Package, workspace: Workspace) -> frozenset[str]:
    """Names and addresses of who maintains or wrote a package, without those of templates."""
    found: set[str] = set()
    for attributes, name in _PERSON.findall(_manifest(package, workspace)):
        mail = _MAIL.search(attributes)
        found.update(part.strip().lower() for part in (name, mail[1] if mail else ""))
    return frozenset(word for word in found if word and not _NOBODY.search(word))


def _first_word(name: str) -> str:
    return name.lower().replace("-", "_").partition("_")[0]


def _outermost(found: Iterable[str], others: Iterable[str]) -> frozenset[str]:
    """The *found* directories, and those around them that have none of the *others* in them instead."""
    around_others = {"."}
    for path in others:
        parts = path.split("/")
        around_others.update("/".join(parts[: i + 1]) for i in range(len(parts)))
    outer: set[str] = set()
    for path in found:
        parts = path.split("/")
        ways = ("/".join(parts[: i + 1]) for i in range(len(parts)))
        outer.add(next((way for way in ways if way not in around_others), path))
    return frozenset(outer)
