// One way to write JSON: its numbers, what made it, a line. For reports/ alone.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reports/results.hpp"

namespace diptych::reports {

using Json = nlohmann::ordered_json;

/// Writes numbers of one object and remembers whether all of them were finite. JSON has no NaN, and the library
/// would write null without a word.
class Numbers {
 public:
  explicit Numbers(Json& object) : object_(object) {}
  void put(const std::string& key, double value) { put_into(object_, key, value); }
  void put(const std::string& key, const std::optional<double>& value) {
    if (value) put(key, *value);
  }
  void put_into(Json& place, const std::string& key, double value) {
    if (std::isfinite(value)) {
      place[key] = value;
    } else {
      place[key] = nullptr;
      finite_ = false;
    }
  }
  void also(bool finite) { finite_ = finite_ && finite; }
  bool finish() {
    object_["finite"] = finite_;
    return finite_;
  }

 private:
  Json& object_;
  bool finite_ = true;
};

inline Json env_of(const Provenance& made_by) {
  return {{"version", made_by.version},   {"commit", made_by.commit}, {"dirty", made_by.dirty},
          {"compiler", made_by.compiler}, {"flags", made_by.flags},   {"libraries", made_by.libraries},
          {"cpu", made_by.cpu},           {"os", made_by.os}};
}

/// Text from outside (a path, a compiler's message) need not be UTF-8: it is replaced rather than the line lost.
inline std::string json_line(const Json& object) {
  return object.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace diptych::reports
