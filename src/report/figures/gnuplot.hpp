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

/// Draws pictures/NAME.svg in the report's folder, or with another ending, and leaves the script
/// beside it as NAME.gp. The picture appears whole or not at all. Gives its panels. Throws
/// OutputError when gnuplot fails, in its words.
std::vector<PicturePanel> draw(const Figure& figure, const std::filesystem::path& folder,
                               const std::string& ending = ".svg");

/// The bytes of a picture of which no file is left, and its panels.
struct PassingPicture {
  std::string bytes;
  std::vector<PicturePanel> panels;
};

/// Draws like draw(), but leaves nothing in the folder.
PassingPicture passing_picture(const Figure& figure, const std::filesystem::path& folder,
                               const std::string& ending);

}  // namespace holdfast::program
