#include "output/metadata.hpp"

#include <cctype>

#include "case/case_file.hpp"
#include "case/model/own/own_parts.hpp"
#include "io/file/build_record.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Json = nlohmann::ordered_json;

/// A file name as a relative URL.
std::string url_of(const std::string& file_name) {
  constexpr const char* hexadecimal = "0123456789ABCDEF";
  const std::string plain = "-._~";
  std::string url;
  for (const char character : file_name) {
    const auto code = static_cast<unsigned char>(character);
    const bool alphanumeric = code < 0x80 && std::isalnum(code) != 0;
    if (alphanumeric || plain.find(character) != std::string::npos) {
      url += character;
    } else {
      url += '%';
      url += hexadecimal[code / 16];
      url += hexadecimal[code % 16];
    }
  }
  return url;
}

Json column_metadata(const Column& column) {
  Json json = {{"name", column.name}, {"titles", column.name}, {"datatype", column.datatype}};
  if (!column.description.empty()) json["dc:description"] = column.description;
  if (!column.unit.empty()) json["schema:unitText"] = column.unit;
  return json;
}

Json origin(const JobContext& context) {
  Json options = Json::object();
  for (const auto& [name, text] : context.options) {
    // An option may be given more than once.
    if (!options.contains(name)) {
      options[name] = text;
    } else if (options[name].is_array()) {
      options[name].push_back(text);
    } else {
      options[name] = Json::array({options[name], text});
    }
  }
  Json built_with = Json::object();
  for (const Dependency& dependency : dependencies())
    built_with[dependency.name] = dependency.version;
  Json json = {{"version", computed_by(context)},
               {"compiler", compiler_text()},
               {"built_with", built_with},
               {"job", context.job},
               {"options", options}};
  if (context.on_packs) json["instructions"] = name_of(context.instructions);
  if (has_own_plant(context.case_data))
    json["own_plant"] = {{"order", context.case_data.own->plant->order()}};
  json["case"] = case_to_json(context.case_data);
  for (const auto& [name, text] : context.notes) json[name] = text;
  return json;
}

void append_trust(Json& json, const TrustedDigits& trusted) {
  if (!is_worth_telling(trusted)) return;
  json["trusted_digits"] = trusted.digits;
  if (trusted.until) json["trusted_until_s"] = *trusted.until;
  if (!trusted.least.empty()) json["least_trusted"] = trusted.least;
}

Json of_file(const Written& file) {
  return {{"bytes", file.bytes}, {"crc64_xz", hexadecimal(file.checksum, 16)}};
}

/// Adds the file name (as URL) and the title to the JSON.
void add_names(Json& json, const JobContext& context, const std::string& file_name) {
  json["url"] = url_of(file_name);
  json["dc:title"] = "holdfast " + context.job;
}

}  // namespace

Json picture_metadata(const JobContext& context, const std::string& file_name,
                      const Written& picture) {
  Json json, note = {{"holdfast", origin(context)}};
  note["holdfast"]["picture"] = of_file(picture);
  add_names(json, context, file_name);
  json["notes"] = Json::array({note});
  return json;
}

Json table_metadata(const JobContext& context, const std::vector<Column>& columns,
                    const std::string& file_name, const TrustedDigits& trusted,
                    const std::optional<Written>& table) {
  Json json = {{"@context", "http://www.w3.org/ns/csvw"}}, note = {{"holdfast", origin(context)}};
  append_trust(note["holdfast"], trusted);
  if (table) note["holdfast"]["table"] = of_file(*table);
  add_names(json, context, file_name);
  Json& described = json["tableSchema"]["columns"] = Json::array();
  for (const Column& column : columns) described.push_back(column_metadata(column));
  json["notes"] = Json::array({note});
  return json;
}

std::string origin_text(const JobContext& context, const TrustedDigits& trusted) {
  Json json = origin(context);
  append_trust(json, trusted);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::filesystem::path metadata_path(const std::filesystem::path& file) {
  return file.parent_path() / (file.filename().string() + "-metadata.json");
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace holdfast::program
