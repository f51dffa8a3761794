"""Comparisons, fits, replays and the command leave what they say."""

import signal
import subprocess
import sys
import threading
from pathlib import Path

import laneweave as lw
import pytest


def test_models_are_compared(ramps: Path, tmp_path: Path) -> None:
    keys = {"vehicles_per_hour": 2000, "duration_s": 30}
    done = lw.compare(ramps, tmp_path, models=["mcdm", "null"], seeds=2, progress=False, **keys)
    assert "2 seeds" in repr(done) and done.report.exists()
    pytest.importorskip("pandas")
    runs = done.runs()
    assert list(runs["model"]) == ["mcdm", "mcdm", "null", "null"] and list(runs["seed"]) == [1, 2, 1, 2]


def test_wrong_studies_are_refused(ramps: Path, tmp_path: Path) -> None:
    with pytest.raises(lw.CommandError, match='did you mean "mobil"'):
        lw.compare(ramps, tmp_path / "out", models=["mobl"])
    with pytest.raises(lw.ScenarioError, match="nothing to compare"):
        lw.compare([], tmp_path / "out")
    with pytest.raises(lw.LaneweaveError, match="choose 0 to 10 s"):
        lw.fit(tmp_path / "tracks.csv", ramps, tmp_path / "out", lead_s=11.0)
    with pytest.raises(lw.LaneweaveError, match="classes: 0 is out of range"):
        lw.fit(tmp_path / "tracks.csv", ramps, classes=0)
    with pytest.raises(lw.LaneweaveError, match="recordings: there is none"):
        lw.fit([], ramps)
    with pytest.raises(lw.NotFoundError):
        lw.fit(tmp_path / "tracks.csv", ramps, tmp_path / "out")
    with pytest.raises(lw.LaneweaveError, match="needs the map"):
        lw.replay(tmp_path / "tracks.csv")
    assert not (tmp_path / "out").exists()


def test_ctrl_c_ends_a_comparison(ramps: Path, tmp_path: Path) -> None:
    threading.Timer(0.5, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        lw.compare(ramps, tmp_path, vehicles_per_hour=2000, duration_s=30, seeds=1000, progress=False)
    lw.compare(ramps, tmp_path, models="mcdm", duration_s=5, seeds=1, progress=False)


def test_ctrl_c_ends_a_study(ramps: Path, tmp_path: Path) -> None:
    threading.Timer(0.5, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        lw.run(ramps, tmp_path, vehicles_per_hour=3000, duration_s=1e5, progress=False)


def test_the_command_is_in_the_package(ramps: Path, tmp_path: Path) -> None:
    def laneweave(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-m", "laneweave", *arguments], capture_output=True, text=True, cwd=tmp_path)

    version = laneweave("--version")
    assert version.returncode == 0 and version.stdout == f"laneweave {lw.__version__}\n"
    run = laneweave("run", str(ramps), "--duration", "5", "--demand", "1000", "--out", "out")
    assert run.returncode == 0 and (tmp_path / "out/report.html").exists()
    assert f"laneweave run {ramps} --duration 5" in (tmp_path / "out/report.html").read_text()
    wrong = laneweave("run", "nowhere.osm")
    assert wrong.returncode == 2 and "nowhere.osm" in wrong.stderr
    assert laneweave("rnu").returncode == 2
