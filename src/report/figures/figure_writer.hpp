#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/output.hpp"
#include "process/job_context.hpp"
#include "report/figures/figure.hpp"
#include "report/page/command_line.hpp"
#include "report/page/html.hpp"

namespace holdfast::program {

/// Where the tables and pictures of a report go, and what makes them.
struct FigureWork {
  std::filesystem::path folder;
  std::vector<std::string> case_arguments;  ///< the options that made the case
  const CommandRunner& run;
  LengthUnit length_unit = {};  ///< of small lengths
};

/// Makes the tables of a report's figures by command lines of the program, and draws them.
class FigureWriter {
 public:
  explicit FigureWriter(FigureWork work);

  /// With its picture, or the reason why there is none, as where its record ends too soon.
  DrawnFigure make(const Figure& figure) const;

  /// A figure whose tables the report has written itself, unless there is a reason not to.
  DrawnFigure drawn(DrawnFigure own) const;

 private:
  DrawnFigure with_picture(DrawnFigure drawn) const;
  std::string write_tables(const Figure& figure) const;
  void write_table(const TableRequest& table) const;

  FigureWork work_;
  bool can_draw_;
};

/// The folder of a report, and data/ and pictures/ in it. Those that it has made go with it where
/// nothing is in them, as a report leaves them that does not come to its end.
class ReportFolders {
 public:
  /// Throws WrongInput where a folder cannot be made.
  explicit ReportFolders(const std::filesystem::path& folder);
  ~ReportFolders();
  ReportFolders(const ReportFolders&) = delete;
  ReportFolders& operator=(const ReportFolders&) = delete;
  ReportFolders(ReportFolders&&) = delete;
  ReportFolders& operator=(ReportFolders&&) = delete;

 private:
  std::vector<std::filesystem::path> made_;
};

/// Writes the page of a report and says where it lies, and what it lacks.
void write_page(const JobContext& context, OutputFile& file, const std::string& html);

}  // namespace holdfast::program
