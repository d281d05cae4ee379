#!/usr/bin/env bash
# objects.sh FILE...: what the product's object files tell of its sources. They are compiled with -O0 -g1 -ffunction-sections
# -fdata-sections, an object of one source or of several: what a function or a table names is told by the relocations of its
# section, and where it was written by the table of lines.
# 1. No source needs, by however many steps, what needs it: each can be read, tested and replaced after those that it stands on.
# 2. What a file keeps to itself has a name that no other file of its part has: they are compiled together, and the wrong one of
#    two functions could answer a call.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Of each object: "S type symbol" what it defines, "L symbol file" where that was written, "R symbol symbol" what one names, and
# "I file symbol" what is named when the program starts. A constructor or destructor has several symbols for one text.
for object in "$@"; do
  echo "O $object"
  nm --defined-only --format=posix "$object" | awk '/^_Z/ { print "S", $2, $1 }'
  {
    objdump -rw "$object"
    readelf -W --debug-dump=rawline "$object" | sed '/Line Number Statements/,$d'
    readelf -W --debug-dump=decodedline "$object"
  } | awk '
    /^RELOCATION RECORDS FOR/ {
      lines = /\[[.]debug_line\]/; starts = /__static_initialization_and_destruction/
      from = match($0, /_Z[^]]*/) ? substr($0, RSTART, RLENGTH) : ""
      if (/\[[.](debug|eh_frame|gcc_except|init_array|fini_array)/) from = ""
      next }
    $2 ~ /^R_[A-Z]/ {
      sub(/[-+]0x[0-9a-f]+$/, "", $3)
      if (lines) { if ($3 ~ /^[.]text/) written[++functions] = match($3, /_Z.*/) ? substr($3, RSTART) : "-" }
      else if (from != "" && match($3, /_Z.*/)) {
        if (starts) { offset[++named] = $1; name[named] = substr($3, RSTART) } else print "R", from, substr($3, RSTART) }
      next }
    # The functions of the table of lines have the order of its relocations. A line of a file alone says whose the next are; the
    # first are of file 1.
    / The (Directory|File Name) Table/ { table = $2 }
    /Contents of/ { table = "" }
    table == "Directory" && $1 ~ /^[0-9]+$/ { folder[$1] = $NF }
    table == "File" && $1 == 1 { file = folder[$2 ~ /udata/ ? $3 : $2] "/" $NF }
    NF == 1 && /:(\[\+\+\])?$/ { file = $1; sub(/:(\[\+\+\])?$/, "", file) }
    NF >= 3 && $2 ~ /^[0-9]+$/ && $3 ~ /^(0x[0-9a-f]+|0)$/ {
      if (!inside) { inside = 1; print "L", written[++function_], file }
      if (written[function_] ~ /__static_initialization_and_destruction/) {
        at[++rows] = sprintf("%16s", substr($3, 3)); gsub(/ /, "0", at[rows]); of[rows] = file } }
    $2 == "-" { inside = 0 }
    END {
      if (function_ != functions) { print "the table of lines of an object is not understood" >"/dev/stderr"; exit 1 }
      for (k = 1; k <= named; ++k) {
        file = ""
        for (row = 1; row <= rows && at[row] "" <= offset[k] ""; ++row) file = of[row]
        print "I", file, name[k]
      } }'
done >"$work/all"
# A symbol with a source is an end of a tie; one of a header (of templates and inline functions each object has a copy) is gone
# through.
awk -v names="$work/symbols" '
  function one(symbol) { gsub(/C[15]E/, "C2E", symbol); gsub(/D[15]E/, "D2E", symbol); return symbol }
  function of(symbol) { symbol = one(symbol); return (object, symbol) in own ? object ":" symbol : symbol }
  function place(id, file) { if (!(id in where)) { where[id] = file; held[file] = held[file] " " id } }
  $1 == "O" { object = $2; next }
  $1 == "S" { type[object, $3] = $2
    if ($2 ~ /^[tdbrn]$/) own[object, one($3)] = 1
    next }
  $1 == "L" { if ($3 ~ /[.]cpp$/) place(of($2), $3)
    if (type[object, $2] ~ /^[tTW]$/) print $3, $2 >names
    next }
  $1 == "R" { from = of($2); to = of($3) }
  $1 == "I" { if ($2 !~ /[.]cpp$/) next
    from = "start of " $2; gsub(/ /, "_", from); to = of($3); place(from, $2) }
  from != to && !((from, to) in seen) { seen[from, to] = 1; needs[from] = needs[from] " " to }
  END {
    for (file in held) {
      split("", met)
      top = split(held[file], stack, " ")
      while (top > 0)
        for (k = split(needs[stack[top--]], list, " "); k > 0; --k) {
          if ((to = list[k]) in met) continue
          met[to] = 1
          if (!(to in where)) stack[++top] = to
          else if (where[to] != file) print file, where[to], to
        }
    } }' "$work/all" | sed "s#$PWD/##g" | sort >"$work/ties"
sources=$(awk '{ print $1; print $2 }' "$work/ties" | sort -u | wc -l) ties=$(cut -d' ' -f1,2 "$work/ties" | sort -u | wc -l)
echo "$sources sources, $ties ties"
[ "$sources" -gt 100 ] && [ "$ties" -gt "$sources" ] ||
  { echo "too few: these are not the product's, compiled as is said above"; exit 1; }
broken=0
# tsort names every source of a cycle on its error output.
if ! cut -d' ' -f1,2 "$work/ties" | tsort >/dev/null 2>"$work/cycle"; then
  sed -n 's/^tsort: \(.*[.]cpp\)$/\1/p' "$work/cycle" | sort -u >"$work/members"
  echo "these need each other:"
  awk 'NR == FNR { member[$1] = 1; next } member[$1] && member[$2]' "$work/members" "$work/ties" | c++filt
  broken=1
fi
# Functions of a namespace: part, name, whether it is the file's own, file.
sed "s#^$PWD/##" "$work/symbols" | c++filt | grep -v -e 'lambda' -e '\[clone' | awk '
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
