"""The environments that come with the package."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium

from .._examples import example

_MAPS = Path(__file__).parent / "maps"


@dataclass(frozen=True)
class Registered:
    """An environment that comes with the package: its map, its task and its scenario."""

    source: Path
    task: dict[str, Any]
    keys: dict[str, Any] = field(default_factory=dict)


ENVIRONMENTS = {
    # From an on-ramp onto a motorway of two lanes.
    "Merge-v0": Registered(
        _MAPS / "merge.osm",
        {"entrances": [20], "limit_s": 60.0},
        {"demand": {"entrances": {"1": 2400, "20": 500}}},
    ),
    # Three lanes, of which the slow one ends.
    "LaneDrop-v0": Registered(_MAPS / "lane_drop.osm", {"limit_s": 60.0}, {"vehicles_per_hour": 3000}),
    # From an on-ramp through a weaving section, straight on or off again.
    "Weave-v0": Registered(example("weaving"), {"entrances": [31], "limit_s": 180.0}, {"vehicles_per_hour": 3600}),
    # Through a roundabout of one lane.
    "Roundabout-v0": Registered(example("roundabout"), {"limit_s": 120.0}, {"vehicles_per_hour": 1000}),
    # Over a junction where a minor road crosses a priority road.
    "Crossing-v0": Registered(
        example("priority"), {"entrances": [13, 24], "limit_s": 120.0}, {"vehicles_per_hour": 1000}
    ),
}
"""The environments by their names."""


def register() -> None:
    """Registers all environments; Gymnasium calls it, and it may be called again."""
    for name, it in ENVIRONMENTS.items():
        _register(name, {"source": it.source, "task": it.task, **it.keys})
    _register("Scenario-v0", {})


def _register(name: str, arguments: dict[str, Any]) -> None:
    if f"laneweave/{name}" in gymnasium.registry:
        return
    gymnasium.register(
        id=f"laneweave/{name}",
        entry_point="laneweave.gym:Environment",
        vector_entry_point="laneweave.gym:VectorEnvironment",
        kwargs=arguments,
    )
