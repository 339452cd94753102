# SPDX-License-Identifier: Apache-2.0
"""What people declare of an architecture: hints, expectations, HAROS's words."""
