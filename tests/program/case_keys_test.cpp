#include "case_keys.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "case_file.hpp"
#include "errors.hpp"
#include "support/message_of.hpp"

namespace holdfast::program {
namespace {

using tests::message_of;

const double infinity = std::numeric_limits<double>::infinity();

/// A case in which every key has a place.
Case windy_case() {
  return load_case(std::nullopt,
                   {"wind.speed=4", "wind.diameter=0.0032", "wind.effective_length=1"});
}

/// A case that lets a number be set: [excitation] and [wind] exclude one another.
Case case_for(const CaseKey& key) {
  return key.table() == "wind" ? windy_case() : load_case(std::nullopt, {});
}

/// Numbers just inside and just outside the ends of a range.
std::vector<double> numbers_near_ends(const AdmissibleRange& range) {
  std::vector<double> values = {infinity, -infinity, std::nan("")};
  for (const double end : {range.lowest, range.highest}) {
    if (!std::isfinite(end)) continue;
    values.push_back(end);
    values.push_back(std::nextafter(end, -infinity));
    values.push_back(std::nextafter(end, infinity));
  }
  return values;
}

TEST(CaseKeys, NamesAreDistinctAndEachHasOnePlaceAndADescription) {
  std::set<std::string> names;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_NE(key.number == nullptr, key.word == nullptr) << key.name;
    EXPECT_FALSE(key.description.empty()) << key.name;
    EXPECT_FALSE(key.admissible().empty()) << key.name;
    EXPECT_EQ(key.table() + "." + key.short_name(), key.name);
    EXPECT_EQ(find_case_key(key.name), &key);
  }
}

TEST(CaseKeys, NoTwoKeysShareAPlace) {
  Case windy = windy_case();
  std::set<const void*> places;
  for (const CaseKey& key : case_keys()) {
    const void* place = key.number != nullptr ? static_cast<const void*>(key.number(windy))
                                              : static_cast<const void*>(key.word(windy));
    EXPECT_TRUE(places.insert(place).second) << key.name;
  }
}

TEST(CaseKeys, EachNumberIsRefusedOutsideItsRangeAndSetInside) {
  int refused = 0;
  int accepted = 0;
  for (const CaseKey& key : case_keys()) {
    if (key.number == nullptr) continue;
    for (const double value : numbers_near_ends(key.range)) {
      Case the_case = case_for(key);
      if (key.range.contains(value)) {
        set_case_value(the_case, key.name, value);
        EXPECT_EQ(case_value(the_case, key.name), value) << key.name;
        ++accepted;
      } else {
        const Case before = the_case;
        EXPECT_THROW(set_case_value(the_case, key.name, value), WrongInput) << key.name;
        EXPECT_EQ(case_value(the_case, key.name), case_value(before, key.name)) << key.name;
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(accepted, 20);
}

TEST(CaseKeys, PhysicalQuantitiesAreBounded) {
  Case the_case = load_case(std::nullopt, {});
  for (const char* key :
       {"conductor.mass_per_length", "conductor.span", "plant.conductor_mass",
        "plant.absorber_stiffness", "control.sampling_period", "excitation.frequency"}) {
    EXPECT_THROW(set_case_value(the_case, key, 0.0), WrongInput) << key;
  }
  for (const char* key : {"plant.conductor_damping", "plant.absorber_damping", "backlash.width",
                          "control.processing_delay", "excitation.amplitude"}) {
    set_case_value(the_case, key, 0.0);
    EXPECT_THROW(set_case_value(the_case, key, -1e-12), WrongInput) << key;
  }
  for (const char* key : {"control.proportional_gain", "control.differential_gain", "initial.z1"}) {
    set_case_value(the_case, key, -5.0);
  }
}

TEST(CaseKeys, OneSlipOfTheHandIsRecognised) {
  for (const CaseKey& key : case_keys()) {
    const std::size_t middle = key.name.size() - key.short_name().size() / 2 - 1;
    std::string doubled = key.name;
    doubled.insert(middle, 1, doubled[middle]);
    EXPECT_EQ(nearest_case_key(doubled).name, key.name);
  }
}

TEST(CaseKeys, AKeyWithoutItsTableOrInAnotherIsRecognised) {
  EXPECT_EQ(nearest_case_key("sampling_period").name, "control.sampling_period");
  EXPECT_EQ(nearest_case_key("plant.sampling_period").name, "control.sampling_period");
  EXPECT_EQ(nearest_case_table("contorl"), "control");
  EXPECT_EQ(nearest_case_table("excitations"), "excitation");
}

TEST(CaseKeys, UnknownKeysAndWordsAreNoNumbers) {
  Case the_case = load_case(std::nullopt, {});
  const auto unknown =
      message_of<WrongInput>([&] { set_case_value(the_case, "control.sample_period", 1.0); });
  EXPECT_NE(unknown.find("did you mean control.sampling_period"), std::string::npos) << unknown;
  EXPECT_THROW(set_case_value(the_case, "backlash.law", 1.0), WrongInput);
  EXPECT_THROW(case_value(the_case, "excitation.hold"), WrongInput);
}

TEST(CaseKeys, WindAndExcitationAreNotSetTogether) {
  Case still = load_case(std::nullopt, {});
  EXPECT_THROW(set_case_value(still, "wind.speed", 3.0), WrongInput);
  EXPECT_THROW(case_value(still, "wind.speed"), WrongInput);
  Case windy = windy_case();
  EXPECT_THROW(set_case_value(windy, "excitation.frequency", 3.0), WrongInput);
  set_case_value(windy, "wind.speed", 3.0);
  EXPECT_EQ(case_value(windy, "wind.speed"), 3.0);
}

TEST(CaseKeys, ATunedGainFollowsTheFrequencyUntilANumberIsSet) {
  Case the_case = load_case(std::nullopt, {"control.proportional_gain=tuned"});
  // Eq. 6: the absorber alone would vibrate at k2/m2 = omega^2 with P = 0.
  const double pi = std::acos(-1.0);
  const double own = std::sqrt(the_case.plant.absorber_stiffness / the_case.plant.absorber_mass);
  set_case_value(the_case, "excitation.frequency", own / (2.0 * pi));
  EXPECT_NEAR(case_value(the_case, "control.proportional_gain"), 0.0, 1e-11);
  set_case_value(the_case, "control.proportional_gain", -10.0);
  EXPECT_EQ(resolved_proportional_gain(the_case), -10.0);
}

TEST(CaseKeys, FaultsBetweenKeysAreFoundAfterSetting) {
  const auto faulty = [](const char* key, double value) {
    Case the_case = load_case(std::nullopt, {});
    check_case(the_case);
    set_case_value(the_case, key, value);
    return message_of<WrongInput>([&] { check_case(the_case); });
  };
  EXPECT_NE(faulty("control.processing_delay", 0.01).find("sampling_period"), std::string::npos);
  EXPECT_NE(faulty("absorber.position", 6.4).find("conductor.span"), std::string::npos);
  EXPECT_NE(faulty("conductor.sag", 3.2).find("half of conductor.span"), std::string::npos);
  EXPECT_NE(faulty("reduction.first_frequency", 7.0).find("second_frequency"), std::string::npos);
}

TEST(CaseKeys, DelayUpToThePeriodIsNoFault) {
  Case the_case = load_case(std::nullopt, {});
  set_case_value(the_case, "control.processing_delay", the_case.control.sampling_period);
  EXPECT_EQ(first_fault(the_case).message, "");
}

}  // namespace
}  // namespace holdfast::program
