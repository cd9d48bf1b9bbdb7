"""One part of a sweep, and all of them joined, as plain functions for any pool of workers."""

import os
import subprocess
from pathlib import Path

HELIXLOCK = os.environ.get("HELIXLOCK", "helixlock")
HERE = Path(__file__).resolve().parent
OUT = Path(os.environ.get("OUT", HERE / "parts")).resolve()
SWEEP = [
    "../sg7430-6mm/machine.toml",
    *("--length", "0.5"),
    *("--seed", "3"),
    *("--samples", "4"),
    *("--set", "drive.frequency=50..150:6 Hz"),
    *("--draw", "effect.0.amplitude=0.5..2 um"),
]


def work_out(part: int, parts: int) -> int:
    """Works out part `part` of `parts`, counted from 1; what is there already is not done again."""
    words = [HELIXLOCK, "sweep", *SWEEP, "--shard", f"{part}/{parts}", "-o", str(OUT)]
    subprocess.run(words, cwd=HERE, check=True)
    return part


def merge() -> Path:
    """Checks and joins the parts; gives the file of all cases."""
    cases = OUT / "cases.parquet"
    subprocess.run([HELIXLOCK, "merge", str(OUT), "-o", str(cases)], cwd=HERE, check=True)
    return cases
