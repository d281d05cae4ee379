#!/usr/bin/env bash
# price.sh PROGRAM SOURCE: what docs/price.md prints. The commands after `$` are run, and the lines below each must be what it
# prints, all of them and in this order.
set -uo pipefail
program=$(readlink -f "$1")
document=$(readlink -f "$2")/docs/price.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0 commands=0 command="" inside=""
compare() {
  [ -z "$command" ] && return
  commands=$((commands + 1))
  # shellcheck disable=SC2086
  "$program" $command >printed 2>/dev/null
  diff -u expected printed >different || { echo "wrong: ./diptych $command"; cat different; failures=$((failures + 1)); }
  command=""
}
while IFS= read -r line; do
  case $line in
    '```console') inside=yes ;;
    '```') compare; inside="" ;;
    '$ ./diptych '*)
      compare
      command=${line#'$ ./diptych '}
      : >expected
      ;;
    *) [ -z "$inside" ] || printf '%s\n' "$line" >>expected ;;
  esac
done <"$document"
echo "$commands commands"
[ "$commands" -gt 0 ] && [ "$failures" = 0 ]
