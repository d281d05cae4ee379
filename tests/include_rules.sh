#!/usr/bin/env bash
# include_rules.sh SOURCE: who may include whom. An oracle that calls what it judges is no oracle.
set -uo pipefail
cd "$1" || exit 1
broken=0 looked=0
forbid() { # forbid FOLDER OTHERS: no file of FOLDER includes a header of OTHERS (an alternation)
  local found files
  files=$(find "$1" -name '*.[ch]pp' | wc -l)
  [ "$files" -gt 0 ] || { echo "no sources in $1"; broken=1; }
  looked=$((looked + files))
  found=$(grep -nE "#include \"($2)/" "$1"/*.[ch]pp)
  [ -z "$found" ] || { echo "$found"; broken=1; }
}
forbid material 'fem|mpm|diffusion|analytic|cases|reports|tests'
forbid diffusion 'material|fem|mpm|analytic|cases|reports|tests'
forbid fem 'mpm|analytic|cases|reports|tests'
forbid mpm 'fem|analytic|cases|reports|tests'
forbid analytic 'material|diffusion|fem|mpm|cases|reports|tests'
forbid reports 'material|diffusion|fem|mpm|analytic|cases|tests'
forbid cases 'tests'
echo "$looked files"
exit "$broken"
