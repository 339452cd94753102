# SPDX-License-Identifier: Apache-2.0
"""ROS 2 launch descriptions evaluated: which nodes start, with which names, remaps and parameters."""
