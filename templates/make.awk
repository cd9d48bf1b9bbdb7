# Made data for these machines: `awk -v what=NAME -f make.awk`. Each holds one effect that its machine
# file does not have, and noise of Park and Miller's generator, so that anyone gets the same.
function noise(size,    sum, i) {
    sum = -6
    for (i = 0; i < 12; i++) { seed = (seed * 16807) % 2147483647; sum += seed / 2147483647 }
    return size * sum
}
function wave(size, turns, phase) { return size * sin(tau * turns + phase) }
BEGIN {
    tau = 8 * atan2(1, 1); seed = 20240607
    if (what == "lead-screw-grinder") {          # the screw's wobble: 1.5 um every 12 mm
        print "time_s,position_mm,error_um"
        for (k = 0; k <= 400; k++) {
            x = 0.6 * k
            printf "%.2f,%.3f,%.4f\n", x / 0.6, x, -0.000846 * x - wave(1.5, x / 12, 0.5) + noise(0.05)
        }
    } else if (what == "screw-axis") {           # backlash of 8 um
        print "time_s,position_mm,direction,error_um"
        for (k = 0; k <= 400; k++) {
            d = k <= 200 ? 1 : -1; x = d > 0 ? k : 400 - k
            printf "%.2f,%.3f,%d,%.4f\n", k / 25, x * 1.01, d, -d * 4 + noise(0.3)
        }
    } else if (what == "laser-axis") {           # the screw's wobble: 2 um every 10 mm
        print "time_s,position_mm,error_um"
        for (k = 0; k <= 400; k++) {
            x = 0.77 * k
            printf "%.3f,%.3f,%.4f\n", x / 20, x, -wave(2, x / 10, 1.2) + noise(0.1)
        }
    } else if (what == "rotary-table") {         # the worm: 4 arcsec
        print "angle_rev,error_arcsec"
        for (k = 0; k <= 600; k++)
            printf "%.6f,%.3f\n", k / 600, -wave(4, 90 * k / 600, 0.3) + noise(0.4)
    } else if (what == "telescope") {            # the worm: 5 arcsec
        print "time_s,error_arcsec"
        for (k = 0; k <= 700; k++)
            printf "%.1f,%.3f\n", 3.1 * k, -wave(5, 180 * 3.1 * k / 86164.1, 0.7) + noise(0.8)
    } else if (what == "robot-joint") {          # the strain wave gear: 25 arcsec
        print "angle_rev,error_arcsec"
        for (k = 0; k <= 800; k++)
            printf "%.6f,%.3f\n", k / 3200, -wave(25, 200 * k / 3200, 0.2) + noise(2)
    } else if (what == "gear-tester") {          # the pinion's run-out: 12 arcsec
        print "angle_rev,error_arcsec"
        for (k = 0; k <= 600; k++)
            printf "%.6f,%.3f\n", k / 200, -wave(12, 62 / 26 * k / 200, 0.9) + noise(1)
    }
}
