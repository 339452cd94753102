# SPDX-License-Identifier: Apache-2.0
"""Every rule id of HAROS is known: it is an alias of a rule, or a sentence says why nothing reports it."""

from __future__ import annotations

import pytest
from every import every

from haros_ci.linters.catalogue import TOOLS, UNSERVED, rules_of
from haros_ci.registry import check_rules

CPPLINT = """
    line_endings comments_must_end no_copyright header_guard header_guard_format header_guard_close include_own_header
    non_ascii newline_terminator complex_comment thread_safe_functions logging_levels invalid_increment disallow_macro
    close_brace_alignment namespace_end_comment indent_access_mod string_format invalid_escape storage_before_type
    text_after_endif invalid_forward_declaration deprecated_operators const_string_ref explicit_constructors
    non_explicit_constructors whitespace_after_paren whitespace_before_paren whitespace_before_comments
    whitespace_before_comment_text todo_format disallow_in_private blank_code_line whitespace_before_brackets
    whitespace_colon whitespace_assign whitespace_binary_op whitespace_unary_op whitespace_before_paren_if
    whitespace_inside_paren whitespace_after_comma whitespace_after_semicolon whitespace_open_brace
    whitespace_close_brace whitespace_before_semicolon empty_statement rvalue_ref blank_before_section
    opening_curly_brace else_line else_braces else_if_else_line do_while_line single_if_else if_else_indentation
    closing_brace_line opening_brace_line redundant_empty_statement check_eq alternative_tokens two_space_indent
    whitespace_end_line max_line_length_80 max_line_length_120 one_command_per_line dir_in_header include_twice
    include_cpp include_order c_headers c_types unary_and if_line format_string_var using_directives
    variable_length_array unnamed_namespace string_constants snprintf_args c_string_print non_const_ref
    deprecated_casting dangerous_addresses unnamed_params include_what_you_use make_pair_template
    default_lambda_captures redundant_virtual_decl redundant_override_decl namespace_indent unapproved_headers
    unapproved_functions
""".split()
CPPCHECK = """
    cppcheckRule uninitMemberVar unusedFunction redundantAssignment unreadVariable variableScope harosDeprecatedSTL
    harosRegisterKeyword harosThrowSpecification harosCaseWithoutBreak harosBooleanCase harosEnumWithoutBase
    harosInlineAssembly harosDoublePointer harosTriplePointer harosSixParams harosConstUniquePtr harosDefaultArguments
    harosBooleanVector harosUnion harosIntegerTypes harosAssignIncrement harosAssignAssignment harosFloatEquality
    harosOverrideUnaryAnd harosOverrideBinaryAnd harosOverrideBinaryOr harosOverrideComma harosUsingErrno
    harosRvalueStdArray
""".split()
COMMON = """
    max_comment_ratio_30 max_comment_ratio_40 min_comment_ratio_20 max_cyclomatic_complexity_10
    max_cyclomatic_complexity_15 max_eloc_50 max_eloc_70 max_function_calls_7 max_function_calls_10
    max_function_parameters_6 max_function_length_40 max_file_length_400 max_control_nesting_4 max_control_nesting_5
    max_static_path_80 max_static_path_200 max_static_path_250 max_coupling_objects_5 max_immediate_children_10
    max_weighted_methods_50 max_weighted_methods_100 max_deepest_inheritance_5 max_methods_available_20 mi_below_20
    mi_below_65 halstead_volume_above_8000 halstead_bugs_above_2 no_global_names
""".split()
PYLINT = "refactor convention warning error fatal".split()

IDS = [
    *(f"haros_plugin_cpplint:{name}" for name in CPPLINT),
    *(f"haros_plugin_cppcheck:{name}" for name in CPPCHECK),
    *(f"haros_plugin_pylint:{name}" for name in PYLINT),
    *COMMON,
]


def by_alias() -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    tables = {tool: rules_of(tool) for tool in TOOLS} | {"haros-ci": check_rules()}
    for tool, rules in tables.items():
        for entry in rules.values():
            for alias in entry.aliases:
                found.setdefault(alias, []).append(f"{tool}:{entry.id}")
    return found


def test_the_counts_are_those_of_haros() -> None:
    assert (len(set(CPPLINT)), len(set(CPPCHECK)), len(set(PYLINT)), len(set(COMMON))) == (92, 30, 5, 28)


@every("identifier", IDS)
def test_every_id_is_served_or_explained(identifier: str) -> None:
    served = identifier in by_alias()
    assert served != (identifier in UNSERVED)
    assert served or UNSERVED[identifier].endswith(".")


@pytest.mark.parametrize(
    ("alias", "rules"),
    [
        ("haros_plugin_cpplint:no_copyright", ["cpplint:legal/copyright"]),
        ("haros_plugin_cpplint:whitespace_open_brace", ["cpplint:whitespace/braces"]),
        ("haros_plugin_cppcheck:uninitMemberVar", ["cppcheck:uninitMemberVar"]),
        ("haros_plugin_cppcheck:harosSixParams", ["metrics:max-function-parameters-6"]),
        ("max_cyclomatic_complexity_10", ["metrics:max-cyclomatic-complexity-10"]),
        ("haros_plugin_lizard:max_cyclomatic_complexity_10", ["metrics:max-cyclomatic-complexity-10"]),
        ("max_eloc_70", ["metrics:max-eloc-70"]),
        ("haros_plugin_ccd:halstead_volume_above_8000", ["metrics:halstead-volume-above-8000"]),
        ("no_global_names", ["haros-ci:global-name"]),
        ("haros_plugin_mi_calculator:mi_below_20", ["metrics:mi-below-20"]),
    ],
)
def test_aliases(alias: str, rules: list[str]) -> None:
    assert by_alias()[alias] == rules


def test_pylint_letters() -> None:
    aliases = by_alias()
    assert "pylint:undefined-variable" in aliases["haros_plugin_pylint:error"]
    assert "pylint:missing-module-docstring" in aliases["haros_plugin_pylint:convention"]
    assert sum(len(aliases[f"haros_plugin_pylint:{name}"]) for name in PYLINT) >= 380


def test_the_catch_all_leaves_out_what_has_an_id() -> None:
    caught = by_alias()["haros_plugin_cppcheck:cppcheckRule"]
    assert "cppcheck:nullPointer" in caught
    assert "cppcheck:uninitMemberVar" not in caught


@pytest.mark.parametrize(
    ("tag", "some", "none"),
    [
        ("formatting", "cpplint:whitespace/braces", "cpplint:runtime/memset"),
        ("whitespace", "cpplint:whitespace/tab", "cpplint:legal/copyright"),
        ("copyright", "cpplint:legal/copyright", "cpplint:build/include"),
        ("google-cpp", "cpplint:build/namespaces", "pylint:bare-except"),
        ("ros", "metrics:max-cyclomatic-complexity-15", "metrics:max-cyclomatic-complexity-10"),
        ("ros-cpp", "cpplint:build/header_guard", "cpplint:runtime/explicit"),
        ("hicpp", "cppcheck:unreadVariable", "cppcheck:variableScope"),
        ("misra-cpp", "cppcheck:uninitMemberVar", "cppcheck:nullPointer"),
        ("jsf-av-cpp", "cppcheck:variableScope", "cppcheck:unreadVariable"),
        ("nasa-satc", "metrics:max-eloc-50", "metrics:max-eloc-70"),
        ("his", "metrics:min-comment-ratio-20", "metrics:max-comment-ratio-30"),
        ("kth", "metrics:max-eloc-70", "metrics:max-eloc-50"),
        ("verifysoft", "metrics:max-file-length-400", "metrics:mi-below-20"),
        ("microsoft", "metrics:mi-below-20", "metrics:mi-below-65"),
        ("unak", "metrics:max-comment-ratio-40", "metrics:max-comment-ratio-30"),
        ("metrics", "metrics:mi-below-65", "cppcheck:nullPointer"),
        ("code-standards", "pylint:unused-import", "metrics:mi-below-20"),
    ],
)
def test_tags_of_haros_stand(tag: str, some: str, none: str) -> None:
    tagged = {f"{tool}:{r.id}" for tool in TOOLS for r in rules_of(tool).values() if tag in r.tags}
    assert some in tagged and none not in tagged
