# Travel deviation of a modelled trapezoidal screw, 6 mm lead, cut on an ordinary lathe: 12 samples a turn.
function uniform() { seed = (16807 * seed) % 2147483647; return seed / 2147483647 }
function normal(  k, sum) { sum = -6; for (k = 0; k < 12; k++) sum += uniform(); return sum }
BEGIN {
    seed = 2886; tau = 8 * atan2(1, 1)
    print "position_mm,lead_error_um"
    for (k = 0; k <= 1200; k++) {
        x = k / 2
        y = 0.03 * x + 6 * sin(tau * x / 110 + 1) + 8 * sin(tau * x / 6) + 2.5 * sin(tau * x / 36) + 0.3 * normal()
        printf "%.1f,%.3f\n", x, y
    }
}
