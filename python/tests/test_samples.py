"""Tables are read by numpy, pyarrow, pandas and polars, and not copied where that can be seen."""

import gc
import threading
import time
from pathlib import Path

import helixlock
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest


@pytest.fixture(scope="module")
def trace() -> helixlock.Table:
    examples = Path(__file__).parents[2] / "examples"
    return helixlock.simulate(examples / "sg7430-6mm/machine.toml", length="6 mm").trace


def address(array: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> int:
    place = array.__array_interface__["data"][0]
    assert isinstance(place, int)
    return place


def test_all_readers_see_the_same_numbers_in_the_same_place(trace: helixlock.Table) -> None:
    place = address(np.asarray(trace["error_um"]))
    arrow = pa.table(trace)
    assert arrow.column_names == trace.columns
    assert address(arrow["error_um"].chunk(0).to_numpy()) == place
    assert address(pa.array(trace["error_um"]).to_numpy()) == place
    assert address(pl.DataFrame(trace)["error_um"].to_numpy()) == place
    frame = pd.DataFrame.from_arrow(trace)
    assert list(frame.columns) == trace.columns
    np.testing.assert_array_equal(frame["error_um"], np.asarray(trace["error_um"]))


def test_numbers_outlive_their_table() -> None:
    model = Path(__file__).parents[2] / "examples/sg7430-6mm/machine.toml"
    times = np.asarray(helixlock.simulate(model, length="6 mm").trace["time_s"])
    gc.collect()
    assert np.all(np.diff(times) > 0)
    with pytest.raises(ValueError, match="read-only"):
        times[0] = 1.0


def test_a_column_is_a_sequence(trace: helixlock.Table) -> None:
    column = trace["time_s"]
    assert len(column) == len(trace)
    assert [column[place] for place in range(len(column))] == list(np.asarray(column))
    assert column[-1] == np.asarray(column)[-1]
    with pytest.raises(IndexError):
        column[len(column)]
    with pytest.raises(KeyError, match="time_s"):
        trace["time"]


def test_other_threads_run_meanwhile(trace: helixlock.Table) -> None:
    """While one thread simulates, this one is never kept waiting for long."""
    machine = Path(__file__).parents[2] / "examples/sg7430-6mm/machine.toml"
    work = threading.Thread(target=helixlock.simulate, args=(machine,))
    turns = 0
    work.start()
    while work.is_alive():
        time.sleep(0.001)
        turns += 1
    # With the lock held, the loop would turn once or twice in all.
    assert 10 < turns
