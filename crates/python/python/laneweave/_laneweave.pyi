"""The compiled part of the package."""

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal, Self, TypeAlias

import numpy as np
import numpy.typing as npt

__version__: str
SIGHT_COLUMNS: list[str]
"""The columns of a row of sight: whether there is a vehicle (1 or 0); where its centre is in the frame of the lane, ahead
and to the left [m]; its speed [m/s]; its heading against that of the lane [rad]; its length and its width [m]."""

Lateral: TypeAlias = Literal["driver", "keep", "left", "right"]

class Simulation:
    """A simulation: traffic on a map, which a program steps through, asks, and changes.

    Threads do not share a simulation: a call from another one raises a StateError while it works.
    """

    def __new__(cls, source: str | PathLike[str] | Map, **keys: Any) -> Self:
        """A simulation of the scenario (.toml) or the map `source`, with these keys in place of its own.

        Raises:
            LaneweaveError: A file or a key cannot be used.
        """

    def step(self, count: int = 1) -> list[dict[str, Any]]:
        """Simulates `count` steps, and returns what happened in them: dicts with the key "event", such as
        "lane_change", which has its reasons."""

    def run(self, until_s: float) -> None:
        """Simulates steps until the time `until_s` [s], without their events. Ctrl-C ends it between two steps."""

    def reset(self, seed: int) -> None:
        """Begins anew with this seed; the drivers stay those with which the simulation was made."""

    @property
    def time_s(self) -> float:
        """The present time [s]."""

    @property
    def end_s(self) -> float:
        """The time at which a run of the scenario ends [s]."""

    @property
    def step_s(self) -> float:
        """The length of a step [s]."""

    @property
    def scenario(self) -> dict[str, Any]:
        """The scenario, with the keys of a scenario file."""

    @property
    def lanelets(self) -> list[str]:
        """The ids of all lanelets."""

    @property
    def lights(self) -> dict[str, str]:
        """What each traffic light shows, by its id: green, yellow or red."""

    @property
    def origins(self) -> list[tuple[str, float]]:
        """Where trips start, by the smallest lanelet id, with the demand there [veh/h]."""

    @property
    def destinations(self) -> list[str]:
        """Where trips can end, by the smallest lanelet id."""

    @property
    def styles(self) -> list[tuple[str, float]]:
        """The styles with their weights."""

    @property
    def state_hash(self) -> int:
        """A hash of the traffic: two simulations with the same hash have the same traffic."""

    @property
    def counts(self) -> dict[str, Any]:
        """Counts of vehicles, trips and lane changes since the end of the warm-up."""

    def __len__(self) -> int:
        """Number of vehicles on the road."""

    def __bool__(self) -> bool:
        """True, also while nobody is on the road."""

    def vehicles(self) -> list[dict[str, Any]]:
        """All vehicles on the road, in the order of their ids, with the names of the table trajectories."""

    def vehicle(self, id: int) -> dict[str, Any] | None:
        """A vehicle; None if it is not on the road."""

    def columns(self, poses: bool = False) -> dict[str, npt.NDArray[Any]]:
        """All vehicles as arrays of the shape (vehicles,): vehicle, lanelet_index (its place in `lanelets`),
        position_m [m], speed_mps [m/s], acceleration_mps2 [m/s²]; with `poses` also x_m, y_m, z_m [m] and heading_rad
        [rad] of the centres."""

    def insert(
        self,
        lanelet: str | int,
        position_m: float,
        speed_mps: float,
        *,
        class_: str = "car",
        style: str | None = None,
        destination: str | int | None = None,
    ) -> int:
        """Puts a vehicle on the road, at once, and returns its id. Its own driver drives it, with the first style of
        the scenario if none is given.

        Args:
            lanelet: The lanelet on which its front bumper is.
            position_m: Position of its front bumper along the lanelet [m].
            speed_mps: Speed [m/s].

        Raises:
            CommandError: It cannot be there, or another vehicle could not stay clear of it.
        """

    def remove(self, id: int) -> None:
        """Takes a vehicle off the road."""

    def control(
        self,
        id: int,
        *,
        speed_mps: float | None = None,
        acceleration_mps2: float | None = None,
        most_mps: float | None = None,
        lateral: Lateral = "driver",
    ) -> None:
        """Drives a vehicle in lanes until the next control: at a speed [m/s], with an acceleration [m/s²], or as its
        driver does but no faster than a speed [m/s]. It keeps its lane, or changes once to the left or the right."""

    def pose(self, id: int, x_m: float, y_m: float, heading_rad: float, speed_mps: float) -> None:
        """Puts the centre of a vehicle at this pose [m, rad] at the end of the next step, and leaves it there."""

    def release(self, id: int) -> None:
        """Gives a vehicle back to its driver."""

    def set_style(self, id: int, style: str) -> None:
        """Gives the driver of a vehicle another style of the scenario."""

    def set_destination(self, id: int, destination: str | int | None) -> None:
        """Gives the driver of a vehicle another destination; None: it follows the road."""

    def set_demand(self, origin: str | int, vehicles_per_hour: float) -> None:
        """Sets the demand at an entrance from now on [veh/h]."""

    def set_share(self, style: str, weight: float) -> None:
        """Sets the weight of a style among those of the drivers who arrive from now on."""

    def set_parameter(self, style: str, parameter: str, value: float) -> None:
        """Changes a number of a style for all of its drivers, by its key in a style file."""

    def close_lanelet(self, lanelet: str | int, is_closed: bool = True) -> None:
        """Closes a lanelet to all vehicles, or opens it again."""

    def explain(self, id: int) -> str | None:
        """What a driver makes of its lanes and is about to do, in words; None if it is not on the road."""

    def evaluate(self, id: int) -> dict[str, Any] | None:
        """The same as data, with the yield and the weight of each incentive."""

    def save(self) -> bytes:
        """All state of the traffic."""

    def restore(self, saved: bytes) -> None:
        """Goes on from a saved state of a simulation of the same scenario and seed, bit for bit."""

    def branch(self) -> Simulation:
        """Another simulation in the same state, which goes on by itself."""

    def template(self) -> Template:
        """A template of simulations that go on from where this one is, each with random numbers of its own: a Fleet, say,
        in traffic that has been driven for a while."""

    def _png(self, camera: str | tuple[float, float, float] | int, size: tuple[int, int]) -> bytes:
        """A picture of the traffic as it is now; see laneweave.picture."""

    def _pixels(
        self, camera: str | tuple[float, float, float] | int, size: tuple[int, int]
    ) -> npt.NDArray[np.uint8]:
        """The same as an array: height × width × red, green and blue."""

    def _view(self, saved: Path, port: int) -> View:
        """The page in the browser with a branch of it; see laneweave.view."""

    def close(self) -> None:
        """Frees its memory. Nothing can be asked of it any more."""

    def __enter__(self) -> Self: ...
    def __exit__(self, *exception: object) -> None: ...

class Template:
    """A scenario of which many simulations are made, each with a seed of its own. They share map, routes, drivers and
    demand."""

    def __new__(cls, source: str | PathLike[str] | Map, **keys: Any) -> Self: ...
    def spawn(self, seed: int) -> Simulation:
        """A simulation with this seed of all random numbers, which begins where the template is: at its start, unless a
        simulation that had begun gave it. Its drivers are those of the template: of the
        seed, or the drivers_seed, with which that was made."""

    @property
    def scenario(self) -> dict[str, Any]:
        """The scenario, with the keys of a scenario file."""

class Batch:
    """Many worlds in which a program learns to drive one vehicle: what the environments of laneweave.gym are made of."""

    TERMS: list[str]
    """The names of the terms of a reward."""
    CHOICES: list[str]
    """The names of the discrete actions, in the order of their numbers."""

    def __new__(
        cls,
        source: str | PathLike[str] | Map,
        populations: list[tuple[str, dict[str, Any]]],
        task: dict[str, Any],
        seeds: list[int],
        threads: int = 1,
        autoreset: str = "next_step",
        changes: bool = False,
    ) -> Self: ...
    @property
    def parts(self) -> list[dict[str, Any]]:
        """The parts of an observation: name, shape and columns of each."""

    @property
    def task(self) -> dict[str, Any]:
        """The task, with all its values."""

    @property
    def populations(self) -> list[str]:
        """The name of the population in each world."""

    def reset(self, seeds: list[int | None], mask: list[bool], observations: npt.NDArray[np.float32]) -> None:
        """Begins the next episodes where the mask is true: the first one of a seed where one is given."""

    def act(
        self,
        actions: npt.NDArray[np.float64],
        observations: npt.NDArray[np.float32],
        last_observations: npt.NDArray[np.float32],
        rewards: npt.NDArray[np.float64],
        terms: npt.NDArray[np.float64],
        terminated: npt.NDArray[np.bool_],
        truncated: npt.NDArray[np.bool_],
    ) -> None:
        """Acts in all worlds, and fills the arrays."""

    def changes(self, number: int) -> list[dict[str, Any]]:
        """The lane changes around the ego of a world in the steps of the last action, if it keeps them."""

    def ego(self, number: int) -> int:
        """The vehicle that the program drives in a world."""

    def simulation(self, number: int) -> Simulation:
        """A simulation that goes on from where a world is."""

class Fleet:
    """Many simulations of one template, stepped together on one pool of threads."""

    def __new__(cls, template: Template, seeds: Sequence[int], threads: int = 1) -> Self: ...
    def __len__(self) -> int:
        """Number of simulations."""

    def step(self, steps: int = 1) -> None:
        """Simulates so many steps of each."""

    def reset(self, number: int, seed: int) -> None:
        """Lets one of the simulations begin anew with this seed."""

    @property
    def lanelets(self) -> list[str]:
        """The ids of all lanelets: the column `lanelet_index` has places in this list."""

    @property
    def state_hashes(self) -> list[int]:
        """The hashes of the traffic of all simulations."""

    def control(
        self, vehicles: npt.NDArray[np.uint32], speed_mps: npt.NDArray[np.float64], lateral: Lateral = "driver"
    ) -> None:
        """Drives the vehicle of each simulation at these speeds [m/s]; NaN leaves the speed to its driver."""

    def columns(
        self,
        counts: npt.NDArray[np.uint32],
        vehicle: npt.NDArray[np.uint32],
        lanelet_index: npt.NDArray[np.uint32],
        position_m: npt.NDArray[np.float64],
        speed_mps: npt.NDArray[np.float64],
        acceleration_mps2: npt.NDArray[np.float32],
    ) -> int:
        """Fills the arrays with the vehicles of all simulations, one simulation after the other, and `counts` with how
        many each has. `lanelet_index` gets places in `lanelets`. Returns how many there are."""

    def sight(self, vehicles: npt.NDArray[np.uint32], sight: npt.NDArray[np.float32]) -> None:
        """Fills `sight`, of the shape (simulations, 1 + nearest, len(SIGHT_COLUMNS)), with what the vehicle of each
        simulation sees: itself first, then the others, the nearest first. Rows are 0 where there is nobody."""

class Map:
    """A map that was read: its lanelets, what is wrong with it, and the ways through it.

    Simulations and templates are made of it as of its file.
    """

    def __new__(cls, path: str | PathLike[str], **options: Any) -> Self:
        """The map in the file `path`, read with these options: `origin`, `law`, `driving_side`, `joins_ends`,
        `max_size_mb`, as in a scenario.

        Raises:
            LaneweaveError: The file or an option cannot be used.
        """

    @property
    def path(self) -> Path:
        """The file."""

    @property
    def options(self) -> dict[str, Any]:
        """How it was read."""

    @property
    def lanelets(self) -> list[str]:
        """The ids of all lanelets for vehicles."""

    def lines(self, lanelet: str | int) -> dict[str, npt.NDArray[np.float64]]:
        """The borders and the centre line of a lanelet, "left", "right" and "centre": arrays of the shape (points, 3) with
        x, y and z [m]."""

    def graph(self) -> dict[str, dict[str, Any]]:
        """The routing graph by the ids of the lanelets: what follows, what lies beside, what crosses, length and limit."""

    def check(self) -> dict[str, Any]:
        """What the map contains, and the problems in it, as `laneweave check --json` says it."""

    def routes(self, from_lanelet: str | int, to_lanelet: str | int, *, most: int = ..., longest: float = ...) -> list[dict[str, Any]]:
        """The sensible routes from one lanelet to another, the fastest first.

        Args:
            most: Largest number of routes.
            longest: Longest travel time, as a multiple of that of the fastest route.
        """

    def svg(self) -> str:
        """A picture of the map, with its problems. A notebook shows it."""

    def _repr_svg_(self) -> str: ...

class View:
    """The page in the browser; see laneweave.View."""

    @property
    def url(self) -> str: ...
    def doorway(self) -> Path:
        """A file that leads a browser to the page, and that only you can read; it is there until the view is closed."""

    @property
    def is_closed(self) -> bool: ...
    def close(self) -> None: ...

Progress: TypeAlias = Callable[[float], object] | None

def compare_models(
    sources: Sequence[str | PathLike[str] | Map],
    out: Path,
    models: list[str] | None,
    seeds: int,
    progress: Progress,
    **keys: Any,
) -> tuple[str, tuple[Path, Path]]:
    """Compares models; see laneweave.compare."""

def fit_styles(
    recordings: list[Path], out: Path, keys: dict[str, Any], progress: Progress
) -> dict[str, Any]:
    """Fits styles; see laneweave.fit."""

def replay_recordings(
    recordings: list[Path], out: Path, how: dict[str, Any], keys: dict[str, Any], progress: Progress
) -> dict[str, Any]:
    """Replays recordings; see laneweave.replay."""

def style_text(name: str) -> str:
    """The text of a style file."""

def new_style(name: str, base: str) -> str:
    """The text of a new style like another one."""

def style_of(values: dict[str, Any]) -> str:
    """The text of a style file with these values."""

def view_files(
    input: list[Path],
    map: str | PathLike[str] | None,
    columns: str | PathLike[str] | None,
    options: dict[str, Any],
    saved: Path,
    port: int,
) -> View:
    """A view of files; see laneweave.view."""

def command(arguments: list[str], program: list[str]) -> int:
    """Does what a command line asks for, and returns the exit code. The first argument is the name of the program.

    Another process of the command begins with ``program``.
    """

class SweepFolder:
    """A sweep in its folder; see laneweave.sweep."""

    def __init__(self, plan: str | PathLike[str] | dict[str, Any], out: str | PathLike[str]) -> None: ...
    @property
    def run_count(self) -> int: ...
    def open_keys(self, shard: str | None = None) -> list[str]: ...
    def run(self, keys: list[str], program: list[str], workers: int | None, progress: Progress = None) -> None: ...
    def finish(self) -> tuple[Path, Path, str] | None: ...

class SweepWorker:
    """Does runs of a sweep that was begun."""

    def __init__(self, folder: str | PathLike[str]) -> None: ...
    def run(self, key: str) -> None: ...

def run(
    source: str | PathLike[str] | Map,
    out: str | PathLike[str],
    progress: Progress = None,
    **keys: Any,
) -> tuple[dict[str, Any], list[Path], list[str]]:
    """Runs a scenario to its end; see laneweave.run."""
