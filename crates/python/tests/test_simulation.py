"""A simulation steps, tells, takes commands, and is saved."""

import multiprocessing
import threading
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import laneweave as lw
import numpy as np
import pytest
from conftest import MAPS


def test_columns_are_those_of_the_vehicles(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=3000, seed=3)
    simulation.step(600)
    columns, vehicles = simulation.columns(poses=True), simulation.vehicles()
    assert len(vehicles) == len(simulation) > 20
    order = np.argsort(columns["vehicle"])
    for name, key in [("vehicle", "id"), ("speed_mps", "speed_mps"), ("x_m", "x_m")]:
        assert columns[name][order].tolist() == [it[key] for it in vehicles]
    lanelets = [simulation.lanelets[it] for it in columns["lanelet_index"][order]]
    assert lanelets == [it["lanelet"] for it in vehicles] and {type(it) for it in lanelets} == {str}
    assert simulation.columns().keys() < columns.keys()
    assert columns["position_m"].dtype == np.float64 and columns["vehicle"].dtype == np.uint32


def test_keys_are_those_of_a_scenario(ramps: Path) -> None:
    keys = {"demand": {"trucks": 0.25}, "styles": {"aggressive": 1.0}, "step_s": 0.2, "seed": 7}
    scenario = lw.Simulation(ramps, vehicles_per_hour=1200, **keys).scenario
    assert scenario["demand"]["trucks"] == 0.25 and scenario["demand"]["vehicles_per_hour"] == 1200
    assert scenario["styles"] == {"aggressive": 1.0}
    assert (scenario["run"]["step_s"], scenario["run"]["seed"]) == (0.2, 7)


def test_lights_change() -> None:
    simulation = lw.Simulation(MAPS / "grid.osm", vehicles_per_hour=100)
    before = simulation.lights
    seen = set(before.values())
    for _ in range(90):
        simulation.step(10)
        seen |= set(simulation.lights.values())
    assert before.keys() == simulation.lights.keys() and seen == {"green", "yellow", "red"}


def test_lane_changes_have_their_reasons(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=4000, seed=1)
    changes = [it for it in simulation.step(1200) if it["event"] == "lane_change"]
    assert changes and all(it["reasons"] for it in changes)
    vehicle = simulation.vehicles()[0]["id"]
    words, evaluation = simulation.explain(vehicle), simulation.evaluate(vehicle)
    assert words and words.startswith(f"vehicle {vehicle} (")
    assert evaluation and {"sides", "decision", "style"} <= evaluation.keys()
    assert simulation.explain(4_000_000) is None and simulation.evaluate(4_000_000) is None


def test_an_ego_is_driven_and_given_back(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=0, seed=1)
    with pytest.raises(TypeError, match="an id is a str"):
        simulation.insert(1.5, 30.0, 20.0)  # type: ignore[arg-type]
    ego = simulation.insert(int(simulation.lanelets[0]), 30.0, 20.0, style="conservative")
    simulation.control(ego, speed_mps=12.0, lateral="keep")
    simulation.run(10.0)
    driven = simulation.vehicle(ego)
    assert driven and driven["is_external"] and driven["speed_mps"] == pytest.approx(12.0)
    simulation.release(ego)
    simulation.run(20.0)
    free = simulation.vehicle(ego)
    assert free and not free["is_external"] and free["speed_mps"] > 20.0
    simulation.remove(ego)
    simulation.step()
    assert simulation.vehicle(ego) is None


def test_a_saved_state_goes_on_bit_for_bit(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=3000, seed=2)
    simulation.run(30.0)
    saved, branch = simulation.save(), simulation.branch()
    simulation.run(60.0)
    branch.run(60.0)
    assert branch.state_hash == simulation.state_hash
    simulation.restore(saved)
    assert simulation.time_s == pytest.approx(30.0)
    simulation.run(60.0)
    assert branch.state_hash == simulation.state_hash


def test_the_same_seed_gives_the_same_bits_however_it_is_made(merge: Path) -> None:
    alone = lw.Simulation(merge, vehicles_per_hour=2400, seed=5)
    template = lw.Template(merge, vehicles_per_hour=2400, seed=5)
    spawned, fleet = template.spawn(5), lw.Fleet(template, [4, 5, 6], threads=2)
    again = template.spawn(9)
    again.run(20.0)
    again.reset(5)
    for it in (alone, spawned, again):
        it.run(60.0)
    fleet.step(600)
    assert {alone.state_hash, spawned.state_hash, again.state_hash, fleet.state_hashes[1]} == {alone.state_hash}


def hash_in_a_process(map: Path, seed: int) -> int:
    simulation = lw.Simulation(map, vehicles_per_hour=2400, seed=seed, drivers_seed=1)
    simulation.run(30.0)
    return simulation.state_hash


def test_eight_simulations_in_threads_are_those_of_eight_processes(merge: Path) -> None:
    template = lw.Template(merge, vehicles_per_hour=2400)
    hashes: dict[int, int] = {}

    def drive(seed: int) -> None:
        simulation = template.spawn(seed)
        simulation.run(30.0)
        hashes[seed] = simulation.state_hash

    threads = [threading.Thread(target=drive, args=(it,)) for it in range(8)]
    for it in threads:
        it.start()
    for it in threads:
        it.join()
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn"), max_tasks_per_child=1) as processes:
        alone = list(processes.map(hash_in_a_process, [merge] * 8, range(8)))
    assert [hashes[it] for it in range(8)] == alone


def test_a_closed_simulation_and_one_in_use_are_refused(ramps: Path) -> None:
    with lw.Simulation(ramps, vehicles_per_hour=3000) as simulation:
        started = threading.Event()

        def drive() -> None:
            started.set()
            simulation.run(600.0)

        thread = threading.Thread(target=drive)
        thread.start()
        started.wait()
        with pytest.raises(lw.StateError, match="another thread is using it"):
            while thread.is_alive():
                simulation.columns()
        thread.join()
    with pytest.raises(lw.StateError, match="it is closed; make a new one"):
        simulation.step()
    assert "closed" in repr(simulation)
