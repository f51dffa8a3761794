"""A run with all its result files, and what is in them."""

from __future__ import annotations

import html
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from . import _laneweave
from ._laneweave import Map


class Results:
    """The results of a run: its summary, its tables and its report.

    Attributes:
        folder: The folder with all files.
        summary: The summary, with the names and units of ``summary.json``.
        files: The names of all files.
        warnings: What did not happen as the scenario asks, in a line each.
    """

    def __init__(self, folder: Path, summary: dict[str, Any], files: list[Path], warnings: list[str]) -> None:
        self.folder, self.summary, self.files, self.warnings = folder, summary, files, warnings

    @property
    def report(self) -> Path:
        """The report, a page for any browser."""
        return self.folder / "report.html"

    @property
    def tables(self) -> list[str]:
        """The names of all tables."""
        return sorted(it.stem for it in self.folder.iterdir() if it.suffix in (".parquet", ".csv"))

    def table(self, name: str, library: str | None = None) -> Any:
        """A table as a pandas data frame, or as one of polars or an Arrow table if pandas is not there.

        Args:
            name: Its name, such as ``"trajectories"``, ``"trips"`` or ``"lane_changes"``.
            library: What reads it: ``"pandas"``, ``"polars"`` or ``"pyarrow"``; by default the first that is there.

        Raises:
            KeyError: There is no such table.
            ImportError: Nothing is installed that reads it.
        """
        paths = [self.folder / f"{name}{end}" for end in (".parquet", ".csv")]
        path = next((it for it in paths if it.exists()), None)
        if path is None:
            raise KeyError(f"there is no table {name!r}; choose one of {', '.join(self.tables)}")
        return read_table(path, library)

    def __repr__(self) -> str:
        return f"<laneweave.Results in {self.folder}>"

    def _repr_html_(self) -> str:
        plain = {key: it for key, it in self.summary.items() if isinstance(it, (int, float, str))}
        rows = "".join(f"<tr><th>{html.escape(key)}</th><td>{html.escape(str(it))}</td></tr>" for key, it in plain.items())
        figures = "".join(it.read_text(encoding="utf-8") for it in sorted(self.folder.glob("*.svg")))
        return f"<table>{rows}</table>{figures}"


def read_table(path: Path, library: str | None = None) -> Any:
    """A table as a data frame of ``library``, or of the first that is there: pandas, polars, pyarrow."""
    readers = {"pandas": _by_pandas, "polars": _by_polars, "pyarrow": _by_arrow}
    if library is not None:
        if library not in readers:
            raise ValueError(f"there is no library {library!r}; choose one of {', '.join(readers)}")
        return readers[library](path)
    for read in readers.values():
        try:
            return read(path)
        except ImportError:
            continue
    raise ImportError(f"nothing here reads {path.name}; install pandas with pyarrow, polars, or pyarrow")


def _by_pandas(path: Path) -> Any:
    import pandas

    if path.suffix == ".parquet":
        return pandas.read_parquet(path)
    # The model "null" is a name.
    return pandas.read_csv(path, keep_default_na=False, na_values=[""])


def _by_polars(path: Path) -> Any:
    import polars  # pyright: ignore

    return polars.read_parquet(path) if path.suffix == ".parquet" else polars.read_csv(path)


def _by_arrow(path: Path) -> Any:
    from pyarrow import csv, parquet

    return parquet.read_table(path) if path.suffix == ".parquet" else csv.read_csv(path)


def run(
    source: str | PathLike[str] | Map,
    out: str | PathLike[str] | None = None,
    *,
    progress: bool = True,
    **keys: Any,
) -> Results:
    """Runs a scenario, or a bare map, to its end, and writes all result files.

    Args:
        source: A scenario (.toml) or a map.
        out: The folder of the results; a new temporary one if it is left out.
        progress: Whether a bar shows how far it is, if ``tqdm`` is installed.
        keys: Keys of a scenario file, in place of those of ``source``.

    Raises:
        LaneweaveError: The file, its map or a style cannot be used, or a key is wrong. Nothing is written then.
        KeyboardInterrupt: Ctrl-C.
    """
    with results_folder(out) as folder, progress_bar(progress) as show:
        summary, files, warnings = _laneweave.run(source, folder, show, **keys)
    return Results(folder, summary, files, warnings)


@contextmanager
def results_folder(out: str | PathLike[str] | None) -> Iterator[Path]:
    """The folder ``out``; a new temporary one if it is left out, which goes if nothing is written into it."""
    if out is not None:
        yield Path(out)
        return
    folder = Path(tempfile.mkdtemp(prefix="laneweave-"))
    try:
        yield folder
    finally:
        if not any(folder.iterdir()):
            folder.rmdir()


def map_file(
    map: str | PathLike[str] | Map | None, options: dict[str, Any] | None
) -> tuple[str | None, dict[str, Any]]:
    """The file of a map, and how it is read: as a ``Map`` was, unless ``options`` say it otherwise."""
    if isinstance(map, Map):
        return fspath(map.path), {**map.options, **(options or {})}
    return None if map is None else fspath(map), options or {}


@contextmanager
def progress_bar(is_wanted: bool) -> Iterator[Callable[[float], object] | None]:
    """What shows the share that is done, from 0 to 1, in a bar; nothing if it is not wanted, or ``tqdm`` is not there."""
    bar = _bar() if is_wanted else None
    if bar is None:
        yield None
        return
    with bar:
        yield lambda share: bar.update(share - bar.n)


def _bar() -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    return tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}", leave=False)
