"""Environments keep Gymnasium's rules, alone and many together."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import gymnasium
import laneweave as lw
import laneweave.gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv

OBSERVATIONS: tuple[dict[str, Any], ...] = ({"kinematics": {"nearest": 3}}, {"grid": {}}, {"lanes": {}})
SOON = {"warmup_s": 10.0, "starts": 4}


@pytest.mark.parametrize("name", [*laneweave.gym.ENVIRONMENTS, "Scenario-v0"])
def test_environments_keep_the_rules(name: str) -> None:
    given: dict[str, Any] = {} if name != "Scenario-v0" else {"source": lw.example("town"), "task": SOON}
    environment = gymnasium.make(f"laneweave/{name}", **given)
    check_env(environment.unwrapped, skip_render_check=True)


@pytest.mark.parametrize("action", ["discrete", "continuous", "pose"])
@pytest.mark.parametrize("observation", OBSERVATIONS, ids=lambda it: next(iter(it)))
def test_all_kinds_of_observations_and_actions_keep_the_rules(action: str, observation: dict[str, Any]) -> None:
    task = {**SOON, "action": action, "observation": observation}
    check_env(laneweave.gym.Environment(lw.example("ramps"), task), skip_render_check=True)


def same(one: Any, other: Any) -> bool:
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(it, other[name]) for name, it in one.items())
    return bool(np.array_equal(one, other))


@pytest.mark.parametrize("observation", OBSERVATIONS, ids=lambda it: next(iter(it)))
@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_many_worlds_do_what_gymnasium_makes_of_single_ones(mode: AutoresetMode, observation: dict[str, Any]) -> None:
    task = {**SOON, "observation": observation, "limit_s": 8.0}
    source, count = lw.example("ramps"), 5
    ours = laneweave.gym.VectorEnvironment(source, task, num_envs=count, threads=2, autoreset_mode=mode)
    single = laneweave.gym.Environment
    theirs = SyncVectorEnv([lambda: single(source, task, reasons=False)] * count, autoreset_mode=mode)
    assert ours.observation_space == theirs.observation_space and ours.action_space == theirs.action_space
    (one, _), (other, _) = ours.reset(seed=3), theirs.reset(seed=3)
    assert same(one, other) and one in ours.observation_space
    ours.action_space.seed(1)
    ended = 0
    for _ in range(30):
        actions = ours.action_space.sample()
        one, *found, info = ours.step(actions)
        other, *expected, their_info = theirs.step(actions)
        assert same(one, other) and all(same(*it) for it in zip(found, expected, strict=True))
        if "final_obs" in their_info:
            assert same(info["_final_obs"], their_info["_final_obs"])
            pairs = zip(info["final_obs"], their_info["final_obs"], strict=True)
            assert all((a is None) == (b is None) and (a is None or same(a, b)) for a, b in pairs)
        ended += int((found[1] | found[2]).sum())
    assert ended >= count


def test_worlds_begin_anew_where_the_mask_says(merge: Path) -> None:
    environment = laneweave.gym.VectorEnvironment(merge, SOON, num_envs=3, autoreset_mode="Disabled")
    first, _ = environment.reset(seed=1)
    before, *_ = environment.step([1, 1, 1])
    mask = np.array([False, True, False])
    after, _ = environment.reset(seed=1, options={"reset_mask": mask})
    assert same(after[[0, 2]], before[[0, 2]]) and same(after[1], first[1])


def test_make_vec_gives_worlds_without_a_loop() -> None:
    environment = gymnasium.make_vec("laneweave/Merge-v0", num_envs=4)
    assert isinstance(environment.unwrapped, laneweave.gym.VectorEnvironment)
    observations, _ = environment.reset(seed=1)
    assert observations.shape == environment.observation_space.shape
    other = gymnasium.make_vec("laneweave/Merge-v0", num_envs=4, threads=2, autoreset_mode="SameStep")
    assert other.unwrapped.mode is gymnasium.vector.AutoresetMode.SAME_STEP  # type: ignore[attr-defined]
    assert np.array_equal(other.reset(seed=1)[0], observations)


def test_what_is_given_is_put_into_what_an_environment_has(merge: Path) -> None:
    def made(**keys: Any) -> Any:
        return gymnasium.make("laneweave/Merge-v0", **keys).unwrapped

    own = made().worlds.task
    assert own["entrances"] == ["20"]
    assert made(task={"decision_s": 0.5}).worlds.task == {**own, "decision_s": 0.5}
    many = gymnasium.make_vec("laneweave/Merge-v0", num_envs=2, task={"limit_s": 30.0})
    assert many.unwrapped.worlds.task == {**own, "limit_s": 30.0}  # type: ignore[attr-defined]

    def vehicles(environment: Any) -> int:
        environment.reset(seed=1)
        return len(environment.simulation().vehicles())

    usual, trucks = vehicles(made()), vehicles(made(demand={"trucks": 0.5}))
    assert vehicles(made(vehicles_per_hour=300)) < usual / 2 < vehicles(made(vehicles_per_hour=4500))
    assert trucks > usual / 2
    few = lw.Simulation(merge, demand={"entrances": {"1": 3000}}, vehicles_per_hour=10, duration_s=300)
    assert few.scenario["demand"]["entrances"] == {"1": 3000}


def test_reasons_say_why_drivers_around_changed_lanes(merge: Path) -> None:
    environment = laneweave.gym.Environment(merge, {"limit_s": 300.0}, vehicles_per_hour=3000)
    environment.reset(seed=1)
    reasons = [it for _ in range(60) for it in environment.step(1)[4]["reasons"]]
    assert reasons and all(it["reasons"] or it["kind"] != "discretionary" for it in reasons)


def test_each_episode_has_one_of_the_populations(merge: Path) -> None:
    gentle = lw.Style("gentle")
    populations: dict[str, dict[Any, float]] = {"wild": {"aggressive": 1.0}, "calm": {gentle: 2.0, "conservative": 1.0}}
    environment = laneweave.gym.Environment(merge, SOON, populations=populations)
    names = [environment.reset(seed=3 if number == 0 else None)[1]["population"] for number in range(20)]
    assert set(names) == {"wild", "calm"}
    styles = {it["style"] for it in environment.simulation().vehicles()}
    assert styles <= ({"aggressive"} if names[-1] == "wild" else {"gentle", "conservative"})


def test_a_picture_shows_the_ego(merge: Path) -> None:
    environment = laneweave.gym.Environment(merge, SOON, render_mode="rgb_array", size=(160, 90))
    environment.reset(seed=1)
    pixels = environment.render()
    assert pixels is not None and pixels.shape == (90, 160, 3) and pixels.dtype == np.uint8 and pixels.std() > 5


def test_what_cannot_be_is_refused_with_a_remedy(merge: Path) -> None:
    with pytest.raises(lw.ScenarioError, match='did you mean "limit_s"'):
        laneweave.gym.Environment(merge, {"limits": 3})
    with pytest.raises(lw.ScenarioError, match="name entrances"):
        laneweave.gym.Environment(merge, {"entrances": [123]})
    wrong: Any
    for wrong in ({"calm": 1}, {"calm": "conservative"}, ["conservative"], {1: {"conservative": 1}}):
        with pytest.raises(TypeError, match="give styles with their weights"):
            laneweave.gym.Environment(merge, populations=wrong)
    with pytest.raises(ValueError, match="rgb_array"):
        laneweave.gym.Environment(merge, render_mode="human")
    environment = laneweave.gym.Environment(merge, SOON)
    with pytest.raises(lw.LaneweaveError, match="choose 0 to 4"):
        environment.step(5)
    with pytest.raises(ValueError, match=r"they have the shape \(2,\); give \(1,\)"):
        environment.step(np.array([1, 1]))
    with pytest.raises(lw.ScenarioError, match='did you mean "grid"'):
        laneweave.gym.Environment(merge, {"observation": "gird"})
    assert "ahead_m" in laneweave.gym.Environment(merge, {"observation": "grid"}).worlds.task["observation"]["grid"]


def test_the_maps_are_what_the_command_generates(tmp_path: Path) -> None:
    folder = Path(laneweave.gym.__file__).parent / "maps"
    road = ("--speed-limit", "100")
    arguments = {
        "merge": ("--lanes", "2", "--length", "700", "--on-ramp-at", "300", *road),
        "lane_drop": ("--lanes", "3", "--length", "800", "--lane-drop-at", "500", *road),
    }
    assert {it.stem for it in folder.glob("*.osm")} == set(arguments)
    for name, given in arguments.items():
        made = tmp_path / f"{name}.osm"
        subprocess.run([sys.executable, "-m", "laneweave", "generate", "motorway", *given, made], check=True)
        assert made.read_bytes() == (folder / made.name).read_bytes()
