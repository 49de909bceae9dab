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

/// A unit of length and how many of it a metre has.
struct LengthUnit {
  const char* name = "mm";
  double per_metre = 1e3;
};

/// A picture of the report: the tables it is drawn from and the gnuplot commands that draw it.
struct Figure {
  std::string name;     ///< "fig06a": pictures/fig06a.svg
  std::string title;    ///< heading
  std::string caption;  ///< says what is drawn, so that the picture can be understood alone
  std::vector<TableRequest> tables;  ///< the name of each begins with that of the figure
  /// gnuplot commands; the file of the table NAME-loop is @-loop@, that of the table NAME @@, the
  /// unit of small lengths @unit@, of which a metre has @length@.
  std::string plot;
  double height = 360.0;        ///< of the picture, in points; its width is 640
  LengthUnit length_unit = {};  ///< of length_unit_for()
  std::string heading = {};     ///< in the picture itself, "" where it stands above it
};

/// One list after the other.
template <class List>
List joined(List first, const List& others) {
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

/// The figures of a list of texts/figures.toml, which is compiled in.
/// @param list    "paper"
/// @param values  what the texts leave open to the program
/// @param panels  the same for each of the panels, where the list has none
std::vector<Figure> listed_figures(const std::string& list, const Values& values = {},
                                   const std::vector<Values>& panels = {});

/// The texts of a table.
Values values_of(const toml::table& table);

/// A figure of a kind of that file.
/// @param figure  its name, title and caption
/// @param tables  of each the suffix of its name and its command; null: those of the kind
Figure figure_of_kind(Figure figure, const std::string& kind_name, const toml::array* tables,
                      const Values& given, const std::vector<Values>& panels);

/// A text of that file that is no figure's, or one of a table in it, as "words"; "" where there is
/// none.
std::string listed_text(const std::string& name);
std::string listed_text(const std::string& table, const std::string& name);

/// The rows of its list of pictures.
const toml::array& listed_pictures();

/// The figures of a case with its settings.
/// @param builtin  the case is the paper's: Figs. 2–13 of Kollár 2022, with the settings that their
///                 captions give, and some beyond them
std::vector<Figure> figures_of(const Case& the_case, bool builtin);

/// "P" and "D": a window of gains around those of the case, as wide as the gains themselves.
Values window_of_gains(const Case& the_case);

/// Range of --p or --d in a chart of gains: as it is given, else the paper's, and where the case's
/// gains lie outside of that, or its absorber is of another size, one about the case's.
/// @param range  given or the paper's, MIN:MAX with a count behind it or without
std::string shown_gains(const JobContext& context, const std::string& option,
                        const std::string& range);

/// Where the spectrum of a motion ends (Hz): behind the fourth harmonic of the force, or where the
/// samples show no more.
std::string greatest_frequency(const Case& the_case);

/// The arguments of a command line without quotes.
std::vector<std::string> words_of(const std::string& command);

/// Does one command line of the program, without the program's name; throws what its job throws.
using CommandRunner = std::function<void(const std::vector<std::string>&)>;

/// A job's command line with the options that made the case before its own: job, case, the rest.
/// @param arguments  the job and its own options
std::vector<std::string> command_of(const std::vector<std::string>& arguments,
                                    const std::vector<std::string>& case_arguments);

/// A command line of the program as a shell reads it.
std::string shell_text(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& case_arguments);

/// Text of a number with so many significant digits.
std::string rounded(double value, int digits);

/// A little above the value, with one digit: where an axis ends.
double rounded_up(double value);

/// The unit in which a length (m) is between 0.1 and 100 or so: mm, µm or nm.
LengthUnit length_unit_for(double length);

/// An axis of frequencies as the jobs read it: MIN:MAX:COUNT.
std::string frequencies_text(const Axis& axis);

/// Values that the texts leave open of the pictures of a span.
Values span_values(const Case& the_case);

/// Figures of a span as a line engineer draws them: its vibration and strain over frequency, what
/// its devices take at each end, the damping of its modes, and the damage over wind speed.
std::vector<Figure> span_figures(const Case& the_case);

/// A key of the case along an axis of a map, and how the picture shows it.
struct MapAxis {
  std::string key;
  double min, max;  // in the key's unit, min < max
  bool logarithmic;
  std::string label;
  double scale;  // the picture shows scale times the key's value
};

/// gnuplot's expression for what the picture's axis shows of a value, itself an expression.
std::string shown_on(const MapAxis& axis, const std::string& value);

/// Values that the texts leave open of an axis: "x axis" of a sweep with 61 values, "x label",
/// "x range", "x tics" and, as "x", the expression for what it shows of a column.
Values values_of(const std::string& letter, const MapAxis& axis, const std::string& column);

/// Label of an axis for a key of the case, with the unit in which it shows it: "sampling period τ
/// (ms)"; of another word, that word.
std::string label_of(const std::string& key);

/// So many times an axis of that label shows the key's value.
double scale_of(const std::string& key);

/// The largest finite |value| (m) of the columns of a table whose unit is the metre; 0 for none.
double largest_length(const CsvTable& table);

/// Values that the texts leave open of the panels of a table over axes, one for each column behind
/// those: its label, its values, what its shades or, over one axis, its ordinate span, how it is
/// drawn. A column of words is drawn with a shade, or a height, a word.
std::vector<Values> panels_of(const CsvTable& table, std::size_t axes, const LengthUnit& unit);

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
