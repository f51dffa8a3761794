"""Styles of drivers, edited as dicts."""

from __future__ import annotations

import tomllib
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from . import _laneweave


class Style:
    """A style of drivers: how they follow, and why they change lanes. It is edited as a dict.

    >>> mine = lw.Style("mine", base="aggressive")
    >>> mine["change.courtesy.weight"] = 1.2
    >>> lw.Simulation(lw.example("ramps"), styles={mine: 1, "conservative": 3})

    Keys are those of a style file; ``style["change.speed.weight"]`` is ``style["change"]["speed"]["weight"]``. A number
    can be a distribution: ``{"distribution": "uniform", "low": 0.9, "high": 1.1}``.

    Attributes:
        values: All values, table by table.
    """

    def __init__(self, name: str, base: str | PathLike[str] = "conservative") -> None:
        """A new style with the values of ``base``: a built-in style, or a style file (.toml).

        Raises:
            StyleError: The name is that of a built-in style, or there is no such base.
        """
        self.values: dict[str, Any] = tomllib.loads(_laneweave.new_style(name, fspath(base)))

    @classmethod
    def read(cls, name: str | PathLike[str]) -> Style:
        """A style as it is: a built-in one, or a style file (.toml).

        Raises:
            StyleError: There is no such style, or the file cannot be used.
        """
        style = cls.__new__(cls)
        style.values = tomllib.loads(_laneweave.style_text(fspath(name)))
        return style

    @property
    def name(self) -> str:
        """Its name."""
        return str(self.values["name"])

    def __getitem__(self, key: str) -> Any:
        table, last = self._table(key)
        return table[last]

    def __setitem__(self, key: str, value: Any) -> None:
        table, last = self._table(key)
        table[last] = value

    def __contains__(self, key: str) -> bool:
        try:
            self[key]
        except KeyError:
            return False
        return True

    def _table(self, key: str) -> tuple[dict[str, Any], str]:
        *tables, last = key.split(".")
        table = self.values
        for name in tables:
            table = table[name]
            if not isinstance(table, dict):
                raise KeyError(key)
        return table, last

    def to_toml(self) -> str:
        """The text of a style file.

        Raises:
            StyleError: A key is unknown, or a value is not in its range.
        """
        return _laneweave.style_of(self.values)

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes a style file, and returns its path.

        Raises:
            StyleError: A key is unknown, or a value is not in its range. Nothing is written then.
        """
        text = self.to_toml()
        Path(path).write_text(text, encoding="utf-8")
        return Path(path)

    def __repr__(self) -> str:
        return f"<laneweave.Style {self.name}: {self.values.get('description', '')}>"
