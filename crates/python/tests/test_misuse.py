"""Whatever a program hands over, it gets an exception, and the simulation goes on."""

import os
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import laneweave as lw
import numpy as np
import pytest

RUNS = int(os.environ.get("LANEWEAVE_MISUSES") or 500)

ODD: list[Any] = [
    None, True, -1, 0, 1, 7, 2**31, 2**63, 2**64, -(2**63), 0.0, -0.5, 1e308, float("nan"), float("inf"), "", "car",
    "left", "\0", "ü" * 1000, b"", b"\xff" * 64, [], [1], {}, {"a": 1}, (), set(), object(), int, print,
    np.zeros(0), np.zeros(3), np.zeros((2, 2)), np.zeros(3, np.uint32), np.zeros(8, np.float32)[::2],
    np.zeros((2, 3, 7), np.float32), np.full(6, np.nan), np.zeros(6, ">f8"), np.array(["a"]), Path("/"),
]  # fmt: skip


ENDLESS: list[Any] = []
ENDLESS.append(ENDLESS)
ODD.append(ENDLESS)


def calls(objects: list[Any]) -> list[Callable[..., Any]]:
    """All methods of these objects."""
    names = [(it, name) for it in objects for name in dir(type(it)) if not name.startswith("_")]
    # A closed object refuses even its attributes.
    methods = [(it, name) for it, name in names if callable(getattr(type(it), name))]
    return [getattr(it, name) for it, name in methods if name not in ("close", "run")]


def test_random_misuse_raises_exceptions_only(merge: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    dice = random.Random(1)
    template = lw.Template(merge, vehicles_per_hour=2400)
    simulation, fleet = template.spawn(1), lw.Fleet(template, range(6))
    simulation.step(100)
    closed = template.spawn(2)
    closed.close()
    known = [it["id"] for it in simulation.vehicles()] + simulation.lanelets
    road, style = lw.Map(merge), lw.Style("mine")
    methods = calls([simulation, fleet, template, closed, road, style])
    methods += [lw.Simulation, lw.Template, lw.Fleet, lw.Map, lw.Style, lw.Style.read, lw.example, lw.picture]
    methods += [lw.run, lw.compare, lw.fit, lw.replay]
    refused = 0
    for _ in range(RUNS):
        method = dice.choice(methods)
        pool = ODD + [template, simulation, fleet, closed, style, dice.choice(known)]
        arguments = [dice.choice(pool) for _ in range(dice.randrange(5))]
        if method.__name__ == "step" and any(isinstance(it, int) and it > 100 for it in arguments):
            continue
        try:
            method(*arguments)
        except Exception as error:
            refused += 1
            assert "report this as a bug" not in str(error), (method, arguments, error)
    assert refused > RUNS // 3
    fleet.step()
    simulation.step()
