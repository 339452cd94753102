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
            ("runtime/memset", "BG", "The size and the value of a memset call are not swapped."),
            ("runtime/invalid_increment", "BG", "A pointer's target is incremented with (*count)++, not *count++."),
            ("runtime/init", "BG", "A member is not initialized with itself."),
            ("runtime/casting", "RG", "No address is taken of the temporary that a cast makes."),
            (
                "runtime/member_string_references",
                "RG",
                "A class does not keep a const reference to a string that may be a temporary.",
            ),
            ("runtime/operator", "RG", "The unary operator & is not overloaded."),
            ("build/printf_format", "RG", "A format string contains no escape that C++ does not know."),
            ("readability/nul", "RG", "Source text contains no NUL byte."),
            ("readability/utf8", "RG", "Source text is valid UTF-8."),
        ),
    ),
    Group(
        "A header is text in every file that includes it, in other packages too: what it opens there nobody can close."
        " Write the names out, or move the directive into a function or a .cpp file.",
        ("headers", "namespace"),
        (("build/namespaces_headers", "RG", "A header holds no unnamed namespace."),),
    ),
    Group(
        "The compiler or another platform may reject or misread this; write the standard form.",
        ("portability",),
        (
            ("build/storage_class", "RG", "The storage class (static, extern) stands before the type."),
            ("build/forward_decl", "RG", "A forward declaration does not name an inner class through its outer one."),
            ("build/deprecated", "SG", "The operators >? and <? of old GCC versions are not used."),
            ("build/endif_comment", "SG", "What follows #endif or #else is a comment."),
            ("build/explicit_make_pair", "SG", "make_pair deduces its template arguments."),
            ("runtime/printf_format", "SG", "A format string uses %d and friends as the standard defines them."),
            ("runtime/arrays", "SG", "The size of an array is a compile-time constant."),
        ),
    ),
    Group(
        "Includes say what a file depends on; when they are incomplete a change in another package breaks the build.",
        ("include", "headers"),
        (
            ("build/include", "RG", "A header is included once, by its directory, and no .cc file is included."),
            (
                "build/include_what_you_use",
                "SG",
                "A file includes the standard header of each standard name that it uses.",
            ),
            ("build/include_subdir", "G", "An include names the directory of the header."),
            ("build/include_order", "G", "Includes stand in the order own header, C, C++, others."),
            ("build/include_alpha", "G", "Includes of one kind are sorted alphabetically."),
            ("build/header_guard", "G", "A header has an include guard named after its path."),
            ("build/c++11", "G", "No C++11 header is used that Google has not approved."),
            ("build/c++17", "G", "No C++17 header is used that Google has not approved."),
        ),
    ),
    Group(
        "C's functions and types check nothing. Use std::string, snprintf with sizeof, fixed-width integers and the"
        " C++ casts; in callbacks of a multi-threaded executor the reentrant functions.",
        ("c", "robustness"),
        (
            ("runtime/printf", "SG", "No sprintf, strcpy or strcat, and no format string from a variable."),
            ("runtime/threadsafe_fn", "SG", "The reentrant _r form of C library functions is used."),
            ("runtime/int", "SG", "Integers have fixed-width types rather than short and long."),
            ("readability/casting", "SG", "Casts are C++ casts rather than C casts."),
            (
                "runtime/string",
                "SG",
                "Global string constants are C strings, whose order of construction does not matter.",
            ),
        ),
    ),
    Group(
        "Implicit conversions, open namespaces and redundant specifiers surprise the reader.",
        ("readability",),
        (
            ("runtime/explicit", "SG", "A constructor that one argument can call is explicit."),
            ("build/namespaces", "SG", "Names of another namespace come one by one with using-declarations."),
            ("readability/inheritance", "SG", "A function is marked with one of virtual, override and final."),
            ("readability/multiline_comment", "SG", "A multi-line comment is closed and simple."),
            ("readability/multiline_string", "SG", "A string that spans lines is a raw string."),
            ("readability/nolint", "SG", "A NOLINT comment names categories that exist."),
            ("build/namespaces_literals", "G", "Literal operators come one by one with using-declarations."),
            ("readability/check", "G", "CHECK_EQ and friends stand for CHECK(a == b)."),
            ("readability/constructors", "G", "Deleted constructors are declared in the public section."),
            ("readability/alt_tokens", "G", "Operators are written as symbols rather than words."),
            (
                "readability/braces",
                "G",
                "Both branches of an if have braces or none has, and no semicolon follows a brace.",
            ),
            ("readability/fn_size", "G", "A function is short for what it holds."),
            ("readability/namespace", "G", "The closing brace of a namespace names it in a comment."),
            ("readability/todo", "G", "A TODO names who will do it."),
            ("runtime/references", "G", "Parameters that a function changes are pointers rather than references."),
            ("runtime/vlog", "G", "VLOG gets a number rather than a severity."),
        ),
    ),
    Group(
        "ROS asks for a copyright and licence statement at the top of every file.",
        ("license",),
        (("legal/copyright", "SG", "A file begins with a copyright statement."),),
    ),
    Group(
        "Layout: leave it to a formatter (clang-format, ament_uncrustify) rather than to reviewers.",
        ("formatting", "whitespace"),
        (
            ("whitespace/blank_line", "G", "Blocks do not begin or end with a blank line, sections begin after one."),
            ("whitespace/braces", "G", "An opening brace stands at the end of the line, with a blank before it."),
            ("whitespace/comma", "G", "A blank follows a comma."),
            ("whitespace/comments", "G", "Two blanks stand before and one after the slashes of a comment."),
            ("whitespace/empty_conditional_body", "G", "An empty body is written with braces."),
            ("whitespace/empty_if_body", "G", "An if has a body."),
            ("whitespace/empty_loop_body", "G", "An empty loop is written with braces or continue."),
            ("whitespace/end_of_line", "G", "Lines do not end with blanks."),
            ("whitespace/ending_newline", "G", "A file ends with a newline."),
            ("whitespace/forcolon", "G", "Blanks stand around the colon of a range-based for."),
            ("whitespace/indent", "G", "Code is indented by two, access specifiers by one."),
            ("whitespace/indent_namespace", "G", "The contents of a namespace are not indented."),
            ("whitespace/line_length", "G", "A line is no longer than the limit."),
            (
                "whitespace/newline",
                "G",
                "One statement stands on a line, else beside its brace, and lines end with LF.",
            ),
            ("whitespace/operators", "G", "Blanks stand around binary operators and not after unary ones."),
            ("whitespace/parens", "G", "No blanks stand inside parentheses, one before those of if and for."),
            ("whitespace/semicolon", "G", "No blank stands before a semicolon, one after it."),
            ("whitespace/tab", "G", "Indentation is made of blanks rather than tabs."),
            ("whitespace/todo", "G", "A TODO is followed by one blank."),
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
    return _rule(identifier, "G", f"The style guide's rule {identifier} is kept.", Group("", (), ()))


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
