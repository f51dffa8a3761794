"""Sweeps: many variants of a scenario, each with several seeds, on any executor."""

from __future__ import annotations

import html
import threading
from collections.abc import Iterator, Mapping
from concurrent import futures
from os import PathLike
from pathlib import Path
from typing import Any, Protocol

from . import _laneweave
from ._command import PROGRAM
from ._errors import StateError
from ._results import progress_bar, read_table


class Executor(Protocol):
    """Does runs of a sweep anywhere. Those of ``laneweave.executors`` are such."""

    def run(self, folder: Path, keys: list[str]) -> Iterator[int]:
        """Does all runs with these ``keys`` by ``laneweave.sweep_runs``, and yields how many have ended since."""
        ...


class Sweep:
    """A sweep of which all runs are done.

    Attributes:
        folder: The folder with all files.
        text: A few measures of each variant in words, if there are not too many variants.
    """

    def __init__(self, folder: Path, runs: Path, variants: Path, text: str) -> None:
        self.folder, self.text, self._runs, self._variants = folder, text, runs, variants

    def runs(self, library: str | None = None) -> Any:
        """A row for each run, as ``Results.table`` gives tables.

        Raises:
            ImportError: Nothing is installed that reads it.
        """
        return read_table(self._runs, library)

    def variants(self, library: str | None = None) -> Any:
        """A row for each variant: means over its seeds, with half the widths of their 95 % intervals.

        Raises:
            ImportError: Nothing is installed that reads it.
        """
        return read_table(self._variants, library)

    def __repr__(self) -> str:
        return self.text or f"<laneweave.Sweep in {self.folder}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"


_local = threading.local()


def sweep_runs(folder: str | PathLike[str], keys: list[str]) -> int:
    """Does runs of a sweep that was begun: what an executor calls, in any process that sees the folder.

    Each run leaves its row there. A run that is done is not done again.

    Args:
        folder: The folder of the sweep.
        keys: The keys of the runs.

    Returns:
        The number of the runs.

    Raises:
        NotFoundError: There is no such sweep, or no such run.
        StateError: A file on which the runs depend has changed since the sweep was begun.
    """
    whole = Path(folder).absolute()
    # What was made ready for a run serves the next one.
    if getattr(_local, "folder", None) != whole:
        _local.folder, _local.worker = whole, _laneweave.SweepWorker(whole)
    for key in keys:
        _local.worker.run(key)
    return len(keys)


def sweep(
    plan: str | PathLike[str] | Mapping[str, Any],
    out: str | PathLike[str],
    *,
    executor: Executor | futures.Executor | None = None,
    workers: int | None = None,
    shard: str | None = None,
    progress: bool = True,
) -> Sweep | None:
    """Runs many variants of a scenario, each with several seeds.

    A sweep that was ended goes on with the same call; no run is lost, and none is done twice.

    Args:
        plan: A plan (.toml), or its keys: ``{"scenario": "maps/ramps.osm", "seeds": 10, "grid": {"model": ["mcdm"]}}``.
            Relative paths begin in the folder of the file, or else in the current one.
        out: The folder of the sweep. All processes have to see it under this path.
        executor: Who does the runs: any ``concurrent.futures.Executor``, or one of ``laneweave.executors``; by default
            processes of this machine.
        workers: Number of these processes; by default the cores of the machine.
        shard: "1/3" for the first of three parts, so that programs that know nothing of each other share a sweep.
        progress: Whether a bar shows how far it is, if ``tqdm`` is installed.

    Returns:
        The sweep; ``None`` if runs of other parts are not done.

    Raises:
        LaneweaveError: The plan, a variant of it or the folder cannot be used. Nothing has run then.
        KeyboardInterrupt: Ctrl-C. The same call goes on.
    """
    if executor is not None and workers is not None:
        raise ValueError("workers: the executor has its own workers; leave it out")
    if executor is not None and not hasattr(executor, "submit") and not hasattr(executor, "run"):
        raise TypeError(f"executor: {executor!r} is neither a concurrent.futures.Executor nor of laneweave.executors")
    if not isinstance(plan, (str, PathLike, Mapping)):
        raise TypeError(f"plan: {plan!r} is neither a file nor a dict of its keys")
    if shard is not None and not isinstance(shard, str):
        raise TypeError(f'shard: {shard!r} is no text; write "1/3" for the first of three')
    begun = _laneweave.SweepFolder(dict(plan) if isinstance(plan, Mapping) else plan, out)
    keys = begun.open_keys(shard)
    folder = Path(out).absolute()
    with progress_bar(progress) as show:
        if executor is None:
            begun.run(keys, [*PROGRAM, "sweep", "--worker"], workers, show)
        else:
            ended = 0
            for more in _run_on(executor, folder, keys):
                ended += more
                if show is not None:
                    show(ended / len(keys))
    done = begun.finish()
    if done is not None:
        return Sweep(folder, *done)
    left = begun.open_keys(shard)
    if left:
        raise StateError(str(out), f"{len(left)} runs are not done, although the executor has ended", "sweep again")
    return None


def _run_on(executor: Executor | futures.Executor, folder: Path, keys: list[str]) -> Iterator[int]:
    if not isinstance(executor, futures.Executor):
        yield from executor.run(folder, keys)
        return
    tasks = [executor.submit(sweep_runs, folder, [key]) for key in keys]
    try:
        for task in futures.as_completed(tasks):
            yield task.result()
    finally:
        for task in tasks:
            task.cancel()
