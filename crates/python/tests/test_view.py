"""The page is served, shows what it is given, and ends."""

import urllib.error
import urllib.request
from pathlib import Path
from typing import Any

import laneweave as lw
import pytest


def fetched(url: str) -> str:
    with urllib.request.urlopen(url, timeout=10) as answer:
        return str(answer.read().decode())


def test_a_simulation_is_shown_and_stays_as_it_is(ramps: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=2000)
    simulation.run(20.0)
    before = simulation.state_hash
    with lw.view(simulation, browser=False) as view:
        assert "<html" in fetched(view.url)
        assert '"lanelets"' in fetched(view.url.replace("/?", "/scene.json?"))
        assert "iframe" in view._repr_html_() and "token" not in repr(view)
        with pytest.raises(urllib.error.HTTPError):
            fetched(view.url.partition("?")[0] + "scene.json")
    assert simulation.state_hash == before and "closed" in repr(view) and bool(lw.Simulation(ramps))
    with pytest.raises(urllib.error.URLError):
        fetched(view.url)


def test_maps_and_results_are_shown(ramps: Path, tmp_path: Path) -> None:
    results = lw.run(ramps, tmp_path, vehicles_per_hour=1000, duration_s=10, progress=False)
    for shown in (ramps, str(ramps), lw.Map(ramps), results, results.folder):
        with lw.view(shown, browser=False) as view:
            assert "<html" in fetched(view.url)
    with pytest.raises(lw.LaneweaveError, match="one thing is shown"):
        lw.view([ramps, ramps], browser=False)
    with pytest.raises(lw.LaneweaveError, match="no results of a run"):
        lw.view(ramps.parent, browser=False)


def test_what_has_no_meaning_for_what_is_shown_is_refused(ramps: Path, tmp_path: Path) -> None:
    simulation = lw.Simulation(ramps)
    wrong: list[tuple[Any, dict[str, Any]]] = [
        (simulation, {"map": ramps}), (simulation, {"map_options": {}}), (ramps, {"columns": "a.toml"}), ([], {}),
        (ramps, {"brower": False}),
    ]  # fmt: skip
    for shown, keys in wrong:
        with pytest.raises(TypeError):
            lw.view(shown, **{"browser": False, **keys})
    results = lw.run(ramps, tmp_path, vehicles_per_hour=1000, duration_s=10, progress=False)
    with pytest.raises(lw.LaneweaveError, match="leave the options of the map out"):
        lw.view(results, map_options={"law": "usa"}, browser=False)
    with pytest.raises(lw.LaneweaveError, match="name it with map="):
        lw.view(tmp_path / "tracks.csv", browser=False)


def test_a_picture_is_one_of_now(ramps: Path, tmp_path: Path) -> None:
    simulation = lw.Simulation(ramps, vehicles_per_hour=2000)
    empty = lw.picture(simulation, size=(320, 200))
    simulation.run(60.0)
    after = lw.picture(simulation, size=(320, 200))
    assert empty.startswith(b"\x89PNG") and after != empty == lw.picture(lw.Simulation(ramps), size=(320, 200))
    vehicle = simulation.vehicles()[0]["id"]
    assert lw.picture(simulation, camera=vehicle, size=(320, 200)) != after
    assert lw.picture(simulation, (0.0, 0.0, 100.0), (64, 64)).save(tmp_path / "a.png").stat().st_size > 100
    with pytest.raises(lw.NotFoundError, match="vehicle 99999 is not on the road"):
        lw.picture(simulation, camera=99999)
    with pytest.raises(lw.LaneweaveError, match="width of 1 to"):
        lw.picture(simulation, camera=(0.0, 0.0, float("nan")))
    with pytest.raises(lw.LaneweaveError, match="16384"):
        lw.picture(simulation, size=(0, 10))
