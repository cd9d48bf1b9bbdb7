# Runs a compiled Icarus bench on a stimulus file; prints user seconds and the end state.
TIMEFORMAT='%U'
{ time vvp "$1" "+stimulus=$2" >icarus.out; } 2>icarus.time
echo "end $(cat icarus.time) $(sed -n 's/^state //p' icarus.out | sed -E 's/\b0+([0-9a-f])/\1/g')"
