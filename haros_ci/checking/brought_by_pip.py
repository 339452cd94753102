# SPDX-License-Identifier: Apache-2.0
"""What pip installs with a distribution that somebody asks for: pydantic with fastapi."""

from __future__ import annotations

#: Distributions that nodes import beside those that bring them, by the names of PEP 503: ``Requires-Dist`` in the metadata of the latest
#: release of each (without extras), where older ones have it, too.
_REQUIRED = {
    "aiohttp": "multidict yarl attrs",
    "dronekit": "pymavlink",
    "dynamixel-sdk": "pyserial",
    "fastapi": "pydantic starlette anyio typing-extensions",
    "flask": "werkzeug jinja2 click itsdangerous markupsafe",
    "flask-cors": "flask",
    "flask-socketio": "flask python-socketio",
    "matplotlib": "numpy pillow cycler kiwisolver pyparsing python-dateutil packaging",
    "mediapipe": "numpy matplotlib absl-py opencv-contrib-python",
    "openai": "pydantic anyio sniffio typing-extensions",
    "opencv-contrib-python": "numpy",
    "opencv-python": "numpy",
    "opencv-python-headless": "numpy",
    "pandas": "numpy python-dateutil",
    "python-socketio": "python-engineio bidict",
    "scikit-image": "numpy scipy networkx pillow imageio tifffile packaging",
    "scikit-learn": "numpy scipy joblib threadpoolctl",
    "scipy": "numpy",
    "seaborn": "numpy pandas matplotlib",
    "stable-baselines3": "numpy torch gymnasium cloudpickle",
    "timm": "torch torchvision pyyaml huggingface-hub safetensors",
    "torchvision": "torch numpy pillow",
    "transformers": "numpy pyyaml huggingface-hub tokenizers safetensors tqdm packaging",
    "ultralytics": "numpy matplotlib opencv-python pillow pyyaml requests torch torchvision psutil",
}


def brought(name: str) -> frozenset[str]:
    """The distributions that pip installs with the one called *name*, themselves with all that they bring; none where nothing is known of it."""
    found: set[str] = set()
    waiting = _REQUIRED.get(name, "").split()
    while waiting:
        other = waiting.pop()
        if other not in found:
            found.add(other)
            waiting += _REQUIRED.get(other, "").split()
    return frozenset(found)
