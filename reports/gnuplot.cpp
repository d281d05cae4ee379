#include "reports/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "reports/files.hpp"
#include "reports/text.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <gnuplot-iostream.h>
#pragma GCC diagnostic pop

extern char** environ;

namespace diptych::reports {
namespace {

namespace fs = std::filesystem;

std::string end_mark(const std::string& id) { return "# end of " + id + "\n"; }

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A name beside the final files that is removed on the way out.
struct Scratch {
  explicit Scratch(fs::path where) : path(std::move(where)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  fs::path path;
};

/// The script that `write` sends.
std::string script_of(const std::string& id, const fs::path& directory,
                      const std::function<void(std::ostream&)>& write) {
  // gnuplot-iostream writes only to a file of its own and reports no failure: read back what arrived.
  const Scratch file(directory / fmt::format(".{}.gp.{}.tmp", id, ::getpid()));
  bool good = false;
  errno = 0;
  try {
    Gnuplot gp(fmt::format(">{}", file.path.string()));
    write(gp);
    gp << end_mark(id) << std::flush;
    good = gp.good();
  } catch (const std::ios_base::failure&) {
    good = false;
  }
  const int error = errno;
  std::string script = contents(file.path);
  if (!good || !script.ends_with(end_mark(id)))
    throw std::runtime_error((directory / (id + ".gp")).string() +
                             ": cannot write: " + (error != 0 ? std::strerror(error) : "it came out incomplete"));
  return script;
}

struct Outcome {
  bool found = true;
  int status = 0;  ///< as from waitpid
  std::string words;
};

/// Runs gnuplot in `directory`, without a shell; its output and complaints are collected.
Outcome run_gnuplot(const fs::path& directory, const std::string& script, const std::string& output) {
  Outcome outcome;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));

  // Names hold no quotes: draw() has checked the id. -d: no start-up file of the user's may change the picture.
  std::array<std::string, 5> words{"gnuplot", "-d", "-e", "output_file='" + output + "'", script};
  std::array<char*, words.size() + 1> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  pid_t child = 0;
  // Its own locale would speak: of a degree sign that it has not, and of a decimal comma.
  std::vector<std::string> settings{"LC_ALL=C.UTF-8"};
  for (char** setting = environ; *setting != nullptr; ++setting)
    if (!std::string_view(*setting).starts_with("LC_ALL=")) settings.emplace_back(*setting);
  std::vector<char*> environment;
  for (std::string& setting : settings) environment.push_back(setting.data());
  environment.push_back(nullptr);
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    outcome.found = false;
    outcome.words = std::string("gnuplot: ") + std::strerror(error);
    return outcome;
  }
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = ::read(ends[0], buffer.data(), buffer.size())) != 0;) {
    if (got > 0) outcome.words.append(buffer.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) break;
  }
  ::close(ends[0]);
  while (::waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  return outcome;
}

/// What is wrong with the run or its picture; empty if nothing.
std::string complaint(const Outcome& outcome, const fs::path& svg) {
  std::string wrong;
  if (WIFSIGNALED(outcome.status))
    wrong = fmt::format("gnuplot was killed by signal {}", WTERMSIG(outcome.status));
  else if (WEXITSTATUS(outcome.status) != 0)
    wrong = fmt::format("gnuplot exited with status {}", WEXITSTATUS(outcome.status));
  else {
    const std::string picture = contents(svg);
    const std::size_t last = picture.find_last_not_of(" \n\r\t");
    const bool complete = last != std::string::npos && picture.substr(0, last + 1).ends_with("</svg>") &&
                          picture.find("<svg") != std::string::npos;
    if (picture.empty())
      wrong = "gnuplot wrote no picture";
    else if (!complete)
      wrong = "gnuplot's picture is incomplete";
  }
  return wrong.empty() || outcome.words.empty() ? wrong : wrong + ": " + outcome.words;
}

}  // namespace

void check_id(const std::string& id) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  constexpr std::size_t longest = 200;  // names of files have at most 255 bytes, with an ending and what marks a draft
  if (id.empty() || id.front() == '.' || id.front() == '-' || id.find_first_not_of(allowed) != std::string::npos ||
      id.size() > longest)
    throw std::invalid_argument(
        fmt::format("figure '{}': an id names files: at most {} letters, digits, '_', '-' and '.', starting with a "
                    "letter, digit or "
                    "'_'",
                    printable(id), longest));
}

void send_points(std::ostream& gp, const std::vector<std::pair<double, double>>& points) {
  dynamic_cast<Gnuplot&>(gp).send1d(points);
}

Drawn draw_files(const std::string& id, const std::string& csv, const std::function<void(std::ostream&)>& write,
                 const fs::path& directory, std::string& message) {
  write_file(directory / (id + ".csv"), csv);  // also creates the directory
  write_file(directory / (id + ".gp"), script_of(id, directory, write));
  const fs::path svg = directory / (id + ".svg");
  std::error_code ignored;
  fs::remove(svg, ignored);

  const Scratch unfinished(directory / fmt::format(".{}.svg.{}.tmp", id, ::getpid()));
  const Outcome outcome = run_gnuplot(directory, id + ".gp", unfinished.path.filename().string());
  if (!outcome.found) {
    message = outcome.words;
    return Drawn::gnuplot_missing;
  }
  message = complaint(outcome, unfinished.path);
  if (!message.empty()) return Drawn::gnuplot_failed;
  fs::rename(unfinished.path, svg);
  return Drawn::yes;
}

}  // namespace diptych::reports
