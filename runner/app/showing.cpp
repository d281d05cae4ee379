#include "runner/app/showing.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <boost/timer/progress_display.hpp>
#include <iostream>
#include <memory>
#include <thread>

#include "reports/figure.hpp"
#include "reports/page.hpp"
#include "reports/plate_figure.hpp"
#include "runner/input/messages.hpp"

namespace diptych::runner {

std::string some_of(const std::string& headline, const std::vector<std::string>& lines) {
  constexpr std::size_t most = 10;
  std::string out = headline;
  for (std::size_t i = 0; i < std::min(most, lines.size()); ++i) out += "\n  " + lines[i];
  if (lines.size() > most) out += fmt::format("\n  and {} more", lines.size() - most);
  return out;
}

int threads_of(const Options& options) {
  return options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::function<void(std::size_t, std::size_t)> progress() {
  if (isatty(STDERR_FILENO)) {
    auto bar = std::make_shared<std::unique_ptr<boost::timer::progress_display>>();
    return [bar](std::size_t done, std::size_t total) {
      if (!*bar) *bar = std::make_unique<boost::timer::progress_display>(total, std::cerr);
      **bar += done - (*bar)->count();
    };
  }
  return [](std::size_t done, std::size_t total) {
    if (done == total || done * 4 / total != (done - 1) * 4 / total) tell("{} of {} runs\n", done, total);
  };
}

std::string duration_words(double seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 100) return fmt::format("about {:.0f} s", seconds);
  if (seconds < 6000) return fmt::format("about {:.0f} min", seconds / 60);
  if (seconds < 3 * 86400) return fmt::format("about {:.1f} h", seconds / 3600);
  return fmt::format("about {:.3g} days", seconds / 86400);
}

std::function<void(const Ahead&)> warning_of(const Options& options, bool aloud) {
  return [yes = options.yes, aloud](const Ahead& ahead) {
    const std::string what = fmt::format("{} runs of {:.3g} steps in all, {:.3g} at the most of one: {}", ahead.runs,
                                         ahead.steps, ahead.most_steps, duration_words(ahead.seconds));
    constexpr double hour = 3600;
    if (ahead.seconds > hour && !yes) throw InputError(what + "; allowed: at most an hour, or with --yes");
    if (aloud) tell("{}\n", what);
  };
}

void prepare(const std::filesystem::path& out, const std::string& option) {
  std::error_code problem;
  std::filesystem::create_directories(out, problem);
  if (problem || access(out.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("{}: cannot write to {}: {}", option, out.string(),
                                 problem ? problem.message() : "permission denied or read-only"));
  }
}

void prepare_file(const std::string& option, const std::filesystem::path& file, const std::vector<Case>& cases) {
  if (file.empty()) return;
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: found {}, {}; allowed: a file for results", option, file.string(), what));
  };
  std::error_code none;
  if (std::filesystem::is_directory(file, none)) refuse("which is a folder");
  for (const Case& c : cases)
    if (std::filesystem::equivalent(file, c.path, none)) refuse("which is the case itself");
  if (file.extension() == ".toml" && std::filesystem::exists(file, none)) refuse("which may be a case");
  if (!file.has_filename()) refuse("which is no name of a file");
  if (file.has_parent_path()) prepare(file.parent_path(), option);
}

int draw_figures(const std::vector<reports::Case>& results, const std::filesystem::path& directory,
                 const std::set<std::string>& wanted) {
  int undrawn = 0;
  bool missing = false;
  const auto draw_each = [&](const auto& figures) {
    for (const auto& figure : figures) {
      const std::string page = figure.id.substr(0, figure.id.rfind('.'));  // a page's pictures go by its name
      if (!wanted.empty() && !wanted.count(figure.id) && !wanted.count(page)) continue;
      std::string message;
      const reports::Drawn drawn = reports::draw(figure, directory, message);
      if (drawn == reports::Drawn::yes) {
        print("{}\n", (directory / (figure.id + ".svg")).string());
        continue;
      }
      missing = missing || drawn == reports::Drawn::gnuplot_missing;
      undrawn += drawn == reports::Drawn::gnuplot_failed;
      print("{}  (script and data only)\n", (directory / (figure.id + ".gp")).string());
      if (drawn == reports::Drawn::gnuplot_failed) tell("gnuplot failed on {}: {}\n", figure.id, message);
    }
  };
  for (const auto& result : results) {
    draw_each(result.figures);
    draw_each(result.problem_figures);
    draw_each(result.plate_figures);
    for (const auto& [name, page] : result.pages) {
      if (!wanted.empty() && !wanted.count(name)) continue;
      const auto path = directory / (name + ".html");
      reports::write_page(page, path);
      print("{}\n", path.string());
    }
  }
  if (missing) tell("gnuplot is not installed: no pictures, all else is complete (apt-get install gnuplot-nox)\n");
  return undrawn;
}

}  // namespace diptych::runner
