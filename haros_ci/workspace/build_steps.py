# SPDX-License-Identifier: Apache-2.0
"""What build files say that no reader here follows: by it code may be compiled, made or run that nothing analyses.

Commands of CMake and forms of their arguments that are known to be harmless are listed; all others are named, where a change brings them.
So what nobody has thought of is named, too. Sources: cmake-commands(7), cmake-generator-expressions(7), cmake-properties(7); gcc(1).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping

from haros_ci.records import dataclass
from haros_ci.regex import regex
from haros_ci.workspace.build_definitions import is_macro_name, renamings
from haros_ci.workspace.build_flags import OF_SIZES, changes_sizes, odd_flags
from haros_ci.workspace.cmake_parse import CMakeArgument, ParsedCommand, parse_cmake
from haros_ci.workspace.language import language_of, suffix_of

#: Characters of what is quoted.
_QUOTED = 100

#: Commands that say, find, ask, decide or link something: no argument of theirs makes code of a file.
_HARMLESS = frozenset(
    """
    message cmake_minimum_required cmake_policy project find_package find_library find_path find_file find_program pkg_check_modules pkg_search_module
    if else elseif endif foreach while break continue return option math mark_as_advanced unset include_guard enable_testing enable_language
    get_property get_target_property get_directory_property get_source_file_property get_cmake_property get_filename_component get_test_property
    cmake_parse_arguments cmake_path site_name separate_arguments include_regular_expression find_dependency source_group export
    ament_package ament_export_dependencies ament_export_targets ament_export_libraries ament_export_interfaces ament_export_include_directories
    ament_export_link_flags ament_target_dependencies ament_lint_auto_find_test_dependencies ament_auto_find_build_dependencies
    ament_auto_find_test_dependencies ament_index_register_resource ament_environment_hooks catkin_package catkin_metapackage catkin_python_setup catkin_workspace
    pluginlib_export_plugin_description_file rclcpp_components_register_node rclcpp_components_register_nodes rosidl_get_typesupport_target add_dependencies
    ament_cppcheck ament_cpplint ament_uncrustify ament_flake8 ament_pep257 ament_copyright ament_xmllint ament_lint_cmake ament_pycodestyle ament_clang_format
    ament_clang_tidy ament_mypy ament_black roslint_cpp roslint_python roslint_custom roslint_add_test roslaunch_add_file_check
    check_cxx_compiler_flag check_c_compiler_flag check_include_file check_include_files check_symbol_exists include_directories link_directories
    target_include_directories target_link_directories target_compile_features set_tests_properties add_test generate_export_header write_basic_package_version_file
    configure_package_config_file include_external_msproject aux_source_directory
    """.split()
)
#: Of these, those that give variables values: one of CMake's own, or a flag that names a file, may be among their arguments.
_SETTING = frozenset(
    "cmake_parse_arguments cmake_path separate_arguments get_filename_component foreach option site_name get_property get_target_property get_directory_property"
    " get_source_file_property get_cmake_property find_program find_file find_path find_library".split()
)
_OWN = regex(r"CMAKE(?:_\w*)?|ENV\{.*|PKG_CONFIG_(?:EXECUTABLE|ARGN)", re.DOTALL)
#: Commands whose arguments are definitions, which are looked at as such.
_DEFINING = frozenset(
    "add_definitions remove_definitions target_compile_definitions add_compile_definitions ament_export_definitions".split()
)
#: Options of generate_export_header() that are given the name of a macro ("GenerateExportHeader").
_NAMES_MACRO = regex(r"\w+_MACRO_NAME|STATIC_DEFINE|DEFINE_NO_DEPRECATED|INCLUDE_GUARD_NAME")
#: Properties that hold definitions, and programs that CMake's modules ask for flags and files.
_DEFINITIONS_OF = regex(r"(?:INTERFACE_)?COMPILE_DEFINITIONS(?:_\w+)?")
_PROGRAM = regex(r"PKG_CONFIG_(?:EXECUTABLE|ARGN)|\w+_EXECUTABLE")
_OF_SOURCES = regex(r"\$\{\w*(?:SOURCE_DIR|CURRENT_LIST_DIR)\}|\.\.?/")
#: Commands that name sources; what stands there in another form than a path may be any file.
_SOURCES = frozenset(
    "add_executable add_library target_sources set_source_files_properties target_precompile_headers".split()
)
#: Commands that run a program, or text that is put together, when a package is configured or built.
_RUNNING = frozenset(
    "execute_process exec_program add_custom_command add_custom_target cmake_language variable_watch try_run try_compile load_command load_cache fetchcontent_declare"
    " fetchcontent_populate externalproject_add externalproject_add_step file_download include_external ctest_run_script subdirs write_file".split()
)
#: Those of file() that put no text or file anywhere and read none.
_FILE = frozenset(
    "GLOB GLOB_RECURSE MAKE_DIRECTORY REMOVE REMOVE_RECURSE RELATIVE_PATH TO_CMAKE_PATH TO_NATIVE_PATH REAL_PATH SIZE TOUCH TOUCH_NOCREATE TIMESTAMP LOCK CHMOD".split()
)
#: Suffixes of other languages that CMake compiles, or Python imports.
_COMPILED = frozenset("m mm cppm ixx ccm cxxm pyx so pyc".split())
#: Properties that change neither what is compiled nor how, but for flags that are looked at as such.
_PROPERTIES = regex(
    r"VERSION|SOVERSION|OUTPUT_NAME\w*|(?:C|CXX|CUDA)_(?:STANDARD|STANDARD_REQUIRED|EXTENSIONS|VISIBILITY_PRESET|SCAN_FOR_MODULES)|VISIBILITY_INLINES_HIDDEN"
    r"|POSITION_INDEPENDENT_CODE|\w*_OUTPUT_(?:DIRECTORY|NAME)\w*|\w*LINK_(?:FLAGS|OPTIONS|LIBRARIES|DIRECTORIES|DEPENDS)\w*|LINKER_LANGUAGE|PREFIX|SUFFIX|FOLDER|EXPORT_NAME"
    r"|\w*LOCATION\w*|IMPORTED_\w+|INTERFACE_(?:INCLUDE_DIRECTORIES|SYSTEM_INCLUDE_DIRECTORIES|COMPILE_\w+)|(?:SYSTEM_)?INCLUDE_DIRECTORIES|PUBLIC_HEADER|PRIVATE_HEADER|COMPILE_(?:FLAGS|OPTIONS|DEFINITIONS)"
    r"|COMPILE_FEATURES|AUTO(?:MOC|UIC|RCC)\w*|SKIP_\w+|TIMEOUT|LABELS|ENVIRONMENT\w*|GENERATED|\w*RPATH\w*|WINDOWS_EXPORT_ALL_SYMBOLS|ENABLE_EXPORTS|HEADER_FILE_ONLY|STRINGS|USE_FOLDERS|DEBUG_POSTFIX"
    r"|\w+_POSTFIX|TYPE|VALUE|HELPSTRING|FRAMEWORK|(?:MACOSX|VS|WIN32|XCODE)_\w+|DEFINE_SYMBOL|CLEAN_DIRECT_OUTPUT|WILL_FAIL|WORKING_DIRECTORY|RUN_SERIAL|DEPENDS|REQUIRED_FILES|SKIP_RETURN_CODE|INTERPROCEDURAL_OPTIMIZATION\w*|EXCLUDE_FROM_ALL|EXCLUDE_FROM_DEFAULT_BUILD|NO_SONAME"
    r"|CUDA_(?:SEPARABLE_COMPILATION|ARCHITECTURES|RESOLVE_DEVICE_SYMBOLS)|OBJECT_DEPENDS|DEPENDENCY_SCANNING|TARGET_SUPPORTS_SHARED_LIBS|ALLOW_DUPLICATE_CUSTOM_TARGETS|ADDITIONAL_(?:MAKE_)?CLEAN_FILES"
)
#: Variables of CMake that change where things go, what is found and in which version of a language code is; flags are looked at as such.
_VARIABLES = regex(
    r"CMAKE_(?:(?:C|CXX|CUDA|OBJC|OBJCXX|ASM|Fortran)_(?:STANDARD|STANDARD_REQUIRED|EXTENSIONS|VISIBILITY_PRESET|FLAGS\w*|ARCHITECTURES|SCAN_FOR_MODULES)|VISIBILITY_INLINES_HIDDEN|BUILD_TYPE|MODULE_PATH|PREFIX_PATH|LIBRARY_PATH"
    r"|INCLUDE_PATH|FRAMEWORK_PATH|FIND_\w+|\w+_OUTPUT_DIRECTORY\w*|EXPORT_\w+|POSITION_INDEPENDENT_CODE|INSTALL_\w+|WINDOWS_EXPORT_ALL_SYMBOLS|AUTO(?:MOC|UIC|RCC)\w*|INCLUDE_CURRENT_DIR\w*"
    r"|\w*RPATH\w*|\w+_LINKER_FLAGS\w*|CONFIGURATION_TYPES|POLICY_\w+|MACOSX_RPATH|OSX_\w+|VERBOSE_MAKEFILE|COLOR_\w+|SUPPRESS_\w+|WARN_\w+|THREAD_PREFER_PTHREAD|DEBUG_POSTFIX|\w+_POSTFIX|REQUIRED_\w+"
    r"|INTERPROCEDURAL_OPTIMIZATION\w*|SKIP_\w+|LINK_\w+|USE_RELATIVE_PATHS|CROSSCOMPILING|LIBRARY_OUTPUT_PATH|PROJECT_(?:NAME|VERSION\w*)|CURRENT_\w+|(?:SOURCE|BINARY)_DIR|ENABLE_EXPORTS|STRIP|ALLOW_LOOSE_LOOP_CONSTRUCTS|NO_SYSTEM_FROM_IMPORTED|SWIG_\w+|SYSTEM_\w+|TRY_COMPILE_\w+|USE_PTHREADS_INIT|HAVE_\w+|THREAD_\w+|OBJDUMP|\w+_PLATFORM|ABSOLUTE_DESTINATION_FILES)"
)
_KEEPING = frozenset(("set", "list", "string"))
_SCOPES = frozenset(("PUBLIC", "PRIVATE", "INTERFACE", "BEFORE"))
#: What a package that was found offers (cmake-developer(7)).
_USE_FILE = regex(r"\$\{\w{1,100}_USE_FILE\}")
#: Generator expressions that stand for what a target makes, or for the path that they hold.
_OF_TARGETS = frozenset(
    "TARGET_OBJECTS TARGET_FILE TARGET_FILE_DIR TARGET_FILE_NAME BUILD_INTERFACE INSTALL_INTERFACE BUILD_LOCAL_INTERFACE TARGET_PROPERTY".split()
)
_GENEX = regex(r"\$<([A-Za-z_]*)")
#: An escape that means the character itself.
_NEEDLESS = regex(r"\\[./\-A-Z]")
#: Variables that may be flags by their names, and beginnings of flags that name a file, which any variable may hold.
_OF_COMPILERS = regex(r"FLAGS|DEFINITIONS|COMPILE", re.I)
_READS = regex(
    r"-(?:i|x|-?specs|B|wrapper|W[pa],|fplugin|fmodule|X(?:clang|preprocessor)|-include|-imacros|-language|-config)|@[\w./$]"
)
#: An option whose beginning is a variable's.
_PUT_TOGETHER = regex(r"(?:SHELL:)?\$\{[^{}]{1,100}\}[\w-]")


@dataclass(frozen=True, slots=True)
class BuildStep:
    """What is not followed at *line*: the *words* that say it, and its *effect*; *is_usual* where many packages do so: a program is run, or a file written or read; or where sizes of types change alone."""

    line: int
    words: str
    is_usual: bool = False
    effect: str = "may compile, make or run what is not analysed"


def steps_not_followed(text: str, is_file: Callable[[str], bool] = lambda _: False) -> tuple[BuildStep, ...]:
    """What the CMake *text* has that is not known to be harmless, in its order; *is_file* tells whether a name without directories is that of a file of the workspace.

    Takes linear time; names are not evaluated.
    """
    script = parse_cmake(text)
    found = [BuildStep(line, f"what cannot be read as CMake ({message})", True) for line, message in script.errors]
    pending = list(reversed(script.commands))
    while pending:
        command = pending.pop()
        is_usual = command.name in _RUNNING or command.name in ("file", "configure_file")
        found += (
            BuildStep(command.line, _quoted(command, odd), True, OF_SIZES)
            if changes_sizes(odd)
            else BuildStep(command.line, _quoted(command, odd), is_usual)
            for odd in _odd(command, is_file)
        )
        for opener, body in reversed(command.branches):
            pending += reversed(body)
            if opener is not command:
                found += (BuildStep(opener.line, _quoted(opener, odd)) for odd in _odd(opener, is_file))
    return tuple(sorted(dict.fromkeys(found), key=lambda step: step.line))


def _odd(command: ParsedCommand, is_file: Callable[[str], bool]) -> Iterator[str]:
    """The arguments of *command* that are not known to be harmless; all of them, for a command that is not."""
    name, arguments = command.name, command.arguments
    if name not in _DEFINING and name != "message":
        texts = [argument.text for argument in arguments if not argument.is_literal]
        yield from renamings(texts, are_kept=name in _KEEPING)
    if name in _HARMLESS:
        yield from _given(name, [argument.text for argument in arguments])
        return
    if name in _RUNNING:
        yield " ".join(argument.text for argument in arguments)
        return
    if name in _BY_NAME:
        yield from _BY_NAME[name](arguments, is_file)
    if name != "string":
        yield from (argument.text for argument in arguments if not _is_plain(argument, name))


def _given(name: str, words: list[str]) -> Iterator[str]:
    """What a harmless command gives to CMake's own variables, or writes into a file of code."""
    if name in _SETTING:
        yield from (
            word for word in words if _READS.match(word) or (_OWN.fullmatch(word) and not _is_usual_variable(word))
        )
    elif name == "generate_export_header":
        named = {after: word for word, after in zip(words, words[1:], strict=False) if _NAMES_MACRO.fullmatch(word)}
        yield from (f"{word} {after}" for after, word in named.items() if not is_macro_name(after))
        yield from (word for word in words if word == "CUSTOM_CONTENT_FROM_VARIABLE")
    elif name == "configure_package_config_file":
        yield from (word for word in words[1:2] if language_of(_name(word)) in ("cpp", "python"))


def _is_usual_variable(name: str) -> bool:
    return _VARIABLES.fullmatch(name) is not None and "FLAGS" not in name


def _is_plain(argument: CMakeArgument, name: str) -> bool:
    """Whether *argument* is written as paths and names are."""
    text = argument.text
    if argument.is_literal:
        return False
    if not argument.is_quoted and "\\" in text and _NEEDLESS.search(text):
        return False
    if "$<" in text and (name in _SOURCES or "_add_" in name):
        return {*_GENEX.findall(text)} <= _OF_TARGETS
    return True


def _options(arguments: Iterable[CMakeArgument], is_file: Callable[[str], bool]) -> Iterator[str]:
    for number, argument in enumerate(arguments):
        if number and _PUT_TOGETHER.match(argument.text):
            yield argument.text
        yield from odd_flags(argument.text)


def _flags(arguments: Iterable[CMakeArgument], _: Callable[[str], bool]) -> Iterator[str]:
    for argument in arguments:
        yield from odd_flags(argument.text)


def _definitions(arguments: Iterable[CMakeArgument], _: Callable[[str], bool]) -> Iterator[str]:
    for argument in arguments:
        if argument.text in _SCOPES:
            continue
        yield from odd_flags(argument.text, are_definitions=True)


def _target_definitions(arguments: tuple[CMakeArgument, ...], is_file: Callable[[str], bool]) -> Iterator[str]:
    yield from _definitions(arguments[1:], is_file)


def _set(arguments: tuple[CMakeArgument, ...], is_file: Callable[[str], bool]) -> Iterator[str]:
    name = arguments[0].text if arguments else ""
    is_odd = name.startswith(("CMAKE_", "ENV{")) and not _VARIABLES.fullmatch(name)
    is_odd |= _PROGRAM.fullmatch(name) is not None and any(_OF_SOURCES.search(value.text) for value in arguments[1:])
    if is_odd and len(arguments) > 1:
        yield " ".join(argument.text for argument in arguments)
    else:
        values = [argument for argument in arguments[1:] if "-" in argument.text or "@" in argument.text]
        if _OF_COMPILERS.search(name):
            yield from _flags(values, is_file)
        else:
            yield from (word for word in _flags(values, is_file) if word == "-" or _READS.match(word))


def _list(arguments: tuple[CMakeArgument, ...], is_file: Callable[[str], bool]) -> Iterator[str]:
    what = arguments[0].text.upper() if arguments else ""
    if what in ("APPEND", "PREPEND", "INSERT", "CONCAT", "JOIN"):
        yield from _set(arguments[1:], is_file)
    elif what in ("ASCII", "HEX"):
        yield what


def _properties(arguments: tuple[CMakeArgument, ...], is_file: Callable[[str], bool]) -> Iterator[str]:
    words = [argument.text for argument in arguments]
    if "PROPERTIES" in words:
        at = words.index("PROPERTIES") + 1
        pairs = list(zip(words[at::2], words[at + 1 :: 2], strict=False))
    elif "PROPERTY" in words:
        at = words.index("PROPERTY") + 1
        pairs = [(words[at], ";".join(words[at + 1 :]))] if at < len(words) else []
    else:
        pairs = []
    for name, value in pairs:
        if not _is_usual_property(name, value):
            yield f"{name} {value}"
        elif _DEFINITIONS_OF.fullmatch(name):
            yield from odd_flags(value, are_definitions=True)
        elif "$<" in value:
            yield from odd_flags(value)
    yield from _flags((argument for argument in arguments if argument.text.startswith(("-", "@"))), is_file)


def _is_usual_property(name: str, value: str) -> bool:
    """Whether it is known to be harmless; files with a property LANGUAGE are looked up by their names (``used_names``)."""
    is_language = name == "LANGUAGE" and value in ("C", "CXX", "CUDA")
    return name.startswith("-") or is_language or _PROPERTIES.fullmatch(name) is not None


def _include(arguments: tuple[CMakeArgument, ...], is_file: Callable[[str], bool]) -> Iterator[str]:
    word = arguments[0].text if arguments else ""
    is_module = re.fullmatch(r"\w+", word) is not None and not is_file(word)
    if word and not word.endswith((".cmake", "CMakeLists.txt")) and not is_module and not _USE_FILE.fullmatch(word):
        yield word


def _install(arguments: tuple[CMakeArgument, ...], _: Callable[[str], bool]) -> Iterator[str]:
    words = [argument.text for argument in arguments]
    if words[:1] in (["CODE"], ["SCRIPT"]):
        yield " ".join(words)
    elif "RENAME" in words:
        at = words.index("RENAME") + 1
        before = {language_of(_name(word)) for word in words[1 : at - 1] if "." in word}
        if (
            at < len(words)
            and (language_of(_name(words[at])) or suffix_of(words[at]) in _COMPILED)
            and before != {language_of(_name(words[at]))}
        ):
            yield f"RENAME {words[at]}"


def _name(word: str) -> str:
    return word.rpartition("/")[2]


def _configured(arguments: tuple[CMakeArgument, ...], _: Callable[[str], bool]) -> Iterator[str]:
    """A template that nobody finds by its name, of what may be CMake or code."""
    source, target = ([_name(argument.text) for argument in arguments] + ["", ""])[:2]
    if target.endswith(".pc") and ".pc" not in source:
        yield f"{source} {target}"
    elif "$" in source.removesuffix("}") and ("$" in target or language_of(target) in ("cmake", "cpp", "python")):
        yield f"{source} {target}"


def _file(arguments: tuple[CMakeArgument, ...], _: Callable[[str], bool]) -> Iterator[str]:
    words = [argument.text for argument in arguments]
    what = words[0].upper() if words else ""
    if what not in _FILE:
        yield " ".join(words)


def _headers(arguments: tuple[CMakeArgument, ...], _: Callable[[str], bool]) -> Iterator[str]:
    for argument in arguments:
        name = _name(argument.text.strip('<>"'))
        if "." in name and language_of(name) != "cpp":
            yield argument.text


def _defined(arguments: tuple[CMakeArgument, ...], _: Callable[[str], bool]) -> Iterator[str]:
    name = arguments[0].text.lower() if arguments else ""
    if name in _HARMLESS or name in _BY_NAME or name in _SOURCES or name in _RUNNING or not name.isidentifier():
        yield name


_BY_NAME: Mapping[str, Callable[[tuple[CMakeArgument, ...], Callable[[str], bool]], Iterator[str]]] = {
    "set": _set,
    "list": _list,
    "string": _list,
    "include": _include,
    "install": _install,
    "file": _file,
    "configure_file": _configured,
    "target_precompile_headers": _headers,
    "function": _defined,
    "macro": _defined,
    **dict.fromkeys(
        ("set_target_properties", "set_property", "set_source_files_properties", "set_directory_properties"),
        _properties,
    ),
    **dict.fromkeys(
        (
            "target_link_libraries",
            "target_link_options",
            "add_link_options",
            "link_libraries",
            "cuda_add_executable",
            "cuda_add_library",
        ),
        _flags,
    ),
    **dict.fromkeys(("target_compile_options", "add_compile_options"), _options),
    **dict.fromkeys(_DEFINING, _definitions),
    "target_compile_definitions": _target_definitions,
}


def _quoted(command: ParsedCommand, odd: str) -> str:
    plain = " ".join(odd.split())
    return f"{command.name}(… {plain if len(plain) <= _QUOTED else plain[:_QUOTED] + '…'})"
