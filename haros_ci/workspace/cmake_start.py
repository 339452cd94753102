# SPDX-License-Identifier: Apache-2.0
"""The variables of CMake before the first line of a package is read."""

from __future__ import annotations

from haros_ci.model.package import Package
from haros_ci.workspace.cmake_words import BINARY_ROOT, absolute, unknown

#: What a build under Linux with catkin or ament has set before the first line is read.
_KNOWN = {
    "CMAKE_SYSTEM_NAME": "Linux",
    "CMAKE_HOST_SYSTEM_NAME": "Linux",
    "UNIX": "TRUE",
    "LINUX": "TRUE",
    "CMAKE_HOST_UNIX": "TRUE",
    "CMAKE_VERSION": "3.28.0",
    "CMAKE_MAJOR_VERSION": "3",
    "CMAKE_MINOR_VERSION": "28",
    "CMAKE_CXX_COMPILER_ID": "GNU",
    "CMAKE_C_COMPILER_ID": "GNU",
    "CMAKE_COMPILER_IS_GNUCXX": "TRUE",
    "CMAKE_COMPILER_IS_GNUCC": "TRUE",
    "CATKIN_ENABLE_TESTING": "TRUE",
    "BUILD_TESTING": "TRUE",
    "CATKIN_PACKAGE_BIN_DESTINATION": "lib/{name}",
    "CATKIN_PACKAGE_LIB_DESTINATION": "lib",
    "CATKIN_PACKAGE_PYTHON_DESTINATION": "lib/python3/dist-packages/{name}",
    "CATKIN_PACKAGE_INCLUDE_DESTINATION": "include/{name}",
    "CATKIN_PACKAGE_SHARE_DESTINATION": "share/{name}",
    "CATKIN_PACKAGE_ETC_DESTINATION": "etc/{name}",
    "CATKIN_GLOBAL_BIN_DESTINATION": "bin",
    "CATKIN_GLOBAL_LIB_DESTINATION": "lib",
    "CATKIN_GLOBAL_LIBEXEC_DESTINATION": "lib",
    "CATKIN_GLOBAL_PYTHON_DESTINATION": "lib/python3/dist-packages",
    "CATKIN_GLOBAL_INCLUDE_DESTINATION": "include",
    "CATKIN_GLOBAL_SHARE_DESTINATION": "share",
    "CATKIN_GLOBAL_ETC_DESTINATION": "etc",
    "CMAKE_INSTALL_BINDIR": "bin",
    "CMAKE_INSTALL_LIBDIR": "lib",
    "CMAKE_INSTALL_INCLUDEDIR": "include",
    "CMAKE_INSTALL_DATADIR": "share",
    "CMAKE_INSTALL_PREFIX": "install",
}
#: What only the machine or the person that builds knows.
_UNKNOWN = (
    "CMAKE_BUILD_TYPE",
    "CMAKE_CROSSCOMPILING",
    "CMAKE_CXX_COMPILER_VERSION",
    "CMAKE_C_COMPILER_VERSION",
    "CMAKE_HOST_SYSTEM_PROCESSOR",
    "CMAKE_SIZEOF_VOID_P",
    "CMAKE_SYSTEM_PROCESSOR",
    "CMAKE_SYSTEM_VERSION",
    "PYTHON_VERSION",
    "ROS_DISTRO",
    "ROS_VERSION",
)


def start_values(package: Package) -> dict[str, str]:
    """Those that are known, and those that are known to be unknown; each package is built by itself."""
    values = {key: value.format(name=package.name) for key, value in _KNOWN.items()}
    values |= {name: unknown(name) for name in _UNKNOWN}
    values["CATKIN_DEVEL_PREFIX"] = f"{BINARY_ROOT}/devel"
    for owner in ("CMAKE", "PROJECT", "CMAKE_CURRENT"):
        values[f"{owner}_SOURCE_DIR"] = absolute(package.path)
        values[f"{owner}_BINARY_DIR"] = BINARY_ROOT
    return values
