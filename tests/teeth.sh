#!/usr/bin/env bash
# teeth.sh PROGRAM GATE...: a program with a planted defect must fail each of these gates, by a number and not by a crash.
set -uo pipefail
program=$1
shift
out=$("$program" gate "$@" 2>&1)
status=$?
survived=0
for gate in "$@"; do
  if ! grep -q "^FAIL  *$gate " <<<"$out"; then
    echo "not failed: $gate"
    survived=1
  fi
done
if [ "$status" -ne 10 ] || [ "$survived" -ne 0 ]; then
  echo "exit status $status"
  echo "$out"
  exit 1
fi
