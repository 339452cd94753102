# SPDX-License-Identifier: Apache-2.0
"""A project file, ours or HAROS's, as the values of Settings that it sets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from haros_ci.config.access import read_access
from haros_ci.config.declared import EXEC_KEYS, read_declared
from haros_ci.config.exemptions import read_exemptions
from haros_ci.config.haros import HOME_KEYS, PROJECT_KEYS, read_haros
from haros_ci.config.settings import PROFILES, LinterSettings, PackagePolicy, PathPolicy, Policy
from haros_ci.config.shapes import MAX_ENTRIES, File, NamedShape, kind
from haros_ci.config.suggestion import quoted
from haros_ci.config.yaml_lines import YamlValue, parse, plain
from haros_ci.errors import UserError
from haros_ci.model.api import RowError, load_row
from haros_ci.model.declared_tool import DeclaredTool
from haros_ci.records import dataclass
from haros_ci.results.rule import Level

OWN_KEYS = (
    "profile", "select", "ignore", "levels", "per-package", "per-path", "exceptions", "exclude", "linters", "fail-on", "max-file-size",
    "compile-database", "baseline", "plugins", "plugin_whitelist", "apis", "known_nodes",
    "environment_files", "access",
)  # fmt: skip
KNOWN_KEYS = (*OWN_KEYS, *PROJECT_KEYS, *HOME_KEYS)
POLICY_KEYS = ("select", "ignore", "levels")
LINTER_KEYS = ("enabled", "timeout", "arguments")
LEVELS = ("error", "warning", "note", "off")
FAIL_ON = ("error", "warning", "note", "never")
MAX_SELECTORS = 500
MAX_PATH_GLOBS = 200
MAX_ROW_TEXT = 500  # characters of one text in an API row; selectors are parsed in quadratic time


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectFile:
    """*values* are fields of Settings; *origins* and *notes* as there."""

    values: Mapping[str, Any]
    origins: tuple[tuple[str, str], ...]
    notes: tuple[str, ...]


def read_project(data: bytes, name: str, *, trust_config: bool = False) -> ProjectFile:
    """Read the project file *name*; UserError, with the line, for whatever is wrong in it.

    A file with ``haros-ci`` in its name is ours: unknown and repeated keys are errors. Any other may be one that HAROS
    reads as well, and HAROS passes over both: they are notes.
    """
    file = File(name, strict="haros-ci" in name.rsplit("/", 1)[-1])
    document = parse(data, name)
    for twice in document.duplicates:
        message = f"key {quoted(twice.key)} stands here again, first on line {twice.first}"
        if file.strict:
            raise file.error(twice.line, message, "keep one of them")
        file.note(f"{message}; the last one counts", twice.line)
    top = file.map(document.top, "a project file", "keys such as profile: ros", KNOWN_KEYS) if document.top else {}

    origins = {key: f"{name}:{value.key_line}" for key, value in top.items() if key in KNOWN_KEYS}
    haros = read_haros(file, top)
    for selector in haros.ignore:
        origins.setdefault(f"haros {selector.text}", f"{name}:{selector.line}")
    own = _Own(file, trust_config, origins)
    policy = own.policy(top)
    per_package = own.per_package(top)
    per_path = own.per_path(top)
    exemptions = read_exemptions(file, top.get("exceptions"), own.selector)
    own.check_numbers(per_path)
    own.check_apis(top)
    if "known_nodes" in top:
        file.map(top["known_nodes"], "'known_nodes'", "known_nodes: {package: {executable: {publishers: […]}}}")
    if "environment_files" in top:
        file.texts(top["environment_files"], "environment_files")
    values: dict[str, Any] = {
        "policy": Policy(
            select=policy.select,
            ignore=(*policy.ignore, *dict.fromkeys(n.text for n in haros.ignore)),
            levels=policy.levels,
        ),
        "per_package": per_package,
        "per_path": per_path,
        "exemptions": exemptions,
        "access": read_access(file, top.get("access")),
        "linters": own.linters(top, haros.disabled),
        "declared": own.declared(top),
        "packages": haros.packages,
        "ignore_files": haros.ignore_files,
        "project": plain(document.top) if document.top and top else {},
        **own.simple(top),
    }
    return ProjectFile(values=values, origins=tuple(sorted(origins.items())), notes=file.notes)


@dataclass(frozen=True, slots=True)
class _Own:
    """Reads our own keys; adds to *origins* where each selector stands."""

    file: File
    trust_config: bool
    origins: dict[str, str]

    def simple(self, top: dict[str, YamlValue]) -> dict[str, Any]:
        """The keys that set one value each."""
        file, trust = self.file, self.trust_config
        values: dict[str, Any] = {}
        if "profile" in top:
            values["profile"] = file.choice(top["profile"], "'profile'", PROFILES)
        if "exclude" in top:
            values["exclude"] = tuple(file.glob(n) for n in file.texts(top["exclude"], "exclude"))
        if "fail-on" in top:
            fail_on = file.choice(top["fail-on"], "'fail-on'", FAIL_ON)
            values["fail_on"] = None if fail_on == "never" else Level(fail_on)
        if "max-file-size" in top:
            values["max_file_size"] = file.count(top["max-file-size"], "'max-file-size'", "bytes")
        if "compile-database" in top:
            values["compile_database"] = file.path(top["compile-database"], "'compile-database'", anywhere=trust)
        if "baseline" in top:
            values["baseline"] = file.path(top["baseline"], "'baseline'", anywhere=trust)
        if "plugins" in top:
            plugins = tuple(n.text for n in file.texts(top["plugins"], "plugins"))
            if trust:
                values["plugins"] = plugins
            elif plugins:
                file.note("plugins are loaded only with --trust-config", top["plugins"].key_line)
        if "plugin_whitelist" in top:
            white = tuple(n.text for n in file.texts(top["plugin_whitelist"], "plugin_whitelist"))
            if trust:
                values["plugin_whitelist"] = white
            elif white:
                file.note("HAROS plug-ins run only with --trust-config", top["plugin_whitelist"].key_line)
        if "plugin_blacklist" in top:  # HAROS's key, which turns off tools of the same names, too
            values["plugin_blacklist"] = tuple(n.text for n in file.names(top["plugin_blacklist"], "plugin_blacklist"))
        return values

    def check_numbers(self, per_path: tuple[PathPolicy, ...]) -> None:
        """Every selector is held against every rule, every glob against every file."""
        selectors = sum(origin.startswith(("selector ", "haros ")) for origin in self.origins)
        if selectors > MAX_SELECTORS:
            raise UserError(f"{self.file.name}: more than {MAX_SELECTORS} selectors", help="use globs or tags")
        if sum(len(entry.globs) for entry in per_path) > MAX_PATH_GLOBS:
            raise UserError(f"{self.file.name}: more than {MAX_PATH_GLOBS} globs in 'per-path'", help="use wider globs")

    def check_apis(self, top: dict[str, YamlValue]) -> None:
        """Every API row is one that ``model.api.load_row`` takes."""
        if "apis" not in top:
            return
        rows = top["apis"]
        if not isinstance(rows.data, tuple):
            form = "write apis: [{call: 'robot::advertise', args: [1], makes: […]}]"
            raise self.file.error(rows.line, f"'apis' must be a list, not {kind(rows)}", form)
        if len(rows.data) > MAX_ENTRIES:
            raise self.file.error(rows.line, f"'apis' has more than {MAX_ENTRIES} rows", "leave out what is not called")
        for number, row in enumerate(rows.data, start=1):
            if fault := row_fault(row):
                line, message = fault
                raise self.file.error(line, f"row {number} of 'apis': {message}", "docs/adding-an-api.md has examples")

    def policy(self, entries: dict[str, YamlValue]) -> Policy:
        return Policy(
            select=self.selectors(entries, "select"),
            ignore=self.selectors(entries, "ignore"),
            levels=self.levels(entries),
        )

    def selectors(self, entries: dict[str, YamlValue], key: str) -> tuple[str, ...]:
        if key not in entries:
            return ()
        return tuple(self.selector(named) for named in self.file.texts(entries[key], key))

    def selector(self, named: NamedShape) -> str:
        self.origins.setdefault(f"selector {named.text}", f"{self.file.name}:{named.line}")
        return named.text

    def levels(self, entries: dict[str, YamlValue]) -> tuple[tuple[str, Level | None], ...]:
        if "levels" not in entries:
            return ()
        chosen: list[tuple[str, Level | None]] = []
        for text, value in self.file.map(entries["levels"], "'levels'", "levels: {unused-import: note}").items():
            selector = self.selector(NamedShape(text, value.key_line))
            # YAML 1.1 reads a bare off as false
            word = "off" if value.data is False else self.file.choice(value, f"the level of {quoted(text)}", LEVELS)
            chosen.append((selector, None if word == "off" else Level(word)))
        return tuple(chosen)

    def per_path(self, top: dict[str, YamlValue]) -> tuple[PathPolicy, ...]:
        if "per-path" not in top:
            return ()
        form = "per-path: {'test/**': {ignore: […]}}"
        policies: list[PathPolicy] = []
        for globs, value in self.file.map(top["per-path"], "'per-path'", form).items():
            policy, profile = self.local(globs, value, "per-path")
            names = tuple(self.path_glob(NamedShape(glob.strip(), value.key_line)) for glob in globs.split(","))
            policies.append(PathPolicy(globs=names, policy=policy, profile=profile))
        return tuple(policies)

    def per_package(self, top: dict[str, YamlValue]) -> tuple[PackagePolicy, ...]:
        if "per-package" not in top:
            return ()
        form = "per-package: {my_driver: {profile: strict}}"
        policies: list[PackagePolicy] = []
        entry: tuple[Policy, str | None]
        for names, value in self.file.map(top["per-package"], "'per-package'", form).items():
            if isinstance(value.data, str):  # as in Statick's profile.yaml: a name and its level
                entry = Policy(), self.file.choice(value, f"the profile of {quoted(names)}", PROFILES)
            else:
                entry = self.local(names, value, "per-package")
            globs = tuple(name.strip() for name in names.split(",") if name.strip())
            if not globs or len(names) > MAX_ROW_TEXT:
                raise self.file.error(value.key_line, f"{quoted(names[:40])} names no package", f"write {form}")
            policies.append(PackagePolicy(names=globs, policy=entry[0], profile=entry[1]))
        if sum(len(policy.names) for policy in policies) > MAX_PATH_GLOBS:
            raise UserError(f"{self.file.name}: more than {MAX_PATH_GLOBS} names in 'per-package'", help="use globs")
        return tuple(policies)

    def local(self, names: str, value: YamlValue, where: str) -> tuple[Policy, str | None]:
        """The policy and the profile of an entry of ``per-path`` or ``per-package``."""
        form = f"{quoted(names)}: {{ignore: […]}}"
        entries = self.file.map(value, f"{where} {quoted(names)}", form, ("profile", *POLICY_KEYS))
        chosen = self.file.choice(entries["profile"], "'profile'", PROFILES) if "profile" in entries else None
        return self.policy(entries), chosen

    def path_glob(self, glob: NamedShape) -> str:
        if glob.text.startswith("!"):
            raise self.file.error(
                glob.line, f"{quoted(glob.text)}: '!' has a meaning in 'exclude' only", "leave it out"
            )
        return self.file.glob(glob)

    def linters(
        self, top: dict[str, YamlValue], disabled: tuple[NamedShape, ...]
    ) -> tuple[tuple[str, LinterSettings], ...]:
        """By tool, sorted; what our own key says of a tool beats HAROS's plugin_blacklist."""
        chosen = {named.text: LinterSettings(enabled=False) for named in disabled}
        if "linters" in top:
            for tool, value in self.file.map(top["linters"], "'linters'", "linters: {pylint: false}").items():
                self.origins.setdefault(f"linter {tool}", f"{self.file.name}:{value.key_line}")
                chosen[tool] = self.linter(tool, value)
        return tuple(sorted(chosen.items(), key=lambda entry: entry[0]))

    def declared(self, top: dict[str, YamlValue]) -> tuple[DeclaredTool, ...]:
        """The tools with an ``exec``, in the order of their names."""
        entries = top["linters"].data if "linters" in top else None
        if not isinstance(entries, dict):
            return ()
        found = (read_declared(self.file, str(tool), value, trust=self.trust_config) for tool, value in entries.items())
        return tuple(sorted((tool for tool in found if tool is not None), key=lambda tool: tool.name))

    def linter(self, tool: str, value: YamlValue) -> LinterSettings:
        file, what = self.file, f"linter {quoted(tool)}"
        if isinstance(value.data, bool):
            return LinterSettings(enabled=value.data)
        if not isinstance(value.data, dict):
            raise file.error(value.line, f"{what} must be true, false or a map", f"write {tool}: {{timeout: 60}}")
        entries = file.map(value, what, f"{tool}: {{timeout: 60}}", (*LINTER_KEYS, *EXEC_KEYS))
        arguments = (
            tuple(n.text for n in file.texts(entries["arguments"], "arguments")) if "arguments" in entries else ()
        )
        if arguments and not self.trust_config:
            file.note(f"arguments reach {quoted(tool)} only with --trust-config", entries["arguments"].key_line)
        return LinterSettings(
            enabled=file.flag(entries["enabled"], f"'enabled' of {what}") if "enabled" in entries else None,
            timeout=float(file.number(entries["timeout"], f"'timeout' of {what}", "seconds"))
            if "timeout" in entries
            else None,
            arguments=arguments,
        )


def row_fault(row: YamlValue) -> tuple[int, str] | None:
    """Line and text of the first thing that is wrong with an API row; None if it is right.

    Keys, and the entries of ``makes``, are looked at one by one, so that each has its own line.
    """
    if not isinstance(row.data, dict):
        return row.line, f"a row is a map with a 'call', not {kind(row)}"
    if (odd := _odd(row)) is not None:
        return odd
    name = {key: plain(item) for key, item in row.data.items() if key in ("call", "class")}
    parts: list[tuple[int, dict[Any, object]]] = [(row.line, name)]
    for key, item in row.data.items():
        if key == "makes" and isinstance(item.data, tuple):
            parts += ((entry.line, {**name, key: [plain(entry)]}) for entry in item.data)
        elif key not in name:
            parts.append((item.key_line, {**name, key: plain(item)}))
    for line, part in parts:
        try:
            load_row(part)
        except RowError as err:
            in_quotes = "; put it in quotes" if str(err).endswith(" is text") else ""
            return line, f"{err}{in_quotes}"
    return None


def _odd(value: YamlValue, named: bool = True) -> tuple[int, str] | None:
    """A text without end in an API row, or a key of the row or of an entry (*named* maps) that is no text."""
    if isinstance(value.data, str):
        too_long = len(value.data) > MAX_ROW_TEXT
        return (value.line, f"a text has more than {MAX_ROW_TEXT} characters") if too_long else None
    if isinstance(value.data, tuple):
        return next((odd for item in value.data if (odd := _odd(item, named)) is not None), None)
    for key, item in value.data.items() if isinstance(value.data, dict) else ():
        if named and not isinstance(key, str):
            return item.key_line, f"key {quoted(key)} must be text"
        if len(str(key)) > MAX_ROW_TEXT:
            return item.key_line, f"a key has more than {MAX_ROW_TEXT} characters"
        if (odd := _odd(item, key == "makes")) is not None:
            return odd
    return None
