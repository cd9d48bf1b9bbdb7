# Three probes 45 mm and 40 mm apart on a carriage, ten runs over 160 mm in steps of 5 mm. Probes of 0.01 µm
# resolution, σ = 0.01 µm; the carriage repeats to 0.16 µm only; one reading of run 4 is spoilt.
# With -v aperiodic=1 the bar does not repeat with the stroke.
function uniform() { seed = (16807 * seed) % 2147483647; return seed / 2147483647 }
function normal(  k, sum) { sum = -6; for (k = 0; k < 12; k++) sum += uniform(); return sum }
function bar(x) {
    if (aperiodic) return 0.4 * sin(tau * x / 230 + 0.3) + 0.16 * cos(tau * x / 71) + 0.05 * sin(tau * x / 37)
    return 0.42 * sin(tau * x / 160 + 0.3) + 0.16 * cos(tau * x * 2 / 160) + 0.05 * sin(tau * x * 5 / 160)
}
function reading(place, motion) { return int((bar(place) + motion + 0.01 * normal() + 100) * 100 + 0.5) / 100 - 100 }
BEGIN {
    seed = 160; tau = 8 * atan2(1, 1); kept = exp(-5 / 20)
    print "position_mm,probe1_um,probe2_um,probe3_um,repeat"
    for (run = 1; run <= 10; run++) {
        wander = 0.16 * normal()
        for (j = 0; j < 32; j++) {
            x = 5 * j
            wander = kept * wander + sqrt(1 - kept * kept) * 0.16 * normal()
            motion = -0.5 * sin(tau * x / 160 + 0.3) - 0.15 * cos(tau * x / 80) + wander
            tilt = 0.001 * sin(tau * x / 120)
            z1 = reading(x, motion)
            z2 = reading(x - 45, motion + 45 * tilt)
            z3 = reading(x - 85, motion + 85 * tilt)
            if (run == 4 && j == 11) z2 += 0.4
            printf "%d,%.2f,%.2f,%.2f,%d\n", x, z1, z2, z3, run
        }
    }
}
