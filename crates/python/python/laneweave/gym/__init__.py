"""Environments in which a program learns to drive, for Gymnasium: ``pip install laneweave[gym]``.

>>> import gymnasium
>>> environment = gymnasium.make("laneweave/Merge-v0")
>>> observation, info = environment.reset(seed=1)

``gymnasium.make_vec("laneweave/Merge-v0", num_envs=64)`` steps many worlds together. ``laneweave/Scenario-v0`` is one
for any map or scenario: ``gymnasium.make("laneweave/Scenario-v0", source="town.osm")``.
"""

from ._environment import Environment
from ._registered import ENVIRONMENTS, register
from ._vector import VectorEnvironment

__all__ = ["ENVIRONMENTS", "Environment", "VectorEnvironment", "register"]

register()
