"""A run leaves its files, and a wrong word leaves nothing."""

import pickle
import signal
import tempfile
import threading
from pathlib import Path
from typing import Any

import laneweave as lw
import numpy as np
import pytest


def test_a_run_has_a_summary_tables_and_a_report(ramps: Path, tmp_path: Path) -> None:
    results = lw.run(ramps, tmp_path / "out", vehicles_per_hour=2000, duration_s=30, progress=False)
    assert results.summary["entered"] > 5 and results.report.exists()
    assert {"trajectories", "trips", "lane_changes"} <= set(results.tables)
    assert "<svg" in results._repr_html_() and "out" in repr(results)
    with pytest.raises(KeyError, match="choose one of commands, incidents"):
        results.table("trip")
    pytest.importorskip("pyarrow")
    assert len(results.table("trips")) == results.table("trips", "pyarrow").num_rows == results.summary["entered"]
    with pytest.raises(ValueError, match="choose one of pandas, polars, pyarrow"):
        results.table("trips", "panda")


ENDLESS: list[Any] = []
ENDLESS.append(ENDLESS)


def test_keys_are_numbers_of_numpy_and_paths_too(ramps: Path, tmp_path: Path) -> None:
    keys = {"vehicles_per_hour": np.float32(1000), "seed": np.int64(3), "map_options": {"origin": np.array([49.0, 8.0])}}
    scenario = lw.Simulation(ramps, **keys).scenario
    assert (scenario["run"]["seed"], scenario["map_options"]["origin"]) == (3, (49.0, 8.0))
    (tmp_path / "own.toml").write_text(f'map = "{ramps}"\n[demand]\ntrucks = 0.1\n')
    with pytest.raises(lw.ScenarioError, match="^trucks: "):
        lw.Simulation(tmp_path / "own.toml", trucks=3)


def test_a_refused_run_leaves_no_folder(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(lw.NotFoundError):
        lw.run("nowhere.osm")
    assert list(tmp_path.iterdir()) == []


def test_a_run_ends_as_a_simulation_does(ramps: Path, tmp_path: Path) -> None:
    keys = {"vehicles_per_hour": 2000, "duration_s": 20, "seed": 6}
    results = lw.run(ramps, tmp_path / "out", progress=False, **keys)
    simulation = lw.Simulation(ramps, **keys)
    simulation.run(simulation.end_s)
    assert results.summary["state_hash"] == f"{simulation.state_hash:016x}"


@pytest.mark.parametrize(
    ("keys", "kind", "words"),
    [
        ({"vehicles_per_hou": 3}, lw.ScenarioError, 'unknown key "vehicles_per_hou"; did you mean "vehicles_per_hour"'),
        ({"demand": {"trucks": 3}}, lw.ScenarioError, "choose 0 to 1"),
        ({"demand": {"truks": 0.3}}, lw.ScenarioError, 'did you mean "trucks"'),
        ({"styles": {"agressive": 1}}, lw.StyleError, 'did you mean "aggressive"'),
        ({"seed": "one"}, lw.ScenarioError, "a whole number is expected"),
        ({"seed": object()}, TypeError, "seed: the type object"),
        ({"seed": ENDLESS}, TypeError, "seed: it is too deep"),
        ({"vehicles_per_hour": float("nan")}, TypeError, "vehicles_per_hour: it is no finite number"),
        ({"output": {"dir": "elsewhere"}}, lw.ScenarioError, "give it as out="),
        ({"trucks": 3}, lw.ScenarioError, "trucks: a share"),
    ],
)
def test_wrong_keys_are_refused(
    ramps: Path, tmp_path: Path, keys: dict[str, Any], kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind, match=words):
        lw.run(ramps, tmp_path / "out", **keys)
    assert not (tmp_path / "out").exists()


def test_exceptions_say_where_what_and_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(lw.NotFoundError) as caught:
        lw.Simulation(tmp_path / "nowhere.osm")
    error = caught.value
    assert error.place.endswith("nowhere.osm") and error.what and error.remedy == "check the path"
    assert isinstance(error, lw.LaneweaveError)
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    (tmp_path / "bad.osm").write_text("<osm></osm>")
    with pytest.raises(lw.LaneweaveError):
        lw.Simulation(tmp_path / "bad.osm")


def test_ctrl_c_ends_a_long_call(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=3000)
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.run(1e6)
    assert 0 < simulation.time_s < 1e6
    simulation.step()
