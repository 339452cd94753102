# SPDX-License-Identifier: Apache-2.0
"""Call sites of ROS APIs, found as text, and what the model says of each."""
