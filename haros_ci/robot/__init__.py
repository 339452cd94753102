# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions: xacro and URDF files read as values, never run."""
