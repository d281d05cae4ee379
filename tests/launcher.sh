#!/usr/bin/env bash
# launcher.sh SOURCE PROGRAM: what a user meets before there is a program, and where one may be run but not built.
set -uo pipefail
tests=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
source=$1 program=$2
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
chmod 755 "$work"
source "$tests/expect.sh"
# Somebody who may not write here; root may everywhere.
as_another() {
  if [ "$(id -u)" = 0 ]; then setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; else "$@"; fi
}

mkdir -p "$work/clone/runner/app" "$work/bin"
cp "$source/diptych" "$source/CMakeLists.txt" "$work/clone"
cp "$source/runner/app/main.cpp" "$work/clone/runner/app"

# A fresh clone: told without installing or building anything.
for tool in apt-get dpkg-query cmake ninja; do
  printf '#!/bin/sh\necho called >>"%s"\nexit 1\n' "$work/called" >"$work/bin/$tool"
  chmod +x "$work/bin/$tool"
done
fresh=(env PATH="$work/bin:$PATH" "$work/clone/diptych")
for command in $("$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]*\) .*/\1/p'); do
  expect 0 "^  $command  " "${fresh[@]}" --help
done
[ "$checks" -ge 5 ] || { echo "the program names $checks commands"; failures=$((failures + 1)); }
expect 0 'diptych [0-9.]+ \(.*\), not built yet' "${fresh[@]}" --version
expect 0 'Usage' env -i "$work/clone/diptych" --help
if [ -e "$work/called" ] || [ -e "$work/clone/build" ]; then
  echo "--help and --version installed or built something"
  failures=$((failures + 1))
fi

# Somebody else's build, or one on a read-only file system: used as it is.
mkdir -p "$work/clone/build/release"
printf '#!/bin/sh\necho "ran $*"\n' >"$work/clone/build/release/diptych"
chmod +x "$work/clone/build/release/diptych"
chmod -R a-w "$work/clone/build"
expect 0 '^ran list bar.energy$' as_another env PATH="$work/bin:$PATH" "$work/clone/diptych" list bar.energy
expect 14 'tests are built .* may not be written' as_another env PATH="$work/bin:$PATH" "$work/clone/diptych" test
touch -d '+1 minute' "$work/clone/runner/app/main.cpp"
expect 14 'main.cpp is newer than the program' as_another env PATH="$work/bin:$PATH" "$work/clone/diptych" list

# Tests by parts.
expect 0 '^unit_tests planted$' "$program" test --targets
expect 0 '^planted$' "$program" test teeth --targets
expect 0 '^unit_tests$' "$program" test unit cli --quick --targets
expect 0 '^$' "$program" test lint recipes --targets
expect 14 "no part of the tests is called 'gate'; .*did you mean \"gates\"" "$program" test gate
expect 14 'planted defects are what --quick leaves out' "$program" test teeth --quick

# Lint goes on without tools that are not to be had, and says so; what it does not need is not asked for.
chmod -R u+w "$work/clone/build"
printf '#!/bin/sh\necho "$*" >>%s/configured\n' "$work" >"$work/bin/cmake"
printf '#!/bin/sh\nexit 1\n' >"$work/bin/sudo"
printf '#!/bin/sh\ncase "$*" in *clang*) exit 1 ;; *) printf installed ;; esac\n' >"$work/bin/dpkg-query"
touch "$work/clone/build/release/build.ninja"
printf '#!/bin/sh\n[ "$2" = --targets ] || [ "$3" = --targets ] || echo "ran $*"\n' >"$work/clone/build/release/diptych"
rm -f "$work/called"
# Whatever the part, ctest finds its tests only in a build that was configured with them.
expect 0 '^ran test cli$' "${fresh[@]}" test cli
expect 0 'BUILD_TESTING=ON' cat "$work/configured"
[ ! -e "$work/called" ] || { echo "test cli asked for packages"; failures=$((failures + 1)); }
expect 0 'install.* clang-format-14 clang-tidy-19$' "${fresh[@]}" test cli lint
expect 0 'going on without' "${fresh[@]}" test lint
expect 0 '^ran test lint$' "${fresh[@]}" test lint

echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
