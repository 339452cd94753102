# SPDX-License-Identifier: Apache-2.0
"""``python -m haros_ci``."""

from haros_ci.cli import main

if __name__ == "__main__":
    raise SystemExit(main())
