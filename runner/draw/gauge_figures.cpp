#include "runner/draw/gauge_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "runner/compare/gauges.hpp"
#include "runner/draw/figure_runs.hpp"
#include "runner/input/leaf.hpp"
#include "runner/input/plate_build.hpp"

namespace diptych::runner {
namespace {

const reports::GaugeHistory* history_at(const reports::Run* run, const std::string& id) {
  if (run)
    for (const auto& gauge : run->gauges)
      if (gauge.id == id) return &gauge;
  return nullptr;
}

PlateSpec plate_of(const Case& c, const std::string& variant, int cells) {
  Leaf leaf;
  leaf.cells = cells;
  leaf.variant = variant;
  return *with_parameters(c, leaf).plate;
}

std::string viscosity_words(const PlateSpec& plate) {
  if (!plate.viscosity) return "no artificial viscosity";
  return fmt::format("artificial viscosity of eq. 21 with c1 = {:g}, c2 = {:g}, λ = {:g}, g = {:.4g} cells",
                     plate.viscosity->c1, plate.viscosity->c2, plate.viscosity->bulk, plate.viscosity->length);
}

std::string failure_words(const PlateSpec& plate) {
  const auto* failure = plate.failing();
  if (!failure) return "elastic";
  const char* profile = failure->spread.profile == diffusion::Profile::falling    ? "d0 (1 − V_d/V_d,max)"
                        : failure->spread.profile == diffusion::Profile::constant ? "d0"
                                                                                  : "d0 V_d/V_d,max";
  return fmt::format("d = {}, d0 = {:g} m²/s, f_max = {:g}, threshold {:g} GPa", profile, failure->spread.diffusivity,
                     failure->law.most_converted, failure->law.threshold / 1e9);
}

reports::Curve in_figure_units(const std::vector<double>& time, const std::vector<double>& stress) {
  reports::Curve curve;
  for (std::size_t n = 0; n < time.size(); ++n) {
    curve.x.push_back(time[n] * 1e6);
    curve.y.push_back(-stress[n] / 1e9);
  }
  return curve;
}

/// The elastic solution until it is released: a step at the arrival.
reports::Curve elastic_curve(const ImpactTheory& theory, double stress, double end) {
  const double until = std::min(theory.release, end);
  if (!(until > theory.arrival)) return {{0, until * 1e6}, {0, 0}};
  return {{0, theory.arrival * 1e6, theory.arrival * 1e6, until * 1e6}, {0, 0, stress / 1e9, stress / 1e9}};
}

/// Of a table, in this unit.
std::string cell(double value, double unit = 1, int digits = 4) { return table_cell(value / unit, digits); }

double measure(const reports::Run* run, const std::string& name) {
  if (!run) return std::nan("");
  const auto found = run->measures.find(name);
  return found == run->measures.end() ? std::nan("") : found->second;
}

std::vector<std::string> notes_of(const Case& c, const FigureSpec& spec, const PlateSpec& plate) {
  const double speed = plate.flyer->velocity;
  const ImpactTheory theory = impact_theory(plate, c.gauges.front().from_face);
  std::vector<std::string> notes{
      fmt::format("{}; flyer {:g} mm at {:g} m/s: σ_x = ½ρc_L v = {:.3f} GPa", words_of(plate),
                  plate.flyer->thickness * 1e3, speed, theory.plateau / 1e9),
      fmt::format("Reconstructed model R1: {}; {}", failure_words(plate), viscosity_words(plate)),
      fmt::format(
          "{} cells of {:g} mm across; four triangles (FEM), particles at ξ, η = {} (MPM) a cell; Courant number {:g}",
          spec.cells, plate.width / spec.cells * 1e3, particles_label(spec.particles), spec.courant)};
  if (!spec.choices.empty()) notes.push_back("Reconstructed parameters: " + spec.choices);
  return notes;
}

}  // namespace

reports::Figure gauge_figure(const Case& c, const FigureSpec& spec, const std::vector<reports::Run>& runs) {
  reports::Figure figure;
  figure.id = spec.id;
  figure.title = title_of(c, spec);
  figure.notes = notes_of(c, spec, plate_of(c, spec.variants.front(), spec.cells));
  const bool longitudinal = spec.components.front() == "longitudinal", both = spec.components.size() > 1;
  figure.x_label = "time from impact t [µs]";
  figure.y_label = both ? "−σ_x, −σ_y [GPa]" : longitudinal ? "−σ_x [GPa]" : "−σ_y [GPa]";
  figure.x_max = c.times.back() * 1e6;
  figure.y_min = figure.y_max = 0;
  if (spec.time_range) {
    figure.x_min = (*spec.time_range)[0] * 1e6;
    figure.x_max = (*spec.time_range)[1] * 1e6;
  }
  for (const std::string& variant : spec.variants) {
    const PlateSpec plate = plate_of(c, variant, spec.cells);
    for (const GaugeSpec& gauge : c.gauges) {
      if (std::find(spec.gauges.begin(), spec.gauges.end(), gauge.id) == spec.gauges.end()) continue;
      const ImpactTheory theory = impact_theory(plate, gauge.from_face);
      const double elastic_lateral = theory.lateral_ratio * theory.plateau;
      reports::Figure::Panel panel;
      panel.label = fmt::format("{:g} mm from the impact face", gauge.from_face * 1e3);
      if (spec.variants.size() > 1) panel.label += ": " + viscosity_words(plate);
      for (const std::string& component : spec.components) {
        const double stress = component == "lateral" ? elastic_lateral : theory.plateau;
        panel.series.push_back({both ? "" : "elastic, exact", "exact", elastic_curve(theory, stress, c.times.back())});
        if (both) panel.series.back().label = component == "lateral" ? "−σ_y elastic" : "−σ_x elastic";
      }
      for (const std::string& method : spec.methods) {
        const reports::Run* run = find_run(runs, spec, method, variant);
        const auto* history = history_at(run, gauge.id);
        if (!history) {
          figure.notes.push_back(method + " is missing: its run did not complete");
          continue;
        }
        for (const std::string& component : spec.components) {
          const bool thin = both && component == "lateral";
          panel.series.push_back({name_of_method(method) + (both ? (thin ? ", −σ_y" : ", −σ_x") : ""),
                                  kind_of_method(method) + (thin ? "-thin" : ""),
                                  in_figure_units(history->time, component == "lateral" ? history->yy : history->xx)});
        }
        const double over = measure(run, "gauge." + gauge.id + ".overshoot");
        if (spec.variants.size() > 1)
          panel.label += fmt::format("; {} overshoot {:.1f} %, 10–90 % in {:.0f} ns", family_of_method(method),
                                     over < 0 ? 0.0 : over * 100, measure(run, "gauge." + gauge.id + ".rise") * 1e9);
      }
      for (const SpeedBand& band : spec.bands)
        panel.spans.push_back({(gauge.from_face / band.speed[1] + band.delay[0]) * 1e6,
                               (gauge.from_face / band.speed[0] + band.delay[1]) * 1e6, band.label, "published"});
      if (std::isfinite(theory.failed_lateral) && (both || !longitudinal)) {
        panel.marks.push_back({theory.failed_lateral / 1e9, "−σ_y at f_max", false});
        if (std::isfinite(theory.failure) && theory.failure * 1e6 < figure.x_max)
          panel.marks.push_back({theory.failure * 1e6, "half-way, by diffusion alone", true});
      }
      for (const auto& series : panel.series) widen(figure, series.curve);
      for (const auto& mark : panel.marks)
        if (!mark.vertical) figure.y_max = std::max(figure.y_max, mark.at);
      figure.panels.push_back(std::move(panel));
    }
  }
  const double margin = 0.06 * (figure.y_max - figure.y_min);
  figure.y_min -= margin;
  figure.y_max += margin;
  if (spec.range) {
    figure.y_min = (*spec.range)[0];
    figure.y_max = (*spec.range)[1];
  }
  return figure;
}

namespace {

/// What is certain, what is ours, and where numbers come from: physics of the page, not of this program.
const std::vector<std::array<std::string, 3>> grounds{
    {"Damage is measured one to one by shear-induced dilatancy", "certain",
     "abstract of ref. [11], Chen, Feng, Xin & Shen, Int. J. Numer. Meth. Eng. 56 (2003) 1979"},
    {"It spreads by a nonlinear diffusion equation behind the elastic shock, from the impact face", "certain",
     "the same; this paper, section 4"},
    {"Deviatoric strain energy of the compressed solid becomes volumetric energy of the dilated one", "certain",
     "the same"},
    {"Wave and diffusion are solved in turn within a time step; four triangles or particles a cell; bonded FEM flyer, "
     "MPM flyer apart; gauges at 4.5 and 6.5 mm; a little viscous damping",
     "certain", "this paper, section 4"},
    {"p = K (−tr ε + V_d), s = √(1 − f) s_e, f = V_d (2 p_e + K V_d)/(2W): all of the energy is kept at fixed strain",
     "reconstruction", "ours; follows from the energy statement if the deviator shrinks along itself"},
    {"At most the part f_max of the shear energy is converted", "reconstruction", "ours"},
    {"Damage spreads where √(3/2 s_e:s_e) of the whole solid is above a threshold; the impact face holds V_d,max from "
     "then on, in flyer and target",
     "reconstruction", "ours; the threshold is that of σ_x = 3.85 GPa, where Bauer et al. see fronts begin"},
    {"d = d0 V_d/V_d,max: cracks let others through, which gives a front with an end; nonlinear, as [11] says",
     "reconstruction", "ours; the form after eq. 25, d0 (1 − V_d/V_d,max), creeps: it is among the variants"},
    {"Strains are those of the reference configuration, and the dilatancy diffuses there; MPM's grid follows the "
     "material",
     "reconstruction",
     "ours: particles that cross cells behind a shock of 6 % make a noise that does not converge (case "
     "glass.crossing)"},
    {"E = 72.8 GPa, ν = 0.222, ρ = 2563 kg/m³", "choice",
     "which glass is ours; published for soda-lime-magnesium silicate, Sci. Rep. 11 (2021), s41598-021-04045-6, table "
     "1"},
    {"Impact stress, thicknesses, d0, f_max, viscosity", "choice",
     "ours: near the HEL of 5.0 ± 0.2 GPa (Bauer et al.); d0 so that the front is at 4.5 mm after some 3 µs"},
};

std::vector<std::string> result_columns(const Case& c) {
  std::vector<std::string> columns;
  for (const GaugeSpec& gauge : c.gauges)
    columns.push_back(fmt::format("failure at {:g} mm [µs]", gauge.from_face * 1e3));
  columns.insert(columns.end(),
                 {"speed [km/s]", "delay [µs]", "ratio of arrivals", "σ_x late / elastic", "σ_y late / elastic"});
  return columns;
}

std::vector<std::string> results_of(const Case& c, const reports::Run* run) {
  std::vector<std::string> values;
  for (const GaugeSpec& gauge : c.gauges) values.push_back(cell(measure(run, "gauge." + gauge.id + ".failure"), 1e-6));
  values.push_back(cell(measure(run, "failure.speed"), 1e3));
  values.push_back(cell(measure(run, "failure.delay"), 1e-6));
  values.push_back(cell(measure(run, "failure.slowing")));
  for (const char* what : {".longitudinal", ".lateral"})
    values.push_back(cell(measure(run, "gauge." + c.gauges.front().id + what)));
  return values;
}

}  // namespace

void add_failure_page(const Case& c, const FigureSpec& spec, reports::Case& result) {
  const PlateSpec plate = plate_of(c, "", spec.cells);
  reports::Page page;
  page.title = title_of(c, spec);
  page.intro = {c.why,
                "All of it is a reconstruction: the paper gives neither equations nor parameters, and the article that "
                "does could not be read. What is certain is marked so below; no experimental point is shown, only "
                "published ranges with their source."};
  for (const std::string& note : notes_of(c, spec, plate)) page.intro.push_back(note + ".");
  reports::Page::Section model;
  model.heading = "The model, and what of it is certain";
  model.text = {
      "Compression positive, ε the total strain. Of the whole solid: p_e = −K tr ε, s_e = −2G dev ε, "
      "W = s_e:s_e/(4G). The dilatancy V_d ≥ 0 spreads by ∂V_d/∂t = ∇·(d ∇V_d). The solid that has it answers with "
      "p = K (−tr ε + V_d) and s = √(1 − f) s_e, where f = V_d (2p_e + K V_d)/(2W), at most f_max, is the part of the "
      "shear energy that has become volumetric: p²/(2K) + (1 − f) W = p_e²/(2K) + W.",
      "In uniaxial strain ε the longitudinal stress does not change to first order in f, and the lateral one rises by "
      "Gε f: a gauge along the shock sees next to nothing of the front, one across it sees it arrive."};
  model.first = "Statement";
  model.columns = {"standing", "source"};
  for (const auto& [what, standing, source] : grounds)
    model.rows.push_back({what, "", {standing, source}, "", "", false});
  page.sections.push_back(std::move(model));
  for (const std::string& picture : spec.pictures) {
    reports::Page::Section section;
    section.picture = picture + ".svg";
    for (const FigureSpec& other : c.figures)
      if (other.id == picture) section.heading = title_of(c, other);
    section.caption = section.heading;
    page.sections.push_back(std::move(section));
  }
  for (const PageSection& part : spec.sections) {
    reports::Page::Section section;
    section.heading = part.heading;
    section.text = {part.says};
    section.first = "Variant, method";
    section.columns = result_columns(c);
    section.columns.insert(section.columns.end(), {"diffusion: node updates a step", "µs a step, this run"});
    for (const std::string& variant : part.variants) {
      std::string says = "the scene of the figures";
      for (const PlateVariant& one : c.variants)
        if (one.id == variant) says = one.says;
      for (const std::string& method : spec.methods) {
        const reports::Run* run = find_run(result.runs, spec, method, variant);
        std::vector<std::string> values = results_of(c, run);
        values.push_back(run ? cell(measure(run, "diffusion.updates"), 1, 5) : "did not complete");
        values.push_back(run ? cell(run->wall_seconds / static_cast<double>(run->steps), 1e-6, 3) : "");
        section.rows.push_back(
            {fmt::format("{}, {}", says, name_of_method(method)), "", std::move(values), "", "", variant.empty()});
      }
    }
    page.sections.push_back(std::move(section));
  }
  result.pages.emplace_back(spec.id, std::move(page));
}

}  // namespace diptych::runner
