"""A run leaves its files, and a wrong word leaves nothing."""

import pickle
import signal
import threading
from pathlib import Path
from typing import Any

import laneweave as lw
import pytest


def test_a_run_has_a_summary_tables_and_a_report(ramps: Path, tmp_path: Path) -> None:
    results = lw.run(ramps, tmp_path / "out", vehicles_per_hour=2000, duration_s=30, progress=False)
    assert results.summary["entered"] > 5 and results.report.exists()
    assert {"trajectories", "trips", "lane_changes"} <= set(results.tables)
    assert "<svg" in results._repr_html_() and "out" in repr(results)
    with pytest.raises(KeyError, match="choose one of commands, incidents"):
        results.table("trip")
    pytest.importorskip("pyarrow")
    assert len(results.table("trips")) == results.summary["entered"]


@pytest.mark.parametrize(
    ("keys", "kind", "words"),
    [
        ({"vehicles_per_hou": 3}, lw.ScenarioError, 'unknown key "vehicles_per_hou"; did you mean "vehicles_per_hour"'),
        ({"demand": {"trucks": 3}}, lw.ScenarioError, "choose 0 to 1"),
        ({"demand": {"truks": 0.3}}, lw.ScenarioError, 'did you mean "trucks"'),
        ({"styles": {"agressive": 1}}, lw.StyleError, 'did you mean "aggressive"'),
        ({"seed": "one"}, lw.ScenarioError, "invalid type"),
        ({"seed": object()}, TypeError, "object"),
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
