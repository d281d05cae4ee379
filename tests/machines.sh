#!/usr/bin/env bash
# machines.sh PROGRAM DOCUMENT: the recipes of docs/machines.md, word for word, each in a folder of its own. A fenced block with a
# name behind its language is a file of that name; `console NAME` holds commands after `$` and lines that must be found in what
# they say, in this order. A recipe whose engine is not installed is skipped, with the reason. Slurm's is run with a controller
# and a node of this script's own, on this machine.
set -uo pipefail
program=$(readlink -f "$1") document=$(readlink -f "$2")
work=$(mktemp -d)
failures=0 checks=0 skipped=0
stop() { kill $(jobs -p) 2>/dev/null; wait 2>/dev/null; rm -rf "$work"; }
trap stop EXIT
mkdir "$work/bin" && ln -s "$program" "$work/bin/diptych"
export PATH=$work/bin:$PATH HOME=$work
cd "$work" || exit 1

block() { # block LANGUAGE NAME: its lines
  awk -v fence="\`\`\`$1 $2" '$0 == fence { inside = 1; next } inside && /^```$/ { exit } inside' "$document"
}
follow() { # follow NAME: the commands of a console
  local line command="" expected=() said
  check() {
    [ -n "$command" ] || return
    checks=$((checks + 1))
    said=$(bash -c "$command" 2>&1) || { echo "wrong: \$ $command"; echo "$said" | tail -n 20; failures=$((failures + 1)); return; }
    local rest=$said one
    for one in "${expected[@]}"; do
      [[ $rest == *"$one"* ]] || { echo "wrong: \$ $command"; echo "does not say: $one"; echo "$said" | tail -n 20
        failures=$((failures + 1)); return; }
      rest=${rest#*"$one"}
    done
  }
  while IFS= read -r line; do
    if [[ $line == '$ '* ]]; then check; command=${line#'$ '} expected=(); else expected+=("$line"); fi
  done < <(block console "$1")
  [ -n "$command" ] || { echo "wrong: no commands of $1 in $document"; failures=$((failures + 1)); }
  check
}
recipe() { # recipe NAME PROGRAM...: its folder, unless one of the programs is missing
  local name=$1 needed
  shift
  for needed in "$@"; do
    command -v "$needed" >/dev/null || { echo "skipped: $name, for $needed is not installed"; skipped=$((skipped + 1)); return 1; }
  done
  mkdir "$work/$name" && cd "$work/$name" || exit 1
}

if recipe parallel parallel; then
  mkdir -p "$HOME/.parallel" && touch "$HOME/.parallel/will-cite"
  follow parallel
fi

start_slurm() {
  local host
  host=$(hostname -s)
  mkdir state spool
  cat >slurm.conf <<END
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
ReturnToService=2
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
  export SLURM_CONF=$PWD/slurm.conf
  slurmctld -D >controller.log 2>&1 &
  sleep 1
  slurmd -D >node.log 2>&1 &
  for _ in $(seq 20); do
    sleep 0.5
    sinfo -h -o %T 2>/dev/null | grep -q idle && return
  done
  return 1
}
if recipe slurm sbatch slurmctld slurmd; then
  if start_slurm; then
    block sh parts.sbatch >parts.sbatch
    follow slurm
  else
    echo "skipped: slurm, whose controller and node do not start here: $(tail -qn 1 controller.log node.log | tr '\n' ' ')"
    skipped=$((skipped + 1))
  fi
fi

if recipe snakemake snakemake; then
  block python Snakefile >Snakefile
  follow snakemake
fi
echo "$checks checks, $failures failed, $skipped recipes skipped"
[ "$failures" = 0 ] || exit 1
[ "$checks" -gt 0 ] || exit 77
