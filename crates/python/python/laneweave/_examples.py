"""The maps that come with the package."""

from __future__ import annotations

import difflib
from pathlib import Path

from ._errors import NotFoundError

_MAPS = Path(__file__).parent / "maps"


def example(name: str) -> Path:
    """The file of a map that comes with the package, such as ``"ramps"``, ``"on_ramp"``, ``"town"`` or ``"roundabout"``.

    Raises:
        NotFoundError: There is no such map; the exception lists them.
    """
    path = _MAPS / f"{name.removesuffix('.osm')}.osm"
    if path.exists():
        return path
    names = sorted(it.stem for it in _MAPS.glob("*.osm"))
    near = difflib.get_close_matches(name, names, 1)
    remedy = f'did you mean "{near[0]}"?' if near else f"choose one of {', '.join(names)}"
    raise NotFoundError("example", f'there is no map "{name}"', remedy)
