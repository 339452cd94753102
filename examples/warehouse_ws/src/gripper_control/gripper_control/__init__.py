# SPDX-License-Identifier: Apache-2.0
"""The gripper of the parcel warehouse."""
