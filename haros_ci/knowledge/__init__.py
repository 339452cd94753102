# SPDX-License-Identifier: Apache-2.0
"""What is known about packages of ROS that are not in the workspace: names, by sources that the data file lists."""
