"""What is refused raises `helixlock.Error`, which knows the place."""

from pathlib import Path

import helixlock
import pytest

MACHINE = "sg7430-6mm/machine.toml"


def test_a_value_of_a_machine_file(example: Path, tmp_path: Path) -> None:
    text = (example / MACHINE).read_text()
    lines = text.splitlines()
    number = next(n for n, line in enumerate(lines) if line.startswith("speed"))
    lines[number] = 'speed = "4 mm"'
    machine = tmp_path / "machine.toml"
    machine.write_text("\n".join(lines))
    with pytest.raises(helixlock.Error) as refused:
        helixlock.simulate(machine)
    error = refused.value
    assert (error.file, error.line, error.key) == (machine, number + 1, "spindle.speed")
    assert error.column is not None
    assert str(error).startswith(f"{machine}:{number + 1}:{error.column}: `spindle.speed`")


def test_a_cell_of_a_table(example: Path, tmp_path: Path) -> None:
    data = tmp_path / "data.csv"
    data.write_text("position_mm,error_um\n0,0\n1,0\n2,0.2.3\n")
    with pytest.raises(helixlock.Error) as refused:
        helixlock.compare(example / MACHINE, data)
    assert (refused.value.file, refused.value.line) == (data, 4)
    assert refused.value.key == "error_um"


def test_a_row_of_a_metrology_file(tmp_path: Path) -> None:
    data = tmp_path / "screw.csv"
    data.write_text("position_mm,lead_error_um\n0,0\n1,0\n0.5,0\n")
    with pytest.raises(helixlock.Error) as refused:
        helixlock.screw(data, lead=2)
    assert (refused.value.file, refused.value.line) == (data, 4)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(helixlock.Error, match="cannot be read") as refused:
        helixlock.simulate(tmp_path / "none.toml")
    assert (refused.value.file, refused.value.line) == (tmp_path / "none.toml", None)


def test_an_option(example: Path) -> None:
    with pytest.raises(helixlock.Error, match="expected more than 0") as refused:
        helixlock.simulate(example / MACHINE, length="0 mm")
    assert (refused.value.key, refused.value.file) == ("--length", None)
    assert isinstance(refused.value, ValueError)


def test_an_unknown_option_is_a_type_error(example: Path) -> None:
    with pytest.raises(TypeError):
        helixlock.simulate(example / MACHINE, lenght="6 mm")  # type: ignore[call-arg]
