# SPDX-License-Identifier: Apache-2.0
"""The HAROS part of a project file: keys of HAROS's project files and of its configs.yaml, and what we add to them.

Whatever HAROS reads without an error is read without an error. What HAROS refuses (a configuration without launch
files, a rule without tags) is an error here, too. Keys as read by HAROS 3.10: ``extractor.py:ProjectExtractor._setup``,
``haros.py:_extract_configurations``, ``data.py:HarosSettings`` and ``HarosDatabase.register_rules``.
"""

from __future__ import annotations

from typing import Any

from haros_ci.config.on_violation import check_on_violation
from haros_ci.config.shapes import File, NamedShape, kind
from haros_ci.config.suggestion import did_you_mean, quoted
from haros_ci.config.yaml_lines import YamlValue
from haros_ci.records import dataclass

#: Keys of a HAROS project file, and of HAROS's own configs.yaml.
PROJECT_KEYS = ("project", "packages", "repositories", "configurations", "nodes", "rules", "analysis")
HOME_KEYS = ("workspace", "environment", "plugin_blacklist", "cpp")
IGNORE_KEYS = ("tags", "rules", "metrics", "files")
#: Keys of one configuration; HAROS has no arguments and environment of launch files and no ``closed``, they are ours.
CONFIGURATION_KEYS = ("launch", "hints", "hpl", "user_data", "args", "environment", "environment_files", "closed")

#: Repositories that one note names.
MAX_NAMED = 10

#: The HAROS rules on each HAROS metric (HAROS definitions.yaml); a metric without rules has nothing to ignore.
METRIC_RULES: dict[str, tuple[str, ...]] = {
    "comment_ratio": ("min_comment_ratio_20", "max_comment_ratio_30", "max_comment_ratio_40"),
    "comments": (),
    "coupling": ("max_coupling_objects_5",),
    "cyclomatic_complexity": ("max_cyclomatic_complexity_10", "max_cyclomatic_complexity_15"),
    "depth_in_tree": ("max_deepest_inheritance_5",),
    "eloc": ("max_eloc_50", "max_eloc_70"),
    "function_calls": ("max_function_calls_7", "max_function_calls_10"),
    "function_parameters": ("max_function_parameters_6",),
    "halstead_bugs": ("halstead_bugs_above_2",),
    "halstead_time": (),
    "halstead_volume": ("halstead_volume_above_8000",),
    "lloc": (),
    "maintainability_index": ("mi_below_20", "mi_below_65"),
    "methods_available": ("max_methods_available_20",),
    "nested_control": ("max_control_nesting_4", "max_control_nesting_5"),
    "number_of_children": ("max_immediate_children_10",),
    "ploc": ("max_function_length_40", "max_file_length_400"),
    "sloc": (),
    "static_path_count": ("max_static_path_80", "max_static_path_200", "max_static_path_250"),
    "unique_function_calls": (),
    "weighted_methods": ("max_weighted_methods_50", "max_weighted_methods_100"),
}
#: HAROS plug-ins that stand for one of our tools.
PLUGIN_TOOLS = ("cppcheck", "cpplint", "lizard", "pylint", "radon")


@dataclass(frozen=True, slots=True, kw_only=True)
class HarosPart:
    """What a project file says in HAROS's words. *ignore* are selectors, *disabled* tools."""

    packages: tuple[str, ...] = ()
    ignore: tuple[NamedShape, ...] = ()
    ignore_files: tuple[str, ...] = ()
    disabled: tuple[NamedShape, ...] = ()


def read_haros(file: File, top: dict[str, YamlValue]) -> HarosPart:
    """Check and read the HAROS keys among *top*; UserError where HAROS would refuse the file as well."""
    if "configurations" in top:
        _check_configurations(file, top["configurations"])
    if "nodes" in top:
        _check_nodes(file, top["nodes"])
    if "repositories" in top:
        _check_required(file, top["repositories"], "repositories", ("type", "url", "version", "packages"))
    if "rules" in top:
        _check_required(file, top["rules"], "rules", ("name", "description", "tags"))
    _say_idle(file, top)
    home = [key for key in ("workspace", "environment", "cpp") if key in top]
    if home:
        file.note(f"of no use here, where neither ROS nor a build is needed: {', '.join(home)}")
    ignore, ignore_files = _analysis(file, top.get("analysis"))
    return HarosPart(
        packages=tuple(dict.fromkeys(n.text for n in file.names(top["packages"], "packages")))
        if "packages" in top
        else (),
        ignore=ignore,
        ignore_files=ignore_files,
        disabled=_blacklist(file, top.get("plugin_blacklist")),
    )


def file_pattern(pattern: str) -> str:
    """HAROS puts ``*/`` in front of a pattern that begins neither with ``/`` nor with a wildcard."""
    return pattern if pattern[0] in "/*?[" else f"*/{pattern}"


def _analysis(file: File, value: YamlValue | None) -> tuple[tuple[NamedShape, ...], tuple[str, ...]]:
    if value is None:
        return (), ()
    analysis = file.map(value, "'analysis'", "analysis: {ignore: {tags: […], rules: […], files: […]}}", ("ignore",))
    if "ignore" not in analysis:
        return (), ()
    ignore = file.map(analysis["ignore"], "'ignore'", "ignore: {tags: […], rules: […], files: […]}", IGNORE_KEYS)
    lists = {key: file.names(ignore[key], key) for key in IGNORE_KEYS if key in ignore}
    selectors = [*lists.get("tags", ()), *lists.get("rules", ())]
    for metric in lists.get("metrics", ()):
        if metric.text in METRIC_RULES:
            selectors.extend(NamedShape(rule, metric.line) for rule in METRIC_RULES[metric.text])
        else:
            file.note(f"no metric {quoted(metric.text)} here", metric.line, did_you_mean(metric.text, METRIC_RULES))
    return tuple(selectors), tuple(file_pattern(n.text) for n in lists.get("files", ()))


def _blacklist(file: File, value: YamlValue | None) -> tuple[NamedShape, ...]:
    if value is None:
        return ()
    plugins = tuple(
        NamedShape(n.text.removeprefix("haros_plugin_"), n.line) for n in file.names(value, "plugin_blacklist")
    )
    for plugin in plugins:
        if plugin.text not in PLUGIN_TOOLS:
            file.note(f"no tool here stands for the plug-in {quoted(plugin.text)}", plugin.line)
    return tuple(plugin for plugin in plugins if plugin.text in PLUGIN_TOOLS)


def _say_idle(file: File, top: dict[str, YamlValue]) -> None:
    """Notes on what is read and has no effect: repositories to clone."""
    if names := [quoted(str(name)) for name in _entries(top, "repositories")]:
        more = f" and {len(names) - MAX_NAMED} more" if len(names) > MAX_NAMED else ""
        file.note(
            f"repositories are never cloned: {', '.join(names[:MAX_NAMED])}{more}",
            help="check them out into the workspace",
        )


def _entries(top: dict[str, YamlValue], key: str) -> dict[Any, YamlValue]:
    """What stands under a key whose value is known to be a map, if it is there."""
    value = top[key].data if key in top else None
    return value if isinstance(value, dict) else {}


def _check_configurations(file: File, value: YamlValue) -> None:
    form = "configurations: {robot: {launch: [package/launch/file.launch]}}"
    for name, item in file.map(value, "'configurations'", form).items():
        launch = item
        if not isinstance(item.data, tuple):
            what = f"configuration {quoted(name)}"
            entries = file.map(item, what, form, CONFIGURATION_KEYS)
            if "launch" not in entries:
                raise file.error(item.key_line, f"{what} has no 'launch'", f"write {form}")
            launch = entries["launch"]
            if "hints" in entries:
                file.map(entries["hints"], f"'hints' of {what}", "hints: {nodes: {/node: {…}}}")
            if "closed" in entries and not isinstance(entries["closed"].data, bool | None):
                raise file.error(
                    entries["closed"].line, f"'closed' of {what} is neither true nor false", "closed: true"
                )
            if "hpl" in entries:
                check_on_violation(file, entries["hpl"], what)
            if "environment_files" in entries:
                file.texts(entries["environment_files"], f"environment_files of {what}")
            for key, example in (("args", "args: {robot: kobuki}"), ("environment", "environment: {ROBOT: kobuki}")):
                if key in entries:
                    _check_scalars(file, entries[key], f"'{key}' of {what}", example)
        if not isinstance(launch.data, tuple):
            raise file.error(launch.line, f"'launch' must be a list, not {kind(launch)}", f"write {form}")
        for entry in launch.data:
            if not isinstance(entry.data, str) or "/" not in entry.data:
                raise file.error(
                    entry.line, "a launch file is named as package/path", "for example robot/launch/a.launch"
                )


def _check_scalars(file: File, value: YamlValue, what: str, example: str) -> None:
    """A map of texts, numbers, true and false; an empty value would be text that nobody wrote."""
    file.map(value, what, example)
    for key, item in value.data.items() if isinstance(value.data, dict) else ():
        if item.data is None or isinstance(item.data, (dict, tuple)):
            raise file.error(
                item.key_line,
                f"{quoted(str(key))} in {what} must be text, a number, true or false, not {kind(item)}",
                f"write {example}, and '' for an empty text",
            )


def _check_nodes(file: File, value: YamlValue) -> None:
    for name, item in file.map(value, "'nodes'", "nodes: {package/executable: {…}}").items():
        if name.count("/") != 1:
            raise file.error(item.key_line, f"node {quoted(name)} must be named as package/executable")
        file.map(item, f"node {quoted(name)}", "package/executable: {hpl: {…}}")


def _check_required(file: File, value: YamlValue, what: str, required: tuple[str, ...]) -> None:
    form = f"{what}: {{name: {{{', '.join(f'{key}: …' for key in required)}}}}}"
    for name, item in file.map(value, f"'{what}'", form).items():
        entry = file.map(item, f"{quoted(name)} in '{what}'", form)
        missing = [key for key in required if key not in entry]
        if missing:
            raise file.error(item.key_line, f"{quoted(name)} in '{what}' lacks {', '.join(missing)}", f"write {form}")
