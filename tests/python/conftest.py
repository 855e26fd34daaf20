"""Scenes so small that a frame takes no time."""

import os
import sys
from pathlib import Path

import pytest

import rainref as rr

ROOT = Path(__file__).resolve().parents[2]
PACKS = Path(os.environ.get("RAINREF_PACKS", ROOT / "build/release/packs"))  # the build makes them
sys.path.insert(0, str(Path(__file__).parent))
PUDDLE = {"run.size": (64, 36), "puddle.grid": (96, 64), "rain.rate": 60, "rain.smallest_drop": 0.5,
          "environment.image": str(ROOT / "tests/packs/sky.png"), "puddle.ground_image": str(ROOT / "tests/packs/ground.png")}


@pytest.fixture
def puddle():
    return rr.open("puddle", PUDDLE)
