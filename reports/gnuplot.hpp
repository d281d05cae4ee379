// What the figures share, for reports/ alone: text on a page, gnuplot's script mode, and running gnuplot.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/figure.hpp"

namespace diptych::reports {

// Sizes of text [px].
constexpr double margin = 14, title_line = 24, note_line = 15, label_line = 16;
constexpr double label_char = 7.0, note_char = 6.2, title_char = 9.4;  ///< generous for a sans face

std::size_t characters(std::string_view text);  ///< UTF-8 code points

/// Breaks at spaces into lines of at most so many pixels, where words allow.
std::vector<std::string> lines_of(const std::string& text, double pixels, double per_character);

/// Title and notes, broken into lines.
struct Heading {
  std::vector<std::string> title, notes;
  double height() const;  ///< [px]
};
Heading heading_of(const std::string& title, const std::vector<std::string>& notes, double pixels);

/// A string in gnuplot's single quotes, in which nothing is expanded.
std::string quoted(const std::string& text);

/// The same for a page with enhanced text: "L_x", "ε_v" get their subscript (one letter, '_' and up to four letters or
/// digits, which end the word), and all else stays as it is.
std::string marked(const std::string& text);

std::string csv_field(const std::string& text);                   ///< RFC 4180
std::string csv_note(const std::string& key, std::string value);  ///< "# key: value", one line
std::string csv_number(double value);                             ///< as short as gives the same double; "nan"

/// Throws std::invalid_argument unless the id is a plain file name: letters, digits, '_', '-' and '.'.
void check_id(const std::string& id);

/// First lines of a script: the page's size [px] and the file it writes, which is ID.svg beside it unless the variable
/// output_file names another.
void begin_page(std::ostream& gp, const std::string& id, double width, double height, bool enhanced = false);

/// What a '-' of the last plot command is to read, with 18 digits. `gp` is the stream that draw_files gives.
void send_points(std::ostream& gp, const std::vector<std::pair<double, double>>& points);

/// Writes ID.csv, and ID.gp as `write` sends it to gnuplot-iostream, runs gnuplot and keeps its picture if it is whole:
/// see draw(). Throws std::runtime_error where a script did not arrive whole.
Drawn draw_files(const std::string& id, const std::string& csv, const std::function<void(std::ostream&)>& write,
                 const std::filesystem::path& directory, std::string& message);

}  // namespace diptych::reports
