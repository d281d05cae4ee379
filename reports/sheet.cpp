#include "reports/sheet.hpp"

#include <fmt/core.h>

#include <cctype>
#include <ostream>
#include <string_view>
#include <utility>

#include "reports/csv.hpp"

namespace diptych::reports {

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
  // gnuplot 5.4 takes two apostrophes for one only behind another character: not at the beginning, not behind one.
  // Those stand in double quotes, joined by its '.'. Its SVG terminal writes texts as CDATA, which "]]>" would end.
  const std::string shown = printable(text);
  std::string out = "'";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    if (c == '\'')
      out += i == 0 || shown[i - 1] == c ? "'.\"'\".'" : "''";
    else if (c == '>' && i >= 2 && shown[i - 1] == ']' && shown[i - 2] == ']')
      out += "\u200b>";
    else
      out += c == '\n' || c == '\t' ? ' ' : c;
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

std::string Sheet::at(double x, double y) const {
  return fmt::format("screen {:.6f},{:.6f}", x / width, 1 - y / height);
}

void Sheet::text(const std::string& words, double x, double y, const std::string& style) const {
  gp << "set label " << (enhanced ? marked(words) : quoted(words)) << " at " << at(x, y) << ' ' << style << '\n';
}

void Sheet::heading(const Heading& heading, double x) const {
  write_heading(heading, [&](const std::string& line, double y, const char* style) { text(line, x, y, style); });
}

void Sheet::margins(double x0, double x1, double y0, double y1) const {
  gp << fmt::format(
      "set lmargin at screen {:.6f}; set rmargin at screen {:.6f}\n"
      "set tmargin at screen {:.6f}; set bmargin at screen {:.6f}\n",
      x0 / width, x1 / width, 1 - y0 / height, 1 - y1 / height);
}

std::string csv_heading(const std::string& id, const std::string& title, const std::vector<std::string>& notes) {
  std::string out = csv_note("figure", id) + csv_note("title", title);
  for (const std::string& note : notes) out += csv_note("note", note);
  return out;
}

}  // namespace diptych::reports
