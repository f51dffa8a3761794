"""Studies: models compared, styles fitted, recordings replayed."""

from __future__ import annotations

import html
from collections.abc import Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any, TypeAlias

from . import _laneweave
from ._laneweave import Map
from ._results import Results, map_file, progress_bar, read_table, results_folder
from ._style import Style

File: TypeAlias = str | PathLike[str]


class Comparison:
    """Lane-change models compared on the same traffic.

    Attributes:
        report: The report, a page for any browser.
        text: The means of all measures with their 95 % intervals.
    """

    def __init__(self, text: str, report: Path, runs: Path) -> None:
        self.text, self.report, self._runs = text, report, runs

    def runs(self, library: str | None = None) -> Any:
        """A row for each run, as ``Results.table`` gives tables.

        Raises:
            ImportError: Nothing is installed that reads it.
        """
        return read_table(self._runs, library)

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"


def compare(
    sources: File | Map | Sequence[File | Map],
    out: File | None = None,
    *,
    models: str | Sequence[str] | None = None,
    seeds: int = 10,
    progress: bool = True,
    **keys: Any,
) -> Comparison:
    """Runs scenarios with several lane-change models and seeds, and compares the results.

    Args:
        sources: Scenarios (.toml) or maps, one or several.
        out: The folder of the report and of the table of all runs; a new temporary one if it is left out.
        models: Lane-change models; by default "mcdm", "mobil", "lmrs", "null" and "constant-hazard".
        seeds: Number of seeds for each model; the first is the seed of the scenario.
        progress: Whether a bar shows how far it is, if ``tqdm`` is installed.
        keys: Keys of a scenario file, in place of those of the sources.

    Raises:
        LaneweaveError: A file or a key cannot be used.
        KeyboardInterrupt: Ctrl-C. It ends after the runs that have begun.
    """
    all_sources: list[File | Map] = [sources] if isinstance(sources, (str, PathLike, Map)) else list(sources)
    with results_folder(out) as folder, progress_bar(progress) as show:
        text, (report, runs) = _laneweave.compare_models(all_sources, folder, _names(models), seeds, show, **keys)
    return Comparison(text, report, runs)


class Fit:
    """Styles fitted to recordings.

    Attributes:
        folder: The folder with all files.
        found: What was found, with the names and units of ``fit.json``.
        text: The same in words.
        styles: The fitted styles; ``styles={fit.styles[0]: 1}`` drives with the first.
        warnings: What is wrong with the recordings, in a line each.
    """

    def __init__(self, folder: Path, found: dict[str, Any], text: str, styles: list[Path], warnings: list[str]) -> None:
        self.folder, self.found, self.text, self.warnings = folder, found, text, warnings
        self.styles = [Style.read(it) for it in styles]

    @property
    def report(self) -> Path:
        """The report, a page for any browser."""
        return self.folder / "fit.html"

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        figures = "".join(it.read_text(encoding="utf-8") for it in sorted(self.folder.glob("*.svg")))
        return f"<pre>{html.escape(self.text)}</pre>{figures}"


def fit(
    recordings: File | Sequence[File],
    map: File | Map | None = None,
    out: File | None = None,
    *,
    columns: File | None = None,
    classes: int | None = None,
    reading: str | None = None,
    by_paper: bool = False,
    prior: File = "conservative",
    draws: int = 200,
    repetitions: int = 4,
    lead_s: float | None = None,
    position_error_m: float | None = None,
    judge: int | None = None,
    seed: int = 1,
    map_options: dict[str, Any] | None = None,
    progress: bool = True,
) -> Fit:
    """Fits driving styles to recordings, with their uncertainty.

    Args:
        recordings: Files in the format of INTERACTION, highD, inD, rounD, exiD, NGSIM or CommonRoad, or with ``columns``
            any other. Those that continue one another are joined.
        map: Their map; CommonRoad files have their own.
        out: The folder of all results; a new temporary one if it is left out.
        columns: A TOML file that says what the columns hold.
        classes: Number of classes of drivers, 1 to 6; by default two where the recordings tell them, else one.
        reading: The formulas of all incentives, "literal" or "repaired"; by default those of the prior style.
        by_paper: Whether the paper's procedure is followed, too, to compare.
        prior: The style whose weights are the prior: a built-in one, or a style file (.toml).
        draws: Draws of the bootstrap over drivers; 0: errors by the information matrix alone.
        repetitions: How often a third of the drivers is held out in turn.
        lead_s: Time before the crossing of the line at which a change begins [s]; by default where its path shows it.
        position_error_m: Standard deviation of the errors of positions along each axis [m], for which the weights are
            corrected; by default they are not.
        judge: So many simulations judge the fit on the last third of the recorded time; by default none.
        seed: Seed of all random numbers.
        map_options: How the map is read, with the keys of a scenario's table ``map_options``.
        progress: Whether a bar shows how far ``judge`` is, if ``tqdm`` is installed.

    Raises:
        LaneweaveError: A file or a value cannot be used, or the recordings are too few.
        KeyboardInterrupt: Ctrl-C. Nothing is written then; what was begun is computed to its end in the background.
    """
    file, options = map_file(map, map_options)
    keys: dict[str, Any] = {
        "map": file,
        "columns": columns and fspath(columns),
        "map_options": options,
        "classes": classes,
        "reading": reading,
        "by_paper": by_paper,
        "prior": fspath(prior),
        "draws": draws,
        "repetitions": repetitions,
        "lead_s": lead_s,
        "position_error_m": position_error_m,
        "judge": judge,
        "seed": seed,
    }
    with results_folder(out) as folder, progress_bar(progress and judge is not None) as show:
        return Fit(folder, **_laneweave.fit_styles(_files(recordings), folder, keys, show))


class Replay(Results):
    """A replay: the results of its run, and how well its drivers match what was recorded of them.

    Attributes:
        found: What was found, with the names and units of ``replay.json``.
        text: The same in words.
    """

    def __init__(
        self, folder: Path, summary: dict[str, Any], files: list[Path], warnings: list[str], found: dict[str, Any], text: str
    ) -> None:
        super().__init__(folder, summary, files, warnings)
        self.found, self.text = found, text

    @property
    def report(self) -> Path:
        """The report, a page for any browser."""
        return self.folder / "replay.html"

    def __repr__(self) -> str:
        return self.text


def replay(
    recordings: File | Sequence[File],
    map: File | Map | None = None,
    out: File | None = None,
    *,
    columns: File | None = None,
    reactive_share: float = 0.0,
    reactive_ids: Sequence[int] = (),
    reactive_from_s: float = 0.0,
    rollouts: int = 4,
    models: str | Sequence[str] | None = None,
    progress: bool = True,
    **keys: Any,
) -> Replay:
    """Replays recordings: vehicles drive as they were recorded, and some of them react.

    Args:
        recordings: Files as for ``fit``.
        map: Their map; CommonRoad files have their own.
        out: The folder of all results; a new temporary one if it is left out.
        columns: A TOML file that says what the columns hold.
        reactive_share: Share of the vehicles that become drivers who react, 0 to 1.
        reactive_ids: The ids of the vehicles that become drivers, in place of a share.
        reactive_from_s: Time from which on they are drivers [s].
        rollouts: Rollouts of each model, each with other random numbers.
        models: Lane-change models that are compared, too; by default "null" and "mobil".
        progress: Whether a bar shows how far the first rollout is, if ``tqdm`` is installed.
        keys: Keys of a scenario file, such as ``styles``, ``duration_s`` and ``seed``.

    Raises:
        LaneweaveError: A file or a value cannot be used.
        KeyboardInterrupt: Ctrl-C.
    """
    file, options = map_file(map, keys.pop("map_options", None))
    if options:
        keys["map_options"] = options
    how: dict[str, Any] = {
        "map": file,
        "columns": columns and fspath(columns),
        "reactive_share": reactive_share,
        "reactive_ids": list(reactive_ids),
        "reactive_from_s": reactive_from_s,
        "rollouts": rollouts,
        "models": _names(models),
    }
    with results_folder(out) as folder, progress_bar(progress) as show:
        return Replay(folder, **_laneweave.replay_recordings(_files(recordings), folder, how, keys, show))


def _names(models: str | Sequence[str] | None) -> list[str] | None:
    return [models] if isinstance(models, str) else None if models is None else list(models)


def _files(files: File | Sequence[File]) -> list[Path]:
    return [Path(files)] if isinstance(files, (str, PathLike)) else [Path(it) for it in files]
