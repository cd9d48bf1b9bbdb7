"""`helixlock discover` against shapes that have a formula, shapes that have none, and nothing hidden."""

import json
import subprocess
import tempfile
import time
from pathlib import Path

from .build import build
from .scenes import KINDS, nothing, outside
from .synth import truth, write

PATIENCE_S = 300
# Where a value may lie: standard errors, and the share of it that rounding and sampling take.
ERRORS, SHARE = 2.0, 0.005


def formulas(seeds, binary):
    """Prints a line a case, then what share of the shapes and of their values was right."""
    rooms = nothing.SCENES + outside.SCENES
    tally = {}
    for seed in seeds:
        if KINDS[seed % len(KINDS)] not in rooms:
            continue
        case, rng = build(seed)
        with tempfile.TemporaryDirectory() as folder:
            write(case, rng, Path(folder))
            told, seconds = answer(binary, folder)
        facts = truth(case)
        group, mark, remark = judged(facts, told)
        tally.setdefault(group, []).append(mark)
        print(f"{seed} {facts['kind']} {group}: {mark} {told['verdict']} {remark} ({seconds:.1f} s)", flush=True)
    for group, marks in tally.items():
        print(group, {mark: marks.count(mark) for mark in sorted(set(marks))})


def answer(binary, folder):
    began = time.perf_counter()
    command = [str(Path(binary).resolve()), "discover", "--json", "machine.toml", "data.csv"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S)
    if not done.stdout:
        return {"verdict": f"refused {done.stderr[:100]}", "proposals": []}, 0.0
    return json.loads(done.stdout), time.perf_counter() - began


def judged(facts, told):
    """(group, mark, remark)."""
    shapes = [proposal["shape"] for proposal in told["proposals"]]
    if facts["expect"] == "nothing":
        return "nothing hidden", "none" if not shapes else "false", str(shapes)
    if not facts["formula"]:
        return "no formula of the grammar", "none" if not shapes else "another", str(shapes)
    if not shapes:
        return "formula", "none", str([effect["effect"] for effect in told.get("effects", [])])
    if shapes[0] not in facts["formula"] or len(shapes) > 1:
        return "formula", "another shape", str(shapes)
    found, gaps = told["proposals"][0]["parameters"], {}
    for name, true in facts["planted"][0]["parameters"].items():
        if name in found:
            gaps[name] = gap(found[name], true)
    right = all(abs(one) <= ERRORS for one in gaps.values())
    return "formula", "right" if right else "right shape, a value off", str({k: round(v, 1) for k, v in gaps.items()})


def gap(told, true):
    """Standard errors between a value and the truth; the sign of a size is that of the entry."""
    error = max(told["stderr"] or 0.0, SHARE * abs(true))
    return (abs(told["value"]) - abs(true)) / error
