#!/usr/bin/env bash
# ray farm on a real Slurm: a controller and two nodes on this machine, of which one is killed while it renders. The picture has to
# be that of one machine, by each integrator. Also kills the process that submitted, and starts it again.
# Needs root, and Debian's slurmctld, slurmd, slurm-client and munge. Ends with 77 and the reason where they are missing.
# Usage: slurm.sh RAY SCENE_FOLDER
set -euo pipefail

ray="$(readlink -f -- "$1")" scenes="$(cd -- "$2" && pwd -P)"
for tool in slurmctld slurmd squeue sbatch munged; do
  command -v "$tool" >/dev/null || { echo "SKIPPED: $tool is not installed (./dev test cluster)"; exit 77; }
done
[[ $EUID == 0 ]] || { echo "SKIPPED: slurmctld and munged have to be started as root"; exit 77; }
work="$(mktemp -d /var/tmp/trace-cluster.XXXXXX)"
say() { printf 'cluster: %s\n' "$*"; }
fail() { say "FAILED: $*"; tail -n 5 "$work"/log/*.log "$work"/*.err 2>/dev/null || true; exit 1; }

stop() {  # what was started here, by its number
  local file
  for file in "$work"/*.pid "$work/munge/munged.pid"; do
    [[ ! -s "$file" ]] || kill -KILL "$(cat "$file")" 2>/dev/null || true
  done
  rm -rf --one-file-system -- "$work"
}
trap stop EXIT
mkdir -p "$work"/{log,ctld,munge,render}
chmod 755 "$work"
cd "$work/render"

# --- a cluster of two nodes ----------------------------------------------------------------------------
port=$((20000 + RANDOM % 8000)) host="$(hostname -s)"
head -c 1024 /dev/urandom >"$work/munge/key"
chown -R munge:munge "$work/munge"
chmod 755 "$work/munge"
chmod 400 "$work/munge/key"
munge=(runuser -u munge -- munged --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/munged.pid"
       --log-file="$work/munge/log" --seed-file="$work/munge/seed")
"${munge[@]}" || fail "munged does not start"
export SLURM_CONF="$work/slurm.conf"
cat >"$SLURM_CONF" <<CONF
ClusterName=trace
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort=$port
StateSaveLocation=$work/ctld
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/%n.pid
SlurmctldLogFile=$work/log/ctld.log
SlurmdLogFile=$work/log/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=10
KillWait=3
MinJobAge=600
SchedulerParameters=sched_interval=2,batch_sched_delay=0
JobRequeue=1
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 RealMemory=500
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 RealMemory=500
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -c
slurmd -N n1 -c
slurmd -N n2 -c
for ((i = 0; i < 60; ++i)); do
  [[ "$(sinfo -h -o '%D %t' 2>/dev/null)" != "2 idle" ]] || break
  sleep 0.5
done
[[ "$(sinfo -h -o '%D %t')" == "2 idle" ]] || fail "the nodes are not idle: $(sinfo -h 2>&1)"
say "$(slurmctld -V): a controller and two nodes"

# --- the bytes of one machine --------------------------------------------------------------------------
farm() { "$ray" farm "$@" --sbatch '--cpus-per-task=1'; }
compare() {  # NAME SCENE FLAGS...
  local name="$1" scene="$2"
  shift 2
  "$ray" render "$scenes/$scene.ray" -o "$name-one.png" --resume=never -q "$@" || fail "$name on one machine"
  farm "$scenes/$scene.ray" --parts 6 -o "$name.png" "$@" 2>"../$name.err" || fail "ray farm by $name"
  cmp "$name-one.png" "$name.png" || fail "$name: the pictures differ"
  say "$name: six parts by two nodes have the bytes of one machine"
}
compare path glass -w 160 --integrator path --spp 4
compare bdpt cornell -w 100 --integrator bdpt --spp 4
compare mlt cornell -w 100 --integrator mlt --chain-starts 2000 --spp 4
compare photon cornell -w 100 --integrator photon --photons 20000 --spp 4

# --- a node dies, and so does the process that submitted -----------------------------------------------
flags=(--integrator path --spp 600 -w 200 --checkpoint-every 1)
"$ray" render "$scenes/cornell.ray" -o one.png --resume=never -q "${flags[@]}"
"$ray" farm "$scenes/cornell.ray" --parts 4 -o lost.png "${flags[@]}" 2>../first.err &
first=$!
disown "$first"  # so that the shell does not tell of its end
for ((i = 0; i < 100; ++i)); do
  [[ -z "$(squeue -h -t RUNNING -w n2)" || -z "$(compgen -G 'lost.parts/*.checkpoint')" ]] || break
  sleep 0.3
done
victims="$(squeue -h -t RUNNING -w n2 -o %K | paste -sd ' ')"
[[ -n "$victims" ]] || fail "no task runs on n2"
kill -KILL "$first"
while kill -0 "$first" 2>/dev/null; do sleep 0.1; done
kill -KILL "$(cat "$work/n2.pid")"
# What runs there: the processes with this cluster's and this node's name in their environment, and the slurmstepd over each.
isOfN2() { tr '\0' '\n' 2>/dev/null <"/proc/$1/environ" | grep -cxE "SLURMD_NODENAME=n2|SLURM_CONF=$SLURM_CONF" | grep -qx 2; }
tasks=() steps=()
for process in $(pgrep -x 'sh|slurm_script|ray'); do
  isOfN2 "$process" || continue
  tasks+=("$process")
  parent="$(ps -o ppid= -p "$process" | tr -d ' ')"
  [[ "$(cat "/proc/$parent/comm")" != slurmstepd ]] || steps+=("$parent")
done
((${#steps[@]})) || fail "no slurmstepd is over the tasks of n2"
kill -KILL "${steps[@]}" "${tasks[@]}"
say "killed ray farm, and the node n2 with its task $victims"

# Slurm finds out after SlurmdTimeout, and holds a task that it requeues for two minutes; here it need not wait.
(
  while sleep 2; do
    for job in $(squeue -h -t PENDING --array -o '%A %r' | sed -n 's/ BeginTime$//p'); do
      scontrol update "jobid=$job" StartTime=now 2>/dev/null || true
    done
  done
) &
helper=$!
echo "$helper" >"$work/helper.pid"
disown "$helper"  # so that the shell does not tell of its end
farm "$scenes/cornell.ray" --parts 4 -o lost.png "${flags[@]}" --progress plain 2>../second.err || fail "ray farm, continued"
grep -q 'of an earlier run in the queue' ../second.err || fail "the second ray farm did not continue"
cmp one.png lost.png || fail "after the death of a node the pictures differ"
grep -l 'continuing from' lost.parts/slurm-*.log >/dev/null || say "NOTE: no task had a checkpoint to continue from"
for task in $victims; do say "log of the task $task: $(grep -c . "lost.parts/slurm-$task.log") lines"; done
say "four parts, a dead node and a dead submitter: the bytes of one machine"
say "passed"
