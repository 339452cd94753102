# SPDX-License-Identifier: Apache-2.0
"""Install the gripper's node."""

from setuptools import setup

setup(
    name="gripper_control",
    version="0.5.2",
    packages=["gripper_control"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/gripper_control"]),
        ("share/gripper_control", ["package.xml"]),
        ("share/gripper_control/config", ["config/gripper.yaml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="Warehouse team",
    maintainer_email="warehouse@example.org",
    description="Closes the gripper until a force is reached and reports what it holds.",
    license="Apache-2.0",
    entry_points={"console_scripts": ["gripper_node = gripper_control.gripper_node:main"]},
)
