# SPDX-License-Identifier: Apache-2.0
"""The messages of catkin_lint as rules: package.xml and CMakeLists.txt of catkin packages."""

from __future__ import annotations

from haros_ci.linters.catalogue.group import Group, Rule, help_text, profiles, tags_of, words
from haros_ci.results.rule import Level

MESSAGES = "https://fkie.github.io/catkin_lint/messages/"
SUPPRESS = "`#catkin_lint: ignore_once id` before the line"

LEVELS = {"e": Level.ERROR, "w": Level.WARNING, "n": Level.NOTE}

#: The second letter is a level: e error, which stops a build or a program, w warning, n note. What catkin_lint says of a
#: finding counts where it is less.
GROUPS: tuple[Group, ...] = (
    Group(
        "The package builds here because another one happens to provide it; on the build farm or a clean machine it"
        " will not. Declare the dependency in package.xml and in CMakeLists.txt.",
        ("dependencies",),
        (
            ("catkin_as_system_depend", "Sw", "catkin package under DEPENDS of catkin_package()."),
            ("launch_depend", "Sw", "Package used by a launch file that package.xml does not declare."),
            ("misconfigured_catkin_package", "Rw", "Exported dependency that is not a configured catkin package."),
            ("missing_catkin_depend", "Sw", "Exported dependency missing in CATKIN_DEPENDS."),
            ("missing_depend", "Se", "Used package that package.xml does not declare."),
            ("missing_find", "Re", "Used package without find_package()."),
            ("missing_required", "Sw", "Dependency found without REQUIRED."),
            ("plugin_depend", "Sw", "Plug-in without a dependency on its host package."),
            ("system_as_catkin_depend", "Re", "System package under CATKIN_DEPENDS of catkin_package()."),
            ("unconfigured_build_depend", "Sw", "Build dependency that CMakeLists.txt does not use."),
            ("unconfigured_msg_depend", "Rw", "Message dependency missing in generate_messages()."),
            ("unconfigured_system_depend", "Sw", "Exported system package that is not found."),
            ("unused_depend", "Sw", "Unused dependency."),
            ("wrong_depend", "Rw", "Dependency with the wrong tag."),
            ("missing_cmake_modules", "Sw", "CMake module used before cmake_modules is found."),
        ),
    ),
    Group(
        "What is not installed is there in the development space and missing on the robot.",
        ("installation",),
        (
            ("external_file", "Se", "File outside the package that is built or installed."),
            ("missing_directory", "Sw", "Directory that does not exist."),
            ("missing_file", "Se", "File that does not exist."),
            ("missing_plugin", "Re", "Exported plug-in description that does not exist."),
            ("plugin_export_prefix", "Re", "Exported plug-in description without ${prefix}."),
            ("script_not_executable", "Se", "Installed script without the execute bit."),
            ("missing_shebang", "Rw", "Installed script without a shebang."),
            ("uninstalled_depend", "Sw", "Installed target that depends on a target that is not installed."),
            ("uninstalled_export_lib", "Sw", "Exported library that is not installed."),
            ("uninstalled_include_path", "Sw", "Exported include path that is not installed."),
            ("uninstalled_plugin", "Rw", "Exported plug-in description that is not installed."),
            ("uninstalled_script", "Sw", "Executable script that is not installed."),
            ("uninstalled_target", "Sw", "Target that is not installed."),
            ("wrong_bin_install_destination", "Sw", "Program installed where rosrun does not find it."),
            ("wrong_install_destination", "Sw", "File installed outside the install prefix."),
            ("missing_python_setup", "Se", "setup.py without catkin_python_setup()."),
        ),
    ),
    Group(
        "CMake runs from top to bottom and forgives much; the build then fails elsewhere, or for others.",
        ("cmake",),
        (
            ("ambiguous_condition", "Sw", "Ambiguous condition that may be read as a variable."),
            ("ambiguous_include_path", "Sw", "Several include paths for the same headers."),
            ("build_include_path", "Rw", "Exported path of the build space."),
            ("catkin_order_violation", "Re", "catkin command before find_package(catkin)."),
            ("cmake_build_type", "Sw", "Build type fixed in CMakeLists.txt."),
            ("critical_var_append", "Sw", "Changed variable of CMake."),
            ("critical_var_overwrite", "Sw", "Overwritten variable of CMake."),
            ("deprecated_cmake_module", "Sw", "Deprecated CMake module."),
            ("deprecated_cmd", "Sw", "Deprecated CMake command."),
            ("duplicate_cmd", "Sw", "Repeated command that works only once."),
            ("duplicate_find", "Sw", "Package found twice."),
            ("duplicate_subdir", "Re", "Subdirectory added twice."),
            ("exported_pkg_config", "Sw", "pkg-config module exported as a package."),
            ("export_lib_not_lib", "Re", "Exported library that is not a library."),
            ("export_lib_renamed", "Rw", "Exported library with a changed file name."),
            ("external_include_path", "Sw", "Exported include path outside the package."),
            ("external_link_directory", "Sw", "Link directory outside the package."),
            ("external_subdir", "Rw", "Subdirectory outside the package."),
            ("find_by_include", "Sw", "Package included instead of found with find_package()."),
            ("immutable_var", "Sw", "Changed variable of catkin."),
            ("invalid_meta_command", "Sw", "Metapackage with build commands."),
            ("invalid_meta_depend", "Rw", "Metapackage with dependencies other than run dependencies."),
            ("invalid_target_output", "Rw", "Invalid character in an output file name."),
            ("link_directory", "Sw", "link_directories() instead of a full library name."),
            ("missing_cmd", "Sw", "Missing required command."),
            ("missing_export_lib", "Sw", "Package with headers that exports no library."),
            ("missing_generate_msg", "Re", "Declared messages that are never generated."),
            ("missing_include_path", "Re", "Exported include path that does not exist."),
            ("missing_subdir", "Re", "Subdirectory that does not exist."),
            ("order_violation", "Se", "Commands in the wrong order."),
            ("project_name", "Rw", "Project name that differs from the package name."),
            ("shadowed_find", "Sw", "Second find_package() that overwrites the components of the first."),
            ("subproject", "Sw", "Subdirectory with its own project()."),
            ("undefined_target", "Re", "Undefined target."),
            ("unguarded_test_cmd", "Sw", "Test commands without a check of CATKIN_ENABLE_TESTING."),
            ("unguarded_test_depend", "Rw", "Test dependency found without a check of CATKIN_ENABLE_TESTING."),
            ("unused_catkin_include_dirs", "Sw", "Include paths of catkin packages that are not used."),
            ("unused_generate_msg", "Sw", "generate_messages() without messages."),
            ("unused_include_path", "Sw", "Unused exported include path."),
            ("wrong_catkin_metapackage", "Rw", "catkin_metapackage() in a package that is not a metapackage."),
            ("wrong_catkin_package", "Sw", "catkin_package() in a metapackage."),
        ),
    ),
)

#: Messages in no profile but ``all``: they need every package installed, are layout or taste, or say that catkin_lint
#: gave up.
QUIET: tuple[tuple[str, str], ...] = (
    ("e", "no_catkin_component os_error unknown_package"),
    ("w", "argument_error cmake_ancient cmake_old duplicate_include_path env_var external_directory"),
    ("w", "external_interface_path parse_error"),
    ("n", "cmd_case description_boilerplate description_meaningless endblock_args global_var_collision indentation"),
    ("n", "header_outside_package_include_path literal_project_name missing_components package_path_name"),
    ("n", "redundant_lib_prefix unquoted_string_op unsorted_list"),
)


def rules() -> dict[str, Rule]:
    """Every message by id, in the lower case of catkin_lint's options."""
    found = {name: _rule(name, letters, summary, group) for group in GROUPS for name, letters, summary in group.rows}
    for severity, names in QUIET:
        found.update((name, _rule(name, f"-{severity}", _generic(name), _OTHER)) for name in names.split())
    return found


def invented(name: str) -> Rule:
    """A rule for a message that the tables do not know, for example of a newer version."""
    return _rule(name, "-w", _generic(name), _OTHER)


_OTHER = Group("", (), (), precision="medium")


def _generic(name: str) -> str:
    return f"Finding of catkin_lint's check '{words(name.lower())}'."


def _rule(name: str, letters: str, summary: str, group: Group) -> Rule:
    return Rule(
        id=name,
        summary=summary,
        level=LEVELS[letters[1]],
        help=help_text(name, summary, group.advice, SUPPRESS),
        help_uri=MESSAGES,
        precision=group.precision,
        profiles=profiles(letters),
        tags=tags_of("code-standards", "catkin", "ros", *group.tags),
    )
