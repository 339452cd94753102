# SPDX-License-Identifier: Apache-2.0
"""Models of libraries that are no ROS API: what their functions do to values."""
