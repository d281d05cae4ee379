#include "reports/files.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "reports/json.hpp"
#include "reports/text.hpp"

namespace diptych::reports {
namespace {

namespace fs = std::filesystem;

// ---- writing

[[noreturn]] void fail(const fs::path& path, const char* what, int error) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(error)));
}

void write_all(int descriptor, const std::string& content, const fs::path& path) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = ::write(descriptor, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path, "write", errno);
    done += static_cast<std::size_t>(written);
  }
}

/// A file beside its target that vanishes unless it is kept.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target) {
    // Not mkstemp: that would ignore the umask. O_EXCL keeps two writers apart.
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
      path_ = (target.parent_path() / fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), attempt))
                  .string();
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && (errno != EEXIST || attempt == 1000)) fail(target_, "create a file beside it", errno);
    }
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  int descriptor() const { return descriptor_; }

  void keep() {
    if (::fsync(descriptor_) != 0) fail(target_, "flush to disk", errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(target_, "close", errno);
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, "rename into place", errno);
    path_.clear();
    // Its new name is on the disk once its folder is; some file systems know of no such thing.
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    const int place = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (place >= 0) {
      ::fsync(place);
      ::close(place);
    }
  }

 private:
  fs::path target_;
  std::string path_;
  int descriptor_ = -1;
};

/// A device or a pipe (/dev/stdout) cannot be replaced by a file; it is written to as it is.
void write_through(const fs::path& path, const std::string& content) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, "open", errno);
  try {
    write_all(descriptor, content, path);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  if (::close(descriptor) != 0) fail(path, "close", errno);
}

// ---- JSON

Json json_of(const Sample& sample, bool& finite) {
  Json out = Json::object();
  Numbers numbers(out);
  numbers.put("asked", sample.asked);
  numbers.put("time", sample.time);
  out["errors"] = Json::array();
  for (const FieldError& error : sample.errors) {
    Json item{{"field", error.field}};
    Numbers values(item);
    values.put("time", error.time);
    values.put("scale", error.scale);
    values.put("l1", error.l1);
    values.put("l2", error.l2);
    values.put("linf", error.linf);
    values.put("predicted_l1", error.predicted_l1);
    values.put("predicted_l2", error.predicted_l2);
    values.put("predicted_linf", error.predicted_linf);
    numbers.also(values.finish());
    out["errors"].push_back(std::move(item));
  }
  out["probes"] = Json::array();
  for (const ProbeValue& probe : sample.probes) {
    Json item{{"id", probe.id}};
    Numbers values(item);
    values.put("value", probe.value);
    values.put("predicted", probe.predicted);
    numbers.also(values.finish());
    out["probes"].push_back(std::move(item));
  }
  finite = numbers.finish();
  return out;
}

Json json_of(const Run& run) {
  Json out{
      {"type", "run"},          {"case", run.case_id},        {"label", run.label()},         {"method", run.method},
      {"cells", run.cells},     {"particles", run.particles}, {"parameters", run.parameters}, {"status", run.status},
      {"message", run.message}, {"invalid", run.invalid}};
  Numbers numbers(out);
  numbers.also(run.finite);
  numbers.put("courant_asked", run.courant_asked);
  numbers.put("courant", run.courant);
  numbers.put("cell_size", run.cell_size);
  numbers.put("time_step", run.time_step);
  numbers.put("time_step_limit", run.time_step_limit);
  out["unknowns"] = run.unknowns;
  out["steps"] = run.steps;
  out["element_steps"] = run.element_steps;
  out["particle_steps"] = run.particle_steps;
  out["node_steps"] = run.node_steps;
  out["bytes"] = run.bytes;
  numbers.put("wall_seconds", run.wall_seconds);
  out["features"] = run.features;
  Json measures = Json::object();
  for (const auto& [name, value] : run.measures) numbers.put_into(measures, name, value);
  out["measures"] = std::move(measures);
  Json samples = Json::array();
  for (const Sample& sample : run.samples) {
    bool finite = true;
    samples.push_back(json_of(sample, finite));
    numbers.also(finite);
  }
  out["samples"] = std::move(samples);
  numbers.finish();
  return out;
}

Json json_of(const Gate& gate) {
  Json out{{"type", "gate"},
           {"case", gate.case_id},
           {"id", gate.id},
           {"kind", gate.kind},
           {"quantity", gate.quantity},
           {"formula", gate.formula},
           {"reason", gate.reason},
           {"verdict", to_string(gate.verdict)},
           {"message", gate.message},
           {"line", gate.line}};
  Numbers numbers(out);
  numbers.put("headroom", gate.headroom());
  Json checks = Json::array();
  for (const Check& check : gate.checks) {
    Json item{{"what", check.what}};
    Numbers values(item);
    values.put("value", check.value);
    values.put("predicted", check.predicted);
    values.put("low", check.low);
    values.put("high", check.high);
    values.put("judged", check.judged);
    item["passed"] = check.passed;
    numbers.also(values.finish());
    checks.push_back(std::move(item));
  }
  out["checks"] = std::move(checks);
  numbers.finish();
  return out;
}

// ---- JUnit

std::string plain(double value) { return std::isnan(value) ? "nan" : fmt::format("{}", value); }

std::string details(const Gate& gate) {
  std::string out = fmt::format("{}\nquantity: {}\nformula: {}\nreason: {}\n", gate.message, gate.quantity,
                                gate.formula, gate.reason);
  for (const Check& check : gate.checks) {
    out += fmt::format("{} {}: value {}", check.passed ? "ok  " : "FAIL", check.what, plain(check.value));
    if (check.predicted) out += ", predicted " + plain(*check.predicted);
    out += fmt::format(", judged {} in [{}, {}]\n", plain(check.judged), plain(check.low), plain(check.high));
  }
  if (gate.checks.empty()) out += "no checks\n";
  return out;
}

}  // namespace

void write_file(const fs::path& path, const std::string& content) {
  if (!path.has_filename()) throw std::runtime_error(path.string() + ": cannot write: not a file name");
  if (path.has_parent_path()) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) fail(path, "create its folder", error.value());
  }
  struct stat found {};
  const bool exists = ::stat(path.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) fail(path, "write", EISDIR);
  if (exists && !S_ISREG(found.st_mode)) return write_through(path, content);
  const fs::path target = exists ? fs::canonical(path) : path;  // a link stays a link
  Temporary file(target);
  write_all(file.descriptor(), content, path);
  if (exists && ::fchmod(file.descriptor(), found.st_mode & 07777U) != 0) fail(path, "set permissions", errno);
  file.keep();
}

std::string results_jsonl(const std::vector<Case>& cases, const Provenance& made_by) {
  const Json env = env_of(made_by);
  std::string out;
  const auto add = [&](Json line) {
    line["env"] = env;
    out += json_line(line);
  };
  for (const Case& data : cases) {
    for (const Run& run : data.runs) add(json_of(run));
    for (const Gate& gate : data.gates) add(json_of(gate));
  }
  return out;
}

std::string junit_xml(const std::vector<Case>& cases) {
  pugi::xml_document document;
  pugi::xml_node head = document.append_child(pugi::node_declaration);
  head.append_attribute("version") = "1.0";
  head.append_attribute("encoding") = "UTF-8";
  pugi::xml_node root = document.append_child("testsuites");
  root.append_attribute("name") = "diptych";
  pugi::xml_attribute all_tests = root.append_attribute("tests"), all_failures = root.append_attribute("failures"),
                      all_errors = root.append_attribute("errors");
  int tests = 0, failures = 0, errors = 0;
  for (const Case& data : cases) {
    pugi::xml_node suite = root.append_child("testsuite");
    suite.append_attribute("name") = printable(data.id).c_str();
    int failed = 0, broken = 0;
    pugi::xml_attribute suite_tests = suite.append_attribute("tests"),
                        suite_failures = suite.append_attribute("failures"),
                        suite_errors = suite.append_attribute("errors");
    for (const Gate& gate : data.gates) {
      pugi::xml_node test = suite.append_child("testcase");
      test.append_attribute("name") = printable(gate.id).c_str();
      test.append_attribute("classname") = printable(gate.case_id).c_str();
      if (!data.path.empty()) test.append_attribute("file") = printable(data.path).c_str();
      if (gate.line > 0) test.append_attribute("line") = gate.line;
      if (gate.verdict == Verdict::pass) continue;
      const bool failure = gate.verdict == Verdict::fail;
      ++(failure ? failed : broken);
      pugi::xml_node why = test.append_child(failure ? "failure" : "error");
      why.append_attribute("message") = printable(gate.message).c_str();
      why.append_attribute("type") = to_string(gate.verdict).c_str();
      why.append_child(pugi::node_pcdata).set_value(printable(details(gate)).c_str());
    }
    suite_tests = static_cast<int>(data.gates.size());
    suite_failures = failed;
    suite_errors = broken;
    tests += static_cast<int>(data.gates.size());
    failures += failed;
    errors += broken;
  }
  all_tests = tests;
  all_failures = failures;
  all_errors = errors;
  std::ostringstream out;
  document.save(out, "  ");
  return out.str();
}

}  // namespace diptych::reports
