"""Steps of laneweave's environments beside those of highway-env: alternated rounds in one process, by CPU time.

Needs the packages laneweave (a release build), gymnasium, highway-env and numpy:

    OPENBLAS_NUM_THREADS=1 python bench/beside_highway_env.py [--worlds 64] [--rounds 5] [--seconds 4]

Both take actions at random, and begin anew at the end of an episode. An environment step is one action; a vehicle update
is one vehicle in one substep. The vehicles of laneweave are those on the road in each substep at the end of a step.
"""

import argparse
import time
from typing import Any

import gymnasium
import highway_env  # noqa: F401
import numpy as np

import laneweave.gym  # noqa: F401


def theirs(seconds: float, environment: Any, rng: np.random.Generator) -> tuple[float, float]:
    """Environment steps and vehicle updates per CPU second of highway-env."""
    config = environment.unwrapped.config
    substeps = config["simulation_frequency"] // config["policy_frequency"]
    steps = updates = 0
    begin = time.process_time()
    while time.process_time() - begin < seconds:
        *_, terminated, truncated, _ = environment.step(rng.integers(environment.action_space.n))
        steps += 1
        updates += substeps * len(environment.unwrapped.road.vehicles)
        if terminated or truncated:
            environment.reset()
    spent = time.process_time() - begin
    return steps / spent, updates / spent


def ours(seconds: float, environment: Any, rng: np.random.Generator, substeps: int) -> tuple[float, float]:
    """The same of laneweave. Vehicles are counted once in a round, outside of the time that is measured."""
    worlds, batch = environment.num_envs, environment.unwrapped.worlds.batch
    steps = 0
    begin = time.process_time()
    while time.process_time() - begin < seconds:
        environment.step(rng.integers(5, size=worlds))
        steps += worlds
    spent = time.process_time() - begin
    vehicles = np.mean([len(batch.simulation(number).vehicles()) for number in range(worlds)])
    return steps / spent, steps * substeps * float(vehicles) / spent


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--environment", default="laneweave/Merge-v0")
    parser.add_argument("--beside", default="merge-v1")
    parser.add_argument("--worlds", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=4.0)
    asked = parser.parse_args()
    rng = np.random.default_rng(1)
    one = gymnasium.make(asked.beside)
    one.reset(seed=1)
    config = one.unwrapped.config
    their_substeps = config["simulation_frequency"] // config["policy_frequency"]
    many = gymnasium.make_vec(asked.environment, num_envs=asked.worlds, vectorization_mode="vector_entry_point")
    many.reset(seed=1)
    # A decision a second, in steps of 0.1 s.
    substeps = 10
    # Episodes at their beginnings have other vehicles than later.
    ours(asked.seconds, many, rng, substeps)
    rows = []
    for number in range(asked.rounds):
        a, b = theirs(asked.seconds, one, rng), ours(asked.seconds, many, rng, substeps)
        rows.append((*a, *b))
        print(
            f"round {number + 1}: {asked.beside} {a[0]:.1f} steps/s, {a[1]:.0f} updates/s;"
            f" {asked.environment} {b[0]:.0f} steps/s, {b[1]:.0f} updates/s; ×{b[0] / a[0]:.0f}, ×{b[1] / a[1]:.0f}"
        )
    best = np.median(np.array(rows), axis=0)
    print(f"median: ×{best[2] / best[0]:.0f} environment steps, ×{best[3] / best[1]:.0f} vehicle updates, per CPU second")
    print(f"vehicles: {best[1] / best[0] / their_substeps:.1f}, {best[3] / best[2] / substeps:.1f}")
    print(f"substeps: {their_substeps}, {substeps}")


if __name__ == "__main__":
    main()
