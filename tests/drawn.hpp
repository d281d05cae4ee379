// Figures drawn for a test, with gnuplot or without.
#pragma once

#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <string>

#include "reports/figure.hpp"
#include "tests/folder.hpp"

namespace diptych::tests {

/// Draws with the gnuplot there is; false, with a message, where there is none.
template <class AnyFigure>
bool drawn(const AnyFigure& figure, const std::filesystem::path& directory) {
  std::string message;
  const reports::Drawn result = draw(figure, directory, message);
  BOOST_TEST((result != reports::Drawn::gnuplot_failed), message);
  if (result == reports::Drawn::gnuplot_missing) BOOST_TEST_MESSAGE("gnuplot is missing: no picture was checked");
  return result == reports::Drawn::yes;
}

/// The script alone, which is written without gnuplot, too.
template <class AnyFigure>
std::string scripted(const AnyFigure& figure, const std::filesystem::path& directory) {
  const Path nowhere(directory.string());
  std::string message;
  BOOST_TEST((draw(figure, directory, message) == reports::Drawn::gnuplot_missing));
  return contents(directory / (figure.id + ".gp"));
}

}  // namespace diptych::tests
