#!/usr/bin/env bash
# same_numbers.sh PROGRAM FILE: with no switch set, the program with the planted defects measures in every gate what FILE,
# the product's results, says, wall time aside.
set -uo pipefail
program=$1 expected=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DIPTYCH_DEFECT
"$program" gate --json "$work/planted.jsonl" >"$work/out" || { tail -n 20 "$work/out"; exit 1; }
for file in "$expected" "$work/planted.jsonl"; do
  sed -E 's/"wall_seconds":[^,}]*//g' "$file" >"$work/$(basename "$file").numbers"
done
cmp "$work/$(basename "$expected").numbers" "$work/planted.jsonl.numbers" && wc -l <"$expected"
