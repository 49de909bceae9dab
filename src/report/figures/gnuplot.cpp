#include "report/figures/figure.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "io/file/output.hpp"
#include "io/file/whole_file.hpp"
#include "process/child.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// The gnuplot commands with non-breaking blanks in the labels of x and y, since SVG loses blanks
/// beside a change of font. The blank after a font's name belongs to gnuplot's syntax and remains.
std::string with_unbroken_labels(const std::string& plot) {
  std::string text;
  for (const std::string_view line : split(plot, '\n')) {
    const std::string beginning(line.substr(0, 12)), label(line.substr(beginning.size()));
    const bool is_label = beginning == "set xlabel \"" || beginning == "set ylabel \"";
    text += (text.empty() ? "" : "\n") + beginning;
    text += is_label ? replaced(replaced(label, " ", "\u00a0"), "{/:Italic\u00a0", "{/:Italic ")
                     : label;
  }
  return text;
}

/// Environment without variables by which gnuplot reads user files or chooses settings.
std::vector<char*> environment_of_gnuplot() {
  std::vector<char*> kept;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (std::string_view(*variable).substr(0, 3) != "GNU") kept.push_back(*variable);
  kept.push_back(nullptr);
  return kept;
}

/// Runs gnuplot in a folder without the user's settings: first `commands`, then a script or option
/// `argument`. Standard output goes to the file `output`, messages to the descriptor `messages`.
/// Returns gnuplot's exit status, or another number than 0 if gnuplot could not start.
int run_gnuplot(const fs::path& folder, const std::string& commands, const std::string& argument,
                const fs::path& output, int messages) {
  std::vector<char*> environment = environment_of_gnuplot();
  return run_in_child([&] {
    const int null_input = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int picture = open(output.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (null_input < 0 || picture < 0 || chdir(folder.c_str()) != 0) return 127;
    dup2(null_input, STDIN_FILENO);
    dup2(picture, STDOUT_FILENO);
    dup2(messages >= 0 ? messages : null_input, STDERR_FILENO);
    restore_signals_of_child();
    environ = environment.data();
    execlp("gnuplot", "gnuplot", "-d", "-e", commands.c_str(), argument.c_str(),
           static_cast<char*>(nullptr));
    return 127;
  });
}

/// Temporary file without a name that receives the messages of gnuplot.
class Messages {
 public:
  Messages() : file_(std::tmpfile(), &std::fclose) {}

  /// Descriptor of the file; −1 if it could not be made.
  int descriptor() const { return file_ ? fileno(file_.get()) : -1; }

  std::string text() const {
    std::string text(100000, '\0');
    if (file_) std::rewind(file_.get());
    text.resize(file_ ? std::fread(text.data(), 1, text.size(), file_.get()) : 0);
    return text;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Whether a picture has its end mark; on a full disk gnuplot truncates it without an error.
bool is_whole(std::string_view picture, const std::string& ending) {
  using namespace std::string_view_literals;
  const std::string_view end = ending == ".svg"   ? "</svg>"sv
                               : ending == ".png" ? "IEND\xae\x42\x60\x82"sv
                                                  : "%%EOF"sv;
  const std::size_t last = picture.find_last_not_of(" \r\n\t");
  if (last == std::string_view::npos || last + 1 < end.size()) return false;
  return picture.substr(last + 1 - end.size(), end.size()) == end;
}

/// gnuplot line for the heading of a picture, above the key or in its place.
std::string heading_line(const Figure& figure) {
  if (figure.heading.empty()) return "";
  const bool has_key = figure.plot.find("unset key") == std::string::npos;
  return std::string(has_key ? "set key title '" : "set title '") +
         replaced(figure.heading, "'", "''") + "' noenhanced\n";
}

/// Reason why gnuplot has not drawn a picture: the first 1000 characters of its messages.
std::string reason_of(int status, const std::string& messages) {
  if (status == 0) return "the picture is incomplete; is the disk full?";
  return one_line(without_panels(messages).substr(0, 1000));
}

}  // namespace

bool gnuplot_available() { return run_gnuplot(".", "", "--version", "/dev/null", -1) == 0; }

std::string gnuplot_script(const Figure& figure, const std::string& ending) {
  const std::string ahead = figure.heading.empty() ? "" : figure.heading + ": ";
  Values values = {{"unit", figure.length_unit.name},
                   {"ahead", replaced(ahead, "'", "''")},
                   {"length", format_number(figure.length_unit.per_metre)}};
  for (const TableRequest& table : figure.tables)
    values.emplace_back(table.name.substr(figure.name.size()),
                        "'data/" + table.name + ".csv' skip 1");
  const Values height = {{"height", format_number(figure.height)}};
  return filled(
      listed_text("script"),
      {{"name", figure.name},
       {"ending", ending},
       {"terminal", filled(listed_text("terminal", ending), height)},
       {"heading", heading_line(figure)},
       {"plot", filled(with_measured_panels(with_unbroken_labels(figure.plot)), values)}});
}

Drawing draw(const Figure& figure, const fs::path& folder, const std::string& ending, bool kept) {
  const fs::path pictures = folder / "pictures";
  OutputFile script(pictures / (figure.name + (kept ? "" : ending) + ".gp"));
  script.write(gnuplot_script(figure, ending));
  kept ? script.commit() : script.finish();
  OutputFile picture(pictures / (figure.name + ending));
  const std::string commands =
      "picture = '/dev/stdout'; measure = '" + listed_text("measure") + "'";
  const Messages messages;
  const int status =
      run_gnuplot(folder, commands, fs::absolute(kept ? script.target() : script.temporary()),
                  fs::absolute(picture.temporary()), messages.descriptor());
  std::string bytes = read_input(picture.temporary());
  if (status != 0 || !is_whole(bytes, ending)) {
    throw_if_interrupted();  // a terminal sends its signal to gnuplot as well
    throw OutputError("gnuplot could not draw " + figure.name + ": " +
                      reason_of(status, messages.text()));
  }
  if (kept) picture.commit();
  return {std::move(bytes), measured_panels(messages.text())};
}

}  // namespace holdfast::program
