#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A cohort on Slurm: one job array over its cases (several where the site's MaxArraySize is smaller), then a job that makes the table.
#   slurm.sh submit RUNS COHORT   gives it to Slurm; with RESUME=1 only the cases that are missing or out of date
#   slurm.sh script RUNS COHORT   prints the script of the array instead
#   slurm.sh task FOLDER OFFSET   within the array: runs the case of this task
#   slurm.sh table FOLDER COHORT  within the last job
# RUNS/.cases and RUNS/.command are written by pipelines/cohort.mk. Every submission keeps its own list in RUNS/.slurm/N, so that a
# second one does not change what the tasks of the first will read. CLUSTER_PARTITION, _ACCOUNT, _TIME (minutes, or as sbatch
# takes it), _MEMORY (MB), _CORES and _OPTIONS are asked for; time and memory come from measured cost where they are empty (by COHORT_TABULATE).
set -euo pipefail
export LC_ALL=C
unset MAKEFLAGS MFLAGS MAKEOVERRIDES MAKELEVEL  # tasks are makes of their own
what=$1
here=$(dirname "$0")
quoted() { printf '%q' "$1"; }

if [ "$what" = task ]; then
  folder=$2 offset=$3
  runs=$(dirname "$(dirname "$folder")")
  mapfile -t command < "$folder/command"
  IFS=$'\t' read -r case file kind < <(sed -n "$((SLURM_ARRAY_TASK_ID + offset + 1))p" "$folder/cases")
  export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}  # also what nproc says
  echo "$case on $(uname -n), job $SLURM_JOB_ID, start $((${SLURM_RESTART_COUNT:-0} + 1))"
  "$here/cohort.sh" run "$runs/$case.status" "$runs/$case.log" "$kind" "${command[@]}" COHORT= CLUSTER= RUNS="$runs" CASE_FILE="$file" CASE="$case" summary
  cat "$runs/$case.status"
  grep -q '^done' "$runs/$case.status"
  exit
fi
if [ "$what" = table ]; then
  folder=$2 cohort=$3
  runs=$(dirname "$(dirname "$folder")")
  mapfile -t command < "$folder/command"
  "${command[@]}" COHORT="$cohort" CLUSTER= RUNS="$(dirname "$runs")" cohort-table
  exit
fi

runs=$2 cohort=$3
number=1
while [ -e "$runs/.slurm/$number" ]; do number=$((number + 1)); done
folder=$runs/.slurm/$number

# Minutes and MB of one case, and where they come from: three times, and one and a half times, what was measured.
estimate() {
  # The largest mesh that a setting or a case file asks for.
  local size=$COST_ELEMENTS element=${COST_ELEMENT:-q1p0} file line
  while IFS=$'\t' read -r _ file _; do
    while IFS= read -r line; do
      if [[ $line =~ ^[[:space:]]*ELEMENTS[[:space:]]*=[[:space:]]*([0-9]+) ]] && [ "${BASH_REMATCH[1]}" -gt "$size" ]; then size=${BASH_REMATCH[1]}; fi
      if [[ $line =~ ^[[:space:]]*ELEMENT[[:space:]]*=[[:space:]]*q2p1 ]]; then element=q2p1; fi
    done < "$file"
  done < "$runs/.cases"
  $COHORT_TABULATE case-cost "$runs" "$CLUSTER_CORES" "$element" "$size"
}
IFS=$'\t' read -r minutes memory source <<< "$(estimate)"
[ -z "$CLUSTER_TIME" ] && [ -z "$CLUSTER_MEMORY" ] || source="$source${CLUSTER_TIME:+; time as asked}${CLUSTER_MEMORY:+; memory as asked}"

job_script() { # NAME TIME MEMORY CORES OUTPUT COMMAND: a script for sbatch
  cat <<SCRIPT
#!/bin/bash
#SBATCH --job-name=$1
#SBATCH --time=$2
#SBATCH --mem=$3M
#SBATCH --cpus-per-task=$4
#SBATCH --output=$folder/$5
#SBATCH --requeue
#SBATCH --open-mode=append
${CLUSTER_PARTITION:+#SBATCH --partition=$CLUSTER_PARTITION
}${CLUSTER_ACCOUNT:+#SBATCH --account=$CLUSTER_ACCOUNT
}cd $(quoted "$PWD") || exit 1
exec $6
SCRIPT
}
array_script() {
  job_script "$(basename "$runs")" "${CLUSTER_TIME:-$minutes}" "${CLUSTER_MEMORY:-$memory}" "$CLUSTER_CORES" '%A_%a.out' \
    "$(quoted "$here/slurm.sh") task $(quoted "$folder") \"\${1:-0}\"" | sed "s|^cd |# Time and memory: from $source.\n# Task K runs the case on line K + 1 of $folder/cases, in chunks K + 1 + \$1.\n&|"
}
# sbatch: how many tasks an array may have.
largest_array() {
  local size
  size=$(scontrol show config 2> /dev/null | sed -n 's/^MaxArraySize *= *//p')
  echo "${size:-1001}"
}
# Cases to run: all, or those without a result, and those whose make has something to do.
wanted() {
  [ -n "$RESUME" ] || { cat "$runs/.cases"; return; }
  local case file kind command
  mapfile -t command < "$runs/.command"
  while IFS=$'\t' read -r case file kind; do
    if ! grep -qs '^done' "$runs/$case.status" ||
      ! "${command[@]}" -q COHORT= CLUSTER= RUNS="$runs" CASE_FILE="$file" CASE="$case" summary > /dev/null 2>&1 < /dev/null; then
      printf '%s\t%s\t%s\n' "$case" "$file" "$kind"
    fi
  done < "$runs/.cases"
}
if [ "$what" = script ]; then
  echo "# sbatch --array=0-$(($(wanted | wc -l) - 1)) [OFFSET: tasks before those of this chunk]"
  array_script
  exit
fi

command -v sbatch > /dev/null || { echo "cohort: sbatch is not there: this machine submits no jobs to Slurm; without --slurm the cases run here" >&2; exit 1; }
mkdir -p "$folder"
cp "$runs/.command" "$folder/command"
wanted > "$folder/cases"
array_script > "$folder/array.sh"
# The table takes a second or two a case.
job_script "$(basename "$runs")-table" $((30 + $(wc -l < "$runs/.cases") / 10)) 1024 1 'table.out' "$(quoted "$here/slurm.sh") table $(quoted "$folder") $(quoted "$cohort")" > "$folder/table.sh"
total=$(wc -l < "$folder/cases") size=$(largest_array) offset=0 jobs=
while [ "$offset" -lt "$total" ]; do
  count=$((total - offset < size ? total - offset : size))
  job=$(sbatch --parsable --array="0-$((count - 1))" $CLUSTER_OPTIONS "$folder/array.sh" "$offset") ||
    { echo "cohort: sbatch took $offset of $total cases${jobs:+ (jobs$jobs)}; once they have ended, the same with --resume gives the rest" >&2; exit 1; }
  jobs=$jobs:${job%%;*}
  offset=$((offset + count))
done
last=$(sbatch --parsable ${jobs:+--dependency=afterany$jobs} $CLUSTER_OPTIONS "$folder/table.sh")
echo "$total of $(wc -l < "$runs/.cases") cases given to Slurm, job${jobs:- none}; then the table, job ${last%%;*}"
echo "Time and memory of a case: ${CLUSTER_TIME:-$minutes} minutes, ${CLUSTER_MEMORY:-$memory} MB, from $source"
echo "$runs/cohort.tsv and cohort.html appear when the last has ended"
