#!/usr/bin/env bash
# locales.sh PROGRAM: figures, data and pages are the same bytes in any locale and with no environment at all. (Tables and
# results tell wall times.)
set -uo pipefail
program=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
figures=(fig2 fig4 choices)
failures=0 tried=0
# The plate of Figs. 12 and 13, on Mesh I alone: its other meshes say nothing of letters.
awk -v RS= -v ORS='\n\n' '/^\[\[gate]]/ && !/id = "balance"/ { next } /^\[\[figure]]/ && !/id = "fig1[23]"/ { next }
  { sub(/\ncells = \[10, [0-9, ]*\]/, "\ncells = [10]"); sub(/id = "plate.damage"/, "id = \"mesh-one\""); print }' \
  "$(dirname -- "${BASH_SOURCE[0]}")/../cases/plate/damage.toml" >"$work/mesh-one.toml"

draw() { # draw NAME COMMAND...
  local name=$1
  shift
  { "$@" "$program" paper "${figures[@]}" --store none --out "$work/$name" &&
    "$@" "$program" run "$work/mesh-one.toml" --store none --out "$work/$name"; } >"$work/$name.log" 2>&1 || {
    echo "$name: exit status $?"
    tail -n 10 "$work/$name.log"
    failures=$((failures + 1))
  }
  tried=$((tried + 1))
  [ "$name" = plain ] || diff -rq -x '*.jsonl' -x tables "$work/plain" "$work/$name" || failures=$((failures + 1))
  [ "$name" = plain ] || diff <(cd "$work/plain" && find . | sort) <(cd "$work/$name" && find . | sort) ||
    failures=$((failures + 1))
}

draw plain env LC_ALL=C.UTF-8
draw nothing env -i
# One with a decimal comma, made here where the package locales is installed.
if localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8" >/dev/null 2>&1; then
  draw german env LOCPATH="$work" LC_ALL=de_DE.UTF-8 LANGUAGE=de
else
  echo "de_DE.UTF-8 was not tried: localedef cannot make it (apt-get install locales)"
fi
pictures=$(find "$work/plain" -name '*.svg' | wc -l)
[ "$pictures" -ge 5 ] || { echo "$pictures pictures"; failures=$((failures + 1)); }
echo "$tried locales, $pictures pictures each, $failures failed"
[ "$failures" -eq 0 ]
