#pragma once

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace holdfast {
class RecordedForce;
}

namespace holdfast::program {

struct ImpedanceTable;
struct OwnParts;

/// The tables of a case file, one struct each; the members bear the names of the keys. Units,
/// admissible ranges and meaning of each are in case_keys().
namespace case_tables {

/// A number that nobody gave and nothing stands in for; its users ask for it: needed.hpp.
inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

struct Conductor {
  std::string name;  // of the library; "": none
  double mass_per_length = absent;
  double span = absent;
  double sag = absent;
  double area = absent;
  double youngs_modulus = absent;
  double damping_ratio = absent;
  double gravity = 9.81;
  double tension = std::numeric_limits<double>::infinity();  // infinity: "sag", what that leaves
  double bending_stiffness = 0.0;
  // Infinity: "unknown".
  double diameter = std::numeric_limits<double>::infinity();
  double rated_strength = std::numeric_limits<double>::infinity();
  double outer_wire_diameter = std::numeric_limits<double>::infinity();
  double outer_wire_modulus = std::numeric_limits<double>::infinity();
  double layers = std::numeric_limits<double>::infinity();  // whole
  double thermal_expansion = std::numeric_limits<double>::infinity();
  std::string damping = "chosen";  // by the plant: ratio of the string, Rayleigh's of the cable
  std::array<double, 2> rayleigh_frequencies{2.0, 7.0};  // Hz
};

/// How the span was strung, which its tension at other temperatures follows from.
struct Stringing {
  double temperature = absent;  // °C
  double tension = absent;      // horizontal
  double sag = absent;          // or its sag
  std::string state = "final";
  double ruling_span = std::numeric_limits<double>::infinity();  // infinity: "span"
};

/// The weather that a strung span meets.
struct Weather {
  double temperature = std::numeric_limits<double>::infinity();  // °C; infinity: "stringing"
  std::vector<double> temperatures;                              // °C, of a year
  std::vector<double> hours;                                     // a year, at each
  double ice = 0.0;                                              // radial
  double ice_density = 900.0;
  double wind_pressure = 0.0;
  double load_temperature = 0.0;  // °C, at which ice and that wind come
};

struct Absorber {
  double mass = absent;
  double position = absent;
  double clamp_mass = 0.0;
  std::string motion = "vertical";
};

struct Reduction {
  double first_frequency = absent;   // Hz
  double second_frequency = absent;  // Hz
  std::string stiffness_reading = "least_squares";
  double reading_below = 0.008;
  double reading_above = 0.007;
};

struct Plant {
  double conductor_mass = absent;
  double conductor_stiffness = absent;
  double conductor_damping = absent;
  double absorber_mass = absent;
  double absorber_stiffness = absent;
  double absorber_damping = absent;
  std::string model = "two_masses";
  double modes = std::numeric_limits<double>::infinity();  // whole; infinity: "chosen"
};

struct Control {
  double proportional_gain = 0.0;  // not in force while tuned: ask resolved_proportional_gain()
  bool proportional_gain_tuned = false;
  double differential_gain = 0.0;
  double sampling_period = absent;
  double processing_delay = 0.0;
  double displacement_quantum = 0.0;
  double velocity_quantum = 0.0;
  std::string velocity = "measured";
  double largest_force = std::numeric_limits<double>::infinity();       // infinity: "none"
  double measurement_filter = std::numeric_limits<double>::infinity();  // Hz; infinity: "none"
  double drive_bandwidth = std::numeric_limits<double>::infinity();     // Hz; infinity: "none"
  double drive_damping = std::numeric_limits<double>::infinity();       // infinity: "first_order"
  double jitter = 0.0;                                                  // half width
  double jitter_seed = 1.0;                                             // whole
};

struct Backlash {
  double width = 0.0;
  std::string law = "kollar";
  double contact_stiffness = 0.0;
  double contact_damping = 0.0;
};

struct Excitation {
  double amplitude = 0.0;
  double frequency = absent;  // Hz
  std::string hold = "sampled";
  std::vector<std::array<double, 3>> harmonics;  // amplitude (N), frequency (Hz), phase (rad)
  std::string record;                            // a file, seen from the working folder; "": none
  std::string record_interpolation = "linear";
  double noise_rms = 0.0;
  double noise_lowest = 1.0;    // Hz
  double noise_highest = 50.0;  // Hz
  double noise_lines = 1000.0;  // whole
  double noise_seed = 1.0;      // whole
};

struct Wind {
  double speed = 0.0;
  double diameter = 0.0;
  double effective_length = 0.0;
  double strouhal = 0.2;
  double lift_coefficient = 1.0;
  double air_density = 1.225;
};

/// A passive device clamped on the conductor. What of it counts, its kind says: device_keys.hpp.
struct Device {
  std::string kind;
  double position = 0.0;            // from the left support
  std::string to = "ground";        // what it pushes against, the ground or a mass that it carries
  double damping = 0.0;             // N s/m
  double stiffness = 0.0;           // N/m; below 0 of a stiffness alone
  double inertance = 0.0;           // kg
  double mass = 0.0;                // kg, what hangs below; of a stockbridge its weights together
  double clamp_mass = 0.0;          // kg, moves with the conductor
  std::vector<double> frequencies;  // Hz; empty: a tuned mass has a stiffness
  std::vector<double> damping_ratios;  // of each; empty: a tuned mass has a damping
  double mass_share = 0.5;             // of a stockbridge: what swings at the first frequency
  std::string file;                    // measured: seen from the working folder

  // Table of the file; null of every other kind. CaseSource::attach_record() reads it.
  std::shared_ptr<const ImpedanceTable> table;
};

/// A range that a number of the case is uncertain in.
struct Uncertain {
  enum class Form { interval, relative, absolute };

  std::string key;  // "conductor.tension"
  Form form;
  double below;  // lowest end; or how much less, of the value or in the key's unit
  double above;
};

/// The wind where the line stands, over a year.
struct Site {
  std::vector<double> speeds;  // m/s, ascending; empty: by Weibull's law, or not known
  std::vector<double> hours;   // a year, at each
  double weibull_scale = std::numeric_limits<double>::infinity();  // m/s; infinity: "none"
  double weibull_shape = 2.0;
  double turbulence_intensity = 0.0;
  double years = 40.0;
};

struct Initial {
  double z1 = 0.0;
  double v1 = 0.0;
  double z2 = 0.0;
  double v2 = 0.0;
};

}  // namespace case_tables

/// Everything that a case file says, in SI units. load_case() makes one that is checked.
struct Case {
  case_tables::Conductor conductor;
  case_tables::Stringing stringing;
  case_tables::Weather weather;
  case_tables::Absorber absorber;
  case_tables::Reduction reduction;
  case_tables::Plant plant;
  case_tables::Control control;
  case_tables::Backlash backlash;
  // With wind, its amplitude and frequency do not count: ask effective_excitation().
  case_tables::Excitation excitation;
  std::optional<case_tables::Wind> wind;
  std::vector<case_tables::Device> devices;
  case_tables::Site site;
  case_tables::Initial initial;
  std::vector<case_tables::Uncertain> uncertain;

  // Record of excitation.record; null where it is "". CaseSource::attach_record() reads it.
  std::shared_ptr<const RecordedForce> force_record;

  // Plant and controller of the user's own; null where there is neither. CaseSource hands it on.
  std::shared_ptr<const OwnParts> own;

  // Where the user gave a key: "plant.absorber_mass" -> "my.toml:12" or "--set plant....=0.2".
  std::map<std::string, std::string> places;
  bool is_given(const std::string& key) const { return places.count(key) > 0; }

  // The case file describes its own cable or plant: nothing of the built-in case is in it.
  bool stands_alone = false;
  bool plant_given = false;      // the user gave a key of [plant] that the two masses depend on
  bool conductor_given = false;  // or one of [conductor], [absorber] or [reduction]
  // The frequencies of [reduction] are computed from the conductor: it is the user's, they are not.
  bool first_frequency_computed = false;
  bool second_frequency_computed = false;
};

/// Whether the case has an absorber with a computer on its span. A file of its own cable has one
/// where it gives one. The built-in one counts beside [[device]] or a named conductor where the
/// user says something of it: it is of another cable.
bool has_active_absorber(const Case& the_case);

/// Whether the plant is one of the user's own, in place of conductor and absorber.
bool has_own_plant(const Case& the_case);

/// Whether the conductor is one mass.
bool is_two_masses(const Case& the_case);

/// Whether the readings are filtered or the drive lags.
bool has_hardware(const Case& the_case);

/// Whether an absorber hangs on the conductor; without one its devices are alone.
bool has_absorber(const Case& the_case);

/// Whether anything is said of how the span was strung.
bool has_stringing(const Case& the_case);

/// Whether anything is said of the site.
bool has_site(const Case& the_case);

/// The parts of a case that make its loop more than two masses and a computer, for a message.
std::string modal_words(const Case& the_case);

/// Whether the conductor is a string without ends.
bool is_infinite(const Case& the_case);

/// Whether that conductor is the hanging cable in elements, and not the taut string.
bool is_cable(const Case& the_case);

/// The force on the conductor: [excitation] as given, or with its amplitude and frequency made from
/// [wind]: frequency = strouhal·speed/diameter (Hz), amplitude = ½·air_density·speed²·diameter·
/// effective_length·lift_coefficient (N).
case_tables::Excitation effective_excitation(const Case& the_case);

/// A wind for a case without one: it sheds vortices at the frequency of [excitation] from the
/// conductor, or a strand of its area where its diameter is unknown, in step over one half-wave of
/// that frequency.
case_tables::Wind wind_for(const Case& the_case);

/// Why the wind's vortices are not those of aeolian vibration (3 to 150 Hz), in words for a
/// warning; empty where they are, or there is no wind.
std::string wind_warning(const Case& the_case);

/// The proportional gain in force (N/m): the number given, or for "tuned" Eq. 6,
/// P = k2 − m2 ω², with ω = 2π·frequency of effective_excitation().
double resolved_proportional_gain(const Case& the_case);

}  // namespace holdfast::program
