# Sourced by scripts: counts checks and failures.
failures=0 checks=0
# expect STATUS PATTERN COMMAND...: exit status and a pattern in what is printed
expect() {
  local status=$1 pattern=$2 out got
  shift 2
  out=$("$@" 2>&1)
  got=$?
  checks=$((checks + 1))
  if [ "$got" -ne "$status" ] || ! grep -qE -- "$pattern" <<<"$out"; then
    echo "expected status $status and /$pattern/, got $got from: $*"
    echo "$out" | tail -n 15
    failures=$((failures + 1))
  fi
}
