#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "io/text/csv.hpp"
#include "output/trusted_digits.hpp"

namespace holdfast::program {

/// Origin and columns of a table, as W3C CSV on the Web metadata. `file_name` is the table's name
/// without folder. Units are `schema:unitText`. `notes[0].holdfast` contains version, job, options
/// and the full case. There is no date: an equal job gives equal bytes. If the table has fewer than
/// six trusted digits, `trusted_digits` is their number. For a motion `trusted_until_s` is added;
/// for a table of single quantities `least_trusted`.
nlohmann::ordered_json table_metadata(const JobContext& context, const std::vector<Column>& columns,
                                      const std::string& file_name,
                                      const TrustedDigits& trusted = {},
                                      const std::optional<Written>& table = std::nullopt);

/// The content of `notes[0].holdfast` as JSON in one line.
std::string origin_text(const JobContext& context, const TrustedDigits& trusted);

/// Metadata of a picture, which has no columns.
nlohmann::ordered_json picture_metadata(const JobContext& context, const std::string& file_name,
                                        const Written& picture);

/// Path of the metadata file of FILE: FILE-metadata.json in the folder of FILE.
std::filesystem::path metadata_path(const std::filesystem::path& file);

/// The text of a JSON file: indented, with a final line end; bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace holdfast::program
