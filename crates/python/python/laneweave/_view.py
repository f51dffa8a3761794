"""Traffic to look at: the page in the browser, and pictures."""

from __future__ import annotations

import html
import sys
import time
import webbrowser
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Self

from . import _laneweave
from ._laneweave import Map, Simulation
from ._results import Results, map_file


class Picture(bytes):
    """A picture as PNG. A notebook shows it."""

    def _repr_png_(self) -> bytes:
        return bytes(self)

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes it, and returns the path."""
        Path(path).write_bytes(self)
        return Path(path)

    def __repr__(self) -> str:
        return f"<laneweave.Picture: {len(self)} bytes of PNG>"


def picture(
    simulation: Simulation,
    camera: str | tuple[float, float, float] | int = "map",
    size: tuple[int, int] = (1280, 720),
) -> Picture:
    """A picture of the traffic from above, as it is now.

    Args:
        simulation: The traffic; it stays as it is.
        camera: ``"map"``; a place and the width of what is seen, ``(x_m, y_m, width_m)``; or the id of a vehicle.
        size: Width and height in pixels.

    Raises:
        NotFoundError: The vehicle is not on the road.
        LaneweaveError: There is no such camera or size.
    """
    return Picture(simulation._png(camera, size))


class View:
    """The page in the browser. It is served until it is closed, or the program ends.

    In a notebook it shows itself. As a context manager it closes itself.
    """

    def __init__(self, made: _laneweave.View) -> None:
        self._made = made

    @property
    def url(self) -> str:
        """The address of the page. Whoever knows it can do there what you can do."""
        return self._made.url

    def close(self) -> None:
        """Ends the page."""
        self._made.close()

    def wait(self) -> None:
        """Waits until Ctrl-C, and closes it."""
        try:
            while not self._made.is_closed:
                time.sleep(0.1)
        except KeyboardInterrupt:
            self.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<laneweave.View: {'closed' if self._made.is_closed else self.url.partition('?')[0]}>"

    def _repr_html_(self) -> str:
        frame = f'<iframe src="{html.escape(self.url)}" width="100%" height="600" style="border:0"></iframe>'
        return "<p>closed</p>" if self._made.is_closed else frame


def view(
    shown: Simulation | Results | Map | str | PathLike[str] | Sequence[str | PathLike[str]],
    *,
    map: str | PathLike[str] | Map | None = None,
    columns: str | PathLike[str] | None = None,
    map_options: dict[str, Any] | None = None,
    browser: bool | None = None,
    saved: str | PathLike[str] = "saved",
    port: int = 0,
) -> View:
    """Shows traffic in the browser of this machine, in 3-D, with the reasons of its drivers.

    Args:
        shown: A simulation, of which a copy goes on there from its present state; the results of a run, or their
            folder; a scenario (.toml) or a map, which is simulated; or recordings, with ``map``.
        map: The map of the recordings.
        columns: A TOML file that says what the columns of the recordings hold.
        map_options: How a map is read, with the keys of a scenario's table ``map_options``.
        browser: Whether a browser is opened; by default it is, except in a notebook, where the page is shown in place.
        saved: The folder in which scenarios are saved with what was done by hand. Traffic that a program drove before
            it was shown cannot be saved there: its scenario does not lead to it.
        port: The port of the page; 0: any free one.

    Raises:
        TypeError: An argument has no meaning for what is shown.
        LaneweaveError: A file cannot be used, or the port is taken.
    """
    if map is None and columns is not None:
        raise TypeError("columns= says what the columns of recordings hold; name their map with map=")
    if isinstance(shown, Simulation):
        if map is not None or map_options is not None:
            raise TypeError("a simulation has its map; leave map= and map_options= out")
        made = shown._view(Path(saved), port)
    else:
        map, options = map_file(map, map_options)
        if isinstance(shown, Results):
            files = [shown.folder]
        elif isinstance(shown, Map):
            file, options = map_file(shown, map_options)
            files = [Path(file or "")]
        elif isinstance(shown, (str, PathLike)):
            files = [Path(shown)]
        else:
            files = [Path(it) for it in shown]
        if not files:
            raise TypeError("nothing is shown; name a file")
        made = _laneweave.view_files(files, map, columns, options, Path(saved), port)
    if (not _in_notebook()) if browser is None else browser:
        webbrowser.open(made.doorway().as_uri())
    return View(made)


def _in_notebook() -> bool:
    return "ipykernel" in sys.modules
