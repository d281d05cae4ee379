#!/usr/bin/env bash
# lint.sh format SOURCE: every source stands as clang-format 14 would write it.
# lint.sh tidy SOURCE BUILD PART: clang-tidy 19 and clang's own warnings find nothing in a folder's sources (.clang-tidy).
# Exit status 77, for ctest a test that was skipped: the tool is not on this machine.
set -euo pipefail
what=$1
cd "$2"
need() { command -v "$1" >/dev/null || { echo "skipped: $1 is not installed (apt-get install $2)"; exit 77; }; }
case $what in
  format)
    need clang-format-14 clang-format-14
    mapfile -t files < <(find hinge fem mpm analytic reports runner tests -name '*.[ch]pp' | sort)
    clang-format-14 --dry-run -Werror "${files[@]}"
    ;;
  tidy)
    need clang-tidy-19 clang-tidy-19
    tidy() { clang-tidy-19 --quiet "$@" 2> >(grep -vE '^[0-9]+ warnings? (and [0-9]+ errors? )?generated' >&2); }
    # The sources of a folder are read all at once: most of the work is what they include.
    flags=$(sed -n "s#^  \"command\": \"[^ ]* \(.*\) -Winvalid-pch .*/diptych_$4[.]dir/.*#\1#p" "$3/compile_commands.json")
    mapfile -t files < <(find "$PWD/$4" "$3/generated/$4" -name '*.cpp' ! -path '*/app/main.cpp' 2>/dev/null | sort)
    [ -n "$flags" ] || { echo "no sources of $4 in $3/compile_commands.json"; exit 1; }
    printf '#include "%s"\n' "${files[@]}" >"$3/tidy_$4.cpp"
    # shellcheck disable=SC2086
    tidy "$3/tidy_$4.cpp" -- ${flags%%$'\n'*}
    [ "$4" != runner ] || tidy -p "$3" "$PWD/runner/app/main.cpp"
    ;;
esac
echo "${#files[@]} files"
