"""The generated device, driven through its pins as someone would who never saw its source."""

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, Timer, with_timeout

CLOCK_NS = 80
FRINGE_CLOCKS = 24
A, B = 110, 150  # dividers of examples/sg7430-6mm, range x2
PERIOD_CLOCKS = 2 * B * FRINGE_CLOCKS  # of one comparison

INPUTS = (
    "grating laser start correct playback calibrate manual_step manual_forward".split()
)


async def power_up(dut):
    """All switches off; the power-on reset is over after 16 clocks."""
    for name in INPUTS:
        getattr(dut, name).value = 0
    cocotb.start_soon(Clock(dut.clock, CLOCK_NS, unit="ns").start())
    await ClockCycles(dut.clock, 20)


async def pulses(pin, period_ps):
    """Square wave without relation to the clock."""
    half_ps = round(period_ps / 2)
    while True:
        pin.value = 1
        await Timer(half_ps, unit="ps")
        pin.value = 0
        await Timer(half_ps, unit="ps")


def phases(dut):
    return tuple(int(pin.value) for pin in (dut.phase_a, dut.phase_b, dut.phase_c))


async def one_step(dut):
    """Presses the button; the step comes with the next tick of the step clock."""
    dut.manual_step.value = 1
    await ClockCycles(dut.clock, 6)
    dut.manual_step.value = 0
    if int(dut.step.value) == 0:
        await with_timeout(RisingEdge(dut.step), 100, "ms")
    await FallingEdge(dut.step)


@cocotb.test()
async def the_phase_starts_in_the_middle(dut):
    """An initial phase of 150 pulses at B = 150, x2 is 180 degrees: T1 is high half the time."""
    await power_up(dut)
    fringe_ps = 1000 * CLOCK_NS * FRINGE_CLOCKS
    cocotb.start_soon(pulses(dut.laser, fringe_ps))
    cocotb.start_soon(pulses(dut.grating, fringe_ps * B / A))
    dut.start.value = 1
    await with_timeout(RisingEdge(dut.measuring), 10, "ms")
    await ClockCycles(dut.clock, 2 * PERIOD_CLOCKS)
    high = 0
    for _ in range(PERIOD_CLOCKS):
        await RisingEdge(dut.clock)
        high += int(dut.t1.value)
        assert int(dut.t2.value) == 1 - int(dut.t1.value)
    duty = high / PERIOD_CLOCKS
    dut._log.info("T1 is high %.2f %% of the time", 100 * duty)
    # A fringe is 0.33 %; the first line after the gate opens may come up to a line late.
    assert abs(duty - 0.5) < 0.01


@cocotb.test()
async def steps_follow_the_half_step_sequence_and_play_back(dut):
    """A, AB, B, BC forward; the playback goes the same way back and stops at zero."""
    await power_up(dut)
    assert phases(dut) == (1, 0, 0)
    assert int(dut.zero.value) == 1
    dut.manual_forward.value = 1
    for expected in ((1, 1, 0), (0, 1, 0), (0, 1, 1)):
        await one_step(dut)
        assert phases(dut) == expected
        assert int(dut.zero.value) == 0
        assert int(dut.direction.value) == 1
    dut.playback.value = 1
    await with_timeout(RisingEdge(dut.zero), 100, "ms")
    assert phases(dut) == (1, 0, 0)
    assert int(dut.fault.value) == 0
