"""python3 -m world generate --seed 7 -o DIR
python3 -m world score --seeds 1..400 --binary ../target/release/helixlock [-j 2] [-o DIR] [--keep DIR]
python3 -m world formulas --seeds 1..400 --binary ../target/release/helixlock [--keep DIR]
python3 -m world doubts --seeds 1..600 --challenges 1..300 --binary ../target/release/helixlock [-j 2]
python3 -m world check --seeds 1..200
python3 -m world kinds
"""

import argparse
import json
import sys
from pathlib import Path

from .build import build
from .check import check
from .doubts import doubts
from .formulas import formulas
from .scenes import KINDS
from .score import score, table
from .synth import write


def main():
    words = argparse.ArgumentParser(prog="world", description=__doc__)
    commands = words.add_subparsers(dest="command", required=True)
    one = commands.add_parser("generate", help="machine.toml, data.csv and truth.json of one seed")
    one.add_argument("--seed", type=int, required=True)
    one.add_argument("-o", "--output", type=Path, required=True)
    many = commands.add_parser("score", help="diagnose many seeds and print a table")
    many.add_argument("--seeds", type=seeds, required=True, help="first..last")
    many.add_argument("--binary", required=True)
    many.add_argument("-j", "--jobs", type=int, default=1)
    many.add_argument("-o", "--output", type=Path, help="folder for cases.json and table.md")
    many.add_argument("--keep", type=Path, help="folder that keeps every case's files")
    many.add_argument("--kind", help="only kinds whose name holds this")
    shapes = commands.add_parser("formulas", help="`discover` on shapes outside the catalogue, and on nothing hidden")
    shapes.add_argument("--seeds", type=seeds, required=True, help="first..last")
    shapes.add_argument("--binary", required=True)
    shapes.add_argument("--kind", default="", help="only kinds whose name holds this")
    sound = commands.add_parser("doubts", help="how often sound data are doubted, and mistakes are not")
    sound.add_argument("--seeds", type=seeds, required=True, help="first..last")
    sound.add_argument("--challenges", type=seeds, default=range(0), help="first..last of `helixlock challenge`")
    sound.add_argument("--kind", default="", help="only kinds whose name holds this")
    sound.add_argument("--binary", required=True)
    sound.add_argument("-j", "--jobs", type=int, default=1)
    self_check = commands.add_parser("check", help="the generator against the documents' formulas")
    self_check.add_argument("--seeds", type=seeds, required=True, help="first..last")
    commands.add_parser("kinds", help="the kinds of scene")
    told = words.parse_args()
    {"generate": generate, "score": run, "check": against, "formulas": discovered, "doubts": doubted, "kinds": kinds}[told.command](told)


def seeds(text):
    first, _, last = text.partition("..")
    return range(int(first), int(last or first) + 1)


def generate(told):
    case, rng = build(told.seed)
    write(case, rng, told.output)
    print(f"{told.output}: {case.kind}")


def run(told):
    wanted = [seed for seed in told.seeds if not told.kind or told.kind in KINDS[seed % len(KINDS)].__name__]
    cases = []
    for case in score(wanted, told.binary, told.jobs, told.keep):
        cases.append(case)
        mark = "false" if case["false"] else "right" if case["right"] else "wrong"
        print(f"{case['seed']} {case['kind']} {mark} {case['verdict']} {case['effects']} {case['remark']}",
              file=sys.stderr, flush=True)
    if told.output:
        told.output.mkdir(parents=True, exist_ok=True)
        (told.output / "cases.json").write_text(json.dumps(cases, indent=1) + "\n")
        (told.output / "table.md").write_text(table(cases))
    print(table(cases), end="")


def discovered(told):
    wanted = [seed for seed in told.seeds if told.kind in KINDS[seed % len(KINDS)].__name__]
    formulas(wanted, told.binary)


def doubted(told):
    wanted = [seed for seed in told.seeds if told.kind in KINDS[seed % len(KINDS)].__name__]
    doubts(wanted, told.challenges, told.binary, told.jobs)


def against(told):
    gaps = []
    for line, gap in check(told.seeds):
        gaps.append(abs(gap))
        print(line)
    print(f"{len(gaps)} planted curves, rms {sum(gap**2 for gap in gaps) ** 0.5 / max(1, len(gaps)) ** 0.5:.2f} "
          f"errors from 1, most {max(gaps, default=0):.1f}")


def kinds(_):
    for scene in KINDS:
        print(scene.__name__, "–", (scene.__doc__ or "").strip().split("\n")[0])


main()
