// Tables of case files that many scenes of the tests share, as TOML text. A scene is their sum with what it has of its
// own; text.hpp changes a key of it.
#pragma once

#include <string>
#include <vector>

namespace diptych::tests {

/// What a case file begins with.
inline std::string head(const std::string& id, const std::string& claim, const std::string& units = "SI") {
  return "schema = 1\nid = \"" + id + "\"\ntitle = \"t\"\nclaim = \"" + claim + "\"\nwhy = \"w\"\nunits = \"" + units +
         "\"\n";
}

/// The paper's bar: L = 1, E = 1e4, ρ = 1, fixed on the left.
inline const std::string paper_bar = R"toml([bar]
length = 1.0
[material]
model = "elastic"
E = 1e4
rho = 1.0
[supports]
left = "fixed"
right = "free"
)toml";
/// The same, pulled at its right end: its load, its features and what is exactly known of it.
inline const std::string pulled_bar = paper_bar + R"toml([[load]]
at = "right"
history = "step"
traction = 1.0
[model]
features = ["elastic"]
[exact]
solution = "bar-wave"
)toml";

inline std::string plate(const std::string& width, const std::string& height) {
  return "[plate]\nwidth = " + width + "\nheight = " + height + '\n';
}

/// A plate of one row of cells.
inline std::string strip(const std::string& width) { return "[plate]\nwidth = " + width + "\nrows = 1\n"; }

inline std::string elastic(const std::string& E, const std::string& nu, const std::string& rho,
                           const std::string& plane = "strain") {
  return "[material]\nmodel = \"elastic\"\nE = " + E + "\nnu = " + nu + "\nrho = " + rho + "\nplane = \"" + plane +
         "\"\n";
}

/// The glass of the paper's failure wave.
inline std::string glass() { return elastic("72.8e9", "0.222", "2563"); }

/// A rock that cracks in tension.
inline const std::string rock = R"toml([material]
model = "tensile-damage"
E = 50e9
nu = 0.3
rho = 2500
plane = "strain"
K_IC = 1e6
k = 5e22
m = 7
)toml";

/// ... at a strain rate that is given.
inline const std::string reference_damage = R"toml([damage]
critical_strain = 0.002
rate = "reference"
reference_rate = 100
)toml";

inline std::string supports(const std::string& left, const std::string& right, const std::string& bottom,
                            const std::string& top) {
  return "[supports]\nleft = \"" + left + "\"\nright = \"" + right + "\"\nbottom = \"" + bottom + "\"\ntop = \"" + top +
         "\"\n";
}

/// What a flyer strikes moves along x only.
inline std::string guided() { return supports("free", "free", "roller", "roller"); }

/// Lists as TOML writes them: axes({"fem"}, "10, 20", "0.5").
inline std::string axes(const std::vector<std::string>& methods, const std::string& cells, const std::string& courant) {
  std::string names;
  for (const std::string& method : methods) names += (names.empty() ? "\"" : ", \"") + method + '"';
  return "[axes]\nmethod = [" + names + "]\ncells = [" + cells + "]\ncourant = [" + courant + "]\n";
}

/// Sample times as TOML writes a list, in L/c.
inline std::string sampled(const std::string& times) {
  return "[sample]\ntimes = { unit = \"L/c\", at = [" + times + "] }\n";
}

/// `rest`: the lines of the kind, each with its end. The reason is none.
inline std::string gate(const std::string& id, const std::string& kind, const std::string& quantity,
                        const std::string& rest) {
  return "[[gate]]\nid = \"" + id + "\"\nkind = \"" + kind + "\"\nquantity = \"" + quantity + "\"\n" + rest +
         "reason = \"r\"\n";
}

}  // namespace diptych::tests
