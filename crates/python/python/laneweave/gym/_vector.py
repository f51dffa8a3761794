"""Many worlds as one environment of Gymnasium."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium.vector import AutoresetMode, VectorEnv

from .._laneweave import Map
from ._reasons import Reasons
from ._spaces import batched
from ._worlds import Populations, Worlds

_MODES = {
    AutoresetMode.NEXT_STEP: "next_step",
    AutoresetMode.SAME_STEP: "same_step",
    AutoresetMode.DISABLED: "disabled",
}


class VectorEnvironment(VectorEnv[Any, Any, Any]):
    """Many worlds of one task, which are stepped together: no loop over them in Python.

    Takes what :class:`Environment` takes, and:

    Args:
        num_envs: Number of worlds.
        threads: Number of threads that step them.
        autoreset_mode: When a world whose episode is over begins the next one.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        source: str | PathLike[str] | Map,
        task: Mapping[str, Any] | None = None,
        *,
        num_envs: int = 1,
        threads: int = 1,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        populations: Populations | None = None,
        flat: bool | None = None,
        reasons: bool = False,
        render_mode: str | None = None,
        camera: Any = "ego",
        size: tuple[int, int] = (320, 180),
        **keys: Any,
    ) -> None:
        mode = AutoresetMode(autoreset_mode)
        self.num_envs, self.mode = num_envs, mode
        self.metadata = {**self.metadata, "autoreset_mode": mode}
        self.worlds = Worlds(
            source,
            task or {},
            range(num_envs),
            populations=populations,
            threads=threads,
            autoreset=_MODES[mode],
            reasons=reasons,
            flat=flat,
            keys=keys,
        )
        self.single_observation_space = self.worlds.observation_space
        self.single_action_space = self.worlds.action_space
        self.observation_space = batched(self.single_observation_space, num_envs)
        self.action_space = batched(self.single_action_space, num_envs)
        self.render_mode, self.camera, self.size = render_mode, camera, size
        self._reasons = Reasons(self.worlds)
        self._has_begun = False

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begins the next episode in all worlds, or in those of ``options["reset_mask"]``; with a seed, the first one
        of ``seed + number`` in each, or of its own."""
        if isinstance(seed, np.integer):
            seed = int(seed)
        super().reset(seed=seed if isinstance(seed, int) else None)
        seeds: list[int | None]
        if seed is None:
            first = None if self._has_begun else int(self.np_random.integers(2**62))
            seeds = [None if first is None else first + it for it in range(self.num_envs)]
        elif isinstance(seed, int):
            seeds = [seed + it for it in range(self.num_envs)]
        else:
            seeds = list(seed)
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, bool))
        self._has_begun = True
        self.worlds.reset(seeds, mask)
        names = np.array(self.worlds.batch.populations, object)
        return self.worlds.seen(self.worlds.observations), {"population": names, "_population": np.asarray(mask, bool)}

    def step(
        self, actions: Any
    ) -> tuple[Any, npt.NDArray[Any], npt.NDArray[np.bool_], npt.NDArray[np.bool_], dict[str, Any]]:
        """Acts in all worlds, and simulates until the next actions are due."""
        worlds = self.worlds
        worlds.act(actions)
        terminated, truncated = worlds.terminated.copy(), worlds.truncated.copy()
        info: dict[str, Any] = {"terms": worlds.terms_by_name()}
        is_over = terminated | truncated
        if self.mode == AutoresetMode.SAME_STEP and is_over.any():
            info |= {"final_obs": self._last(is_over), "_final_obs": is_over}
        if worlds.reasons:
            info["reasons"] = [self._reasons.of(it) for it in range(self.num_envs)]
        return worlds.seen(worlds.observations), worlds.rewards.copy(), terminated, truncated, info

    def _last(self, is_over: npt.NDArray[np.bool_]) -> npt.NDArray[Any]:
        """The last observations of the episodes that are over."""
        last = np.full(self.num_envs, None, object)
        seen = self.worlds.seen(self.worlds.last_observations)
        for world in np.flatnonzero(is_over):
            last[world] = seen[world] if self.worlds.flat else {name: part[world] for name, part in seen.items()}
        return last

    def render(self) -> tuple[npt.NDArray[np.uint8], ...] | None:
        """All worlds from above, each as height × width × red, green, blue."""
        if self.render_mode is None:
            return None
        return tuple(self.worlds.picture(it, self.camera, self.size) for it in range(self.num_envs))
