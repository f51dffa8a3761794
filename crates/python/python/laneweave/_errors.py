"""What can go wrong. Each exception says where, what, and what to do about it."""


class LaneweaveError(Exception):
    """A mistake in the input, or of laneweave itself.

    Attributes:
        place: Where: a file with line and column, a key, a vehicle or a function.
        what: The problem.
        remedy: What can be done about it.
    """

    def __init__(self, place: str, what: str = "", remedy: str = "") -> None:
        super().__init__(place, what, remedy)
        self.place, self.what, self.remedy = place, what, remedy

    def __str__(self) -> str:
        return f"{self.place}: {self.what}; {self.remedy}" if self.what else self.place


class NotFoundError(LaneweaveError, LookupError):
    """A file, or something with this name, does not exist."""


class FileError(LaneweaveError):
    """The system refuses to read or write a file."""


class ScenarioError(LaneweaveError, ValueError):
    """A scenario or a value cannot be used."""


class MapError(LaneweaveError, ValueError):
    """A map cannot be used."""


class RecordingError(LaneweaveError, ValueError):
    """A recording cannot be used."""


class StyleError(LaneweaveError, ValueError):
    """A style cannot be used."""


class CommandError(LaneweaveError, ValueError):
    """A command to the traffic is not possible."""


class StateError(LaneweaveError, RuntimeError):
    """Something is not possible in the present state, such as going back in time."""
