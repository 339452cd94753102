# SPDX-License-Identifier: Apache-2.0
"""What calls of ROS mean: API rows, names, quality of service, parameters, behaviour trees."""
