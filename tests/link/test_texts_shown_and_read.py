# SPDX-License-Identifier: Apache-2.0
"""Texts that are shown in windows and widgets, or name the files that OpenCV and PCL read: they stay what they are."""

from __future__ import annotations

import pytest
from follow_kit import cpp, names

HEAD = "#include <opencv2/opencv.hpp>\n#include <QLabel>\nQLabel* label;\nUi::Window ui;\n"
KEPT = (
    "cv::namedWindow(s, 1);",
    "namedWindow(s);",
    "cv::imshow(s, image);",
    "cv::Mat image = cv::imread(s, 0);",
    "cv::imwrite(s, image);",
    "pcl::io::loadPCDFile(s, cloud);",
    "pcl::io::loadPCDFile<pcl::PointXYZ>(s, *cloud);",
    "pcl::io::savePCDFileASCII(s, cloud);",
    "label->setText(s);",
    "ui.label->setText(s);",
    "ui.window->setWindowTitle(s);",
)
#: Functions of the same libraries, and others, of which it is not known what they do.
MAY_CHANGE = (
    "cv::other(s);",
    "window.show(s);",
    "pcl::io::other(s);",
    "load(s);",
    "cv::namedWindow(f(s), 1);",
    "ui.label->getText(s);",
    "ui.label->text(&s);",
    "cv::imread(&s);",
    "elsewhere::set(s);",
    "QFile::read(s);",
)


@pytest.mark.parametrize("code", KEPT)
def test_what_is_shown_or_read_stays(code: str) -> None:
    assert names(cpp(f'std::string s = "a"; {code} ADV(s, 1);', HEAD)) == ["/a"]


@pytest.mark.parametrize("code", MAY_CHANGE)
def test_what_else_is_given_it_may_change_it(code: str) -> None:
    assert names(cpp(f'std::string s = "a"; {code} ADV(s, 1);', HEAD)) == ["/?"]


@pytest.mark.parametrize("name", ["namedWindow", "setText"])
def test_a_function_of_the_workspace_is_followed(name: str) -> None:
    own = f'void {name}(std::string& text) {{ text = "own"; }}\n'
    assert names(cpp(f'std::string s = "a"; {name}(s); ADV(s, 1);', HEAD + own)) == ["/own"]
