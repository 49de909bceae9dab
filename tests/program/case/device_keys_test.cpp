#include "case/device/device_keys.hpp"

#include <nlohmann/json.hpp>

#include "case/case_source.hpp"
#include "case/device/impedance_table.hpp"
#include "case/toml_values.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/span/device/measured_impedance.hpp"
#include "program/case/case_text.hpp"
#include "support/temporary_folder.hpp"

namespace holdfast::program {
namespace {

using tests::TemporaryFolder;
using tests::write_text;

using Device = case_tables::Device;

/// One device of each kind, two of what may be said in two ways.
const std::vector<std::string> devices = {
    "kind = \"dashpot\"\nposition = 1.5\ndamping = 30\n",
    "kind = \"dashpot\"\nposition = 1.5\ndamping = 30\nto = \"conductor\"\nmass = 0.2\n"
    "clamp_mass = 0.01\n",
    "kind = \"tuned_mass\"\nposition = 0.3\nmass = 0.1\nstiffness = 400\ndamping = 0.5\n",
    "kind = \"tuned_mass\"\nposition = 0.3\nmass = 0.1\nfrequencies = [10]\n"
    "damping_ratios = [0.1]\n",
    "kind = \"stockbridge\"\nposition = 6.3\nmass = 0.3\nfrequencies = [8, 21.5]\n"
    "damping_ratios = [0.2, 0.25]\nmass_share = 0.625\n",
    "kind = \"measured\"\nposition = 2\nfile = \"shaker.csv\"\nclamp_mass = 0.05\n",
    "kind = \"inerter\"\nposition = 3\ninertance = 12.5\nstiffness = 1e3\n",
    "kind = \"stiffness\"\nposition = 3\nstiffness = -250\ndamping = 1\n"};

std::string case_of(const std::vector<std::string>& texts) {
  std::string text = "[conductor]\nspan = 6.4\n";
  for (const std::string& one : texts) text += "[[device]]\n" + one;
  return text;
}

/// Why a case of this device alone is none.
std::string refusal_of(const std::string& device) { return refusal(case_of({device})); }

void expect_same(Device a, Device b) {
  for (const DeviceKey& key : device_keys())
    EXPECT_EQ(json_value(key, key.place(a)), json_value(key, key.place(b))) << key.name;
}

TEST(DeviceKeys, EachHasOnePlaceAndSaysWhatIsAdmissible) {
  for (const DeviceKey& key : device_keys()) {
    ASSERT_NE(key.place, nullptr) << key.name;
    Device device;
    const std::size_t type = key.is_number() ? 0 : key.kind == ValueKind::numbers ? 3 : 1;
    EXPECT_EQ(key.place(device).index(), type) << key.name;
    EXPECT_EQ(key.kind == ValueKind::word, !key.words.empty()) << key.name;
    EXPECT_FALSE(key.description.empty() || key.admissible().empty()) << key.name;
    EXPECT_EQ(find_device_key(key.name), &key);
    const auto name = device_key_name(device_key_text(12, key.name));
    ASSERT_TRUE(name);
    EXPECT_EQ(name->number, 12U);
    EXPECT_EQ(name->key, key.name);
  }
  for (const char* name :
       {"device.0.kind", "device.01.kind", "device.-1.kind", "device..kind", "device.1",
        "device.1x.kind", "device.99999999999999999999.kind", "plant.1.kind", "device"})
    EXPECT_FALSE(device_key_name(name)) << name;
}

TEST(Devices, AreReadInTheirOrder) {
  const Case the_case = from_text(case_of(devices));
  ASSERT_EQ(the_case.devices.size(), devices.size());
  EXPECT_EQ(the_case.devices[0].kind, "dashpot");
  EXPECT_EQ(the_case.devices[0].damping, 30.0);
  EXPECT_EQ(the_case.devices[1].mass, 0.2);
  EXPECT_EQ(the_case.devices[2].stiffness, 400.0);
  EXPECT_EQ(the_case.devices[3].frequencies, (std::vector<double>{10.0}));
  EXPECT_EQ(the_case.devices[4].mass_share, 0.625);
  EXPECT_EQ(the_case.devices[5].file, "shaker.csv");
  EXPECT_EQ(the_case.devices[6].inertance, 12.5);
  EXPECT_EQ(the_case.devices[7].stiffness, -250.0);
  EXPECT_EQ(the_case.places.at("device.3.mass"), "case.toml:17");
  EXPECT_FALSE(the_case.plant_given);
  EXPECT_TRUE(load_case(std::nullopt, {}).devices.empty());
}

TEST(Devices, HangOnTheConductorWhereTheirKindDoes) {
  const Case the_case = from_text(case_of(devices));
  for (std::size_t k = 0; k < devices.size(); ++k) {
    const bool hangs = k >= 1 && k <= 5;
    EXPECT_EQ(the_case.devices[k].to, hangs ? "conductor" : "ground") << k;
  }
}

TEST(Devices, AreWrittenSoThatTheyReadBack) {
  std::vector<std::string> texts;
  for (const std::string& device : devices) {
    texts.push_back(device);
    const Case the_case = from_text(case_of(texts));
    const std::string written = case_to_toml(the_case);
    const Case again = from_text(written);
    EXPECT_EQ(case_to_toml(again), written);
    ASSERT_EQ(again.devices.size(), texts.size());
    for (std::size_t k = 0; k < texts.size(); ++k)
      expect_same(again.devices[k], the_case.devices[k]);
    EXPECT_EQ(case_to_json(again), case_to_json(the_case));
    EXPECT_EQ(from_text(case_to_begin_with(the_case, CaseForm::conductor)).devices.size(),
              texts.size());
  }
  const auto json = case_to_json(from_text(case_of(texts)))["device"];
  EXPECT_EQ(json[3].dump(),
            "{\"kind\":\"tuned_mass\",\"position\":0.3,\"to\":\"conductor\",\"mass\":0.1,"
            "\"clamp_mass\":0.0,\"frequencies\":[10.0],\"damping_ratios\":[0.1]}");
}

TEST(Devices, LeaveNoTraceInACaseWithout) {
  const Case bare = load_case(std::nullopt, {});
  EXPECT_FALSE(holds(case_to_toml(bare), "[[device]]"));
  EXPECT_FALSE(case_to_json(bare).contains("device"));
}

TEST(Devices, MissingKeysAreAskedForByNameAndKind) {
  EXPECT_EQ(refusal_of("position = 3\n"),
            "case.toml:3: [[device]]: device.1: kind is missing: kind of the device; must be "
            "\"dashpot\" or \"tuned_mass\" or \"stockbridge\" or \"measured\" or \"inerter\" or "
            "\"stiffness\"");
  for (const auto& [text, missing] : std::vector<std::pair<std::string, std::string>>{
           {"kind = \"dashpot\"\ndamping = 3\n", "position is missing"},
           {"kind = \"dashpot\"\nposition = 3\n", "damping is missing, which a dashpot needs"},
           {"kind = \"dashpot\"\nposition = 3\ndamping = 1\nto = \"conductor\"\n",
            "mass is missing, needed with to = \"conductor\""},
           {"kind = \"tuned_mass\"\nposition = 3\nstiffness = 1\n", "mass is missing"},
           {"kind = \"tuned_mass\"\nposition = 3\nmass = 1\n",
            "stiffness or frequencies is missing: a tuned_mass needs one of them"},
           {"kind = \"stockbridge\"\nposition = 3\nmass = 1\ndamping_ratios = [0.1, 0.1]\n",
            "frequencies is missing, which a stockbridge needs"},
           {"kind = \"stockbridge\"\nposition = 3\nmass = 1\nfrequencies = [1, 2]\n",
            "damping_ratios is missing"},
           {"kind = \"measured\"\nposition = 3\n", "file is missing, which a measured device"},
           {"kind = \"inerter\"\nposition = 3\n", "inertance is missing, which an inerter needs"},
           {"kind = \"stiffness\"\nposition = 3\n", "stiffness is missing, which a stiffness"}}) {
    const std::string message = refusal_of(text);
    EXPECT_TRUE(holds(message, "case.toml:3: [[device]]: device.1: " + missing)) << message;
  }
}

TEST(Devices, AKeyThatTheKindDoesNotUseIsRefusedWithThoseItUses) {
  EXPECT_EQ(
      refusal_of(devices[0] + "stiffness = 3\n"),
      "case.toml:7: device.1.stiffness = 3: a dashpot has no such key; its keys are position, "
      "to, damping, mass, clamp_mass");
  for (const auto& [device, key] :
       std::vector<std::pair<std::string, std::string>>{{devices[0], "inertance = 1"},
                                                        {devices[0], "frequencies = [3]"},
                                                        {devices[2], "mass_share = 0.5"},
                                                        {devices[4], "stiffness = 3"},
                                                        {devices[5], "mass = 3"},
                                                        {devices[6], "file = \"a.csv\""},
                                                        {devices[7], "inertance = 3"}})
    EXPECT_TRUE(holds(refusal_of(device + key + "\n"), " has no such key; its keys are position"))
        << key;
  EXPECT_TRUE(
      holds(refusal_of(devices[6] + "mass = 1\n"), "with to = \"ground\" an inerter has no mass"));
  for (const std::size_t k : {2U, 4U})
    EXPECT_TRUE(holds(refusal_of(devices[k] + "to = \"ground\"\n"),
                      "hangs on the conductor: set to = \"conductor\""));
}

TEST(Devices, ContradictionsAndValuesThatTheKindCannotHaveAreRefused) {
  for (const auto& [text, why] : std::vector<std::pair<std::string, std::string>>{
           {devices[2] + "frequencies = [3]\n",
            "case.toml:9: device.1.frequencies = [3]: frequencies replaces stiffness"},
           {devices[2] + "damping_ratios = [0.1]\n", "replaces damping: give only one"},
           {"kind = \"tuned_mass\"\nposition = 1\nmass = 1\nstiffness = 0\n",
            "stiffness of a tuned_mass must be greater than 0 N/m"},
           {"kind = \"inerter\"\nposition = 1\ninertance = 1\nstiffness = -1\n",
            "stiffness of an inerter must be at least 0 N/m"},
           {"kind = \"tuned_mass\"\nposition = 1\nmass = 1\nfrequencies = [1, 2]\n",
            "a tuned_mass needs 1 frequencies, not 2"},
           {"kind = \"stockbridge\"\nposition = 3\nmass = 1\nfrequencies = [1]\n"
            "damping_ratios = [0.1, 0.1]\n",
            "device.1.frequencies = [1]: a stockbridge needs 2 frequencies, not 1"},
           {"kind = \"stockbridge\"\nposition = 3\nmass = 1\nfrequencies = [2, 2]\n"
            "damping_ratios = [0.1, 0.1]\n",
            "frequencies must ascend"},
           {"kind = \"dashpot\"\nposition = 6.4\ndamping = 1\n",
            "case.toml:5: device.1.position = 6.4: device.1.position = 6.4 m must be less than "
            "conductor.span = 6.4 m"}})
    EXPECT_TRUE(holds(refusal_of(text), why)) << refusal_of(text);
}

TEST(Devices, EveryKeyRefusesAWrongTypeWithFileLineAndWhatIsAdmissible) {
  for (const DeviceKey& key : device_keys())
    for (const std::string value :
         {"true", "[\"1\"]", "[nan]", "1979-05-27", "{ a = 1 }", "\"nonsense\"", "inf", "[]"}) {
      if (key.kind == ValueKind::file && value.front() == '"') continue;  // as good a name as any
      const std::string message = refusal(case_of({devices[0], key.name + " = " + value + "\n"}));
      EXPECT_TRUE(holds(message, "case.toml:8: device.2." + key.name + " = ")) << message;
      EXPECT_TRUE(holds(message, key.admissible())) << message;
    }
}

TEST(Devices, EveryBoundedNumberRefusesWhatIsBelow) {
  for (const DeviceKey& key : device_keys()) {
    if (!key.is_number() || !std::isfinite(key.range.lowest)) continue;
    EXPECT_EQ(refusal_of(key.name + " = -1\n"),
              "case.toml:4: device.1." + key.name + " = -1: must be " + key.admissible());
  }
}

TEST(Devices, SlipsOfTheHandAreRecognised) {
  EXPECT_EQ(refusal_of("knd = \"dashpot\"\n").substr(0, 80),
            "case.toml:4: device.1.knd = 'dashpot': unknown key: did you mean device.1.kind (");
  EXPECT_TRUE(holds(refusal_of("kind = \"dashpod\"\n"), "did you mean \"dashpot\"?"));
  EXPECT_EQ(refusal("[device]\nkind = \"dashpot\"\n"),
            "case.toml:1: device must be a list of tables: write [[device]] before each device");
  EXPECT_TRUE(holds(refusal("device = 3\n"), "case.toml:1: device must be a list of tables"));
  EXPECT_TRUE(holds(refusal("device = [3]\n"), "case.toml:1: device = 3: must be a list"));
  EXPECT_EQ(refusal("[[devices]]\nkind = \"dashpot\"\n"),
            "case.toml:1: [[devices]]: unknown table: did you mean [[device]]?");
  EXPECT_TRUE(holds(refusal("[devices]\nkind = 1\n"), "did you mean [[device]]?"));
  EXPECT_TRUE(holds(refusal("[[control]]\nkind = 1\n"), "must be a table: write [control]"));
}

TEST(Devices, AreSetByTheirNumbers) {
  const std::string text = case_of({devices[0], devices[6]});
  const Case the_case = from_text(text, {"device.1.damping=1200", "device.2.position = 2.5"});
  EXPECT_EQ(the_case.devices[0].damping, 1200.0);
  EXPECT_EQ(the_case.devices[1].position, 2.5);
  EXPECT_EQ(the_case.places.at("device.1.damping"), "--set device.1.damping=1200");
  const Case another = from_text(text, {"device.1.kind=inerter", "device.1.inertance=3"});
  EXPECT_EQ(another.devices[0].kind, "inerter");
  EXPECT_EQ(another.devices[0].damping, 30.0);
}

TEST(Devices, OneMoreIsAddedByItsKind) {
  const Case the_case =
      load_case(std::nullopt, {"device.1.kind=stockbridge", "device.1.position=1",
                               "device.1.mass=0.2", "device.1.frequencies=[3, 9]",
                               "device.1.damping_ratios=[0.2,0.3]", "device.2.kind=measured",
                               "device.2.position=2", "device.2.file=my tables/#1.csv"});
  ASSERT_EQ(the_case.devices.size(), 2U);
  EXPECT_EQ(the_case.devices[0].frequencies, (std::vector<double>{3.0, 9.0}));
  EXPECT_EQ(the_case.devices[1].file, "my tables/#1.csv");
}

TEST(Devices, OverridesThatMeetNoDeviceAreRefused) {
  EXPECT_EQ(override_refusal({"device.1.damping=3"}),
            "--set device.1.damping=3: there is no device 1: the case has none; give device.1.kind "
            "to add device 1");
  EXPECT_TRUE(holds(override_refusal({"device.2.kind=dashpot"}), "there is no device 2"));
  for (const char* text : {"device=3", "device.1=3", "device.kind=dashpot",
                           "devices.1.kind=dashpot", "device.0.kind=dashpot", "device.1.kind.x"})
    EXPECT_TRUE(holds(override_refusal({text}), std::string("--set ") + text + ": ")) << text;
  EXPECT_TRUE(holds(override_refusal({"device.1.kind=dashpod"}), "did you mean \"dashpot\"?"));
  EXPECT_TRUE(holds(override_refusal({"device.1.dampin=3"}), "did you mean device.1.damping"));
  EXPECT_EQ(override_refusal({"device.1.kind="}),
            "--set device.1.kind=: expected key=value, but there is no value");
  EXPECT_TRUE(holds(override_refusal({"device.1.kind=dashpot"}),
                    "--set device.1.kind=dashpot: device.1: position is missing"));
  EXPECT_TRUE(holds(override_refusal({"device.1.kind=dashpot", "device.1.position=3 kg"}),
                    "kg is not a unit of this key: use m, mm"));
}

TEST(Devices, AShorterSpanLeavesThemOutside) {
  Case the_case = from_text(case_of(devices));
  set_case_value(the_case, "conductor.span", 6.0);
  const std::string message = message_of<WrongInput>([&] { check_case(the_case); });
  EXPECT_TRUE(holds(message, "device.5.position = 6.3 m must be less than")) << message;
}

const std::string header = "frequency_Hz,magnitude_N_s_per_m,phase_deg\n";

std::string table_refusal(const std::string& text) {
  return message_of<WrongInput>([&] { read_impedance_text(text, "shaker.csv"); });
}

TEST(ImpedanceTable, IsRead) {
  const ImpedanceTable table = read_impedance_text(
      "phase_deg,note,magnitude_N_s_per_m,frequency_Hz\n-90,a,3,5\n"
      "90,b,0,6.5\n360,c,2e3,7\n",
      "shaker.csv");
  EXPECT_EQ(table.frequency, (std::vector<double>{5.0, 6.5, 7.0}));
  EXPECT_EQ(table.magnitude, (std::vector<double>{3.0, 0.0, 2000.0}));
  EXPECT_EQ(table.phase_deg, (std::vector<double>{-90.0, 90.0, 360.0}));
}

TEST(ImpedanceTable, NamesFileAndLineOfAFault) {
  const auto rows = [](const std::string& last) {
    return table_refusal(header + "5,3,0\n" + last + "\n");
  };
  EXPECT_EQ(rows("5,3,0"), "shaker.csv:3: frequency_Hz = 5 must exceed 5 of the row before");
  EXPECT_EQ(rows("6,-3,0"), "shaker.csv:3: magnitude_N_s_per_m = -3: must be at least 0 N s/m");
  EXPECT_EQ(rows("6,3,361"),
            "shaker.csv:3: phase_deg = 361: must be at least -360 and at most 360 degrees");
  EXPECT_EQ(rows("6,nan,0"), "shaker.csv:3: magnitude_N_s_per_m = nan: must be finite");
  EXPECT_EQ(rows("6,3,"), "shaker.csv:3: phase_deg is missing");
  EXPECT_EQ(rows("6,3,x"), "shaker.csv:3: phase_deg = \"x\" is not a number");
  EXPECT_EQ(table_refusal(header + "0,3,0\n1,3,0\n"),
            "shaker.csv:2: frequency_Hz = 0: must be above 0 Hz");
  EXPECT_EQ(table_refusal(header + "5,3,0\n"),
            "shaker.csv: a table of impedance needs at least 2 rows, but has 1");
  EXPECT_TRUE(holds(table_refusal("frequency,magnitude,phase\n1,2,3\n"), "frequency_Hz"));
}

TEST(ImpedanceTable, ADeviceThatWouldGivePowerIsRefusedAtItsFrequency) {
  const std::string message = table_refusal(header + "5,3,0\n12.5,3,120\n");
  EXPECT_TRUE(holds(message, "shaker.csv:3: at 12.5 Hz the real part of the impedance is -1.5 N"))
      << message;
  EXPECT_TRUE(holds(message, "gives no power")) << message;
  EXPECT_TRUE(holds(table_refusal(header + "5,3,-91.2\n6,3,0\n"), "at 5 Hz"));
  EXPECT_EQ(read_impedance_text(header + "5,3,90\n6,0,180\n", "a").magnitude.size(), 2U)
      << "a mere mass, and nothing at all";
}

TEST(ImpedanceTable, PhasesThatMissByADegreeKeepTheImaginaryPartAlone) {
  Case the_case = load_case(std::nullopt, {});
  the_case.devices.resize(1);
  the_case.devices[0].file = "shaker.csv";
  the_case.devices[0].table = std::make_shared<const ImpedanceTable>(read_impedance_text(
      header + "5,100,90.4\n6,100,-91\n7,100,269.5\n8,100,30\n9,0,180\n", "shaker.csv"));
  const ImpedanceTable& table = *the_case.devices[0].table;
  std::vector<MeasuredImpedance::Row> rows;
  for (std::size_t k = 0; k < table.frequency.size(); ++k)
    rows.push_back({table.frequency[k],
                    std::polar(table.magnitude[k], table.phase_deg[k] * pi<double> / 180.0)});
  const MeasuredImpedance device(rows);  // refuses one that gives power
  const auto expect = [&](double frequency, double real, double imaginary) {
    EXPECT_NEAR(device.at(frequency).real(), real, 1e-12);
    EXPECT_NEAR(device.at(frequency).imag(), imaginary, 1e-12);
  };
  expect(5.0, 0.0, 100.0 * std::cos(0.4 * pi<double> / 180.0));
  expect(6.0, 0.0, -100.0 * std::cos(1.0 * pi<double> / 180.0));
  expect(7.0, 0.0, -100.0 * std::cos(0.5 * pi<double> / 180.0));
  expect(8.0, 50.0 * std::sqrt(3.0), 50.0);
  const auto doubts = impedance_doubts(the_case);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_TRUE(holds(doubts.front(), "3 row(s)") && holds(doubts.front(), "1.7452 %"))
      << doubts.front();
}

TEST(ImpedanceTable, PhasesInRadiansAreDoubted) {
  Case the_case = load_case(std::nullopt, {});
  the_case.devices.resize(1);
  const auto doubts = [&](const std::string& rows) {
    the_case.devices[0].file = "shaker.csv";
    the_case.devices[0].table =
        std::make_shared<const ImpedanceTable>(read_impedance_text(header + rows, "shaker.csv"));
    return impedance_doubts(the_case);
  };
  EXPECT_TRUE(doubts("5,3,0\n6,3,0.2\n").empty());
  EXPECT_TRUE(doubts("5,3,-20\n6,3,1.5\n").empty());
  ASSERT_EQ(doubts("5,3,-1.5\n6,3,1.2\n").size(), 1U);
  EXPECT_TRUE(holds(doubts("5,3,-1.5\n6,3,1.2\n").front(), "are the phases in radians?"));
}

TEST(MeasuredDevices, LieInTheFolderOfTheFileThatNamesThemAndAreReadOnce) {
  const TemporaryFolder folder;
  write_text(folder / "tables.csv", header + "5,3,0\n6,4,10\n");
  CaseSource source;
  source.name = (folder / "case.toml").string();
  source.text = "[[device]]\nkind = \"measured\"\nposition = 1\nfile = \"tables.csv\"\n";
  Case the_case = source.load();
  EXPECT_EQ(the_case.devices[0].file, (folder / "tables.csv").string());
  source.attach_record(the_case);
  ASSERT_NE(the_case.devices[0].table, nullptr);
  EXPECT_EQ(the_case.devices[0].table->magnitude, (std::vector<double>{3.0, 4.0}));
  const Case another = source.load({"device.1.position=2"});
  EXPECT_EQ(another.devices[0].table, the_case.devices[0].table);
  EXPECT_THROW(source.load({"device.1.file=absent.csv"}), WrongInput);
}

}  // namespace
}  // namespace holdfast::program
