# A task of the array: some parts of the batch. The argument is the number of the array's first task.
task=$(($1 + SLURM_ARRAY_TASK_ID))
from=$((first + task * pack)) to=$((first + task * pack + pack - 1))
[ "$to" -le "$last" ] || to=$last
echo "task $task: $(date '+%F %T') $(hostname) ${SLURMD_NODENAME:-} job ${SLURM_JOB_ID:-}"

"$ramify" batch run "$folder" --parts "$from-$to" --threads "$SLURM_CPUS_PER_TASK" --quiet &
child=$!
# USR1: the time is nearly over. TERM (scancel, preemption) reaches ramify without our help. In both cases it saves what it
# has begun and ends with status 130.
over=
trap 'over=1; kill -TERM $child' USR1
trap : TERM
while :; do
    wait $child
    status=$?
    kill -0 $child 2>/dev/null || break # else it was a signal that ended the wait
done

# What was out of time goes on from there; what was killed (by the system, for want of memory) is tried again.
most=0
[ $status -ne 130 ] || [ -z "$over" ] || most=50
[ $status -ne 137 ] || most=3
if [ "${SLURM_RESTART_COUNT:-0}" -lt $most ]; then
    echo "task $task: status $status; again"
    scontrol requeue "$SLURM_JOB_ID"
else
    echo "task $task: status $status"
fi
exit $status
