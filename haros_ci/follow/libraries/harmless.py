# SPDX-License-Identifier: Apache-2.0
"""Library functions that leave what they are given as it is: by full name, and by what only reads."""

from __future__ import annotations

from haros_ci import syntax

#: Namespaces of the C++ and Boost functions below.
SPACES = (
    "",
    "std::",
    "boost::",
    "boost::algorithm::",
    "boost::filesystem::",
    "std::filesystem::",
    "fs::",
    "ros::this_node::",
)
NUMBERS = (
    "abs acos asin atan atan2 cbrt ceil copysign cos cosh exp exp2 fabs floor fma fmax fmin fmod hypot isfinite isinf "
    "isnan isnormal ldexp llround log log10 log1p log2 lround max min nearbyint pow remainder rint round signbit sin "
    "sinh sqrt tan tanh trunc clamp"
)
TEXTS = (
    "atof atoi atol atoll isalnum isalpha isdigit isspace isupper islower memcmp stod stof stoi stol stoll stoul "
    "stoull strcasecmp strchr strcmp strlen strncmp strrchr strstr strdup tolower toupper to_string contains "
    "icontains starts_with istarts_with ends_with iends_with equals iequals all to_lower_copy to_upper_copy trim_copy "
    "trim_left_copy trim_right_copy trim_copy_if replace_all_copy replace_first_copy replace_last_copy erase_all_copy "
    "ireplace_all_copy join regex_match lexical_cast str format path exists is_directory is_regular_file absolute "
    "canonical extension filename stem"
)
ALGORITHMS = (
    "accumulate adjacent_find all_of any_of begin binary_search cbegin cend count count_if distance end equal "
    "equal_range find find_first_of find_if find_if_not includes is_sorted lexicographical_compare "
    "lower_bound max_element min_element minmax mismatch next none_of prev search size upper_bound get"
)
MAKERS = (
    "make_pair make_tuple make_shared make_unique make_optional bind function ref cref thread async pair tuple "
    "forward as_const static_pointer_cast dynamic_pointer_cast const_pointer_cast shared_ptr unique_ptr weak_ptr "
    "scoped_ptr lock_guard unique_lock runtime_error logic_error invalid_argument out_of_range exception "
    "numeric_limits initializer_list hash less greater boost::ref"
)
OUTPUT = (
    "printf fprintf vprintf puts fputs perror exit abort atexit signal sleep usleep system getenv assert getpid "
    "static_assert sizeof typeid alignof time fopen fclose remove access stat"
)
CHECKS = "CHECK CHECK_EQ CHECK_NE CHECK_LE CHECK_LT CHECK_GE CHECK_GT CHECK_NEAR CHECK_NOTNULL CHECK_STREQ CHECK_STRNE"
LOGS = "LOG LOG_IF LOG_EVERY_N LOG_FIRST_N LOG_IF_EVERY_N VLOG VLOG_IF VLOG_EVERY_N VLOG_IS_ON PLOG PCHECK"
#: Macros of glog.
GLOG = frozenset(f"{debug}{name}" for group in (CHECKS, LOGS) for name in group.split() for debug in ("", "D"))
FUNCTIONS = frozenset(
    f"{space}{name}"
    for group in (NUMBERS, TEXTS, ALGORITHMS, MAKERS, OUTPUT)
    for name in group.split()
    for space in SPACES
)
#: Functions of OpenCV (highgui.hpp, imgcodecs.hpp) and PCL (pcd_io.h, ply_io.h) that take the name of a window or file as a constant.
FILES_AND_WINDOWS = frozenset(
    (
        *(
            f"{space}{name}"
            for space in ("", "cv::")
            for name in "namedWindow destroyWindow imshow imread imwrite moveWindow resizeWindow setWindowTitle setMouseCallback "
            "setWindowProperty getWindowProperty".split()
        ),
        *(
            f"pcl::io::{name}"
            for name in "loadPCDFile savePCDFile savePCDFileASCII savePCDFileBinary savePCDFileBinaryCompressed loadPLYFile "
            "savePLYFile savePLYFileASCII savePLYFileBinary loadOBJFile load save".split()
        ),
    )
)
#: Methods of widgets that take a ``const QString&`` (doc.qt.io: QLabel, QWidget, QLineEdit, QObject, QGroupBox).
OF_WIDGETS = frozenset(
    "setText setWindowTitle setTitle setObjectName setToolTip setStatusTip setPlaceholderText setPlainText setCurrentText".split()
)
#: Beginnings of names: logging and checking macros.
MACROS = ("RCLCPP_", "ROS_", "ROSCONSOLE_", "NODELET_", "EXPECT_", "ASSERT_", "BOOST_ASSERT", "RCUTILS_", "PLUGINLIB_")
#: Libraries whose functions take what they are given as constants, but for those that get something.
LIBRARIES = (
    "ros::",
    "tf::",
    "tf2::",
    "tf2_ros::",
    "YAML::",
    "nodelet::",
    "message_filters::",
    "image_transport::",
    "actionlib::",
    "pluginlib::",
    "class_loader::",
    "diagnostic_updater::",
    "dynamic_reconfigure::",
    "std::chrono::",
    "boost::chrono::",
    "boost::posix_time::",
    "cv_bridge::",
    "rclcpp::",
    "rclcpp_action::",
    "rclcpp_components::",
    "rclcpp_lifecycle::",
    "point_cloud_transport::",
)
GETTERS = ("get", "search", "read", "parse", "extract", "split", "fill", "from")

PYTHON = frozenset(
    "print len str repr isinstance issubclass hasattr getattr callable id type any all sum min max sorted list tuple "
    "set frozenset dict zip map filter enumerate reversed iter range xrange abs round int float bool ord chr hash "
    "format open bytes complex divmod slice unicode basestring long super object Exception ValueError RuntimeError "
    "KeyError TypeError IOError OSError exit quit copy.copy copy.deepcopy json.dumps json.dump yaml.dump "
    "yaml.safe_dump pprint.pprint functools.partial threading.Thread threading.Timer multiprocessing.Process "
    "collections.OrderedDict "
    "collections.deque collections.Counter collections.defaultdict numpy.array numpy.asarray np.array np.asarray "
    "numpy.zeros np.zeros sys.exit".split()
)
PYTHON_LIBRARIES = (
    "rospy.",
    "rclpy.",
    "logging.",
    "math.",
    "os.",
    "time.",
    "warnings.",
    "itertools.",
    "operator.",
    "tf.",
    "tf2_ros.",
    "subprocess.",
    "string.",
    "re.",
    "datetime.",
    "message_filters.",
    "actionlib.",
    "diagnostic_updater.",
    "dynamic_reconfigure.",
    "super().",
)

#: Methods of texts, containers and iterators that only read.
READERS = frozenset(
    "at back begin bucket_count c_str capacity cbegin cend compare contains count crbegin crend data empty end "
    "equal_range find find_first_not_of find_first_of find_last_not_of find_last_of front get_allocator key_comp "
    "length lower_bound max_size rbegin rend rfind size starts_with ends_with str substr toString upper_bound value "
    "string native generic_string lock expired use_count filename stem extension parent_path getType valid hasMember Scalar as IsDefined "
    "IsMap IsScalar IsSequence IsNull Type Tag reserve shrink_to_fit toXml FindValue capitalize casefold center copy "
    "decode encode endswith expandtabs format format_map get has_key index isalnum isalpha isdecimal isdigit "
    "isidentifier islower isnumeric isspace istitle isupper items iteritems iterkeys itervalues join keys ljust lower "
    "lstrip partition rindex rjust rpartition rsplit rstrip split splitlines startswith strip swapcase title "
    "translate upper values viewitems viewkeys viewvalues zfill difference intersection issubset issuperset union "
    "symmetric_difference isdisjoint".split()
)
#: Exceptions that end a program (docs.python.org/3/library/exceptions.html; rclpy/executors.py).
ENDS = ("KeyboardInterrupt", "SystemExit", "ShutdownException", "GeneratorExit")

#: Functions that end the program, of C++ and of Python, and the last parts of their names.
ENDING = frozenset(
    "exit std::exit _exit _Exit std::_Exit quick_exit std::quick_exit abort std::abort std::terminate quit sys.exit "
    "os._exit os.abort".split()
)
EXITS = frozenset(name.rpartition("::")[2].rpartition(".")[2] for name in ENDING)


def is_harmless(name: str, is_python: bool) -> bool:
    """Whether a library's function of that full name leaves lists, texts and maps alone that it is given."""
    if is_python:
        return name in PYTHON or name.startswith(PYTHON_LIBRARIES)
    name = name.removeprefix("::")
    if name in FUNCTIONS or name in GLOG or name in FILES_AND_WINDOWS or name.startswith(MACROS):
        return True
    last = name.rpartition("::")[2]
    if last in OF_WIDGETS:
        return True
    return name.startswith(LIBRARIES) and not last.startswith(GETTERS)


def are_ends(handlers: tuple[syntax.Handler, ...]) -> bool:
    """Whether all that the handlers of a ``try`` catch is that the program is to end."""
    return all(any(word in f"{handler.text} {handler.type}" for word in ENDS) for handler in handlers)
