# Planted defects. Each takes one file of the solvers, replaces one piece of text, and builds the whole program from it:
# no hook for it stands in the code. The gates that it must fail are named; together they must be all gates there are.
# A defect of the oracle that its self-test finds makes its gates INVALID instead.
#
#   mutant(NAME FILE file FIND text REPLACE text [VERDICT INVALID] KILLS gate...)

set(killed_list ${CMAKE_CURRENT_BINARY_DIR}/killed.txt)
file(WRITE ${killed_list} "")

function(mutant name)
  cmake_parse_arguments(PARSE_ARGV 1 M "" "FILE;FIND;REPLACE;VERDICT" "KILLS")
  set(source ${PROJECT_SOURCE_DIR}/${M_FILE})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  file(READ ${source} text)
  string(FIND "${text}" "${M_FIND}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "planted defect ${name}: ${M_FILE} no longer holds\n${M_FIND}\nso the defect must be planted anew")
  endif()
  string(REPLACE "${M_FIND}" "${M_REPLACE}" text "${text}")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/mutants/${name})
  set(mutated ${folder}/${M_FILE})
  set(before "")
  if(EXISTS ${mutated})
    file(READ ${mutated} before)
  endif()
  if(NOT before STREQUAL text)
    file(WRITE ${mutated} "${text}")
  endif()

  set(target mutant_${name})
  add_executable(${target} $<TARGET_OBJECTS:diptych_main>)
  target_include_directories(${target} BEFORE PRIVATE ${folder})
  if(M_FILE MATCHES "[.]cpp$")
    target_sources(${target} PRIVATE ${mutated})
  else()  # a header of the materials
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/fem/bar.cpp ${PROJECT_SOURCE_DIR}/mpm/bar.cpp)
  endif()
  # What the defect's own objects define, the libraries' are not asked for.
  target_link_libraries(${target} PRIVATE diptych_cases diptych_fem diptych_mpm)
  target_compile_options(${target} PRIVATE -O1 -Wno-error)

  if(NOT M_VERDICT)
    set(M_VERDICT FAIL)
    string(REPLACE ";" "\n" lines "${M_KILLS}")
    file(APPEND ${killed_list} "${lines}\n")
  endif()
  add_test(NAME teeth.${name}
    COMMAND ${PROJECT_SOURCE_DIR}/tests/teeth.sh $<TARGET_FILE:${target}> ${M_VERDICT} ${M_KILLS})
  set_tests_properties(teeth.${name} PROPERTIES LABELS teeth TIMEOUT 120)
endfunction()

# --- material -----------------------------------------------------------------------------------------------------------

mutant(modulus FILE material/material.hpp
  FIND    "state.stress += youngs_modulus * strain_increment"
  REPLACE "state.stress += 1.01 * youngs_modulus * strain_increment"
  KILLS bar.step.fixed-free/fem-constant bar.step.fixed-free/musl-constant bar.step.fixed-free/usf-constant
        bar.step.fixed-free/usl-constant bar.step.fixed-free/airy-constant
        bar.step.free-free/constant bar.impulse.free-free/constant
        bar.mode.fixed-free/displacement-constant bar.mode.fixed-free/displacement-order
        bar.mode.fixed-free/stress-constant bar.mode.fixed-free/stress-order
        bar.mode.fixed-free/velocity-constant bar.mode.fixed-free/velocity-order)

mutant(flight-hides-what-grows-inside FILE material/ledger.hpp
  FIND    "free_mass_ > 0 ? momentum * momentum / (2 * free_mass_) : 0"
  REPLACE "0 * momentum"
  KILLS bar.convection.crossing/detected)

# --- both methods alike -------------------------------------------------------------------------------------------------

mutant(fem-density FILE fem/bar.cpp
  FIND    "* law.density * h_;"
  REPLACE "* 1.01 * law.density * h_;"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-magic-displacement bar.step.fixed-free/fem-constant
        bar.step.free-free/fem-magic-step bar.impulse.free-free/fem-magic-step
        bar.step.fixed-free/displacement-l1 bar.step.fixed-free/displacement-l2
        bar.mode.fixed-free/displacement-constant)
mutant(mpm-density FILE mpm/bar.cpp
  FIND    "laws[b].density * h_"
  REPLACE "1.01 * laws[b].density * h_"
  KILLS bar.step.fixed-free/musl-magic-step bar.step.free-free/musl-magic-step bar.impulse.free-free/musl-magic-step
        bar.step.fixed-free/musl-constant bar.step.fixed-free/usf-constant bar.step.fixed-free/usl-constant
        bar.step.fixed-free/usl-order bar.mode.fixed-free/stress-constant)

mutant(fem-load FILE fem/bar.cpp
  FIND    "load.mean_traction(kick.from, kick.to)"
  REPLACE "0.99 * load.mean_traction(kick.from, kick.to)"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-magic-displacement bar.step.fixed-free/fem-constant
        bar.step.free-free/constant bar.traction.node/end-stress bar.step.fixed-free/displacement-linf)
mutant(mpm-load FILE mpm/bar.cpp
  FIND    "load.mean_traction(kick.from, kick.to)"
  REPLACE "0.99 * load.mean_traction(kick.from, kick.to)"
  KILLS bar.step.fixed-free/musl-magic-step bar.step.fixed-free/musl-constant bar.step.fixed-free/usf-constant
        bar.step.fixed-free/usl-constant bar.traction.node/end-stress bar.traction.layer/end-stress)

mutant(full-first-step FILE material/stepping.hpp
  FIND    "if (n == 0) return {0, half, half};"
  REPLACE "if (n == 0) return {0, time_step, time_step};"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-magic-displacement bar.step.fixed-free/fem-constant
        bar.step.fixed-free/musl-magic-step bar.step.fixed-free/musl-constant bar.step.fixed-free/usl-constant
        bar.impulse.free-free/constant)
mutant(usf-kicks-half-a-step-early FILE material/stepping.hpp
  FIND    "return {time, time + time_step, time_step};"
  REPLACE "return {time, time + time_step / 2, time_step / 2};"
  KILLS bar.step.fixed-free/usf-constant)

mutant(fem-load-a-step-late FILE fem/bar.cpp
  FIND    "load.mean_traction(kick.from, kick.to)"
  REPLACE "(kick.from < dt_ ? 0 : load.mean_traction(kick.from - dt_, kick.to - dt_))"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-constant bar.step.free-free/constant)
mutant(musl-filters-a-little-less FILE mpm/bar.cpp
  FIND    "const double momentum = mass(p) * velocity_[p];
          return Pair{(0.5 - offset_[p]) * momentum, (0.5 + offset_[p]) * momentum};"
  REPLACE "const double momentum = mass(p) * velocity_[p];
          return Pair{(0.5 - offset_[p]) * momentum, (0.5 + offset_[p]) * (1 + 1e-6) * momentum};"
  KILLS bar.step.fixed-free/musl-is-fem-on-half-the-cells bar.step.free-free/musl-is-fem-on-half-the-cells
        bar.impulse.free-free/musl-is-fem-on-half-the-cells)
mutant(mpm-load-a-step-late FILE mpm/bar.cpp
  FIND    "load.mean_traction(kick.from, kick.to)"
  REPLACE "(kick.from < dt_ ? 0 : load.mean_traction(kick.from - dt_, kick.to - dt_))"
  KILLS bar.step.fixed-free/musl-magic-step bar.step.fixed-free/musl-constant bar.step.fixed-free/usf-constant)

mutant(fem-damping FILE fem/bar.cpp
  FIND    "velocity_[i] += kick * force_[i] / mass_[i]"
  REPLACE "velocity_[i] = 0.99999 * velocity_[i] + kick * force_[i] / mass_[i]"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-constant bar.step.fixed-free/energy
        bar.step.fixed-free/momentum bar.energy/shadow-energy bar.body-force/energy bar.body-force/momentum
        bar.step.free-free/energy bar.impulse.free-free/energy
        bar.initial-state/momentum)
mutant(mpm-damping FILE mpm/bar.cpp
  FIND    "velocity_[p] += kick * ("
  REPLACE "velocity_[p] = 0.99999 * velocity_[p] + kick * ("
  KILLS bar.step.fixed-free/musl-constant bar.step.fixed-free/usf-constant bar.step.fixed-free/energy
        bar.step.fixed-free/momentum bar.energy/shadow-energy bar.traction.layer/momentum bar.traction.node/momentum
        bar.convection.rigid/momentum bar.convection.rigid/velocity bar.convection.rigid/usl-velocity
        bar.convection.rigid/displacement
        bar.traction.layer-left/momentum bar.traction.layer-left/energy)

# --- FEM ----------------------------------------------------------------------------------------------------------------

mutant(fem-full-mass-at-the-ends FILE fem/bar.cpp
  FIND    "(i == 0 || i == cells_ ? 0.5 : 1.0)"
  REPLACE "1.0"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-constant bar.mode.fixed-free/displacement-order
        bar.mode.fixed-free/stress-constant bar.body-force/displacement-order bar.body-force/velocity-order)

# M = ρh/6 (1 4 1), ρh/6 (2 1) at the ends, solved by elimination.
mutant(fem-consistent-mass FILE fem/bar.cpp
  FIND    "for (std::size_t i = 0; i <= cells_; ++i) velocity_[i] += kick * force_[i] / mass_[i];"
  REPLACE "std::vector<double> a(force_), d(cells_ + 1);
    if (scene_.left == Support::fixed) a[0] = 0;
    if (scene_.right == Support::fixed) a[cells_] = 0;
    const double off = mass_[1] / 6;
    for (std::size_t i = 0; i <= cells_; ++i) d[i] = (i == 0 || i == cells_) ? 2 * off : 4 * off;
    for (std::size_t i = 1; i <= cells_; ++i) {
      d[i] -= off * off / d[i - 1];
      a[i] -= off * a[i - 1] / d[i - 1];
    }
    for (std::size_t i = cells_ + 1; i-- > 0;) {
      a[i] = (a[i] - (i < cells_ ? off * a[i + 1] : 0)) / d[i];
      velocity_[i] += kick * a[i];
    }"
  KILLS bar.step.free-free/constant bar.impulse.free-free/constant bar.stability.limits/fem)

mutant(fem-strong-damping FILE fem/bar.cpp
  FIND    "velocity_[i] += kick * force_[i] / mass_[i]"
  REPLACE "velocity_[i] = 0.9 * velocity_[i] + kick * force_[i] / mass_[i]"
  KILLS bar.stability.limits/fem)

mutant(fem-absolute-tolerance FILE fem/bar.cpp
  FIND    "(velocity_[e + 1] - velocity_[e]) / h_"
  REPLACE "(velocity_[e + 1] - velocity_[e] + 1e-15) / h_"
  KILLS bar.step.fixed-free/power-of-two)
mutant(fem-one-sided-rounding FILE fem/bar.cpp
  FIND    "displacement_[i] += dt * velocity_[i]"
  REPLACE "displacement_[i] += dt * velocity_[i] * (velocity_[i] > 0 ? 1 + 1e-15 : 1)"
  KILLS bar.step.fixed-free/mirror bar.step.free-free/mirror bar.impulse.free-free/mirror)
mutant(fem-remembers-the-last-run FILE fem/bar.cpp
  FIND    "    for (auto& mesh : meshes_) mesh.internal_force();"
  REPLACE "    static double noise = 0; noise += 1e-17; first().velocity_at(1) += noise;
    for (auto& mesh : meshes_) mesh.internal_force();"
  KILLS bar.energy/repeat)
mutant(fem-load-on-one-end-reversed FILE fem/bar.cpp
  FIND    "load_[0] -= traction"
  REPLACE "load_[0] += traction"
  KILLS bar.step.free-free/fem-magic-step bar.impulse.free-free/fem-magic-step bar.step.free-free/constant
        bar.impulse.free-free/constant)
mutant(fem-impulse-forgets-the-support FILE fem/bar.cpp
  FIND    "sum -= first().force_at(0)"
  REPLACE "sum -= 0.999999 * first().force_at(0)"
  KILLS bar.step.fixed-free/momentum bar.body-force/momentum)
mutant(fem-impulse-forgets-a-load FILE fem/bar.cpp
  FIND    "double sum = load_[0] + load_[1];"
  REPLACE "double sum = load_[1];"
  KILLS bar.step.free-free/momentum bar.impulse.free-free/momentum)
mutant(fem-body-force-a-step-late FILE fem/bar.cpp
  FIND    "mesh.add_body_force((kick.from + kick.to) / 2)"
  REPLACE "mesh.add_body_force((kick.from + kick.to) / 2 - dt_)"
  KILLS bar.body-force/displacement-order bar.body-force/velocity-order)

# --- MPM ----------------------------------------------------------------------------------------------------------------

mutant(musl-without-the-second-map FILE mpm/bar.cpp
  FIND    "    map_momentum();
    if (ledger) ledger->after_kick(work_rate(), kick.length);"
  REPLACE "    if (ledger) ledger->after_kick(work_rate(), kick.length);"
  KILLS bar.stability.limits/usf-musl-centred bar.stability.limits/usf-musl-two bar.stability.limits/usf-musl-others)
mutant(usl-with-a-second-map FILE mpm/bar.cpp
  FIND    "    move_particles(dt_);              // eqs. 9, 10
    if (ledger) ledger->after_kick(work_rate(), kick.length);"
  REPLACE "    move_particles(dt_); map_momentum();
    if (ledger) ledger->after_kick(work_rate(), kick.length);"
  KILLS bar.step.fixed-free/usl-constant bar.step.fixed-free/usl-order bar.stability.limits/usl-centred
        bar.stability.limits/usl-two bar.stability.limits/usl-free-end bar.stability.blow-up/detected)
mutant(usf-without-its-half-step FILE mpm/bar.cpp
  FIND    "update_stress<false>(dt_ / 2, nullptr);"
  REPLACE "update_stress<false>(dt_, nullptr);"
  KILLS bar.mode.fixed-free/stress-order)
mutant(mpm-strain-feels-the-flight FILE mpm/bar.cpp
  FIND    "(right.velocity - left.velocity) / h_"
  REPLACE "(right.velocity - 0.999999999 * left.velocity) / h_"
  KILLS bar.convection.rigid/stress)
mutant(mpm-particles-run-ahead FILE mpm/bar.cpp
  FIND    "const double increment = drift * ("
  REPLACE "const double increment = (1 + 1e-9) * drift * ("
  KILLS bar.convection.rigid/displacement)
mutant(mpm-layer-gives-the-end-too-much FILE mpm/bar.cpp
  FIND    "(0.5 + offset_[point.particle]) * force}"
  REPLACE "(0.51 + offset_[point.particle]) * force}"
  KILLS bar.traction.layer/end-stress)
mutant(mpm-traction-beside-the-end FILE mpm/bar.cpp
  FIND    "load.end == End::left ? left_end_node() : right_end_node(), traction}"
  REPLACE "load.end == End::left ? left_end_node() + 1 : right_end_node() - 1, traction}"
  KILLS bar.step.fixed-free/musl-magic-step bar.traction.node/end-stress bar.impulse.free-free/musl-magic-step)
mutant(mpm-one-sided-rounding FILE mpm/bar.cpp
  FIND    "displacement_[p] += increment;"
  REPLACE "displacement_[p] += increment > 0 ? increment * (1 + 1e-15) : increment;"
  KILLS bar.step.fixed-free/mirror bar.step.free-free/mirror bar.impulse.free-free/mirror
        bar.traction.layer/mirror bar.traction.layer-left/mirror)
mutant(mpm-absolute-tolerance FILE mpm/bar.cpp
  FIND    "(right.velocity - left.velocity) / h_"
  REPLACE "(right.velocity - left.velocity + 1e-15) / h_"
  KILLS bar.step.fixed-free/power-of-two)
mutant(mpm-leaves-a-particle-out FILE mpm/bar.cpp
  FIND    "if (low < high) sum = sum + f(low);"
  REPLACE "if (low < high && low > 0) sum = sum + f(low);"
  KILLS bar.step.free-free/musl-magic-step bar.step.free-free/constant)
mutant(mpm-damps-from-the-grid FILE mpm/bar.cpp
  FIND    "node.velocity += kick * node.acceleration;"
  REPLACE "node.velocity += kick * node.acceleration; node.acceleration *= 0.9999;"
  KILLS bar.energy/shadow-energy bar.step.free-free/energy bar.impulse.free-free/energy bar.step.fixed-free/musl-constant)

# --- the oracle ---------------------------------------------------------------------------------------------------------

mutant(oracle-modulus FILE cases/build.cpp
  FIND    "analytic::BarWave::Parameters{E, rho"
  REPLACE "analytic::BarWave::Parameters{1.01 * E, rho"
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/musl-magic-step bar.step.fixed-free/fem-constant
        bar.step.fixed-free/usl-constant bar.step.free-free/constant bar.impulse.free-free/musl-magic-step)
mutant(oracle-takes-a-wall-for-a-free-end FILE analytic/bar_wave.cpp
  FIND    "return end.fixed ? +1 : -1;"
  REPLACE "return end.fixed ? -1 : -1;"
  VERDICT INVALID
  KILLS bar.step.fixed-free/fem-magic-step bar.step.fixed-free/fem-constant)

mutant(fem-initial-stress-at-the-node FILE fem/bar.cpp
  FIND    "bar.initial_stress(midpoint(e))"
  REPLACE "bar.initial_stress(node(e))"
  KILLS bar.initial-state/displacement-order bar.initial-state/velocity-order bar.initial-state/displacement)
mutant(fem-initial-velocity-beside-the-node FILE fem/bar.cpp
  FIND    "bar.initial_velocity(node(i))"
  REPLACE "bar.initial_velocity(node(i) + 0.1 * h_)"
  KILLS bar.mode.fixed-free/displacement-between bar.initial-state/velocity-order)
mutant(fem-impulse-forgets-the-right-support FILE fem/bar.cpp
  FIND    "sum -= last().force_at(last().cells())"
  REPLACE "sum -= 0.999999 * last().force_at(last().cells())"
  KILLS bar.initial-state/momentum)
mutant(mpm-layer-on-the-wrong-end FILE mpm/bar.cpp
  FIND    "load.end == End::left ? member.first + q : member.last - 1 - q"
  REPLACE "member.last - 1 - q"
  KILLS bar.traction.layer-left/end-stress)

add_test(NAME teeth.coverage
  COMMAND ${PROJECT_SOURCE_DIR}/tests/coverage.sh $<TARGET_FILE:diptych> ${killed_list})
set_tests_properties(teeth.coverage PROPERTIES LABELS teeth TIMEOUT 60)
