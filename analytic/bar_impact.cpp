#include "analytic/bar_impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "analytic/parameters.hpp"

namespace diptych::analytic {
namespace {

using real = long double;

constexpr real never = std::numeric_limits<real>::infinity();
constexpr real same_time = 1e-11L;    ///< of the shortest L/c: events at one place are one
constexpr real no_strength = 1e-14L;  ///< of the stresses at hand: a front is none
constexpr std::size_t most_events = 1000000;
constexpr std::size_t most_links = std::size_t{1} << 26;  ///< of 4 bytes: a quarter of a gigabyte

double plain(real x) { return static_cast<double>(x); }

void require_impact(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("bar-impact: " + message);
}

/// Round-off of positions that a user computes as begin + fraction × length.
real slack(const ImpactBar& bar) {
  return 4 * real{std::numeric_limits<double>::epsilon()} * (std::abs(real{bar.begin}) + real{bar.length});
}

struct Material {
  real length, modulus, density, yield;
  real speed, plastic_speed;          ///< c, c_p (0 where elastic)
  real impedance, plastic_impedance;  ///< ρc, ρc_p
  real plastic_compliance;            ///< 1/E_t − 1/E = 1/H
};

Material material(const ImpactBar& bar) {
  const real modulus = bar.youngs_modulus, density = bar.density, tangent = bar.tangent_modulus;
  const bool yields = std::isfinite(bar.yield_stress);
  Material m{};
  m.length = bar.length;
  m.modulus = modulus;
  m.density = density;
  m.yield = bar.yield_stress;
  m.speed = std::sqrt(modulus / density);
  m.impedance = density * m.speed;
  m.plastic_speed = yields ? std::sqrt(tangent / density) : 0;
  m.plastic_impedance = density * m.plastic_speed;
  m.plastic_compliance = yields ? 1 / tangent - 1 / modulus : 0;
  return m;
}

struct State {
  real stress, velocity, plastic_strain, yield;
};

real strain(const Material& m, const State& s) { return s.stress / m.modulus + s.plastic_strain; }

/// Plastic work per unit of volume: while a point flows |σ| = Y, so ∫ σ dε_p = ∫ Y dY/H.
real plastic_work_density(const Material& m, real yield) {
  return m.plastic_compliance == 0 ? 0 : (yield - m.yield) * (yield + m.yield) / 2 * m.plastic_compliance;
}

/// One side of a Riemann problem: material in a uniform state.
struct Side {
  const Material* material;
  State state;
};

/// φ(σ) = offset + slope σ on the linear piece that holds a given stress.
struct Piece {
  real offset, slope;
  real at(real stress) const { return offset + slope * stress; }
};

Piece piece(const Side& side, real stress) {
  const auto& [m, s] = side;
  if (std::abs(stress) <= s.yield) return {-s.stress / m->impedance, 1 / m->impedance};
  const real yield = std::copysign(s.yield, stress);
  return {(yield - s.stress) / m->impedance - yield / m->plastic_impedance, 1 / m->plastic_impedance};
}

/// σ* of v_L + φ_L(σ*) = v_R − φ_R(σ*). A side that is null is a wall at rest.
real star_stress(const Side* left, const Side* right) {
  const real closing = (right ? right->state.velocity : 0) - (left ? left->state.velocity : 0);
  const auto sum = [&](real stress) {
    const Piece l = left ? piece(*left, stress) : Piece{0, 0}, r = right ? piece(*right, stress) : Piece{0, 0};
    return Piece{(l.offset + r.offset) - closing, l.slope + r.slope};
  };
  std::vector<real> kinks;
  for (const Side* side : {left, right})
    if (side && std::isfinite(side->state.yield)) kinks.insert(kinks.end(), {side->state.yield, -side->state.yield});
  std::sort(kinks.begin(), kinks.end());
  const std::size_t count = kinks.size();
  std::size_t above = 0;
  while (above < count && sum(kinks[above]).at(kinks[above]) < 0) ++above;
  real probe = 0;  // on the piece between the kinks around the root
  if (count > 0)
    probe = above == 0 ? 2 * kinks[0] : above == count ? 2 * kinks[count - 1] : (kinks[above - 1] + kinks[above]) / 2;
  const Piece line = sum(probe);
  real stress = -line.offset / line.slope;
  if (above > 0) stress = std::max(stress, kinks[above - 1]);
  if (above < count) stress = std::min(stress, kinks[above]);
  return stress;
}

/// Velocity behind the waves that bring a side to a stress: sent to the left (−1) by the left side, else to the right.
real velocity_at(const Side& side, int direction, real stress) {
  return side.state.velocity - direction * piece(side, stress).at(stress);
}

struct Wave {
  real speed;
  State behind;
};

/// What a side sends out to reach a stress and velocity; the outermost, which is the fastest, first. Waves whose jump
/// is not above `least` are left out.
std::vector<Wave> waves(const Side& side, int direction, real stress, real velocity, real least) {
  const auto& [m, s] = side;
  const bool flows = std::abs(stress) > s.yield + least;
  const real elastic = flows ? std::copysign(s.yield, stress) : stress;
  std::vector<Wave> out;
  State now = s;
  if (std::abs(elastic - s.stress) > least) {
    now.velocity = s.velocity - direction * (elastic - s.stress) / m->impedance;
    now.stress = elastic;
    out.push_back({direction * m->speed, now});
  }
  if (flows) {
    now.plastic_strain += (stress - elastic) * m->plastic_compliance;
    now.yield = std::abs(stress);
    now.stress = stress;
    out.push_back({direction * m->plastic_speed, now});
  }
  if (!out.empty()) out.back().behind.velocity = velocity;
  return out;
}

/// What bounds regions, from one event to another: a front, a jump of the yield stress, or an end of the bar.
struct Line {
  real time, place, displacement;  ///< where it starts; place from the bar's left end
  real speed;                      ///< in the reference bar
  real rate;                       ///< of displacement, following it: v + U ε, the same on both sides
  real travelled;
  State left, right;

  real place_at(real t) const { return place + speed * (t - time); }
  real displacement_at(real t) const { return displacement + rate * (t - time); }
};

/// The lines of a bar after one event, in one long list of links.
struct Chain {
  real time;
  std::size_t event, first, size;
};

/// Jumps of a traction, in order of time.
std::vector<Traction::Kink> jumps(const BarEnd& end) {
  auto kinks = end.traction.kinks;
  std::stable_sort(kinks.begin(), kinks.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return kinks;
}

void check_impact(const BarEnd& end) {
  require_impact(!end.fixed || end.traction.kinks.empty(), "a fixed end carries no traction");
  for (const auto& kink : end.traction.kinks) {
    require_impact(std::isfinite(kink.time) && kink.time >= 0, "a traction must change at finite times >= 0");
    require_impact(std::isfinite(kink.jump), "a traction must be finite");
    require_impact(kink.slope == 0, "a traction may only jump: behind a ramp the states are not constant");
  }
}

void check_impact(const BarImpact::Parameters& p) {
  require_impact(!p.bars.empty(), "there must be a bar");
  require_impact(positive(p.until), "`until` must be finite and > 0");
  check_impact(p.left);
  check_impact(p.right);
  for (std::size_t k = 0; k < p.bars.size(); ++k) {
    const auto& bar = p.bars[k];
    const auto checked = [&](bool condition, const std::string& message) {
      require_impact(condition, "bar " + std::to_string(k) + ": " + message);
    };
    checked(std::isfinite(bar.begin), "its begin must be finite");
    checked(positive(bar.length), "length must be > 0");
    checked(positive(bar.youngs_modulus), "Young's modulus must be > 0");
    checked(positive(bar.density), "density must be > 0");
    checked(std::isfinite(bar.velocity), "velocity must be finite");
    checked(bar.yield_stress > 0, "yield stress must be > 0 (infinite for an elastic bar)");
    if (std::isfinite(bar.yield_stress)) {
      checked(bar.tangent_modulus != 0,
              "tangent modulus 0 with a finite yield stress: c_p = 0: the plastic strain is then a delta on the "
              "contact face and no front carries it; see the perfectly plastic impact (analytic/plastic_impact.hpp)");
      checked(bar.tangent_modulus > 0 && bar.tangent_modulus < bar.youngs_modulus,
              "tangent modulus must lie between 0 and Young's modulus");
    }
    if (k == 0) continue;
    const real gap = real{bar.begin} - (real{p.bars[k - 1].begin} + real{p.bars[k - 1].length});
    checked(gap >= -std::max(slack(bar), slack(p.bars[k - 1])), "it overlaps the bar before it, or is out of order");
  }
}

/// Distance of bars k and k + 1 at t = 0; zero to the round-off of positions is zero.
real initial_gap(const std::vector<ImpactBar>& bars, std::size_t k) {
  const real gap = real{bars[k + 1].begin} - (real{bars[k].begin} + real{bars[k].length});
  return gap <= std::max(slack(bars[k]), slack(bars[k + 1])) ? 0 : gap;
}

}  // namespace

struct BarImpact::Record {
  Parameters parameters;
  std::vector<Material> materials;
  std::vector<Line> lines;
  std::vector<std::uint32_t> links;        ///< into lines
  std::vector<std::vector<Chain>> chains;  ///< of each bar, by time
  std::vector<real> times;                 ///< of snapshots
  std::vector<Event> events;
  std::vector<Contact> contacts;
  struct Span {
    std::size_t from, to;
  };
  std::vector<Span> spans;          ///< of contacts, in snapshots
  std::vector<real> stress, speed;  ///< largest |σ| and |v| in each bar so far
  real slowest = 0, fastest = 0;    ///< velocities met

  const Line& line(const Chain& chain, std::size_t i) const { return lines[links[chain.first + i]]; }

  const Chain& chain(std::size_t bar, real t) const {
    const auto& all = chains[bar];
    const auto after = std::upper_bound(all.begin(), all.end(), t, [](real x, const Chain& c) { return x < c.time; });
    return *std::prev(after);
  }

  const Chain& chain_of_snapshot(std::size_t bar, std::size_t k) const {
    const auto& all = chains[bar];
    const auto after =
        std::upper_bound(all.begin(), all.end(), k, [](std::size_t x, const Chain& c) { return x < c.event; });
    return *std::prev(after);
  }

  void check_time(double t) const {
    if (!(t >= 0 && t <= parameters.until)) {
      std::ostringstream message;
      message << "bar-impact: t = " << t << " must lie in [0, " << parameters.until << "]";
      throw std::domain_error(message.str());
    }
  }

  /// The bar at a reference coordinate, and the distance from its left end.
  std::pair<std::size_t, real> locate(double x) const {
    const auto& bars = parameters.bars;
    for (std::size_t k = bars.size(); std::isfinite(x) && k-- > 0;) {
      const real from = real{x} - real{bars[k].begin};
      if (from < -slack(bars[k])) continue;
      if (from > real{bars[k].length} + slack(bars[k])) break;
      return {k, std::clamp(from, real{0}, real{bars[k].length})};
    }
    std::ostringstream message;
    message << "bar-impact: no bar at x = " << x << " (a reference coordinate)";
    throw std::domain_error(message.str());
  }

  /// Σ f(state) × length over the regions of a bar.
  template <class F>
  real integral(std::size_t bar, double t, const F& f) const {
    check_time(t);
    const auto& now = chain(bar, t);
    real sum = 0;
    for (std::size_t i = 0; i + 1 < now.size; ++i)
      sum += f(line(now, i).right) * (line(now, i + 1).place_at(t) - line(now, i).place_at(t));
    return sum;
  }

  template <class F>
  double integral(double t, const F& f) const {
    real sum = 0;
    for (std::size_t bar = 0; bar < materials.size(); ++bar)
      sum += integral(bar, t, [&](const State& s) { return f(materials[bar], s); });
    return plain(sum);
  }
};

/// Follows fronts from event to event. A face k lies between bars k − 1 and k; faces 0 and n are the outer ends.
class BarImpact::Tracker {
 public:
  explicit Tracker(Record& record) : r_(record), p_(record.parameters) {
    const std::size_t bars = p_.bars.size();
    real crossing = never;
    for (const auto& bar : p_.bars) {
      r_.materials.push_back(material(bar));
      crossing = std::min(crossing, r_.materials.back().length / r_.materials.back().speed);
      r_.stress.push_back(0);
      r_.speed.push_back(std::abs(real{bar.velocity}));
    }
    same_time_ = same_time * crossing;
    r_.slowest = r_.fastest = p_.left.fixed || p_.right.fixed ? 0 : real{p_.bars[0].velocity};
    for (const auto& bar : p_.bars) met(State{0, bar.velocity, 0, 0});
    touching_.assign(bars + 1, false);
    current_.resize(bars);
    meetings_.resize(bars);
    r_.chains.resize(bars);
    loads_ = {jumps(p_.left), jumps(p_.right)};
    r_.times.push_back(0);
    for (std::size_t k = 0; k < bars; ++k) {
      const State rest{0, p_.bars[k].velocity, 0, p_.bars[k].yield_stress};
      current_[k] = {add(k, 0, 0, 0, 0, rest, rest, 0), add(k, 0, r_.materials[k].length, 0, 0, rest, rest, 0)};
      store(k);
    }
  }

  void run() {
    for (std::size_t face = 0; face <= p_.bars.size(); ++face) start(face);
    for (;;) {
      real next = never;
      std::size_t bar = 0, face = 0;
      enum { inside, closing, load } what = inside;
      for (std::size_t k = 0; k < p_.bars.size(); ++k)
        if (meetings_[k].time < next) next = meetings_[k].time, bar = k, what = inside;
      for (std::size_t k = 1; k < p_.bars.size(); ++k)
        if (const real t = closing_time(k); t < next) next = t, face = k, what = closing;
      for (const std::size_t k : {std::size_t{0}, p_.bars.size()})
        if (const real t = next_load(k); t < next) next = t, face = k, what = load;
      if (!(next <= real{p_.until})) break;
      now_ = std::max(now_, next);
      if (what == inside) {
        meet(bar, meetings_[bar].line);
      } else if (what == closing) {
        contact(face);
      } else {
        outer(face);
      }
    }
    r_.times.push_back(p_.until);
  }

 private:
  struct Meeting {
    real time = never;
    std::size_t line = 0;  ///< this one and the next in the bar
  };

  const Line& line(std::size_t bar, std::size_t i) const { return r_.lines[current_[bar][i]]; }
  const Line& left_end(std::size_t bar) const { return r_.lines[current_[bar].front()]; }
  const Line& right_end(std::size_t bar) const { return r_.lines[current_[bar].back()]; }

  void met(const State& s) {
    r_.slowest = std::min(r_.slowest, s.velocity);
    r_.fastest = std::max(r_.fastest, s.velocity);
  }

  std::uint32_t add(std::size_t bar, real time, real place, real displacement, real speed, const State& left,
                    const State& right, real travelled) {
    const auto& m = r_.materials[bar];
    for (const State* s : {&left, &right}) {
      r_.stress[bar] = std::max(r_.stress[bar], std::abs(s->stress));
      r_.speed[bar] = std::max(r_.speed[bar], std::abs(s->velocity));
      met(*s);
    }
    r_.lines.push_back(
        {time, place, displacement, speed, right.velocity + speed * strain(m, right), travelled, left, right});
    return static_cast<std::uint32_t>(r_.lines.size() - 1);
  }

  /// Keeps the lines of a bar as they are after the present event.
  void store(std::size_t bar) {
    auto& chains = r_.chains[bar];
    const std::size_t snapshot = r_.times.size() - 1;
    if (!chains.empty() && chains.back().event == snapshot) throw std::logic_error("bar-impact: stored twice");
    chains.push_back({now_, snapshot, r_.links.size(), current_[bar].size()});
    r_.links.insert(r_.links.end(), current_[bar].begin(), current_[bar].end());
    meetings_[bar] = {};
    for (std::size_t i = 0; i + 1 < current_[bar].size(); ++i) {
      const Line &a = line(bar, i), &b = line(bar, i + 1);
      if (!(a.speed > b.speed)) continue;
      const real time = now_ + std::max(real{0}, (b.place_at(now_) - a.place_at(now_)) / (a.speed - b.speed));
      if (time < meetings_[bar].time) meetings_[bar] = {time, i};
    }
  }

  void begin_event(Event::Kind kind, std::size_t bar, real place) {
    if (r_.events.size() == most_events || r_.links.size() > most_links) {
      std::ostringstream message;
      message << r_.events.size() << " events, after which " << current_[bar].size()
              << " lines stand in a bar, led only to t = " << plain(now_) << " of " << p_.until;
      require_impact(false, message.str());
    }
    r_.events.push_back({kind, plain(now_), bar, plain(real{p_.bars[bar].begin} + place)});
    r_.times.push_back(now_);
  }

  // ---- tolerances ----

  real reach(std::size_t bar) const { return same_time_ * r_.materials[bar].speed; }
  real least(std::size_t bar) const {
    return no_strength * (r_.stress[bar] + r_.materials[bar].impedance * r_.speed[bar]);
  }
  /// Round-off of the stress of a contact: of its stresses, and of its velocities by way of both impedances.
  real least(std::size_t left, std::size_t right, const Side& l, const Side& r) const {
    const real z = 1 / (1 / l.material->impedance + 1 / r.material->impedance);
    return no_strength * (std::max(std::abs(l.state.stress), std::abs(r.state.stress)) +
                          z * std::max(r_.speed[left], r_.speed[right]));
  }

  // ---- inside a bar ----

  /// Everything in a bar that is within reach of a place: lines [first, last].
  std::pair<std::size_t, std::size_t> around(std::size_t bar, std::size_t i, real place) const {
    std::size_t first = i, last = i;
    const auto near = [&](std::size_t k) { return std::abs(line(bar, k).place_at(now_) - place) <= reach(bar); };
    while (first > 0 && near(first - 1)) --first;
    while (last + 1 < current_[bar].size() && near(last + 1)) ++last;
    return {first, last};
  }

  /// Length of path that a wave sent in a direction inherits from the lines [first, last].
  real inherited(std::size_t bar, std::size_t first, std::size_t last, int direction) const {
    real same = -1, any = 0;
    for (std::size_t i = first; i <= last; ++i) {
      const Line& l = line(bar, i);
      if (l.speed == 0) continue;
      const real path = l.travelled + std::abs(l.speed) * (now_ - l.time);
      any = std::max(any, path);
      if ((l.speed > 0) == (direction > 0)) same = std::max(same, path);
    }
    return same >= 0 ? same : any;
  }

  void replace(std::size_t bar, std::size_t first, std::size_t last, const std::vector<std::uint32_t>& by) {
    auto& lines = current_[bar];
    const auto at = lines.begin() + static_cast<std::ptrdiff_t>(first);
    const auto gap = lines.erase(at, at + static_cast<std::ptrdiff_t>(last - first + 1));
    lines.insert(gap, by.begin(), by.end());
  }

  void meet(std::size_t bar, std::size_t i) {
    // A line that stands still keeps its place to the bit.
    const std::size_t keeps = line(bar, i + 1).speed == 0 ? i + 1 : i;
    real place = line(bar, keeps).place_at(now_), displacement = line(bar, keeps).displacement_at(now_);
    const auto [first, last] = around(bar, keeps, place);
    if (first == 0) return face(bar, bar);
    if (last + 1 == current_[bar].size()) return face(bar + 1, bar);
    for (std::size_t k = first; k <= last; ++k) {
      if (line(bar, k).speed != 0) continue;
      place = line(bar, k).place;
      displacement = line(bar, k).displacement_at(now_);
    }
    begin_event(Event::Kind::fronts_meet, bar, place);
    const Side l{&r_.materials[bar], line(bar, first).left}, r{&r_.materials[bar], line(bar, last).right};
    const real stress = star_stress(&l, &r), velocity = velocity_at(l, -1, stress);
    const auto to_left = waves(l, -1, stress, velocity, least(bar));
    const auto to_right = waves(r, +1, stress, velocity, least(bar));
    std::vector<std::uint32_t> sent;
    State now = l.state;
    for (const auto& wave : to_left) {
      sent.push_back(
          add(bar, now_, place, displacement, wave.speed, now, wave.behind, inherited(bar, first, last, -1)));
      now = wave.behind;
    }
    const State star = to_right.empty() ? r.state : to_right.back().behind;
    if (std::abs(now.yield - star.yield) > least(bar) ||
        std::abs(now.plastic_strain - star.plastic_strain) * r.material->modulus > least(bar))
      sent.push_back(add(bar, now_, place, displacement, 0, now, star, 0));
    for (std::size_t k = to_right.size(); k-- > 0;)
      sent.push_back(add(bar, now_, place, displacement, to_right[k].speed, to_right[k].behind,
                         k == 0 ? r.state : to_right[k - 1].behind, inherited(bar, first, last, +1)));
    replace(bar, first, last, sent);
    store(bar);
  }

  // ---- ends ----

  std::pair<std::size_t, std::size_t> at_left_end(std::size_t bar) const { return around(bar, 0, 0); }
  std::pair<std::size_t, std::size_t> at_right_end(std::size_t bar) const {
    return around(bar, current_[bar].size() - 1, r_.materials[bar].length);
  }

  Side inside_left_end(std::size_t bar) const { return {&r_.materials[bar], line(bar, at_left_end(bar).second).right}; }
  Side inside_right_end(std::size_t bar) const { return {&r_.materials[bar], line(bar, at_right_end(bar).first).left}; }

  void send_from_left_end(std::size_t bar, real stress, real velocity, real least_jump) {
    const auto [first, last] = at_left_end(bar);
    const Side side = inside_left_end(bar);
    const auto sent = waves(side, +1, stress, velocity, least_jump);
    const real displacement = left_end(bar).displacement_at(now_), path = inherited(bar, first, last, +1);
    const State end = sent.empty() ? side.state : sent.back().behind;
    std::vector<std::uint32_t> lines{add(bar, now_, 0, displacement, 0, end, end, 0)};
    for (std::size_t k = sent.size(); k-- > 0;)
      lines.push_back(add(bar, now_, 0, displacement, sent[k].speed, sent[k].behind,
                          k == 0 ? side.state : sent[k - 1].behind, path));
    replace(bar, first, last, lines);
    store(bar);
  }

  void send_from_right_end(std::size_t bar, real stress, real velocity, real least_jump) {
    const auto [first, last] = at_right_end(bar);
    const Side side = inside_right_end(bar);
    const real length = r_.materials[bar].length, displacement = right_end(bar).displacement_at(now_);
    const real path = inherited(bar, first, last, -1);
    std::vector<std::uint32_t> lines;
    State now = side.state;
    for (const auto& wave : waves(side, -1, stress, velocity, least_jump)) {
      lines.push_back(add(bar, now_, length, displacement, wave.speed, now, wave.behind, path));
      now = wave.behind;
    }
    lines.push_back(add(bar, now_, length, displacement, 0, now, now, 0));
    replace(bar, first, last, lines);
    store(bar);
  }

  void load_left_end(std::size_t bar, real stress) {
    send_from_left_end(bar, stress, velocity_at(inside_left_end(bar), +1, stress), least(bar));
  }
  void load_right_end(std::size_t bar, real stress) {
    send_from_right_end(bar, stress, velocity_at(inside_right_end(bar), -1, stress), least(bar));
  }

  /// A front has reached a face from inside a bar.
  void face(std::size_t face, std::size_t bar) {
    if (face == 0 || face == p_.bars.size()) return outer(face);
    if (touching_[face] || closing_time(face) <= now_ + same_time_) return contact(face);
    begin_event(Event::Kind::front_reflects, bar, bar == face ? 0 : r_.materials[bar].length);
    if (bar == face)
      load_left_end(bar, 0);
    else
      load_right_end(bar, 0);
  }

  // ---- outer ends ----

  bool is_left(std::size_t face) const { return face == 0; }

  real next_load(std::size_t face) const {
    const auto& loads = loads_[is_left(face) ? 0 : 1];
    const std::size_t applied = applied_[is_left(face) ? 0 : 1];
    return applied < loads.size() ? real{loads[applied].time} : never;
  }

  void outer(std::size_t face) {
    const bool left = is_left(face);
    const std::size_t side = left ? 0 : 1, bar = left ? 0 : p_.bars.size() - 1;
    auto kind = Event::Kind::front_reflects;
    while (next_load(face) <= now_ + same_time_) {
      kind = Event::Kind::load_changes;
      traction_[side] += real{loads_[side][applied_[side]++].jump};
    }
    begin_event(kind, bar, left ? 0 : r_.materials[bar].length);
    const Side inner = left ? inside_left_end(bar) : inside_right_end(bar);
    if (!(left ? p_.left : p_.right).fixed) {
      if (left)
        load_left_end(bar, traction_[side]);
      else
        load_right_end(bar, traction_[side]);
    } else if (left) {
      send_from_left_end(bar, star_stress(nullptr, &inner), 0, least(bar));
    } else {
      send_from_right_end(bar, star_stress(&inner, nullptr), 0, least(bar));
    }
  }

  // ---- contacts ----

  /// When an open face closes if nothing else happens.
  real closing_time(std::size_t face) const {
    if (touching_[face]) return never;
    const Line &l = right_end(face - 1), &r = left_end(face);
    const real approach = l.left.velocity - r.right.velocity;
    if (!(approach > 0)) return never;
    const real gap = initial_gap(p_.bars, face - 1) + (r.displacement_at(now_) - l.displacement_at(now_));
    return now_ + std::max(real{0}, gap / approach);
  }

  void contact(std::size_t face) {
    const std::size_t left = face - 1, right = face;
    const Side l = inside_right_end(left), r = inside_left_end(right);
    const real stress = star_stress(&l, &r), least_here = least(left, right, l, r);
    const bool was = touching_[face], holds = p_.bonded || stress <= least_here;
    begin_event(holds ? (was ? Event::Kind::contact_passes_on : Event::Kind::contact_closes)
                      : (was ? Event::Kind::contact_opens : Event::Kind::front_reflects),
                left, r_.materials[left].length);
    if (holds && !was) open_contact_.push_back(touch(face));
    if (!holds && was) part(face);
    touching_[face] = holds;
    if (holds) {
      const real velocity = velocity_at(l, -1, stress);
      send_from_right_end(left, stress, velocity, std::max(least(left), least_here));
      send_from_left_end(right, stress, velocity, std::max(least(right), least_here));
    } else {
      load_right_end(left, 0);
      load_left_end(right, 0);
    }
  }

  std::size_t touch(std::size_t face) {
    r_.contacts.push_back({face - 1, plain(now_), infinity});
    r_.spans.push_back({r_.times.size() - 1, std::numeric_limits<std::size_t>::max()});
    return r_.contacts.size() - 1;
  }

  void part(std::size_t face) {
    const auto at = std::find_if(open_contact_.begin(), open_contact_.end(),
                                 [&](std::size_t k) { return r_.contacts[k].left == face - 1; });
    r_.contacts[*at].to = plain(now_);
    r_.spans[*at].to = r_.times.size() - 1;
    open_contact_.erase(at);
  }

  /// What happens at t = 0: loads, fixed ends of moving bars, and bars that touch and do not part.
  void start(std::size_t face) {
    if (face == 0 || face == p_.bars.size()) {
      const real velocity = face == 0 ? p_.bars.front().velocity : p_.bars.back().velocity;
      const bool held = (face == 0 ? p_.left : p_.right).fixed && velocity != 0;
      if (held || next_load(face) <= same_time_) outer(face);
    } else if (initial_gap(p_.bars, face - 1) == 0 &&
               (p_.bonded || p_.bars[face - 1].velocity >= p_.bars[face].velocity)) {
      contact(face);
    }
  }

  Record& r_;
  const Parameters& p_;
  real now_ = 0, same_time_ = 0;
  std::vector<std::vector<std::uint32_t>> current_;  ///< lines of each bar
  std::vector<Meeting> meetings_;                    ///< the next of each bar
  std::vector<bool> touching_;                       ///< of each face
  std::vector<std::size_t> open_contact_;            ///< that have not ended yet
  std::array<std::vector<Traction::Kink>, 2> loads_;
  std::array<std::size_t, 2> applied_{};
  std::array<real, 2> traction_{};
};

BarImpact::BarImpact(Parameters p) {
  check_impact(p);
  auto record = std::make_shared<Record>();
  record->parameters = std::move(p);
  Tracker(*record).run();
  record_ = std::move(record);
}

const BarImpact::Parameters& BarImpact::parameters() const { return record_->parameters; }
const std::vector<BarImpact::Contact>& BarImpact::contacts() const { return record_->contacts; }
const std::vector<BarImpact::Event>& BarImpact::events() const { return record_->events; }

double BarImpact::at(BarQuantity quantity, double x, double t) const {
  record_->check_time(t);
  const auto [bar, place] = record_->locate(x);
  const Chain& chain = record_->chain(bar, t);
  // the last line at or left of x that has a region to its right
  std::size_t low = 0, high = chain.size - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (record_->line(chain, middle).place_at(t) <= place ? low : high) = middle;
  }
  const Line& line = record_->line(chain, low);
  switch (quantity) {
    case BarQuantity::stress: return plain(line.right.stress);
    case BarQuantity::velocity: return plain(line.right.velocity);
    case BarQuantity::displacement:
      return plain(line.displacement_at(t) + strain(record_->materials[bar], line.right) * (place - line.place_at(t)));
  }
  throw std::invalid_argument("bar-impact: no such quantity");
}

std::vector<Front> BarImpact::fronts(double t) const {
  record_->check_time(t);
  std::vector<Front> fronts;
  for (std::size_t bar = 0; bar < record_->materials.size(); ++bar) {
    const Chain& chain = record_->chain(bar, t);
    for (std::size_t i = 0; i < chain.size; ++i) {
      const Line& line = record_->line(chain, i);
      const real place = line.place_at(t);
      if (line.speed == 0 || !(place > 0 && place < record_->materials[bar].length)) continue;
      const int direction = line.speed > 0 ? +1 : -1;
      fronts.push_back({plain(real{parameters().bars[bar].begin} + place), direction,
                        plain(direction * (line.left.stress - line.right.stress)),
                        plain(line.travelled + std::abs(line.speed) * (real{t} - line.time))});
    }
  }
  return fronts;
}

double BarImpact::scale(BarQuantity quantity) const {
  const auto& r = *record_;
  const real difference = r.fastest - r.slowest;
  real stress = *std::max_element(r.stress.begin(), r.stress.end());
  if (!(stress > 0))
    for (const auto& m : r.materials) stress = std::max(stress, m.impedance * difference);
  if (!(stress > 0)) stress = 1;
  real displacement = 0;
  for (const auto& m : r.materials) displacement += stress * m.length / m.modulus;
  switch (quantity) {
    case BarQuantity::stress: return plain(stress);
    case BarQuantity::velocity: return plain(difference > 0 ? difference : stress / r.materials[0].impedance);
    case BarQuantity::displacement: return plain(displacement);
  }
  throw std::invalid_argument("bar-impact: no such quantity");
}

double BarImpact::wave_speed(std::size_t bar) const { return plain(record_->materials.at(bar).speed); }

double BarImpact::position(double x, double t) const { return x + at(BarQuantity::displacement, x, t); }

double BarImpact::momentum(double t) const {
  return record_->integral(t, [](const Material& m, const State& s) { return m.density * s.velocity; });
}

double BarImpact::momentum(std::size_t bar, double t) const {
  const Material& m = record_->materials.at(bar);
  return plain(record_->integral(bar, t, [&](const State& s) { return m.density * s.velocity; }));
}

double BarImpact::kinetic_energy(double t) const {
  return record_->integral(t,
                           [](const Material& m, const State& s) { return m.density * s.velocity * s.velocity / 2; });
}

double BarImpact::strain_energy(double t) const {
  return record_->integral(t, [](const Material& m, const State& s) { return s.stress * s.stress / (2 * m.modulus); });
}

double BarImpact::plastic_work(double t) const {
  return record_->integral(t, [](const Material& m, const State& s) { return plastic_work_density(m, s.yield); });
}

double BarImpact::plastic_strain(std::size_t bar, double t) const {
  record_->materials.at(bar);
  return plain(record_->integral(bar, t, [](const State& s) { return std::abs(s.plastic_strain); }));
}

double BarImpact::external_work(double t) const {
  record_->check_time(t);
  const auto& bars = parameters().bars;
  real work = 0;
  for (const bool left : {true, false}) {
    const std::size_t bar = left ? 0 : bars.size() - 1;
    const auto displacement = [&](real time) {
      const Chain& chain = record_->chain(bar, time);
      return record_->line(chain, left ? 0 : chain.size - 1).displacement_at(time);
    };
    for (const auto& kink : jumps(left ? parameters().left : parameters().right))
      if (kink.time < t) work += (left ? -1 : 1) * real{kink.jump} * (displacement(t) - displacement(kink.time));
  }
  return plain(work);
}

std::size_t BarImpact::snapshots() const { return record_->events.size() + 1; }

BarImpact::Snapshot BarImpact::snapshot(std::size_t k) const {
  if (k >= snapshots()) throw std::out_of_range("bar-impact: no snapshot " + std::to_string(k));
  const real t = record_->times[k];
  Snapshot snapshot{plain(t), plain(record_->times[k + 1]), {}, std::vector<bool>(parameters().bars.size() - 1)};
  for (std::size_t i = 0; i < record_->spans.size(); ++i)
    if (k >= record_->spans[i].from && k < record_->spans[i].to) snapshot.touching[contacts()[i].left] = true;
  for (std::size_t bar = 0; bar < parameters().bars.size(); ++bar) {
    const Chain& chain = record_->chain_of_snapshot(bar, k);
    std::vector<Region> regions;
    for (std::size_t i = 0; i + 1 < chain.size; ++i) {
      const Line &a = record_->line(chain, i), &b = record_->line(chain, i + 1);
      regions.push_back({plain(a.place_at(t)), plain(b.place_at(t)), plain(a.speed), plain(b.speed),
                         plain(a.right.stress), plain(a.right.velocity), plain(a.right.plastic_strain),
                         plain(a.right.yield), plain(a.displacement_at(t))});
    }
    snapshot.bars.push_back(std::move(regions));
  }
  return snapshot;
}

// ---- audit ----

namespace {

using Region = BarImpact::Region;
using Snapshot = BarImpact::Snapshot;

/// Keeps the larger violation, as a share of its scale. NaN wins and stays; where everything is zero, so must it be.
void note_violation(double& worst, double violation, double scale) {
  violation = std::abs(violation);
  const double share = violation == 0 ? 0 : violation / scale;
  if (!std::isnan(worst) && !(share <= worst)) worst = share;
}

struct BarScale {
  double stress = 0, velocity = 0, momentum = 0, energy = 0, displacement = 0;
};

class Audit {
 public:
  Audit(const BarImpact::Parameters& p, std::size_t count, const std::function<Snapshot(std::size_t)>& snapshot)
      : p_(p), count_(count), snapshot_(snapshot) {
    for (const auto& bar : p_.bars) materials_.push_back(material(bar));
    scales_.resize(p_.bars.size());
    crossing_ = infinity;
    for (const auto& m : materials_) crossing_ = std::min(crossing_, plain(m.length / m.speed));
  }

  Balance run() {
    measure();
    gained_.assign(p_.bars.size(), {});
    std::optional<Snapshot> before;
    for (std::size_t k = 0; k < count_; ++k) {
      Snapshot now = snapshot_(k);
      for (std::size_t bar = 0; bar < p_.bars.size(); ++bar) {
        bar_is_full(bar, now);
        fronts(bar, now.bars[bar]);
        if (before)
          nothing_changed(bar, later(before->bars[bar], before->until - before->time), now.bars[bar]);
        else
          nothing_changed(bar, {at_rest(bar)}, now.bars[bar]);
        balances(bar, now);
        motion(bar, before, now);
      }
      if (now.until > now.time) {  // or the other events of this time are still to come
        contacts(now);
        outer_ends(now);
      }
      before = std::move(now);
    }
    return b_;
  }

 private:
  struct Gained {
    real momentum = 0, energy = 0;
  };

  Region at_rest(std::size_t bar) const {
    const auto& b = p_.bars[bar];
    return {0, b.length, 0, 0, 0, b.velocity, 0, b.yield_stress, 0};
  }

  double strain_of(std::size_t bar, const Region& r) const {
    return r.stress / p_.bars[bar].youngs_modulus + r.plastic_strain;
  }

  static std::vector<Region> later(std::vector<Region> regions, double time) {
    for (auto& r : regions) {
      r.begin += r.begin_speed * time;
      r.end += r.end_speed * time;
    }
    return regions;
  }

  Gained sums(std::size_t bar, const std::vector<Region>& regions) const {
    const Material& m = materials_[bar];
    Gained sum;
    for (const auto& r : regions) {
      const real width = real{r.end} - real{r.begin}, v = r.velocity, s = r.stress;
      sum.momentum += m.density * v * width;
      sum.energy += (m.density * v * v / 2 + s * s / (2 * m.modulus) + plastic_work_density(m, r.yield_stress)) * width;
    }
    return sum;
  }

  /// The sizes of terms over the whole history. Velocities count as differences: a frame has no effect on waves.
  void measure() {
    std::vector<double> low(p_.bars.size(), infinity), high(p_.bars.size(), -infinity);
    for (std::size_t k = 0; k < count_; ++k) {
      const Snapshot now = snapshot_(k);
      for (std::size_t bar = 0; bar < p_.bars.size(); ++bar) {
        auto& scale = scales_[bar];
        for (const auto& r : now.bars[bar]) {
          ++b_.states;
          scale.stress = std::max(scale.stress, std::abs(r.stress));
          scale.displacement = std::max(scale.displacement, std::abs(r.displacement));
          low[bar] = std::min(low[bar], r.velocity);
          high[bar] = std::max(high[bar], r.velocity);
        }
        for (const double time : {0.0, now.until - now.time}) {
          const Gained sum = sums(bar, later(now.bars[bar], time));
          scale.momentum = std::max(scale.momentum, std::abs(plain(sum.momentum)));
          scale.energy = std::max(scale.energy, std::abs(plain(sum.energy)));
        }
      }
    }
    for (std::size_t bar = 0; bar < p_.bars.size(); ++bar) {
      auto& scale = scales_[bar];
      const double z = plain(materials_[bar].impedance), length = p_.bars[bar].length;
      scale.velocity = std::max(high[bar] - low[bar], scale.stress / z);
      scale.stress = std::max(scale.stress, z * scale.velocity);
      scale.momentum = std::max(scale.momentum, scale.stress * length / plain(materials_[bar].speed));
      scale.displacement = std::max(scale.displacement, scale.stress * length / p_.bars[bar].youngs_modulus);
    }
  }

  void bar_is_full(std::size_t bar, const Snapshot& now) {
    const auto& regions = now.bars[bar];
    const Material& m = materials_[bar];
    const double length = p_.bars[bar].length, speed = plain(m.speed), stress = scales_[bar].stress;
    if (regions.empty()) return note_violation(b_.state, 1, 1);
    note_violation(b_.state, regions.front().begin, length);
    note_violation(b_.state, regions.front().begin_speed, speed);
    note_violation(b_.state, regions.back().end - length, length);
    note_violation(b_.state, regions.back().end_speed, speed);
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const Region& r = regions[i];
      const double width = r.end - r.begin;
      note_violation(b_.state, std::min(0.0, width), length);
      note_violation(b_.state, std::min(0.0, width + (r.end_speed - r.begin_speed) * (now.until - now.time)), length);
      if (i > 0) {
        note_violation(b_.state, r.begin - regions[i - 1].end, length);
        note_violation(b_.state, r.begin_speed - regions[i - 1].end_speed, speed);
      }
      if (!std::isfinite(p_.bars[bar].yield_stress)) {
        note_violation(b_.state, r.plastic_strain * p_.bars[bar].youngs_modulus, stress);
        note_violation(b_.state, r.stress - r.stress, 1);
        continue;
      }
      const double hardened = (r.yield_stress - p_.bars[bar].yield_stress) * plain(m.plastic_compliance);
      const auto excess = [](double x) { return x < 0 ? 0.0 : x; };  // lets NaN through
      note_violation(b_.state, excess(std::abs(r.stress) - r.yield_stress), stress);
      note_violation(b_.state, excess(-hardened) * p_.bars[bar].youngs_modulus, stress);
      note_violation(b_.state, excess(std::abs(r.plastic_strain) - hardened) * p_.bars[bar].youngs_modulus, stress);
    }
  }

  void fronts(std::size_t bar, const std::vector<Region>& regions) {
    const Material& m = materials_[bar];
    const double density = p_.bars[bar].density, modulus = p_.bars[bar].youngs_modulus;
    const double stress = scales_[bar].stress, velocity = scales_[bar].velocity;
    const double c = plain(m.speed), c_p = plain(m.plastic_speed);
    for (std::size_t i = 1; i < regions.size(); ++i) {
      ++b_.fronts;
      const Region &l = regions[i - 1], &r = regions[i];
      const double speed = l.end_speed;
      note_violation(b_.jump, (r.stress - l.stress) + density * speed * (r.velocity - l.velocity), stress);
      note_violation(b_.jump, (r.velocity - l.velocity) + speed * (strain_of(bar, r) - strain_of(bar, l)), velocity);
      const Region &behind = speed > 0 ? l : r, &ahead = speed > 0 ? r : l;
      const bool flows = c_p > 0 && std::abs(std::abs(speed) - c_p) < std::abs(std::abs(speed) - c) && speed != 0;
      if (speed != 0) note_violation(b_.jump, std::abs(speed) - (flows ? c_p : c), c);
      if (flows) {  // from yield to beyond it, on one side of zero
        note_violation(b_.jump, std::abs(behind.stress) - behind.yield_stress, stress);
        note_violation(b_.jump, ahead.stress - std::copysign(ahead.yield_stress, behind.stress), stress);
        note_violation(b_.jump, std::min(0.0, behind.yield_stress - ahead.yield_stress), stress);
      } else if (speed != 0) {
        if (c_p > 0) note_violation(b_.jump, behind.yield_stress - ahead.yield_stress, stress);
        note_violation(b_.jump, (behind.plastic_strain - ahead.plastic_strain) * modulus, stress);
      }
    }
  }

  /// ∫ |after − before| dx. Both fill the bar.
  void nothing_changed(std::size_t bar, const std::vector<Region>& before, const std::vector<Region>& after) {
    const double length = p_.bars[bar].length, modulus = p_.bars[bar].youngs_modulus;
    const auto& scale = scales_[bar];
    double stress = 0, velocity = 0, strain = 0, yield = 0, from = 0;
    for (std::size_t i = 0, j = 0; i < before.size() && j < after.size();) {
      const Region &a = before[i], &b = after[j];
      const double to = std::min(a.end, b.end), width = std::max(0.0, to - from);
      stress += std::abs(b.stress - a.stress) * width;
      velocity += std::abs(b.velocity - a.velocity) * width;
      strain += std::abs(b.plastic_strain - a.plastic_strain) * width;
      if (a.yield_stress != b.yield_stress) yield += std::abs(b.yield_stress - a.yield_stress) * width;
      from = std::max(from, to);
      if (std::isnan(a.end) || std::isnan(b.end)) {
        stress = std::numeric_limits<double>::quiet_NaN();
        break;
      }
      if (a.end <= b.end) ++i;
      if (b.end <= a.end) ++j;
    }
    note_violation(b_.continuity, stress, scale.stress * length);
    note_violation(b_.continuity, velocity, scale.velocity * length);
    note_violation(b_.continuity, strain * modulus, scale.stress * length);
    note_violation(b_.continuity, yield, scale.stress * length);
  }

  void balances(std::size_t bar, const Snapshot& now) {
    const auto& regions = now.bars[bar];
    if (regions.empty()) return;
    const Material& m = materials_[bar];
    const real v = p_.bars[bar].velocity, mass = m.density * m.length;
    const auto compare = [&](const Gained& sum) {
      note_violation(b_.momentum, plain(sum.momentum - mass * v - gained_[bar].momentum), scales_[bar].momentum);
      note_violation(b_.energy, plain(sum.energy - mass * v * v / 2 - gained_[bar].energy), scales_[bar].energy);
    };
    compare(sums(bar, regions));
    const real time = real{now.until} - real{now.time};
    const Region &l = regions.front(), &r = regions.back();
    gained_[bar].momentum += (real{r.stress} - real{l.stress}) * time;
    gained_[bar].energy += (real{r.stress} * real{r.velocity} - real{l.stress} * real{l.velocity}) * time;
    compare(sums(bar, later(regions, now.until - now.time)));
  }

  double right_end_displacement(std::size_t bar, const std::vector<Region>& regions) const {
    const Region& r = regions.back();
    return r.displacement + strain_of(bar, r) * (r.end - r.begin);
  }

  void motion(std::size_t bar, const std::optional<Snapshot>& before, const Snapshot& now) {
    const auto& regions = now.bars[bar];
    if (regions.empty()) return;
    const double size = scales_[bar].displacement;
    for (std::size_t i = 1; i < regions.size(); ++i) {
      const Region& r = regions[i - 1];
      note_violation(b_.motion, r.displacement + strain_of(bar, r) * (r.end - r.begin) - regions[i].displacement, size);
    }
    if (!before) {
      note_violation(b_.motion, regions.front().displacement, size);
      note_violation(b_.motion, right_end_displacement(bar, regions), size);
    } else if (!before->bars[bar].empty()) {
      const auto& old = before->bars[bar];
      const double time = before->until - before->time;
      note_violation(b_.motion, old.front().displacement + old.front().velocity * time - regions.front().displacement,
                     size);
      note_violation(
          b_.motion,
          right_end_displacement(bar, old) + old.back().velocity * time - right_end_displacement(bar, regions), size);
    }
  }

  void contacts(const Snapshot& now) {
    for (std::size_t k = 0; k + 1 < p_.bars.size(); ++k) {
      if (now.bars[k].empty() || now.bars[k + 1].empty()) continue;
      const Region &l = now.bars[k].back(), &r = now.bars[k + 1].front();
      // round-off of the stress between them comes by way of both impedances: the smaller scale is the fair one
      const double stress = std::min(scales_[k].stress, scales_[k + 1].stress);
      const double velocity = std::max(scales_[k].velocity, scales_[k + 1].velocity);
      const double start = plain(initial_gap(p_.bars, k));
      const double size = std::max({scales_[k].displacement, scales_[k + 1].displacement, start});
      const double gap = start + (r.displacement - right_end_displacement(k, now.bars[k]));
      const double gap_later = gap + (r.velocity - l.velocity) * (now.until - now.time);
      if (now.touching[k]) {
        note_violation(b_.contact, l.stress - r.stress, stress);
        note_violation(b_.contact, l.velocity - r.velocity, velocity);
        if (!p_.bonded) note_violation(b_.contact, l.stress <= 0 ? 0 : l.stress, stress);
        note_violation(b_.contact, gap, size);
      } else {
        note_violation(b_.contact, l.stress, stress);
        note_violation(b_.contact, r.stress, stress);
        note_violation(b_.contact, gap >= 0 ? 0 : gap, size);
        note_violation(b_.contact, gap_later >= 0 ? 0 : gap_later, size);
      }
    }
  }

  void outer_ends(const Snapshot& now) {
    for (const bool left : {true, false}) {
      const BarEnd& end = left ? p_.left : p_.right;
      const std::size_t bar = left ? 0 : p_.bars.size() - 1;
      if (now.bars[bar].empty()) continue;
      const Region& r = left ? now.bars[bar].front() : now.bars[bar].back();
      if (end.fixed) {
        note_violation(b_.boundary, r.velocity, scales_[bar].velocity);
        // Loads that change at the time of an event belong to it: between two such there is no load to compare with.
      } else if (now.until - now.time > plain(2 * same_time) * crossing_) {
        const double load = end.traction.value(now.time + (now.until - now.time) / 2);
        note_violation(b_.boundary, r.stress - load, std::max(scales_[bar].stress, std::abs(load)));
      }
    }
  }

  const BarImpact::Parameters& p_;
  std::size_t count_;
  const std::function<Snapshot(std::size_t)>& snapshot_;
  std::vector<Material> materials_;
  std::vector<BarScale> scales_;
  std::vector<Gained> gained_;
  double crossing_ = 0;
  Balance b_;
};

}  // namespace

double Balance::worst() const {
  if (states == 0) return infinity;
  double worst = 0;
  for (const double violation : {jump, state, continuity, momentum, energy, motion, contact, boundary})
    note_violation(worst, violation, 1);
  return worst;
}

Balance audit(const BarImpact::Parameters& p, std::size_t count,
              const std::function<BarImpact::Snapshot(std::size_t)>& snapshot) {
  return Audit(p, count, snapshot).run();
}

Balance audit(const BarImpact& bars) {
  return audit(bars.parameters(), bars.snapshots(), [&](std::size_t k) { return bars.snapshot(k); });
}

double BarImpact::residual(double) const { return audit(*this).worst(); }

}  // namespace diptych::analytic
