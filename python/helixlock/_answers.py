"""Results, and how a command is asked for them."""

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

from . import _native
from ._native import Table

StrPath: TypeAlias = str | os.PathLike[str]
"""A file."""
Quantity: TypeAlias = float | str
"""A number in the unit that its description names, or a text with a unit, such as ``"6 mm"``."""


class Answer(dict[str, Any]):
    """What a command finds: equal to what it prints with ``--json``; each key ends in its unit."""

    def __init__(self, result: Mapping[str, Any], parts: Mapping[str, Table | str]) -> None:
        super().__init__(result)
        vars(self).update(parts)


class Simulation(Answer):
    """A pass without and with the correction."""

    trace: Table
    """A row a comparison: `time_s`, `position_mm`, `error_um` as the recorder draws it,
    `raw_error_um`, `steps`, `lead_error_um`; the other run's columns carry a prefix."""


class Comparison(Answer):
    """A model against a measurement."""

    residual: Table
    """Measured less model, each pass about its own zero: `sensor` (its number in the result),
    `pass`, `time_s`, `position_mm` or `angle_rev`, `residual_um` or `residual_arcsec`."""
    spectrum: Table
    """Its amplitudes: `sensor`, `order` of the spindle, `amplitude_um` or `amplitude_arcsec`."""


class Diagnosis(Answer):
    """Which effects a model lacks, and how sure that is."""

    residual: Table
    """Measured less model, each pass about its own zero: `sensor`, `pass`, `time_s`, `position_mm`
    or `angle_rev`, `before_…` and `after_…` the effects that were found, in um or arcsec."""


class Discovery(Answer):
    """Formulas for what no effect of the catalogue explains."""

    machine: str
    """The machine file with them, and with the effects that were named beside them."""


class Learned(Diagnosis):
    """What a machine file lacked, and the better file."""

    machine: str
    """The machine file with what was found."""
    ledger: str
    """Every round with its machine file, as JSON."""


class Added(Answer):
    """An effect in a machine file; without `fit` there are no keys."""

    machine: str
    """The new machine file."""


class Sweep(Answer):
    """Simulations over ranges of values."""

    cases: Table
    """A row a case: `case`, each value with its unit, and the figures of the pass."""


class ScrewGrade(Answer):
    """The grade of a lead screw."""

    travel: Table
    """The useful travel: `position_mm`, `lead_error_um`."""


class Separation(Answer):
    """A guideway and a workpiece apart; with `plan` there are keys alone."""

    separated: Table
    """`position_mm`, `workpiece_um`, `carriage_um`, `tilt_urad`, `uncertainty_um`."""
    correction: Table
    """`position_mm`, `correction_um`."""


class TransmissionError(Answer):
    """A transmission error by each method."""

    error: Table
    """By the best method that worked: `time_s`, `output_turns`, `delta_arcsec`."""


class Image(Answer):
    """A table of positioning errors."""

    image: str
    """The image of the EEPROM, Intel HEX."""


class Applied(Answer):
    """Errors of a scale before and after compensation."""

    corrected: Table
    """`position_mm`, `error_um`, `direction`, `correction_um`, `steps`, `left_um`."""


A = TypeVar("A", bound=Answer)


def ask(
    kind: type[A],
    function: str,
    operands: Sequence[StrPath | None],
    options: Mapping[str, object],
) -> A:
    """Asks a command; an option that is `None` has the command's default."""
    words = [word for key, value in options.items() for word in _option(key, value)]
    words.append("--")
    words.extend(os.fspath(operand) for operand in operands if operand is not None)
    result, parts = _native.answer(function, words)
    return kind(json.loads(result), parts)


def _option(key: str, value: object) -> list[str]:
    if value is None or value is False:
        return []
    if value is True:
        return [f"--{key}"]
    if isinstance(value, str | os.PathLike) or not isinstance(value, Sequence):
        return [f"--{key}={os.fspath(value) if isinstance(value, os.PathLike) else value}"]
    return [word for each in value for word in _option(key, each)]
