#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# examples/check/array.sbatch on a Slurm of our own: a controller and one node. Tasks are killed, and so is the node. Arguments: mxgen
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
array=$here/../../examples/check/array.sbatch
. "$here/../programs/common.sh"
. "$here/materials.sh"
if ! command -v slurmctld >/dev/null || ! command -v slurmd >/dev/null; then
    skip 'Slurm is not installed'
    finish check-slurm
fi
node= controller=
stop_slurm() {
    for pid in $node $controller; do kill "$pid" 2>/dev/null; done
    wait
    rm -rf "$work"
}
trap stop_slurm EXIT

# The programs, and a document for a test that holds a task until a file is there
mkdir programs && cp "$mxgen" "$(dirname "$mxgen")/mxgen-check" programs
cat >programs/held <<'END'
#!/bin/sh
# Holds shard 2 while the file "hold" is there, then checks.
echo "$SLURM_ARRAY_TASK_ID $$" >>begun
while [ "$SLURM_ARRAY_TASK_ID" = 2 ] && [ -e hold ]; do sleep 0.1; done
shift
exec mxgen check "$@"
END
chmod +x programs/held
export PATH=$work/programs:$PATH
mkdir show
for i in $(seq 9); do material "M$i" "0.$i" >"show/m$i.mtlx"; done
material Bad rough >show/bad.mtlx
"$mxgen" check show --no-compile --baseline baseline.json --update-baseline --json none.json >/dev/null

host=$(hostname -s) port=$((20000 + $$ % 20000))
mkdir -p slurm/state slurm/spool
cat >slurm/slurm.conf <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=5
SchedulerParameters=sched_interval=1,requeue_delay=1
SlurmctldPidFile=$work/slurm/slurmctld.pid
SlurmdPidFile=$work/slurm/slurmd.pid
SlurmdSpoolDir=$work/slurm/spool
StateSaveLocation=$work/slurm/state
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmctldLogFile=$work/slurm/slurmctld.log
SlurmdLogFile=$work/slurm/slurmd.log
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$work/slurm/slurm.conf

# until_ COMMAND...: waits for it, three minutes at most: a task that lost its node begins again when its credential has expired
until_() {
    local _
    for _ in $(seq 720); do
        "$@" >/dev/null 2>&1 && return
        sleep 0.25
    done
    echo "in vain: $*"
    tail -n 5 slurm/*.log
    return 1
}
is_idle() { sinfo -h -o %T | grep -q idle; }
begins() { [ "$(grep -c "^$1 " begun)" -ge "$2" ]; } # SHARD TIMES
start_node() {
    slurmd -D >slurm/slurmd.out 2>&1 &
    node=$!
}
slurmctld -D >slurm/slurmctld.out 2>&1 &
controller=$!
start_node
if ! until_ is_idle >slurm.log; then
    cat slurm.log
    skip 'Slurm does not start here'
    finish check-slurm
fi

submit() { # SHARDS...: the job's number
    sbatch --parsable --array="$1" "$array" 3 show --no-compile
}
fresh() { rm -rf shards report.* merge.log begun hold && mkdir shards; }
# merged CODE: the job that merges, after another one
merged() { # CODE JOB
    local got=0
    timeout 100 sbatch --wait --output=merge.log --dependency=afterany:"$2" \
        --wrap 'mxgen check merge shards/*.json --baseline baseline.json --json report.json --html report.html' || got=$?
    [ "$got" -eq "$1" ] || { echo "exit code $got"; cat merge.log shards/*.log; return 1; }
}

# The example as it is
fresh
check 'an array is merged against the baseline' merged 0 "$(submit 1-3)"
check 'the summary counts the known failure' grep -q '^9 passed, 1 failed (validate 1; known 1)' merge.log
check 'the merge is the report of one run' eval '"$mxgen" check merge shards/*.json --json plain.json >/dev/null; cmp plain.json none.json'
material M3 rough >show/m3.mtlx
fresh
check 'a new failure fails the merge' merged 1 "$(submit 1-3)"
check 'the merge names the failure' grep -q '^FAILED show/m3.mtlx (fails)' merge.log
check 'the merge of a failure has a report' grep -q '<article class="failed fails' report.html
material M3 0.3 >show/m3.mtlx

# A task that is killed: its shard is missing, is named, and runs again alone
sed 's/exec mxgen check/exec held check/' "$array" >held.sbatch
array=$work/held.sbatch
fresh && touch hold
job=$(submit 1-3)
check 'a task begins' until_ begins 2 1
check 'the task is killed' scancel --signal=KILL "${job}_2"
rm hold
check 'the merge does not pass without the task' merged 1 "$job"
check 'the merge names the missing shard' grep -q '^error: shard 2 of 3 is missing \[shard-missing\]' merge.log
check 'the failed merge leaves no report' test ! -e report.json
check 'the missing shard runs again' merged 0 "$(submit 2)"
check 'the report is complete then' eval '"$mxgen" check merge shards/*.json --json plain.json >/dev/null; cmp plain.json none.json'

# A node that dies with its task: Slurm runs the task again
fresh && touch hold
job=$(submit 1-3)
check 'a task of another job begins' until_ begins 2 1
task=$(sed -n 's/^2 //p' begun)
step=$(sed -n 's/^PPid:\t//p' "/proc/$task/status") # Slurm's process above the task, which would tell of its end
kill -9 "$node" "$step" "$task"
wait "$node" 2>/dev/null
rm hold
check 'the controller misses the node' until_ eval '! is_idle && sinfo -h -o %T | grep -q down'
start_node
check 'the task of the node begins again' until_ begins 2 2
check 'the merge of that job passes' merged 0 "$job"
check 'the merge of that job is the report of one run' eval '"$mxgen" check merge shards/*.json --json plain.json >/dev/null; cmp plain.json none.json'

finish check-slurm
