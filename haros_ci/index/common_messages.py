# SPDX-License-Identifier: Apache-2.0
"""Names of the messages and services of ROS 1's common packages (index.ros.org: std_msgs, common_msgs, std_srvs).

They tell which package an unqualified name is from where several are open: ``using namespace``, ``from x.msg import *``.
"""

from __future__ import annotations

COMMON: dict[str, frozenset[str]] = {
    package: frozenset(names.split())
    for package, names in {
        "std_msgs": "Bool Byte ByteMultiArray Char ColorRGBA Duration Empty Float32 Float32MultiArray Float64"
        " Float64MultiArray Header Int16 Int16MultiArray Int32 Int32MultiArray Int64 Int64MultiArray Int8 Int8MultiArray"
        " MultiArrayDimension MultiArrayLayout String Time UInt16 UInt16MultiArray UInt32 UInt32MultiArray UInt64"
        " UInt64MultiArray UInt8 UInt8MultiArray",
        "geometry_msgs": "Accel AccelStamped AccelWithCovariance AccelWithCovarianceStamped Inertia InertiaStamped Point"
        " Point32 PointStamped Polygon PolygonStamped Pose Pose2D PoseArray PoseStamped PoseWithCovariance"
        " PoseWithCovarianceStamped Quaternion QuaternionStamped Transform TransformStamped Twist TwistStamped"
        " TwistWithCovariance TwistWithCovarianceStamped Vector3 Vector3Stamped Wrench WrenchStamped",
        "sensor_msgs": "BatteryState CameraInfo ChannelFloat32 CompressedImage FluidPressure Illuminance Image Imu"
        " JointState Joy JoyFeedback JoyFeedbackArray LaserEcho LaserScan MagneticField MultiDOFJointState"
        " MultiEchoLaserScan NavSatFix NavSatStatus PointCloud PointCloud2 PointField Range RegionOfInterest"
        " RelativeHumidity Temperature TimeReference SetCameraInfo",
        "nav_msgs": "GetMapAction GridCells MapMetaData OccupancyGrid Odometry Path GetMap GetPlan LoadMap SetMap",
        "visualization_msgs": "ImageMarker InteractiveMarker InteractiveMarkerControl InteractiveMarkerFeedback"
        " InteractiveMarkerInit InteractiveMarkerPose InteractiveMarkerUpdate Marker MarkerArray MenuEntry",
        "stereo_msgs": "DisparityImage",
        "diagnostic_msgs": "DiagnosticArray DiagnosticStatus KeyValue AddDiagnostics SelfTest",
        "actionlib_msgs": "GoalID GoalStatus GoalStatusArray",
        "trajectory_msgs": "JointTrajectory JointTrajectoryPoint MultiDOFJointTrajectory MultiDOFJointTrajectoryPoint",
        "shape_msgs": "Mesh MeshTriangle Plane SolidPrimitive",
        "rosgraph_msgs": "Clock Log TopicStatistics",
        "std_srvs": "Empty SetBool Trigger",
        "tf2_msgs": "LookupTransformAction TF2Error TFMessage FrameGraph",
    }.items()
}
#: Constants of messages that are names in ROS 2 (bond/msg/Constants.msg).
NAMES = {"bond::msg::Constants::DISABLE_HEARTBEAT_TIMEOUT_PARAM": "bond_disable_heartbeat_timeout"}
