"""What PPO learns on laneweave/Merge-v0, and where: trained among conservative, usual and aggressive drivers, and tried
among all of them, beside a program that acts at random and one that keeps its lane.

Needs the packages laneweave (a release build), gymnasium, numpy and stable-baselines3:

    OMP_NUM_THREADS=1 python bench/learn_to_merge.py [--steps 300000] [--seeds 3] [--episodes 100] [--delay 0]

The reward is that of the environment, unless ``--delay`` puts a weight on time. The numbers of PPO are those of
stable-baselines3 except where they stand below. Neither was tuned. Episodes that judge begin in traffic that training
has not seen: another ``starts_seed``, and the same seeds for all.
"""

import argparse
import math
from typing import Any, Callable

import gymnasium
import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv

import laneweave.gym  # noqa: F401

POPULATIONS = {
    "conservative": {"conservative": 1},
    "usual": {"aggressive": 1, "conservative": 7.4},
    "aggressive": {"aggressive": 1},
}
HELD_OUT = 2
"""The ``starts_seed`` of the traffic that judges; training has 1."""
KEEP = 1
"""The action that keeps lane and speed."""

Policy = Callable[[np.ndarray], np.ndarray]

REWARDS: dict[str, float] = {}
"""Weights of the reward that are not those of the environment."""


def worlds(population: str, count: int, starts_seed: int) -> Any:
    """Environments in which these drivers drive."""
    arguments = {
        "populations": {population: POPULATIONS[population]},
        "autoreset_mode": "SameStep",
        "task": {"starts_seed": starts_seed, "rewards": REWARDS},
    }
    return gymnasium.make_vec("laneweave/Merge-v0", count, vectorization_mode="vector_entry_point", **arguments)


class Worlds(VecEnv):
    """The environments as stable-baselines3 takes them."""

    def __init__(self, population: str, count: int, seed: int) -> None:
        self.inner = worlds(population, count, starts_seed=1)
        self.first_seed = seed
        super().__init__(count, self.inner.single_observation_space, self.inner.single_action_space)

    def reset(self) -> np.ndarray:
        return self.inner.reset(seed=self.first_seed)[0]

    def step_async(self, actions: np.ndarray) -> None:
        self.actions = actions

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        observations, rewards, terminated, truncated, info = self.inner.step(self.actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for world in np.flatnonzero(terminated | truncated):
            infos[world] = {
                "terminal_observation": info["final_obs"][world],
                "TimeLimit.truncated": bool(truncated[world] and not terminated[world]),
            }
        return observations, rewards.astype(np.float32), terminated | truncated, infos

    def close(self) -> None:
        self.inner.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self.inner, attr_name)] * self.num_envs

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise NotImplementedError

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        raise NotImplementedError

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        return [False] * self.num_envs


def learned(population: str, seed: int, steps: int) -> Policy:
    """What PPO learns among these drivers."""
    environment = Worlds(population, 16, seed=1_000_000 * seed)
    model = PPO("MlpPolicy", environment, n_steps=128, batch_size=256, ent_coef=0.01, seed=seed, device="cpu")
    model.learn(steps)
    return lambda observations: model.predict(observations, deterministic=True)[0]


def judged(policy: Policy, population: str, episodes: int) -> dict[str, np.ndarray]:
    """One episode in each of so many worlds: returns, collisions, whether the ego left the map, and lengths."""
    environment = worlds(population, episodes, HELD_OUT)
    observations, _ = environment.reset(seed=0)
    runs = np.ones(episodes, bool)
    returns, collided, arrived, length = (np.zeros(episodes) for _ in range(4))
    while runs.any():
        observations, rewards, terminated, truncated, info = environment.step(policy(observations))
        returns += np.where(runs, rewards, 0.0)
        length += runs
        collided += np.where(runs, info["terms"]["collision"], 0.0)
        arrived += runs & terminated & (info["terms"]["collision"] == 0.0)
        runs &= ~(terminated | truncated)
    return {"return": returns, "collided": collided, "arrived": arrived, "length": length}


def interval(share: float, count: int) -> tuple[float, float]:
    """The 95 % interval of a share (Wilson 1927)."""
    z = 1.96
    middle, wide = share + z * z / (2 * count), z * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return (middle - wide) / (1 + z * z / count), (middle + wide) / (1 + z * z / count)


def row(name: str, population: str, trials: list[dict[str, np.ndarray]]) -> str:
    """A row of the table. Episodes with the same seed are one observation: the mean over the trials."""
    returns = np.mean([it["return"] for it in trials], axis=0)
    half = 1.96 * returns.std(ddof=1) / math.sqrt(len(returns))
    all_of = {key: np.concatenate([it[key] for it in trials]) for key in trials[0]}
    low, high = interval(all_of["collided"].mean(), len(all_of["collided"]))
    by_seed = ", ".join(f"{it['return'].mean():.2f}" for it in trials)
    return (
        f"| {name} | {population} | {returns.mean():.2f} ± {half:.2f} | {by_seed} | {all_of['collided'].mean():.1%}"
        f" ({low:.1%} to {high:.1%}) | {all_of['arrived'].mean():.1%} | {all_of['length'].mean():.1f} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=300_000)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--episodes", type=int, default=100)
    parser.add_argument("--delay", type=float, default=0.0, help="the weight of the time lost")
    asked = parser.parse_args()
    REWARDS["delay"] = asked.delay
    rng = np.random.default_rng(1)
    policies: dict[str, list[Policy]] = {
        "at random": [lambda seen: rng.integers(5, size=len(seen))],
        "keeps its lane": [lambda seen: np.full(len(seen), KEEP)],
    }
    print("| program | drives among | return | by training seed | collisions | arrived | decisions |", flush=True)
    print("|---|---|---|---|---|---|---|", flush=True)
    for population in POPULATIONS:
        for name, all_of in policies.items():
            print(row(name, population, [judged(it, population, asked.episodes) for it in all_of]), flush=True)
    for trained in POPULATIONS:
        all_of = [learned(trained, seed, asked.steps) for seed in range(1, asked.seeds + 1)]
        for population in POPULATIONS:
            trials = [judged(it, population, asked.episodes) for it in all_of]
            print(row(f"learned among {trained}", population, trials), flush=True)


if __name__ == "__main__":
    main()
