#!/bin/bash
# usage: daemons.sh DIR start|stop
# A Slurm of one node on this machine, without systemd and without authentication, everything below DIR.
# Its commands find it by SLURM_CONF=DIR/slurm.conf.
set -eu
folder=$1

if [ "$2" = stop ]; then
    for name in slurmd slurmctld; do
        [ -s "$folder/$name.pid" ] && kill "$(cat "$folder/$name.pid")" 2>/dev/null
    done
    exit 0
fi

node=$(hostname -s)
user=$(id -un)
# Two runs on one machine must not meet.
port=$((20000 + $$ % 20000))
mkdir -p "$folder/control" "$folder/node"
# A job that is queued again waits until credentials have expired (cred_expire), by default two minutes.
cat >"$folder/slurm.conf" <<END
ClusterName=verify
SlurmctldHost=$node(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/none
CredType=cred/none
AuthInfo=cred_expire=5
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/control
SlurmdSpoolDir=$folder/node
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SlurmdParameters=config_overrides
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,batch_sched_delay=0,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=30
MinJobAge=600
InactiveLimit=0
NodeName=$node NodeAddr=127.0.0.1 CPUs=4 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
export SLURM_CONF=$folder/slurm.conf
export PATH=$PATH:/usr/sbin:/sbin
# They detach themselves; what they say must not keep a pipe of ours open.
slurmctld -c >"$folder/start.log" 2>&1 </dev/null
slurmd >>"$folder/start.log" 2>&1 </dev/null
for _ in $(seq 100); do
    if sinfo --noheader --format=%T 2>/dev/null | grep -qE 'idle|mixed'; then exit 0; fi
    sleep 0.2
done
echo "the node does not become idle:" >&2
tail -n 20 "$folder"/*.log >&2
exit 1
