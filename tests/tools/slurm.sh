#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# slurm.sh BUILD [GOOD]: a cohort on a Slurm of its own (Debian: slurm-wlm, munge), on loopback and without systemd. GOOD cases (6), one
# that is killed and one that fails run the installed chain, coarse, as processes of this machine and as job arrays of at most six tasks. One
# of two nodes is lost in the middle and comes back, one task is cancelled; resumed, the table is the local one byte for byte.
# The scan is segmented once and its pictures are copies: neither is the subject here.
# Needs root: a node is a process namespace, so that losing it takes all its tasks along.
set -euo pipefail
export LC_ALL=C
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL  # of a make that runs the tests
for program in slurmctld slurmd munged sbatch unshare; do
  PATH=$PATH:/usr/sbin command -v $program > /dev/null || { echo "skipped: $program is not installed (Debian: slurm-wlm munge)"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: needs root"; exit 77; }
PATH=$PATH:/usr/sbin
build=$(realpath "$1")
good=${2:-6}
total=$((good + 2)) largest_array=6
work=$(mktemp -d)
chmod 755 "$work"
started=$SECONDS
controller= munge=
declare -A node=()
end() {
  local code=$?
  local server
  for server in "${node[@]}" $controller $munge; do kill -9 "$server" 2> /dev/null || true; wait "$server" 2> /dev/null || true; done
  [ $code -eq 0 ] || [ ! -s "$work/slurmctld.log" ] || tail -n 20 "$work/slurmctld.log" "$work"/slurmd*.log
  [ -n "${KEEP:-}" ] || rm -rf "$work"
}
trap end EXIT
passed=0
pass() { passed=$((passed + 1)); echo "ok ($((SECONDS - started)) s): $*"; }
fail() { echo "FAILED: $*"; echo "$passed passed, 1 failed"; exit 1; }
within() { # SECONDS WHAT COMMAND...: waits until COMMAND succeeds
  local left=$1 what=$2
  shift 2
  until "$@" > /dev/null 2>&1; do
    [ $((left -= 1)) -gt 0 ] || { squeue || true; tail -n 5 "$work"/slurm/cohort-patients/*.log; fail "$what"; }
    sleep 1
  done
}

# --- the cluster ---
start_node() { # NAME
  unshare --pid --fork --mount-proc --kill-child=KILL bash -c "slurmd -D -N $1 -L '$work/slurmd-$1.log' & wait" > "$work/slurmd-$1.out" 2>&1 &
  node[$1]=$!
}
start_cluster() {
  local port=$((20000 + RANDOM % 20000))
  mkdir -m 755 "$work/munge" "$work/state"
  (umask 077; head -c 1024 /dev/urandom > "$work/munge/key")
  munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed" > "$work/munge/out" 2>&1 &
  munge=$!
  within 60 "munged answers" test -S "$work/munge/socket"
  export SLURM_CONF=$work/slurm.conf
  cat > "$SLURM_CONF" <<CONF
ClusterName=trial
SlurmctldHost=$(uname -n)(127.0.0.1)
SlurmctldPort=$port
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool-%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ReturnToService=2
SlurmdTimeout=10
KillWait=5
MaxArraySize=$largest_array
SchedulerParameters=bf_interval=1,sched_interval=2
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=n1 NodeHostname=$(uname -n) NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2 RealMemory=8000
NodeName=n2 NodeHostname=$(uname -n) NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 RealMemory=8000
PartitionName=trial Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld -D -L "$work/slurmctld.log" > "$work/slurmctld.out" 2>&1 &
  controller=$!
  start_node n1
  start_node n2
  within 60 "both nodes are idle" sh -c "[ \"\$(sinfo -h -N -o %T | grep -cx idle)\" -eq 2 ]"
}

# --- programs and cases ---
cmake --install "$build" --prefix "$work/prefix" > "$work/log" || fail "cmake --install"
PATH=$work/prefix/bin:$PATH
cd "$work"
mkdir once patients
breast phantom scan.nrrd --preset small --coarse 2 --quiet
# The case `early` waits as long as the file `hold` is there.
cat > segment <<SEGMENT
#!/bin/bash
set -e
run=\$(dirname "\$2")
case "\$run" in */early) while [ -e $work/hold ]; do sleep 0.2; done ;; esac
exec 8> $work/once/lock
flock 8
[ -s $work/once/labels.json ] || $work/prefix/libexec/breast/segment "\$1" $work/once/labels.vtkhdf --side left --quiet \
  --points $work/once/points.vtp --overlay $work/once/contours.png --report $work/once/labels.json
cp $work/once/{labels.vtkhdf,points.vtp,contours.png,labels.json} "\$run"
SEGMENT
cat > render <<'RENDER'
#!/bin/bash
while [ "$1" != --all ]; do shift; done
for name in ${4//,/ }; do
  /usr/bin/python3 -c 'import sys; from PIL import Image; Image.new("L", (2, 2), 90).save(sys.argv[1])' "$2/$name.png"
done
RENDER
chmod +x segment render
for number in $(seq "$good"); do
  printf 'MR = scan.nrrd\nSIDE = left\nELEMENTS = 4\nREDUCTION = %d\n' $((18 + 2 * (number % 8))) > patients/good-$number.case
done
printf 'MR = scan.nrrd\nELEMENTS = 6\nREDUCTION = 20\n' > patients/early.case
printf 'MR = no-such-scan.nrrd\n' > patients/missing.case
settings=(SEGMENT="$work/segment" RENDER="$work/render" MATERIALS=seed2008 AT_LEAST=10 TUMOUR=auto
  "PROJECT_OPTIONS=--pixel 1")
table=slurm/cohort-patients/cohort.tsv
is() { awk -F'\t' -v case="$1" -v status="$2" -v reason="$3" '$1 == case && $2 == status && $NF ~ reason { found = 1 } END { exit !found }' "$table"; }

breast cohort patients --runs local --jobs 2 "${settings[@]}" > log 2>&1 || { tail -n 20 log; tail -n 5 local/cohort-patients/*.log; fail "the cohort as local processes"; }
[ "$(awk -F'\t' '$2 == "done"' local/cohort-patients/cohort.tsv | wc -l)" -eq $((good + 1)) ] ||
  { cat local/cohort-patients/cohort.tsv; fail "all cases done but the one that fails"; }
sed -n 2p local/cohort-patients/cohort.tsv | grep -q '^missing.failed.*no-such-scan' || fail "the failed case comes first, with its reason"
pass "$total cases as local processes: $((good + 1)) done, one failed and says why"

start_cluster
pass "Slurm answers on loopback"
ours() { breast cohort patients --slurm --runs slurm "${settings[@]}" "$@"; }
touch hold
ours --dry-run > script || fail "the script is printed"
bash -n script && grep -q '^#SBATCH --requeue' script && grep -q 'cohort-cost.tsv' script && [ -z "$(squeue -h)" ] ||
  { cat script; fail "--dry-run prints the script, with the source of its figures, and submits nothing"; }
ours > log || { cat log; fail "the cohort is submitted"; }
arrays=$(((total + largest_array - 1) / largest_array))
grep -q "^$total of $total cases given to Slurm" log && [ "$(squeue -h -o %F | sort -u | wc -l)" -eq $((arrays + 1)) ] ||
  { cat log; squeue; fail "$arrays arrays and a table"; }
pass "$total cases in $arrays arrays of at most $largest_array tasks, and the job of the table"

running() { grep -qs '^running' slurm/cohort-patients/early.status; }
within 200 "the held case runs" running
early_task() { basename "$(grep -l '^early on' slurm/cohort-patients/.slurm/1/*.out)" .out; }
lost=$(squeue -h -j "$(early_task)" -o %N)
kill -9 "${node[$lost]}"
wait "${node[$lost]}" 2> /dev/null || true
within 60 "the node is down" sh -c "sinfo -h -n $lost -o %T | grep -q down"
start_node "$lost"
within 60 "the node is back" sh -c "sinfo -h -n $lost -o %T | grep -qE 'idle|mixed|allocated'"
# Slurm would wait two minutes before it starts a task again.
again() {
  local job
  for job in $(squeue -h -r -t PD -o '%i %r' | sed -n '/Dependency/!s/ .*//p'); do scontrol update "JobId=$job" StartTime=now; done
  grep -qs '^early on.*start 2' slurm/cohort-patients/.slurm/1/*.out
}
within 240 "the case of the lost node is started again" again
pass "after the loss of node $lost, one of two, its tasks were started again"

scancel "$(early_task)"
within $((220 + 10 * total)) "the table appears" test -s "$table"
within 30 "the queue is empty" sh -c '[ -z "$(squeue -h)" ]'
is missing failed no-such-scan && is early failed . && [ "$(grep -c 'done' "$table")" -eq "$good" ] ||
  { cat "$table"; fail "$good cases done, the cancelled and the failed one say so"; }
pass "one task cancelled: the table is complete, two cases failed with reasons"

rm hold
ours --resume > log
grep -q "^2 of $total cases given to Slurm" log || { cat log; fail "only what is missing is submitted again"; }
within 200 "the resumed jobs end" sh -c '[ -z "$(squeue -h)" ]'
cmp "$table" local/cohort-patients/cohort.tsv || { diff "$table" local/cohort-patients/cohort.tsv; fail "the tables are equal"; }
pass "resumed with the two cases that were missing, the table is the local one byte for byte"

sed -i 's/REDUCTION = 20/REDUCTION = 21/' patients/early.case
ours --resume --dry-run | grep -q -- '--array=0-1 ' || fail "a changed case is run again"
ours --resume --dry-run | grep -q 'cases in cost.tsv' || fail "time and memory come from the cases that are done"
for page in cohort contours; do
  ! grep -qE "$work|/tmp/|/home/" slurm/cohort-patients/$page.html || fail "$page.html names no folder"
  grep -q 'data:image/jpeg' slurm/cohort-patients/$page.html || fail "$page.html has its pictures"
done
pass "a changed case is found; the pages have pictures and name no folder"
echo "$passed passed, 0 failed in $((SECONDS - started)) s"
