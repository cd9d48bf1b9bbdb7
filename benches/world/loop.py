"""The closed loop as the report tells it: at every comparison the sign of the error chooses the motor's way."""

from dataclasses import dataclass

import numpy as np

from .shapes import play


@dataclass
class Loop:
    gain: float = 1.0  # true travel over counted travel
    lost_motion_um: float = 0.0
    lost: tuple = ()  # (instant, steps) that the motor did not take


def run(loop, machine, t, open_error, reading):
    """Recorder and counter at every comparison: `open_error` is the machine's, `reading` the meter's noise."""
    per = machine.step_hz * (t[1] - t[0])
    flank, count, owed = 0.0, 0.0, 0.0
    shown, counted = np.empty(len(t)), np.empty(len(t))
    for row in range(len(t)):
        missing = sum(steps for at, steps in loop.lost if t[row] >= at)
        wanted = machine.step_um * (count - missing)
        flank = min(max(flank, wanted - loop.lost_motion_um / 2), wanted + loop.lost_motion_um / 2)
        shown[row] = open_error[row] - loop.gain * flank + reading[row]
        counted[row] = count
        owed += per
        count += np.sign(shown[row]) * np.floor(owed)
        owed -= np.floor(owed)
    return shown, counted


def fallen_short(loop, machine, t, counted):
    """What the correction lacks against the counter: the actuator's own error as the table shows it."""
    missing = np.zeros(len(t))
    for at, steps in loop.lost:
        missing += steps * (t >= at)
    wanted = machine.step_um * (counted - missing)
    moved = play(wanted, loop.lost_motion_um) if loop.lost_motion_um else wanted
    return machine.step_um * counted - loop.gain * moved
