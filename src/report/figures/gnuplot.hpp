#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/figures/figure.hpp"
#include "report/picture/picture_panels.hpp"

namespace holdfast::program {

/// Whether a gnuplot can be started here (Debian package gnuplot-nox).
bool gnuplot_available();

/// The whole gnuplot script of a figure: style, axes, tables. It is run in the report's folder and
/// reads data/NAME.csv.
/// @param ending  of the picture: ".svg", ".png" or ".pdf"
std::string gnuplot_script(const Figure& figure, const std::string& ending = ".svg");

/// A picture in bytes, and its panels.
struct Drawing {
  std::string bytes;
  std::vector<PicturePanel> panels;
};

/// Draws pictures/NAME.svg in the report's folder, or with another ending, and leaves the script
/// beside it as NAME.gp; or neither, where they are not kept. The picture appears whole or not at
/// all. Throws OutputError when gnuplot fails, in its words.
Drawing draw(const Figure& figure, const std::filesystem::path& folder,
             const std::string& ending = ".svg", bool kept = true);

}  // namespace holdfast::program
