# SPDX-License-Identifier: Apache-2.0
"""The arguments of launch files of released packages that many workspaces include.

All that any branch or release of the package declares or reads there, and in the files of the package that it includes itself in ROS 2:
ros-simulation/gazebo_ros_pkgs (up to d52f7c471d), gazebosim/ros_gz (739cb42a58), RobotWebTools/rosbridge_suite (c1bfc2ff45), mavlink/mavros
(f8f462dd74), IntelRealSense/realsense-ros (ee94dc926f), ros-drivers/velodyne (04a7ca722e), ros-navigation/navigation2 (f4108e5b1c) and
SteveMacenski/slam_toolbox (e38048fbf1).
"""

from __future__ import annotations

from haros_ci.records import dataclass
from haros_ci.regex import regex

_FILES = {
    "gazebo_ros/launch/empty_world.launch": """
        debug enable_ros_network extra_gazebo_args gui gui_required headless output paused physics pub_clock_frequency recording required
        respawn_gazebo server_required use_clock_frequency use_sim_time verbose world_name""",
    "gazebo_ros/launch/mud_world.launch": "",
    "gazebo_ros/launch/rubble_world.launch": "",
    "gazebo_ros/launch/shapes_world.launch": "",
    "gazebo_ros/launch/willowgarage_world.launch": "",
    "gazebo_ros/launch/range_world.launch": """
        debug extra_gazebo_args gui headless output paused physics use_sim_time verbose world""",
    "gazebo_ros/launch/elevator_world.launch": """
        debug extra_gazebo_args gui headless output paused physics recording use_sim_time verbose world_name""",
    "gazebo_ros/launch/gzserver.launch.py": """
        extra_gazebo_args factory force_system gdb help init initial_sim_time iters lockstep minimal_comms params_file pause physics play profile
        record record_encoding record_filter record_path record_period seed server_required valgrind verbose version world""",
    "gazebo_ros/launch/gzclient.launch.py": "extra_gazebo_args gdb gui_required help valgrind verbose version",
    "gazebo_ros/launch/gazebo.launch.py": """
        extra_gazebo_args factory force_system gdb gui gui_required help init initial_sim_time iters lockstep minimal_comms params_file pause physics
        play profile record record_encoding record_filter record_path record_period seed server server_required valgrind verbose version world""",
    "ros_gz_sim/launch/gz_sim.launch.py": "debugger gz_args gz_version ign_args ign_version on_exit_shutdown",
    "ros_gz_sim/launch/gz_server.launch.py": """
        container_name create_own_container use_composition world_sdf_file world_sdf_string""",
    "ros_gz_sim/launch/gz_spawn_model.launch.py": """
        P R Y allow_renaming entity_name file model_string name pitch roll string topic world x xml_string y yaw z""",
    "rosbridge_server/launch/rosbridge_websocket.launch": """
        address authenticate binary_encoder bson_only_mode certfile delay_between_messages fragment_timeout keyfile max_message_size output
        params_glob port retry_startup_delay services_glob ssl topics_glob unregister_timeout use_compression websocket_external_port
        websocket_null_origin websocket_ping_interval websocket_ping_timeout""",
    "rosbridge_server/launch/rosbridge_tcp.launch": """
        authenticate bson_only_mode certfile check_response_delay delay_between_messages fragment_timeout host incoming_buffer keyfile
        max_message_size max_service_requests params_glob port retry_startup_delay service_request_timeout services_glob socket_timeout ssl
        topics_glob unregister_timeout wait_for_busy_service_provider""",
    "rosbridge_server/launch/rosbridge_websocket_launch.xml": """
        address authenticate binary_encoder bson_only_mode call_services_in_new_thread certfile delay_between_messages fragment_timeout keyfile
        max_message_size params_glob port retry_startup_delay send_action_goals_in_new_thread services_glob ssl topics_glob unregister_timeout
        url_path use_compression""",
    "mavros/launch/node.launch": """
        blacklist_yaml config_yaml fcu_protocol fcu_url gcs_url log_output namespace pluginlists_yaml respawn_mavros tgt_component tgt_system""",
    "mavros/launch/px4.launch": """
        fcu_protocol fcu_url gcs_url log_output namespace respawn_mavros tgt_component tgt_system""",
    "mavros/launch/apm.launch": """
        fcu_protocol fcu_url gcs_url log_output namespace respawn_mavros tgt_component tgt_system""",
    "realsense2_camera/launch/rs_camera.launch": """
        accel_fps align_depth allow_no_texture_points calib_odom_file camera clip_distance color_fps color_height color_width confidence_fps
        confidence_height confidence_width depth_fps depth_height depth_width device_type enable_accel enable_color enable_confidence enable_depth
        enable_fisheye enable_gyro enable_imu enable_infra enable_infra1 enable_infra2 enable_pointcloud enable_sync enable_tm2 external_manager
        filters fisheye_fps fisheye_height fisheye_width gyro_fps infra1_fps infra1_height infra1_width infra2_fps infra2_height infra2_width
        infra_fps infra_height infra_rgb infra_width initial_reset json_file_path linear_accel_cov manager ordered_pc output pointcloud_texture_index
        pointcloud_texture_stream publish_odom_tf publish_tf reconnect_timeout respawn serial_no stereo_module/exposure/1 stereo_module/exposure/2
        stereo_module/gain/1 stereo_module/gain/2 tf_prefix tf_publish_rate topic_odom_in unite_imu_method usb_port_id wait_for_device_timeout""",
    "realsense2_camera/launch/rs_rgbd.launch": """
        accel_fps align_depth bond camera color_fps color_height color_width debayer_processing depth depth_fps depth_height depth_processing
        depth_registered depth_registered_filtered depth_registered_processing depth_registered_pub depth_width device_type disparity_processing
        disparity_registered_processing enable_accel enable_color enable_depth enable_fisheye enable_gyro enable_imu enable_infra1 enable_infra2
        enable_pointcloud enable_sync external_manager filters fisheye_fps fisheye_height fisheye_width gyro_fps hw_registered_processing infra1_fps
        infra1_height infra1_width infra2_fps infra2_height infra2_width infra_fps infra_height infra_width ir ir_processing json_file_path manager
        namespace projector publish_tf respawn rgb rgb_processing serial_no sw_registered_processing tf_prefix tf_publish_rate usb_port_id""",
    "realsense2_camera/launch/rs_aligned_depth.launch": """
        accel_fps align_depth camera color_fps color_height color_width depth_fps depth_height depth_width enable_accel enable_color enable_depth
        enable_fisheye enable_gyro enable_imu enable_infra1 enable_infra2 enable_pointcloud enable_sync filters fisheye_fps fisheye_height
        fisheye_width gyro_fps infra1_fps infra1_height infra1_width infra2_fps infra2_height infra2_width infra_fps infra_height infra_width
        json_file_path serial_no tf_prefix""",
    "realsense2_camera/launch/rs_t265.launch": """
        accel_fps camera device_type enable_accel enable_fisheye1 enable_fisheye2 enable_gyro enable_pose enable_sync fisheye_fps fisheye_height
        fisheye_width gyro_fps initial_reset json_file_path linear_accel_cov publish_odom_tf reconnect_timeout serial_no tf_prefix unite_imu_method
        usb_port_id""",
    "realsense2_camera/launch/includes/nodelet.launch.xml": """
        accel accel_fps accel_frame_id accel_optical_frame_id align_depth aligned_depth_to_color_frame_id aligned_depth_to_fisheye1_frame_id
        aligned_depth_to_fisheye2_frame_id aligned_depth_to_fisheye_frame_id aligned_depth_to_infra1_frame_id aligned_depth_to_infra2_frame_id
        allow_no_texture_points base_frame_id calib_odom_file clip_distance color_fps color_frame_id color_height color_optical_frame_id color_width
        confidence_fps confidence_height confidence_width depth depth_fps depth_frame_id depth_height depth_optical_frame_id depth_width device_type
        enable_accel enable_color enable_confidence enable_depth enable_fisheye enable_fisheye1 enable_fisheye2 enable_gyro enable_imu enable_infra
        enable_infra1 enable_infra2 enable_pointcloud enable_pose enable_sync enable_tm2 external_manager filters fisheye fisheye1_frame_id
        fisheye1_optical_frame_id fisheye2_frame_id fisheye2_optical_frame_id fisheye_fps fisheye_frame_id fisheye_height fisheye_optical_frame_id
        fisheye_width gyro gyro_fps gyro_frame_id gyro_optical_frame_id imu_optical_frame_id infra1 infra1_fps infra1_frame_id infra1_height
        infra1_optical_frame_id infra1_width infra2 infra2_fps infra2_frame_id infra2_height infra2_optical_frame_id infra2_width infra_fps
        infra_height infra_rgb infra_width initial_reset json_file_path linear_accel_cov manager odom_frame_id ordered_pc output
        pointcloud_texture_index pointcloud_texture_stream pose_frame_id pose_optical_frame_id publish_odom_tf publish_tf reconnect_timeout required
        respawn rgb rosbag_filename serial_no spatial_frame_id stereo_module/exposure/1 stereo_module/exposure/2 stereo_module/gain/1
        stereo_module/gain/2 tf_prefix tf_publish_rate topic_odom_in unite_imu_method usb_port_id wait_for_device_timeout""",
    "velodyne_pointcloud/launch/VLP16_points.launch": """
        calibration cut_angle device_ip frame_id gps_time laserscan_resolution laserscan_ring manager max_range min_range organize_cloud pcap
        pcap_time port read_fast read_once repeat_delay rpm timestamp_first_packet""",
    "nav2_bringup/launch/navigation_launch.py": """
        autostart container_name default_bt_xml_filename graph log_level map_subscribe_transient_local namespace params_file use_composition
        use_intra_process_comms use_keepout_zones use_respawn use_sim_time use_speed_zones""",
    "nav2_bringup/launch/localization_launch.py": """
        autostart container_name log_level map namespace params_file use_composition use_intra_process_comms use_respawn use_sim_time""",
    "nav2_bringup/launch/slam_launch.py": """
        autostart log_level namespace params_file slam_params_file use_lifecycle_manager use_respawn use_sim_time""",
    "nav2_bringup/launch/rviz_launch.py": "namespace rviz_config use_namespace use_sim_time",
    "nav2_bringup/launch/bringup_launch.py": """
        autostart container_name default_bt_xml_filename graph keepout_mask log_level map map_subscribe_transient_local namespace params_file slam
        slam_params_file speed_mask use_composition use_intra_process_comms use_keepout_zones use_lifecycle_manager use_localization use_namespace
        use_respawn use_sim_time use_speed_zones""",
    "slam_toolbox/launch/online_sync_launch.py": """
        autostart params_file slam_params_file use_lifecycle_manager use_sim_time""",
    "slam_toolbox/launch/online_async_launch.py": """
        autostart params_file slam_params_file use_lifecycle_manager use_sim_time""",
}
_DRIVERS = frozenset(("mavros", "realsense2_camera", "velodyne_pointcloud"))
#: What nav2_bringup itself passes to files of its own that do not read it, and those who copied it do, too.
_PASSED_ON = frozenset(("use_lifecycle_mgr", "map_subscribe_transient_local", "default_bt_xml_filename"))
_TEXT = regex(r"\$\(find(?:-pkg-share)?[ \t]+([\w-]+)\)/([\w./-]+)")


@dataclass(frozen=True, slots=True)
class OutsideFile:
    """A launch file of a released *package*: how it is called, and all arguments that it may have.

    *may_differ* says of a driver that many use in a version of their own, which may have more.
    """

    package: str
    name: str
    arguments: frozenset[str]
    may_differ: bool


def outside_file(text: str) -> OutsideFile | None:
    """The launch file that an include names with *text*; None if its arguments are not known."""
    match = _TEXT.fullmatch(text)
    names = _FILES.get(f"{match[1]}/{match[2]}") if match is not None else None
    if match is None or names is None:
        return None
    name = f"{match[2].rpartition('/')[2]} of {match[1]}"
    arguments = frozenset(names.split()) | (_PASSED_ON if match[1] == "nav2_bringup" else frozenset())
    return OutsideFile(match[1], name, arguments, match[1] in _DRIVERS)
