# SPDX-License-Identifier: Apache-2.0
"""``rules.json`` and ``metrics.json``: rules under HAROS's ids where one of ours is one of HAROS's, and HAROS's 21 metrics."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from haros_ci.haros_json.texts import words
from haros_ci.records import dataclass, field
from haros_ci.results.rule import Rule

#: HAROS's common rules (definitions.yaml); those of its plug-ins begin with the plug-in's name.
COMMON = frozenset(
    "max_comment_ratio_30 max_comment_ratio_40 min_comment_ratio_20 max_cyclomatic_complexity_10 max_cyclomatic_complexity_15"
    " max_function_length_40 max_function_parameters_6 max_file_length_400 max_eloc_50 max_eloc_70 halstead_volume_above_8000"
    " halstead_bugs_above_2 mi_below_20 mi_below_65 max_function_calls_7 max_function_calls_10 max_control_nesting_4"
    " max_control_nesting_5 max_static_path_80 max_static_path_200 max_static_path_250 max_coupling_objects_5"
    " max_immediate_children_10 max_weighted_methods_50 max_weighted_methods_100 max_methods_available_20"
    " max_deepest_inheritance_5 no_global_names".split()
)
#: HAROS's metrics: id, name, scope, least and greatest value, what it is in our words.
METRICS: tuple[tuple[str, str, str, float | None, float | None, str], ...] = (
    ("comment_ratio", "Comment Ratio", "file", 0, 1.0, "The part of the lines that are not blank that hold a comment."),
    ("comments", "Lines of Comments", "file", 0, None, "Lines that hold a comment."),
    ("coupling", "Coupling Between Objects", "file", 0, None, "Other classes that a class uses."),
    (
        "cyclomatic_complexity",
        "Cyclomatic Complexity",
        "file",
        1,
        None,
        "Independent paths through a function: one more than its branches.",
    ),
    ("depth_in_tree", "Deepest Level of Inheritance", "file", 1, None, "Classes above a class, itself included."),
    ("eloc", "Executable Lines of Code", "file", 0, None, "Lines of code that are more than braces."),
    ("function_calls", "Number of Function Calls", "function", 0, None, "Calls that a function makes."),
    ("function_parameters", "Number of Function Parameters", "function", 0, None, "Parameters that a function takes."),
    ("halstead_bugs", "Number of Delivered Bugs", "file", 0, None, "Bugs in a file, as Halstead estimates them."),
    (
        "halstead_time",
        "Time Required to Program",
        "file",
        0,
        None,
        "Seconds to write a file, as Halstead estimates them.",
    ),
    (
        "halstead_volume",
        "Halstead Volume",
        "file",
        0,
        None,
        "Operators and operands, by the number of distinct ones.",
    ),
    ("lloc", "Logical Lines of Code", "file", 0, None, "Statements."),
    (
        "maintainability_index",
        "Maintainability Index",
        "file",
        0,
        100,
        "A score from volume, complexity, lines and comments.",
    ),
    ("methods_available", "Methods Available in Class", "file", 1, None, "Methods that a class offers."),
    ("nested_control", "Nesting of Control Structures", "function", 0, None, "Control structures within each other."),
    (
        "number_of_children",
        "Number of Immediate Children",
        "file",
        0,
        None,
        "Classes that are derived from a class directly.",
    ),
    ("ploc", "Program Lines of Code", "file", 0, None, "Lines that hold code: neither blank nor comments alone."),
    ("sloc", "Source Lines of Code", "file", 0, None, "Lines that are not blank."),
    (
        "static_path_count",
        "Estimated Static Path Count",
        "function",
        1,
        None,
        "Paths through a function, loops taken once.",
    ),
    (
        "unique_function_calls",
        "Number of Distinct Function Calls",
        "function",
        0,
        None,
        "Distinct functions that a function calls.",
    ),
    (
        "weighted_methods",
        "Weighted Methods per Class",
        "file",
        1,
        None,
        "The complexities of the methods of a class, added up.",
    ),
)

#: A rule with the name of its tool.
Named = tuple[str, Rule]


def is_harosid(alias: str) -> bool:
    return alias.startswith("haros_plugin_") or alias in COMMON


@dataclass(frozen=True, slots=True)
class RuleTable:
    """The rules of a run by ``tool:id``; *scopes* are those of checks and queries, *queries* the texts of the latter.

    *documented* are all that there are: a rule goes by its HAROS id if it has one, and no other rule has the same.
    """

    shown: Mapping[str, Named]
    documented: Iterable[Named] = ()
    scopes: Mapping[str, str] = field(default_factory=dict)
    queries: Mapping[str, str] = field(default_factory=dict)
    _ids: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        every = {f"{tool}:{rule.id}": rule for tool, rule in (*self.documented, *self.shown.values())}
        uses = Counter(alias for rule in every.values() for alias in set(rule.aliases) if is_harosid(alias))
        for full in self.shown:
            rule = self.shown[full][1]
            known = [alias for alias in rule.aliases if is_harosid(alias)]
            own = rule.id if rule.id.startswith("user:") else full
            self._ids[full] = known[0] if len(known) == 1 and uses[known[0]] == 1 and own == full else own

    def id(self, full: str) -> str:
        """The id under which the rule ``tool:id`` is shown."""
        return self._ids[full]

    def tags(self, full: str) -> tuple[str, ...]:
        return self.shown[full][1].tags

    def json(self) -> list[dict[str, Any]]:
        """``rules.json``. A rule's name is how settings and comments of ours write it."""
        made = {}
        for full, (_, rule) in sorted(self.shown.items()):
            id = self.id(full)
            made[id] = {
                "id": id,
                "name": words(rule.id if rule.id.startswith("user:") else full),
                "scope": self.scopes.get(full, "file"),
                "description": words(rule.summary or rule.id),
                "tags": [words(tag) for tag in rule.tags],
                "query": self.queries.get(full),
            }
        return [made[id] for id in sorted(made)]


def metrics_json() -> list[dict[str, Any]]:
    """``metrics.json``."""
    return [
        {"id": id, "name": name, "scope": scope, "description": text, "minimum": least, "maximum": most}
        for id, name, scope, least, most, text in METRICS
    ]
