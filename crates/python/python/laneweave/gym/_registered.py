"""The environments that come with the package."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium

from .._examples import example
from ._environment import Environment
from ._vector import VectorEnvironment

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


def environment(name: str, task: Mapping[str, Any] | None = None, **keys: Any) -> Environment:
    """The environment with this name: its own task and scenario, with these keys in place of theirs."""
    return Environment(**_arguments(name, task, keys))


def worlds(name: str, task: Mapping[str, Any] | None = None, **keys: Any) -> VectorEnvironment:
    """Many worlds of the environment with this name."""
    return VectorEnvironment(**_arguments(name, task, keys))


def _arguments(name: str, task: Mapping[str, Any] | None, keys: Mapping[str, Any]) -> dict[str, Any]:
    own = ENVIRONMENTS[name]
    scenario = own.keys
    if "vehicles_per_hour" in keys:
        # The total replaces what the environment gives for single entrances.
        scenario = {key: it for key, it in scenario.items() if key != "demand"}
    return {"source": own.source, "task": {**own.task, **dict(task or {})}, **_merged(scenario, keys)}


def _merged(own: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Both tables, with the given values; of tables in both, too."""
    both = {key: _merged(own[key], given[key]) for key in own if _are_tables(own[key], given.get(key))}
    return {**own, **given, **both}


def _are_tables(one: Any, other: Any) -> bool:
    return isinstance(one, Mapping) and isinstance(other, Mapping)


def register() -> None:
    """Registers all environments; Gymnasium calls it, and it may be called again."""
    here = "laneweave.gym._registered"
    for name in ENVIRONMENTS:
        _register(name, f"{here}:environment", f"{here}:worlds", {"name": name})
    _register("Scenario-v0", "laneweave.gym:Environment", "laneweave.gym:VectorEnvironment", {})


def _register(name: str, one: str, many: str, arguments: dict[str, Any]) -> None:
    if f"laneweave/{name}" not in gymnasium.registry:
        gymnasium.register(id=f"laneweave/{name}", entry_point=one, vector_entry_point=many, kwargs=arguments)
