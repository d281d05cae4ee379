#!/usr/bin/env bash
# same_numbers.sh PROGRAM FILE: with no switch set, the program with the planted defects measures in every gate what FILE,
# the product's results, says, wall time aside. Two cases, which are half of all work, are plate.damage's once more.
set -uo pipefail
program=$1 expected=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset DIPTYCH_DEFECT
twice='plate\.damage-(fine|aside)'
# shellcheck disable=SC2046
"$program" gate $("$program" list --declarations | sed -n 's|^\[\([^/]*\)\]$|\1|p' | grep -Ev "^$twice\$") \
  --store none --json "$work/planted.jsonl" >"$work/out" || { tail -n 20 "$work/out"; exit 1; }
for file in "$expected" "$work/planted.jsonl"; do
  grep -Ev "\"case\":\"$twice\"" "$file" | sed -E 's/"wall_seconds":[^,}]*//g' >"$work/$(basename "$file").numbers"
done
cmp "$work/$(basename "$expected").numbers" "$work/planted.jsonl.numbers" && wc -l <"$expected"
