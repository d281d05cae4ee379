// plant: writes the sources of a program that holds every planted defect, each behind a run-time switch.
//
//   plant SOURCE DEFECTS OUT FILE...
//
// DEFECTS/*.toml are the defects (tests/defects/README.md says how they are written), FILE... the product's sources,
// relative to SOURCE. Into OUT go: the sources and headers with each defective expression or statement beside the right
// one; planted.hpp and planted.cpp, the switch, which the environment variable DIPTYCH_DEFECT sets; and teeth.cmake,
// one ctest entry for each defect. What is the same already is not written, so that nothing is built anew for it.
//
// A defect that no longer fits the sources fails in its own entry and stops nothing else.
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Defect {
  int number = 0;  ///< of the switch, from 1
  std::string id, file, in, find, replace, why, verdict = "FAIL";
  std::vector<std::string> gates;
  std::string unfit;  ///< why it is not planted; empty if it is
};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Leaves a file alone that holds the text already; whether it did not.
bool write(const fs::path& path, const std::string& text) {
  if (fs::exists(path) && contents(path) == text) return false;
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  return true;
}

// --- reading the defects ------------------------------------------------------------------------------------------

std::vector<Defect> read_defects(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Defect> defects;
  std::set<std::string> ids;
  for (const fs::path& path : files) {
    const toml::table table = toml::parse_file(path.string());
    for (const toml::node& node : *table["defect"].as_array()) {
      const toml::table& entry = *node.as_table();
      const auto wrong = [&](const std::string& what) {
        return std::runtime_error(path.string() + ":" + std::to_string(entry.source().begin.line) + ": " + what);
      };
      Defect d;
      const std::map<std::string, std::string*> keys{{"id", &d.id},          {"file", &d.file}, {"in", &d.in},
                                                     {"find", &d.find},      {"why", &d.why},   {"verdict", &d.verdict},
                                                     {"replace", &d.replace}};
      for (const auto& [key, value] : entry) {
        const std::string name(key.str());
        if (name == "gates" && value.is_array()) {
          for (const toml::node& gate : *value.as_array()) d.gates.push_back(gate.value_or(std::string()));
        } else if (const auto known = keys.find(name); known != keys.end() && value.is_string()) {
          *known->second = value.value_or(std::string());
        } else {
          throw wrong("a defect has id, file, find, replace, why and gates, and may have in and verdict; found " +
                      name);
        }
      }
      if (d.id.empty() || d.file.empty() || d.find.empty() || d.why.empty() || d.gates.empty() ||
          !entry.contains("replace"))
        throw wrong("a defect needs id, file, find, replace, why and gates");
      if (d.verdict != "FAIL" && d.verdict != "INVALID" && d.verdict != "ERROR" && d.verdict != "UNSTABLE")
        throw wrong("verdict = \"" + d.verdict + "\"; allowed: FAIL, INVALID, ERROR, UNSTABLE");
      if (!ids.insert(d.id).second) throw wrong("there are two defects " + d.id);
      d.number = static_cast<int>(defects.size()) + 1;
      defects.push_back(std::move(d));
    }
  }
  return defects;
}

// --- finding their places -----------------------------------------------------------------------------------------

bool of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// A text without blanks and comments, and where each of its letters stands: what only moved or got a comment is found
/// again.
struct Letters {
  std::string text;
  std::vector<std::size_t> at;

  explicit Letters(std::string_view source) {
    const auto keep = [&](std::size_t i) {
      text += source[i];
      at.push_back(i);
    };
    for (std::size_t i = 0; i < source.size(); ++i) {
      const char c = source[i];
      if (source.substr(i, 2) == "//") {
        i = std::min(source.find('\n', i), source.size() - 1);
      } else if (source.substr(i, 2) == "/*") {
        i = std::min(source.find("*/", i + 2), source.size() - 2) + 1;
      } else if (c == '"' || (c == '\'' && (i == 0 || !of_word(source[i - 1])))) {  // not a digit's separator
        keep(i);
        while (++i < source.size() && source[i] != c) {
          keep(i);
          if (source[i] == '\\' && i + 1 < source.size()) keep(++i);
        }
        if (i < source.size()) keep(i);
      } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
        keep(i);
      }
    }
  }
  /// Where `part` stands as whole words, from letter `from` to before `end`.
  std::optional<std::size_t> find(const Letters& part, std::size_t from, std::size_t end) const {
    if (part.text.empty()) return std::nullopt;
    for (std::size_t k = text.find(part.text, from); k != std::string::npos && k + part.text.size() <= end;
         k = text.find(part.text, k + 1)) {
      const std::size_t last = k + part.text.size() - 1;
      const auto cut = [&](std::size_t a, std::size_t b) {  // neighbours that are one word
        return of_word(text[a]) && of_word(text[b]) && at[a] + 1 == at[b];
      };
      if ((k == 0 || !cut(k - 1, k)) && (last + 1 == text.size() || !cut(last, last + 1))) return k;
    }
    return std::nullopt;
  }
};

/// How tightly the operator binds that stands at letter `k` of a text, or ends there; 9 for none.
int strength_at(const std::string& text, std::size_t k) {
  const char c = text[k], before = k > 0 ? text[k - 1] : ' ', after = k + 1 < text.size() ? text[k + 1] : ' ';
  const auto pair = [&](const char* of) { return (before == of[0] && c == of[1]) || (c == of[0] && after == of[1]); };
  if (pair("->") || pair("++") || pair("--") || pair("::")) return 9;
  if (pair("||")) return 2;
  if (pair("&&")) return 3;
  if (pair("==") || pair("!=")) return 4;
  if (pair("<=") || pair(">=") || c == '<' || c == '>') return 5;
  if (c == '?' || c == ':') return 1;
  if (c == '=') return 0;
  if (c == '+' || c == '-') return 6;
  if (c == '*' || c == '/') return 7;
  return 9;
}

/// Whether an expression stands as a whole where it was found: nothing beside it takes a part of it away. What stands
/// before must bind less, since a × (b × c) has other bits than (a × b) × c.
bool whole(const Letters& source, std::size_t begin, std::size_t size) {
  const std::string& text = source.text;
  int weakest = 9, depth = 0;
  for (std::size_t k = begin; k < begin + size; ++k) {
    depth +=
        (text[k] == '(' || text[k] == '[' || text[k] == '{') - (text[k] == ')' || text[k] == ']' || text[k] == '}');
    const bool sign = k == begin || std::string_view("(,=*/+-<>?:&|!").find(text[k - 1]) != std::string_view::npos;
    if (depth == 0 && !(sign && (text[k] == '+' || text[k] == '-' || text[k] == '*' || text[k] == '&')))
      weakest = std::min(weakest, strength_at(text, k));
  }
  const int before = begin > 0 ? strength_at(text, begin - 1) : 9, after = strength_at(text, begin + size);
  const bool logical = weakest == 2 || weakest == 3;
  return (before == 9 || before < weakest || (logical && before == weakest)) && (after == 9 || after <= weakest);
}

bool is_statement(const Letters& find) { return find.text.back() == ';' || find.text.back() == '}'; }

/// A place in a source: [begin, end) and the defects that have it, in order.
struct Place {
  std::size_t begin, end;
  std::vector<const Defect*> defects;
  std::vector<Place> inside;  ///< places of other defects, in order
};

/// Each place of a defect's text: everywhere, or where `in` stands.
std::vector<std::pair<std::size_t, std::size_t>> places_of(const Defect& d, const Letters& source) {
  const Letters find(d.find), in(d.in.empty() ? d.find : d.in);
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::size_t from = 0;
  while (const auto around = source.find(in, from, source.text.size())) {
    from = *around + in.text.size();
    const auto here = source.find(find, *around, from);
    if (!here) throw std::runtime_error("in does not hold find");
    if (!is_statement(find) && !whole(source, *here, find.text.size()))
      throw std::runtime_error("what stands beside it takes a part of the expression " + d.find);
    places.emplace_back(source.at[*here], source.at[*here + find.text.size() - 1] + 1);
  }
  return places;
}

/// Files a place among others; throws where two cross.
void file_in(std::vector<Place>& places, std::size_t begin, std::size_t end, const Defect& d) {
  std::vector<Place> inside;
  for (auto place = places.begin(); place != places.end();) {
    if (place->begin == begin && place->end == end) return place->defects.push_back(&d);
    if (place->begin <= begin && end <= place->end) return file_in(place->inside, begin, end, d);
    if (begin <= place->begin && place->end <= end) {
      inside.push_back(std::move(*place));
      place = places.erase(place);
    } else if (place->end <= begin || end <= place->begin) {
      ++place;
    } else {
      throw std::runtime_error("its place crosses that of " + place->defects.front()->id);
    }
  }
  const auto next = std::find_if(places.begin(), places.end(), [&](const Place& place) { return place.begin > begin; });
  places.insert(next, Place{begin, end, {&d}, std::move(inside)});
}

// --- writing the switches -----------------------------------------------------------------------------------------

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// [begin, end) of a source with its places switched. Lines stay where they are.
std::string switched(const std::string& source, std::size_t begin, std::size_t end, const std::vector<Place>& places) {
  std::string out;
  for (const Place& place : places) {
    out += source.substr(begin, place.begin - begin);
    begin = place.end;
    const std::string right = switched(source, place.begin, place.end, place.inside);
    const bool statement = right.find_last_of(";}") == right.size() - 1;
    std::string choice, closing;
    for (const Defect* d : place.defects) {
      const std::string planted = "::diptych::planted(" + std::to_string(d->number) + ")";
      choice += statement ? "if (" + planted + ") { " + one_line(d->replace) + " } else "
                          : "(" + planted + " ? (" + one_line(d->replace) + ") : ";
      if (!statement) closing += ")";
    }
    out += choice + (statement ? "{ " + right + " }" : "(" + right + ")") + closing;
  }
  return out + source.substr(begin, end - begin);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\' || c == '$') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string the_switch(const std::vector<Defect>& defects) {
  std::string out =
      "// Written by tests/defects/plant.cpp.\n#include \"planted.hpp\"\n\n#include <cstdio>\n#include "
      "<cstdlib>\n#include "
      "<cstring>\n\nnamespace diptych {\nnamespace {\n\nconstexpr const char* ids[] = {\"\"";
  for (const Defect& d : defects) out += ",\n    " + quoted(d.id);
  return out +
         "};\n\nint chosen() {\n  const char* id = std::getenv(\"DIPTYCH_DEFECT\");\n  if (id == nullptr) return 0;\n"
         "  for (int k = 1; k < static_cast<int>(sizeof ids / sizeof *ids); ++k)\n"
         "    if (std::strcmp(ids[k], id) == 0) return k;\n"
         "  std::fprintf(stderr, \"no planted defect %s\\n\", id);\n  std::exit(14);\n}\n\n}  // namespace\n\n"
         "const int chosen_defect = chosen();\n\n}  // namespace diptych\n";
}

constexpr const char* switch_header =
    "// Written by tests/defects/plant.cpp.\n#pragma once\n\nnamespace diptych {\n\nextern const int chosen_defect;  "
    "///< 0 "
    "for "
    "none\n\ninline bool planted(int number) { return number == chosen_defect; }\n\n}  // namespace diptych\n";

/// One ctest entry for each defect; paths of programs are those of the ctest file that includes this.
std::string entries(const std::vector<Defect>& defects, const fs::path& out) {
  std::string text = "# Written by tests/defects/plant.cpp.\n";
  for (const Defect& d : defects) {
    const std::string name = "teeth." + d.id;
    if (d.unfit.empty()) {
      text += "add_test(" + name + " ${teeth} ${planted} " + d.verdict;
      for (const std::string& gate : d.gates) text += " " + quoted(gate);
      text += ")\nset_tests_properties(" + name + " PROPERTIES ENVIRONMENT " + quoted("DIPTYCH_DEFECT=" + d.id);
    } else {
      const fs::path why = out / "unfit" / (d.id + ".txt");
      write(why, d.unfit + "\n");
      text += "add_test(" + name + " sh -c " + quoted("cat '" + why.string() + "'; exit 1") +
              ")\nset_tests_properties(" + name + " PROPERTIES";
    }
    text += " LABELS teeth TIMEOUT 300)\n";
  }
  return text;
}

/// Folders whose sources are all built anew, for the headers that they include: the solvers and what they stand on.
bool of_the_solvers(const std::string& file) {
  const std::string folder = file.substr(0, file.find('/'));
  return folder == "hinge" || folder == "fem" || folder == "mpm";
}

int plant(const fs::path& source, const fs::path& folder, const fs::path& out, const std::vector<std::string>& files) {
  std::vector<Defect> defects = read_defects(folder);
  std::map<std::string, std::vector<Place>> planted;  // by file
  std::map<std::string, std::string> texts;
  for (Defect& d : defects) {
    try {
      if (!texts.count(d.file)) texts[d.file] = contents(source / d.file);
      const auto places = places_of(d, Letters(texts[d.file]));
      if (places.empty()) throw std::runtime_error("it no longer holds\n  " + (d.in.empty() ? d.find : d.in));
      for (const auto& [begin, end] : places) file_in(planted[d.file], begin, end, d);
    } catch (const std::exception& problem) {
      d.unfit = "planted defect " + d.id + ": " + d.file + ": " + problem.what() + "\nso it must be planted anew";
      std::cerr << d.unfit << '\n';
    }
  }
  const auto copy = [&](const std::string& file) {
    const std::string text = contents(source / file);
    const auto places = planted.find(file);
    return write(out / file, "#include \"planted.hpp\"\n#line 1 " + quoted((source / file).string()) + "\n" +
                                 (places == planted.end() ? text : switched(text, 0, text.size(), places->second)));
  };
  for (const std::string& file : files) {
    if (planted.count(file) || of_the_solvers(file))
      copy(file);
    else  // the product's own object serves
      write(out / file, "// No defect is planted here.\n");
  }
  // The build knows of these headers only what it has seen before it called for them: what may include one that is new,
  // other or gone is compiled anew.
  bool headers_differ = false;
  for (const auto& [file, places] : planted)
    if (std::find(files.begin(), files.end(), file) == files.end()) headers_differ = copy(file) || headers_differ;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    const std::string name = fs::relative(entry.path(), out).generic_string();
    if (entry.path().extension() != ".hpp" || name == "planted.hpp" || planted.count(name)) continue;
    fs::remove(entry.path());
    headers_differ = true;
  }
  if (headers_differ)
    for (const std::string& file : files) fs::last_write_time(out / file, fs::file_time_type::clock::now());
  write(out / "planted.hpp", switch_header);
  write(out / "planted.cpp", the_switch(defects));
  write(out / "teeth.cmake", entries(defects, out));
  std::string killed;
  for (const Defect& d : defects) {
    if (d.verdict != "FAIL")
      continue;  // an oracle that fails its own test, a run that breaks or has too much energy: no gate needed
    for (const std::string& gate : d.gates) killed += gate + "\n";
  }
  write(out / "killed.txt", killed);
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "plant SOURCE DEFECTS OUT FILE...\n";
    return EXIT_FAILURE;
  }
  try {
    return plant(argv[1], argv[2], argv[3], {argv + 4, argv + argc});
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return EXIT_FAILURE;
  }
}
