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

std::size_t characters(std::string_view text) {  // UTF-8 code points
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Breaks at spaces into lines of at most so many pixels, where words allow.
std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character) {
  const auto limit = static_cast<std::size_t>(pixels / per_character);
  std::vector<std::string> lines;
  std::string line;
  std::size_t used = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n\r\t", at), text.size());
    const std::string word = text.substr(at, end - at);
    const std::size_t length = characters(word);
    if (used > 0 && used + 1 + length > limit) {
      lines.push_back(std::exchange(line, ""));
      used = 0;
    }
    if (used > 0 && length > 0) line += ' ', ++used;
    line += word;
    used += length;
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

double Heading::height() const {
  return title_line * static_cast<double>(title.size()) + note_line * static_cast<double>(notes.size());
}

Heading heading_of(const std::string& title, const std::vector<std::string>& notes, double pixels) {
  Heading heading{lines_of(title, pixels, title_char), {}};
  for (const std::string& note : notes)
    for (std::string& line : lines_of(note, pixels, note_char)) heading.notes.push_back(std::move(line));
  return heading;
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += '\'';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + "'";
}

std::string marked(const std::string& text) {
  const auto in_word = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  // Where the letter before text[i] begins, Greek ones having two bytes; none: i.
  const auto letter_before = [&](std::size_t i) {
    if (i >= 1 && std::isalpha(static_cast<unsigned char>(text[i - 1])) != 0) return i - 1;
    if (i >= 2 && (text[i - 2] == '\xce' || text[i - 2] == '\xcf')) return i - 2;
    return i;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::size_t end = i + 1;
    while (text[i] == '_' && in_word(end) && text[end] != '_') ++end;
    const std::size_t start = letter_before(i), length = end - i - 1;
    if (length >= 1 && length <= 4 && start < i && (start == 0 || !in_word(start - 1)) && !in_word(end)) {
      out += "_{" + text.substr(i + 1, length) + "}";
      if (end < text.size() && text[end] == ' ') out += "\u200b";  // or readers of SVG drop a span's leading space
      i = end - 1;
      continue;
    }
    if (std::string_view("\\^_@&~{}").find(text[i]) != std::string_view::npos) out += '\\';
    out += text[i];
  }
  return reports::quoted(out);
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string csv_note(const std::string& key, std::string value) {
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return "# " + key + ": " + value + "\n";
}

std::string csv_number(double value) { return std::isnan(value) ? std::string("nan") : fmt::format("{}", value); }

void check_id(const std::string& id) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (id.empty() || id.front() == '.' || id.front() == '-' || id.find_first_not_of(allowed) != std::string::npos)
    throw std::invalid_argument(
        "figure '" + id +
        "': an id names files: letters, digits, '_', '-' and '.', starting with a letter, digit or '_'");
}

void begin_page(std::ostream& gp, const std::string& id, double width, double height, bool enhanced) {
  gp << "# " << id << ": stand-alone, data included; 'gnuplot " << id << ".gp' writes " << id << ".svg beside it.\n"
     << "set encoding utf8\n"
     << fmt::format("set terminal svg {} rounded size {:.0f},{:.0f}", enhanced ? "enhanced" : "noenhanced", width,
                    height)
     << " font 'sans-serif,12' background rgb '#ffffff'\n"
     << "if (!exists('output_file')) {\n"
     << "  slash = 0\n"
     << "  if (exists('ARG0')) { do for [i=1:strlen(ARG0)] { if (ARG0[i:i] eq '/') { slash = i } } }\n"
     << "  output_file = (slash > 0 ? ARG0[1:slash] : '') . '" << id << ".svg'\n"
     << "}\n"
     << "set output output_file\n\n";
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
