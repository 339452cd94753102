# SPDX-License-Identifier: Apache-2.0
"""Worlds and models that come with Gazebo Classic and have no plug-ins that make something in ROS.

Source: https://github.com/gazebosim/gazebo-classic/tree/gazebo11/worlds, https://github.com/osrf/gazebo_models.
"""

from __future__ import annotations

WORLDS = frozenset(
    """empty.world empty_sky.world blank.world cafe.world mud.world rubble.world shapes.world willowgarage.world""".split()
)
MODELS = frozenset(
    """sun ground_plane asphalt_plane bookshelf bowl brick_box_3x1x3 cabinet cafe cafe_table cardboard_box cinder_block
    cinder_block_2 cinder_block_wide coke_can construction_barrel construction_cone cordless_drill cube_20k cylinder drc_practice_angled_barrier_45
    drc_practice_blue_cylinder drc_practice_orange_jersey_barrier drc_practice_yellow_parking_block dumpster fast_food fire_hydrant
    first_2015_trash_can gas_station gazebo grey_wall grey_tote hammer hoop_red house_1 house_2 house_3 jersey_barrier
    kitchen_dining ladder lamp_post mailbox marble_1_5cm_base monkey_wrench mud_box oak_tree office_building osrf_first_office parking_garage
    person_standing person_walking pine_tree playground police_station post_office postbox radio_tower robocup_3Dsim_field saloon school
    speed_limit_sign starting_pen stop_light stop_sign suv table table_marble telephone_pole thrift_shop truss_bridge
    unit_box utility_cart water_tower willowgarage wood_cube_10cm wood_cube_2_5cm wood_cube_5cm wood_cube_7_5cm""".split()
)
