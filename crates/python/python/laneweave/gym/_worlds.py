"""The worlds behind environments: one batch, and the arrays into which it writes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _laneweave
from .._laneweave import Map
from .._view import Picture
from ._spaces import Floats, action_space, observation_space, parts_of

Populations = Mapping[str, Mapping[Any, float]]
"""Styles with their weights, by the name of a population."""


def _checked(populations: Populations) -> dict[str, dict[Any, float]]:
    example = 'give styles with their weights, such as {"calm": {"conservative": 1}}'
    if not isinstance(populations, Mapping):
        raise TypeError(f"populations: {populations!r} is no dict; {example}")
    for name, styles in populations.items():
        if not isinstance(name, str) or not isinstance(styles, Mapping):
            raise TypeError(f"populations: {name!r}: {styles!r} is no population; {example}")
    return {name: dict(styles) for name, styles in populations.items()}


class Worlds:
    """Many worlds of one task, with their arrays."""

    def __init__(
        self,
        source: str | PathLike[str] | Map,
        task: Mapping[str, Any],
        seeds: Sequence[int],
        *,
        populations: Populations | None,
        threads: int,
        autoreset: str,
        reasons: bool,
        flat: bool | None,
        keys: Mapping[str, Any],
    ) -> None:
        named = [("scenario", dict(keys))]
        if populations is not None:
            named = [(name, {**keys, "styles": styles}) for name, styles in _checked(populations).items()]
        kind = task.get("observation")
        whole = {**task, "observation": {kind: {}}} if isinstance(kind, str) else dict(task)
        self.batch = _laneweave.Batch(source, named, whole, list(seeds), threads, autoreset, reasons)
        self.task: dict[str, Any] = self.batch.task
        self.reasons = reasons
        count, numbers = len(seeds), sum(int(np.prod(part["shape"])) for part in self.batch.parts)
        self.flat = flat if flat is not None else "kinematics" in self.task["observation"]
        self.observation_space = observation_space(self.batch, self.flat)
        self.action_space = action_space(self.task)
        self.observations: Floats = np.zeros((count, numbers), np.float32)
        self.last_observations: Floats = np.zeros((count, numbers), np.float32)
        self.rewards = np.zeros(count)
        self.terms = np.zeros((count, len(self.batch.TERMS)))
        self.terminated, self.truncated = np.zeros(count, bool), np.zeros(count, bool)

    def reset(self, seeds: Sequence[int | None], mask: Sequence[bool]) -> None:
        """Begins the next episodes where the mask is true."""
        self.batch.reset(list(seeds), [bool(it) for it in mask], self.observations)

    def act(self, actions: Any) -> None:
        """Acts in all worlds."""
        rows = np.ascontiguousarray(actions, np.float64)
        expected = (len(self.rewards), *(self.action_space.shape or ()))
        # One world takes its action without the axis of worlds.
        if rows.shape != expected and not (len(self.rewards) == 1 and rows.shape == expected[1:]):
            raise ValueError(f"actions: they have the shape {rows.shape}; give {expected}, a row for each world")
        rows = rows.reshape(len(self.rewards), -1)
        self.batch.act(
            rows,
            self.observations,
            self.last_observations,
            self.rewards,
            self.terms,
            self.terminated,
            self.truncated,
        )

    def seen(self, rows: Floats) -> Any:
        """Observations, one in each row of numbers, as the space has them: a copy."""
        return rows.copy() if self.flat else {name: part.copy() for name, part in parts_of(self.batch, rows).items()}

    def terms_by_name(self) -> dict[str, npt.NDArray[np.float64]]:
        """The terms of the rewards, each of all worlds."""
        return {name: self.terms[:, number].copy() for number, name in enumerate(self.batch.TERMS)}

    def picture(self, world: int, camera: Any, size: tuple[int, int]) -> npt.NDArray[np.uint8]:
        """A world from above: height × width × red, green, blue."""
        ego = self.batch.ego(world)
        with self.batch.simulation(world) as simulation:
            is_there = simulation.vehicle(ego) is not None
            place = camera if camera != "ego" else (ego if is_there else "map")
            return simulation._pixels(place, size)
