# SPDX-License-Identifier: Apache-2.0
"""The rule ids of HAROS and its plug-ins: what reports them now, under which tags, and which nothing reports."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

#: Plug-ins of HAROS and their rules: the id there, the rules (``tool:id``) that report it now, and those of its tags
#: that say more than the rule's own.
PLUGINS: tuple[tuple[str, tuple[tuple[str, str, str], ...]], ...] = (
    (
        "haros_plugin_cpplint",
        (
            ("line_endings", "cpplint:whitespace/newline", "formatting newline"),
            ("comments_must_end", "cpplint:readability/multiline_comment", "comments invalid-code"),
            ("no_copyright", "cpplint:legal/copyright", "comments license copyright ros"),
            ("header_guard", "cpplint:build/header_guard", "header header-guard preprocessor ros ros-cpp"),
            ("header_guard_format", "cpplint:build/header_guard", "ros ros-cpp"),
            ("header_guard_close", "cpplint:build/header_guard", "header-guard"),
            ("include_own_header", "cpplint:build/include", "header include preprocessor"),
            ("non_ascii", "cpplint:readability/utf8", "formatting character-encoding"),
            ("newline_terminator", "cpplint:whitespace/ending_newline", "formatting end-of-file ros ros-cpp"),
            (
                "complex_comment",
                "cpplint:readability/multiline_comment cpplint:readability/multiline_string",
                "strings",
            ),
            ("thread_safe_functions", "cpplint:runtime/threadsafe_fn", "multi-threading thread-safety"),
            ("logging_levels", "cpplint:runtime/vlog", "logging library"),
            ("invalid_increment", "cpplint:runtime/invalid_increment", "increment pointer invalid-code"),
            ("disallow_macro", "cpplint:readability/constructors", "macros class constructors"),
            ("disallow_in_private", "cpplint:readability/constructors", "private"),
            ("close_brace_alignment", "cpplint:whitespace/indent", "curly-braces indentation"),
            ("namespace_end_comment", "cpplint:readability/namespace", "formatting comments ros ros-cpp"),
            ("indent_access_mod", "cpplint:whitespace/indent", "access-modifiers"),
            ("string_format", "cpplint:runtime/printf_format", "strings string-formatting deprecation"),
            ("invalid_escape", "cpplint:build/printf_format", "strings escape-sequences invalid-code"),
            ("storage_before_type", "cpplint:build/storage_class", "invalid-code storage-class"),
            ("text_after_endif", "cpplint:build/endif_comment", "preprocessor invalid-code"),
            ("invalid_forward_declaration", "cpplint:build/forward_decl", "invalid-code forward-declaration"),
            ("deprecated_operators", "cpplint:build/deprecated", "invalid-code deprecation operators"),
            ("const_string_ref", "cpplint:runtime/member_string_references", "strings references constants"),
            ("explicit_constructors", "cpplint:runtime/explicit", "explicit constructors"),
            ("non_explicit_constructors", "cpplint:runtime/explicit", "explicit"),
            ("whitespace_after_paren", "cpplint:whitespace/parens", "formatting parenthesis"),
            ("whitespace_before_paren", "cpplint:whitespace/parens", "formatting"),
            ("whitespace_before_paren_if", "cpplint:whitespace/parens", "formatting"),
            ("whitespace_inside_paren", "cpplint:whitespace/parens", "formatting"),
            ("whitespace_before_comments", "cpplint:whitespace/comments", "formatting comments"),
            ("whitespace_before_comment_text", "cpplint:whitespace/comments", "formatting"),
            ("todo_format", "cpplint:readability/todo cpplint:whitespace/todo", "formatting todo-comment"),
            ("blank_code_line", "cpplint:whitespace/blank_line", "formatting code-blocks"),
            ("blank_before_section", "cpplint:whitespace/blank_line", "access-modifiers"),
            ("whitespace_before_brackets", "cpplint:whitespace/braces", "brackets"),
            ("whitespace_colon", "cpplint:whitespace/forcolon", "formatting colon for-loop"),
            ("whitespace_assign", "cpplint:whitespace/operators", "formatting assignment"),
            ("whitespace_binary_op", "cpplint:whitespace/operators", "binary-operator"),
            ("whitespace_unary_op", "cpplint:whitespace/operators", "unary-operator"),
            ("whitespace_after_comma", "cpplint:whitespace/comma", "formatting comma"),
            ("whitespace_after_semicolon", "cpplint:whitespace/semicolon", "formatting semicolon"),
            ("whitespace_before_semicolon", "cpplint:whitespace/semicolon", "formatting"),
            ("whitespace_open_brace", "cpplint:whitespace/braces", "formatting curly-braces"),
            ("whitespace_close_brace", "cpplint:whitespace/braces", "formatting"),
            ("opening_curly_brace", "cpplint:whitespace/braces", "formatting"),
            (
                "empty_statement",
                "cpplint:whitespace/semicolon cpplint:whitespace/empty_conditional_body"
                " cpplint:whitespace/empty_if_body cpplint:whitespace/empty_loop_body",
                "empty-statement",
            ),
            ("else_line", "cpplint:whitespace/newline", "if-else"),
            ("else_if_else_line", "cpplint:whitespace/newline", "if-else"),
            ("do_while_line", "cpplint:whitespace/newline", "do-while"),
            ("one_command_per_line", "cpplint:whitespace/newline", "formatting"),
            ("else_braces", "cpplint:readability/braces", "formatting if-else curly-braces"),
            ("single_if_else", "cpplint:readability/braces", "single-line-statements"),
            ("if_else_indentation", "cpplint:readability/braces", "ambiguous-indentation"),
            ("if_line", "cpplint:readability/braces", "formatting"),
            ("redundant_empty_statement", "cpplint:readability/braces", "empty-statement ambiguous-code"),
            ("check_eq", "cpplint:readability/check", "macros equality"),
            ("alternative_tokens", "cpplint:readability/alt_tokens", "tokens alternative-tokens operators"),
            ("two_space_indent", "cpplint:whitespace/indent cpplint:whitespace/tab", "formatting ros ros-cpp"),
            ("whitespace_end_line", "cpplint:whitespace/end_of_line", "formatting"),
            ("max_line_length_80", "cpplint:whitespace/line_length", "formatting line-length"),
            ("max_line_length_120", "cpplint:whitespace/line_length", "ros ros-cpp"),
            ("dir_in_header", "cpplint:build/include_subdir", "naming headers include"),
            ("include_twice", "cpplint:build/include", "headers"),
            ("include_cpp", "cpplint:build/include", "implementation-files"),
            (
                "include_order",
                "cpplint:build/include_order cpplint:build/include_alpha",
                "include preprocessor formatting",
            ),
            ("c_headers", "clang-tidy:modernize-deprecated-headers", "include headers deprecation hicpp"),
            ("c_types", "cpplint:runtime/int", "types deprecation"),
            ("unary_and", "cpplint:runtime/operator", "operators overload"),
            ("format_string_var", "cpplint:runtime/printf", "formatting strings potential-bugs"),
            ("snprintf_args", "cpplint:runtime/printf", "literals"),
            ("c_string_print", "cpplint:runtime/printf", "deprecation library"),
            (
                "using_directives",
                "cpplint:build/namespaces cpplint:build/namespaces_literals",
                "namespace using-directives using-declarations hicpp misra-cpp",
            ),
            ("variable_length_array", "cpplint:runtime/arrays", "arrays variables constants"),
            ("unnamed_namespace", "cpplint:build/namespaces_headers", "namespace unnamed-namespace headers"),
            ("string_constants", "cpplint:runtime/string", "strings constants"),
            ("non_const_ref", "cpplint:runtime/references", "parameters const pointers references"),
            ("deprecated_casting", "cpplint:readability/casting", "casting deprecation"),
            ("dangerous_addresses", "cpplint:runtime/casting", "potential-bugs addresses casting"),
            ("unnamed_params", "clang-tidy:readability-named-parameter", "parameters functions naming"),
            ("include_what_you_use", "cpplint:build/include_what_you_use", "include headers preprocessor"),
            ("make_pair_template", "cpplint:build/explicit_make_pair", "cpp11 compatibility templates pair"),
            ("redundant_virtual_decl", "cpplint:readability/inheritance", "functions virtual override final"),
            ("redundant_override_decl", "cpplint:readability/inheritance", "override"),
            ("namespace_indent", "cpplint:whitespace/indent_namespace", "formatting indentation namespace"),
            ("unapproved_headers", "cpplint:build/c++11 cpplint:build/c++17", "include headers cpp11"),
            ("max_eloc_50", "metrics:max-eloc-50", ""),
            ("max_eloc_70", "metrics:max-eloc-70", ""),
        ),
    ),
    (
        "haros_plugin_cppcheck",
        (
            (
                "uninitMemberVar",
                "cppcheck:uninitMemberVar",
                "classes constructors google-cpp jsf-av-cpp misra-cpp hicpp",
            ),
            ("unusedFunction", "cppcheck:unusedFunction", "unused-variables misra-cpp"),
            ("redundantAssignment", "cppcheck:redundantAssignment", "redundancy hicpp"),
            ("unreadVariable", "cppcheck:unreadVariable", "redundancy hicpp"),
            ("variableScope", "cppcheck:variableScope", "scope declarations jsf-av-cpp"),
            ("harosThrowSpecification", "clang-tidy:modernize-use-noexcept", "exceptions deprecation hicpp"),
            ("harosInlineAssembly", "clang-tidy:hicpp-no-assembler", "assembly asm hicpp"),
            ("harosSixParams", "metrics:max-function-parameters-6", "hicpp"),
            (
                "harosDefaultArguments",
                "clang-tidy:fuchsia-default-arguments-declarations",
                "default-arguments parameters hicpp",
            ),
            ("harosIntegerTypes", "cpplint:runtime/int", "integer-types portability hicpp misra-cpp jsf-av-cpp"),
            ("harosAssignIncrement", "cppcheck:unknownEvaluationOrder", "evaluation-order hicpp misra-cpp jsf-av-cpp"),
            ("harosOverrideUnaryAnd", "cpplint:runtime/operator", "hicpp misra-cpp jsf-av-cpp"),
        ),
    ),
    (
        "haros_plugin_lizard",
        (
            ("max_cyclomatic_complexity_10", "metrics:max-cyclomatic-complexity-10", ""),
            ("max_cyclomatic_complexity_15", "metrics:max-cyclomatic-complexity-15", ""),
            ("max_function_length_40", "metrics:max-function-length-40", ""),
            ("max_function_parameters_6", "metrics:max-function-parameters-6", ""),
            ("max_file_length_400", "metrics:max-file-length-400", ""),
        ),
    ),
    (
        "haros_plugin_radon",
        (
            ("min_comment_ratio_20", "metrics:min-comment-ratio-20", ""),
            ("max_comment_ratio_30", "metrics:max-comment-ratio-30", ""),
            ("max_comment_ratio_40", "metrics:max-comment-ratio-40", ""),
        ),
    ),
    (
        "haros_plugin_ccd",
        (
            ("halstead_volume_above_8000", "metrics:halstead-volume-above-8000", ""),
            ("halstead_bugs_above_2", "metrics:halstead-bugs-above-2", ""),
        ),
    ),
    (
        "haros_plugin_mi_calculator",
        (
            ("mi_below_20", "metrics:mi-below-20", ""),
            ("mi_below_65", "metrics:mi-below-65", ""),
        ),
    ),
)

#: Metric rules of HAROS's own that no plug-in of it reported: the same here with hyphens.
COMMON = (
    "max_function_calls_7 max_function_calls_10 max_control_nesting_4 max_control_nesting_5 max_static_path_80"
    " max_static_path_200 max_static_path_250 max_coupling_objects_5 max_immediate_children_10 max_weighted_methods_50"
    " max_weighted_methods_100 max_methods_available_20 max_deepest_inheritance_5".split()
)

_NO_CHECK = "Cppcheck itself has no such check; HAROS looked for it with a regular expression."
_NO_CPPLINT = "The cpplint of today no longer has this check."
_NO_BRACES = "The cpplint of today cannot ask for braces on lines of their own; a formatter can."

#: HAROS ids that are accepted wherever a rule can be named, and why nothing reports them.
UNSERVED: Mapping[str, str] = {
    "haros_plugin_cpplint:rvalue_ref": _NO_CPPLINT,
    "haros_plugin_cpplint:default_lambda_captures": _NO_CPPLINT,
    "haros_plugin_cpplint:unapproved_functions": _NO_CPPLINT,
    "haros_plugin_cpplint:closing_brace_line": _NO_BRACES,
    "haros_plugin_cpplint:opening_brace_line": _NO_BRACES,
    "haros_plugin_cppcheck:harosDeprecatedSTL": _NO_CHECK,
    "haros_plugin_cppcheck:harosRegisterKeyword": _NO_CHECK,
    "haros_plugin_cppcheck:harosCaseWithoutBreak": _NO_CHECK,
    "haros_plugin_cppcheck:harosBooleanCase": _NO_CHECK,
    "haros_plugin_cppcheck:harosEnumWithoutBase": _NO_CHECK,
    "haros_plugin_cppcheck:harosDoublePointer": _NO_CHECK,
    "haros_plugin_cppcheck:harosTriplePointer": _NO_CHECK,
    "haros_plugin_cppcheck:harosConstUniquePtr": _NO_CHECK,
    "haros_plugin_cppcheck:harosBooleanVector": _NO_CHECK,
    "haros_plugin_cppcheck:harosUnion": _NO_CHECK,
    "haros_plugin_cppcheck:harosAssignAssignment": _NO_CHECK,
    "haros_plugin_cppcheck:harosFloatEquality": _NO_CHECK,
    "haros_plugin_cppcheck:harosOverrideBinaryAnd": _NO_CHECK,
    "haros_plugin_cppcheck:harosOverrideBinaryOr": _NO_CHECK,
    "haros_plugin_cppcheck:harosOverrideComma": _NO_CHECK,
    "haros_plugin_cppcheck:harosUsingErrno": _NO_CHECK,
    "haros_plugin_cppcheck:harosRvalueStdArray": _NO_CHECK,
}

#: Plug-ins whose rules were HAROS's common ones, so that a project file names them without the plug-in.
_COMMON = frozenset({"haros_plugin_lizard", "haros_plugin_radon", "haros_plugin_ccd", "haros_plugin_mi_calculator"})


def aliases(tool: str, identifier: str) -> tuple[str, ...]:
    """The HAROS ids that mean the rule ``tool:identifier``."""
    return _index().get(f"{tool}:{identifier}", ((), ()))[0]


def tags(tool: str, identifier: str) -> tuple[str, ...]:
    """The HAROS tags of the rule ``tool:identifier``."""
    return _index().get(f"{tool}:{identifier}", ((), ()))[1]


@cache
def _index() -> Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]]:
    """Aliases and tags by rule."""
    index: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {}
    rows = ((plugin, *row) for plugin, rules in PLUGINS for row in rules)
    for plugin, name, targets, words in rows:
        bare = (name,) if plugin in _COMMON or name.startswith("max_eloc") else ()
        for target in targets.split():
            names, labels = index.get(target, ((), ()))
            index[target] = (names + bare + (f"{plugin}:{name}",), tuple(dict.fromkeys((*labels, *words.split()))))
    index |= {f"metrics:{name.replace('_', '-')}": ((name,), ()) for name in COMMON}
    return index
