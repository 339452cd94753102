# SPDX-License-Identifier: Apache-2.0
"""Packages whose Python modules installed files import, and that no declared dependency brings."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace

from haros_ci.api import (
    Check,
    Finding,
    Fix,
    Level,
    Location,
    Project,
    ProjectPackage,
    dataclass,
    line_of,
    listed,
    regex,
    spelled_out,
)
from haros_ci.api.code import parsed_of_any_version
from haros_ci.api.packages import (
    Need,
    Provisions,
    Reason,
    add_dependency,
    closes_a_cycle,
    dependency_tags,
    distributions_of,
    first_provider,
    imports_of,
    is_called_after,
    is_for_older,
    is_for_tests,
    is_of_ros,
    lacking,
    last_dependency,
    left_to_pip,
    needs_of,
    normal,
    only_for_tests,
    others_of,
    pinned,
    proposed_before,
    said_misplaced,
    unreached,
)

#: So many places of one module are related.
_SHOWN = 3
_PIP = regex(r"\bpip3?\s+install\s+([^;&|]*)")
_PYTHON2 = regex(r"#![^\n]*\bpython2(?:\.\d)?\b")
_PYTHON = regex(r"#![^\n]*\bpython(?![\w.])")
_KEY = regex(r"^python3?-|-pip$")


@dataclass(frozen=True, slots=True)
class _UndeclaredModule:
    """A package that is not declared: what to declare, *others* that would do as well, and the modules of it that are imported.

    *pin* is where pip is asked for a version of it, *left* where the package leaves it to pip on purpose. *is_idle* says that nothing which runs
    imports it, *is_older* that files for Python 2 do, for which there is no key any more.
    """

    name: str
    others: tuple[str, ...]
    uses: tuple[Need, ...]
    is_certain: bool
    pin: Location | None
    left: Location | None = None
    is_idle: bool = False
    is_older: bool = False

    @property
    def modules(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(use.what.removeprefix("import ") for use in self.uses))

    @property
    def level(self) -> Level | None:
        """bloom takes no keys of pip, and the system has one version only: many have their users install such by hand."""
        is_pip = all(key.endswith("-pip") for key in (self.name, *self.others))
        return Level.NOTE if is_pip or self.is_idle or self.pin is not None or self.left is not None else None


def check(project: Project) -> Iterator[Finding]:
    provisions, sources = Provisions(project), project.sources
    proposed = dict(proposed_before(Reason.IMPORT, project))
    for package in project.packages:
        needs = list(imports_of(package, sources)) if package.manifest is not None else []
        provided = provisions.of(package, tests=False) if needs else None
        by_pip = set(_by_pip(package)) if needs else set()
        missing: dict[frozenset[str], list[Need]] = {}
        for need in needs:
            if provided is None or _called(need) & by_pip or _is_named(need, package):
                continue
            if provisions.lacks(provided, need.providers):
                missing.setdefault(need.providers, []).append(need)
        if not missing:
            continue
        built = lacking(package, needs_of(package, sources), provisions)  # that is there when it runs, too
        pins, left = pinned(package), left_to_pip(package)
        aside = unreached(package, {use.location.path for uses in missing.values() for use in uses})
        groups: dict[tuple[Level | None, bool, bool], list[_UndeclaredModule]] = {}
        for providers, uses in missing.items():
            tested = sorted(providers & package.declared)
            if providers & built:
                continue
            if tested:
                if more := _beside_tests(package, uses):
                    yield _only_tested(package, tested[0], more)
            else:
                running = [use for use in uses if use.location.path not in aside]
                other_missing = replace(_missing(package, running or uses, pins, left), is_idle=not running)
                is_circular = closes_a_cycle(package.name, other_missing.name, project.manifests, proposed)
                groups.setdefault((other_missing.level, is_circular, other_missing.is_idle), []).append(other_missing)
                if not is_circular:
                    proposed[package.name] = proposed.get(package.name, frozenset()) | {other_missing.name}
        for (_, is_circular, _), group in groups.items():
            yield _circular(package, group) if is_circular else _finding(package, group)


def _called(need: Need) -> frozenset[str]:
    """The names that pip may have for what brings a module."""
    stems = (normal(_KEY.sub("", name)) for name in need.providers)
    return distributions_of(need.what.removeprefix("import ")).union(stems)


def _is_named(need: Need, package: ProjectPackage) -> bool:
    """Whether the manifest declares, for more than tests, a package that is called after the module."""
    module = need.what.removeprefix("import ")
    return any(
        is_called_after(dependency.name, module)
        for dependency in package.raw.dependencies
        if dependency.kind != "test_depend"
    )


def _missing(
    package: ProjectPackage, uses: list[Need], pins: Mapping[str, Location], left: Mapping[str, Location]
) -> _UndeclaredModule:
    name = _of_its_python(first_provider(uses[0].providers, package), uses, package)
    others = others_of(uses[0].providers, name, package)
    is_certain = not others and is_of_ros(name, package.project)
    if name.startswith(("python3-", "python-")) and not name.endswith("-pip"):
        others = []  # of the other Python, of pip, or with more than the module
    called = [item for use in uses for item in sorted(_called(use))]
    pin = next((pins[item] for item in called if item in pins), None)
    by_pip = next((left[item] for item in called if item in left), None)
    if any(is_of_ros(provider, package.project) for provider in uses[0].providers):
        by_pip = None  # pip has no packages of ROS
    is_older = _lacks_python3(name, uses, package)
    return _UndeclaredModule(name, tuple(others), tuple(uses), is_certain, pin, by_pip, is_older=is_older)


def _of_its_python(name: str, uses: list[Need], package: ProjectPackage) -> str:
    """The key for Python 2 in place of *name* where only files for that Python import the module, and rosdep has such a key."""
    if not _lacks_python3(name, uses, package):
        return name
    older = f"python-{name.removeprefix('python3-')}"
    keys = [key for key in sorted(uses[0].providers) if key.startswith("python-")]
    if older in keys or package.project.knowledge.is_key(older):
        return older
    return keys[0] if keys and all(key.startswith(keys[0]) for key in keys) else name


def _lacks_python3(name: str, uses: list[Need], package: ProjectPackage) -> bool:
    """Whether *name* is a key for Python 3, and all that imports the module are files for Python 2."""
    if package.ros != 1 or not name.startswith("python3-"):
        return False
    is_old = is_for_older(package.project)
    return all(_is_older(package.project.text(use.location.path), is_old) for use in uses)


def _is_older(text: str, is_old: bool) -> bool:
    """Whether a file is for Python 2: it asks for it, Python 3 refuses it, or it asks for any in a workspace for distributions of ROS 1 that are old (*is_old*)."""
    if _PYTHON2.match(text) or (is_old and _PYTHON.match(text)):
        return True
    module = parsed_of_any_version(text)
    return module is not None and module[2]


def _by_pip(package: ProjectPackage) -> Iterator[str]:
    """What the build itself installs with pip."""
    for command in package.commands("execute_process", "add_custom_command", "add_custom_target", "install"):
        for match in _PIP.finditer(" ".join(command.arguments)):
            yield from (normal(re.split(r"[=<>~!\[]", word.strip("\"'"))[0]) for word in match[1].split())


def _finding(package: ProjectPackage, group: list[_UndeclaredModule]) -> Finding:
    """One finding for all modules of which the same is at stake: they are declared in one place."""
    kind = "exec_depend" if package.raw.format > 1 else "run_depend"
    modules = tuple(module for missing in group for module in missing.modules)
    lines = [
        f"{dependency_tags(package, kind, missing.name)}{_alternative(missing, _is_left_to_pip(group))}"
        for missing in group
    ]
    if len(group) == 1:
        them, fails = "it", f"the import fails on a machine without {group[0].name}"
    else:
        them, fails = "them", "the imports fail on a machine without these packages"
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} imports {listed(modules)}, but package.xml declares no package that provides {them}: "
        f"{fails}; add {spelled_out(lines)}{_by_choice(group)}{_of_python2(group)}{_aside(group)}{said_misplaced(package, (missing.name for missing in group))}",
        about=(package.name, *modules),
        related=tuple(place for missing in group for place in _places(missing)),
        apart=modules,
        level=group[0].level,
        fixes=_fixes(package, group),
    )


def _by_choice(group: list[_UndeclaredModule]) -> str:
    """Where the package leaves them to pip, if that is not only by a version."""
    left = {
        missing.name: missing.left or missing.pin
        for missing in group
        if missing.left is not None or missing.pin is not None
    }
    if not _is_left_to_pip(group):
        return ""
    what = ("it" if len(left) == 1 else "them") if len(left) == len(group) else listed(list(left))
    places = list(dict.fromkeys(line_of(place) for place in left.values() if place is not None))
    return f", unless pip is to install {what}, as {listed(places)} say{'' if len(places) > 1 else 's'}"


def _of_python2(group: list[_UndeclaredModule]) -> str:
    """That the keys do not fit the Python of the scripts."""
    older = any(missing.is_older for missing in group)
    return "; no such key of Python 2, which the scripts are for, is known: port them" if older else ""


def _is_left_to_pip(group: list[_UndeclaredModule]) -> bool:
    """Whether one of them is left to pip by more than a version: then all packages that pip may install are reported in one finding."""
    return any(missing.left is not None and missing.pin is None for missing in group)


def _aside(group: list[_UndeclaredModule]) -> str:
    """That only files import it which nothing starts or imports."""
    files = (
        sorted({use.location.path for missing in group for use in missing.uses})
        if all(missing.is_idle for missing in group)
        else []
    )
    if not files:
        return ""
    shown = listed([path.rpartition("/")[2] for path in files[:_SHOWN]] + ["others"] * (len(files) > _SHOWN))
    return f" (nothing here starts or imports {shown}, which may as well go)"


def _circular(package: ProjectPackage, group: list[_UndeclaredModule]) -> Finding:
    """The packages of the modules need *package*: build tools refuse both in a row."""
    modules = tuple(module for missing in group for module in missing.modules)
    names = [missing.name for missing in group]
    need, them = ("needs", "it") if len(names) == 1 else ("need", "them")
    return Finding(
        at=last_dependency(package),
        message=f"{package.name} imports {listed(modules)}, but package.xml does not declare {listed(names)}, which in turn {need} "
        f"{package.name}: with {them} declared the build tool stops at the circular dependency; move what imports {them} out of "
        f"{package.name}",
        about=(package.name, *modules),
        related=tuple(place for missing in group for place in _places(missing)),
        apart=modules,
        level=Level.WARNING,
    )


def _alternative(missing: _UndeclaredModule, is_told: bool) -> str:
    """What would do as well; *is_told* where the message says for all together that pip may install them."""
    pin = ""
    if missing.pin is not None and not is_told:
        pin = f", unless pip is to install it: {line_of(missing.pin)} asks for a version"
    older = " (of Python 3)" if missing.is_older else ""
    return older + (f" (or {', '.join(missing.others)})" if missing.others else "") + pin


def _places(missing: _UndeclaredModule) -> Iterator[tuple[Location, str]]:
    for use in missing.uses[:_SHOWN]:
        yield use.location, f"needs {missing.name}: {use.what}"
    if missing.pin is not None:
        yield missing.pin, "pip is asked for a version here"
    elif missing.left is not None:
        yield missing.left, "it is left to pip here"


def _fixes(package: ProjectPackage, group: list[_UndeclaredModule]) -> tuple[Fix, ...]:
    made = [add_dependency(package, "exec_depend", missing.name) if missing.is_certain else None for missing in group]
    fixes = [fix for fix in made if fix is not None]
    if len(fixes) < len(group):
        return ()
    return (
        Fix(
            f"declare {listed([missing.name for missing in group])}", tuple(edit for fix in fixes for edit in fix.edits)
        ),
    )


def _beside_tests(package: ProjectPackage, uses: list[Need]) -> list[Need]:
    """Those of *uses* that stand in files which more than tests use."""
    if is_for_tests(package):
        return []
    for_tests = only_for_tests(package, {use.location.path for use in uses})
    return [use for use in uses if use.location.path not in for_tests]


def _only_tested(package: ProjectPackage, name: str, uses: list[Need]) -> Finding:
    """What the manifest has for tests alone, and more than tests use."""
    modules = tuple(dict.fromkeys(use.what.removeprefix("import ") for use in uses))
    kind = "exec_depend" if package.raw.format > 1 else "run_depend"
    line = next((dependency.line for dependency in package.raw.dependencies if dependency.name == name), None)
    return Finding(
        at=Location(package.manifest_path, line or 1),
        message=f"{package.name} imports {name} ({uses[0].what}), but declares it for tests only: an installation without "
        f"tests lacks it; write {dependency_tags(package, kind, name)}",
        about=(package.name, *modules),
        level=Level.WARNING,
        related=tuple((use.location, f"needs {name}: {use.what}") for use in uses[:_SHOWN]),
        apart=modules,
    )


CHECK = Check(
    id="undeclared-import",
    summary="Python import that package.xml does not declare.",
    level=Level.ERROR,
    project=check,
    catalogue="M02",
    tags=("packages", "python"),
)
