# Pulses of a worm pair 36:1. The worm turns six times a second and gives 200 pulses a turn, the table
# 720. What the table has turned too much: 12 arcsec once a turn, 4 arcsec with the worm, 1.5 twice
# as often. With -v what=truth that error itself.
function delta(turns) { return 12 * sin(tau * turns) + 4 * sin(tau * 36 * turns + 1) + 1.5 * sin(tau * 72 * turns) }
BEGIN {
    tau = 8 * atan2(1, 1); turns = 2.05
    if (what == "truth") {
        print "output_turns,delta_arcsec"
        for (k = 0; k <= 3000; k++) printf "%.6f,%.5f\n", k * turns / 3000, delta(k * turns / 3000)
        exit
    }
    print "input_s,output_s"
    for (k = 0; k <= turns * 36 * 200; k++) {
        output = ""
        if (k <= turns * 720) output = sprintf("%.9f", 0.001 + (k / 720 - delta(k / 720) / 1296000) * 36 / 6)
        printf "%.9f,%s\n", 0.001 + k / 200 / 6, output
    }
}
