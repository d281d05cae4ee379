#!/usr/bin/env bash
# objects.sh FILE...: what the product's object files, one of each source, tell of it.
# 1. None needs, by however many steps, what needs it: each can be read, tested and replaced after those that it stands on.
# 2. What a file keeps to itself has a name that no other file of its part has: they are compiled together, and the wrong one of
#    two functions could answer a call.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# T, D, B, R: defined by this object alone; weak symbols are templates and inline functions, which many objects define.
nm -A --format=posix "$@" | awk '{ sub(/^.*[.]dir\//, "", $1); sub(/:$/, "", $1) } { print $3, $2, $1 }' >"$work/all"
awk '$1 ~ /^[TDBR]$/ { where[$2] = $3 } $1 == "U" { used[$0] = 1 }
     END { for (line in used) { split(line, f, " "); if (where[f[2]] && where[f[2]] != f[3]) print f[3], where[f[2]], f[2] } }' \
  "$work/all" | sort >"$work/ties"
objects=$# ties=$(cut -d' ' -f1,2 "$work/ties" | sort -u | wc -l)
echo "$objects objects, $ties ties"
[ "$objects" -gt 50 ] && [ "$ties" -gt "$objects" ] || { echo "too few: these are not the product's, a source an object"; exit 1; }
broken=0
# tsort names every object of a cycle on its error output.
if ! cut -d' ' -f1,2 "$work/ties" | tsort >/dev/null 2>"$work/cycle"; then
  sed -n 's/^tsort: \(.*[.]o\)$/\1/p' "$work/cycle" | sort -u >"$work/members"
  echo "these need each other:"
  awk 'NR == FNR { member[$1] = 1; next } member[$1] && member[$2]' "$work/members" "$work/ties" | c++filt
  broken=1
fi
# Functions of a namespace: part, name, whether it is the file's own, file.
awk '$1 ~ /^[tTW]$/ { print $3, $2 }' "$work/all" | c++filt | grep -v -e 'lambda' -e '\[clone' | awk '
  { file = $1; part = file; sub("/.*", "", part); $1 = ""
    gsub(/[(]anonymous namespace[)]/, "@"); name = $0
    sub(/[<(].*/, "", name); sub(/.* /, "", name)
    own = sub(/@::/, "", name)
    if (name !~ /^diptych::[a-z_]+::[A-Za-z_0-9]+$/) next
    key = part " " name
    if (!((key, file) in seen)) { seen[key, file] = 1; files[key] = files[key] " " file; n[key]++ }
    if (own) kept[key] = 1 }
  END { for (key in kept) if (n[key] > 1 && key ~ /^(reports|runner) /) print key ":" files[key] }' | sort >"$work/names"
if [ -s "$work/names" ]; then
  echo "a file's own functions with the name of another file's:"
  cat "$work/names"
  broken=1
fi
exit "$broken"
