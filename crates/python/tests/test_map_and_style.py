"""Maps and styles are read, edited, refused and used."""

from pathlib import Path

import laneweave as lw
import pytest


def test_a_map_tells_what_it_has(ramps: Path) -> None:
    road = lw.Map(ramps)
    first = road.lanelets[0]
    lines = road.lines(first)
    assert set(lines) == {"left", "right", "centre"}
    assert all(it.ndim == 2 and it.shape[1] == 3 for it in lines.values())
    graph = road.graph()
    assert set(graph) == set(road.lanelets) and graph[first]["length_m"] > 10
    assert road.check()["problems"] == [] and road.svg().startswith("<svg")
    following = next(it for it in road.lanelets if graph[it]["following"])
    routes = road.routes(following, graph[following]["following"][0])
    assert routes[0]["lanelets"][0]["id"] == following
    assert "lanelets" in repr(road)


def test_maps_come_with_the_package() -> None:
    assert lw.Map(lw.example("on_ramp")).lanelets
    with pytest.raises(lw.NotFoundError, match='did you mean "ramps"'):
        lw.example("rams")
    with pytest.raises(lw.NotFoundError, match="choose one of all_way_stop"):
        lw.example("zzz")


def test_a_map_is_used_as_it_was_read(ramps: Path) -> None:
    road = lw.Map(ramps, origin=(49.0, 8.0), law="usa")
    assert road.options["law"] == "usa"
    simulation = lw.Simulation(road, vehicles_per_hour=1000)
    assert simulation.scenario["map_options"]["law"] == "usa" and simulation.lanelets == road.lanelets


def test_what_a_map_lacks_is_refused(ramps: Path) -> None:
    with pytest.raises(lw.NotFoundError, match="no lanelet 7777"):
        lw.Map(ramps).lines(7777)
    with pytest.raises(lw.ScenarioError, match='did you mean "origin"'):
        lw.Map(ramps, orign=(1.0, 2.0))
    with pytest.raises(lw.LaneweaveError, match="no lanelet"):
        lw.Map(ramps).routes(7777, 7778)
    with pytest.raises(TypeError, match="Map"):
        lw.Simulation(3)  # type: ignore[arg-type]  # pyright: ignore


def test_a_style_is_edited_saved_and_driven(ramps: Path, tmp_path: Path) -> None:
    mine = lw.Style("mine", base="aggressive")
    assert mine.name == "mine" and mine["change.speed.weight"] == 1.26 and "change.sped" not in mine
    mine["change.speed.weight"] = 0.0
    mine["speed_factor"] = {"distribution": "uniform", "low": 0.9, "high": 1.1}
    path = mine.save(tmp_path / "mine.toml")
    assert lw.Style.read(path).values == mine.values
    keys = {"vehicles_per_hour": 2000, "seed": 4}
    given, of_file, other = (
        lw.Simulation(ramps, styles={it: 1}, **keys) for it in (mine, str(path), "aggressive")
    )
    for it in (given, of_file, other):
        it.run(60.0)
    assert given.state_hash == of_file.state_hash != other.state_hash
    assert given.styles == [("mine", 1.0)]


def test_a_run_keeps_the_style_that_it_was_given(ramps: Path, tmp_path: Path) -> None:
    mine = lw.Style("mine")
    results = lw.run(ramps, tmp_path, styles={mine: 1}, vehicles_per_hour=1000, duration_s=10, progress=False)
    assert "mine" in (results.folder / "scenario.toml").read_text()


def test_two_styles_have_two_names(ramps: Path, tmp_path: Path) -> None:
    with pytest.raises(lw.StyleError, match="two styles have this name"):
        lw.Simulation(ramps, styles={lw.Style("mine"): 1, lw.Style("mine", base="aggressive"): 1})
    path = lw.Style("mine").save(tmp_path / "mine.toml")
    assert lw.Simulation(ramps, styles={path: 1}).styles == [("mine", 1.0)]


def test_wrong_styles_are_refused(tmp_path: Path) -> None:
    with pytest.raises(lw.StyleError, match="name: .*built-in style"):
        lw.Style("aggressive")
    with pytest.raises(lw.StyleError, match='did you mean "aggressive"'):
        lw.Style("mine", base="agressive")
    mine = lw.Style("mine")
    mine["change.speed.wieght"] = 2
    with pytest.raises(lw.StyleError, match="wieght"):
        mine.save(tmp_path / "mine.toml")
    assert not (tmp_path / "mine.toml").exists()
    with pytest.raises(KeyError):
        mine["chnge.speed.weight"]
