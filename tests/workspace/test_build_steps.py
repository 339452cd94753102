# SPDX-License-Identifier: Apache-2.0
"""What CMake says that no reader follows is named where a change brings it; what packages say every day is not."""

from __future__ import annotations

from pathlib import Path

import pytest

from haros_ci.model.workspace import Problem
from haros_ci.workspace.build_changes import brought_steps
from haros_ci.workspace.build_steps import steps_not_followed
from haros_ci.workspace.discover import discover

#: By each of these a compiler, an interpreter or CMake itself is given a file that nobody looks at.
FOLLOWED_BY_NOBODY = [
    "target_compile_options(a PRIVATE -Wp,-include,part.txt)",
    "target_compile_options(a PRIVATE -include part.txt)",
    "target_compile_options(a PRIVATE -includepart.txt)",
    "target_compile_options(a PRIVATE SHELL:-include\\ part.txt)",
    'target_compile_options(a PRIVATE "SHELL:-include part.txt")',
    "target_compile_options(a PRIVATE -specs=flags.txt)",
    "target_compile_options(a PRIVATE @flags.txt)",
    "target_link_options(a PRIVATE -Wl,--defsym=pick=nothing)",
    'target_link_options(a PRIVATE "LINKER:--defsym,pick=nothing")',
    "target_link_libraries(a -Wl,-z,now,--wrap=pick)",
    "target_link_libraries(a -Wl,--just-symbols=b)",
    "set_target_properties(a PROPERTIES LINK_FLAGS -Wl,--defsym,pick=nothing)",
    "target_link_options(a PRIVATE -Wl,-Tmap.ld)",
    "target_compile_options(a PRIVATE --config=flags.txt)",
    "target_compile_options(a PRIVATE -fplugin=part.so)",
    "target_compile_options(a PRIVATE -wrapper part.sh)",
    "target_compile_options(a PRIVATE -Bbin)",
    "target_compile_options(a PRIVATE -xassembler)",
    "target_compile_options(a PRIVATE -x c++)",
    "target_compile_options(a PRIVATE ${D}include part.txt)",
    "target_compile_options(a PRIVATE -${I} part.txt)",
    "target_compile_options(a PRIVATE $<1:-include> part.txt)",
    "target_compile_options(a PRIVATE $<$<CONFIG:Debug>:-includepart.txt>)",
    "target_compile_options(a PRIVATE /FIpart.txt)",
    'add_compile_options("-Xclang" -include)',
    "add_definitions(-include part.txt)",
    "target_compile_definitions(a PRIVATE PART=<a/part.txt>)",
    'target_compile_definitions(a PRIVATE "GO=return *pointer;")',
    'add_definitions("-DGO=int x(){return *pointer;}")',
    'set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -include ${CMAKE_CURRENT_LIST_DIR}/part.txt")',
    'string(APPEND CMAKE_CXX_FLAGS " -imacros part.txt")',
    "list(APPEND OPTIONS -include-pch part.txt)",
    'set(A "-incl" "ude")',
    "set(D -)",
    "string(ASCII 45 D)",
    'set(CMAKE_CXX_COMPILE_OBJECT "part.sh")',
    "set(CMAKE_PROJECT_INCLUDE part.txt)",
    "set(CMAKE_CXX_COMPILER_LAUNCHER part.sh)",
    "set(CMAKE_USER_MAKE_RULES_OVERRIDE part.txt)",
    "set(ENV{CXXFLAGS} x)",
    'set_target_properties(a PROPERTIES UNITY_BUILD ON UNITY_BUILD_CODE_BEFORE_INCLUDE "#include <part.txt>")',
    "set_property(TARGET a PROPERTY UNITY_BUILD_CODE_AFTER_INCLUDE x)",
    "set_source_files_properties(src/part.txt PROPERTIES LANGUAGE ASM)",
    "set_source_files_properties(src/part.txt PROPERTIES ${L} CXX)",
    "set_property(GLOBAL PROPERTY RULE_LAUNCH_COMPILE part.sh)",
    "set_target_properties(a PROPERTIES COMPILE_FLAGS -imultilib)",
    'cmake_parse_arguments(CMAKE "" "CXX_FLAGS" "" CXX_FLAGS "@${CMAKE_CURRENT_SOURCE_DIR}/cfg/flags.txt")',
    'separate_arguments(CMAKE_CXX_FLAGS UNIX_COMMAND "@cfg/flags.txt")',
    'cmake_path(SET CMAKE_CXX_FLAGS "@cfg/flags.txt")',
    "foreach(flag @cfg/flags.txt)\nendforeach()",
    "get_filename_component(CMAKE_PROJECT_INCLUDE cfg/flags.txt ABSOLUTE)",
    "find_file(CMAKE_PROJECT_INCLUDE flags.txt PATHS cfg)",
    "find_program(CMAKE_CXX_COMPILER_LAUNCHER wrap PATHS cfg)",
    "generate_export_header(a CUSTOM_CONTENT_FROM_VARIABLE MORE)",
    "configure_package_config_file(cfg/part_hpp include/a/part.hpp INSTALL_DESTINATION share)",
    "add_executable(a [[src/part.txt]])",
    "add_executable(a src/part\\.txt)",
    "add_executable(a $<1:src/part.txt>)",
    "target_sources(a PRIVATE $<JOIN:src/part,.txt>)",
    "target_precompile_headers(a PRIVATE <part.txt>)",
    "include(part.txt)",
    "include(parts/part)",
    "include(${WHERE})",
    "install(FILES src/part.txt DESTINATION lib/python3/site-packages RENAME part.py)",
    "install(FILES src/part.txt DESTINATION include RENAME part.hpp)",
    "install(FILES launch/part.txt DESTINATION share/a/launch RENAME part.launch.xml)",
    'install(CODE "execute_process(COMMAND part.sh)")',
    "install(SCRIPT part.txt)",
    "function(add_executable)\nendfunction()",
    "macro(install)\nendmacro()",
    "if(A)\nelse()\n  include(part.txt)\nendif()",
    "foreach(A B)\n  function(b)\n    include(part.txt)\n  endfunction()\nendforeach()",
]
#: These make another word of what analysed code says, or have it read in another way.
FOLLOWED_BY_NOBODY += [
    "target_compile_definitions(a PRIVATE kept=local)",
    "target_compile_definitions(a PRIVATE static=)",
    "target_compile_definitions(a PRIVATE filled=nullptr)",
    "target_compile_definitions(a PRIVATE kept=0)",
    "target_compile_definitions(a PRIVATE kept)",
    "target_compile_definitions(a PRIVATE KEPT=local)",
    "target_compile_definitions(a PRIVATE Kept=Local)",
    "target_compile_definitions(a PRIVATE ${K}=${L})",
    "target_compile_definitions(a PRIVATE $<1:kept=local>)",
    "target_compile_definitions(a PRIVATE KEPT=$<1:local>)",
    "target_compile_definitions(a PRIVATE A;kept=local)",
    "add_definitions(-Dkept=local)",
    "add_definitions(-DA -D kept=local)",
    'add_definitions("-DA=1 -Dkept=local")',
    "add_compile_definitions(kept=local)",
    "ament_export_definitions(kept=local)",
    "add_compile_options(-Dkept=local)",
    "add_compile_options(-D kept=local)",
    "add_compile_options($<$<CONFIG:Debug>:-Dkept=local>)",
    'set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -Wall -Dkept=local")',
    "set_source_files_properties(src/a.cpp PROPERTIES COMPILE_DEFINITIONS kept=local)",
    "set_property(TARGET a APPEND PROPERTY COMPILE_DEFINITIONS A kept=local)",
    "set_property(SOURCE a.cpp PROPERTY COMPILE_FLAGS -Dkept=local)",
    "set(MODE kept=local)",
    'set(MODE "A=1;static=")',
    "list(APPEND MODE kept=local)",
    "define_more(a kept=local)",
    "set(MODE KEPT=local)",
    "option(MODE kept=local ON)",
    "foreach(mode kept=local)\nendforeach()",
    "add_compile_options(-DKEPT$<1:=local>)",
    "add_compile_options(-DKEPT=$<1:local>)",
    "target_compile_definitions(a PRIVATE KEPT${SIGN}local)",
    "set_target_properties(a PROPERTIES COMPILE_OPTIONS $<1:-Dkept=local>)",
    "set_target_properties(a PROPERTIES INTERFACE_COMPILE_DEFINITIONS kept=local)",
    "generate_export_header(a NO_EXPORT_MACRO_NAME static)",
    "generate_export_header(a EXPORT_MACRO_NAME ${WORD})",
    "add_compile_options(-finput-charset=UTF-7)",
    "add_compile_options(-fno-operator-names)",
    "add_compile_options(-trigraphs)",
    "set(PKG_CONFIG_EXECUTABLE ${CMAKE_CURRENT_SOURCE_DIR}/cfg/query.sh)",
    "find_program(PKG_CONFIG_EXECUTABLE query.sh PATHS cfg)",
    "set(Python3_EXECUTABLE ${PROJECT_SOURCE_DIR}/scripts/run.py)",
]
#: Many packages do so: it is noted.
USUAL = [
    "target_compile_options(a PRIVATE -fshort-enums)",
    "add_compile_options(-m32)",
    "add_compile_options(-fpack-struct=1)",
    'set(CMAKE_CXX_FLAGS "-Wall -funsigned-char")',
    "execute_process(COMMAND git describe OUTPUT_VARIABLE V)",
    "add_custom_command(OUTPUT a.cpp COMMAND make_it)",
    "add_custom_target(docs COMMAND doxygen)",
    'cmake_language(EVAL CODE "include(part.txt)")',
    "file(STRINGS sources.txt SOURCES)",
    "file(WRITE a.cpp ${TEXT})",
    "file(COPY src/part.txt DESTINATION ${CMAKE_BINARY_DIR})",
    "FetchContent_Declare(a URL b)",
    "include(part.txt",
    "<part>",
]
EVERY_DAY = """
cmake_minimum_required(VERSION 3.8)
project(a LANGUAGES CXX)
if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options(-Wall -Wextra -Wpedantic -Wno-unused-parameter -Werror=return-type -O3 -g -march=native -fPIC -fsanitize=address,undefined)
endif()
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-std=c++17> "$<$<CONFIG:Debug>:-O0;-g3>")
target_compile_options(a PRIVATE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER:$<CXX_COMPILER_VERSION>,9>>:-Wno-deprecated-copy>)
target_link_options(a PRIVATE -Wl,--no-undefined -Wl,--as-needed "-Wl,-rpath,${HERE}" -Wl,-R/opt -Wl,--version-script=a.map "LINKER:-z,now" -Wl,--gc-sections)
target_compile_options(a PRIVATE -m64 -mfpu=neon -mavx2 -fsigned-char -fno-short-enums -fpack -mtune=native)
target_compile_options(a PRIVATE ${OPTIONS} "${OPTIONS}" /W4 /bigobj -ffile-prefix-map=${CMAKE_SOURCE_DIR}=.)
set(CMAKE_CXX_FLAGS "${CMAKE_CXX_FLAGS} -std=c++11 -Wall -pthread -D_GLIBCXX_USE_CXX11_ABI=0 -isystem ${A_DIR}/include")
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_MODULE_PATH ${CMAKE_MODULE_PATH} "${CMAKE_CURRENT_SOURCE_DIR}/cmake")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(VERSION 1.2.3)
set(VERSION_TEXT "${MAJOR}-${MINOR}")
string(APPEND VERSION_TEXT "-${EXTRA}")
set(NUMBERS -1 -2.5 1e-3)
set(HELP "a - b, see -h")
set(SOURCES src/a.cpp src/${PROJECT_NAME}_node.cpp ${CMAKE_CURRENT_BINARY_DIR}/b.cpp)
list(APPEND SOURCES src/c.cpp)
list(FILTER SOURCES EXCLUDE REGEX ".*\\\\.txt$")
string(REGEX REPLACE "\\\\.cpp$" "" NAME "${SOURCE}")
string(REPLACE "." "_" NAME ${NAME})
file(GLOB SOURCES src/*.cpp "${CMAKE_CURRENT_SOURCE_DIR}/include/*.h" *.hpp)
file(GLOB_RECURSE MESHES RELATIVE ${CMAKE_SOURCE_DIR} meshes/*.stl)
file(GLOB EVERY src/*)
aux_source_directory(src SOURCES)
set(LINTER_OPTIONS --filter=-build/c++11,-runtime/references -warnings-as-errors=* -j${N})
target_compile_options(${PROJECT_NAME}_node PUBLIC -Wall)
include(${QT_USE_FILE})
set_source_files_properties(src/a.c PROPERTIES LANGUAGE CXX)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/a)
add_definitions(-DA -DB=1 "-DC=\\"${CMAKE_SOURCE_DIR}/test\\"" -DLIB-1.0)
target_compile_definitions(a PRIVATE A B=1 "C=\\"lib/a\\"" D=${D} "E=$<BOOL:${E}>")
add_library(a SHARED ${SOURCES} src/a.cpp src/b.cxx include/a/a.hpp $<TARGET_OBJECTS:b>)
add_executable(b src/main.cpp)
target_sources(a PUBLIC "src/d.cpp")
target_precompile_headers(a PRIVATE <vector> "include/a/a.hpp" <rclcpp/rclcpp.hpp>)
target_include_directories(a PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>" $<INSTALL_INTERFACE:include>)
target_link_libraries(a ${catkin_LIBRARIES} -lm -L/usr/lib -Wl,--no-as-needed -pthread Eigen3::Eigen)
set_target_properties(a PROPERTIES OUTPUT_NAME b PREFIX "" CXX_STANDARD 14 COMPILE_FLAGS "-Wno-all -fvisibility=hidden" LINK_FLAGS "-Wl,-z,defs")
set_property(TARGET a PROPERTY POSITION_INDEPENDENT_CODE ON)
set_property(CACHE CMAKE_BUILD_TYPE PROPERTY STRINGS Debug Release)
set_source_files_properties(src/a.cpp PROPERTIES COMPILE_FLAGS -Wno-all GENERATED TRUE)
include(cmake/part.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/part.cmake OPTIONAL)
include(GNUInstallDirs)
include_directories(include SYSTEM ${Eigen3_INCLUDE_DIRS})
add_subdirectory(src/part)
configure_file(a.hpp.in a.hpp @ONLY)
configure_file(cmake/a.in.txt ${CMAKE_BINARY_DIR}/a.txt)
rosidl_generate_interfaces(${PROJECT_NAME} "msg/A.msg" "srv/B.srv" DEPENDENCIES std_msgs)
generate_dynamic_reconfigure_options(cfg/A.cfg)
generate_parameter_library(a_parameters src/a.yaml)
ament_python_install_package(${PROJECT_NAME})
pybind11_add_module(_a src/a.cpp)
install(TARGETS a EXPORT a ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
install(PROGRAMS scripts/a.py DESTINATION lib/${PROJECT_NAME} RENAME a)
install(FILES config/a.yaml DESTINATION share/${PROJECT_NAME} RENAME b.yaml)
install(DIRECTORY include/ DESTINATION include PATTERN "*.hpp" REGEX "\\\\.svn" EXCLUDE)
function(add_parts NAME)
  cmake_parse_arguments(ARG "QUIET" "TARGET" "SOURCES" ${ARGN})
  add_library(${NAME} ${ARG_SOURCES})
endfunction()
add_parts(b SOURCES src/e.cpp)
add_test(NAME b COMMAND b --gtest_filter=-A.*)
ament_add_gtest(test_a test/test_a.cpp TIMEOUT 60 ENV A=b WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
add_launch_test(test/a.py ARGS "x:=1" --verbose)
message(STATUS "[[a]] -include $<1:b>")
# include(part.txt) [[
#[[ include(part.txt) ]]
get_filename_component(HERE "${CMAKE_CURRENT_LIST_FILE}" PATH)
option(CMAKE_EXPORT_COMPILE_COMMANDS "as a database" ON)
foreach(lib IN LISTS LIBRARIES)
  get_target_property(TYPE ${lib} TYPE)
endforeach()
cmake_parse_arguments(ARG "A" "B" "C" ${ARGN})
separate_arguments(WORDS UNIX_COMMAND "${WORDS}")
find_program(CCACHE ccache)
generate_export_header(a EXPORT_FILE_NAME include/a/export.hpp)
generate_export_header(a EXPORT_MACRO_NAME ${PROJECT_NAME}_EXPORT STATIC_DEFINE A_STATIC BASE_NAME a)
add_definitions(-DSTM32F407xx -Dfoo_EXPORTS -D_GNU_SOURCE -DEIGEN_USE_BLAS -DPy_DEBUG -DUSE=ON -DBUILD=true -DNAME=${NAME} /wd4800)
add_definitions(${DEFINITIONS} -DA= "-DB=\\"a b=c\\"" -DPATH_TO="${HERE}/a" -DVERSION=1.2.3-rc1)
target_compile_definitions(b PUBLIC $<$<CONFIG:Debug>:CHECKED=1> "$<BUILD_INTERFACE:WHERE=\\"${HERE}\\">")
set_target_properties(a PROPERTIES COMPILE_DEFINITIONS "A=1;B=\\"c\\"" DEFINE_SYMBOL A_BUILDING)
add_compile_options(-finput-charset=UTF-8 -finput-charset=utf8 -fno-exceptions -fexec-charset=UTF-8)
target_compile_definitions(b PUBLIC LIB_${NAME} ${PROJECT_NAME}_EXPORTS A_${B}_C)
add_compile_options(-DCHECKED=$<BOOL:${CHECKED}> $<$<CONFIG:Debug>:-DDEBUG=1>)
set_target_properties(a PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O0>")
ament_add_test(test_b ENV RMW_IMPLEMENTATION=rmw_a A=b)
set(ENVIRONMENT "PYTHONPATH=${HERE};A=B" ROS_DOMAIN_ID=3 name:=value a==b --arg=value)
set(PYTHON_EXECUTABLE /usr/bin/python3)
set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
message(STATUS kept=local)
add_launch_test(test/b.py ARGS "name:=a" rate=3)
configure_package_config_file(cfg/aConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/aConfig.cmake INSTALL_DESTINATION share)
"""


@pytest.mark.parametrize("text", FOLLOWED_BY_NOBODY)
def test_it_is_named(text: str) -> None:
    assert [step for step in steps_not_followed(text) if not step.is_usual]


@pytest.mark.parametrize("text", USUAL)
def test_it_is_noted(text: str) -> None:
    [step] = steps_not_followed(text)
    assert step.is_usual and step.line == 1


def test_what_packages_say_every_day_is_not_named() -> None:
    assert steps_not_followed(EVERY_DAY) == ()


def test_a_module_that_is_a_file_of_the_workspace_is_named() -> None:
    [step] = steps_not_followed("\n include(sources)\n", {"sources"}.__contains__)
    assert (step.line, step.words, step.is_usual) == (2, "include(… sources)", False)


def test_hostile_text_takes_linear_time() -> None:
    for text in ("add_compile_options(", "${", "-D" * 9, "a(b)\n", "if(A)\n", "set(A -x ", "$<", "[["):
        steps_not_followed(text * 20_000)


def brought(old: dict[str, str], new: dict[str, str], place: Path) -> tuple[list[Problem], list[Problem]]:
    for side, texts in (("old", old), ("new", new)):
        (place / side).mkdir()
        for path, text in texts.items():
            (place / side / path).parent.mkdir(parents=True, exist_ok=True)
            (place / side / path).write_text(text)
    found, notes = brought_steps(discover(place / "new", ["."]), discover(place / "old", ["."]))
    return list(found), list(notes)


def test_only_what_a_change_brings_is_reported(tmp_path: Path) -> None:
    odd, other = "include(part.txt)\n", "include(other.txt)\n"
    old = {"same/CMakeLists.txt": odd, "a/CMakeLists.txt": odd, "gone.cmake": other, "b/CMakeLists.txt": "project(b)\n"}
    new = {"same/CMakeLists.txt": odd, "a/CMakeLists.txt": f"project(a)\n{odd}", "moved.cmake": f"{other}\n"}
    new |= {"b/CMakeLists.txt": "project(b)\n\ninclude(new.txt)\nfile(READ a.txt A)\n"}
    found, notes = brought(old, new, tmp_path)
    assert [(problem.path, problem.line) for problem in found] == [("b/CMakeLists.txt", 3)]
    assert [(problem.path, problem.line) for problem in notes] == [("b/CMakeLists.txt", 4)]
    assert "include(… new.txt)" in found[0].message


def test_what_a_step_may_do_is_said(tmp_path: Path) -> None:
    text = "add_compile_options(-m32)\nexecute_process(COMMAND git describe OUTPUT_VARIABLE V)\n"
    _, notes = brought({}, {"CMakeLists.txt": text}, tmp_path)
    sizes, program = (problem.message for problem in notes)
    assert "-m32" in sizes and sizes.endswith(
        "changes the size or the sign of types, which linters do not take into account"
    )
    assert program.endswith("may compile, make or run what is not analysed")


def test_many_are_few(tmp_path: Path) -> None:
    text = "".join(f"include(part{n}.txt)\nfile(READ a{n} A)\n" for n in range(300))
    found, notes = brought({}, {"CMakeLists.txt": text}, tmp_path)
    assert len(found) == len(notes) == 21, "one of them counts the rest"
    assert all(any("more than the next 20" in problem.message for problem in every) for every in (found, notes))
