#!/bin/sh
# Stands in for mpirun: its ranks know their number and how many there are; the first hears its standard input.
if [ "$1" = --version ]; then
    echo "${FAKE_MPIRUN:-mpirun (Open MPI) 4.1.4}"
    exit
fi
while [ $# -gt 0 ]; do
    case $1 in
    -n) ranks=$2; shift 2 ;;
    --mca) shift 3 ;;
    --bind-to) shift 2 ;;
    --*) shift ;;
    *) break ;;
    esac
done
export OMPI_COMM_WORLD_SIZE="$ranks"
for rank in $(seq $((ranks - 1))); do
    OMPI_COMM_WORLD_RANK=$rank "$@" </dev/null &
done
OMPI_COMM_WORLD_RANK=0 exec "$@"
