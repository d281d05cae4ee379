// When two bars of particles feel each other through the background grid of the material point method.
#pragma once

namespace diptych::analytic {

/// Two particles in rigid flight on a line, seen from one face of a grid with cells of one size.
struct Approach {
  double left, right;                    ///< of the particles that face each other at t = 0, left < right [m]
  double left_velocity, right_velocity;  ///< [m/s]
  double cell;                           ///< h [m], > 0
};

/// Seconds until both reach one node: until their cells are the same or next to each other. Linear shape functions see
/// no further, and the no-slip contact of a single velocity field begins there: while the particles are still between h
/// and 2h apart, or nearer where both enter the same cell at once. Infinite where they never do. Throws
/// std::invalid_argument where left ≥ right or the cell is not positive, std::domain_error where they fly so far or so
/// slowly that doubles do not tell the faces that they cross.
double grid_contact_time(const Approach&);

}  // namespace diptych::analytic
