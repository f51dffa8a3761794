"""Observations and actions as spaces of Gymnasium."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from .._laneweave import Batch

Floats = npt.NDArray[np.float32]
# A pose: 60 m/s ahead, 5 m/s to the left, half a turn in a second.
_POSE = np.array([60.0, 5.0, np.pi])


def observation_space(batch: Batch, flat: bool) -> spaces.Space[Any]:
    """The space of an observation: one box if it is flat, otherwise a dict of its parts."""
    parts: dict[str, spaces.Space[Any]] = {
        part["name"]: spaces.Box(*_bounds(part["name"]), tuple(part["shape"]), np.float32) for part in batch.parts
    }
    if not flat:
        return spaces.Dict(parts)
    numbers = sum(int(np.prod(space.shape)) for space in parts.values() if space.shape is not None)
    return spaces.Box(-1.0, 1.0, (numbers,), np.float32)


def _bounds(part: str) -> tuple[float, float]:
    # Links name places of lanelets.
    return (-1.0, 1024.0) if part == "links" else (-1.0, 1.0)


def parts_of(batch: Batch, rows: Floats) -> dict[str, Floats]:
    """The parts of observations, one in each row of numbers."""
    found, begin = {}, 0
    for part in batch.parts:
        numbers = int(np.prod(part["shape"]))
        found[part["name"]] = rows[..., begin : begin + numbers].reshape(*rows.shape[:-1], *part["shape"])
        begin += numbers
    return found


def action_space(task: dict[str, Any]) -> spaces.Space[Any]:
    """The space of an action."""
    match task["action"]:
        case "discrete":
            return spaces.Discrete(len(Batch.CHOICES))
        case "continuous":
            return spaces.Box(-1.0, 1.0, (2,), np.float32)
        case _:
            reach = (_POSE * task["decision_s"]).astype(np.float32)
            return spaces.Box(np.array([0.0, -reach[1], -reach[2]], np.float32), reach, dtype=np.float32)


def batched(space: spaces.Space[Any], count: int) -> spaces.Space[Any]:
    """The space of so many at once."""
    return gymnasium.vector.utils.batch_space(space, count)
