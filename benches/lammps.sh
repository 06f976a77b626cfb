#!/bin/sh
# usage: benches/lammps.sh CGAFT, in the top folder
# The processor time that LAMMPS takes on one core for the all-atom slab of studies/speed-against-error.yaml, as a table to compare with.
# Its fastest pair style for this potential, lj/cut/opt, without the pairs that the notch severs, without output.
set -eu
STEPS=2000
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" export lammps studies/speed-against-error.yaml --case atoms --into "$folder" >"$folder/said"
sed -E \
    -e 's|^pair_style .*|pair_style lj/cut 3.4000000000000002e-1|' \
    -e 's|^pair_coeff \* \* lj/cut 1 |pair_coeff * * |' \
    -e '/^pair_(coeff [0-9]|modify)/d; /^(dump|thermo_style|thermo_modify)/d' \
    -e "s|^thermo .*|thermo $STEPS|" \
    -e "s|^run .*|run $STEPS|" \
    "$folder/in.atoms" >"$folder/in.fast"
(cd "$folder" && OMP_NUM_THREADS=1 lmp -suffix opt -in in.fast) >"$folder/log"
awk -v steps="$STEPS" '
    /^timestep/ { step = $2 }
    /^Loop time of/ { seconds = $4 }
    /% CPU use with/ { share = $1 / 100 }
    END {
        print "# LAMMPS, lj/cut/opt, one core, first " steps " steps of the all-atom slab; written by benches/lammps.sh"
        print "case,core_seconds_per_ps"
        printf "atoms,%.4g\n", share * seconds / (steps * step)
    }' "$folder/in.fast" "$folder/log"
