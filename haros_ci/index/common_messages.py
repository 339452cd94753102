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
#: The same of packages of ros_control, navigation, gazebo_ros_pkgs and MoveIt, which Python modules are opened of.
OPENED: dict[str, frozenset[str]] = COMMON | {
    package: frozenset(names.split())
    for package, names in {
        "control_msgs": "FollowJointTrajectoryAction GripperCommandAction JointTrajectoryAction PointHeadAction"
        " SingleJointPositionAction DynamicJointState GripperCommand InterfaceValue JointControllerState JointJog"
        " JointTolerance JointTrajectoryControllerState PidState QueryCalibrationState QueryTrajectoryState",
        "controller_manager_msgs": "ControllerState ControllerStatistics ControllersStatistics HardwareInterfaceResources ListControllerTypes"
        " ListControllers LoadController ReloadControllerLibraries SwitchController UnloadController",
        "move_base_msgs": "MoveBaseAction RecoveryStatus",
        "map_msgs": "OccupancyGridUpdate PointCloud2Update ProjectedMap ProjectedMapInfo GetMapROI GetPointMap GetPointMapROI"
        " ProjectedMapsInfo SaveMap SetMapProjections",
        "gazebo_msgs": "ContactState ContactsState LinkState LinkStates ModelState ModelStates ODEJointProperties ODEPhysics"
        " PerformanceMetrics SensorPerformanceMetric WorldState ApplyBodyWrench ApplyJointEffort BodyRequest"
        " DeleteLight DeleteModel GetJointProperties GetLightProperties GetLinkProperties GetLinkState"
        " GetModelProperties GetModelState GetPhysicsProperties GetWorldProperties JointRequest SetJointProperties"
        " SetJointTrajectory SetLightProperties SetLinkProperties SetLinkState SetModelConfiguration SetModelState"
        " SetPhysicsProperties SpawnModel",
        "ackermann_msgs": "AckermannDrive AckermannDriveStamped",
        "moveit_msgs": "ExecuteTrajectoryAction MoveGroupAction MoveGroupSequenceAction PickupAction PlaceAction"
        " AllowedCollisionEntry AllowedCollisionMatrix AttachedCollisionObject BoundingVolume CartesianPoint"
        " CartesianTrajectory CartesianTrajectoryPoint CollisionObject ConstraintEvalResult Constraints"
        " ContactInformation CostSource DisplayRobotState DisplayTrajectory GenericTrajectory Grasp"
        " GripperTranslation JointConstraint JointLimits KinematicSolverInfo LinkPadding LinkScale"
        " MotionPlanDetailedResponse MotionPlanRequest MotionPlanResponse MotionSequenceItem MotionSequenceRequest"
        " MotionSequenceResponse MoveItErrorCodes ObjectColor OrientationConstraint OrientedBoundingBox"
        " PlaceLocation PlannerInterfaceDescription PlannerParams PlanningOptions PlanningScene"
        " PlanningSceneComponents PlanningSceneWorld PositionConstraint PositionIKRequest RobotState"
        " RobotTrajectory TrajectoryConstraints VisibilityConstraint WorkspaceParameters ApplyPlanningScene"
        " ChangeControlDimensions ChangeDriftDimensions CheckIfRobotStateExistsInWarehouse"
        " DeleteRobotStateFromWarehouse ExecuteKnownTrajectory GetCartesianPath GetMotionPlan GetMotionSequence"
        " GetPlannerParams GetPlanningScene GetPositionFK GetPositionIK GetRobotStateFromWarehouse GetStateValidity"
        " GraspPlanning ListRobotStatesInWarehouse LoadMap QueryPlannerInterfaces RenameRobotStateInWarehouse"
        " SaveMap SaveRobotStateToWarehouse SetPlannerParams UpdatePointcloudOctomap",
    }.items()
}
#: Constants of messages that are names in ROS 2 (bond/msg/Constants.msg).
NAMES = {"bond::msg::Constants::DISABLE_HEARTBEAT_TIMEOUT_PARAM": "bond_disable_heartbeat_timeout"}
