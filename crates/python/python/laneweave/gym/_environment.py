"""One world as an environment of Gymnasium."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

from .._laneweave import Map
from ._reasons import Reasons
from ._worlds import Populations, Worlds


class Environment(gymnasium.Env[Any, Any]):
    """A world in which a program drives one vehicle, the ego, among drivers who react.

    Args:
        source: A map or a scenario.
        task: What the program learns: the keys of a task that differ from the usual ones.
        populations: Styles with their weights, by the name of a population. Each episode has one of them, drawn at
            random; by default the styles of the scenario.
        flat: Whether an observation is one box; by default with the observation ``kinematics`` only.
        reasons: Whether ``info["reasons"]`` says why the drivers around changed lanes.
        render_mode: ``"rgb_array"``, or nothing.
        camera: ``"ego"``, or what laneweave.picture takes.
        size: Width and height of pictures in pixels.
        **keys: Keys of the scenario, such as ``vehicles_per_hour``.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        source: str | PathLike[str] | Map,
        task: Mapping[str, Any] | None = None,
        *,
        populations: Populations | None = None,
        flat: bool | None = None,
        reasons: bool = True,
        render_mode: str | None = None,
        camera: Any = "ego",
        size: tuple[int, int] = (640, 360),
        **keys: Any,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f'render_mode is "rgb_array" or None, not {render_mode!r}')
        self.worlds = Worlds(
            source,
            task or {},
            [0],
            populations=populations,
            threads=1,
            autoreset="disabled",
            reasons=reasons,
            flat=flat,
            keys=keys,
        )
        self.observation_space, self.action_space = self.worlds.observation_space, self.worlds.action_space
        self.render_mode, self.camera, self.size = render_mode, camera, size
        self._reasons = Reasons(self.worlds)
        self._has_begun = False

    @property
    def ego(self) -> int:
        """The id of the vehicle that the program drives in this episode."""
        return self.worlds.batch.ego(0)

    def simulation(self) -> Any:
        """A simulation that goes on from here: to look at, to ask, and to branch."""
        return self.worlds.batch.simulation(0)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins the next episode; with a seed, the first one of this seed."""
        super().reset(seed=seed)
        if seed is None and not self._has_begun:
            seed = int(self.np_random.integers(2**63))
        self._has_begun = True
        self.worlds.reset([seed], [True])
        return self._seen(), {"population": self.worlds.batch.populations[0]}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Acts, and simulates until the next action is due or the episode is over."""
        worlds = self.worlds
        worlds.act(action)
        info: dict[str, Any] = {"terms": dict(zip(worlds.batch.TERMS, worlds.terms[0].tolist(), strict=True))}
        if worlds.reasons:
            info["reasons"] = self._reasons.of(0)
        return self._seen(), float(worlds.rewards[0]), bool(worlds.terminated[0]), bool(worlds.truncated[0]), info

    def render(self) -> npt.NDArray[np.uint8] | None:
        """The traffic from above, as height × width × red, green, blue."""
        return None if self.render_mode is None else self.worlds.picture(0, self.camera, self.size)

    def _seen(self) -> Any:
        seen = self.worlds.seen(self.worlds.observations)
        return seen[0] if self.worlds.flat else {name: part[0] for name, part in seen.items()}
