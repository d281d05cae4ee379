# Planted defects. Each takes one file of the solvers, replaces one piece of text, and builds the whole program from it:
# no hook for it stands in the code. The gates that it must fail are named; together they must be all gates there are.
# A defect of the oracle that its self-test finds makes its gates INVALID instead, and one that breaks the run ERROR; neither
# counts as the defect that every gate must have.
#
#   mutant(NAME FILE file FIND text REPLACE text [SOURCES source...] [VERDICT INVALID|ERROR] KILLS gate...)
#
# SOURCES: of a header, the sources that are built with the defect; without it those of the bars.

set(killed_list ${CMAKE_CURRENT_BINARY_DIR}/killed.txt)
file(WRITE ${killed_list} "")

function(mutant name)
  cmake_parse_arguments(PARSE_ARGV 1 M "" "FILE;FIND;REPLACE;VERDICT" "KILLS;SOURCES")
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
  elseif(M_SOURCES)
    list(TRANSFORM M_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/)
    target_sources(${target} PRIVATE ${M_SOURCES})
  elseif(M_FILE MATCHES "^fem/")  # a header of one solver
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/fem/bar.cpp)
  else()  # of both
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/fem/bar.cpp ${PROJECT_SOURCE_DIR}/mpm/bar.cpp)
  endif()
  # What the defect's own objects define, the libraries' are not asked for.
  target_link_libraries(${target} PRIVATE diptych_cases diptych_fem diptych_mpm diptych_diffusion
    fmt::fmt Eigen3::Eigen SuiteSparse::CHOLMOD TBB::tbb)
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
        bar.initial-state/momentum viscosity.tension/energy)
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
  KILLS bar.step.fixed-free/power-of-two impact.unequal/power-of-two)
mutant(fem-one-sided-rounding FILE fem/bar.cpp
  FIND    "displacement_[i] += dt * velocity_[i]"
  REPLACE "displacement_[i] += dt * velocity_[i] * (velocity_[i] > 0 ? 1 + 1e-15 : 1)"
  KILLS bar.step.fixed-free/mirror bar.step.free-free/mirror bar.impulse.free-free/mirror viscosity.front/mirror)
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

# --- bars that collide ----------------------------------------------------------------------------------------------------

mutant(contact-sticks FILE fem/contact.hpp
  FIND    "needed < half"
  REPLACE "needed < -1e300"
  KILLS impact.elastic/fem-magic-stress impact.elastic/fem-magic-velocity impact.elastic/restitution
        impact.elastic/fem-recovers impact.unequal/displacement impact.three-bars/stress impact.three-bars/velocity
        impact.one-cell/stress impact.one-cell/restitution impact.near-sonic/stress impact.near-sonic/displacement
        impact.sweep/restitution
        impact.plastic/fem-rebound impact.hardening/restitution impact.hardening-convergence/restitution
        impact.plastic-convergence/restitution)
mutant(contact-opens-late FILE fem/contact.hpp
  FIND    "needed < half"
  REPLACE "needed < -half"
  KILLS impact.elastic/fem-magic-stress impact.three-bars/stress impact.one-cell/stress)
mutant(contact-opens-with-a-jerk FILE fem/contact.hpp
  FIND    "force_ = half;"
  REPLACE "force_ = 0.999 * half;"
  KILLS impact.elastic/fem-magic-stress impact.unequal/stress impact.unequal/displacement impact.density-ratio/stress
        impact.one-cell/stress impact.one-cell/restitution)
mutant(contact-bond-lets-go FILE fem/contact.hpp
  FIND    "contact_ == Contact::node_to_node && "
  REPLACE ""
  KILLS impact.bonded/stress impact.bonded/pulls)
mutant(contact-of-bars-that-never-met FILE fem/contact.hpp
  FIND    "      force_ = 0;"
  REPLACE "      force_ = carried;"
  KILLS impact.gap/alone impact.gap/magic-step impact.fraction-of-a-cell/fem-alone
        impact.fraction-of-a-cell/fem-magic-step)
mutant(norms-never-nothing FILE cases/norms.cpp
  FIND    "is_nan = is_nan || std::isnan(error);"
  REPLACE "norms.linf = std::max(norms.linf, 1e-300); is_nan = is_nan || std::isnan(error);"
  KILLS impact.zero-speed/stress impact.zero-speed/velocity impact.zero-speed/displacement)
mutant(contact-of-equal-masses FILE fem/contact.hpp
  FIND    "1 / a.mass + 1 / b.mass"
  REPLACE "2 / a.mass"
  KILLS impact.density-ratio/stress impact.density-ratio/heavy-bar impact.unequal/stress)
mutant(contact-found-a-step-late FILE fem/contact.hpp
  FIND    "share_of_step_ = gap > predicted ? std::clamp(gap / (gap - predicted), 0.0, 1.0) : 0;"
  REPLACE "share_of_step_ = gap > predicted ? 1 : 0;"
  KILLS impact.within-a-step/begin)
mutant(contact-without-a-reaction FILE fem/bar.cpp
  FIND    "b.force_at(0) += force;"
  REPLACE "b.force_at(0) += 0.999999 * force;"
  KILLS impact.elastic/momentum impact.within-a-step/momentum impact.unequal/momentum impact.density-ratio/momentum impact.three-bars/momentum
        impact.one-cell/momentum impact.sweep/momentum impact.hardening/momentum impact.plastic/momentum)
mutant(contact-favours-a-bar FILE fem/bar.cpp
  FIND    "a.force_at(a.cells()) -= force;"
  REPLACE "a.force_at(a.cells()) -= (1 + 1e-15) * force;"
  KILLS impact.elastic/mirror)
mutant(contact-takes-no-energy FILE fem/bar.cpp
  FIND    "if (ledger) ledger->take_by_contact(-kick.length * contact_work_rate() / 2);
    for"
  REPLACE "for"
  KILLS impact.elastic/closure impact.within-a-step/closure impact.convergence/closure impact.sweep/closure impact.hardening/closure
        impact.plastic/closure impact.hardening-convergence/closure impact.plastic-convergence/closure)
mutant(contact-ends-on-paper-only FILE fem/bar.cpp
  FIND    "same)->to = now;"
  REPLACE "same)->to = now + 0.001;"
  KILLS impact.unequal/end impact.elastic/duration impact.hardening/fem-duration impact.plastic/fem-duration
        impact.hardening-convergence/duration impact.plastic-convergence/duration impact.sweep/duration)

mutant(mpm-bars-touch-at-two-cells FILE mpm/bar.cpp
  FIND    "cell_[members_[b].last - 1] <= 1;"
  REPLACE "cell_[members_[b].last - 1] <= 3;"
  KILLS impact.sweep/mpm-begin impact.elastic/early impact.sweep/early impact.hardening/early impact.plastic/early impact.convergence/early)
mutant(mpm-touch-a-step-late FILE mpm/bar.cpp
  FIND    "touches_.push_back({b, now});"
  REPLACE "touches_.push_back({b, now + dt_});"
  KILLS impact.fraction-of-a-cell/mpm-holds)
mutant(mpm-lets-go-late FILE mpm/bar.cpp
  FIND    "open->to = now;"
  REPLACE "open->to = now + 0.001;"
  KILLS impact.convergence/late-release impact.hardening/mpm-duration impact.elastic/duration)
mutant(mpm-bars-askew FILE mpm/bar.cpp
  FIND    "const double shift = begin - std::floor(begin);"
  REPLACE "const double shift = begin - std::floor(begin) + (b > 0 ? 1e-12 : 0);"
  KILLS impact.gap/alone)
mutant(mpm-strain-of-the-moment FILE mpm/bar.cpp
  FIND    "if constexpr (convected) strain_increment *= stretch_[p];"
  REPLACE ""
  VERDICT ERROR
  KILLS impact.near-sonic-mpm/stress)
mutant(mpm-remapping-takes-no-energy FILE mpm/bar.cpp
  FIND    "ledger->take_by_scheme(-(dt_ * power / 2 + half_work_));"
  REPLACE "ledger->take_by_scheme(0 * power);"
  KILLS impact.one-particle/closure impact.near-sonic-mpm/closure impact.elastic/closure)
mutant(mpm-flight-is-damped FILE mpm/bar.cpp
  FIND    "velocity_[p] += kick * ("
  REPLACE "velocity_[p] = 0.9 * velocity_[p] + kick * ("
  KILLS impact.one-particle/restitution impact.near-sonic-mpm/restitution impact.near-sonic-mpm/energy
        impact.near-sonic-mpm/stress
        impact.gap-not-of-cells/energy impact.fraction-of-a-cell/energy)
mutant(mpm-slows-a-particle FILE mpm/bar.cpp
  FIND    "velocity_[p] += kick * ("
  REPLACE "velocity_[p] = (p == 0 ? 0.9999 : 1.0) * velocity_[p] + kick * ("
  KILLS impact.one-particle/momentum impact.gap-not-of-cells/momentum impact.fraction-of-a-cell/momentum
        impact.gap/energy)
mutant(mpm-reports-a-stress-beside-its-own FILE mpm/bar.cpp
  FIND    "s.stress.value.push_back(state.stress);"
  REPLACE "s.stress.value.push_back(state.stress + 0.05);"
  KILLS impact.convergence/mpm-stress-after-release)
mutant(fem-reports-velocities-low FILE fem/bar.cpp
  FIND    "s.velocity.value.push_back(velocity_[i]);"
  REPLACE "s.velocity.value.push_back(0.99 * velocity_[i]);"
  KILLS impact.convergence/fem-restitution)
mutant(mpm-reports-velocities-low FILE mpm/bar.cpp
  FIND    "s.velocity.value = velocity_;"
  REPLACE "s.velocity.value = velocity_; for (double& v : s.velocity.value) v *= 0.95;"
  KILLS impact.convergence/mpm-velocity-after-release)
mutant(mpm-load-a-tenth-off FILE mpm/bar.cpp
  FIND    "load.mean_traction(kick.from, kick.to)"
  REPLACE "0.9 * load.mean_traction(kick.from, kick.to)"
  KILLS impact.gap-not-of-cells/left-stress impact.gap-not-of-cells/right-stress impact.gap/magic-step)

mutant(modulus-a-tenth-off FILE material/material.hpp
  FIND    "state.stress += youngs_modulus * strain_increment"
  REPLACE "state.stress += 1.1 * youngs_modulus * strain_increment"
  KILLS impact.within-a-step/stress impact.convergence/fem-stress-l1 impact.convergence/fem-velocity-l1
        impact.convergence/fem-stress-l2
        impact.convergence/fem-velocity-l2
        impact.convergence/mpm-stress-l1 impact.convergence/mpm-stress-l2 impact.convergence/mpm-velocity-l1
        impact.convergence/mpm-velocity-l2 impact.convergence/displacement-l2)
mutant(yield-a-hundredth-high FILE material/material.hpp
  FIND    "const double yield = yield_stress + state.hardened;"
  REPLACE "const double yield = 1.01 * yield_stress + state.hardened;"
  KILLS impact.plastic/interface-stress impact.plastic-convergence/restitution)
mutant(yield-a-hundredth-low FILE material/material.hpp
  FIND    "const double yield = yield_stress + state.hardened;"
  REPLACE "const double yield = 0.99 * yield_stress + state.hardened;"
  KILLS impact.at-yield/stress impact.at-yield/restitution impact.plastic/interface-stress)
mutant(yield-never-reached FILE material/material.hpp
  FIND    "const double yield = yield_stress + state.hardened;"
  REPLACE "const double yield = 10 * yield_stress + state.hardened;"
  KILLS impact.plastic/mpm-sticks impact.plastic/interface-stress impact.hardening/interface-stress
        impact.plastic/fem-rebound)
mutant(plastic-without-unloading FILE material/material.hpp
  FIND    "    if (excess <= 0) {"
  REPLACE "    if (excess <= 0 && state.hardened > 0) return {state.stress, stored(state), 0, elastic_wave_speed()};
    if (excess <= 0) {"
  KILLS impact.hardening-convergence/restitution)
mutant(plastic-unloads-softly FILE material/material.hpp
  FIND    "    if (excess <= 0) {
      state.stress = trial;"
  REPLACE "    if (excess <= 0) {
      state.stress = state.hardened > 0 ? state.stress + 0.8 * youngs_modulus * strain_increment : trial;"
  KILLS impact.hardening-convergence/fem-stress impact.hardening-convergence/fem-velocity
        impact.hardening-convergence/mpm-stress impact.hardening-convergence/mpm-velocity)
mutant(plastic-tangent-for-the-plastic-modulus FILE material/material.hpp
  FIND    "return youngs_modulus * tangent_modulus / (youngs_modulus - tangent_modulus);"
  REPLACE "return tangent_modulus;"
  KILLS impact.hardening/interface-stress impact.hardening-convergence/fem-stress)
mutant(plastic-modulus-of-yielding-bars FILE material/material.hpp
  FIND    "const double trial = state.stress + youngs_modulus * strain_increment;"
  REPLACE "const double trial = state.stress + 1.1 * youngs_modulus * strain_increment;"
  KILLS impact.plastic-convergence/fem-stress impact.plastic-convergence/fem-velocity
        impact.plastic-convergence/mpm-stress impact.plastic-convergence/mpm-velocity)
mutant(plastic-work-a-tenth-off FILE material/material.hpp
  FIND    "const double work = (yield + rise / 2) * plastic;"
  REPLACE "const double work = 0.9 * (yield + rise / 2) * plastic;"
  KILLS impact.hardening/plastic-work impact.plastic/fem-plastic-work impact.hardening-convergence/plastic-work
        impact.plastic-convergence/plastic-work impact.hardening-convergence/plastic-work-order
        impact.plastic-convergence/plastic-work-order)

mutant(viscosity-in-tension FILE material/viscosity.hpp
  FIND    "return D < 0 ||"
  REPLACE "return D != 0 ||"
  KILLS viscosity.tension/inviscid viscosity.limits-in-compression/half)
mutant(viscosity-a-twentieth-off FILE material/viscosity.hpp
  FIND    "(c1 * speed + c2 * h * std::abs(D))"
  REPLACE "(1.05 * c1 * speed + c2 * h * std::abs(D))"
  KILLS viscosity.front/stress-l1 viscosity.front/stress-l2 viscosity.front/velocity-l1 viscosity.limits/lagged)
mutant(viscosity-of-no-grid FILE material/viscosity.hpp
  FIND    "return density * h * D *"
  REPLACE "return density * 0.001 * D *"
  KILLS viscosity.front/stress-order)
mutant(viscosity-takes-no-energy FILE fem/bar.cpp
  FIND    "ledger->take_by_viscosity(sums.viscous_after);"
  REPLACE ""
  KILLS viscosity.front/closure)

# --- plates and diffusion -------------------------------------------------------------------------------------------------

mutant(plate-damage-a-step-late FILE fem/plate.cpp
  FIND    "evolution_->advance(volumetric_, dt_);"
  REPLACE "static thread_local std::vector<double> late; late.resize(volumetric_.size()); late.swap(volumetric_); evolution_->advance(volumetric_, dt_);"
  KILLS plate.driver/stress)
mutant(backward-euler-half-way FILE diffusion/concentration.cpp
  FIND    "return scheme == Scheme::backward_euler ? 1 : 0.5;"
  REPLACE "return 0.5;"
  KILLS diffusion.time/first)
mutant(implicit-diffusion-leaks FILE diffusion/concentration.cpp
  FIND    "u[k] += delta[k] + missing;"
  REPLACE "u[k] += delta[k] + missing + 1e-9;"
  KILLS diffusion.time/balance)
mutant(source-takes-away FILE diffusion/damage_evolution.cpp
  FIND    "return density / d.characteristic_time / ("
  REPLACE "return -density / d.characteristic_time / ("
  KILLS plate.driver-diffusion/stress-1 plate.driver-diffusion/stress-3 plate.driver-diffusion/total-1
        plate.driver-diffusion/total-3 plate.extremes/not-negative plate.extremes/ruptures)
mutant(mpm-plate-pulled-a-little-more FILE mpm/plate.cpp
  FIND    "mean(edge_of_plate.normal_traction);"
  REPLACE "1.05 * mean(edge_of_plate.normal_traction);"
  KILLS plate.damage/late-radius-0 plate.damage/late-radius-45)
mutant(fem-plate-strained-less FILE fem/plate.cpp
  FIND    "volumetric_[cell] = damage().volumetric("
  REPLACE "volumetric_[cell] = 0.9 * damage().volumetric("
  KILLS plate.damage/early-area plate.damage/early-radius-45 plate.damage/early-radius-90 plate.damage/late-area
        plate.damage/late-total plate.damage/platen)
mutant(mpm-plate-strained-less FILE mpm/plate.cpp
  FIND    "volumetric_strain_[j * nx_ + i] = volumetric("
  REPLACE "volumetric_strain_[j * nx_ + i] = 0.9 * volumetric("
  KILLS plate.damage/early-area plate.damage/early-contour plate.damage/early-radius-0 plate.damage/early-radius-45
        plate.damage/early-radius-90 plate.damage/early-total plate.damage/platen)
mutant(mpm-plate-strained-more FILE mpm/plate.cpp
  FIND    "volumetric_strain_[j * nx_ + i] = volumetric("
  REPLACE "volumetric_strain_[j * nx_ + i] = 1.1 * volumetric("
  KILLS plate.damage/early-area plate.damage/early-radius-45 plate.damage/early-total plate.damage/late-radius-0
        plate.damage/late-radius-90 plate.damage/platen)
mutant(fem-plate-cracked-by-nothing FILE fem/plate.cpp
  FIND    "if (crack_density != 0) {"
  REPLACE "if (true) {"
  KILLS plate.undamaged/elastic)
mutant(compression-without-its-slope FILE material/compression.hpp SOURCES fem/plate.cpp mpm/plate.cpp
  FIND    "strength + slope"
  REPLACE "strength + 0 * slope"
  KILLS plate.compression/stress)
mutant(plate-stress-for-strain FILE material/plane.hpp SOURCES fem/plate.cpp fem/plate_time_step.cpp mpm/plate.cpp
  FIND    "if (plane == Plane::stress) return"
  REPLACE "if (plane == Plane::strain) return"
  KILLS plate.driver/stress plate.p-wave/constant plate.patch/stress plate.stability/limit)
mutant(plate-shear-a-hundredth-off FILE material/plane.hpp SOURCES fem/plate.cpp fem/plate_time_step.cpp mpm/plate.cpp
  FIND    "const double shear = E / (2 * (1 + nu));"
  REPLACE "const double shear = 1.01 * E / (2 * (1 + nu));"
  KILLS glass.elastic/lateral-ratio
        plate.incompressible/constant plate.incompressible/displacement-order plate.lame/constant
        plate.lame/displacement-order plate.patch/stress)
mutant(plate-mpm-swapped-gradient FILE mpm/plate_kernels.hpp SOURCES mpm/plate.cpp
  FIND    "const double yy = near[a] * yy_left + far[a] * yy_right;"
  REPLACE "const double yy = near[a] * xy_left + far[a] * xy_right + 0 * (yy_left + yy_right);"
  KILLS plate.patch/stress plate.pic/stress plate.rigid/displacement plate.rigid/velocity)
mutant(plate-fem-swapped-gradient FILE fem/cell.hpp SOURCES fem/plate.cpp
  FIND    "(along_x[1] / h.x + along_y[0] / h.y) / 2"
  REPLACE "(along_x[0] / h.x + along_y[1] / h.y) / 2"
  KILLS plate.bits/closure plate.bits/drift plate.bits/mirror plate.driver/closure plate.driver/stress
        plate.lame/energy plate.patch/stress)
mutant(plate-mpm-leaves-a-particle-out FILE mpm/plate_kernels.hpp SOURCES mpm/plate.cpp
  FIND    "bottom_left[i] = pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return near[b] * along(near, b); });"
  REPLACE "bottom_left[i] = i == 0 ? 0 : pair_sum<n>(count, [&](std::size_t b) DIPTYCH_INLINE { return near[b] * along(near, b); });"
  KILLS plate.bits/closure plate.bits/drift plate.bits/mirror plate.rigid/displacement plate.rigid/velocity)
mutant(plate-mpm-damage-a-step-late FILE mpm/plate.cpp
  FIND    "    evolution_->advance(volumetric_strain_, dt);
    law_.crack(evolution_->crack_density());"
  REPLACE "    law_.crack(evolution_->crack_density());
    evolution_->advance(volumetric_strain_, dt);"
  KILLS plate.driver-diffusion/stress-1 plate.driver-diffusion/stress-3 plate.driver/stress)
mutant(source-without-its-time FILE diffusion/damage_evolution.cpp
  FIND    "return density / d.characteristic_time / ("
  REPLACE "return density / ("
  KILLS plate.driver-diffusion/stress-1 plate.driver-diffusion/stress-3 plate.driver-diffusion/total-1
        plate.driver-diffusion/total-3)
mutant(rate-not-kept FILE diffusion/damage_evolution.cpp
  FIND    "largest = std::max(largest, (strain - strain_before_[k]) / dt);"
  REPLACE "largest = (strain - strain_before_[k]) / dt;"
  KILLS plate.driver-tracked/stress)
mutant(concentration-counted-twice FILE diffusion/damage_evolution.cpp
  FIND    "const double mean = 0.25 * ("
  REPLACE "const double mean = 0.5 * ("
  KILLS plate.driver-diffusion/stress-1 plate.driver-diffusion/stress-3)
mutant(source-beyond-rupture FILE diffusion/damage_evolution.cpp
  FIND    "const double most = evolution_.cap / d.crack_volume;"
  REPLACE "const double most = 1.2 * evolution_.cap / d.crack_volume;"
  KILLS plate.extremes/ruptures)
mutant(what-is-fed-is-misread FILE diffusion/concentration.cpp
  FIND    "fed += dt * rate;"
  REPLACE "fed += 1.0001 * dt * rate;"
  KILLS plate.choices/balance plate.damage/balance plate.extremes/balance plate.runaway/balance plate.schemes/balance)
mutant(corner-source-without-its-quarter FILE cases/plate_runner.cpp
  FIND    "source[0] = spec.corner_rate / (grid.hx * grid.hy / 4);"
  REPLACE "source[0] = spec.corner_rate / (grid.hx * grid.hy);"
  KILLS diffusion.corner-source/error diffusion.corner-source/order diffusion.corner-source/total)
mutant(diffusion-a-hundredth-off FILE diffusion/concentration.cpp
  FIND    "const double across = grid.hy / (2 * grid.hx), up"
  REPLACE "const double across = 1.01 * grid.hy / (2 * grid.hx), up"
  KILLS glass.front/erfc
        diffusion.green/order diffusion.corner-source/error diffusion.corner-source/order diffusion.mode/order diffusion.order-four/error
        diffusion.order-four/order diffusion.time/rkl2 diffusion.time/second diffusion.variable/error
        diffusion.variable/order)
mutant(diffusivity-of-one-side FILE diffusion/concentration.cpp
  FIND    "e[i] = across * (below[i] + above[i]);"
  REPLACE "e[i] = across * (below[i] + below[i]);"
  KILLS diffusion.variable/order)
mutant(diffusion-leaks FILE diffusion/concentration.cpp
  FIND    "out[k] = u[k] + s[k] * inflow;"
  REPLACE "out[k] = (u[k] + s[k] * inflow) * (1 - 1e-9);"
  KILLS diffusion.green/balance diffusion.green/amount diffusion.corner-source/balance diffusion.corner-source/total diffusion.mode/balance
        diffusion.positive/balance)
mutant(diffusion-below-zero FILE diffusion/concentration.cpp
  FIND    "out[k] = u[k] + s[k] * inflow;"
  REPLACE "out[k] = u[k] + 1.05 * s[k] * inflow;"
  KILLS diffusion.positive/not-negative)
mutant(fem-mass-a-fiftieth-off FILE fem/plate.cpp
  FIND    "cell_mass_(elastic(plate).density * h_.x * h_.y),"
  REPLACE "cell_mass_(1.02 * elastic(plate).density * h_.x * h_.y),"
  KILLS glass.crossing/fem-converges
        plate.incompressible/constant plate.incompressible/displacement-order plate.lame/constant
        plate.lame/displacement-order plate.p-wave/constant plate.p-wave/order plate.roller/constant
        plate.roller/displacement-order plate.roller/stress-constant plate.s-wave/speed plate.stability/limit)
mutant(fem-plate-drifts FILE fem/plate.cpp
  FIND    "const KickAndDrift corner{kick / (cell_mass_ * 2 / 3), dt_};"
  REPLACE "const KickAndDrift corner{kick / (cell_mass_ * 2 / 3), 1.0001 * dt_};"
  KILLS plate.bits/closure plate.bits/drift plate.bits/threads plate.lame/constant plate.lame/displacement-order
        plate.lame/energy plate.p-wave/constant plate.patch/displacement plate.patch/stress plate.patch/velocity
        plate.rigid/displacement plate.rigid/velocity plate.roller/constant plate.roller/displacement-order
        plate.roller/energy plate.roller/stress-constant)
mutant(mpm-plate-is-damped FILE mpm/plate_kernels.hpp SOURCES mpm/plate.cpp
  FIND    "        velocity[p] = v;"
  REPLACE "        velocity[p] = 0.9999 * v;"
  KILLS glass.elastic/scaling glass.elastic/momentum
        plate.pic/velocity plate.aspect/velocity plate.bits/closure plate.bits/drift plate.bits/momentum plate.incompressible/energy
        plate.lame/energy plate.rigid/displacement plate.rigid/momentum plate.rigid/velocity plate.roller/constant
        plate.roller/displacement-order plate.roller/energy plate.roller/stress-constant)
mutant(mpm-flying-plate-is-damped FILE mpm/plate_particles.hpp SOURCES mpm/plate.cpp
  FIND    "            v += kick * ai;"
  REPLACE "            v = 0.9999 * v + kick * ai;"
  KILLS glass.crossing/closure
        plate.flight/displacement plate.flight/momentum plate.flight/velocity)
mutant(mpm-flying-plate-falls-behind FILE mpm/plate_particles.hpp SOURCES mpm/plate.cpp
  FIND    "            u += drift * grid;"
  REPLACE "            u += 0.9999 * drift * grid;"
  KILLS plate.flight/displacement)
mutant(fem-plate-forgets-nothing FILE fem/plate.cpp
  FIND    "    const KickAndDrift corner{"
  REPLACE "    static double runs = 1;
    runs += 1e-13;
    const KickAndDrift corner{runs * "
  KILLS plate.bits/mirror plate.bits/power-of-two plate.bits/repeat plate.bits/threads)
mutant(fem-plate-counts-threads FILE fem/plate.cpp
  FIND    "dt_(stepping.time_step),"
  REPLACE "dt_(stepping.time_step * (stepping.threads > 1 ? 1 + 1e-12 : 1)),"
  KILLS glass.elastic/threads glass.extremes/threads glass.wave/threads
        plate.bits/threads plate.damage/threads)
mutant(mpm-plate-counts-threads FILE mpm/plate.cpp
  FIND    "dt_(stepping.time_step),"
  REPLACE "dt_(stepping.time_step * (stepping.threads > 1 ? 1 + 1e-12 : 1)),"
  KILLS plate.bits/threads plate.damage/threads)
mutant(fem-plate-askew FILE fem/sweep.cpp
  FIND    "fby[i] = (s_yy - s_yx) - qy;"
  REPLACE "fby[i] = s_yy - (s_yx + qy);"
  KILLS plate.bits/mirror)
mutant(fem-plate-of-one-size FILE fem/sweep.cpp
  FIND    "vx[i] += kick * fx;"
  REPLACE "vx[i] += kick * fx + 1e-25;"
  KILLS plate.bits/power-of-two)
mutant(fem-plate-pulled-by-nobody FILE fem/plate.cpp
  FIND    "edge.normal_traction(kick.from, kick.to) * length;"
  REPLACE "(1e-30 + edge.normal_traction(kick.from, kick.to)) * length;"
  KILLS plate.zero/nothing)
mutant(fem-plate-loses-a-weight FILE fem/plate.cpp
  FIND    "f->weight.push_back(h_.x * h_.y * (middle ? 1 : 2 * sides_of) / 3);"
  REPLACE "f->weight.push_back(h_.x * h_.y * (middle ? 1 : 1.9 * sides_of) / 3);"
  KILLS plate.damage/whole plate.rigid/whole)
mutant(fem-plate-kick-on-paper FILE fem/plate.cpp
  FIND    "ledger.before_kick(before, along_diagonal(force), kick);"
  REPLACE "ledger.before_kick(1.0001 * before, along_diagonal(force), kick);"
  KILLS plate.bits/closure plate.bits/drift plate.compression/closure plate.damage/closure)
mutant(fem-plate-impulse-on-paper FILE fem/plate.cpp
  FIND    "ledger.before_kick(before, along_diagonal(force), kick);"
  REPLACE "ledger.before_kick(before, 1.0001 * along_diagonal(force), kick);"
  KILLS plate.bits/momentum)
mutant(mpm-plate-impulse-on-paper FILE mpm/plate.cpp
  FIND    "ledger->before_kick(work_rate(grid_.velocity), impulse, kick.length);"
  REPLACE "ledger->before_kick(work_rate(grid_.velocity), impulse + 1e-6, kick.length);"
  KILLS glass.elastic/momentum glass.wave/momentum
        plate.bits/momentum plate.flight/momentum plate.rigid/momentum)
mutant(sub-cycles-a-tenth-too-long FILE diffusion/concentration.cpp
  FIND    "const double part = dt / static_cast<double>(parts);"
  REPLACE "const double part = 1.1 * dt / static_cast<double>(parts);"
  KILLS plate.schemes/balance plate.schemes/same plate.schemes/same-backward-euler)

add_test(NAME teeth.coverage
  COMMAND ${PROJECT_SOURCE_DIR}/tests/coverage.sh $<TARGET_FILE:diptych> ${killed_list})
set_tests_properties(teeth.coverage PROPERTIES LABELS teeth TIMEOUT 60)

# --- a flyer, a failure wave, viscosity of plates -----------------------------------------------------------------------
mutant(fem-failure-threshold-ignored FILE material/failure_wave.hpp SOURCES fem/plate.cpp
  FIND    "equivalent_stress(strain) <= threshold ? 0"
  REPLACE "equivalent_stress(strain) <= 0 * threshold ? 0"
  KILLS glass.extremes/no-failure glass.point/stress glass.wave/not-ahead glass.wave/settles-near-xx)
mutant(mpm-failure-threshold-ignored FILE material/failure_wave.hpp SOURCES mpm/plate.cpp
  FIND    "equivalent_stress(strain) <= threshold ? 0"
  REPLACE "equivalent_stress(strain) <= 0 * threshold ? 0"
  KILLS glass.extremes/no-failure glass.point/stress)
mutant(failure-ahead-of-the-shock FILE diffusion/dilatancy.cpp
  FIND    "if (ceiling == 0) return spread_.ahead ? spread_.diffusivity : 0;"
  REPLACE "if (ceiling == 0) return spread_.diffusivity;"
  KILLS glass.extremes/release)
mutant(failure-conversion-a-hundredth-off FILE material/failure_wave.hpp SOURCES fem/plate.cpp
  FIND    "const double f = raised / (2 * shear_energy(strain))"
  REPLACE "const double f = raised / (2.02 * shear_energy(strain))"
  KILLS glass.point/stress glass.point/no-first-order glass.point/energy-kept)
mutant(failure-lateral-not-updated FILE material/failure_wave.hpp SOURCES fem/plate.cpp
  FIND    "mean + kept * (strain.yy - third), kept"
  REPLACE "elastic.stiffness().stress(strain).yy + 0 * third, kept"
  KILLS glass.point/stress glass.wave/lateral-rises)
mutant(failure-face-keeps-its-overshoot FILE diffusion/dilatancy.cpp
  FIND    "(spread_.keeps_largest && !(mean > value))"
  REPLACE "!(mean > value)"
  KILLS glass.wave/settles-near-yy glass.wave/settles-far-yy glass.wave/settles-near-dilatancy glass.wave/methods-agree
        glass.wave/failure-near)
mutant(failure-falls-where-it-rises FILE diffusion/dilatancy.cpp
  FIND    "spread_.profile == Profile::rising ? part : 1 - part"
  REPLACE "spread_.profile == Profile::rising ? 1 - part : part"
  KILLS glass.front/falling glass.front/size)
mutant(failure-face-follows-slowly FILE diffusion/dilatancy.cpp
  FIND    "    value = mean;"
  REPLACE "    value += 0.02 * (mean - value);"
  KILLS glass.front/balance glass.wave/balance glass.wave/forward-euler glass.wave/rings)
mutant(failure-face-draws FILE diffusion/dilatancy.cpp
  FIND    "    value = mean;"
  REPLACE "    value = -mean;"
  KILLS glass.extremes/not-negative)
mutant(fem-impact-face-at-full-speed FILE fem/plate.cpp
  FIND    "i < face ? v : v / 2"
  REPLACE "i < face ? v : v / 1"
  KILLS glass.elastic/lattice-near glass.elastic/lattice-far glass.elastic/plateau-near glass.elastic/arrival-near
        glass.elastic/rise-near glass.elastic/overshoot-near)
mutant(mpm-impact-does-not-join FILE mpm/plate_grid.hpp SOURCES mpm/plate.cpp
  FIND    "if (joined_) unite(grid_.acceleration)"
  REPLACE "if (joined_ && false) unite(grid_.acceleration)"
  KILLS glass.elastic/lattice-near glass.elastic/order glass.elastic/displacement glass.extremes/closure)
mutant(mpm-impact-a-step-early FILE mpm/plate.cpp
  FIND    "if (!(std::abs(left_over_ + dt_ * opened(state.velocity.x)) < std::abs(left_over_))) break"
  REPLACE "if (left_over_ + 2 * dt_ * opened(state.velocity.x) < 0) break"
  KILLS glass.elastic/gap)
mutant(plate-viscosity-a-fifth-weak FILE material/viscosity.hpp SOURCES fem/plate.cpp
  FIND    "return density * bulk * speed * length * h * D * (c1 + c2 * relative)"
  REPLACE "return 0.8 * density * bulk * speed * length * h * D * (c1 + c2 * relative)"
  KILLS glass.elastic/rise-viscous)
mutant(plate-viscosity-next-to-none FILE material/viscosity.hpp SOURCES fem/plate.cpp
  FIND    "return density * bulk * speed * length * h * D * (c1 + c2 * relative)"
  REPLACE "return 0.05 * density * bulk * speed * length * h * D * (c1 + c2 * relative)"
  KILLS glass.elastic/rise-viscous glass.wave/no-overshoot)
mutant(fem-plate-viscous-work-off FILE fem/plate.cpp
  FIND    "drag_[j].work = h_.triangle_area() * sum / 2"
  REPLACE "drag_[j].work = h_.triangle_area() * sum / 2.001"
  KILLS glass.elastic/closure glass.wave/closure)
mutant(gauge-too-near FILE cases/plate_build.cpp
  FIND    "flyer.thickness + gauge.from_face, spec.height"
  REPLACE "flyer.thickness + gauge.from_face - 0.7e-3, spec.height"
  KILLS glass.extremes/arrival-on-a-face
        glass.elastic/lattice-near glass.elastic/arrival-exact-near glass.elastic/arrival-exact-far glass.wave/slowing)
mutant(flyer-a-thirtieth-fast FILE cases/plate_build.cpp
  FIND    "Impact{flyer.thickness, flyer.velocity, "
  REPLACE "Impact{flyer.thickness, 1.03 * flyer.velocity, "
  KILLS glass.elastic/plateau-exact-near glass.elastic/plateau-exact-far glass.wave/longitudinal-stays)
mutant(mpm-flying-plate-stands FILE mpm/plate_particles.hpp SOURCES mpm/plate.cpp
  FIND    "advance = drift * grid / h;"
  REPLACE "advance = 0 * drift * grid / h;"
  KILLS glass.crossing/noise)
mutant(oracle-impact-without-its-far-end FILE analytic/plate_impact.cpp
  FIND    "std::min(folded, 2 * p_.width - folded) - p_.face"
  REPLACE "folded - p_.face"
  VERDICT INVALID
  KILLS glass.elastic/order glass.elastic/displacement)
mutant(oracle-front-too-slow FILE analytic/diffusion_front.cpp
  FIND    "return std::erfc(eta / 2);"
  REPLACE "return std::erfc(eta / 1.9);"
  VERDICT INVALID
  KILLS glass.front/erfc)
