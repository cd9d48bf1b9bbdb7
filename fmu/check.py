"""The unit against `helixlock sim`: python3 check.py UNIT MACHINE HELIXLOCK

A pass in large steps and in small ones, loop closed and open, ends with the counter, the ring and the
last reading that the command has; steps are played back to zero; a unit without a machine says why.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import fmpy
import numpy as np
from fmpy.validation import validate_fmu

# Six beats, forward (rtl/src/ring_distributor.rs).
RING = ["a", "ab", "b", "bc", "c", "ca"]


def run(unit, step_s, stop_s, switches):
    """The outputs at the end; switches are rows of an instant, `correct` and `playback`."""
    kinds = [("time", np.float64), ("correct", np.bool_), ("playback", np.bool_)]
    outputs = [
        v.name for v in fmpy.read_model_description(unit).modelVariables if v.causality == "output"
    ]
    rows = fmpy.simulate_fmu(
        unit,
        stop_time=stop_s,
        step_size=step_s,
        output_interval=step_s,
        input=np.array(switches, dtype=kinds),
        output=outputs,
    )
    return dict(zip(rows.dtype.names, rows[-1].tolist()))


def said(helixlock, machine):
    """What the command says of both passes, and its last reading."""
    with tempfile.TemporaryDirectory() as folder:
        words = [helixlock, "sim", machine, "--json", "--output", f"{folder}/run"]
        summary = json.loads(subprocess.run(words, check=True, capture_output=True).stdout)
        trace = np.genfromtxt(f"{folder}/run/trace.csv", delimiter=",", names=True, comments="#")
    # The pass that the machine file asks for stands first, without a prefix.
    closed = "closed_raw_error_um"
    name = closed if closed in trace.dtype.names else "raw_error_um"
    return summary, float(trace[name][-1])


def ends_as(end, passed, summary):
    steps = passed["steps_net"]
    assert end["steps"] == steps, (end, passed)
    assert end["count"] == abs(steps), end
    assert end["comparisons"] == summary["run"]["comparisons"], end
    assert end["fault"] == passed["counter_fault"], end
    phases = {phase for phase in "abc" if end[f"phase_{phase}"]}
    assert phases == set(RING[steps % 6]), end


def main(unit, machine, helixlock):
    problems = validate_fmu(unit)
    assert not problems, problems
    summary, last = said(helixlock, machine)
    end_s, closed = summary["run"]["duration_s"], summary["with_correction"]
    for step_s in (end_s / 7, 1.7):
        end = run(unit, step_s, end_s, [(0.0, True, False)])
        ends_as(end, closed, summary)
        assert abs(end["error_um"] - last) < 1e-6, (end, last)
    ends_as(run(unit, 5.0, end_s, [(0.0, False, False)]), summary["without_correction"], summary)
    home_s = abs(closed["steps_net"]) / summary["settings"]["step_frequency_hz"] + 5.0
    switches = [(0.0, True, False), (end_s, True, False), (end_s + 1.0, False, True)]
    home = run(unit, 0.5, end_s + 1.0 + home_s, switches)
    assert home["zero"] and home["steps"] == 0 and home["phase_a"], home
    without_machine(unit)
    print("as the command:", json.dumps(end))


def without_machine(unit):
    with tempfile.TemporaryDirectory() as folder:
        unpacked = Path(fmpy.extract(unit, f"{folder}/unit"))
        (unpacked / "resources/machine.toml").unlink()
        bare = shutil.make_archive(f"{folder}/bare", "zip", unpacked)
        try:
            run(bare, 1.0, 2.0, [(0.0, True, False)])
        except Exception as error:
            assert "fmi3ExitInitializationMode" in str(error), error
        else:
            raise AssertionError("a unit without a machine ran")


if __name__ == "__main__":
    main(*sys.argv[1:])
