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
            ("catkin_as_system_depend", "Sw", "A catkin package stands under CATKIN_DEPENDS of catkin_package()."),
            ("launch_depend", "Sw", "Packages that a launch file uses are dependencies."),
            ("misconfigured_catkin_package", "Rw", "A catkin package that others need is configured."),
            ("missing_catkin_depend", "Rw", "A dependency that others need is exported with CATKIN_DEPENDS."),
            ("missing_depend", "Re", "A package that is used is a dependency."),
            ("missing_find", "Re", "A package that is used is found with find_package()."),
            ("missing_required", "Rw", "A dependency is found with REQUIRED."),
            ("plugin_depend", "Sw", "A package with a plug-in depends on the plug-in's host."),
            ("system_as_catkin_depend", "Re", "A system package stands under DEPENDS of catkin_package()."),
            ("unconfigured_build_depend", "Sw", "A build dependency is configured in CMakeLists.txt."),
            ("unconfigured_msg_depend", "Rw", "A dependency of messages is listed for generate_messages()."),
            ("unconfigured_system_depend", "Sw", "An exported system package is found."),
            ("unused_depend", "Sw", "A dependency is used."),
            ("wrong_depend", "Rw", "A dependency has the tag that its use asks for."),
            ("missing_cmake_modules", "Sw", "cmake_modules is found before the modules in it."),
        ),
    ),
    Group(
        "What is not installed is there in the development space and missing on the robot.",
        ("installation",),
        (
            ("external_file", "Re", "A file that is built or installed is in the package."),
            ("missing_directory", "Sw", "A directory that is named exists."),
            ("missing_file", "Re", "A file that is named exists."),
            ("missing_plugin", "Re", "A plug-in description that is exported exists."),
            ("plugin_export_prefix", "Re", "A plug-in description is exported below ${prefix}."),
            ("script_not_executable", "Re", "An installed script is executable."),
            ("missing_shebang", "Rw", "An installed script names its interpreter."),
            ("uninstalled_depend", "Rw", "What an installed target needs is installed."),
            ("uninstalled_export_lib", "Rw", "An exported library is installed."),
            ("uninstalled_include_path", "Rw", "An exported include path is installed."),
            ("uninstalled_plugin", "Rw", "An exported plug-in description is installed."),
            ("uninstalled_script", "Sw", "An executable script is installed."),
            ("uninstalled_target", "Sw", "A target is installed."),
            ("wrong_bin_install_destination", "Sw", "A program is installed where rosrun finds it."),
            ("wrong_install_destination", "Sw", "A file is installed below the install prefix."),
            ("missing_python_setup", "Re", "A package with setup.py calls catkin_python_setup()."),
        ),
    ),
    Group(
        "CMake runs from top to bottom and forgives much; the build then fails elsewhere, or for others.",
        ("cmake",),
        (
            ("ambiguous_condition", "Sw", "A condition cannot be taken for a variable."),
            ("ambiguous_include_path", "Sw", "Headers have one include path."),
            ("build_include_path", "Rw", "No path of the build space is exported."),
            ("catkin_order_violation", "Re", "catkin is found before its commands are used."),
            ("cmake_build_type", "Sw", "The build type is the user's choice."),
            ("critical_var_append", "Sw", "Variables that CMake itself uses are left alone."),
            ("critical_var_overwrite", "Sw", "Variables that CMake itself uses are not overwritten."),
            ("deprecated_cmake_module", "Sw", "No deprecated module is used."),
            ("deprecated_cmd", "Sw", "No deprecated command is used."),
            ("duplicate_cmd", "Sw", "A command that works once is called once."),
            ("duplicate_find", "Sw", "A package is found once."),
            ("duplicate_subdir", "Re", "A subdirectory is added once."),
            ("exported_pkg_config", "Sw", "A module of pkg-config is not exported as a package."),
            ("export_lib_not_lib", "Re", "What is exported as a library is one."),
            ("export_lib_renamed", "Rw", "An exported library keeps its name."),
            ("external_include_path", "Sw", "An exported include path is in the package."),
            ("external_link_directory", "Sw", "No directory of the system is added for linking."),
            ("external_subdir", "Rw", "A subdirectory is in the package."),
            ("find_by_include", "Sw", "A package is found with find_package()."),
            ("immutable_var", "Sw", "Variables of catkin are not changed."),
            ("invalid_meta_command", "Sw", "A metapackage builds nothing."),
            ("invalid_meta_depend", "Rw", "A metapackage has only run dependencies."),
            ("invalid_target_output", "Rw", "A file name holds only characters that files may have."),
            ("link_directory", "Sw", "Libraries are named in full instead of by a directory."),
            ("missing_cmd", "Rw", "A command that the package needs is called."),
            ("missing_export_lib", "Sw", "A package with headers exports its library."),
            ("missing_generate_msg", "Re", "Declared messages are generated."),
            ("missing_include_path", "Re", "An exported include path exists."),
            ("missing_subdir", "Re", "A subdirectory exists."),
            ("order_violation", "Re", "Commands stand in the order that catkin needs."),
            ("project_name", "Rw", "The project is named like the package."),
            ("shadowed_find", "Sw", "A second find_package() keeps the components of the first."),
            ("subproject", "Sw", "A subdirectory is not a project of its own."),
            ("undefined_target", "Re", "A target that is named is defined."),
            ("unguarded_test_cmd", "Sw", "Tests are built only where testing is enabled."),
            ("unguarded_test_depend", "Rw", "Test dependencies are found only where testing is enabled."),
            ("unused_catkin_include_dirs", "Sw", "The include paths of catkin packages are used."),
            ("unused_generate_msg", "Sw", "Messages are generated where some are declared."),
            ("unused_include_path", "Sw", "An exported include path is used."),
            ("wrong_catkin_metapackage", "Rw", "A package is not built as a metapackage."),
            ("wrong_catkin_package", "Sw", "A metapackage is built as one."),
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
    return f"The check '{words(name.lower())}' of catkin_lint finds nothing."


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
