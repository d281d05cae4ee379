#!/usr/bin/env bash
# plant.sh PLANT SOURCE: what the planting of defects withstands, and what it says where it does not.
set -uo pipefail
plant=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0 checks=0
check() { # check WHAT COMMAND...
  local what=$1
  shift
  checks=$((checks + 1))
  "$@" >/dev/null 2>&1 || { echo "not so: $what"; failures=$((failures + 1)); }
}
mkdir -p "$work/source/fem" "$work/defects"
cat >"$work/source/fem/bar.cpp" <<'CPP'
double load(double x) {
  const double twice = 2 * x;
  for (int i = 0; i < 2; ++i) x += twice / 3;
  return x;
}
CPP
defect() { # defect ID FIND REPLACE [IN]
  printf '[[defect]]\nid = "%s"\nfile = "fem/bar.cpp"\nfind = "%s"\nreplace = "%s"\nwhy = "a try"\ngates = ["a/b"]\n%s\n' \
    "$1" "$2" "$3" "${4:+in = \"$4\"}"
}
run() { "$plant" "$work/source" "$work/defects" "$work/out" fem/bar.cpp runner/app/main.cpp 2>"$work/words"; }
mkdir -p "$work/source/runner/app" && echo 'int main() {}' >"$work/source/runner/app/main.cpp"

{
  defect modulus '2 * x' '3 * x'
  defect slow 'x += twice / 3;' ''
  defect loop 'for (int i = 0; i < 2; ++i) x += twice / 3;' 'x += twice;'
  defect end 'x' '-x' 'return x;'
} >"$work/defects/fem.toml"
check 'defects are planted' run
check 'nothing is said' test ! -s "$work/words"
check 'an expression' grep -q 'twice = (::diptych::planted(1) ? (3 \* x) : (2 \* x));' "$work/out/fem/bar.cpp"
check 'a statement within another' grep -q \
  'planted(3)) { x += twice; } else { for .* if (::diptych::planted(2)) { *} else { x += twice / 3; } }' "$work/out/fem/bar.cpp"
check 'a part of a statement' grep -q 'return (::diptych::planted(4) ? (-x) : (x));' "$work/out/fem/bar.cpp"
check 'lines stay where they are' test "$(grep -n 'return' "$work/out/fem/bar.cpp" | cut -d: -f1)" = 6
check 'one test for each' test "$(grep -c '^add_test' "$work/out/teeth.cmake")" = 4
check 'the program with all of them is C++' g++ -std=c++20 -fsyntax-only -I "$work/out" "$work/out/fem/bar.cpp"

cp -p "$work/out/fem/bar.cpp" "$work/before"
sed -i -e 's#$#  // a remark#' -e 's/+= twice/+=\n    twice/' "$work/source/fem/bar.cpp"
check 'remarks and new lines do not matter' run
check 'all still fit' test ! -s "$work/words"

sed -i 's/2 \* x/x + x/' "$work/source/fem/bar.cpp"
check 'one that no longer fits stops nothing' run
check 'it is named' grep -q 'planted defect modulus: fem/bar.cpp: it no longer holds' "$work/words"
check 'its own test fails' grep -q 'teeth.modulus sh -c "cat .*exit 1"' "$work/out/teeth.cmake"
check 'the others do not' test "$(grep -c 'exit 1' "$work/out/teeth.cmake")" = 1

# A header with a defect: what may include it is compiled anew when it changes, or when it has none any more.
mkdir -p "$work/source/hinge/material" && echo 'inline double half(double x) { return x / 2; }' >"$work/source/hinge/material/half.hpp"
printf '[[defect]]\nid = "half"\nfile = "hinge/material/half.hpp"\nfind = "x / 2"\nreplace = "x / 3"\nwhy = "a try"\ngates = ["a/b"]\n' \
  >"$work/defects/material.toml"
older() { find "$work/out" -name '*.[ch]pp' -exec touch -d '2020-01-01' {} + && run && [ "$work/out/fem/bar.cpp" "$1" "$work/before" ]; }
touch -d '2021-01-01' "$work/before"
run
check 'what stays as it is is not compiled anew' older -ot
echo '// more' >>"$work/source/hinge/material/half.hpp"
check 'what may include a header that has changed is' older -nt
check 'with the header' grep -q more "$work/out/hinge/material/half.hpp"
rm "$work/defects/material.toml"
check 'and what may include one without defects' older -nt
check 'which is gone' test ! -e "$work/out/hinge/material/half.hpp"

defect torn 'x + x' '2 * x' 'twice = x + x;' >"$work/defects/fem.toml"
sed -i 's/x + x/3 * x + x/' "$work/source/fem/bar.cpp"
sed -i 's/in = .*//' "$work/defects/fem.toml"
check 'what its neighbours take apart is not planted' run
check 'and named' grep -q 'takes a part of the expression x + x' "$work/words"
defect twice 'x' '0' >>"$work/defects/fem.toml" && defect twice 'x' '0' >>"$work/defects/fem.toml"
check 'two of one name are refused' sh -c "! '$plant' '$work/source' '$work/defects' '$work/out' 2>/dev/null"
echo 'gate = "a/b"' >>"$work/defects/fem.toml"
check 'and so are unknown keys' sh -c "! '$plant' '$work/source' '$work/defects' '$work/out' 2>/dev/null"
# Every line of the solvers may get a remark.
mkdir -p "$work/remarks" && cp -r "$source"/{hinge,fem,mpm,analytic,reports,runner} "$work/remarks"
find "$work/remarks" -name '*.[ch]pp' -exec sed -i '/[^\\]$/s#$#  // a remark#' {} +
unfit() { "$plant" "$1" "$source/tests/defects" "$work/out" 2>&1 | grep '^planted defect' | cut -d: -f1; }
unfit "$source" >"$work/unfit"
unfit "$work/remarks" >"$work/unfit_with_remarks"
check 'every defect that fits the sources fits them with remarks' cmp "$work/unfit" "$work/unfit_with_remarks"
echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
