#!/usr/bin/env bash
# recipes.sh SOURCE: the recipes of docs/developing.md, word for word. Their files are written into a copy of the program, which
# is built with all of them at once; the commands after `$` are run there, and the lines below a command must be found in
# what it says, in this order. A headline that says "N files" is held to it, documents, tests and scenes not counted.
#
# The copy is built without optimisation, all sources of reports/ at once and all of runner/. What its object files tell is
# looked at (objects.sh), and so are names that hide others.
#
# A fenced block with a file behind its language belongs to that file: a new one, or with the language diff a change of one
# that is there, whose lines stand in it as they are.
set -uo pipefail
document=$1/docs/developing.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0 checks=0
wrong() { echo "wrong: $*"; failures=$((failures + 1)); }

mapfile -t parts < <(sed -n 's/^set(DIPTYCH_PARTS \(.*\))/\1/p' "$1/CMakeLists.txt" | tr ' ' '\n')
[ "${#parts[@]}" -gt 0 ] || { echo "no parts are named in CMakeLists.txt"; exit 1; }
(cd "$1" && cp -r --parents CMakeLists.txt cmake cases "${parts[@]}" "$work") || exit 1
cd "$work" || exit 1

# Lines that stand in the file once, with those that begin with - taken out and those with + put in.
change() { # change FILE BLOCK
  [ -f "$1" ] || { wrong "there is no $1"; return; }
  local text old new
  text=$'\n'$(<"$1") old=$'\n'$(sed -n 's/^[ -]//p' "$2") new=$'\n'$(sed -n 's/^[ +]//p' "$2")
  [[ $text == *"$old"* && ${text#*"$old"} != *"$old"* ]] || { wrong "these lines do not stand in $1 once:$old"; return; }
  text=${text%%"$old"*}$new${text#*"$old"}
  printf '%s\n' "${text#$'\n'}" >"$1"
}

# --- what the document says, in its order ---
recipe="" promised="" console=()
declare -A touched=()
count() {
  [ -z "$promised" ] && return
  checks=$((checks + 1))
  [ "${#touched[@]}" = "$promised" ] || wrong "$recipe: ${#touched[@]} files, not $promised: ${!touched[*]}"
}
block=$work/block fence="" n=0
while IFS= read -r line; do
  case $line in
    '```'?*)
      if [ -z "$fence" ]; then read -r fence file <<<"${line#'```'}"; : >"$block"; continue; fi
      ;;
    '```')
      if [ -z "$fence" ]; then fence=none; continue; fi
      case $fence in
        diff) change "$file" "$block" ;;
        console) console+=("$work/console.$n"); mv "$block" "$work/console.$n"; n=$((n + 1)) ;;
        none | sh) ;;
        *)
          if [ -n "$file" ]; then
            [ -e "$file" ] && wrong "$file is there already"
            mkdir -p "$(dirname "$file")" && mv "$block" "$file"
          fi
          ;;
      esac
      case $file in "" | docs/* | tests/* | cases/*) ;; */*) touched[$file]=1 ;; esac
      fence=""
      continue
      ;;
    '### '*)
      if [ -z "$fence" ]; then
        count
        recipe=${line#'### '} promised="" touched=()
        [[ $line =~ ([0-9]+)\ files?$ ]] && promised=${BASH_REMATCH[1]}
      fi
      ;;
  esac
  [ -n "$fence" ] && printf '%s\n' "$line" >>"$block"
done <"$document"
count
[ "$checks" -ge 5 ] || wrong "only $checks recipes say what they cost"
[ "$failures" = 0 ] || exit 1

cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Debug -DBUILD_TESTING=OFF \
  -DCMAKE_CXX_FLAGS_DEBUG="-g1 -ffunction-sections -fdata-sections -Wshadow -Wno-error=shadow" \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 >log 2>&1 &&
  cmake --build build --target diptych >log 2>&1 || { tail -n 40 log; exit 1; }
PATH=$work/build:$PATH
checks=$((checks + 1))
find build -name '*.o' ! -path '*diptych_main*' -exec "$1/tests/objects.sh" {} + || wrong "the object files"

# Of files compiled together, one's names hide another's, which is nothing; those of its own file or of a header are wrong.
checks=$((checks + 1))
hidden=$(awk '/\[-Wshadow/ { warning = $0; split($1, place, ":") }
  /note: shadowed declaration is here/ { split($1, of, ":")
    if (warning !~ /global declaration/ || of[1] == place[1] || of[1] ~ /hpp$/) print warning }' log | sort -u)
[ -z "$hidden" ] || { wrong "names that hide others"; echo "$hidden"; }

# --- what its commands say ---
ask() { # ask COMMAND LINES: each line of LINES is found in what the command says, after the one before
  checks=$((checks + 1))
  bash -c "$1" >said 2>&1
  local rest expected
  rest=$(<said)
  while IFS= read -r expected; do
    [[ $rest == *"$expected"* ]] || { wrong "\$ $1"; echo "does not say, in its place: $expected"; tail -n 30 said; return; }
    rest=${rest#*"$expected"}
  done <<<"$2"
}
for block in "${console[@]}"; do
  command="" lines=""
  while IFS= read -r line; do
    if [[ $line == '$ '* ]]; then
      [ -n "$command" ] && ask "$command" "$lines"
      command=${line#'$ '} lines=""
    else
      lines+=${lines:+$'\n'}$line
    fi
  done <"$block"
  [ -n "$lines" ] || wrong "$command: nothing is expected of it"
  ask "$command" "$lines"
done

echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
