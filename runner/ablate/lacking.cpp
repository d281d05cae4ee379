#include "runner/ablate/lacking.hpp"

#include <cmath>
#include <limits>

#include "runner/input/build.hpp"
#include "runner/panel.hpp"

namespace diptych::runner {
namespace {

using Addition = std::optional<Revision>;

/// At a shock; where nothing is compressed it does nothing.
Addition with_viscosity(const Case& c, const Leaf&) {
  if (c.viscosity || (c.plate && (c.plate->viscosity || !c.plate->solid))) return {};
  if (c.plate && !takes_viscosity(*c.plate->solid))
    return impossible("no viscosity is known beside damage or plasticity of a plate");
  Revision r;
  r.says = "artificial viscosity in compression, eq. 21 with c1 = c2 = 0.2";
  Node::Entries table;
  table.push_back({"c1", {}, Node{{}, 0.2}});
  table.push_back({"c2", {}, Node{{}, 0.2}});
  table.push_back({"form", {}, Node{{}, std::string("york")}});
  r.changes = {{"viscosity", Node{{}, std::move(table)}}};
  r.adds = {"viscosity"};
  r.aid = true;
  return r;
}

/// Whether two bars come together in free flight before the run ends.
bool closes(const Case& c, const Leaf& leaf) {
  return c.bars.size() > 1 && contact_time(c, leaf.cells) < instant(c, leaf, c.times.back());
}

Revision finite_displacements() {
  Revision r;
  r.says = "finite displacements: the material moves through the grid";
  r.changes = {{"model.displacements", value_in("finite")}};
  r.adds = {"convection"};
  r.another_exact = true;
  return r;
}

Addition with_finite_displacements(const Case& c, const Leaf& leaf) {
  if (c.convected || (c.plate && !c.plate->solid)) return {};
  const Panel& method = panel(leaf.method);
  if (contains(method.shows_not, "convection")) return impossible("its mesh goes with the material either way");
  if (!c.plate && closes(c, leaf)) return {};  // asked as contact
  return finite_displacements();
}

Addition with_contact(const Case& c, const Leaf& leaf) {
  if (c.plate || c.bars.size() < 2) return {};
  const Panel& method = panel(leaf.method);
  if (method.grid_contact) {
    if (c.convected || !closes(c, leaf)) return {};
    Revision r = finite_displacements();
    r.says = "finite displacements: the bars come together, and particles that stay in their cells never meet";
    return r;
  }
  if (c.contact != Contact::bonded) return {};
  Revision r;
  r.says = "ends that may part again, instead of bonded ones";
  r.changes = {{"contact.fem", value_in("node-to-node")}};
  r.another_exact = true;
  return r;
}

Addition with_finer_step(const Case& c, const Leaf&) {
  if (!c.plate || !(c.plate->diffusion || (c.plate->solid && diffuses(*c.plate->solid)))) return {};
  Revision r;
  r.says = c.plate->solid ? "half the time step, of waves and of diffusion" : "half the time step";
  r.courant = 0.5;
  if (c.scene.contains("diffusion.drift")) {
    r.says += ", and matrices factorised in every step";
    r.changes.push_back({"diffusion.drift", Node{{}, 0.0}});
  }
  return r;
}

}  // namespace

const std::vector<LackingRow>& lacking_rows() {
  static const std::vector<LackingRow> rows{{"viscosity", with_viscosity},
                                            {"finite displacements", with_finite_displacements},
                                            {"contact", with_contact},
                                            {"a finer time step", with_finer_step}};
  return rows;
}

}  // namespace diptych::runner
