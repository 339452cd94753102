# SPDX-License-Identifier: Apache-2.0
"""The categories of cpplint as rules: Google's style for C++, of which ROS takes a part."""

from __future__ import annotations

from haros_ci.linters.catalogue import haros
from haros_ci.linters.catalogue.group import Group, Rule, help_text, level_of, profiles, tags_of
from haros_ci.results.rule import Level

GUIDE = "https://google.github.io/styleguide/cppguide.html"
SUPPRESS = "`// NOLINT(CODE)` on the line or `// NOLINTNEXTLINE(CODE)` before it"

#: The ROS guides (ROS 1 C++ style guide, ROS 2 code style) leave braces, columns and blanks to the formatter, so that
#: whitespace and layout are only in ``google``.
GROUPS: tuple[Group, ...] = (
    Group(
        "The statement does not do what it seems to do; correct it.",
        ("correctness",),
        (
            ("runtime/memset", "BG", "Swapped size and value of memset."),
            ("runtime/invalid_increment", "BG", "*count++ instead of (*count)++."),
            ("runtime/init", "BG", "Member initialized with itself."),
            ("runtime/casting", "SG", "Address of a temporary from a cast."),
            (
                "runtime/member_string_references",
                "RG",
                "const string reference member that may refer to a temporary.",
            ),
            ("runtime/operator", "RG", "Overloaded unary operator &."),
            ("build/printf_format", "RG", "Unknown escape sequence in a format string."),
            ("readability/nul", "RG", "NUL byte in source text."),
            ("readability/utf8", "SG", "Invalid UTF-8 in source text."),
        ),
    ),
    Group(
        "A header is text in every file that includes it, in other packages too: what it opens there nobody can close."
        " Write the names out, or move the directive into a function or a .cpp file.",
        ("headers", "namespace"),
        (("build/namespaces_headers", "SG", "Unnamed namespace in a header."),),
    ),
    Group(
        "The compiler or another platform may reject or misread this; write the standard form.",
        ("portability",),
        (
            ("build/storage_class", "SG", "Storage class after the type."),
            ("build/forward_decl", "RG", "Forward declaration of a nested class."),
            ("build/deprecated", "SG", "Operators >? and <? of old GCC versions."),
            ("build/endif_comment", "SG", "Text after #endif or #else that is not a comment."),
            ("build/explicit_make_pair", "SG", "make_pair with explicit template arguments."),
            ("runtime/printf_format", "SG", "Non-standard conversion in a format string."),
            ("runtime/arrays", "SG", "Array of variable size."),
        ),
    ),
    Group(
        "Includes say what a file depends on; when they are incomplete a change in another package breaks the build.",
        ("include", "headers"),
        (
            ("build/include", "SG", "Header included twice, without its directory, or an included .cc file."),
            (
                "build/include_what_you_use",
                "SG",
                "Missing include of a standard header.",
            ),
            ("build/include_subdir", "G", "Include without a directory."),
            ("build/include_order", "G", "Wrong order of includes."),
            ("build/include_alpha", "G", "Includes not in alphabetical order."),
            ("build/header_guard", "G", "Missing or wrongly named include guard."),
            ("build/c++11", "G", "C++11 header that Google has not approved."),
            ("build/c++17", "G", "C++17 header that Google has not approved."),
        ),
    ),
    Group(
        "C's functions and types check nothing. Use std::string, snprintf with sizeof, fixed-width integers and the"
        " C++ casts; in callbacks of a multi-threaded executor the reentrant functions.",
        ("c", "robustness"),
        (
            ("runtime/printf", "SG", "sprintf, strcpy, strcat or a variable format string."),
            ("runtime/threadsafe_fn", "SG", "C library function that is not thread-safe."),
            ("runtime/int", "SG", "short or long instead of a fixed-width integer."),
            ("readability/casting", "SG", "C-style cast."),
            (
                "runtime/string",
                "SG",
                "Global string object.",
            ),
        ),
    ),
    Group(
        "Implicit conversions, open namespaces and redundant specifiers surprise the reader.",
        ("readability",),
        (
            ("runtime/explicit", "SG", "Constructor with one argument that is not explicit."),
            ("build/namespaces", "SG", "using-directive for a namespace."),
            ("readability/inheritance", "SG", "Several of virtual, override and final on one function."),
            ("readability/multiline_comment", "SG", "Unclosed or complex multi-line comment."),
            ("readability/multiline_string", "SG", "Multi-line string that is not a raw string."),
            ("readability/nolint", "SG", "Unknown category in a NOLINT comment."),
            ("build/namespaces_literals", "G", "using-directive for a namespace of literals."),
            ("readability/check", "G", "CHECK(a == b) instead of CHECK_EQ."),
            ("readability/constructors", "G", "Deleted constructor outside the public section."),
            ("readability/alt_tokens", "G", "Operator written as a word."),
            (
                "readability/braces",
                "G",
                "Braces on only one branch of an if, or a semicolon after a brace.",
            ),
            ("readability/fn_size", "G", "Long function."),
            ("readability/namespace", "G", "Closing brace of a namespace without a comment."),
            ("readability/todo", "G", "TODO without an owner."),
            ("runtime/references", "G", "Non-const reference parameter."),
            ("runtime/vlog", "G", "Severity passed to VLOG."),
        ),
    ),
    Group(
        "ROS asks for a copyright and licence statement at the top of every file.",
        ("license",),
        (("legal/copyright", "SG", "Missing copyright statement."),),
    ),
    Group(
        "Layout: leave it to a formatter (clang-format, ament_uncrustify) rather than to reviewers.",
        ("formatting", "whitespace"),
        (
            ("whitespace/blank_line", "G", "Blank line at the beginning or end of a block, or none before a section."),
            ("whitespace/braces", "G", "Misplaced opening brace."),
            ("whitespace/comma", "G", "Missing space after a comma."),
            ("whitespace/comments", "G", "Wrong spaces around the slashes of a comment."),
            ("whitespace/empty_conditional_body", "G", "Empty conditional body without braces."),
            ("whitespace/empty_if_body", "G", "Empty body of an if."),
            ("whitespace/empty_loop_body", "G", "Empty loop without braces or continue."),
            ("whitespace/end_of_line", "G", "Trailing spaces."),
            ("whitespace/ending_newline", "G", "Missing newline at the end of the file."),
            ("whitespace/forcolon", "G", "Missing spaces around the colon of a range-based for."),
            ("whitespace/indent", "G", "Wrong indentation."),
            ("whitespace/indent_namespace", "G", "Indented contents of a namespace."),
            ("whitespace/line_length", "G", "Line too long."),
            (
                "whitespace/newline",
                "G",
                "Several statements on one line, misplaced else, or wrong line ending.",
            ),
            ("whitespace/operators", "G", "Missing or extra spaces around operators."),
            ("whitespace/parens", "G", "Wrong spaces around parentheses."),
            ("whitespace/semicolon", "G", "Wrong spaces around a semicolon."),
            ("whitespace/tab", "G", "Indentation with tabs."),
            ("whitespace/todo", "G", "Wrong spaces after TODO."),
        ),
        level=Level.NOTE,
        precision="very-high",
    ),
)


def rules() -> dict[str, Rule]:
    """Every category by id."""
    return {
        identifier: _rule(identifier, letters, summary, group)
        for group in GROUPS
        for identifier, letters, summary in group.rows
    }


def invented(identifier: str) -> Rule:
    """A rule for a category that the table does not know."""
    return _rule(identifier, "G", f"Finding of cpplint's category {identifier}.", Group("", (), ()))


def _rule(identifier: str, letters: str, summary: str, group: Group) -> Rule:
    return Rule(
        id=identifier,
        summary=summary,
        level=group.level or level_of(letters, Level.WARNING),
        help=help_text(identifier, summary, group.advice, SUPPRESS),
        help_uri=GUIDE,
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "google-cpp", *group.tags, *haros.tags("cpplint", identifier)),
        aliases=haros.aliases("cpplint", identifier),
    )
