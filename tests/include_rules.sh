#!/usr/bin/env bash
# include_rules.sh SOURCE: who may include whom. An oracle that calls what it judges is no oracle.
set -uo pipefail
cd "$1" || exit 1
broken=0 looked=0
only() { # only FOLDER OTHERS [EXCEPT]: files of FOLDER, but for EXCEPT, include headers of OTHERS (an alternation) alone
  local files found
  files=$(find "$1" -name '*.[ch]pp' | grep -vE "${3:-^$}")
  [ -n "$files" ] || { echo "no sources in $1"; broken=1; return; }
  looked=$((looked + $(wc -l <<<"$files")))
  # shellcheck disable=SC2086
  found=$(grep -HnE '#include "' $files | grep -vE "#include \"(($2)[/.]|diptych_version.hpp)")
  [ -z "$found" ] || { echo "$1 may include $2 alone:"; echo "$found"; broken=1; }
}
only hinge/material hinge/material
only hinge/diffusion 'hinge/(diffusion|wide)'
only hinge/solid 'hinge/(material|diffusion|solid|wide)'
only hinge/scene 'hinge/(material|diffusion|solid|scene|step)'
only hinge/step 'hinge/(material|diffusion|solid|scene|step)'
only fem 'hinge|fem'
only mpm 'hinge|mpm'
only analytic analytic
only reports reports
# panel.cpp alone knows the solvers; what diffuses alone has none.
[ "$(grep -rlE '#include "(fem|mpm)/' runner --include='*.[ch]pp')" = runner/panel.cpp ] ||
  { echo "runner/panel.cpp alone includes fem/ and mpm/:"; grep -rnE '#include "(fem|mpm)/' runner; broken=1; }
# And what a method is stands in that table alone: nobody else decides by a name. (contact.fem is a key of case files.)
named=$(grep -rnE '"(fem|mpm)[-"]' runner reports --include='*.[ch]pp' | grep -vE '^runner/panel.cpp:|//.*"(fem|mpm)|t[.]need\("fem", one_of' )
[ -z "$named" ] || { echo "a method's name outside of runner/panel.cpp:"; echo "$named"; broken=1; }
only runner/input 'hinge|analytic|reports|runner/(input|panel|diffusion_alone)'
only runner/compare 'hinge|analytic|reports|runner/(input|compare|panel)'
only runner/store 'reports|runner/store'
only runner/run 'hinge|analytic|reports|runner/(input|compare|store|run|panel|diffusion_alone)'
only runner/judge 'hinge|analytic|reports|runner/(input|compare|run|judge|panel|registry)'
only runner/draw 'hinge|analytic|reports|runner/(input|compare|draw|panel|registry)'
# A case is read anew with a key of its file changed.
only runner/trade 'hinge|analytic|reports|runner/(input|compare|run|draw|trade|panel|app/case_file)'
only runner/stability 'hinge|analytic|reports|runner/(input|run|draw|trade|stability|panel|diffusion_alone)'
only runner/ablate 'hinge|analytic|reports|runner/(input|compare|run|trade|ablate|panel|app/case_file)'
only runner/app 'hinge|analytic|reports|runner'
# GSL's error handler is one for the whole process: whoever changes it beside other threads changes it for them.
handlers=$(grep -rlE 'gsl_set_error_handler' analytic fem hinge mpm reports runner tests --include='*.[ch]pp' | sort | tr '\n' ' ')
[ "$handlers" = 'runner/app/main.cpp tests/main.cpp ' ] ||
  { echo "main() alone sets GSL's error handler, not: $handlers"; broken=1; }
echo "$looked files"
exit "$broken"
