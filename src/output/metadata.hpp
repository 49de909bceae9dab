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
/// without folder. Units are `schema:unitText`. `notes[0].holdfast` holds version, job, options and
/// the full case. There is no date: the same question gives the same bytes.
/// Where fewer than six digits of the table are to be trusted, `trusted_digits` says how many, with
/// `trusted_until_s` and `largest_exponent_per_s` with its standard error for a motion, and
/// `least_trusted` for a table of single quantities.
nlohmann::ordered_json table_metadata(const JobContext& context, const std::vector<Column>& columns,
                                      const std::string& file_name,
                                      const TrustedDigits& trusted = {},
                                      const std::optional<Written>& table = std::nullopt);

/// Text of `notes[0].holdfast`, in one line.
std::string origin_text(const JobContext& context, const TrustedDigits& trusted);

/// Metadata of a picture, which has no columns.
nlohmann::ordered_json picture_metadata(const JobContext& context, const std::string& file_name,
                                        const Written& picture);

/// FILE-metadata.json beside FILE.
std::filesystem::path metadata_path(const std::filesystem::path& file);

/// The JSON as it is written: indented, with a final line end. Text that is not UTF-8 is mended.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace holdfast::program
