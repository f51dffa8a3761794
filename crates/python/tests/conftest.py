"""Where the maps are."""

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

MAPS = Path(__file__).resolve().parents[3] / "maps"


@pytest.fixture
def ramps() -> Path:
    return MAPS / "ramps.osm"


@pytest.fixture
def merge() -> Path:
    return MAPS / "on_ramp.osm"


@pytest.fixture(autouse=True)
def ctrl_c() -> Iterator[None]:
    """Ctrl-C raises, also in a program that was begun in the background, where a shell has it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
