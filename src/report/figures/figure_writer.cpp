#include "report/figures/figure_writer.hpp"

#include <unistd.h>

#include <system_error>
#include <utility>

#include "process/errors.hpp"
#include "process/exit.hpp"
#include "report/figures/gnuplot.hpp"
#include "store/work_store.hpp"

namespace holdfast::program {

namespace fs = std::filesystem;

FigureWriter::FigureWriter(FigureWork work)
    : work_(std::move(work)), can_draw_(gnuplot_available()) {}

DrawnFigure FigureWriter::make(const Figure& figure) const {
  DrawnFigure drawn{figure, {}, {}, ""};
  for (const TableRequest& table : figure.tables)
    drawn.commands.push_back(shell_text(table.arguments, work_.case_arguments) + " --output data/" +
                             table.name + ".csv");
  drawn.reason = write_tables(figure);
  return drawn.reason.empty() ? with_picture(std::move(drawn)) : drawn;
}

DrawnFigure FigureWriter::drawn(DrawnFigure own) const {
  own.commands = {shell_text({"report"}, work_.case_arguments) + " --output ."};
  return own.reason.empty() ? with_picture(std::move(own)) : own;
}

DrawnFigure FigureWriter::with_picture(DrawnFigure drawn) const {
  if (!can_draw_) {
    drawn.reason = "gnuplot is not installed (Debian package gnuplot-nox)";
    return drawn;
  }
  drawn.figure.length_unit = work_.length_unit;
  drawn.picture = page_picture(drawn.figure, work_.folder);
  return drawn;
}

std::string FigureWriter::write_tables(const Figure& figure) const {
  try {
    for (const TableRequest& table : figure.tables) write_table(table);
  } catch (const NoAnswer& reason) {
    return reason.what();
  } catch (const WrongInput& reason) {
    return reason.what();
  }
  return "";
}

void FigureWriter::write_table(const TableRequest& table) const {
  const std::string file = (work_.folder / "data" / (table.name + ".csv")).string();
  // A sweep that was interrupted has left its chunks; this report may be one of another case.
  remove_left_work_store(file + ".zarr");
  std::vector<std::string> arguments = command_of(table.arguments, work_.case_arguments);
  arguments.insert(arguments.end(), {"--quiet", "--output", file});
  work_.run(arguments);
}

ReportFolders::ReportFolders(const fs::path& folder) {
  for (const fs::path& wanted : {folder / "data", folder / "pictures"}) {
    fs::path made;
    for (const fs::path& part : fs::absolute(wanted)) {
      made /= part;
      std::error_code failure;
      if (fs::create_directory(made, failure)) made_.push_back(made);
      if (failure) throw WrongInput("--output " + folder.string() + ": " + failure.message());
    }
  }
}

ReportFolders::~ReportFolders() {
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) rmdir(made->c_str());
}

void write_page(const JobContext& context, OutputFile& file, const std::string& html) {
  file.write(html);
  file.commit();
  if (!context.quiet) {
    OutputFile output(std::nullopt);
    output.write("Report: " + (fs::path(*context.output) / "report.html").string() + "\n");
    output.commit();
  }
  if (!gnuplot_available())
    report_error("the report has no pictures: install gnuplot (Debian package gnuplot-nox)");
}

}  // namespace holdfast::program
