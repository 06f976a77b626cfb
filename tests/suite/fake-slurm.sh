#!/bin/bash
# Stands in for Slurm under the names of its commands; jobs are processes of this machine, their states files in $FAKE_SLURM.
# FAKE_STATE='TIMEOUT|TimeLimit' leaves every job in that state and never starts it (`vanish`: in none);
# FAKE_FULL='1 3' are the submissions for which there is no room; FAKE_REFUSE refuses every script, FAKE_REFUSE_AFTER all after so many; FAKE_MAX_ARRAY is the longest array; FAKE_GARBAGE makes squeue babble. A file `silent` there makes squeue fail; a file
# `accounting` is what sacct answers.
state=$FAKE_SLURM
put() {
    echo "$2" >"$state/.$1.new"
    mv "$state/.$1.new" "$state/$1"
}

case ${FAKE_ROLE:-$(basename "$0")} in
sbatch)
    echo submitted >>"$state/submissions"
    if [ -n "${FAKE_REFUSE:-}" ]; then
        echo "sbatch: error: invalid partition specified: nowhere" >&2
        exit 1
    fi
    if [ "$(wc -l <"$state/submissions")" -gt "${FAKE_REFUSE_AFTER:-1000}" ]; then
        echo "sbatch: error: invalid account" >&2
        exit 1
    fi
    if [[ " ${FAKE_FULL:-} " == *" $(wc -l <"$state/submissions") "* ]]; then
        echo "sbatch: error: QOSMaxSubmitJobPerUserLimit" >&2
        echo "sbatch: error: Batch job submission failed: Job violates accounting/QOS policy" >&2
        exit 1
    fi
    array=$((100 + $(find "$state" -name '*.sh' | wc -l)))
    script=$state/$array.sh
    cat >"$script"
    only=$(grep -q '^#SBATCH --array=' "$script" || echo "$array")
    last=$(sed -n 's/^#SBATCH --array=0-\([0-9]*\).*/\1/p' "$script")
    output=$(sed -n 's/^#SBATCH "\{0,1\}--output=\([^"]*\)"\{0,1\}$/\1/p' "$script")
    for task in $(seq 0 "${last:-0}"); do
        id=${only:-${array}_$task}
        log=${output//%[Aj]/$array}
        put "$id" "${FAKE_STATE:-PENDING|Resources}"
        [ "${FAKE_STATE:-}" = vanish ] && rm "$state/$id"
        [ -n "${FAKE_STATE:-}" ] && continue
        if [ -n "$only" ]; then
            export SLURM_JOB_ID=$array
        else
            export SLURM_JOB_ID=$((array + task)) SLURM_ARRAY_JOB_ID=$array SLURM_ARRAY_TASK_ID=$task
        fi
        FAKE_ROLE=node FAKE_ID=$id setsid bash "$0" "$script" "${log//%a/$task}" </dev/null >/dev/null 2>&1 &
    done
    echo "$array"
    ;;
node)
    unset FAKE_ROLE
    id=$FAKE_ID
    while
        put "$id" 'RUNNING|None'
        bash "$1" >>"$2" 2>&1 &
        echo $! >"$state/$id.pid"
        wait $!
        code=$?
        [ -e "$state/$id.requeue" ]
    do
        rm "$state/$id.requeue"
    done
    if [ -e "$state/$id.cancelled" ]; then
        put "$id" 'CANCELLED|None'
    elif [ $code = 0 ]; then
        put "$id" 'COMPLETED|None'
    else
        put "$id" 'FAILED|NonZeroExitCode'
    fi
    ;;
squeue)
    [ -n "${FAKE_GARBAGE:-}" ] && echo "is anybody there?" && exit
    cd "$state" || exit
    [ -e silent ] && echo "slurm_load_jobs error: Unable to contact slurm controller" >&2 && exit 1
    for job in [0-9]*; do
        [ "$job" = "${job%.*}" ] && [ -e "$job" ] && echo "$job|$(cat "$job")"
    done
    true
    ;;
scancel)
    shift
    for id in "$@"; do
        echo "$id" >>"$state/cancellations"
        if grep -q PENDING "$state/$id"; then
            put "$id" 'CANCELLED|None'
        else
            touch "$state/$id.cancelled"
            # The real one may say it twice.
            kill -TERM "$(cat "$state/$id.pid")"
            kill -TERM "$(cat "$state/$id.pid")" 2>/dev/null || true
        fi
    done
    ;;
scontrol)
    if [ "$1" = show ]; then
        echo "Configuration data as of now"
        echo "MaxArraySize            = ${FAKE_MAX_ARRAY:-1001}"
        exit
    fi
    echo "$2" >>"$state/requeues"
    touch "$state/$2.requeue"
    ;;
sacct)
    cat "$state/accounting" 2>/dev/null && exit
    echo "Slurm accounting storage is disabled" >&2
    exit 1
    ;;
esac
