#!/bin/sh
# Stands in for cgaft-solve: takes its arguments, speaks its progress, leaves its files, computes nothing.
# A case whose file holds `fake: fail` (or the text in FAKE_FAIL) fails; `fake: slow` (FAKE_SLOW) waits to be stopped;
# `fake: long` (FAKE_LONG) goes on slowly, and does so only until it has a checkpoint;
# `fake: stubborn` (FAKE_STUBBORN) does not listen; `fake: pause` (FAKE_PAUSE) takes a moment; `fake: empty` leaves no result.
# As one of several ranks it leaves all to the first.
if [ "$1" = --version ]; then
    printf 'cgaft-solve 0\nfeatures: %s\n' "${FAKE_FEATURES:-mpi (Open MPI 4.1.4)}"
    exit
fi
[ "${OMPI_COMM_WORLD_RANK:-0}" = 0 ] || exit 0
case_file=$1
shift
while [ $# -gt 0 ]; do
    case $1 in
    --into) into=$2; shift 2 ;;
    --threads) threads=$2; shift 2 ;;
    *) shift ;;
    esac
done
holds() { grep -qF -- "$1" "$case_file"; }

echo "$(basename "$into") threads=$threads${OMPI_COMM_WORLD_SIZE:+ ranks=$OMPI_COMM_WORLD_SIZE}" >>"$into/../../starts.txt"
echo '{"step": 40, "of": 100, "time_ps": 0.5, "strain": 0.004, "tip_nm": 12.5, "percent": 40}'
if holds "${FAKE_FAIL:-fake: fail}"; then
    i=1
    while [ $i -le 30 ]; do
        echo "log line $i" >&2
        i=$((i + 1))
    done
    exit 4
fi
echo "a word that is no progress"
if holds "${FAKE_SLOW:-fake: slow}"; then
    [ -e "$into/checkpoint.h5" ] && echo "resumed" >&2
    cat >/dev/null
    echo "checkpoint" >"$into/checkpoint.h5"
    exit 130
fi
if holds "${FAKE_LONG:-fake: long}" && [ ! -e "$into/checkpoint.h5" ]; then
    sleep 0.1
    echo '{"step": 50, "of": 100, "time_ps": 0.6, "strain": 0.005, "tip_nm": 12.5, "percent": 50}'
    cat >/dev/null
    echo "checkpoint" >"$into/checkpoint.h5"
    exit 130
fi
holds "${FAKE_STUBBORN:-fake: stubborn}" && exec sleep 60
holds "${FAKE_PAUSE:-fake: pause}" && sleep 0.5
holds "fake: empty" && exit 0
echo "series" >"$into/series.h5"
cat >"$into/outcome.json" <<'END'
{"end_reason": "strain 0.01 reached", "steps": 100, "time_step_ps": 0.0012, "stability_limit_ps": 0.0015,
 "energy_error_relative": 1e-6, "cost": [{"name": "forces", "calls": 100, "seconds": 0.1}]}
END
