"""Every function answers what its command prints, and its samples are those that it writes."""

import json
import subprocess
from pathlib import Path

import helixlock
import numpy as np
import pandas as pd
import pytest

from conftest import COMMAND, Printed

LENGTH = "6 mm"


def same(table: helixlock.Table, path: Path) -> None:
    """A table holds the numbers of a file that the command has written, to the last bit."""
    file = pd.read_csv(path)
    assert table.columns == list(file.columns)
    for name in table.columns:
        np.testing.assert_array_equal(np.asarray(table[name]), file[name].to_numpy())


def test_simulate(example: Path, printed: Printed, tmp_path: Path) -> None:
    machine = example / "sg7430-6mm/machine.toml"
    found = helixlock.simulate(machine, length=LENGTH)
    assert found == printed("sim", machine, "--length", LENGTH, "-o", tmp_path)
    same(found.trace, tmp_path / "trace.csv")


def test_compare(example: Path, printed: Printed) -> None:
    files = example / "encoder-1000-1024/machine.toml", example / "encoder-1000-1024/data.csv"
    found = helixlock.compare(*files)
    assert found == printed("compare", *files)
    for number, sensor in enumerate(found["sensors"]):
        residual = np.asarray(found.residual["residual_um"])
        residual = residual[np.asarray(found.residual["sensor"]) == number]
        assert len(residual) == sensor["samples"]
        assert np.sqrt(np.mean(residual**2)) == pytest.approx(sensor["rms_um"])
    assert found.spectrum.columns == ["sensor", "order", "amplitude_um"]


def test_diagnose_and_learn(example: Path, printed: Printed, tmp_path: Path) -> None:
    files = example / "encoder-1000-1024/machine.toml", example / "encoder-1000-1024/data.csv"
    diagnosed = helixlock.diagnose(*files)
    assert diagnosed == printed("diagnose", *files)
    learned = helixlock.learn(*files)
    assert learned == printed("learn", *files, "-o", tmp_path)
    assert learned.machine == (tmp_path / "machine.toml").read_text()
    assert learned.ledger == (tmp_path / "ledger.json").read_text()
    assert learned.residual.columns == diagnosed.residual.columns
    before, after = (np.asarray(learned.residual[name]) for name in ("before_um", "after_um"))
    assert np.std(after) < 0.01 * np.std(before)


def test_discover(example: Path, printed: Printed, tmp_path: Path) -> None:
    files = [example / "outside-the-catalogue" / name for name in ("machine.toml", "data.csv")]
    new = tmp_path / "new.toml"
    found = helixlock.discover(*files)
    assert found == printed("discover", *files, "-o", new)
    assert found.machine == new.read_text()


def test_diagnose_with_own_formula(example: Path, printed: Printed) -> None:
    files = [example / "outside-the-catalogue" / name for name in ("machine.toml", "data.csv")]
    own = example / "outside-the-catalogue/rack.toml"
    assert helixlock.diagnose(*files, with_=own) == printed("diagnose", *files, "--with", own)


def test_add(example: Path, printed: Printed, tmp_path: Path) -> None:
    machine, data = example / "hidden-gear/machine.toml", example / "hidden-gear/data.csv"
    new = tmp_path / "new.toml"
    added = helixlock.add(machine, "gear-error", fit=data)
    assert added == printed("add", machine, "gear-error", "--fit", data, "-o", new)
    assert added.machine == new.read_text()
    given = helixlock.add(machine, "screw-periodic", set=["amplitude=1.5 um", "phase=30 deg"])
    assert given == {}
    assert 'amplitude = "1.5 um"' in given.machine


def test_sweep(example: Path, tmp_path: Path) -> None:
    machine = example / "sg7430-6mm/machine.toml"
    found = helixlock.sweep(machine, set="drive.frequency=80,160 Hz", length=0.5)
    assert found == {"cases": 2, "failures": []}
    output = tmp_path / "out.csv"
    words = ["sweep", str(machine), "--set", "drive.frequency=80,160 Hz", "--length", "0.5"]
    subprocess.run([COMMAND, *words, "-o", output], check=True)
    same(found.cases, output)


def test_screw(example: Path, printed: Printed) -> None:
    data = example / "ball-screw-grade/screw.csv"
    found = helixlock.screw(data, lead="2 mm", run_out=30, grade="3")
    assert found == printed("screw", data, "--lead", "2 mm", "--run-out", "30 mm", "--grade", "3")
    assert len(found.travel) == found["samples"]


def test_straightness(example: Path, printed: Printed, tmp_path: Path) -> None:
    data = example / "lathe-straightness/probes.csv"
    found = helixlock.straightness(data, spacing=["45 mm", "40 mm"], simulate=True)
    words = ("straightness", data, "--spacing", "45 mm,40 mm", "--simulate", "-o", tmp_path)
    assert found == printed(*words)
    same(found.separated, tmp_path / "separated.csv")
    same(found.correction, tmp_path / "correction.csv")
    plan = helixlock.straightness(None, plan=True, spacing="45 mm,40 mm")
    assert plan == printed("straightness", "--plan", "--spacing", "45 mm,40 mm")


def test_transmission(example: Path, printed: Printed, tmp_path: Path) -> None:
    data = example / "transmission-error/pulses.csv"
    found = helixlock.transmission(
        data, input_lines=200, output_lines=720, ratio=36, shaft=["worm=36", "wheel=1"]
    )
    words: list[object] = ["transmission", data, "--input-lines", 200, "--output-lines", 720]
    words += ["--ratio", "36", "--shaft", "worm=36", "--shaft", "wheel=1", "-o", tmp_path]
    assert found == printed(*words)
    same(found.error, tmp_path / "error.csv")


def test_scale(example: Path, printed: Printed, tmp_path: Path) -> None:
    data = example / "inductosyn-scale/table.csv"
    image = tmp_path / "table.hex"
    built = helixlock.scale_build(data, joint_zone=8)
    assert built == printed("scale", "build", data, "--joint-zone", "8 mm", "-o", image)
    assert built.image == image.read_text()
    check = example / "inductosyn-scale/check.csv"
    applied = helixlock.scale_apply(image, check, scheme="display")
    folder = tmp_path / "report"
    words = ("scale", "apply", image, check, "--scheme", "display", "-o", folder)
    assert applied == printed(*words)
    assert len(applied.corrected) == applied["samples"]
    axis = example / "inductosyn-scale/axis.csv"
    assert helixlock.scale_iso230(axis) == printed("scale", "iso230", axis)
    assert helixlock.scale_model(seed=4) == printed("scale", "model", "--seed", "4")


def test_results_are_plain_json(example: Path) -> None:
    found = helixlock.scale_model()
    assert json.loads(json.dumps(found)) == found
