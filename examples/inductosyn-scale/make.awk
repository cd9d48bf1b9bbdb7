# Errors of a machine scale of two pieces of 250 mm, 2 µm apart, both ways. Samples within 3 mm of the
# joint are poor. -v what=table: every 1 mm, once; what=check: every 0.25 mm, once;
# what=axis: targets every 23.4 mm, five approaches from each side.
function uniform() { seed = (16807 * seed) % 2147483647; return seed / 2147483647 }
function normal(  k, sum) { sum = -6; for (k = 0; k < 12; k++) sum += uniform(); return sum }
function error(x, way,  piece) { # the slider passes from the one piece to the other over 8 mm
    piece = x < 246 ? -1 : x < 254 ? (x - 250) / 4 : 1
    return 4.1 * sin(tau * x / 420) + piece + 0.5 * sin(tau * x / 2) + 0.2 * way
}
function sample(x, way,  poor) {
    poor = (what == "table" && x > 247 && x < 253) ? 1.5 * normal() : 0
    return error(x, way) + 0.1 * normal() + poor
}
function row(x, way) { printf "%.2f,%.2f,%d\n", x, sample(x, way), way }
BEGIN {
    seed = 250; if (what == "check") seed = 251; if (what == "axis") seed = 252
    tau = 8 * atan2(1, 1); step = what == "table" ? 1 : what == "check" ? 0.25 : 23.4
    runs = what == "axis" ? 5 : 1
    print "position_mm,error_um,direction"
    for (run = 0; run < runs; run++) {
        for (k = 0; k * step <= 500; k++) row(k * step, 1)
        for (k--; k >= 0; k--) row(k * step, -1)
    }
}
