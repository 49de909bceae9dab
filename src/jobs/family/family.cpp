#include "jobs/family/family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>

#include "case/uncertain.hpp"
#include "jobs/family/family_proof.hpp"
#include "jobs/job_texts.hpp"
#include "output/table.hpp"
#include "process/errors.hpp"
#include "process/exit.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Place = std::vector<double>;  // in the box, 0 … 1 along each key

/// A Latin-hypercube sample: each range is cut into `points` slices, with one random point in each.
std::vector<Place> latin_hypercube(std::size_t ranges, std::size_t points) {
  std::mt19937_64 random(20260117);
  std::vector<Place> places(points, Place(ranges));
  std::vector<std::size_t> slices(points);
  for (std::size_t k = 0; k < points; ++k) slices[k] = k;
  for (std::size_t range = 0; range < ranges; ++range) {
    // std::shuffle and its like differ from library to library.
    for (std::size_t k = points; k > 1; --k) std::swap(slices[k - 1], slices[random() % k]);
    for (std::size_t k = 0; k < points; ++k) {
      const double within = static_cast<double>(random() >> 11U) * 0x1p-53;
      places[k][range] = (static_cast<double>(slices[k]) + within) / static_cast<double>(points);
    }
  }
  return places;
}

std::vector<Place> places_in_box(std::size_t ranges, std::size_t draws) {
  std::vector<Place> places;
  if (ranges == 1) {
    for (std::size_t k = 0; k < draws; ++k)
      places.push_back({static_cast<double>(k) / static_cast<double>(draws - 1)});
    return places;
  }
  places.emplace_back(ranges, 0.5);
  constexpr std::size_t most = 10;  // of ranges whose corners are taken
  const std::size_t corners = ranges <= most ? std::size_t{1} << ranges : 0;
  for (std::size_t corner = 0; corner < corners && places.size() < draws; ++corner) {
    places.emplace_back(ranges);
    for (std::size_t k = 0; k < ranges; ++k) places.back()[k] = (corner >> k & 1U) != 0 ? 1.0 : 0.0;
  }
  if (places.size() < draws)
    for (Place& place : latin_hypercube(ranges, draws - places.size()))
      places.push_back(std::move(place));
  return places;
}

/// A column that decides which member of the family is worst.
struct Deciding {
  std::string column;
  bool largest;
};

std::vector<Deciding> deciding_columns(const std::string& job) {
  std::vector<Deciding> all;
  if (const toml::array* rows = job_texts()["worst"][job].as_array())
    for (const toml::node& node : *rows) {
      const toml::array& row = *node.as_array();
      all.push_back({text_of(row[0]), text_of(row[1]) == "largest"});
    }
  if (all.empty())
    throw WrongInput(
        "--family: " + job +
        " cannot compare the members of a family; the jobs stability, boundary "
        "--stable-interval, response, margins, max-delay, modal-damping and aeolian can");
  return all;
}

/// A cell of a table: a text, or a number.
struct Cell {
  std::string text;
  double number = std::numeric_limits<double>::quiet_NaN();
};
using Row = std::vector<Cell>;

Cell cell_of(ReceivedColumn& column, std::size_t row) {
  if (column.kind() == ReceivedColumn::Kind::numbers) return {"", column.numbers()[row]};
  const std::int64_t whole = column.whole_numbers()[row];
  if (column.kind() == ReceivedColumn::Kind::whole_numbers) return {"", static_cast<double>(whole)};
  return {column.words()[static_cast<std::size_t>(whole)]};
}

/// A table as columns and rows; the columns of a grid's axes come first.
struct Rows {
  std::vector<Column> columns;
  std::vector<Row> rows;

  explicit Rows(ReceivedTable table) {
    std::size_t count = table.columns.front().rows();
    for (const ReceivedAxis& axis : table.axes) columns.push_back(axis.about);
    for (const ReceivedColumn& column : table.columns) columns.push_back(column.about());
    for (std::size_t k = 0; k < count; ++k) {
      rows.emplace_back();
      std::size_t slower = count;
      for (const ReceivedAxis& axis : table.axes) {
        slower /= axis.values.size();
        rows.back().push_back({"", axis.values[k / slower % axis.values.size()]});
      }
      for (ReceivedColumn& column : table.columns) rows.back().push_back(cell_of(column, k));
    }
  }

  std::optional<std::size_t> place_of(const std::string& name) const {
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].name == name) return k;
    return std::nullopt;
  }
};

/// The worst row over the members added so far, for each row of the table.
class WorstRows {
 public:
  WorstRows(Rows first, const FamilyMember& member, const std::vector<Deciding>& deciding)
      : worst_(std::move(first)), members_(worst_.rows.size(), member.text()) {
    for (const Deciding& one : deciding)
      if (const auto place = worst_.place_of(one.column))
        deciding_.emplace_back(*place, one.largest);
    if (deciding_.empty())
      throw WrongInput(
          "--family: this table has no column that tells which member is worst; leave "
          "--family out");
  }

  void add(Rows rows, const FamilyMember& member) {
    if (rows.rows.size() != worst_.rows.size())
      throw NoAnswer("--family: member " + members_.front() + " gives " +
                     std::to_string(worst_.rows.size()) + " rows and member " + member.text() +
                     " gives " + std::to_string(rows.rows.size()) +
                     ", so that the rows cannot be compared: give narrower ranges in [uncertain]");
    for (std::size_t k = 0; k < rows.rows.size(); ++k) {
      if (!is_worse(rows.rows[k], worst_.rows[k])) continue;
      worst_.rows[k] = std::move(rows.rows[k]);
      members_[k] = member.text();
    }
  }

  void write(const JobContext& context) const {
    std::vector<Column> columns = worst_.columns;
    columns.push_back(
        {"worst_member", "", "member of the family with the values of the row", "string"});
    Table table(context, columns);
    for (std::size_t k = 0; k < worst_.rows.size(); ++k) {
      for (std::size_t n = 0; n < worst_.columns.size(); ++n)
        worst_.columns[n].datatype == "string" ? table.writer().cell(worst_.rows[k][n].text)
                                               : table.writer().cell(worst_.rows[k][n].number);
      table.writer().cell(members_[k]);
      table.writer().end_row();
    }
    table.commit();
  }

 private:
  bool is_worse(const Row& row, const Row& than) const {
    for (const auto& [column, largest] : deciding_) {
      const double here = row[column].number, there = than[column].number;
      if (here == there || std::isnan(here)) continue;
      return std::isnan(there) || (here > there) == largest;
    }
    return false;
  }

  Rows worst_;
  std::vector<std::string> members_;
  std::vector<std::pair<std::size_t, bool>> deciding_;  // column, whether the largest is worst
};

/// An end of an interval, and the member of the family that determines it.
struct End {
  double value;
  std::string member;
};

/// Stable intervals of a gain, ascending; each is a pair of lower and upper end.
using Intervals = std::vector<std::pair<End, End>>;

Intervals common_part(const Intervals& all, const Intervals& others) {
  Intervals common;
  for (const auto& one : all)
    for (const auto& other : others) {
      const End& lower = other.first.value > one.first.value ? other.first : one.first;
      const End& upper = other.second.value < one.second.value ? other.second : one.second;
      if (lower.value < upper.value) common.emplace_back(lower, upper);
    }
  return common;
}

/// Stable intervals of one gain, by the name of that gain and the value of the other gain.
using GainIntervals = std::map<std::pair<std::string, double>, Intervals>;

GainIntervals intervals_of(const Rows& table, const FamilyMember& member) {
  GainIntervals intervals;
  for (const Row& row : table.rows)
    intervals[{row[0].text, row[1].number}].emplace_back(End{row[2].number, member.text()},
                                                         End{row[3].number, member.text()});
  return intervals;
}

void write_common_intervals(const JobContext& context, const std::vector<FamilyMember>& members,
                            bool prove, const MemberAnswer& answer) {
  GainIntervals common;
  std::vector<Column> columns;
  for (const FamilyMember& member : members) {
    const Rows table(answer(member));
    columns = table.columns;
    if (columns.front().name != "gain")
      throw WrongInput("--family: boundary compares members only with --stable-interval; add it");
    GainIntervals own = intervals_of(table, member);
    if (&member == &members.front())
      common = std::move(own);
    else
      for (auto& [gain, intervals] : common) intervals = common_part(intervals, own[gain]);
  }
  columns.push_back(
      {"worst_member", "", "members that determine the lower and the upper end", "string"});
  Table table(context, columns);
  for (const auto& [gain, intervals] : common) {
    if (intervals.empty())
      report_warning("no " + gain.first + " is stable for all members of the family",
                     context.quiet);
    for (const auto& [lower, upper] : intervals) {
      std::optional<Interval<double>> interval = Interval<double>{lower.value, upper.value};
      if (prove) interval = proved_interval(context, gain.first, gain.second, *interval);
      if (interval)
        table.row(
            gain.first, gain.second, interval->lower, interval->upper,
            lower.member == upper.member ? lower.member : lower.member + " | " + upper.member);
      else
        report_warning("the interval of the " + gain.first + " from " + format_number(lower.value) +
                           " to " + format_number(upper.value) +
                           " is left out: the computed members are stable in it, but stability of "
                           "all members of the family is not proved",
                       context.quiet);
    }
  }
  table.commit();
}

}  // namespace

double FamilyMember::value_of(const std::string& key) const {
  for (const auto& [name, value] : values)
    if (name == key) return value;
  return std::nan("");
}

std::vector<std::string> FamilyMember::overrides() const {
  std::vector<std::string> all;
  for (const auto& [key, value] : values) all.push_back(key + "=" + format_number(value));
  return all;
}

std::string FamilyMember::text() const {
  std::string text;
  for (const std::string& setting : overrides()) text += (text.empty() ? "" : ";") + setting;
  return text;
}

std::vector<FamilyMember> family_members(const Case& the_case, int draws) {
  const std::vector<UncertainRange> ranges = uncertain_ranges(the_case);
  if (ranges.empty())
    throw WrongInput(
        "--family: the case has no [uncertain]; give a key a range, as by --set "
        "'uncertain.absorber.mass=± 5 %'");
  std::vector<FamilyMember> members;
  for (const Place& place : places_in_box(ranges.size(), static_cast<std::size_t>(draws))) {
    members.emplace_back();
    for (std::size_t k = 0; k < ranges.size(); ++k)
      members.back().values.emplace_back(
          ranges[k].key, ranges[k].lowest + place[k] * (ranges[k].highest - ranges[k].lowest));
  }
  return members;
}

void write_worst_of_family(const JobContext& context, int draws, bool prove,
                           const MemberAnswer& answer) {
  const std::vector<FamilyMember> members = family_members(context.case_data, draws);
  const std::vector<Deciding> deciding = deciding_columns(context.job);
  if (!prove)
    report_warning("each row is the worst of the " + std::to_string(members.size()) +
                       " members computed; other members of the family are not covered",
                   context.quiet);
  const bool intersects = deciding.front().column == "intersection";
  if (intersects) return write_common_intervals(context, members, prove, answer);
  std::optional<WorstRows> worst;
  for (const FamilyMember& member : members) {
    Rows rows(answer(member));
    worst ? worst->add(std::move(rows), member)
          : void(worst.emplace(std::move(rows), member, deciding));
  }
  worst->write(context);
}

}  // namespace holdfast::program
