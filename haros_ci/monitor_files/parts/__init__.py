# SPDX-License-Identifier: Apache-2.0
"""What generated monitors consist of. These modules are not run here: their definitions are copied into the file that is written, as
far as it needs them. So they import the standard library and each other alone, are read by Python 3.8, and have no two definitions of
one name."""
