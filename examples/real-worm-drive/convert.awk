# Turns a log of the PHD2 autoguider into measured data for helixlock.
#
#     awk -f convert.awk logs/performance_dataset03.txt > performance_dataset03.csv
#
# The guider measures where a star stands against its mark and pushes the drive back. Without the
# pushes the drive would have been off by the reading and by all pushes before it, so that
#
#     error_arcsec = scale · (RARawDistance + sum of earlier RAGuideDistance)
#
# A lost star leaves its cell empty. A new mark, a pause, or another session of guiding begins a new
# pass; a session counts its seconds anew, so they go on after those of the one before.
BEGIN {
    FS = ","
    scale = 1
    pass = 1
    print "time_s,error_arcsec,pass"
}

/Pixel scale = / {
    split($0, words, /Pixel scale = /)
    scale = words[2] + 0
}

/^Guiding Begins/ && rows { fresh = 1; before = last + 60 }

/^INFO: (SET LOCK POSITION|Server received PAUSE)/ && rows { fresh = 1 }

/^Frame,/ { for (field = 1; field <= NF; field++) { gsub(/"/, "", $field); place[$field] = field } }

/^[0-9]+,/ {
    if (fresh) { pass++; pushed = 0; fresh = 0 }
    rows++
    raw = $place["RARawDistance"]
    error = raw == "" ? "" : sprintf("%.4f", scale * (raw + pushed))
    last = before + $place["Time"]
    printf "%.3f,%s,%d\n", last, error, pass
    pushed += $place["RAGuideDistance"]
}
