# SPDX-License-Identifier: Apache-2.0
"""The topics that image_transport's plug-ins publish below an image's: implicit, and not certain to be there."""

from __future__ import annotations

import pytest
from follow_kit import cpp, ends

from haros_ci.extract.apis.tables import UNSURE

IT = "#include <image_transport/image_transport.h>\n"
BELOW = [("compressed", "CompressedImage"), ("compressedDepth", "CompressedImage"), ("theora", "Packet")]

#: Code of ``main``, the image's topic, the queue, and whether it is latched.
CASES = (
    ('image_transport::ImageTransport it(nh); it.advertise("image", 5);', "/image", 5, False),
    ('image_transport::ImageTransport it(nh); it.advertise("image", 5, true);', "/image", 5, True),
    ('image_transport::ImageTransport it(ros::NodeHandle("~")); it.advertise("image", 1);', "/n/image", 1, False),
    ('image_transport::ImageTransport it(nh); it.advertiseCamera("cam/image", 2);', "/cam/image", 2, False),
)


@pytest.mark.parametrize(("code", "topic", "queue", "latched"), CASES)
def test_topics_below_an_image(code: str, topic: str, queue: int, latched: bool) -> None:
    found = [end for end in ends(cpp(code, IT)) if end.implicit and end.name.startswith(topic)]
    assert [(end.name, (end.type or "").rpartition("/")[2]) for end in found] == [
        (f"{topic}/{name}", kind) for name, kind in BELOW
    ]
    assert {(end.queue_size, end.latched) for end in found} == {(queue, latched)}
    assert {(unknown.field, unknown.reason) for end in found for unknown in end.unknowns} == {("conditions", UNSURE)}


def test_they_stand_below_the_topic_as_it_is_remapped() -> None:
    launch = '<launch><node pkg="p" type="n" name="n"><remap from="image" to="/front/raw"/></node></launch>'
    found = ends(cpp('image_transport::ImageTransport it(nh); it.advertise("image", 5);', IT, launch))
    assert sorted(end.name for end in found if end.type != "rosgraph_msgs/Log") == [
        "/front/raw",
        "/front/raw/compressed",
        "/front/raw/compressedDepth",
        "/front/raw/theora",
    ]


QUIET = (
    'image_transport::ImageTransport it(nh); it.subscribe("image", 5, cb);',
    'nh.advertise<sensor_msgs::Image>("image", 5);',
    "image_transport::ImageTransport it(nh);",
)


@pytest.mark.parametrize("code", QUIET)
def test_nothing_below_what_is_not_advertised_as_an_image(code: str) -> None:
    found = cpp('ADV("base", 1); ' + code, IT + "void cb(const sensor_msgs::ImageConstPtr& m);\n")
    assert not [end.name for end in ends(found) if end.name.endswith(("/compressed", "/compressedDepth", "/theora"))]


BASE = """#include <elsewhere/base.h>
class C : public elsewhere::Base { public: C() : Base("c") { %s } void im(const sensor_msgs::ImageConstPtr& m) {}
 void both(const sensor_msgs::ImageConstPtr& m, const sensor_msgs::CameraInfoConstPtr& i) {} };
"""


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ('p = transport.advertise("/image", 1);', [("/image", "sensor_msgs/Image")]),
        ('p = transport->advertise("/image", 1, true);', [("/image", "sensor_msgs/Image")]),
        (
            'p = transport.advertiseCamera("/a/image", 1);',
            [("/a/camera_info", "sensor_msgs/CameraInfo"), ("/a/image", "sensor_msgs/Image")],
        ),
        (
            's = transport.subscribeCamera("/a/image", 1, &C::both, this);',
            [("/a/camera_info", "sensor_msgs/CameraInfo"), ("/a/image", "sensor_msgs/Image")],
        ),
        # what is another call
        ('p = handle.advertise<std_msgs::String>("/text", 1);', [("/text", "std_msgs/String")]),
        ("p = handle.advertise(options);", [("/?", None)]),
    ],
)
def test_a_transport_of_a_base_class_that_is_not_here(code: str, expected: list[tuple[str, str]]) -> None:
    found = cpp("C c;", IT + BASE % code)
    assert (
        sorted(
            (end.name, end.type)
            for kind in ("publishers", "subscribers")
            for end in ends(found, kind)
            if not end.implicit
        )
        == expected
    )
