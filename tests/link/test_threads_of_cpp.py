# SPDX-License-Identifier: Apache-2.0
"""C++: threads call a function with what stands behind it; POSIX threads are threads, too."""

from __future__ import annotations

import pytest

from tests.link.follow_kit import cpp, names

GO = "void go(ros::NodeHandle & nh, std::string n) { ADV(n, 1); }\n"
W = (
    "struct W { ros::NodeHandle nh; void go(std::string n) { ADV(n, 1); }\n"
    'static void * entry(void * a) { static_cast<W *>(a)->go("t"); return nullptr; } };\n'
    'void * own(void * a) { ros::NodeHandle & nh = *(ros::NodeHandle *)a; ADV(std::string("t"), 1); return NULL; }\n'
)
FIRES = [
    ('std::thread t(go, std::ref(nh), "t");', ["/t"]),
    ('std::thread t(&go, std::ref(nh), "t");', ["/t"]),
    ('boost::thread t(go, boost::ref(nh), "t");', ["/t"]),
    ('auto f = std::async(go, std::ref(nh), "t");', ["/t"]),
    ('auto f = std::async(std::launch::async, go, std::ref(nh), "t");', ["/t"]),
    ('std::thread t(go, std::ref(nh), "a"); std::thread u(go, std::ref(nh), "b");', ["/a", "/b"]),
    ('W w; std::thread t(&W::go, &w, "t");', ["/t"]),
    ('W w; auto t = std::make_unique<std::thread>(&W::go, &w, "t");', ["/t"]),
    ('std::thread t([&](std::string n) { ADV(n, 1); }, "t");', ["/t"]),
    ('W w; std::thread t(std::bind(&W::go, &w, "t"));', ["/t"]),
    ("pthread_t t; pthread_create(&t, NULL, own, &nh);", ["/t"]),
    ("W w; pthread_t t; pthread_create(&t, nullptr, &W::entry, &w);", ["/t"]),
]
QUIET = [
    "std::thread t;",
    "std::thread t([] {}); t.join();",
    "W w; pthread_t t; pthread_join(t, NULL);",
    "W w; std::thread t(&W::other, &w);",
    "pthread_t t; pthread_create(&t, NULL, unseen, &nh);",
    "auto f = &W::entry; auto g = own;",
    "Own t(own, &nh);",
    'W w; auto f = std::bind(&W::go, &w, "t");',
]


@pytest.mark.parametrize(("body", "expected"), FIRES)
def test_what_a_thread_is_given(body: str, expected: list[str]) -> None:
    assert names(cpp(body, GO + W)) == expected


@pytest.mark.parametrize("body", QUIET)
def test_what_makes_nothing(body: str) -> None:
    assert names(cpp(body, GO + W + "struct Own { Own(void * (*)(void *), ros::NodeHandle *) {} };\n")) == []
