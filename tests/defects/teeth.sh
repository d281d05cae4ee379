#!/usr/bin/env bash
# teeth.sh PROGRAM VERDICT GATE...: with the defect that DIPTYCH_DEFECT names, the program must give each of these gates
# that verdict: FAIL, by a number and not by a crash, or INVALID.
set -uo pipefail
program=$1 verdict=$2
shift 2
out=$("$program" gate --store none --fail-fast -j 1 "$@" 2>&1)
status=$?
survived=0
for gate in "$@"; do
  if ! grep -q "^$verdict  *$gate " <<<"$out"; then
    echo "not $verdict: $gate"
    survived=1
  fi
done
if [ "$status" -eq 0 ] || ! grep -q "^DIPTYCH-VERDICT $verdict " <<<"$out" || [ "$survived" -ne 0 ]; then
  echo "exit status $status"
  echo "$out"
  exit 1
fi
