#!/usr/bin/env bash
# coverage.sh PROGRAM FILE: every gate of every case must be named in FILE, the list of gates that some planted defect fails.
set -euo pipefail
program=$1 killed=$2
declared=$("$program" list --declarations | sed -n 's|^\[\(.*/.*\)\]$|\1|p')
[ -n "$declared" ] || { echo "no gates at all"; exit 1; }
missing=$(comm -23 <(sort -u <<<"$declared") <(sort -u "$killed"))
unknown=$(comm -13 <(sort -u <<<"$declared") <(sort -u "$killed"))
[ -z "$missing" ] || { echo "no planted defect fails:"; echo "$missing"; }
[ -z "$unknown" ] || { echo "planted defects name gates that do not exist:"; echo "$unknown"; }
[ -z "$missing$unknown" ]
