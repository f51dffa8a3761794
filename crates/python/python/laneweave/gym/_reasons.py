"""Why the drivers around did what they did."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._worlds import Worlds


class Reasons:
    """The lane changes of the ego and of the drivers within 100 m, with their reasons."""

    KEPT = ("vehicle", "style", "side", "kind", "is_completed", "time_s", "reasons", "utility", "threshold")

    def __init__(self, worlds: Worlds) -> None:
        self._worlds = worlds

    def of(self, world: int) -> list[dict[str, Any]]:
        """What drivers of a world did in the steps of the last action: each lane change with its incentives."""
        changes = self._worlds.batch.changes(world)
        return [{key: it[key] for key in self.KEPT} for it in changes]
