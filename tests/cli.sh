#!/usr/bin/env bash
# cli.sh PROGRAM: what a user meets at the command line.
set -uo pipefail
tests=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
program=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
source "$tests/expect.sh"

expect 0 'diptych [0-9.]+ \(.*GNU|Clang' "$program" --version
expect 0 'paper' "$program" --help
expect 14 'subcommand' "$program"
expect 14 "no command 'gaet' \(did you mean 'gate'" "$program" gaet
expect 14 "did you mean 'bar.step.fixed-free'" "$program" gate bar.step.fixed-fre
expect 14 'no figure .fig99.' "$program" paper fig99
expect 14 'cannot|No such file' "$program" run nowhere.toml
expect 14 'not in range' "$program" gate bar.energy -j 0
expect 0 '^DIPTYCH-VERDICT PASS gates=2/2 passed=2' "$program" gate bar.energy
expect 0 'bar.energy/repeat: PASS' "$program" explain bar.energy/repeat
expect 0 'shadow-energy' "$program" list bar.energy
expect 0 '^max = 1e-12$' "$program" list --declarations bar.energy/shadow-energy
expect 0 'fixed–free' "$program" show bar.energy

# What accuracy costs.
expect 0 'fem N=100 C=1 .*front' "$program" trade bar.step.fixed-free --rounds 0 --quantity stress.L1 --out traded
expect 0 '^fem N=100 C=1,fem C=1,,fem,100,' cat traded/trade/bar.step.fixed-free.csv
expect 0 'mpm-usl N=100 C=0.75 ppc=1  +unstable' "$program" trade bar.step.fixed-free --rounds 0 --over courant=0.75 --out traded
expect 0 'fem N=50 C=0.9: 0.449 %' "$program" pick bar.mode.fixed-free --error 1%
expect 0 'confirmed' "$program" pick bar.mode.fixed-free --error 0.1%
expect 10 'none of the measured settings does' "$program" pick bar.mode.fixed-free --error 1e-7
expect 10 'none of the measured settings does' "$program" pick bar.mode.fixed-free --error 1% --memory 100
expect 14 'allowed: 1% or 0.01' "$program" pick bar.mode.fixed-free --error much
expect 14 '; did you mean "stress.L1"' "$program" trade bar.mode.fixed-free --rounds 0 --quantity stres.L1 --out traded
expect 14 'time: found 0.123; allowed' "$program" trade bar.mode.fixed-free --rounds 0 --time 0.123 --out traded
expect 14 'did you mean "courant"' "$program" trade bar.mode.fixed-free --over courrant=1
expect 0 'elastic +fem +[0-9]+ +[0-9x]+ +1 +[0-9.]+' "$program" bench elastic --points 600 --rounds 1 --threads 1 --json bench.jsonl
expect 0 '"type":"bench","scene":"elastic","method":"mpm-musl"' cat bench.jsonl
expect 14 'found "elastik"; allowed: .*did you mean "elastic"' "$program" bench elastik
expect 14 'method: found "femm"; allowed: .*did you mean "fem"' "$program" bench --method femm
expect 0 'viscosity +bar +fem +600 zero +same .* 0.00 ' "$program" bench --off viscosity --points 600 --rounds 1 --json off.jsonl
expect 0 '"type":"off","feature":"viscosity","scene":"bar","method":"mpm-musl"' cat off.jsonl
expect 14 'found "viscousity"; allowed: .*did you mean "viscosity"' "$program" bench --off viscousity
expect 14 'allowed with --off: 1' "$program" bench --off --threads 2
expect 14 'strict-time requires --off' "$program" bench --strict-time
expect 0 'plasticity  required: ' "$program" ablate impact.hardening --out ablated
expect 0 '^fem N=100 C=0.5,convection,off,.*,completed,' cat ablated/ablate/impact.hardening.csv
expect 0 '"type":"ablation","case":"impact.hardening"' cat ablated/ablate/impact.hardening.json
expect 0 'viscosity +NOT REQUIRED HERE: ' "$program" ablate viscosity.front --cells 400 --scene c1=1 --out ablated
expect 14 '; did you mean "c1=1"' "$program" ablate viscosity.front --scene c1=11 --out ablated
expect 14 '2 cases; allowed: one' "$program" ablate bar.mode.fixed-free bar.energy
expect 14 '2 cases; allowed: one' "$program" trade bar.mode.fixed-free bar.energy
expect 14 'found "plain"; allowed: "", "plane-stress"' "$program" pick plate.s-wave --rounds 0 --error 1% --scene plain
expect 14 'did you mean "seconds"' "$program" pick bar.mode.fixed-free --error 1% --by second
expect 14 'rounds to time' "$program" pick bar.mode.fixed-free --error 1% --seconds 1 --rounds 0

# Up to which step settings are stable.
expect 0 'fem N=50 +1\.000.*1\.0000' "$program" stability bar.mode.fixed-free --out looked
expect 0 'limits, [0-9]+ with a theory, all within 1 %' "$program" stability bar.mode.fixed-free --out looked
expect 0 '^fem N=50,fem N=50,fem,,1\.000' cat looked/stability/bar.mode.fixed-free.csv
expect 10 'OFF' "$program" stability bar.stability.limits --within 1e-6 --out looked
expect 0 'none to 64' "$program" stability diffusion.mode --over diffusion.scheme=rkl2 --out looked
expect 14 'Courant numbers are what is sought' "$program" stability bar.mode.fixed-free --over courant=0.5
expect 14 'numbers from 0 to 1, the sides' "$program" stability bar.mode.fixed-free --over position=2
expect 0 'fem N=20 v0=30 +(0\.99|1\.00).*' "$program" stability impact.speed --limit-of courant=0.1:3 --over v0=30 --out looked
expect 0 'inside out' "$program" stability impact.speed --limit-of v0=1:300 --out looked
expect 14 'found "v1"; allowed: .*"v0"' "$program" stability impact.speed --limit-of v1=1:300
expect 14 'KEY=LEAST:MOST' "$program" stability impact.speed --limit-of v0=300
expect 14 '2 cases; allowed: one' "$program" stability bar.mode.fixed-free bar.energy

# A scene of one's own, and what happens to a gate that cannot hold.
cat > own.toml <<'TOML'
schema = 1
id = "own"
title = "My bar"
claim = "code-verification"
why = "to try"
units = "SI"
[bar]
length = 2.0
[material]
model = "elastic"
E = 2e11
rho = 7800.0
[supports]
left = "free"
right = "fixed"
[[load]]
at = "left"
history = "step"
traction = 1e6
[model]
features = ["elastic"]
[exact]
solution = "bar-wave"
[[axes]]
method = ["fem", "mpm-musl"]
cells = [50, 100]
courant = [0.5]
[sample]
times = { unit = "L/c", at = [0.5] }
[[gate]]
id = "close"
kind = "exact"
quantity = "stress.L1"
max = 0.2
reason = "a guess"
TOML
expect 0 'fem' "$program" run own.toml --out results
expect 0 '"type":"run"' cat results/results.jsonl
expect 0 'DIPTYCH-VERDICT PASS' "$program" gate own.toml
expect 0 'own/close: PASS' "$program" explain own.toml/close
expect 14 "did you mean 'close'" "$program" gate own.toml/clos
expect 0 'ledgers/own' "$program" run own.toml --ledger --out results
expect 0 '^time,kinetic,strain,dissipated,viscous,contact,scheme,work,lost,momentum,impulse' sh -c 'cat results/ledgers/own/fem*.csv'
expect 14 'cannot write to' "$program" run own.toml --out own.toml/results

# One run of it alone, and its fields.
expect 0 'fields/own/fem_N=50_C=0.5.elements.csv' "$program" run --only 'fem N=50 C=0.5' own.toml --fields --out one
expect 0 '^t .L/c.,bar,x .m.,displacement .m.,exact displacement .m.,velocity .m/s.,exact velocity .m/s.$' \
  cat one/fields/own/fem_N=50_C=0.5.nodes.csv
expect 0 '^51 ' sh -c 'wc -l <one/fields/own/fem_N=50_C=0.5.elements.csv | sed "s/$/ /"'
expect 0 '^1 ' sh -c 'wc -l <one/results.jsonl | sed "s/$/ /"'
expect 0 'particles.csv' "$program" run own.toml --only 'mpm*' --only 'fem N=100*' --fields --out two
expect 0 '^3 ' sh -c 'wc -l <two/results.jsonl | sed "s/$/ /"'
expect 14 "no run 'fem N=51 C=0.5' .did you mean 'fem N=50 C=0.5'" "$program" run own.toml --only 'fem N=51 C=0.5'
expect 14 '^  mpm-musl N=100 C=0.5 ppc=1$' "$program" run own.toml --only 'mpm-musl'
expect 12 'cannot write|standard output' sh -c "'$program' list >/dev/full"
sed 's/max = 0.2/max = 1e-9/' own.toml > strict.toml
expect 10 'DIPTYCH-VERDICT FAIL gates=1/1 passed=0' "$program" gate strict.toml
expect 10 '^FAIL +own/close +.*outside' "$program" gate --fail-fast strict.toml
expect 0 '"status":"left out"' sh -c "'$program' gate --fail-fast -j1 strict.toml --json f.jsonl >/dev/null 2>&1; [ \$? = 10 ] && cat f.jsonl"
sed 's/^id = "close"/id = "close"\nslow = true/' own.toml > slow.toml
expect 13 '^LEFT OUT +own/close' "$program" gate --quick slow.toml
sed 's/rho = 7800.0/rho = -7800.0/' own.toml > negative.toml
expect 14 'negative.toml:1[0-9].*rho.*-7800' "$program" gate negative.toml
sed 's/^traction = /tracton = /' own.toml > typo.toml
expect 14 'typo.toml:[0-9]+.*tracton.*traction' "$program" gate typo.toml
sed 's/courant = \[0.5\]/courant = [1.5]/' own.toml > fast.toml
expect 14 'above the limit' "$program" gate fast.toml
sed 's/features = \["elastic"\]/features = ["plasticity"]/' own.toml > features.toml
expect 14 'features' "$program" gate features.toml

# A plate of one's own: pulled within 20 µs, with damage that spreads; its fields for ParaView; what is refused.
cat > plate.toml <<'TOML'
schema = 1
id = "slab"
title = "My slab"
claim = "robustness"
why = "to try"
units = "SI"
[plate]
width = 0.4
height = 0.6
[material]
model = "tensile-damage"
E = 30e9
nu = 0.2
rho = 2400
plane = "strain"
K_IC = 1e6
k = 5e22
m = 7
[damage]
critical_strain = 0.001
rate = "tracked"
[diffusion]
T_d = 0.001
lambda1 = 200
lambda2 = 0.01
rupture_strain = 0.01
source = "zone"
radius = 0.05
scheme = "rkl2"
[supports]
left = "roller"
right = "free"
bottom = "roller"
top = "free"
[[load]]
at = "top"
history = "ramp"
traction = 200e6
rise = { value = 20e-6, unit = "s" }
[model]
features = ["damage", "diffusion"]
[axes]
method = ["fem", "mpm-musl"]
cells = [8]
courant = [0.5]
[sample]
times = { unit = "s", at = [1e-4, 2e-4] }
[[gate]]
id = "balance"
kind = "invariant"
quantity = "concentration.balance"
max = 1e-12
reason = "no flux through the sides"
TOML
expect 0 'fem' "$program" run plate.toml --fields --out slab
expect 0 'particles' sh -c 'ls slab/fields/slab'
expect 0 'DataSet.*timestep.*file=.*vtu' sh -c 'cat slab/fields/slab/*.pvd'
expect 0 'crack density' sh -c 'cat slab/fields/slab/*cells.0001.vtu'
expect 0 'plate.*0.4' "$program" show plate.toml
sed 's/^radius = 0.05/raduis = 0.05/' plate.toml > plate-typo.toml
expect 14 "plate-typo.toml:[0-9]+.*diffusion.raduis.*did you mean.*radius" "$program" gate plate-typo.toml
sed 's/courant = \[0.5\]/courant = [0.6]/' plate.toml > plate-fast.toml
expect 14 'above the limit' "$program" gate plate-fast.toml

cat > spread.toml <<'TOML'
schema = 1
id = "spread"
title = "Diffusion alone"
claim = "robustness"
why = "to try"
units = "SI"
[plate]
width = 1.0
height = 1.0
[diffusion]
diffusivity = 1.0
scheme = "forward-euler"
[initial]
concentration = "x*y"
[model]
features = ["diffusion"]
[axes]
method = ["diffusion"]
cells = [10]
courant = [0.2525]
[sample]
times = { unit = "s", at = [0.5] }
[[gate]]
id = "balance"
kind = "invariant"
quantity = "concentration.balance"
max = 1e-12
reason = "no flux through the sides"
TOML
expect 14 'time step of 0.002525, above the limit 0.0025 ' "$program" gate spread.toml

# Results do not depend on the number of threads (wall time aside) and are never half there.
expect 0 'VERDICT PASS' "$program" gate 'bar.step.*' -j1 --json one.jsonl
expect 0 'VERDICT PASS' "$program" gate 'bar.step.*' -j2 --json two.jsonl
strip() { sed -E 's/"wall_s(econds)?":[^,}]*//g' "$1"; }
if [ "$(strip one.jsonl | md5sum)" != "$(strip two.jsonl | md5sum)" ]; then
  echo "one thread and two give different results"
  failures=$((failures + 1))
fi
expect 14 'No such file|Not a directory|cannot' "$program" gate bar.energy --json /dev/null/x/y.jsonl
expect 12 'space|full|cannot' "$program" gate bar.energy --json /dev/full
expect 0 '<testcase' sh -c "'$program' gate bar.energy --junit j.xml >/dev/null 2>&1 && cat j.xml"

# Without gnuplot everything but the pictures is there, and it says so.
mkdir empty
expect 0 'gnuplot is not installed' env PATH="$work/empty" "$program" paper fig2 --out nopic
expect 0 '' test -s nopic/paper/figures/fig2.gp
expect 0 '' test -s nopic/paper/figures/fig2.csv
expect 0 '' test -s nopic/paper/results.jsonl

# Ctrl-C: stops soon, says what it kept, exits with a status of its own.
sed -e 's/cells = \[50, 100\]/cells = [20000, 30000]/' own.toml > long.toml
"$program" run long.toml --out stopped >stopped.txt 2>&1 &
pid=$!
sleep 1
kill -INT "$pid"
wait "$pid"
status=$?
checks=$((checks + 1))
if [ "$status" -ne 12 ] || ! grep -q 'stopped on request' stopped.txt; then
  echo "Ctrl-C: status $status"
  tail -n 5 stopped.txt
  failures=$((failures + 1))
fi

# In the first moments of a gate, too: what was not run is not judged, and nothing is said of it.
"$program" gate >gated.txt 2>&1 &
pid=$!
sleep 0.3
kill -INT "$pid"
began=$SECONDS
wait "$pid"
status=$?
checks=$((checks + 1))
if [ "$status" -ne 12 ] || [ $((SECONDS - began)) -gt 5 ] || grep -q '^ERROR' gated.txt ||
  ! grep -q '^DIPTYCH-VERDICT ERROR gates=' gated.txt; then
  echo "Ctrl-C of gate: status $status after $((SECONDS - began)) s"
  tail -n 5 gated.txt
  failures=$((failures + 1))
fi

echo "$checks checks, $failures failed"
[ "$failures" -eq 0 ]
