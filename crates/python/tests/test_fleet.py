"""Many simulations are stepped together, in arrays of the caller."""

from pathlib import Path
from typing import Any

import laneweave as lw
import numpy as np
import numpy.typing as npt
import pytest

SIZE, NEAREST = 6, 4


@pytest.fixture
def fleet(merge: Path) -> lw.Fleet:
    fleet = lw.Fleet(lw.Template(merge, vehicles_per_hour=2400), range(SIZE), threads=2)
    fleet.step(400)
    return fleet


def columns(rows: int) -> tuple[npt.NDArray[Any], ...]:
    kinds = (np.uint32, np.uint32, np.float64, np.float64, np.float32)
    return tuple(np.zeros(rows, kind) for kind in kinds)


def egos(fleet: lw.Fleet) -> npt.NDArray[np.uint32]:
    """The first vehicle of each simulation."""
    counts, (vehicle, *others) = np.zeros(SIZE, np.uint32), columns(500)
    fleet.columns(counts, vehicle, *others)
    first: npt.NDArray[np.uint32] = vehicle[np.cumsum(counts) - counts]
    return first


def test_columns_are_filled_one_simulation_after_the_other(fleet: lw.Fleet) -> None:
    counts, arrays = np.zeros(SIZE, np.uint32), columns(500)
    total = fleet.columns(counts, *arrays)
    assert arrays[1][:total].max() < len(fleet.lanelets)
    assert total == counts.sum() > SIZE
    assert (arrays[3][:total] > 0).any() and not arrays[3][total:].any()
    with pytest.raises(lw.ScenarioError, match=f"give each column {total} rows or more"):
        fleet.columns(counts, *columns(total - 1))


def test_sight_is_in_the_frame_of_the_lane(fleet: lw.Fleet) -> None:
    sight = np.full((SIZE, 1 + NEAREST, len(lw.SIGHT_COLUMNS)), np.nan, np.float32)
    fleet.sight(egos(fleet), sight)
    assert (sight[:, 0, 0] == 1).all() and np.abs(sight[:, 0, 1]).max() < 1e-3
    distance = np.hypot(sight[:, 1:, 1], sight[:, 1:, 2])
    is_there = sight[:, 1:, 0] == 1
    assert (np.diff(np.where(is_there, distance, np.inf), axis=1)[is_there[:, 1:]] >= 0).all()
    with pytest.raises(lw.ScenarioError, match=r"give it \(6, 1 \+ nearest, 7\)"):
        fleet.sight(egos(fleet), np.zeros((SIZE, 3, 2), np.float32))


def test_vehicles_are_driven_by_batch(fleet: lw.Fleet) -> None:
    vehicles = egos(fleet)
    fleet.control(vehicles, np.full(SIZE, 8.0), lateral="keep")
    fleet.step(40)
    sight = np.zeros((SIZE, 1, len(lw.SIGHT_COLUMNS)), np.float32)
    fleet.sight(vehicles, sight)
    there = sight[:, 0, 0] == 1
    assert there.any() and np.allclose(sight[there, 0, 3], 8.0, atol=0.1)
    with pytest.raises(lw.ScenarioError, match="vehicles has 2 places; give it 6"):
        fleet.control(vehicles[:2], np.zeros(2))
    fleet.reset(0, 77)
    fleet.step()


def test_a_fleet_begins_where_a_simulation_is(merge: Path) -> None:
    simulation = lw.Simulation(merge, vehicles_per_hour=2400, seed=3)
    simulation.run(40)
    template = simulation.template()
    fleet = lw.Fleet(template, [3, 4])
    assert fleet.state_hashes == [simulation.state_hash] * 2
    fleet.step(100)
    simulation.step(100)
    assert fleet.state_hashes[0] == simulation.state_hash != fleet.state_hashes[1]
    fleet.reset(1, 3)
    fleet.step(100)
    assert fleet.state_hashes[1] == simulation.state_hash
