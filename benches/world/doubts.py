"""How often sound data are doubted, and mistakes are not: `compare` on this world, and on the program's own challenges."""

import json
import subprocess
import tempfile
from multiprocessing import Pool
from pathlib import Path

from .build import build
from .score import share
from .synth import write

# What `truth.json` expects of files that hold a mistake of input.
MISTAKES = {"doubt", "setting"}


def doubts_of(binary, folder):
    """Kinds of doubt that `compare` has, or its refusal."""
    command = [binary, "compare", "--json", "machine.toml", "data.csv"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode == 2:
        return ["refused"]
    return [f"{doubt['what']} {doubt['evidence']:.0f}" for doubt in json.loads(done.stdout)["doubts"]]


def of_world(seed, binary):
    case, rng = build(seed)
    with tempfile.TemporaryDirectory() as folder:
        write(case, rng, Path(folder))
        return seed, case.kind, case.expect in MISTAKES, doubts_of(binary, folder)


def of_challenge(seed, binary):
    with tempfile.TemporaryDirectory() as folder:
        command = [binary, "challenge", "--seed", str(seed), "-o", folder]
        subprocess.run(command, check=True, capture_output=True)
        return seed, "challenge", False, doubts_of(binary, folder)


def told_of(job):
    of, seed, binary = job
    return of(seed, binary)


def doubts(seeds, challenges, binary, jobs):
    """Prints every sound file that is doubted, every mistake that is not, and how many there are."""
    binary = str(Path(binary).resolve())
    told = []
    with Pool(jobs) as pool:
        jobs = [(of_world, seed, binary) for seed in seeds] + [(of_challenge, seed, binary) for seed in challenges]
        for one in pool.imap(told_of, jobs):
            told.append(one)
            seed, kind, mistaken, found = one
            if bool(found) != mistaken:
                print(f"{seed} {kind}: {', '.join(found) or 'no doubt'}", flush=True)
    for word, mine in (("sound", [one for one in told if not one[2]]), ("mistaken", [one for one in told if one[2]])):
        own = sum(kind == "challenge" for _, kind, _, _ in mine)
        print(f"{word}: {len(mine)}, {own} of them challenges; doubted {share(sum(bool(one[3]) for one in mine), len(mine))}")
