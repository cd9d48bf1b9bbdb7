"""The commands as functions, written from their words: do not edit."""

from collections.abc import Sequence
from typing import Literal

from ._answers import (
    Added,
    Answer,
    Applied,
    Comparison,
    Diagnosis,
    Discovery,
    Image,
    Learned,
    Quantity,
    ScrewGrade,
    Separation,
    Simulation,
    StrPath,
    Sweep,
    TransmissionError,
    ask,
)

__all__ = [
    "simulate",
    "compare",
    "diagnose",
    "discover",
    "add",
    "learn",
    "sweep",
    "screw",
    "straightness",
    "transmission",
    "scale_build",
    "scale_apply",
    "scale_iso230",
    "scale_model",
]


def simulate(
    machine: StrPath,
    *,
    length: Quantity | None = None,
) -> Simulation:
    """Grind a workpiece clock by clock, without and with the correction.

    machine:
        Machine file
    length:
        Grind only the first so many millimetres

    The keys are those of `helixlock sim --json`.
    """
    return ask(
        Simulation,
        "simulate",
        [machine],
        {
            "length": length,
        },
    )


def compare(
    machine: StrPath,
    data: StrPath,
    *,
    grating_signal: str | None = None,
    laser_signal: str | None = None,
    step_signal: str | None = None,
    forward_signal: str | None = None,
) -> Comparison:
    """Show where a machine file and a measurement part.

    machine:
        Machine file
    data:
        Measured data: CSV or Parquet with `error_um`, `lead_error_um`, `steps` or `error_arcsec`
        over `position_mm`, `time_s` or `angle_rev`; or a VCD capture of grating and laser
    grating_signal:
        In a VCD capture, the signal of the grating lines
    laser_signal:
        In a VCD capture, the signal of the laser fringes
    step_signal:
        In a VCD capture, the signal of the motor's steps
    forward_signal:
        In a VCD capture, the signal that is high when a step goes forward

    The keys are those of `helixlock compare --json`.
    """
    return ask(
        Comparison,
        "compare",
        [machine, data],
        {
            "grating-signal": grating_signal,
            "laser-signal": laser_signal,
            "step-signal": step_signal,
            "forward-signal": forward_signal,
        },
    )


def diagnose(
    machine: StrPath,
    data: StrPath,
    *,
    grating_signal: str | None = None,
    laser_signal: str | None = None,
    step_signal: str | None = None,
    forward_signal: str | None = None,
    with_: StrPath | None = None,
) -> Diagnosis:
    """Name the effects that a machine file lacks, with evidence, rivals, and the experiment that tells.

    machine:
        Machine file
    data:
        Measured data: CSV or Parquet with `error_um`, `lead_error_um`, `steps` or `error_arcsec`
        over `position_mm`, `time_s` or `angle_rev`; or a VCD capture of grating and laser
    grating_signal:
        In a VCD capture, the signal of the grating lines
    laser_signal:
        In a VCD capture, the signal of the laser fringes
    step_signal:
        In a VCD capture, the signal of the motor's steps
    forward_signal:
        In a VCD capture, the signal that is high when a step goes forward
    with_:
        TOML file with custom effects to try beside the catalogue

    The keys are those of `helixlock diagnose --json`.
    """
    return ask(
        Diagnosis,
        "diagnose",
        [machine, data],
        {
            "grating-signal": grating_signal,
            "laser-signal": laser_signal,
            "step-signal": step_signal,
            "forward-signal": forward_signal,
            "with": with_,
        },
    )


def discover(
    machine: StrPath,
    data: StrPath,
    *,
    grating_signal: str | None = None,
    laser_signal: str | None = None,
    step_signal: str | None = None,
    forward_signal: str | None = None,
) -> Discovery:
    """Propose a formula for what no effect of the catalogue explains.

    machine:
        Machine file
    data:
        Measured data: CSV or Parquet with `error_um`, `lead_error_um`, `steps` or `error_arcsec`
        over `position_mm`, `time_s` or `angle_rev`; or a VCD capture of grating and laser
    grating_signal:
        In a VCD capture, the signal of the grating lines
    laser_signal:
        In a VCD capture, the signal of the laser fringes
    step_signal:
        In a VCD capture, the signal of the motor's steps
    forward_signal:
        In a VCD capture, the signal that is high when a step goes forward

    The keys are those of `helixlock discover --json`.
    """
    return ask(
        Discovery,
        "discover",
        [machine, data],
        {
            "grating-signal": grating_signal,
            "laser-signal": laser_signal,
            "step-signal": step_signal,
            "forward-signal": forward_signal,
        },
    )


def add(
    machine: StrPath,
    effect: str | None,
    *,
    formula: str | None = None,
    entry: str | None = None,
    name: str | None = None,
    fit: StrPath | None = None,
    refit: bool = False,
    keep: int | None = None,
    set: str | Sequence[str] | None = None,
    grating_signal: str | None = None,
    laser_signal: str | None = None,
    step_signal: str | None = None,
    forward_signal: str | None = None,
) -> Added:
    """Put an effect into a machine file, its parameters fitted to data.

    machine:
        Machine file
    effect:
        Name of an effect of the catalogue, or a TOML file with one `[[effect]]`, such as a custom
        one
    formula:
        A formula as a `custom` effect, such as `k*ramp(position_mm - at_mm)`: words that are no
        columns are its parameters
    entry:
        Where the formula enters [default: motion]
    name:
        What the formula is called [default: formula]
    fit:
        Measured data to fit its parameters to
    refit:
        Fit the effects that the machine file has already along with it
    keep:
        With `--refit`, leave the first N effects of the machine file as they are [default: 0]
    set:
        A parameter, such as `amplitude="1.5 um"`; with `--fit` only where a formula's search begins
    grating_signal:
        In a VCD capture, the signal of the grating lines
    laser_signal:
        In a VCD capture, the signal of the laser fringes
    step_signal:
        In a VCD capture, the signal of the motor's steps
    forward_signal:
        In a VCD capture, the signal that is high when a step goes forward

    The keys are those of `helixlock add --json`.
    """
    return ask(
        Added,
        "add",
        [machine, effect],
        {
            "formula": formula,
            "entry": entry,
            "name": name,
            "fit": fit,
            "refit": refit,
            "keep": keep,
            "set": set,
            "grating-signal": grating_signal,
            "laser-signal": laser_signal,
            "step-signal": step_signal,
            "forward-signal": forward_signal,
        },
    )


def learn(
    machine: StrPath,
    data: StrPath,
    *,
    with_: StrPath | None = None,
    accept: bool = False,
    grating_signal: str | None = None,
    laser_signal: str | None = None,
    step_signal: str | None = None,
    forward_signal: str | None = None,
) -> Learned:
    """Find what a machine file lacks and write the better file, its ledger and a report.

    machine:
        Machine file
    data:
        Measured data
    with_:
        TOML file with custom effects to try beside the catalogue
    accept:
        Add what was found even if others explain it alike, or something is left that none accounts
        for
    grating_signal:
        In a VCD capture, the signal of the grating lines
    laser_signal:
        In a VCD capture, the signal of the laser fringes
    step_signal:
        In a VCD capture, the signal of the motor's steps
    forward_signal:
        In a VCD capture, the signal that is high when a step goes forward

    The keys are those of `helixlock learn --json`.
    """
    return ask(
        Learned,
        "learn",
        [machine, data],
        {
            "with": with_,
            "accept": accept,
            "grating-signal": grating_signal,
            "laser-signal": laser_signal,
            "step-signal": step_signal,
            "forward-signal": forward_signal,
        },
    )


def sweep(
    machine: StrPath,
    *,
    set: str | Sequence[str] | None = None,
    draw: str | Sequence[str] | None = None,
    samples: int | None = None,
    seed: int | None = None,
    length: Quantity | None = None,
) -> Sweep:
    """Simulate many machines: any value of the file over a range, or by chance.

    machine:
        Machine file
    set:
        A key of the machine file and its values: `drive.frequency=80,160 Hz`, or eight values
        `drive.frequency=40..320:8 Hz`; effects are counted from 0: `effect.0.amplitude=1,2 um`
    draw:
        A key of the machine file and bounds to draw from: `effect.0.amplitude=0.5..3 um`
    samples:
        Draws at every point of the grid [default: 1]
    seed:
        Seed of the draws [default: 1]
    length:
        Grind only the first so many millimetres

    The keys are those of `helixlock sweep --json`.
    """
    return ask(
        Sweep,
        "sweep",
        [machine],
        {
            "set": set,
            "draw": draw,
            "samples": samples,
            "seed": seed,
            "length": length,
        },
    )


def screw(
    data: StrPath,
    *,
    standard: Literal["iso3408-3", "jbt2886"] | None = None,
    lead: Quantity,
    from_: Quantity | None = None,
    to: Quantity | None = None,
    run_out: Quantity | None = None,
    compensation: Quantity | None = None,
    uncertainty: Quantity | None = None,
    reading_noise: Quantity | None = None,
    sheet: StrPath | None = None,
    seed: int | None = None,
    grade: str | None = None,
    weighting: Literal["samples", "travel"] | None = None,
    table: StrPath | None = None,
    pass_: Quantity | None = None,
) -> ScrewGrade:
    """Grade a lead screw from its travel deviation.

    data:
        Measured travel deviation
    standard:
        Standard to grade by [default: iso3408-3]
    lead:
        Lead, such as "5 mm", "1/6 in", "0.5 pi mm"
    from_:
        Begin of the useful travel, mm [default: first sample]
    to:
        End of the useful travel, mm [default: last sample]
    run_out:
        Thread run-out to leave out at each end, mm
    compensation:
        Travel compensation asked for over the useful travel, µm [default: 0]
    uncertainty:
        Standard uncertainty (k = 1) of each characteristic, µm: gives every grade its probability
    reading_noise:
        Standard deviation of a single reading, independent from reading to reading, µm: takes off
        what noise adds to each characteristic, and gives it an uncertainty and every grade a
        probability
    sheet:
        What is known of the measurement, tolerances, and what is printed on the sheet: gives every
        figure its uncertainty, and the grade asked for is decided by ISO 14253-1
    seed:
        Seed of the curves that `--reading-noise` draws; equal seeds give equal results [default: 1]
    grade:
        Grade the screw has to meet
    weighting:
        What a sample counts for in the mean line [default: samples]
    table:
        Tolerance table of your own instead of the one shipped
    pass_:
        Pass to evaluate, when the file holds several

    The keys are those of `helixlock screw --json`.
    """
    return ask(
        ScrewGrade,
        "screw",
        [data],
        {
            "standard": standard,
            "lead": lead,
            "from": from_,
            "to": to,
            "run-out": run_out,
            "compensation": compensation,
            "uncertainty": uncertainty,
            "reading-noise": reading_noise,
            "sheet": sheet,
            "seed": seed,
            "grade": grade,
            "weighting": weighting,
            "table": table,
            "pass": pass_,
        },
    )


def straightness(
    data: StrPath | None,
    *,
    spacing: Quantity | Sequence[Quantity] | None = None,
    plan: bool = False,
    samples: int | None = None,
    step: Quantity | None = None,
    longest: Quantity | None = None,
    method: Literal["fourier", "least-squares"] | None = None,
    zeros_matched: bool = False,
    accept_lost_harmonics: bool = False,
    limit: Quantity | None = None,
    sheet: StrPath | None = None,
    table_step: Quantity | None = None,
    simulate: bool = False,
    unrepeatable: Quantity | None = None,
    correlation: Quantity | None = None,
    corrector_step: Quantity | None = None,
    seed: int | None = None,
) -> Separation:
    """Separate a guideway and a workpiece by three probes.

    data:
        Readings of the three probes; not needed with `--plan`
    spacing:
        Probe spacings L1 and L2, such as "25 mm,30 mm"
    plan:
        Show what spacings do to each harmonic, and propose better ones
    samples:
        Samples of the stroke (with `--plan`) [default: 32]
    step:
        Sampling step, mm (with `--plan`) [default: 5 mm]
    longest:
        Longest distance from probe 1 to probe 3 to propose, mm [default: a third of the stroke]
    method:
        Method whose result makes the correction table and is held against `--limit` [default:
        fourier]
    zeros_matched:
        The probes' zeros are matched: the bar's parabola is measured, not assumed
    accept_lost_harmonics:
        Go on although the spacings lose harmonics; those are left at zero
    limit:
        Straightness of the bar (minimum zone) that must not be exceeded, µm
    sheet:
        What is known of the measurement, tolerances, and what is printed on the sheet: gives the
        straightness its uncertainty, and decides tolerances by ISO 14253-1
    table_step:
        Step of the correction table, mm [default: 1 mm]
    simulate:
        Simulate cutting the next bar with the correction
    unrepeatable:
        Carriage motion that does not repeat, standard deviation, µm [default: from the runs]
    correlation:
        Length over which that motion stays alike, mm [default: 20 mm]
    corrector_step:
        Smallest motion of the corrector, µm [default: 0.01 um]
    seed:
        Seed of the simulation [default: 1]

    The keys are those of `helixlock straightness --json`.
    """
    return ask(
        Separation,
        "straightness",
        [data],
        {
            "spacing": spacing,
            "plan": plan,
            "samples": samples,
            "step": step,
            "longest": longest,
            "method": method,
            "zeros-matched": zeros_matched,
            "accept-lost-harmonics": accept_lost_harmonics,
            "limit": limit,
            "sheet": sheet,
            "table-step": table_step,
            "simulate": simulate,
            "unrepeatable": unrepeatable,
            "correlation": correlation,
            "corrector-step": corrector_step,
            "seed": seed,
        },
    )


def transmission(
    capture: StrPath,
    *,
    method: Literal["all", "analog", "digital", "subdivided", "counting", "subdivided-counting"] | None = None,
    input_lines: int,
    output_lines: int,
    ratio: Quantity | None = None,
    input_signal: str | None = None,
    output_signal: str | None = None,
    clock: Quantity | None = None,
    range_divider: int | None = None,
    recorder: Quantity | None = None,
    shaft: str | Sequence[str] | None = None,
    machine: StrPath | None = None,
    truth: StrPath | None = None,
    lead: Quantity | None = None,
    limit: Quantity | None = None,
) -> TransmissionError:
    """Measure a transmission error from two pulse trains.

    capture:
        Pulses: value change dump, CSV or Parquet
    method:
        Method [default: all]
    input_lines:
        Pulses a turn of the input
    output_lines:
        Pulses a turn of the output
    ratio:
        Turns of the input for one turn of the output, such as 36 or 5/2 [default: 1]
    input_signal:
        Signal or column of the input
    output_signal:
        Signal or column of the output
    clock:
        Clock that subdivides pulses [default: 12 MHz]
    range_divider:
        Further division for the analog and the digital method: more range, fewer samples [default:
        1]
    recorder:
        Time constant of the analog method's recorder [default: 0.05 s]
    shaft:
        Shaft by its turns for one turn of the output, such as worm=36; may be repeated
    machine:
        Machine file whose gears name the orders
    truth:
        True error, `output_turns` and `delta_arcsec`, to hold the methods against
    lead:
        Lead, when the output is a length: the hand-over file is in mm and µm
    limit:
        Peak-to-peak error that must not be exceeded, arcsec

    The keys are those of `helixlock transmission --json`.
    """
    return ask(
        TransmissionError,
        "transmission",
        [capture],
        {
            "method": method,
            "input-lines": input_lines,
            "output-lines": output_lines,
            "ratio": ratio,
            "input-signal": input_signal,
            "output-signal": output_signal,
            "clock": clock,
            "range-divider": range_divider,
            "recorder": recorder,
            "shaft": shaft,
            "machine": machine,
            "truth": truth,
            "lead": lead,
            "limit": limit,
        },
    )


def scale_build(
    data: StrPath,
    *,
    origin: Quantity | None = None,
    step: Quantity | None = None,
    lsb: Quantity | None = None,
    joint: Quantity | None = None,
    joint_zone: Quantity | None = None,
) -> Image:
    """Make the EEPROM image from measured errors.

    data:
        Measured errors
    origin:
        Position of the origin pulse, mm: the table counts from there [default: 0]
    step:
        Distance of the table's places, mm [default: 1 mm]
    lsb:
        Weight of the least of the eight bits, µm [default: 0.1 um]
    joint:
        Length of one scale, mm: joints are looked for at its multiples [default: 250 mm]
    joint_zone:
        Length about each joint that is bridged from both sides, mm; samples there are not used

    The keys are those of `helixlock scale build --json`.
    """
    return ask(
        Image,
        "scale_build",
        [data],
        {
            "origin": origin,
            "step": step,
            "lsb": lsb,
            "joint": joint,
            "joint-zone": joint_zone,
        },
    )


def scale_apply(
    image: StrPath,
    data: StrPath,
    *,
    scheme: Literal["step", "display"] | None = None,
    step_size: Quantity | None = None,
    resolution: Quantity | None = None,
    interpolate: bool = False,
    origin: Quantity | None = None,
    limit: Quantity | None = None,
) -> Applied:
    """Take the errors off measured ones, by a table.

    image:
        EEPROM image, Intel HEX or binary
    data:
        Measured errors
    scheme:
        Who takes the errors off [default: step]
    step_size:
        Motion of one step of the corrector, µm [default: 0.1 um]
    resolution:
        Resolution of the display, µm [default: 0.5 um]
    interpolate:
        Read the table by straight lines between its places, not by the nearest place
    origin:
        Position of the origin pulse, mm [default: 0]
    limit:
        Largest error that may be left, µm; exit status 1 beyond

    The keys are those of `helixlock scale apply --json`.
    """
    return ask(
        Applied,
        "scale_apply",
        [image, data],
        {
            "scheme": scheme,
            "step-size": step_size,
            "resolution": resolution,
            "interpolate": interpolate,
            "origin": origin,
            "limit": limit,
        },
    )


def scale_iso230(
    data: StrPath,
    *,
    limit: Quantity | None = None,
    expanded_uncertainty: Quantity | None = None,
    sheet: StrPath | None = None,
) -> Answer:
    """Evaluate positioning accuracy by ISO 230-2.

    data:
        Measured errors: two approaches or more of every target and direction
    limit:
        Accuracy A that must not be exceeded, µm; exit status 1 beyond
    expanded_uncertainty:
        Expanded uncertainty of A (k = 2), µm: the limit is then decided by ISO 14253-1
    sheet:
        What is known of the measurement, tolerances, and what is printed on the sheet

    The keys are those of `helixlock scale iso230 --json`.
    """
    return ask(
        Answer,
        "scale_iso230",
        [data],
        {
            "limit": limit,
            "expanded-uncertainty": expanded_uncertainty,
            "sheet": sheet,
        },
    )


def scale_model(
    *,
    length: Quantity | None = None,
    long_wave: Quantity | None = None,
    interpolation: Quantity | None = None,
    interpolation_phase: Quantity | None = None,
    reversal: Quantity | None = None,
    scatter: Quantity | None = None,
    lsb: Quantity | None = None,
    step: Quantity | None = None,
    step_size: Quantity | None = None,
    seed: int | None = None,
) -> Answer:
    """Model a scale of ±5.5 µm, compensate it, and show what limits the rest.

    length:
        Length of the scale, mm [default: 250 mm]
    long_wave:
        Amplitude of the slow error, µm [default: 4.7 um]
    interpolation:
        Amplitude of the interpolation error, one period a pitch of 2 mm, µm [default: 0.55 um]
    interpolation_phase:
        Phase of the interpolation error at the places of the table, degrees [default: 0]
    reversal:
        Error forward less error backward, µm [default: 0.4 um]
    scatter:
        Scatter of a sample, standard deviation, µm [default: 0.1 um]
    lsb:
        Weight of the least of the eight bits, µm [default: 0.1 um]
    step:
        Distance of the table's places, mm [default: 1 mm]
    step_size:
        Motion of one step of the corrector, µm [default: 0.1 um]
    seed:
        Seed of the scatter [default: 3]

    The keys are those of `helixlock scale model --json`.
    """
    return ask(
        Answer,
        "scale_model",
        [],
        {
            "length": length,
            "long-wave": long_wave,
            "interpolation": interpolation,
            "interpolation-phase": interpolation_phase,
            "reversal": reversal,
            "scatter": scatter,
            "lsb": lsb,
            "step": step,
            "step-size": step_size,
            "seed": seed,
        },
    )
