#include "case/axes/axis.hpp"

#include "process/errors.hpp"
#include "support/message_of.hpp"
#include "support/testing.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using tests::message_of;

TEST(Axis, ReadsMinMaxCount) {
  const Axis axis = parse_axis("--p", "-6e2:+0.5:41");
  EXPECT_EQ(axis.min, -600.0);
  EXPECT_EQ(axis.max, 0.5);
  EXPECT_EQ(axis.count, 41);
  EXPECT_EQ(parse_axis("--p", "3:3:1").at(0), 3.0);
  EXPECT_EQ(parse_axis("--p", "3:4:1").at(0), 3.0);
}

TEST(Axis, RefusalsNameOptionTextAndForm) {
  for (const std::string text : {"", ":", "::", "1:2", "1:2:3:4", "1:2:0", "1:2:-3", "1:2:2.5",
                                 "1:2:1000000001", "2:1:3", "nan:1:3", "0:inf:3", "a:1:3",
                                 "1:2:", "1:2:3x", "0:1e308:1000", "1:2:99999999999999999999"}) {
    const std::string message = message_of<WrongInput>([&] { parse_axis("--p", text); });
    EXPECT_EQ(message.rfind("--p " + text, 0), 0u) << message;
    EXPECT_NE(message.find("expected MIN:MAX:COUNT"), std::string::npos) << message;
  }
}

TEST(Range, ReadsMinMaxAndRefusesTheRest) {
  const Range range = parse_range("--p", "-1:2");
  EXPECT_EQ(range.min, -1.0);
  EXPECT_EQ(range.max, 2.0);
  for (const std::string text : {"1", "2:1", "1:2:3", "1:x", "-inf:1"}) {
    EXPECT_THROW(parse_range("--p", text), WrongInput) << text;
  }
}

TEST(KeyAxis, SeparatesTheKey) {
  const KeyAxis axis = parse_key_axis("--axis", "initial.z1=-0.01:0.01:5");
  EXPECT_EQ(axis.key, "initial.z1");
  EXPECT_EQ(axis.axis.count, 5);
  for (const std::string text : {"initial.z1", "=1:2:3", "initial.z1=", "initial.z1=1:2"}) {
    EXPECT_THROW(parse_key_axis("--axis", text), WrongInput) << text;
  }
}

TEST(KeyValues, AreARangeARatioOrAList) {
  const KeyValues range = parse_key_values("--axis", "backlash.width=0:0.003:4");
  EXPECT_EQ(range.key, "backlash.width");
  EXPECT_EQ(std::get<Axis>(range.values).at(1), 0.001);
  const KeyValues ratio = parse_key_values("--axis", "control.sampling_period = log:1e-4:1e-2:3");
  EXPECT_EQ(ratio.key, "control.sampling_period");
  EXPECT_NEAR(std::get<LogAxis>(ratio.values).at(1), 1e-3, 1e-17);
  const KeyValues list = parse_key_values("--axis", "initial.z1=0.001, -2,5e-3");
  EXPECT_EQ(std::get<std::vector<double>>(list.values), (std::vector<double>{0.001, -2.0, 5e-3}));
  const KeyValues one = parse_key_values("--axis", "initial.z1=7");
  EXPECT_EQ(std::get<std::vector<double>>(one.values), std::vector<double>{7.0});
}

TEST(KeyValues, RefusesOtherTexts) {
  for (const std::string text : {"a", "=1", "a=", "a=1,", "a=1:2", "a=log:0:1:3", "a=log:-1:1:3",
                                 "a=log:1:2", "a=2:1:3", "a=1,nan", "a=log:1,2", "a=1:2:0"}) {
    EXPECT_THROW(parse_key_values("--axis", text), WrongInput) << text;
  }
}

TEST(Kick, ReadsTimeAndDisplacement) {
  const KickOption kick = parse_kick("--kick", "0.95:-0.003");
  EXPECT_EQ(kick.time, 0.95);
  EXPECT_EQ(kick.displacement, -0.003);
  for (const std::string text : {"1", "-1:0.003", "1:nan", "1:2:3", "a:b"}) {
    EXPECT_THROW(parse_kick("--kick", text), WrongInput) << text;
  }
}

TEST(Window, HasExtentBothWays) {
  const WindowOption window = parse_window("--window", "-1:1:-2:2");
  EXPECT_EQ(window.displacement.max, 1.0);
  EXPECT_EQ(window.velocity.min, -2.0);
  for (const std::string text : {"-1:1:-2", "1:-1:-2:2", "1:1:-2:2", "-1:1:2:2", "-1:1:-2:x"}) {
    EXPECT_THROW(parse_window("--window", text), WrongInput) << text;
  }
}

TEST(List, ReadsNumbersBetweenCommas) {
  EXPECT_EQ(parse_list("--durations", "10, 100,1e3"), (std::vector<double>{10.0, 100.0, 1000.0}));
  for (const std::string text : {"", "1,", ",1", "1;2", "1,inf"}) {
    EXPECT_THROW(parse_list("--durations", text), WrongInput) << text;
  }
}

}  // namespace
}  // namespace holdfast::program
