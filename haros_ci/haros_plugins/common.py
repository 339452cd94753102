# SPDX-License-Identifier: Apache-2.0
"""The rules and metrics that HAROS's plug-ins share (HAROS definitions.yaml): names and bounds."""

from __future__ import annotations

#: The least and the greatest value of each metric, None for no bound.
METRICS: dict[str, tuple[float, float | None]] = {
    "comment_ratio": (0, 1),
    "comments": (0, None),
    "coupling": (0, None),
    "cyclomatic_complexity": (1, None),
    "depth_in_tree": (1, None),
    "eloc": (0, None),
    "function_calls": (0, None),
    "function_parameters": (0, None),
    "halstead_bugs": (0, None),
    "halstead_time": (0, None),
    "halstead_volume": (0, None),
    "lloc": (0, None),
    "maintainability_index": (0, 100),
    "methods_available": (1, None),
    "nested_control": (0, None),
    "number_of_children": (0, None),
    "ploc": (0, None),
    "sloc": (0, None),
    "static_path_count": (1, None),
    "unique_function_calls": (0, None),
    "weighted_methods": (1, None),
}

#: The rules by their ids.
RULES = (
    "halstead_bugs_above_2", "halstead_volume_above_8000", "max_comment_ratio_30", "max_comment_ratio_40",
    "max_control_nesting_4", "max_control_nesting_5", "max_coupling_objects_5", "max_cyclomatic_complexity_10",
    "max_cyclomatic_complexity_15", "max_deepest_inheritance_5", "max_eloc_50", "max_eloc_70", "max_file_length_400",
    "max_function_calls_10", "max_function_calls_7", "max_function_length_40", "max_function_parameters_6",
    "max_immediate_children_10", "max_methods_available_20", "max_static_path_200", "max_static_path_250",
    "max_static_path_80", "max_weighted_methods_100", "max_weighted_methods_50", "mi_below_20", "mi_below_65",
    "min_comment_ratio_20", "no_global_names",
)  # fmt: skip
