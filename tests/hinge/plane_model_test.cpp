#include "hinge/solid/plane_model.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "fem/plate.hpp"
#include "fem/plate_body.hpp"
#include "hinge/solid/plate_models.hpp"
#include "hinge/solid/plate_solid.hpp"
#include "mpm/plate.hpp"
#include "mpm/plate_body.hpp"
#include "tests/plate_records.hpp"

BOOST_AUTO_TEST_SUITE(plane_model)

using namespace diptych;
using material::PlaneElastic;
using material::Tensor;
namespace tt = boost::test_tools;

namespace {

/// A law that no panel knows: the shear modulus is reduced, the bulk modulus is not.
struct Softened {
  static constexpr const char* feature = "softened";
  static constexpr const char* name = "a softened solid";

  PlaneElastic law;
  double part = 1;

  const PlaneElastic& elastic() const { return law; }
  double stiffening() const { return 1; }
  void check() const {}

  class Model : public solid::Unchanging {
   public:
    Model(const Softened& s, const diffusion::Grid&, std::size_t)
        : Unchanging(s.law),
          stiffness_(material::stiffness_of_moduli(s.law.bulk_modulus(), s.part * s.law.shear_modulus(), s.law.plane)) {
    }
    struct Row {
      material::Stiffness stiffness;
      Tensor stress(const Tensor& strain, std::size_t, std::size_t) const { return stiffness.stress(strain); }
      Tensor stress(const Tensor& strain, std::size_t, std::size_t, double&) const { return stiffness.stress(strain); }
    };
    Row row(std::size_t, std::size_t) { return {stiffness_}; }
    Tensor standing(const Tensor& strain, std::size_t, std::size_t) const { return stiffness_.stress(strain); }
    double stored(const Tensor& strain, std::size_t, std::size_t) const {
      return stiffness_.stress(strain).contract(strain) / 2;
    }
    bool whole(std::size_t, std::size_t) const { return false; }
    void name_features(std::vector<std::string>& active) const { active.emplace_back(feature); }

   private:
    material::Stiffness stiffness_;
  };
};
static_assert(solid::PlaneModel<Softened::Model>);

constexpr PlaneElastic rubber{1e4, 0.3, 1, material::Plane::strain};

/// The elastic solid of the same moduli.
PlaneElastic softened(const PlaneElastic& e, double part) {
  const double K = e.bulk_modulus(), G = part * e.shear_modulus();
  return {9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G)), e.density, e.plane};
}

Plate plate(const PlateSolid& of) {
  Plate p;
  p.width = 1;
  p.height = 1.2;
  p.solid = of;
  p.edge(Side::left).support = p.edge(Side::bottom).support = Edge::Support::roller;
  p.edge(Side::top).normal_traction = [](double, double) { return 10.0; };
  p.initial_velocity = [](double x, double y) { return Vector{std::sin(3 * x + y), std::cos(2 * x * y)}; };
  return p;
}

void are_close(const PlateRecord& a, const PlateRecord& b) {
  const PointField &one = first(a).stress, &other = first(b).stress;
  BOOST_REQUIRE_EQUAL(one.x.size(), other.x.size());
  for (std::size_t c = 0; c < 3; ++c) {
    const double scale = largest(other.component[c]);
    for (std::size_t k = 0; k < one.x.size(); ++k)
      BOOST_REQUIRE_SMALL(one.component[c][k] - other.component[c][k], 1e-9 * scale);
  }
  BOOST_TEST(a.features == std::vector<std::string>{"softened"}, tt::per_element());
  BOOST_TEST(std::abs(a.sums.lost) < 1e-10 * a.sums.held);
  BOOST_TEST(std::abs(a.ledger.back().dissipated) < 1e-10 * a.sums.held);
}

constexpr diffusion::Grid grid{3, 2, 0.1, 0.2};
const std::vector<Tensor> strains{{1e-3, 2e-3, -5e-4}, {-2e-3, 1e-3, 3e-4}, {-4e-3, -1e-3, 2e-3}, {0, 0, 1e-3}};

/// The stress of a row's point is the one that stands, and a whole point has the whole solid's, to the bit.
template <class Model>
void is_consistent(Model& model, const PlaneElastic& elastic) {
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    const Tensor& strain = strains[cell % strains.size()];
    const auto law = model.row(cell, 4 * cell);
    const Tensor of_row = law.stress(strain, 0, 1), stands = model.standing(strain, cell, 4 * cell + 1);
    BOOST_TEST(of_row.xx == stands.xx, tt::tolerance(1e-14));
    BOOST_TEST(of_row.yy == stands.yy, tt::tolerance(1e-14));
    BOOST_TEST(of_row.xy == stands.xy, tt::tolerance(1e-14));
    BOOST_TEST(model.stored(strain, cell, 4 * cell + 1) > 0);
    if (!model.whole(cell, 4 * cell + 1)) continue;
    const Tensor whole = elastic.stiffness().stress(strain);
    BOOST_TEST((stands.xx == whole.xx && stands.yy == whole.yy && stands.xy == whole.xy));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(both_panels_run_a_law_that_they_do_not_know) {
  const Softened soft{rubber, 0.6};
  const Plate stiff = plate(solid::Elastic{rubber}), same = plate(solid::Elastic{softened(rubber, 0.6)});
  const Cells cells{5, 6};
  const std::vector<double> quarters{0.25, 0.75};
  const Stepping stepping = steps_of(5e-4, 100);
  are_close(fem::run_solid(stiff, soft, cells, stepping), fem::run(same, cells, stepping));
  for (const auto scheme : {mpm::Scheme::usf, mpm::Scheme::usl, mpm::Scheme::musl})
    are_close(mpm::run_standing({stiff, cells, quarters, scheme, stepping}, soft),
              mpm::run(same, cells, quarters, scheme, stepping));
}

BOOST_AUTO_TEST_CASE(every_model_has_one_stress) {
  const material::Compression cone{1, 0.1};
  solid::Cracking cracking{{rubber}};
  cracking.evolution.critical_strain = 0;
  cracking.evolution.reference_rate = 1e-6;
  solid::Failing failing{{rubber, 0, 0.8}};
  failing.spread.start.assign(grid.nodes(), 0);
  failing.spread.start[0] = 1e-4;
  std::vector<PlateSolid> all{solid::Elastic{rubber}, solid::Elastic{rubber, cone}, cracking, failing};
  cracking.compression = cone;
  all.emplace_back(cracking);
  for (const PlateSolid& one : all) {
    std::visit(
        [](const auto& s) {
          solid::with_model(s, [&]<class Model>() {
            Model model(s, grid, 4 * grid.cells());
            is_consistent(model, rubber);
            std::vector<double> drivers;
            for (std::size_t cell = 0; cell < grid.cells(); ++cell)
              drivers.push_back(model.driver()(strains[cell % strains.size()]));
            model.advance(drivers, 1e-6);
            model.renew(0, grid.cells());
            for (std::size_t cell = 0; cell < grid.cells(); ++cell) BOOST_TEST(!model.outdated(cell));
            is_consistent(model, rubber);
            if (Model::linear) BOOST_TEST(model.whole(0, 0));
            if (Model::staggered) BOOST_TEST(!model.whole(0, 0));
          });
        },
        one);
  }
}

BOOST_AUTO_TEST_CASE(what_a_solid_says_of_itself) {
  const material::Compression cone{1, 0.1};
  const PlateSolid whole = solid::Elastic{rubber}, flows = solid::Elastic{rubber, cone},
                   fails = solid::Failing{{rubber, 0, 0.5}};
  solid::Cracking cracking{{rubber}};
  const PlateSolid local = cracking;
  cracking.evolution.diffusion.emplace();
  const PlateSolid spreads = cracking;
  for (const PlateSolid* s : {&whole, &flows, &fails, &local, &spreads})
    BOOST_TEST(elastic(*s).youngs_modulus == rubber.youngs_modulus);
  BOOST_TEST((takes_viscosity(whole) && !takes_viscosity(flows) && takes_viscosity(fails) && !takes_viscosity(local)));
  BOOST_TEST((!changes_in_cells(whole) && !changes_in_cells(flows) && changes_in_cells(fails)));
  BOOST_TEST((diffuses(fails) && diffuses(spreads) && !diffuses(local) && !diffuses(whole)));
  BOOST_TEST((compression_of(flows) && compression_of(flows)->slope == 0.1 && !compression_of(fails)));
  BOOST_TEST(feature_of(fails) == std::string("failure-wave"));
}

// Eq. 23a stands in the law alone: whoever lets cracks grow asks it.
BOOST_AUTO_TEST_CASE(cracks_grow_by_the_law_of_their_solid) {
  solid::Cracking cracking{{rubber}};
  cracking.law.exponent = 5;
  cracking.law.flaw_density = 3e22;
  cracking.evolution.critical_strain = 0;
  cracking.evolution.reference_rate = 50;
  cracking.evolution.cap = std::numeric_limits<double>::infinity();
  solid::Cracking::Model model(cracking, grid, 1);
  model.advance(std::vector<double>(grid.cells(), 1e-3), 1e-6);
  for (const double C_d : model.fields().crack_density) BOOST_TEST(C_d == cracking.law.crack_density(1e-3, 50));
}

BOOST_AUTO_TEST_SUITE_END()
