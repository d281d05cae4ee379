#!/usr/bin/env bash
# cycles.sh FILE: of the product's object files, which FILE lists, none needs, by however many steps, what needs it: each
# can be read, tested and replaced after those that it stands on.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# T, D, B, R: defined by this object alone; weak symbols are templates and inline functions, which many objects define.
mapfile -t files < <(grep "[.]o$" "$1")
nm -A --format=posix "${files[@]}" | awk '{ sub(/^.*[.]dir\//, "", $1); sub(/:$/, "", $1) }
  $3 ~ /^[TDBR]$/ { print "D", $2, $1 } $3 == "U" { print "U", $2, $1 }' >"$work/symbols"
awk '$1 == "D" { where[$2] = $3; next } { used[$0] = 1 }
     END { for (line in used) { split(line, f, " "); if (where[f[2]] && where[f[2]] != f[3]) print f[3], where[f[2]], f[2] } }' \
  "$work/symbols" | sort >"$work/ties"
objects=${#files[@]} ties=$(cut -d' ' -f1,2 "$work/ties" | sort -u | wc -l)
echo "$objects objects, $ties ties"
[ "$objects" -gt 50 ] && [ "$ties" -gt "$objects" ] || { echo "too few: these are not the product's"; exit 1; }
# tsort names every object of a cycle on its error output.
if ! cut -d' ' -f1,2 "$work/ties" | tsort >/dev/null 2>"$work/cycle"; then
  sed -n 's/^tsort: \(.*[.]o\)$/\1/p' "$work/cycle" | sort -u >"$work/members"
  echo "these need each other:"
  awk 'NR == FNR { member[$1] = 1; next } member[$1] && member[$2]' "$work/members" "$work/ties" | c++filt
  exit 1
fi
