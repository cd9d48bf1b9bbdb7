"""Runs the program on seeds, judges, and prints a table by kind."""

import json
import subprocess
import tempfile
import time
from multiprocessing import Pool
from pathlib import Path

from .build import build
from .judge import ASKED, ASKED_EVIDENCE, covered, judge
from .synth import truth, write

# Longest that a diagnosis may take before it counts as failed.
PATIENCE_S = 120


def answer_of(binary, folder):
    began = time.perf_counter()
    command = [str(binary), "diagnose", "--json", "machine.toml", "data.csv"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        return empty("failed", f"longer than {PATIENCE_S} s", PATIENCE_S)
    seconds = time.perf_counter() - began
    try:
        told = json.loads(done.stdout)
    except json.JSONDecodeError:
        return empty("refused" if done.returncode == 2 else "failed", done.stderr or done.stdout, seconds)
    return read(told, seconds)


def empty(verdict, error, seconds):
    return dict(verdict=verdict, effects=[], contenders=set(), doubts=[], proposals=[], error=error, seconds=seconds)


def read(told, seconds):
    contenders = {effect["effect"] for effect in told.get("effects", [])}
    for candidate in told.get("candidates", []):
        if candidate.get("confounded_with"):
            contenders |= {candidate["effect"], *candidate["confounded_with"]}
    return dict(verdict=told["verdict"], effects=told.get("effects", []), contenders=contenders,
                doubts=told.get("doubts", []), proposals=told.get("proposals", []), error="", seconds=seconds)


def score_one(job):
    seed, binary, keep = job
    case, rng = build(seed)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(keep) / str(seed) if keep else Path(folder)
        write(case, rng, folder)
        facts = truth(case)
        answer = answer_of(Path(binary).resolve(), folder)
    right, false, remark = judge(facts, answer)
    names = [effect["effect"] for effect in answer["effects"]]
    return {"seed": seed, **facts, "verdict": answer["verdict"], "effects": names,
            "contenders": sorted(answer["contenders"]), "right": right, "false": false, "remark": remark,
            "covered": covered(facts, answer), "seconds": round(answer["seconds"], 2)}


def score(seeds, binary, jobs, keep):
    work = [(seed, binary, keep) for seed in seeds]
    if jobs == 1:
        yield from map(score_one, work)
        return
    with Pool(jobs) as pool:
        yield from pool.imap(score_one, work)


def share(part, whole):
    return f"{part} of {whole}" + (f" ({100 * part / whole:.0f} %)" if whole else "")


def table(cases):
    """Markdown: totals, groups, named by level, coverage, time, then every kind."""
    lines = ["| what | |", "|---|---|"]
    total = len(cases)
    lines.append(f"| right | {share(sum(case['right'] for case in cases), total)} |")
    lines.append(f"| false names | {share(sum(bool(case['false']) for case in cases), total)} |")
    for group in sorted({case["expect"] for case in cases}):
        mine = [case for case in cases if case["expect"] == group]
        wrong = sum(bool(case["false"]) for case in mine)
        lines.append(f"| {group}: right | {share(sum(case['right'] for case in mine), len(mine))}, {wrong} false |")
    lines += levels(cases)
    gaps = [gap for case in cases for _, _, _, _, gap in case["covered"]]
    lines.append(f"| within two standard errors | {share(sum(abs(gap) <= 2 for gap in gaps), len(gaps))} |")
    spent = sorted(case["seconds"] for case in cases)
    times = f"{spent[total // 2]}, {spent[total * 95 // 100]}, {spent[-1]}"
    lines.append(f"| seconds a diagnosis: median, 95 %, most | {times} |")
    return "\n".join(lines + [""] + by_kind(cases)) + "\n"


def levels(cases):
    """Of single planted effects that the data can tell: the share named, by level asked."""
    out = []
    for low, high in ((2.5, 4), (4, 6.5), (7.9, 10), (10, 15), (15, 1e9)):
        mine = [case for case in cases if case["expect"] == "named" and len(case["planted"]) == 1
                and not case["planted"][0]["alike"] and low <= case["planted"][0]["level"] < high
                and (low < ASKED or case["planted"][0]["evidence"] >= ASKED_EVIDENCE)]
        named = sum(case["planted"][0]["effect"] in case["effects"] and case["verdict"] == "explained" for case in mine)
        band = f"{low:g} to {high:g}" if high < 1e9 else f"{low:g} and more"
        out.append(f"| one effect that the data can tell, {band} standard errors: named | {share(named, len(mine))} |")
    return out


def by_kind(cases):
    lines = ["| kind | cases | right | false | verdicts |", "|---|---|---|---|---|"]
    for kind in dict.fromkeys(case["kind"] for case in sorted(cases, key=lambda case: (case["expect"], case["kind"]))):
        mine = [case for case in cases if case["kind"] == kind]
        verdicts = sorted({case["verdict"] for case in mine})
        told = ", ".join(f"{verdict} {sum(case['verdict'] == verdict for case in mine)}" for verdict in verdicts)
        right, wrong = sum(case["right"] for case in mine), sum(bool(case["false"]) for case in mine)
        lines.append(f"| {kind} | {len(mine)} | {right} | {wrong} | {told} |")
    return lines
