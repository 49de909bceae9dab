#include "case/case_keys.hpp"

#include "case/case_file.hpp"
#include "case/needed.hpp"
#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"

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
    values.push_back(end - 1.0);
    values.push_back(end + 1.0);
  }
  return values;
}

TEST(CaseKeys, NamesAreDistinctAndEachHasOnePlaceAndADescription) {
  std::set<std::string> names;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_NE(key.place, nullptr) << key.name;
    EXPECT_EQ(key.kind == ValueKind::word, !key.is_number() && !key.words.empty()) << key.name;
    EXPECT_FALSE(key.description.empty()) << key.name;
    EXPECT_FALSE(key.admissible().empty()) << key.name;
    EXPECT_EQ(key.table() + "." + key.short_name(), key.name);
    EXPECT_EQ(find_case_key(key.name), &key);
  }
}

const void* place_of(const CaseKey& key, Case& the_case) {
  return std::visit([](const auto* value) -> const void* { return value; }, key.place(the_case));
}

TEST(CaseKeys, EachPlaceHasTheTypeOfItsKind) {
  constexpr std::array<std::size_t, 7> types = {0, 1, 1, 1, 2, 3, 4};
  Case windy = windy_case();
  for (const CaseKey& key : case_keys())
    EXPECT_EQ(key.place(windy).index(), types[static_cast<std::size_t>(key.kind)]) << key.name;
}

TEST(CaseKeys, NoTwoKeysShareAPlace) {
  Case windy = windy_case();
  std::set<const void*> places;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(places.insert(place_of(key, windy)).second) << key.name;
  }
}

TEST(CaseKeys, EachNumberIsRefusedOutsideItsRangeAndSetInside) {
  int refused = 0;
  int accepted = 0;
  for (const CaseKey& key : case_keys()) {
    if (!key.is_number()) continue;
    for (const double value : numbers_near_ends(key.range)) {
      Case the_case = case_for(key);
      if (key.range.contains(value)) {
        set_case_value(the_case, key.name, value);
        EXPECT_EQ(case_value(the_case, key.name), value) << key.name;
        ++accepted;
      } else {
        const Case before = the_case;
        EXPECT_THROW(set_case_value(the_case, key.name, value), WrongInput) << key.name;
        if (!is_absent(before, key)) {
          EXPECT_EQ(case_value(the_case, key.name), case_value(before, key.name)) << key.name;
        }
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
        "plant.absorber_stiffness", "control.sampling_period", "excitation.frequency",
        "control.largest_force", "excitation.noise_lowest", "excitation.noise_highest"}) {
    EXPECT_THROW(set_case_value(the_case, key, 0.0), WrongInput) << key;
  }
  for (const char* key :
       {"plant.conductor_damping", "plant.absorber_damping", "backlash.width",
        "control.processing_delay", "excitation.amplitude", "backlash.contact_stiffness",
        "backlash.contact_damping", "control.displacement_quantum", "control.velocity_quantum",
        "control.jitter", "excitation.noise_rms"}) {
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
  for (const char* key : {"excitation.record", "excitation.harmonics"})
    EXPECT_THROW(set_case_value(the_case, key, 1.0), WrongInput) << key;
}

TEST(CaseKeys, WholeNumbersRefuseFractions) {
  int whole = 0;
  for (const CaseKey& key : case_keys()) {
    if (!key.range.whole) continue;
    ++whole;
    Case the_case = load_case(std::nullopt, {});
    const double large = std::min(10000.0, key.range.highest);
    for (const double value : {1.0, 2.0, large}) {
      set_case_value(the_case, key.name, value);
      EXPECT_EQ(case_value(the_case, key.name), value) << key.name;
    }
    for (const double value : {0.5, 1.5, large - 2e-12}) {
      const auto message =
          message_of<WrongInput>([&] { set_case_value(the_case, key.name, value); });
      EXPECT_NE(message.find("a whole number"), std::string::npos) << message;
    }
    EXPECT_EQ(case_value(the_case, key.name), large) << key.name;
  }
  EXPECT_EQ(whole, 5);
}

TEST(CaseKeys, SeedsAreAsLargeAsADoubleTellsThemApart) {
  Case the_case = load_case(std::nullopt, {});
  const double largest = std::ldexp(1.0, 53);
  for (const char* key : {"control.jitter_seed", "excitation.noise_seed"}) {
    set_case_value(the_case, key, 0.0);
    set_case_value(the_case, key, largest);
    EXPECT_THROW(set_case_value(the_case, key, 2.0 * largest), WrongInput);
    EXPECT_THROW(set_case_value(the_case, key, -1.0), WrongInput);
  }
}

TEST(CaseKeys, WindReplacesAmplitudeAndFrequencyAlone) {
  for (const CaseKey& key : case_keys()) {
    const bool replaced = key.name == "excitation.amplitude" || key.name == "excitation.frequency";
    EXPECT_EQ(key.replaced_by_wind, replaced) << key.name;
  }
  Case windy = windy_case();
  set_case_value(windy, "excitation.noise_rms", 0.25);
  EXPECT_EQ(effective_excitation(windy).noise_rms, 0.25);
  EXPECT_THROW(set_case_value(windy, "excitation.amplitude", 0.25), WrongInput);
}

TEST(CaseKeys, ALargestForceIsNoneUntilANumberIsSet) {
  Case the_case = load_case(std::nullopt, {});
  const CaseKey& key = *find_case_key("control.largest_force");
  EXPECT_TRUE(key.bears_word(the_case));
  EXPECT_EQ(case_value(the_case, key.name), infinity);
  set_case_value(the_case, key.name, 2.5);
  EXPECT_FALSE(key.bears_word(the_case));
  EXPECT_EQ(the_case.control.largest_force, 2.5);
  key.give_word(the_case);
  EXPECT_EQ(the_case.control.largest_force, infinity);
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
  EXPECT_NE(faulty("control.processing_delay", 0.2).find("sampling_period"), std::string::npos);
  EXPECT_NE(faulty("absorber.position", 6.4).find("conductor.span"), std::string::npos);
  EXPECT_NE(faulty("conductor.sag", 3.2).find("half of conductor.span"), std::string::npos);
  EXPECT_NE(faulty("reduction.first_frequency", 7.0).find("second_frequency"), std::string::npos);
}

TEST(CaseKeys, JitterLeavesRoomForEveryForceBeforeTheNextSample) {
  // 2^-10 s and its parts are exact, so the limits can be met with equality.
  const double period = std::ldexp(1.0, -10);
  const auto fault = [&](double jitter, double delay) {
    Case the_case = load_case(std::nullopt, {});
    the_case.control.sampling_period = period;
    the_case.control.jitter = jitter;
    the_case.control.processing_delay = delay;
    return first_fault(the_case);
  };
  EXPECT_EQ(fault(0.0, period).message, "");
  EXPECT_EQ(fault(period / 4.0, period / 2.0).message, "");
  EXPECT_EQ(fault(std::nextafter(period / 2.0, 0.0), 0.0).message, "");
  const CaseFault half = fault(period / 2.0, 0.0);
  EXPECT_NE(half.message.find("less than half of control.sampling_period"), std::string::npos);
  EXPECT_EQ(half.keys.front(), "control.jitter");
  const CaseFault late = fault(period / 4.0, period * 0.500001);
  EXPECT_NE(late.message.find("control.processing_delay = "), std::string::npos) << late.message;
  EXPECT_NE(late.message.find(" s must not exceed"), std::string::npos) << late.message;
}

TEST(CaseKeys, ContactsBelongToADeadZone) {
  for (const char* key : {"backlash.contact_stiffness", "backlash.contact_damping"}) {
    for (const std::string& law : find_case_key("backlash.law")->words) {
      Case the_case = load_case(std::nullopt, {"backlash.law=" + law});
      set_case_value(the_case, key, 0.0);
      EXPECT_EQ(first_fault(the_case).message, "");
      set_case_value(the_case, key, 1.0);
      const CaseFault fault = first_fault(the_case);
      EXPECT_EQ(fault.message.empty(), law == "dead_zone") << fault.message;
      if (fault.message.empty()) continue;
      EXPECT_EQ(fault.keys, (std::vector<std::string>{key, "backlash.law"}));
      EXPECT_NE(fault.message.find(key), std::string::npos) << fault.message;
      EXPECT_NE(fault.message.find("\"" + law + "\""), std::string::npos) << fault.message;
    }
  }
}

TEST(CaseKeys, NoiseNeedsABand) {
  Case the_case = load_case(std::nullopt, {});
  set_case_value(the_case, "excitation.noise_lowest", 50.0);
  EXPECT_EQ(first_fault(the_case).message, "") << "no noise, no band";
  set_case_value(the_case, "excitation.noise_rms", 0.1);
  const auto message = message_of<WrongInput>([&] { check_case(the_case); });
  EXPECT_NE(message.find("excitation.noise_lowest = 50 Hz"), std::string::npos) << message;
  set_case_value(the_case, "excitation.noise_highest", 50.5);
  EXPECT_EQ(first_fault(the_case).message, "");
}

TEST(CaseKeys, DelayUpToThePeriodIsNoFault) {
  Case the_case = load_case(std::nullopt, {});
  set_case_value(the_case, "control.processing_delay", the_case.control.sampling_period);
  EXPECT_EQ(first_fault(the_case).message, "");
}

}  // namespace
}  // namespace holdfast::program
