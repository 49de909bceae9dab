#include <map>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "case/needed.hpp"
#include "host/job_host.hpp"
#include "job.hpp"
#include "support/testing.hpp"

namespace holdfast::program {
namespace {

using Words = std::vector<std::string>;
using Values = std::map<std::string, std::string>;

/// A stay of 60 kg/m on 180 m with an absorber near its end: every key that a job may ask for.
const Values whole = {{"conductor.name", "\"Drake\""},
                      {"conductor.mass_per_length", "60"},
                      {"conductor.span", "180"},
                      {"conductor.sag", "0.79461"},
                      {"conductor.tension", "\"3 MN\""},
                      {"conductor.area", "6600e-6"},
                      {"conductor.youngs_modulus", "195e9"},
                      {"conductor.damping_ratio", "0.001"},
                      {"conductor.diameter", "0.16"},
                      {"conductor.rated_strength", "1e7"},
                      {"conductor.bending_stiffness", "1000"},
                      {"conductor.outer_wire_diameter", "0.005"},
                      {"conductor.outer_wire_modulus", "2e11"},
                      {"absorber.mass", "30"},
                      {"absorber.position", "3"},
                      {"absorber.clamp_mass", "1"},
                      {"plant.conductor_mass", "100"},
                      {"plant.conductor_stiffness", "1e6"},
                      {"plant.conductor_damping", "20"},
                      {"plant.absorber_mass", "30"},
                      {"plant.absorber_stiffness", "4e4"},
                      {"plant.absorber_damping", "100"},
                      {"plant.model", "\"string\""},
                      {"control.sampling_period", "0.002"},
                      {"reduction.first_frequency", "2"},
                      {"reduction.second_frequency", "8"},
                      {"excitation.frequency", "5"}};

const std::vector<Words> jobs = {
    {"case"},
    {"modes", "--count=2", "--elements=8"},
    {"statics", "--elements=8", "--force=-1:1:2"},
    {"absorption", "--frequency=5:9:2"},
    {"aeolian", "--frequency=5:9:2"},
    {"fatigue"},
    {"modal-damping", "--count=2"},
    {"stability", "--p=0:0:1", "--d=-1:0:2"},
    {"response", "--p=0:0:1", "--d=-1:0:2"},
    {"boundary", "--stable-interval"},
    {"simulate", "--duration=0.02"},
    {"sweep", "--axis=control.differential_gain=-1:0:2", "--duration=0.02", "--metric=first_peak"}};

std::string file_of(const Values& given, bool has_device) {
  std::map<std::string, std::string> tables;
  for (const auto& [key, value] : given) {
    const std::size_t dot = key.find('.');
    tables[key.substr(0, dot)] += key.substr(dot + 1) + " = " + value + "\n";
  }
  std::string text;
  for (const auto& [table, lines] : tables) text += "[" + table + "]\n" + lines;
  return text + (has_device ? "[[device]]\nkind = \"dashpot\"\nposition = 4\ndamping = 1e4\n" : "");
}

/// What a job said of a file, and that it lacked something.
struct Said {
  Words texts;
  std::string missing;
};

Said said_of(const Words& job, const std::string& text) {
  JobHost host;
  host.source = std::make_shared<CaseSource>();
  host.source->text = text;
  host.source->name = "case.toml";
  const HostScope here(host);
  Said said;
  try {
    do_job(job);
  } catch (const MissingKeys& missing) {
    said.missing = missing.what();
  } catch (const Refusal& refusal) {
    said.texts.emplace_back(refusal.what());
  }
  said.texts.insert(said.texts.end(), host.warnings.begin(), host.warnings.end());
  said.texts.push_back(said.missing);
  return said;
}

Words keys_in(const std::string& text, const std::regex& pattern) {
  Words keys;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    keys.push_back((*at)[1]);
  return keys;
}

/// Whether a value may be named: given, of the named conductor, or the other of two that follow
/// from each other.
bool may_be_named(const std::string& key, const Values& given) {
  const bool named = given.count("conductor.name") > 0 && key.rfind("conductor.", 0) == 0;
  // A model is named where another one would do.
  return given.count(key) > 0 || named || whole.count(key) == 0 || key == "plant.model" ||
         (key == "conductor.sag" && given.count("conductor.tension") > 0) ||
         (key == "absorber.mass" && given.count("plant.absorber_mass") > 0) ||
         (key == "plant.absorber_mass" && given.count("absorber.mass") > 0);
}

void expect_names_no_other(const Said& said, const Values& given, const std::string& about) {
  static const std::regex value(R"(([a-z]+\.[a-z_]+) (?:= |is )[-"0-9])");
  for (const std::string& text : said.texts) {
    for (const std::string& key : keys_in(text, value))
      EXPECT_TRUE(may_be_named(key, given)) << key << " in: " << text << "\n" << about;
    for (const char* word : {"built-in", "= nan", "is nan", "nan m", "nan N"})
      EXPECT_EQ(text.find(word), std::string::npos) << text << "\n" << about;
  }
}

/// Gives one thing after another that is asked for, until nothing is.
void expect_asks_until_enough(const Words& job, Values given, bool has_device) {
  static const std::regex key(R"(([a-z]+\.[a-z_]+) ?\()");
  for (int turn = 0;; ++turn) {
    const std::string text = file_of(given, has_device);
    const std::string about = job.front() + " of\n" + text;
    const Said said = said_of(job, text);
    expect_names_no_other(said, given, about);
    if (said.missing.empty()) return;
    ASSERT_LT(turn, 8) << said.missing << "\n" << about;
    bool is_new = false;
    for (const std::string& one : keys_in(said.missing, key)) {
      EXPECT_EQ(given.count(one), 0u) << "it is given: " << said.missing << "\n" << about;
      is_new |= given.insert({one, whole.at(one)}).second;
    }
    ASSERT_TRUE(is_new) << said.missing << "\n" << about;
  }
}

TEST(PartialCases, AreAnsweredOrAskForWhatIsMissingAndNameNothingThatNobodyGave) {
  std::mt19937 random(42);
  const auto chance = [&](double share) {
    return static_cast<double>(random()) < share * 4294967296.0;
  };
  for (int number = 0; number < 200; ++number) {
    Values given;
    for (const auto& [key, value] : whole) {
      const std::string table = key.substr(0, key.find('.'));
      const bool varied = table == "conductor" || table == "absorber" || table == "plant";
      if (varied ? chance(key == "conductor.name" ? 0.1 : 0.5) : chance(0.2)) given[key] = value;
    }
    given["conductor.span"] = whole.at("conductor.span");
    // To fit it to the cable's decay takes a second.
    if (given.count("plant.model") == 0) given["plant.absorber_damping"] = "100";
    const bool has_device = chance(0.3);
    expect_asks_until_enough(jobs[static_cast<std::size_t>(number) % jobs.size()], given,
                             has_device);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace holdfast::program
