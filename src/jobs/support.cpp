#include "jobs/support.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "case/model/own/own_parts.hpp"
#include "jobs/job_texts.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Words = std::vector<std::string>;

Words words_of(const toml::node_view<const toml::node>& node) {
  return program::words_of(node.as_array());
}

Words words_in(const std::string& text) {
  const auto parts = split(text, ' ');
  return {parts.begin(), parts.end()};
}

/// Feature of a case, with its name in texts/support.toml and the test whether a case has it.
struct Feature {
  std::string name;
  bool (*is_of)(const Case& the_case);
};

bool has_law(const Case& the_case, const char* law) { return the_case.backlash.law == law; }

const std::vector<Feature>& features() {
  static const std::vector<Feature> all = {
      // A span without an absorber has none, whatever plant.model says by itself.
      {"two_masses",
       [](const Case& of) { return is_two_masses(of) && !(of.stands_alone && !has_absorber(of)); }},
      {"string", [](const Case& of) { return of.plant.model == "string" && !has_own_plant(of); }},
      {"cable", [](const Case& of) { return is_cable(of) && !has_own_plant(of); }},
      {"infinite_string", [](const Case& of) { return is_infinite(of) && !has_own_plant(of); }},
      {"devices", [](const Case& of) { return !of.devices.empty() && !is_two_masses(of); }},
      {"devices_on_two_masses",
       [](const Case& of) { return !of.devices.empty() && is_two_masses(of); }},
      {"own_plant", has_own_plant},
      {"own_controller", [](const Case& of) { return of.own != nullptr && of.own->controller; }},
      {"filter", [](const Case& of) { return std::isfinite(of.control.measurement_filter); }},
      {"lag", [](const Case& of) { return std::isfinite(of.control.drive_bandwidth); }},
      {"late",
       [](const Case& of) { return of.control.processing_delay > of.control.sampling_period; }},
      {"difference", [](const Case& of) { return of.control.velocity == "difference"; }},
      {"quantum",
       [](const Case& of) {
         return of.control.displacement_quantum > 0.0 ||
                (of.control.velocity_quantum > 0.0 && of.control.velocity == "measured");
       }},
      {"largest_force", [](const Case& of) { return std::isfinite(of.control.largest_force); }},
      {"jitter", [](const Case& of) { return of.control.jitter > 0.0; }},
      {"harmonics",
       [](const Case& of) {
         return !of.excitation.harmonics.empty() || of.excitation.noise_rms > 0.0;
       }},
      {"record",
       [](const Case& of) { return of.force_record != nullptr || !of.excitation.record.empty(); }},
      {"immediate", [](const Case& of) { return has_law(of, "immediate"); }},
      {"play", [](const Case& of) { return has_law(of, "play"); }},
      {"dead_zone", [](const Case& of) { return has_law(of, "dead_zone"); }}};
  return all;
}

/// Names of all features, and of "exact", which is an option.
Words feature_names() {
  Words names;
  for (const Feature& feature : features()) names.push_back(feature.name);
  names.emplace_back("exact");
  return names;
}

/// Whether a feature is a plant, of which a case has only one.
bool is_of_plant(const std::string& name) {
  const Words plants = {"two_masses",      "string",  "cable",
                        "infinite_string", "devices", "devices_on_two_masses",
                        "own_plant"};
  return std::find(plants.begin(), plants.end(), name) != plants.end();
}

struct Rule {
  Words asked, unless, of, also, but;
  std::string refuses, idealises;
};

struct Rulebook {
  toml::table texts;
  std::vector<Rule> rules;
};

const Rulebook& table() {
  static const Rulebook all = [] {
    Rulebook read{toml::parse(support_texts), {}};
    for (const toml::node& node : *read.texts["rules"].as_array()) {
      const toml::node_view<const toml::node> rule(node);
      read.rules.push_back({words_of(rule["asked"]), words_of(rule["unless"]), words_of(rule["of"]),
                            words_of(rule["and"]), words_of(rule["but"]),
                            rule["refuses"].value_or(std::string()),
                            rule["idealises"].value_or(std::string())});
    }
    return read;
  }();
  return all;
}

std::string words_of_feature(const std::string& name) {
  return text_of(table().texts["features"][name]["words"]);
}

bool any_asked(const Words& questions, const Asked& asked) {
  return std::any_of(questions.begin(), questions.end(),
                     [&](const std::string& words) { return asked.has(words); });
}

/// First of a case's features `there` that is among those `wanted`; empty if none is.
std::string first_of(const Words& wanted, const Words& there) {
  for (const std::string& name : there)
    if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) return name;
  return "";
}

/// The part of the question, job or job with options, to which a rule applies.
std::string asked_words(const Rule& rule, const Asked& asked) {
  for (const std::string& words : rule.asked)
    if (asked.has(words)) return words;
  return asked.job;
}

Support support_of(const Words& there, const Asked& asked) {
  Support support;
  for (const Rule& rule : table().rules) {
    if (!any_asked(rule.asked, asked) || any_asked(rule.unless, asked)) continue;
    const std::string feature = first_of(rule.of, there);
    const std::string other = rule.also.empty() ? feature : first_of(rule.also, there);
    if (feature.empty() || other.empty() || !first_of(rule.but, there).empty()) continue;
    const std::string with =
        words_of_feature(feature) + (rule.also.empty() ? "" : " and " + words_of_feature(other));
    support.reason = rule.refuses.empty() ? rule.idealises : rule.refuses;
    if (!rule.refuses.empty()) {
      const std::string question = asked_words(rule, asked);
      support.refusal = question + " cannot answer for " + with + ": " + rule.refuses;
      if (question == asked.job && rule.also.empty()) support.refused_by = feature;
      return support;
    }
    for (const std::string& name : there)
      if (std::find(rule.of.begin(), rule.of.end(), name) != rule.of.end())
        support.idealised += (support.idealised.empty() ? "" : "; ") + words_of_feature(name) +
                             ": " + asked.job + " is computed " + rule.idealises;
  }
  return support;
}

/// Question from its text in texts/support.toml: job and options, as on a command line.
Asked asked_of(const std::string& question) {
  const Words words = words_in(question);
  Asked asked{words[0], {}};
  for (std::size_t k = 1; k < words.size(); ++k) {
    if (words[k].rfind("--", 0) != 0) continue;
    asked.options.push_back(words[k]);
    if (k + 1 < words.size() && words[k + 1].rfind("--", 0) != 0)
      asked.options.push_back(words[k] + " " + words[k + 1]);
  }
  return asked;
}

/// Jobs that no rule refuses for a feature, separated by commas.
std::string jobs_that_answer(const std::string& feature, const Words& there) {
  std::map<std::string, bool> answers;
  for (const SupportCell& cell : support_cells())
    if (cell.features.back() == feature) {
      const std::string job = words_in(cell.question)[0];
      const auto known = answers.try_emplace(job, false).first;
      known->second = known->second || support_of(there, asked_of(cell.question)).refusal.empty();
    }
  std::string names;
  for (const auto& [job, does] : answers)
    if (does) names += (names.empty() ? "" : ", ") + job;
  return names;
}

}  // namespace

bool Asked::has(const std::string& words) const {
  const Words all = words_in(words);
  if (all.empty() || (all[0][0] != '-' && all[0] != job)) return false;
  std::size_t k = all[0][0] == '-' ? 0 : 1;
  for (; k < all.size(); ++k) {
    // A word after an option that begins with no dash is its value.
    std::string wanted = all[k];
    if (k + 1 < all.size() && all[k + 1][0] != '-') wanted += " " + all[++k];
    if (std::find(options.begin(), options.end(), wanted) == options.end()) return false;
  }
  return true;
}

Support support_of(const Case& the_case, const Asked& asked) {
  Words there;
  for (const Feature& feature : features())
    if (feature.is_of(the_case)) there.push_back(feature.name);
  if (asked.has("--switching exact")) there.emplace_back("exact");
  if (has_active_absorber(the_case)) there.emplace_back("computer");
  Support support = support_of(there, asked);
  // Whose job as a whole does not answer asks which do.
  if (is_of_plant(support.refused_by))
    support.refusal += "; jobs that can answer are " +
                       jobs_that_answer(words_of_feature(support.refused_by), there);
  return support;
}

namespace {

/// Cell of the support table. @param named  features; a plant, at most one, comes first
SupportCell cell_of(const std::string& question, const Words& named) {
  SupportCell cell{question, {}, {}, true, {}};
  Words there = named;
  if (named[0] == "devices") there.insert(there.begin(), "string");
  if (!is_of_plant(named[0]) || named[0] == "devices_on_two_masses")
    there.insert(there.begin(), "two_masses");
  for (const std::string& name : named) {
    const auto feature = table().texts["features"][name];
    const Words set = words_of(feature["set"]);
    const auto option = feature["option"].value<std::string>();
    cell.features.push_back(words_of_feature(name));
    cell.settings.insert(cell.settings.end(), set.begin(), set.end());
    if (option) cell.question += " " + *option;
    cell.can_be_asked = cell.can_be_asked && (option || !set.empty());
  }
  const auto says = [&](const char* table) {
    return std::any_of(cell.settings.begin(), cell.settings.end(),
                       [&](const std::string& setting) { return setting.rfind(table, 0) == 0; });
  };
  // The built-in absorber is not on a span of other devices until something is said of it.
  if (!says("device.") || says("control.")) there.emplace_back("computer");
  cell.support = support_of(there, asked_of(cell.question));
  return cell;
}

/// The question with only those options that occur in the rules, each once: "orbit --map".
std::string without_numbers(const std::string& question) {
  const Words words = words_in(question);
  std::string kept = words[0];
  for (const std::string& option : asked_of(question).options) {
    const auto speaks = [&](const Rule& rule) {
      return std::any_of(rule.asked.begin(), rule.asked.end(), [&](const std::string& of) {
        return of.rfind(words[0] + " ", 0) == 0 &&
               (of + " ").find(" " + option + " ") != std::string::npos;
      });
    };
    const auto& rules = table().rules;
    const bool is_named = option.find_first_of("0123456789:") == std::string::npos &&
                          (std::any_of(rules.begin(), rules.end(), speaks) ||
                           option == "--stable-interval" || option == "--largest");
    if (is_named && kept.find(option) == std::string::npos) kept += " " + option;
  }
  return kept;
}

/// Footnotes of the support page; equal texts share a number.
class Footnotes {
 public:
  std::string of(const Support& support) {
    const std::string word = support.refusal.empty() ? "✓" : "✗";
    if (support.reason.empty()) return word;
    const auto known = std::find(texts_.begin(), texts_.end(), support.reason);
    const auto number = known - texts_.begin() + 1;
    if (known == texts_.end()) texts_.push_back(support.reason);
    return word + std::to_string(number);
  }
  std::string list() const {
    std::string all;
    for (std::size_t k = 0; k < texts_.size(); ++k)
      all += std::to_string(k + 1) + ". " + texts_[k] + "\n";
    return all;
  }

 private:
  Words texts_;
};

/// Features of the page's columns for two masses or a conductor; the last feature names the column.
std::vector<Words> singles_asked(bool on_conductor) {
  std::vector<Words> asked;
  for (const std::string& name : feature_names()) {
    if (!on_conductor) asked.push_back({name});
    if (on_conductor && !is_of_plant(name)) asked.push_back({"string", name});
  }
  return asked;
}

/// All pairs of further features that one case can have, with one plant and one law of the play.
std::vector<Words> pairs_asked() {
  const auto is_law = [](const std::string& name) {
    return name == "immediate" || name == "play" || name == "dead_zone";
  };
  const Words all = feature_names();
  std::vector<Words> pairs;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k)
      if (all[i] != "two_masses" && all[i] != "string" && !is_of_plant(all[k]) &&
          !(is_law(all[i]) && is_law(all[k])))
        pairs.push_back({all[i], all[k]});
  return pairs;
}

/// Whether a question can have the feature: "exact" needs a job with the option --switching.
bool knows(const toml::node_view<const toml::node>& group, const std::string& question,
           const std::string& name) {
  return name != "exact" ||
         (group["switching"].value_or(false) && question.find("--switching") == std::string::npos);
}

/// One table of the support page, in Markdown.
std::string table_of(const toml::node_view<const toml::node>& group, bool on_conductor,
                     Footnotes& reasons) {
  const Words all = feature_names();
  const std::vector<Words> shown = singles_asked(on_conductor);
  std::string text = "|asked|", line = "|---|";
  for (const Words& names : shown) {
    text += std::to_string(std::find(all.begin(), all.end(), names.back()) - all.begin() + 1) + "|";
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const std::string& question : words_of(group["questions"])) {
    text += "|`" + without_numbers(question) + "`|";
    for (const Words& names : shown) {
      if (knows(group, question, names.back()))
        text += reasons.of(cell_of(question, names).support);
      text += "|";
    }
    text += "\n";
  }
  return text;
}

std::vector<SupportCell> cells_of(const std::vector<Words>& features) {
  std::vector<SupportCell> cells;
  for (const toml::node& node : *table().texts["asked"].as_array()) {
    const toml::node_view<const toml::node> group(node);
    const bool is_tried = !text_of(group["title"]).empty();
    for (const std::string& question : words_of(group["questions"]))
      for (const Words& names : features) {
        if (!knows(group, question, names.back())) continue;
        cells.push_back(cell_of(question, names));
        cells.back().can_be_asked = cells.back().can_be_asked && is_tried;
      }
  }
  return cells;
}

}  // namespace

std::vector<SupportCell> support_cells() {
  std::vector<Words> singles = singles_asked(false);
  for (Words& names : singles_asked(true)) singles.push_back(std::move(names));
  return cells_of(singles);
}

std::vector<SupportCell> support_pairs() { return cells_of(pairs_asked()); }

std::string support_page() {
  Footnotes reasons;
  std::string page = text_of(table().texts["page"]["head"]) + "\n";
  const Words names = feature_names();
  for (std::size_t k = 0; k < names.size(); ++k)
    page += std::to_string(k + 1) + ". " + words_of_feature(names[k]) + "\n";
  for (const toml::node& node : *table().texts["asked"].as_array()) {
    const toml::node_view<const toml::node> group(node);
    const std::string title = text_of(group["title"]);
    if (title.empty()) continue;
    for (const bool on_conductor : {false, true})
      page += "\n## " + title + (on_conductor ? ", on a conductor by its modes" : "") + "\n\n" +
              table_of(group, on_conductor, reasons);
  }
  return page + "\n## Why\n\n" + reasons.list();
}

}  // namespace holdfast::program
