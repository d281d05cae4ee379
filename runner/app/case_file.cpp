// A case file from its first table to its last: what bars and plates have of their own is read in bar_file.cpp and
// plate_file.cpp.
#include "runner/app/case_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <fstream>
#include <functional>
#include <ios>
#include <system_error>

#include "runner/draw/figure_kinds.hpp"
#include "runner/input/case_tables.hpp"
#include "runner/input/toml_table.hpp"
#include "runner/input/toml_tree.hpp"
#include "runner/judge/gate_file.hpp"

namespace diptych::runner {
namespace {

void read_judgement(Table& file, Case& c) {
  file.maybe_table("run", [&](Table& t) {
    c.allow_unstable = t.get("allow_unstable", flag(), false);
    c.ledger = t.get("ledger", flag(), true);
  });
  c.gates = read_each<GateSpec>(file, "gate", c, read_gate);
  c.figures = read_each<FigureSpec>(file, "figure", c, read_figure);
  check_figures(file.place("figure"), c);

  if (c.gates.empty())
    file.place("gate").say("missing; a case with no gate is an error; allowed: at least one [[gate]]");
  check_gates(file.place("gate"), c);
}

Case read_file(Table& file, const std::function<void(Table&, Case&)>& judgement, const std::string& changed) {
  Case c;
  c.changed = changed;
  if (file.has("plate") && file.has("bar"))  // and all that either lacks would be told of the other
    throw NotRead(file.place("bar").at, "bar: found beside [plate]; allowed: [bar] or [plate], one scene a case");
  file.need("schema", whole(1, 1));
  c.scene = file.declaration({"schema", "id", "title", "claim", "why", "paper", "gate", "figure"});
  c.id = file.need("id", id());
  c.title = file.need("title", text());
  c.claim = file.need("claim", one_of({"code-verification", "solution-verification", "cross-code", "regression",
                                       "robustness", "performance"}));
  c.why = file.need("why", text());
  c.units = file.need("units", one_of({"SI", "paper"}));
  file.maybe_table("paper", [&](Table& t) { c.paper_figures = t.need("figures", set_of(text())); });
  if (file.has("plate"))
    read_plate_case(file, c);
  else
    read_bar_case(file, c);
  judgement(file, c);
  return c;
}

Case parsed(const std::string& text, const std::filesystem::path& name,
            const std::function<void(Table&, Case&)>& judgement, const std::vector<Change>& changes) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(name.string() + ":1:1: found an empty file; allowed: a case, see cases/README.md");
  Case c;
  read_toml(
      text, name.string(), [&](Table& file) { c = read_file(file, judgement, label_of(changes)); }, changes);
  c.path = name;
  return c;
}

std::string text_of(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& reason) { throw InputError(path.string() + ": cannot be read: " + reason); };
  std::error_code problem;
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (std::filesystem::is_directory(status)) fail("it is a directory; allowed: a case file (*.toml)");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail("it is a device, a pipe or a socket; allowed: a case file (*.toml)");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(std::generic_category().message(errno));
  std::string text(most_file_bytes + 1, '\0');
  in.read(text.data(), most_file_bytes + 1);
  if (in.bad()) fail(std::generic_category().message(errno));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > most_file_bytes) fail(fmt::format("it is larger than {} bytes, the most allowed", most_file_bytes));
  return text;
}

}  // namespace

std::string label_of(const std::vector<Change>& changes) {
  Names labels;
  for (const auto& [key, value] : changes) {
    if (!value) {
      labels.push_back("without " + key);
      continue;
    }
    const auto* text = value->as<std::string>();
    const auto number = value->number();
    labels.push_back(key + '=' + (text ? *text : number ? words(*number) : words(*value)));
  }
  return listed(labels, " ");
}

Case parse_case(const std::string& text, const std::filesystem::path& name) {
  return parsed(text, name, read_judgement, {});
}

Case read_case(const std::filesystem::path& path) { return parse_case(text_of(path), path); }

Case changed_case(const std::string& text, const std::filesystem::path& name, const std::vector<Change>& changes) {
  const auto unjudged = [](Table& file, Case&) {
    for (const char* judged : {"run", "gate", "figure"}) file.has(judged);  // known, and not read
  };
  Case c = parsed(text, name, unjudged, changes);
  c.allow_unstable = true;
  return c;
}

Case changed_case(const std::filesystem::path& path, const std::vector<Change>& changes) {
  return changed_case(text_of(path), path, changes);
}

}  // namespace diptych::runner
