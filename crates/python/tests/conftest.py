"""Where the maps are."""

from pathlib import Path

import pytest

MAPS = Path(__file__).resolve().parents[3] / "maps"


@pytest.fixture
def ramps() -> Path:
    return MAPS / "ramps.osm"


@pytest.fixture
def merge() -> Path:
    return MAPS / "on_ramp.osm"
