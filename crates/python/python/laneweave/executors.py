"""Executors of sweeps for Ray and HyperQueue: ``laneweave.sweep(plan, out, executor=Ray())``.

Any ``concurrent.futures.Executor`` needs nothing of this: ``laneweave.sweep(plan, out, executor=ProcessPoolExecutor())``.
All of them have to see the folder of the sweep, the maps and the styles under the same paths.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ._sweep import sweep_runs

__all__ = ["HyperQueue", "Ray"]

ATTEMPTS = 5
"""How often HyperQueue is asked to do a run whose process ends."""


def _parts(keys: list[str], size: int) -> list[list[str]]:
    if size < 1:
        raise ValueError("runs_per_task: a task does at least 1 run")
    return [keys[at : at + size] for at in range(0, len(keys), size)]


class Ray:
    """Runs of a sweep as tasks of Ray, on the cluster to which ``ray.init`` has connected, else on this machine.

    A task whose node is lost begins again elsewhere.

    Args:
        runs_per_task: Runs that a task does, one after the other. A task takes a millisecond or so to begin.
        options: Options of ``ray.remote``, such as ``num_cpus``, ``memory`` or ``scheduling_strategy``.
    """

    def __init__(self, *, runs_per_task: int = 1, **options: Any) -> None:
        self._size, self._options = runs_per_task, {"num_cpus": 1, "max_retries": -1, **options}

    def run(self, folder: Path, keys: list[str]) -> Iterator[int]:
        """Does all runs, and yields how many have ended since."""
        import ray  # pyright: ignore

        task = ray.remote(**self._options)(sweep_runs)
        left = [task.remote(folder, part) for part in _parts(keys, self._size)]
        try:
            while left:
                ended, left = ray.wait(left)
                yield sum(ray.get(ended))
        finally:
            for it in left:
                ray.cancel(it)


class HyperQueue:
    """Runs of a sweep as tasks of HyperQueue.

    A task whose worker is lost begins again elsewhere, and one whose process ends is tried again. HyperQueue shows its
    own progress.

    Args:
        client: A ``hyperqueue.Client``, whose tasks have to find this package; by default one of the server that runs
            for this user, whose tasks run by this interpreter.
        runs_per_task: Runs that a task does, one after the other. A task is a process, which reads the map once.
        options: Options of ``hyperqueue.Job.function``, such as ``resources`` or ``crash_limit``.
    """

    def __init__(self, client: Any = None, *, runs_per_task: int = 10, **options: Any) -> None:
        self._client, self._size, self._options = client, runs_per_task, options

    def run(self, folder: Path, keys: list[str]) -> Iterator[int]:
        """Does all runs, and yields their number at the end."""
        from hyperqueue import Client, Job  # pyright: ignore
        from hyperqueue.task.function import PythonEnv  # pyright: ignore

        client = self._client or Client(python_env=PythonEnv(sys.executable))
        parts = _parts(keys, self._size)
        for attempt in range(1, ATTEMPTS + 1):
            if not parts:
                break
            job = Job(name="laneweave sweep", default_workdir=folder, max_fails=None)
            for part in parts:
                job.function(sweep_runs, args=(str(folder), part), stdout=None, stderr=None, **self._options)
            submitted = client.submit(job)
            # The last attempt raises what went wrong.
            if client.wait_for_jobs([submitted], raise_on_error=attempt == ATTEMPTS):
                break
            parts = [parts[task] for task in client.get_failed_tasks(submitted)]
        yield len(keys)
