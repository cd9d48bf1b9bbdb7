"""helixlock: laser correction of a lead-screw grinder, and what a machine model lacks.

Every function is a command of ``helixlock``: the same words, units, defaults and messages. A result
is a ``dict``, equal to what the command prints with ``--json``; samples and files hang on it as
attributes, samples as Arrow tables that numpy, pandas and polars read without a copy.

>>> import helixlock
>>> found = helixlock.diagnose("machine.toml", "data.csv")
>>> found["verdict"], found.residual.columns

A quantity is a number in the unit that its description names, or a text with a unit: ``"6 mm"``.
What is refused raises :class:`Error` with ``file``, ``line``, ``column`` and ``key``. Other Python
threads run while a function works.
"""

from ._answers import (
    Added,
    Answer,
    Applied,
    Comparison,
    Diagnosis,
    Discovery,
    Image,
    Learned,
    ScrewGrade,
    Separation,
    Simulation,
    Sweep,
    TransmissionError,
)
from ._functions import *  # noqa: F403
from ._functions import __all__ as _functions
from ._native import Column, Error, Table

__all__ = [
    "Added",
    "Answer",
    "Applied",
    "Column",
    "Comparison",
    "Diagnosis",
    "Discovery",
    "Error",
    "Image",
    "Learned",
    "ScrewGrade",
    "Separation",
    "Simulation",
    "Sweep",
    "Table",
    "TransmissionError",
]
__all__ += _functions
