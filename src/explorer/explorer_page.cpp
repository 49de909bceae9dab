#include "explorer/explorer_page.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "case/case_file.hpp"
#include "case/model/cable_of_case.hpp"
#include "io/file/output.hpp"
#include "io/file/whole_file.hpp"
#include "process/errors.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

namespace fs = std::filesystem;

/// Placeholder of the case in the page.
constexpr const char* empty_case = R"({"name":"","text":""})";

/// Folder of the library that contains the program; empty for the program itself.
fs::path folder_of_library;

/// Paths of the page beside the program, as installed and as built, or in the library's folder.
std::vector<fs::path> places_of_page() {
  if (!folder_of_library.empty()) return {folder_of_library / "explorer.html"};
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  return {folder.parent_path() / "share/holdfast/explorer.html",
          folder.parent_path().parent_path() / "wasm/explorer.html"};
}

[[noreturn]] void refuse_without_page() {
  std::string places;
  for (const fs::path& place : places_of_page())
    places += (places.empty() ? "no " : " and no ") + place.string();
  throw NoAnswer("the explorer's page was not built: " + places +
                 "; make it in the project's folder by ./run --explorer" +
                 (folder_of_library.empty() ? "" : ", then install it by pip install ."));
}

std::optional<fs::path> built_page() {
  std::error_code ignored;
  for (const fs::path& place : places_of_page())
    if (fs::is_regular_file(place, ignored)) return place;
  return std::nullopt;
}

/// The text of the case file, empty for the built-in case. The full case, if keys were set or the
/// plant is reduced, since a browser may be unable to reduce it.
std::string text_of_case(const Case& the_case, const CaseSource& source) {
  if (source.overrides.empty() && !plant_is_reduced(source.load())) return source.text.value_or("");
  return case_to_toml(the_case);
}

}  // namespace

void look_for_explorer_page_in(fs::path folder) { folder_of_library = std::move(folder); }

bool can_explore(const Case& the_case) {
  return built_page().has_value() && the_case.excitation.record.empty();
}

void write_explorer_page(const fs::path& output, const Case& the_case, const CaseSource& source) {
  if (!the_case.excitation.record.empty())
    throw WrongInput("excitation.record: the explorer cannot include a recorded force; remove it");
  const std::optional<fs::path> file = built_page();
  if (!file) refuse_without_page();
  const std::string name =
      source.overrides.empty() || source.name.empty() ? source.name : source.name + " with --set";
  const nlohmann::ordered_json json = {{"name", name}, {"text", text_of_case(the_case, source)}};
  OutputFile page(output);
  // The strings must not contain a tag.
  page.write(replaced(read_input(*file), empty_case, replaced(json.dump(), "<", "\\u003c")));
  page.commit();
}

}  // namespace holdfast::program
