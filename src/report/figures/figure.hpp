#pragma once

#include <string>
#include <utility>
#include <vector>

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
};

/// The text with another one wherever a part stands.
std::string replaced(std::string text, const std::string& part, const std::string& other);

/// What @KEY@ stands for in a text, key by key.
using Values = std::vector<std::pair<std::string, std::string>>;

/// The text with every @KEY@ replaced, in the order of the values.
std::string filled(std::string text, const Values& values);

/// The arguments of a command line without quotes.
std::vector<std::string> words_of(const std::string& command);

/// A little above the value, with one digit: where an axis ends.
double rounded_up(double value);

/// The unit in which a length (m) is between 0.1 and 100 or so: mm, µm or nm.
LengthUnit length_unit_for(double length);

}  // namespace holdfast::program
