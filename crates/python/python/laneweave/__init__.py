"""laneweave: a microscopic traffic simulator whose drivers change lanes for human reasons.

>>> import laneweave as lw
>>> simulation = lw.Simulation(lw.example("ramps"), vehicles_per_hour=3000, seed=1)
>>> simulation.run(60.0)
>>> simulation.columns()["speed_mps"].mean()

Keyword arguments are the keys of a scenario file: ``demand={"trucks": 0.1}``, ``styles={"aggressive": 1}``,
``run={"step_s": 0.2}``. The most common ones need no table: ``vehicles_per_hour``, ``trucks``, ``seed``,
``drivers_seed``, ``duration_s``, ``warmup_s``, ``step_s``, ``threads``.
"""

from ._errors import (
    CommandError,
    FileError,
    LaneweaveError,
    MapError,
    NotFoundError,
    RecordingError,
    ScenarioError,
    StateError,
    StyleError,
)
from ._examples import example
from ._laneweave import SIGHT_COLUMNS, Fleet, Map, Simulation, Template, __version__
from ._results import Results, run
from ._studies import Comparison, Fit, Replay, compare, fit, replay
from ._style import Style
from ._sweep import Sweep, sweep, sweep_runs
from ._view import Picture, View, picture, view

__all__ = [
    "SIGHT_COLUMNS",
    "CommandError",
    "Comparison",
    "FileError",
    "Fit",
    "Fleet",
    "LaneweaveError",
    "Map",
    "MapError",
    "NotFoundError",
    "Picture",
    "RecordingError",
    "Replay",
    "Results",
    "ScenarioError",
    "Simulation",
    "StateError",
    "Style",
    "StyleError",
    "Sweep",
    "Template",
    "View",
    "__version__",
    "compare",
    "example",
    "fit",
    "picture",
    "replay",
    "run",
    "sweep",
    "sweep_runs",
    "view",
]
