# Turns the air log of a measuring machine into columns that helixlock knows.
#
#     awk -f convert.awk log.csv > air.csv
#
# Two rows belong to a scan line, one forward and one back; a line took 204.08 s, by the time
# stamps of the machine's own description files.
BEGIN {
    FS = ","
    print "time_s,workpiece_temperature_c,air_temperature_c,humidity_pct,air_pressure_hpa"
}

NR > 1 { printf "%.2f,%s,%s,%s,%.2f\n", ($1 - 1) * 102.04, $3, $4, $5, $6 / 100 }
