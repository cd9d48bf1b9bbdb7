# Travel deviation of a modelled ball screw: 2 mm lead, 16 samples a turn, 1 m of useful travel.
# Run-outs of 30 mm at both ends are 15 µm off.
function uniform() { seed = (16807 * seed) % 2147483647; return seed / 2147483647 }
function normal(  k, sum) { sum = -6; for (k = 0; k < 12; k++) sum += uniform(); return sum }
BEGIN {
    seed = 1991; tau = 8 * atan2(1, 1)
    print "position_mm,lead_error_um"
    for (k = 0; k <= 8480; k++) {
        x = k / 8
        y = 0.014 * x + 5.2 * sin(tau * x / 290 + 0.4) + 1.6 * sin(tau * x / 2) + 1.1 * sin(tau * x / 61) + 0.08 * normal()
        if (x < 30) y += 15 * (1 - x / 30)
        if (x > 1030) y -= 15 * (x - 1030) / 30
        printf "%.3f,%.3f\n", x, y
    }
}
