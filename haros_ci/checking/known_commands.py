# SPDX-License-Identifier: Apache-2.0
"""Commands of CMake by who defines them: those of CMake itself and of the packages that every ROS has, and all others."""

from __future__ import annotations

from haros_ci.regex import regex

#: cmake-commands(7), as patterns of whole names.
_CMAKE = (
    r"add_(?:compile_definitions|compile_options|custom_command|custom_target|definitions|dependencies|executable|library|link_options"
    r"|subdirectory|test)|aux_source_directory|block|break|build_command|build_name|cmake_\w+|configure_file|continue|create_test_sourcelist"
    r"|define_property|else|elseif|enable_language|enable_testing|end\w+|exec_program|execute_process|export\w*|file|find_\w+|fltk_wrap_ui"
    r"|foreach|function|get_\w+|if|include|include_\w+|install\w*|link_directories|link_libraries|list|load_\w+|macro|make_directory"
    r"|mark_as_advanced|math|message|option|project|qt_wrap_\w+|remove|remove_definitions|return|separate_arguments|set|set_\w+"
    r"|site_name|source_group|string|subdirs|target_\w+|try_compile|try_run|unset|use_mangled_mesa|utility_source|variable_\w+|while"
    r"|write_file"
)
#: Modules that come with CMake, and Find modules of it that define commands.
_MODULES = (
    r"check_\w+|test_big_endian|configure_package_config_file|write_basic_package_version_file|externalproject_\w+|fetchcontent_\w+"
    r"|generate_export_header|add_compiler_export_flags|add_feature_info|feature_summary|gtest_\w+|pkg_\w+|print_enabled_features"
    r"|processorcount|select_library_configurations|swig_\w+|qt[456]?_\w+|cuda_\w+|doxygen_add_docs|protobuf_generate\w*|python3?_add_library"
    r"|bison_target|flex_target|add_flex_bison_dependency|gettext_\w+|fixup_bundle|cpack_\w+|ctest_\w+|write_compiler_detection_header"
)
#: Commands of packages that every installation of ROS has, or that the manifest declares in another way.
_ROS = (
    r"ament_\w+|catkin_\w+|add_(?:message|service|action)_files|add_rostest\w*|add_nosetests|add_launch_test|add_ros_\w+|generate_messages"
    r"|generate_dynamic_reconfigure_options|roslint_\w+|roslaunch_add_file_check|rosbuild_\w+|rosidl_generate_interfaces"
    r"|rosidl_target_interfaces|rosidl_get_typesupport_target|rclcpp_components_register_nodes?|pluginlib_\w+|class_loader_\w+"
    r"|xacro_\w+|pybind11_\w+|cs_\w+|generate_parameter_library|generate_parameter_module"
)
_KNOWN = regex(f"(?:{_CMAKE}|{_MODULES}|{_ROS})")


def is_well_known(command: str) -> bool:
    """Whether CMake itself, a module that comes with it, or a package that each ROS builds with defines the *command*, in small letters."""
    return _KNOWN.fullmatch(command) is not None
