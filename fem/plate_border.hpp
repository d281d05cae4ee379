// The sides of the plate: how its border nodes are held, driven and loaded, and the body force.
#pragma once

#include <array>
#include <vector>

#include "fem/plate_mesh.hpp"
#include "hinge/scene/plate.hpp"
#include "hinge/step/stepping.hpp"

namespace diptych::fem {

/// What moves a component of a node on a side.
enum class Hold {
  none,    ///< its own force
  platen,  ///< that of its platen
  driven,  ///< a given velocity
  held     ///< nothing
};

struct BorderNode {
  Index node;   ///< among the corners
  double mass;  ///< [kg/m]
  std::array<Hold, 2> hold{Hold::none, Hold::none};
  std::array<const Edge*, 2> driver{};  ///< of driven components
  Vector load{};                        ///< of tractions [N/m]
  Vector force{};                       ///< all but the reaction of what holds it [N/m]
  Vector before{};                      ///< velocity before the kick, for the books [m/s]
};

/// Work and impulse from outside, of one kick: rates before and after it [W/m], and the force [N/m].
struct ExternalWork {
  double before = 0, after = 0;
  Vector force{};
};

class Border {
 public:
  /// Supports take up at once what the scene would have them do at the start. Throws std::invalid_argument where the
  /// initial displacement bends a platen.
  Border(const Plate&, Mesh&);

  void external_force(const Kick&);  ///< eqs. 17b and 20: tractions on border nodes, the body force on all
  /// Eq. 18 of border node i, j, where nothing holds it.
  void kick(Index i, Index j, const Vector& internal_force, double kick, double dt);
  void move_platens(double kick, double dt);    ///< one acceleration for all nodes of each
  void drive_supports(double time, double dt);  ///< given velocities

  bool has_platen() const { return !platens_.empty(); }
  double platen_displacement() const;  ///< of the first, along its outward normal [m]
  bool free() const;                   ///< nothing holds the plate as a whole

  void note_velocities();  ///< before the kick, for external_work after it
  ExternalWork external_work(double kick) const;
  Index bytes() const { return border_.capacity() * sizeof(BorderNode); }

 private:
  /// Nodes of a side that move as one across it.
  struct Platen {
    Side side;
    std::vector<Index> nodes;  ///< places in the border
    double mass = 0;           ///< [kg/m]
    double u = 0, v = 0;       ///< along x or y [m], [m/s]
  };

  void make_border();
  void start_supports();
  void make_platens();
  Index place(Index i, Index j) const;
  std::vector<Index> places_along(Side) const;
  void apply_body_force(double time);
  template <class Of>
  double sum_over(const Platen&, Of) const;
  void follow(const Platen&);
  double given_velocity(const BorderNode&, Index component, double time) const;
  double body_work_rate() const;

  const Plate& plate_;
  Mesh& mesh_;
  std::vector<BorderNode> border_;
  std::array<std::vector<Index>, 4> along_;  // places in the border, by side
  std::vector<Platen> platens_;
  double body_work_rate_ = 0;
};

}  // namespace diptych::fem
