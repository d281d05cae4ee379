#include "fem/sweep.hpp"

#include "hinge/wide.hpp"

namespace diptych::fem {
namespace {

/// Eq. 18 of one component at a node.
template <bool with_body>
[[gnu::always_inline]] inline void move(double force, const double* body, double* velocity, double* displacement,
                                        std::size_t i, const KickAndDrift& factor) {
  if constexpr (with_body) force += body[i];
  velocity[i] += factor.kick * force;
  displacement[i] += factor.drift * velocity[i];
}

// With e the corners' displacements relative to the middle, the sum of ∇u over the two triangles at a corner is
// (A ∓ P, B ∓ P) at the corners a, c and (A ± Q, B ∓ Q) at b, d, where
//   P = e_a + e_c, D = e_c − e_a, Q = e_b + e_d, E = e_b − e_d, A = D + E, B = D − E:
// the stresses of A and B are common to opposite corners, and the force on the middle is what P and Q pull.
template <bool with_body>
DIPTYCH_WIDEST void cell_loop(const WholeCell& k, std::size_t cells, const double* __restrict ax,
                              const double* __restrict ay, const double* __restrict dx, const double* __restrict dy,
                              const NodeRow& middle, const KickAndDrift& factor, CornerForces& f, std::size_t first) {
  double* __restrict ux = middle.ux, * __restrict uy = middle.uy, * __restrict vx = middle.vx, * __restrict vy = middle.vy;
  const double* __restrict bx = middle.body_x, * __restrict by = middle.body_y;
  double* __restrict fax = f.lower_left[0] + first, * __restrict fay = f.lower_left[1] + first;
  double* __restrict fbx = f.lower_right[0] + first + 1, * __restrict fby = f.lower_right[1] + first + 1;
  double* __restrict fcx = f.upper_right[0] + first + 1, * __restrict fcy = f.upper_right[1] + first + 1;
  double* __restrict fdx = f.upper_left[0] + first, * __restrict fdy = f.upper_left[1] + first;
  const double xx = k.xx, yy = k.yy, shear_x = k.shear_x, shear_y = k.shear_y, cross = k.cross, shear = k.shear,
               direct_x = k.direct_x, direct_y = k.direct_y, mixed = k.mixed;
  const KickAndDrift kick_and_drift = factor;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    const double eax = ax[i] - ux[i], ebx = ax[i + 1] - ux[i], ecx = dx[i + 1] - ux[i], edx = dx[i] - ux[i];
    const double eay = ay[i] - uy[i], eby = ay[i + 1] - uy[i], ecy = dy[i + 1] - uy[i], edy = dy[i] - uy[i];
    const double Px = eax + ecx, Dx = ecx - eax, Qx = ebx + edx, Ex = ebx - edx;
    const double Py = eay + ecy, Dy = ecy - eay, Qy = eby + edy, Ey = eby - edy;
    const double Ax = Dx + Ex, Bx = Dx - Ex, Ay = Dy + Ey, By = Dy - Ey;
    const double s_xx = xx * Ax + cross * By, s_yy = cross * Ax + yy * By;            // a σ_xx, b σ_yy
    const double s_xy = shear_y * Bx + shear * Ay, s_yx = shear * Bx + shear_x * Ay;  // b σ_xy, a σ_xy
    const double px = direct_x * Px + mixed * Py, py = mixed * Px + direct_y * Py;
    const double qx = direct_x * Qx - mixed * Qy, qy = direct_y * Qy - mixed * Qx;
    fax[i] = (s_xx + s_xy) - px;
    fay[i] = (s_yx + s_yy) - py;
    fcx[i] = -(s_xx + s_xy) - px;
    fcy[i] = -(s_yx + s_yy) - py;
    fbx[i] = (s_xy - s_xx) - qx;
    fby[i] = (s_yy - s_yx) - qy;
    fdx[i] = (s_xx - s_xy) - qx;
    fdy[i] = (s_yx - s_yy) - qy;
    const double fx = 2 * (px + qx), fy = 2 * (py + qy);
    move<with_body>(fx, bx, vx, ux, i, kick_and_drift);
    move<with_body>(fy, by, vy, uy, i, kick_and_drift);
  }
}

template <bool with_body>
DIPTYCH_WIDEST void node_loop(std::size_t first, std::size_t end, const CornerForces& f, const NodeRow& row,
                              const KickAndDrift& factor, double* __restrict below_x, double* __restrict below_y) {
  double* __restrict ux = row.ux, * __restrict uy = row.uy, * __restrict vx = row.vx, * __restrict vy = row.vy;
  const double* __restrict bx = row.body_x, * __restrict by = row.body_y;
  const double* __restrict ax = f.lower_left[0], * __restrict ay = f.lower_left[1];
  const double* __restrict rx = f.lower_right[0], * __restrict ry = f.lower_right[1];
  const double* __restrict cx = f.upper_right[0], * __restrict cy = f.upper_right[1];
  const double* __restrict dx = f.upper_left[0], * __restrict dy = f.upper_left[1];
  const KickAndDrift kick_and_drift = factor;
#pragma GCC ivdep
  for (std::size_t i = first; i < end; ++i) {
    const double fx = below_x[i] + (ax[i] + rx[i]), fy = below_y[i] + (ay[i] + ry[i]);
    below_x[i] = dx[i] + cx[i];
    below_y[i] = dy[i] + cy[i];
    move<with_body>(fx, bx, vx, ux, i, kick_and_drift);
    move<with_body>(fy, by, vy, uy, i, kick_and_drift);
  }
}

template <bool with_body, bool viscous>
DIPTYCH_WIDEST void own_cell_loop(const StressRows& stress, const CellSize& h, std::size_t cells, const NodeRow& middle,
                                  const KickAndDrift& factor, CornerForces& f, std::size_t first) {
  double* __restrict ux = middle.ux, * __restrict uy = middle.uy, * __restrict vx = middle.vx, * __restrict vy = middle.vy;
  const double* __restrict bx = middle.body_x, * __restrict by = middle.body_y;
  double* __restrict fax = f.lower_left[0] + first, * __restrict fay = f.lower_left[1] + first;
  double* __restrict fbx = f.lower_right[0] + first + 1, * __restrict fby = f.lower_right[1] + first + 1;
  double* __restrict fcx = f.upper_right[0] + first + 1, * __restrict fcy = f.upper_right[1] + first + 1;
  double* __restrict fdx = f.upper_left[0] + first, * __restrict fdy = f.upper_left[1] + first;
  const auto s = stress.triangle;
  const CellSize size = h;
  const KickAndDrift kick_and_drift = factor;
#pragma GCC ivdep
  for (std::size_t i = 0; i < cells; ++i) {
    const CellValues force =
        internal_forces({s[0].at<viscous>(i), s[1].at<viscous>(i), s[2].at<viscous>(i), s[3].at<viscous>(i)}, size);
    fax[i] = force[0][0];
    fay[i] = force[0][1];
    fbx[i] = force[1][0];
    fby[i] = force[1][1];
    fcx[i] = force[2][0];
    fcy[i] = force[2][1];
    fdx[i] = force[3][0];
    fdy[i] = force[3][1];
    const double fx = force[4][0], fy = force[4][1];
    move<with_body>(fx, bx, vx, ux, i, kick_and_drift);
    move<with_body>(fy, by, vy, uy, i, kick_and_drift);
  }
}

}  // namespace

Loops loops(bool body_force, bool viscous) {
  const auto choose = [&]<bool with_body>() {
    return Loops{cell_loop<with_body>, viscous ? own_cell_loop<with_body, true> : own_cell_loop<with_body, false>,
                 node_loop<with_body>};
  };
  return body_force ? choose.template operator()<true>() : choose.template operator()<false>();
}

}  // namespace diptych::fem
