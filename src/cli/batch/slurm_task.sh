# A task of the array: some parts of the batch. The argument is the number of the array's first task.
task=$(($1 + SLURM_ARRAY_TASK_ID))
from=$((first + task * pack)) to=$((first + task * pack + pack - 1))
[ "$to" -le "$last" ] || to=$last
echo "task $task: $(date '+%F %T') $(hostname) ${SLURMD_NODENAME:-} job ${SLURM_JOB_ID:-}"

# USR1: the time is nearly over. TERM (scancel, preemption) reaches ramify without our help. In both cases it saves what it
# has begun and ends with status 130.
child= over= cancelled=
trap 'over=1; [ -z "$child" ] || kill -TERM $child 2>/dev/null' USR1
trap 'cancelled=1' TERM
run() { # sets status
    "$ramify" batch run "$folder" --parts "$from-$to" --threads "$SLURM_CPUS_PER_TASK" --quiet &
    child=$!
    [ -z "$over$cancelled" ] || kill -TERM $child
    while :; do
        wait $child
        status=$?
        kill -0 $child 2>/dev/null || break # else it was a signal that ended the wait
    done
    child=
}

# What was killed (by the system, for want of memory) is tried again here and now: a task that is queued again waits for two
# minutes and then for its turn.
run
tries=1
while [ $status -eq 137 ] && [ -z "$over$cancelled" ] && [ $tries -lt 4 ]; do
    echo "task $task: status $status; again"
    tries=$((tries + 1))
    run
done

# What was out of time goes on from there once it is queued again. The controller may be away just now.
if [ $status -eq 130 ] && [ -n "$over" ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 50 ]; then
    echo "task $task: status $status; again"
    until scontrol requeue "$SLURM_JOB_ID"; do
        sleep 5
    done
else
    echo "task $task: status $status"
fi
exit $status
