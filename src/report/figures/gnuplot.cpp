#include "report/figures/gnuplot.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/file/input.hpp"
#include "io/file/output.hpp"
#include "io/text/text.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"

namespace holdfast::program {
namespace {

// Colours of M. Okabe and K. Ito, told apart by all kinds of colour vision; dashes tell them apart
// in grey.
constexpr const char* gnuplot_style =
    "set encoding utf8\n"
    "set datafile separator comma\n"
    "set datafile missing 'nan'\n"
    "set border 3 lw 0.8 lc rgb '#444444'\n"
    "set tics nomirror out textcolor rgb '#222222'\n"
    "set grid lw 0.5 lc rgb '#dddddd' dt 1\n"
    "set style line 1 lw 1.6 lc rgb '#0072b2'\n"
    "set style line 2 lw 1.6 lc rgb '#d55e00' dt (8,3)\n"
    "set style line 3 lw 1.6 lc rgb '#009e73' dt (3,2)\n"
    "set style line 4 lw 1.6 lc rgb '#777777'\n"
    "set key outside top center horizontal samplen 3\n";

/// The commands with blanks in the labels of x and y that do not break, as those beside a change of
/// font are lost in SVG. Inside the braces the blank belongs to gnuplot's syntax.
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

/// Runs gnuplot in a folder: commands, then a script or an option. Its messages go to a file. Gives
/// its exit status, or −1 if it could not start.
int run_gnuplot(const std::filesystem::path& folder, const std::string& commands,
                const std::string& argument, const std::filesystem::path& messages) {
  const std::string place = folder.string();
  const std::string message_file = messages.string();
  const pid_t child = fork();
  if (child < 0) return -1;
  if (child == 0) {
    const int null_input = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int log = open(message_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (null_input < 0 || log < 0 || chdir(place.c_str()) != 0) _exit(127);
    dup2(null_input, STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    restore_signals_of_child();
    execlp("gnuplot", "gnuplot", "-e", commands.c_str(), argument.c_str(),
           static_cast<char*>(nullptr));
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The name of a file that gnuplot writes and that goes with the object.
class PassingFile {
 public:
  explicit PassingFile(const std::filesystem::path& path)
      : path_(std::filesystem::absolute(path)), guard_(path_.c_str()) {}
  ~PassingFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  PassingFile(PassingFile&&) = delete;
  PassingFile& operator=(PassingFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  RemovedBySignal guard_;
};

void write_file(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace

bool gnuplot_available() { return run_gnuplot(".", "", "--version", "/dev/null") == 0; }

std::string gnuplot_script(const Figure& figure) {
  std::string plot = with_unbroken_labels(figure.plot);
  for (const TableRequest& table : figure.tables)
    plot = replaced(plot, "@" + table.name.substr(figure.name.size()) + "@",
                    "'data/" + table.name + ".csv' skip 1");
  plot = filled(plot, {{"unit", figure.length_unit.name},
                       {"length", format_number(figure.length_unit.per_metre)}});
  return "set terminal svg size 640," + format_number(figure.height) +
         " dynamic enhanced standalone font 'Helvetica,Arial,sans-serif,13' background rgb "
         "'white'\n" +
         "if (!exists('picture')) picture = 'pictures/" + figure.name +
         ".svg'\nset output picture\n" + gnuplot_style + plot + "unset output\n";
}

void draw(const Figure& figure, const std::filesystem::path& folder) {
  const std::filesystem::path pictures = folder / "pictures";
  const std::filesystem::path script = pictures / (figure.name + ".gp");
  const PassingFile partial(pictures / (figure.name + ".svg.partial"));
  const PassingFile messages(pictures / (figure.name + ".log.partial"));
  write_file(script, gnuplot_script(figure));
  const int status = run_gnuplot(folder, "picture = 'pictures/" + figure.name + ".svg.partial'",
                                 "pictures/" + figure.name + ".gp", messages.path());
  if (status != 0) {
    throw_if_interrupted();  // a terminal sends its signal to gnuplot as well
    throw OutputError("gnuplot could not draw " + figure.name + ": " +
                      one_line(read_input(messages.path())));
  }
  std::filesystem::rename(partial.path(), pictures / (figure.name + ".svg"));
}

}  // namespace holdfast::program
