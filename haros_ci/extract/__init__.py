# SPDX-License-Identifier: Apache-2.0
"""Front ends: each reads one file and knows nothing but its bytes."""
