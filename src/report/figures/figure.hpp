#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/job_context.hpp"
#include "holdfast/core/axis.hpp"
#include "io/text/csv.hpp"
#include "report/picture/picture_panels.hpp"
#include "text/compiled_texts.hpp"

namespace holdfast::program {

/// A table of the report: the name of its file and the command line that makes it.
struct TableRequest {
  std::string name;                    ///< "fig06a-control": data/fig06a-control.csv
  std::vector<std::string> arguments;  ///< {"simulate", "--duration", "1", …}, without --output
};

/// Unit of length, and the number of these units in a metre.
struct LengthUnit {
  const char* name = "mm";
  double per_metre = 1e3;
};

/// Picture of the report: its tables and the gnuplot commands that draw it.
struct Figure {
  std::string name;                  ///< name of the files: "fig06a" for pictures/fig06a.svg
  std::string title;                 ///< title above the picture
  std::string caption;               ///< description that makes the picture understandable alone
  std::vector<TableRequest> tables;  ///< each name begins with the figure's name
  /// gnuplot commands. @@ stands for the file of the table NAME, @-loop@ for that of NAME-loop,
  /// @unit@ for the unit of small lengths, @length@ for the number of these units in a metre.
  std::string plot;
  double height = 360.0;        ///< height of the picture in points; its width is 640
  LengthUnit length_unit = {};  ///< unit of small lengths
  std::string heading = {};     ///< heading inside the picture; "": none
};

/// Concatenation of two lists.
template <class List>
List joined(List first, const List& others) {
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

/// Figures of a list in texts/figures.toml, which is compiled in.
/// @param list    name of the list, such as "paper"
/// @param values  replacements of @KEY@ in the texts
/// @param panels  replacements for each panel, where the list gives no panels
std::vector<Figure> listed_figures(const std::string& list, const Values& values = {},
                                   const std::vector<Values>& panels = {});

/// Strings of a TOML table, by their keys.
Values values_of(const toml::table& table);

/// Figure of one of the kinds that [kind] in texts/figures.toml lists.
/// @param figure  name, title and caption of the figure
/// @param tables  suffix of the name and command of each table; null: the tables of the kind
Figure figure_of_kind(Figure figure, const std::string& kind_name, const toml::array* tables,
                      const Values& given, const std::vector<Values>& panels);

/// Text of texts/figures.toml, at the top level or in a table ("words"); "" where there is none.
std::string listed_text(const std::string& name);
std::string listed_text(const std::string& table, const std::string& name);

/// Rows of the list `pictures` in texts/figures.toml.
const toml::array& listed_pictures();

/// Figures of a case's report.
/// @param builtin  whether the case is the paper's: then Figs. 2–13 of Kollár 2022, with the
///                 settings of their captions, and some beyond them
std::vector<Figure> figures_of(const Case& the_case, bool builtin);

/// Ranges "P" and "D" of a window of gains around the gains of the case, as wide as these gains.
Values window_of_gains(const Case& the_case);

/// Range of --p or --d in a chart of gains: `range` if the user gave the option, or if gains and
/// absorber stiffness are within the paper's ranges; else a range around the case's gains.
/// @param range  given or paper's range, MIN:MAX or MIN:MAX:COUNT
std::string shown_gains(const JobContext& context, const std::string& option,
                        const std::string& range);

/// Highest frequency (Hz) of a spectrum's picture: beyond the fourth harmonic of the force, at most
/// half the sampling rate.
std::string greatest_frequency(const Case& the_case);

/// Arguments of a command line without quotes, split at blanks.
std::vector<std::string> words_of(const std::string& command);

/// Runs one command line, without the program's name; throws what its job throws.
using CommandRunner = std::function<void(const std::vector<std::string>&)>;

/// Command line of a job with the case's options after the job's name, before its own options.
std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments);

/// Command line of the program with the quotes that a shell needs.
std::string shell_text(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& case_arguments);

/// Text of a number with `digits` significant digits.
std::string rounded(double value, int digits);

/// End of an axis: the value plus 2 %, rounded up to one significant digit.
double rounded_up(double value);

/// Unit (mm, µm or nm) in which a length (m) is a number of about 0.1 to 100.
LengthUnit length_unit_for(double length);

/// Text MIN:MAX:COUNT of an axis of frequencies, as the jobs read it.
std::string frequencies_text(const Axis& axis);

/// Replacements of @KEY@ for the pictures of a span.
Values span_values(const Case& the_case);

/// Figures of a span for a line engineer: vibration and strain over frequency, absorption at each
/// end, damping of the modes, and damage over wind speed.
std::vector<Figure> span_figures(const Case& the_case);

/// Axis of a map over a key of the case, and its display in the picture.
struct MapAxis {
  std::string key;
  double min, max;  // in the key's unit, min < max
  bool logarithmic;
  std::string label;
  double scale;  // displayed value over the key's value
};

/// gnuplot expression of the displayed value on an axis.
/// @param value  gnuplot expression of the key's value
std::string shown_on(const MapAxis& axis, const std::string& value);

/// Replacements of @KEY@ for an axis: "x axis" (sweep axis of 61 values), "x label", "x range", "x
/// tics", and "x", the expression of the displayed value of a column.
Values values_of(const std::string& letter, const MapAxis& axis, const std::string& column);

/// Label of an axis over a key of the case, with the displayed unit: "sampling period τ (ms)". A
/// word that is no key is returned unchanged.
std::string label_of(const std::string& key);

/// Ratio of the displayed value to the key's value, on an axis with the label of label_of().
double scale_of(const std::string& key);

/// Largest finite |value| (m) in the columns of a table with the unit metre; 0 for none.
double largest_length(const CsvTable& table);

/// Replacements of @KEY@ for the panels of a table, one panel for each column after the axes:
/// label, values, colour or ordinate range, and style. A column of words has one shade, or one
/// height, per word.
std::vector<Values> panels_of(const CsvTable& table, std::size_t axes, const LengthUnit& unit);

/// Whether gnuplot can be started (Debian package gnuplot-nox).
bool gnuplot_available();

/// Complete gnuplot script of a figure: style, axes, tables. It runs in the report's folder and
/// reads data/NAME.csv.
/// @param ending  file name ending of the picture: ".svg", ".png" or ".pdf"
std::string gnuplot_script(const Figure& figure, const std::string& ending = ".svg");

/// Bytes of a picture, and its panels.
struct Drawing {
  std::string bytes;
  std::vector<PicturePanel> panels;
};

/// Draws pictures/NAME.svg (or another ending) in the report's folder, and writes the script
/// NAME.gp beside it; keeps neither file where `kept` is false. The picture appears whole or not at
/// all. Throws OutputError with gnuplot's message when gnuplot fails.
Drawing draw(const Figure& figure, const std::filesystem::path& folder,
             const std::string& ending = ".svg", bool kept = true);

}  // namespace holdfast::program
