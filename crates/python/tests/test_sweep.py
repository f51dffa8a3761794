"""Sweeps: the same table whoever does the runs, and whatever ends them."""

import io
import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent import futures
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest

import laneweave as lw
from laneweave.executors import HyperQueue, Ray

PLAN: dict[str, Any] = {
    "scenario": lw.example("on_ramp"),
    "seeds": 3,
    "grid": {"run": {"duration_s": [20]}, "model": ["mcdm", "mobil"], "demand.vehicles_per_hour": [1000, 2000]},
}


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The table of the plan, by processes of this machine."""
    folder = tmp_path_factory.mktemp("whole")
    done = lw.sweep(PLAN, folder, workers=2)
    assert done is not None and "model=mobil" in done.text
    pytest.importorskip("pandas")
    runs = done.runs()
    assert len(runs) == 12 and runs["key"].nunique() == 12
    assert len(done.variants()) == 4
    return (folder / "runs.parquet").read_bytes()


def test_executors_of_the_standard_library_do_the_same(table: bytes, tmp_path: Path) -> None:
    executors: list[futures.Executor] = [
        futures.ThreadPoolExecutor(2),
        futures.ProcessPoolExecutor(2, mp_context=get_context("spawn")),
    ]
    for number, executor in enumerate(executors):
        with executor:
            assert lw.sweep(PLAN, tmp_path / str(number), executor=executor) is not None
        assert (tmp_path / str(number) / "runs.parquet").read_bytes() == table


def test_a_pool_whose_process_is_killed_loses_nothing(table: bytes, tmp_path: Path) -> None:
    class Killed:
        """Does some of the runs, and breaks."""

        def run(self, folder: Path, keys: list[str]) -> Iterator[int]:
            yield lw.sweep_runs(folder, keys[:5])
            raise futures.BrokenExecutor

    with pytest.raises(futures.BrokenExecutor):
        lw.sweep(PLAN, tmp_path, executor=Killed())
    assert len(list((tmp_path / "rows").iterdir())) == 5
    assert lw.sweep(PLAN, tmp_path) is not None
    assert (tmp_path / "runs.parquet").read_bytes() == table


def test_parts_share_a_folder(table: bytes, tmp_path: Path) -> None:
    assert lw.sweep(PLAN, tmp_path, shard="1/2") is None
    done = lw.sweep(PLAN, tmp_path, shard="2/2")
    assert done is not None and (tmp_path / "runs.parquet").read_bytes() == table


def test_the_command_of_the_package_does_the_same(table: bytes, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    plan = tmp_path / "plan.toml"
    plan.write_text(
        f'scenario = "{lw.example("on_ramp").as_posix()}"\nseeds = 3\n[grid]\nrun.duration_s = [20]\n'
        'model = ["mcdm", "mobil"]\ndemand.vehicles_per_hour = [1000, 2000]\n',
        encoding="utf-8",
    )
    command = [sys.executable, "-m", "laneweave", "sweep", os.fspath(plan), "--quiet"]
    subprocess.run(command, check=True, cwd=tmp_path, timeout=120)
    runs, whole = (pandas.read_parquet(it) for it in (tmp_path / "sweep/runs.parquet", io.BytesIO(table)))
    assert runs.equals(whole)


def test_wrong_plans_are_refused_before_anything_runs(tmp_path: Path) -> None:
    cases: list[tuple[Any, type[Exception], str]] = [
        ({**PLAN, "grid": {"model": ["mobbil"]}}, lw.ScenarioError, "did you mean \"mobil\""),
        ({**PLAN, "grid": {"model": []}}, lw.ScenarioError, r"^plan: model = \[\]: this key of the grid has no values"),
        ({**PLAN, "sedes": 3}, lw.ScenarioError, "did you mean \"seeds\""),
        ({**PLAN, "seeds": None}, lw.ScenarioError, "plan: "),
        ({"scenario": "nothing.osm"}, lw.NotFoundError, "nothing.osm"),
        ("nothing.toml", lw.NotFoundError, "nothing.toml"),
        (7, TypeError, "plan"),
    ]
    for plan, kind, words in cases:
        with pytest.raises(kind, match=words):
            lw.sweep(plan, tmp_path / "out")
        assert not (tmp_path / "out").exists()
    with pytest.raises(lw.ScenarioError, match="workers"):
        lw.sweep(PLAN, tmp_path / "out", workers=0)
    with pytest.raises(lw.ScenarioError, match="shard"):
        lw.sweep(PLAN, tmp_path / "out", shard="3/2")
    with pytest.raises(TypeError, match='write "1/3"'):
        lw.sweep(PLAN, tmp_path / "out", shard=(1, 3))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="workers"):
        lw.sweep(PLAN, tmp_path / "out", workers=1, executor=futures.ThreadPoolExecutor(1))
    with pytest.raises(TypeError, match="executor"):
        lw.sweep(PLAN, tmp_path / "out", executor=4)  # type: ignore[arg-type]
    with pytest.raises(lw.StateError, match="another plan"):
        lw.sweep({**PLAN, "seeds": 4}, tmp_path / "out")
    with pytest.raises(lw.NotFoundError, match="no sweep"):
        lw.sweep_runs(tmp_path, ["0"])
    with pytest.raises(lw.NotFoundError, match="no run"):
        lw.sweep_runs(tmp_path / "out", ["0"])


def test_ray_does_the_same(table: bytes, tmp_path: Path) -> None:
    ray = pytest.importorskip("ray")
    ray.init(num_cpus=2, include_dashboard=False)
    try:
        assert lw.sweep(PLAN, tmp_path, executor=Ray(runs_per_task=2)) is not None
    finally:
        ray.shutdown()
    assert (tmp_path / "runs.parquet").read_bytes() == table


def test_hyperqueue_does_the_same(table: bytes, tmp_path: Path) -> None:
    cluster = pytest.importorskip("hyperqueue.cluster")
    function = pytest.importorskip("hyperqueue.task.function")
    with cluster.LocalCluster(os.fspath(tmp_path / "server"), cluster.WorkerConfig(cores=2)) as local:
        client = local.client(python_env=function.PythonEnv(sys.executable))
        assert lw.sweep(PLAN, tmp_path / "out", executor=HyperQueue(client, runs_per_task=5)) is not None
    assert (tmp_path / "out/runs.parquet").read_bytes() == table
