#include "report/page/report.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "case/axes/axis.hpp"
#include "io/file/folder_lock.hpp"
#include "io/file/output.hpp"
#include "io/file/own_folder.hpp"
#include "output/metadata.hpp"
#include "process/errors.hpp"
#include "report/figures/figure.hpp"
#include "store/work_store.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* passing_folder = "holdfast-picture-";
constexpr std::array<const char*, 2> parts = {"data", "pictures"};

/// Whether a file name is that of a table, script, picture or their metadata.
bool is_of_picture(const fs::path& name) {
  const std::string ending = name.extension().string();
  return ending == ".csv" || ending == ".json" || ending == ".gp" || ending == ".tmp" ||
         is_picture_name(name);
}

/// Removes the files of pictures from a folder, and the folder if it is then empty.
void remove_passing(const fs::path& path) {
  const OwnFolder folder(path);
  for (const char* part : parts) {
    const OwnFolder inner(folder, part);
    if (!inner.is_open()) continue;
    for (const std::string& name : inner.names()) {
      if (is_of_picture(name)) inner.remove_file(name);
      if (is_store_name(name)) remove_left_work_store(path / part / name);
    }
    folder.remove_empty_folder(part);
  }
  folder.remove_file(FolderLock::file_name, true);
  rmdir(path.c_str());
}

/// Removes files left by programs that were killed while drawing.
void remove_left_passing() {
  for (const fs::path& left : passing_folders(passing_folder)) {
    std::error_code ignored;
    if (!OwnFolder(left).is_open() || !fs::exists(left / FolderLock::file_name, ignored)) continue;
    try {
      const FolderLock held(left);
      remove_passing(left);
    } catch (const Refusal&) {
      // Another program has it.
    }
  }
}

/// Temporary folder for the tables of one picture.
class PassingFolder {
 public:
  PassingFolder() : path_(new_passing_folder(passing_folder)), lock_(path_) {
    remove_left_passing();
    for (const char* part : parts) fs::create_directory(path_ / part);
  }
  ~PassingFolder() { remove_passing(path_); }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;

  fs::path table(const std::string& name) const { return path_ / "data" / (name + ".csv"); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  FolderLock lock_;
};

bool is_given(const PictureRequest& request, const std::string& option) {
  return std::any_of(request.context.options.begin(), request.context.options.end(),
                     [&](const auto& given) { return given.first == option; }) ||
         std::find(request.own.begin(), request.own.end(), option + "=true") != request.own.end();
}

std::string option_text(const PictureRequest& request, const std::string& option) {
  return filled("@" + option + "@", request.options);
}

/// Range of an option for a gain as the picture's job uses it.
std::string shown_option(const PictureRequest& request, const std::string& option) {
  return shown_gains(request.context, option, option_text(request, option));
}

/// The row of the list `pictures` that describes the picture of the requested table.
const toml::array& row_for(const PictureRequest& request) {
  const std::string& job = request.context.job;
  std::string needed;
  for (const toml::node& node : listed_pictures()) {
    const toml::array& row = *node.as_array();
    const std::string option = text_of(row[1]);
    if (text_of(row[0]) != job) continue;
    needed = option;
    if (!option.empty() && !is_given(request, option)) continue;
    if (!text_of(row[2]).empty()) return row;
    throw WrongInput("--output " + request.context.output->string() + ": " + job + " " + option +
                     " has no picture; give a name that ends in .csv");
  }
  throw WrongInput("--output " + request.context.output->string() + ": " + job +
                   " draws a picture only with " + needed + "; or give a name that ends in .csv");
}

/// Keys and values of the table's axes; for a chart over P and D, the gains.
std::vector<KeyValues> axes_of(const PictureRequest& request) {
  std::vector<KeyValues> axes;
  const std::string& job = request.context.job;
  const std::string axis_option = is_given(request, "--map") ? "--map" : "--axis";
  // The border of a motion has no cells.
  const std::string count = job == "orbit" ? ":2" : "";
  for (const auto& [name, text] : request.context.options)
    if (name == axis_option) axes.push_back(parse_key_values(name, text + count));
  if (axes.empty() && job == "diagram")
    return {parse_key_values("--axis", option_text(request, "--axis"))};
  if (!axes.empty() || (job != "stability" && job != "response")) return axes;
  return {{"control.proportional_gain", parse_axis("--p", shown_option(request, "--p"))},
          {"control.differential_gain", parse_axis("--d", shown_option(request, "--d"))}};
}

/// Throws WrongInput for an axis with a single value, or a list where an image needs even steps.
MapAxis map_axis_of(const KeyValues& axis, bool even) {
  MapAxis shown{axis.key, 0.0, 0.0, false, label_of(axis.key), scale_of(axis.key)};
  std::int64_t count = 0;
  const auto take = [&](const auto& range) {
    count = range.count;
    shown.min = range.min;
    shown.max = range.max;
  };
  if (const auto* list = std::get_if<std::vector<double>>(&axis.values)) {
    if (even)
      throw WrongInput("--axis " + axis.key + ": a picture over two axes needs MIN:MAX:COUNT");
    const auto [min, max] = std::minmax_element(list->begin(), list->end());
    take(Axis{*min, *max, static_cast<std::int64_t>(list->size())});
  } else if (const auto* ratios = std::get_if<LogAxis>(&axis.values)) {
    shown.logarithmic = true;
    take(*ratios);
  } else {
    take(std::get<Axis>(axis.values));
  }
  if (count < 2)
    throw WrongInput("a picture needs at least two values of " + axis.key + " along its axis");
  return shown;
}

/// Range of an axis in gnuplot's notation MIN:MAX.
std::string ends_of(const Axis& axis) {
  return format_number(axis.min) + ":" + format_number(axis.max);
}

/// Step of an axis in displayed units; 0 for an axis without equal steps.
double step_of(const KeyValues& axis) {
  const auto* const even = std::get_if<Axis>(&axis.values);
  if (even == nullptr || even->count < 2) return 0.0;
  return (even->max - even->min) / static_cast<double>(even->count - 1) * scale_of(axis.key);
}

/// Replacements of @KEY@ for a picture over axes.
Values values_of_axes(const std::vector<KeyValues>& axes) {
  if (axes.size() > 2)
    throw WrongInput("a picture shows one axis or two, not " + std::to_string(axes.size()));
  Values values;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const MapAxis axis = map_axis_of(axes[k], axes.size() == 2);
    const std::string letter = k == 0 ? "x" : "y";
    const Values shown = joined(values_of(letter, axis, "$" + std::to_string(k + 1)),
                                {{letter + " scale", format_number(axis.scale)},
                                 {letter + " step", format_number(step_of(axes[k]))}});
    values =
        joined(joined(values, shown), {{"label", axis.label},
                                       {"scale", format_number(axis.scale)},
                                       {k == 0 ? "P" : "D", ends_of({axis.min, axis.max, 2})}});
  }
  return values;
}

/// All replacements of @KEY@ for the requested picture.
Values picture_values(const PictureRequest& request) {
  const Case& the_case = request.context.case_data;
  const std::string& job = request.context.job;
  Values values = {{"greatest frequency", greatest_frequency(the_case)}};
  if (job == "boundary") {
    const Range p = parse_range("--p", shown_option(request, "--p"));
    values.emplace_back("P", ends_of({p.min, p.max, 2}));
    values = joined(values, window_of_gains(the_case));
  }
  // From where on exponents are shown: the first ones leave no room for the rest.
  const double duration = parse_number(option_text(request, "--duration")).value_or(0.0);
  values.emplace_back("tenth", format_number(0.1 * duration));
  if (job == "max-delay") {
    const Axis axis = parse_axis("--frequency", option_text(request, "--frequency"));
    values.emplace_back("F", ends_of(axis) + ":" + std::to_string(axis.count));
  }
  return joined(joined(values, span_values(the_case)), values_of_axes(axes_of(request)));
}

/// Command line that writes a table; a `command` that begins with "own" extends that of the job.
std::vector<std::string> command_line(const PictureRequest& request, const std::string& command) {
  std::vector<std::string> words = words_of(command);
  if (command.rfind("own", 0) != 0) {
    words.emplace_back("--quiet");
    return command_of(words, request.case_arguments);
  }
  words.erase(words.begin());
  return joined(request.own, words);
}

/// Writes the tables of a picture; returns the job's own table, or else the first.
CsvTable written_tables(const PictureRequest& request, const CommandRunner& run,
                        const toml::array& tables, const Values& values,
                        const PassingFolder& folder) {
  fs::path own;
  for (const toml::node& node : tables) {
    const toml::array& table = *node.as_array();
    const fs::path file = folder.table(request.context.job + text_of(table[0]));
    const std::string command = text_of(table[1], values);
    run(joined(command_line(request, command), {"--output", file.string()}));
    if (own.empty() || command == "own") own = file;
  }
  return read_csv(own);
}

/// Bytes of a picture; a PDF gets a constant date, so that equal requests give equal bytes.
std::string without_date(std::string picture) {
  const std::string before = "/CreationDate (D:", none = "19700101000000";
  const std::size_t at = picture.find(before);
  if (at != std::string::npos) picture.replace(at + before.size(), none.size(), none);
  return picture;
}

std::string drawn_picture(const PictureRequest& request, const CommandRunner& run) {
  const toml::array& row = row_for(request);
  const std::size_t axes = axes_of(request).size();
  const std::string listed = text_of(row[2]);
  const std::string kind = listed == "cells" && axes < 2 ? "lines" : listed;
  Values values = joined(values_of(*row[3].as_table()), picture_values(request));
  if (!gnuplot_available())
    throw NoAnswer(
        "pictures need gnuplot, which is not installed (Debian package gnuplot-nox); an "
        "--output that ends in .csv needs none");
  const PassingFolder folder;
  const CsvTable table = written_tables(request, run, *row[5].as_array(), values, folder);
  const LengthUnit unit = length_unit_for(largest_length(table));
  std::vector<Values> panels;
  if (listed == "cells") panels = panels_of(table, axes, unit);
  values.emplace_back("panels", std::to_string(panels.size()));
  Figure figure = figure_of_kind({request.context.job, "", "", {}, "", 0.0}, kind,
                                 row[5].as_array(), values, panels);
  figure.height *= static_cast<double>(std::max<std::size_t>(panels.size(), 1));
  figure.length_unit = unit;
  const std::string stem = fs::path(request.context.case_source.name).stem().string();
  figure.heading = text_of(row[4]) + " — " + (stem.empty() ? "the built-in case" : one_line(stem));
  const std::string ending = request.context.output->extension().string();
  return without_date(draw(figure, folder.path(), ending).bytes);
}

}  // namespace

bool has_picture(const std::string& job) {
  const toml::array& rows = listed_pictures();
  return std::any_of(rows.begin(), rows.end(),
                     [&](const toml::node& row) { return text_of((*row.as_array())[0]) == job; });
}

void write_picture(const PictureRequest& request, const CommandRunner& run) {
  OutputFile picture(request.context.output);
  std::unique_ptr<OutputFile> metadata;
  if (picture.is_file()) metadata = std::make_unique<OutputFile>(metadata_path(picture.target()));
  picture.write(drawn_picture(request, run));
  if (!metadata) return picture.commit();
  const std::string name = picture.target().filename().string();
  metadata->write(json_text(picture_metadata(request.context, name, picture.written())));
  commit_together(picture, *metadata);
}

}  // namespace holdfast::program
