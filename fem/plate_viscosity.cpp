#include "fem/plate_viscosity.hpp"

#include <algorithm>
#include <cmath>

namespace diptych::fem {

ArtificialViscosity::ArtificialViscosity(const Plate& plate, const Mesh& mesh, CellStress& stress, const Rows& rows)
    : viscosity_(*plate.viscosity),
      density_(elastic(plate).density),
      speed_(elastic(plate).pressure_wave_speed()),
      length_(std::sqrt(mesh.h.x * mesh.h.y)),
      mesh_(mesh),
      stress_(stress),
      rows_(rows),
      rows_of_(mesh.ny) {
  for (auto& q : stress_.viscous) q.resize(mesh.cells());
}

/// tr D of each triangle [1/s].
std::array<double, 4> ArtificialViscosity::dilation(CellAt at) const {
  const Triangles rate = mesh_.strain_rate(at);
  return {rate[0].xx + rate[0].yy, rate[1].xx + rate[1].yy, rate[2].xx + rate[2].yy, rate[3].xx + rate[3].yy};
}

double ArtificialViscosity::largest_rate() {
  rows_.for_each([&](Index j) {
    rows_of_[j].largest = 0;
    mesh_.for_row(j, [&](CellAt at) {
      for (const double D : dilation(at)) {
        if (viscosity_.acts(D)) rows_of_[j].largest = std::max(rows_of_[j].largest, std::abs(D));
      }
    });
  });
  double largest = 0;
  for (const Row& row : rows_of_) largest = std::max(largest, row.largest);
  return largest;
}

void ArtificialViscosity::update() {
  const double largest = viscosity_.needs_largest() ? largest_rate() : 0;
  rows_.for_each([&](Index j) {
    mesh_.for_row(j, [&](CellAt at) {
      const std::array<double, 4> D = dilation(at);
      bool acts = false;
      for (Index t = 0; t < 4; ++t) {
        double& q = stress_.viscous[t][at.cell];
        q = viscosity_.stress(D[t], largest, density_, speed_, length_);
        acts = acts || q != 0;
      }
      if (!acts) return;
      rows_of_[j].acted = true;
      stress_.keep(at.cell, stress_.of(mesh_, at));
      stress_.own[at.cell] = 1;
    });
  });
}

double ArtificialViscosity::work(double dt) {
  rows_.for_each([&](Index j) {
    double sum = 0;
    mesh_.for_row(j, [&](CellAt at) {
      const std::array<double, 4> D = dilation(at);
      for (Index t = 0; t < 4; ++t) sum += stress_.viscous[t][at.cell] * (D[t] * dt);
    });
    rows_of_[j].work = mesh_.h.triangle_area() * sum / 2;
  });
  double sum = 0;
  for (const Row& row : rows_of_) sum += row.work;
  return sum;
}

bool ArtificialViscosity::acted() const {
  return std::any_of(rows_of_.begin(), rows_of_.end(), [](const Row& row) { return row.acted; });
}

}  // namespace diptych::fem
