// The page that a figure's script describes: its size, its title and notes, and text at places of it. For reports/
// alone.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reports/text.hpp"

namespace diptych::reports {

// Sizes of text [px].
constexpr double margin = 14, title_line = 24, note_line = 15, label_line = 16;
constexpr double label_char = 7.0, note_char = 6.2, title_char = 9.4;  ///< generous for a sans face

// How text looks.
constexpr const char *title_style = "left font ',16' textcolor rgb '#111111'",
                     *note_style = "left font ',11' textcolor rgb '#666666'";

/// Title and notes, broken into lines.
struct Heading {
  std::vector<std::string> title, notes;
  double height() const;  ///< [px]
};
Heading heading_of(const std::string& title, const std::vector<std::string>& notes, double pixels);

/// Calls `write(line, y, style)` for each line of the title and of the notes, y being its middle [px from the top].
template <class Write>
void write_heading(const Heading& heading, const Write& write) {
  double y = margin;
  for (const std::string& line : heading.title) {
    write(line, y + 8, title_style);
    y += title_line;
  }
  for (const std::string& line : heading.notes) {
    write(line, y + 5, note_style);
    y += note_line;
  }
}

/// A string for gnuplot, in which nothing is expanded and which its SVG terminal can write.
std::string quoted(const std::string& text);

/// The same for a page with enhanced text: "L_x", "ε_v" get their subscript (one letter, '_' and up to four letters or
/// digits, which end the word), and all else stays as it is.
std::string marked(const std::string& text);

/// First lines of a script: the page's size [px] and the file it writes, which is ID.svg beside it unless the variable
/// output_file names another.
void begin_page(std::ostream& gp, const std::string& id, double width, double height, bool enhanced = false);

/// A box on the page or in a panel, from its upper left corner [px].
struct Box {
  double x = 0, y = 0, w = 0, h = 0;
  /// Whether there is this much room between both.
  bool apart(const Box& other, double gap) const {
    return x + w + gap <= other.x || other.x + other.w + gap <= x || y + h + gap <= other.y ||
           other.y + other.h + gap <= y;
  }
};

/// A page whose places are pixels from its upper left corner, told to gnuplot as parts of the screen.
struct Sheet {
  std::ostream& gp;
  double width, height;
  bool enhanced = false;  ///< text with subscripts

  std::string at(double x, double y) const;  ///< "screen 0.5,0.5"
  void text(const std::string& words, double x, double y, const std::string& style) const;
  void heading(const Heading&, double x) const;
  void margins(double x0, double x1, double y0, double y1) const;  ///< of the next plot
};

/// The first notes of a figure's data: its id, its title and its notes.
std::string csv_heading(const std::string& id, const std::string& title, const std::vector<std::string>& notes);

}  // namespace diptych::reports
