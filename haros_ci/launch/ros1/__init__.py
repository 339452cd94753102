# SPDX-License-Identifier: Apache-2.0
"""Launch files of ROS 1, as roslaunch evaluates them."""
