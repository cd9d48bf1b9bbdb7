"""The compiled part of helixlock."""

from pathlib import Path
from typing import Any, final

__all__ = ["Column", "Error", "Table", "answer"]

class Error(ValueError):
    """Input that was refused, and its place."""

    file: Path | None
    """The file."""
    line: int | None
    """Line in it, from 1."""
    column: int | None
    """Column in that line, from 1, in characters."""
    key: str | None
    """Key of the machine file, column of the data, or option of the function."""

@final
class Column:
    """One column of a table."""

    def __len__(self) -> int: ...
    def __getitem__(self, place: int, /) -> float: ...
    @property
    def __array_interface__(self) -> dict[str, Any]: ...
    def __arrow_c_array__(self, requested_schema: object | None = None) -> tuple[object, object]: ...

@final
class Table:
    """Samples: named columns of numbers, each name ending in the unit. A missing value is NaN.

    ``pandas.DataFrame.from_arrow``, ``polars.DataFrame``, ``pyarrow.table`` and all that reads the
    Arrow C stream interface take it without a copy; ``numpy.asarray(table["time_s"])`` too.
    """

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
    def __len__(self) -> int: ...
    def __getitem__(self, name: str, /) -> Column: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

def answer(function: str, words: list[str]) -> tuple[str, dict[str, Table | str]]:
    """What a function answers to the words of its command: JSON, and tables and texts by name."""
