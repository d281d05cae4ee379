#include "mpm/plate_grid.hpp"

#include "hinge/scene/plate_check.hpp"

namespace diptych::mpm {

Grid grid_of(const Plate& plate, const Cells& cells, bool roaming, bool keeps_kicked) {
  Grid grid;
  const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
  grid.hx = plate.width / cells.x;
  grid.hy = plate.height / cells.y;
  grid.nx = nx;
  grid.ny = ny;
  if (plate.impact && plate.impact->gap > 0) {
    grid.cut = impact_column(plate, cells);
    ++grid.nx;
  }
  if (roaming) {
    const auto room = [&](Side side, std::size_t count) {
      return plate.edge(side).support == Edge::Support::free ? count : 0;
    };
    grid.left = -static_cast<double>(room(Side::left, nx)) * grid.hx;
    grid.bottom = -static_cast<double>(room(Side::bottom, ny)) * grid.hy;
    grid.nx += room(Side::left, nx) + room(Side::right, nx);
    grid.ny += room(Side::bottom, ny) + room(Side::top, ny);
    grid.alike = false;
  }
  grid.stride = off_pages(grid.row_length(), 4);
  grid.mass.assign(grid.mass_rows() * grid.stride, 0);
  grid.velocity.resize(grid.storage());
  grid.acceleration.resize(grid.storage());
  if (keeps_kicked) grid.kicked.resize(grid.storage());
  return grid;
}

}  // namespace diptych::mpm
