#!/usr/bin/env bash
# store.sh PROGRAM [KILLS]: what runs measured outlives a command that was killed, a full disk and other writers, and what is
# half-written is never believed. Each round kills one of the commands at a moment of its own.
set -uo pipefail
tests=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$(readlink -f "$1") kills=${2:-12}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
source "$tests/expect.sh"
cases=(bar.mode.fixed-free bar.step.fixed-free 'impact.e*' plate.patch)
numbers() { sed -E 's/"wall_seconds":[^,}]*//g' "$1"; }
same() { cmp <(numbers "$1") <(numbers "$2"); }

# --- once, and from the store ---
expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --store none --json alone.jsonl
test ! -e out || { echo "wrong: --store none left a store"; failures=$((failures + 1)); }
expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --json first.jsonl
expect 0 'runs were made before and are taken from out/store' "$program" gate "${cases[@]}" --json second.jsonl
expect 0 '' same alone.jsonl first.jsonl
expect 0 '' same alone.jsonl second.jsonl
expect 0 '^bar.mode.fixed-free ' "$program" store
expect 0 ' 0 not whole' "$program" store verify
expect 0 'are taken from out/store' "$program" explain bar.mode.fixed-free/stress-order
# A program that its environment tells something else is another.
[ "$(DIPTYCH_OTHER=1 "$program" gate bar.mode.fixed-free 2>&1 | grep -c taken)" = 0 ] ||
  { echo "wrong: what another program measured was believed"; failures=$((failures + 1)); }
record=$(find out/store -name '*.run' | sort | sed -n 3p)
printf x >>"$record"
expect 13 "$record: it has .* bytes behind its first line" "$program" store verify
expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --json third.jsonl
expect 0 '' same alone.jsonl third.jsonl
expect 0 'files removed' "$program" store prune
expect 0 ' 0 not whole' "$program" store verify
expect 14 'did you mean "verify"' "$program" store verfy

# --- shards ---
for k in 1 2 3; do expect 0 "^shard $k/3: [0-9]+ runs made" "$program" gate "${cases[@]}" --shard $k/3 --store "part$k"; done
expect 0 "^shard 2/3: 0 runs made" "$program" gate "${cases[@]}" --shard 2/3 --store part2
expect 0 'kept .*; to make: 0 of' "$program" gate "${cases[@]}" --shard 2/3 --store part2 --dry-run
selected=("${cases[@]/#/--case=}")
expect 13 'runs are lacking' "$program" merge part1 part3 --out lame "${selected[@]}"
test ! -e lame || { echo "wrong: what was refused was written"; failures=$((failures + 1)); }
expect 0 'runs of 3 stores' "$program" merge part1 part2 part3 --out whole "${selected[@]}"
expect 13 'of none of these cases' "$program" merge part1 part2 part3 --out more --case 'bar.*fixed-free'
expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --from whole --json merged.jsonl
expect 0 '' same alone.jsonl merged.jsonl
expect 14 'has no record, made by this build of the program, of' "$program" gate "${cases[@]}" --from part2
expect 14 'found "4/3"; allowed: 1/3, 2/3 or 3/3' "$program" gate --shard 4/3
DIPTYCH_OTHER=1 "$program" gate "${cases[@]}" --shard 3/3 --store other3 >log 2>&1
expect 13 '2 builds made them' "$program" merge part1 part2 other3 --out two "${selected[@]}"
printf x >>"$(find part1 -name '*.run' | sort | head -n 1)"
expect 13 '1 records are not whole' "$program" merge part1 part2 part3 --out lame "${selected[@]}"

# --- writers at once ---
for k in 1 2 3 4 5 6 7 8; do "$program" gate "${cases[@]}" --store many -j 1 --json "many$k.jsonl" >"many$k.log" 2>&1 & done
wait
for k in 1 2 3 4 5 6 7 8; do expect 0 '' same alone.jsonl "many$k.jsonl"; done
expect 0 ' 0 not whole' "$program" store verify --store many
expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --from many

# --- kills ---
commands=("gate ${cases[*]} --store killed -j 2" "run bar.step.fixed-free --out killed-run --store killed"
  "gate ${cases[*]} --store killed --shard 1/2" "merge part2 part3 --out killed-merge ${selected[*]}")
for ((k = 0; k < kills; ++k)); do
  # shellcheck disable=SC2086
  setsid "$program" ${commands[k % ${#commands[@]}]} >log 2>&1 &
  pid=$!
  # The first dies when it has kept something, so that there is something to go on from.
  if [ "$k" = 0 ]; then
    until [ -n "$(find killed -name '*.run' 2>/dev/null | head -n 1)" ] || ! kill -0 "$pid" 2>/dev/null; do sleep 0.01; done
  else
    sleep "0.$(printf %03d $((RANDOM % 800)))"
  fi
  kill -9 "$pid" 2>/dev/null
  wait "$pid" 2>/dev/null
  "$program" store verify --store killed >log 2>&1 || { echo "wrong: after kill $k: $(<log)"; failures=$((failures + 1)); }
  checks=$((checks + 1))
done
expect 0 'are taken from killed' "$program" gate "${cases[@]}" --store killed --json killed.jsonl
expect 0 '' same alone.jsonl killed.jsonl

# --- what cannot be written ---
expect 12 'standard output' sh -c "'$program' run bar.energy --out full >/dev/full"
expect 0 '"type":"run"' cat full/results.jsonl
test -s full/tables/bar.energy.csv || { echo "wrong: no tables"; failures=$((failures + 1)); }
expect 0 'VERDICT PASS' sh -c "'$program' gate bar.energy 2>/dev/full"
expect 0 'VERDICT PASS' sh -c "'$program' gate bar.energy 2>&-"
"$program" run bar.energy --out piped 2>log | true
expect 0 '"type":"run"' cat piped/results.jsonl
expect 14 'found "same", as --json is' "$program" gate bar.energy --json same --junit same
expect 14 'which may be a case' sh -c "echo >mine.toml; '$program' gate bar.energy --json mine.toml"
expect 14 'which is a folder' "$program" gate bar.energy --junit full
if mkdir small && mount -t tmpfs -o size=256k none small 2>/dev/null; then
  expect 0 'VERDICT PASS' "$program" gate "${cases[@]}" --store small/store --json crammed.jsonl
  expect 0 '' same alone.jsonl crammed.jsonl
  expect 0 ' 0 not whole' "$program" store verify --store small/store
  expect 0 'not all runs could be kept, which this command does not need: small/store' "$program" gate "${cases[@]}" --store small/store
  umount small
fi
echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
