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

/// The tables of a case file, one struct each. Members are named as the keys; case_keys() has their
/// units, admissible ranges and meanings.
namespace case_tables {

/// Value of a number that is neither given nor has a default: require_keys() reports it.
inline constexpr double absent = std::numeric_limits<double>::quiet_NaN();

struct Conductor {
  std::string name;  // name in the conductor library; "": none
  double mass_per_length = absent;
  double span = absent;
  double sag = absent;
  double area = absent;
  double youngs_modulus = absent;
  double damping_ratio = absent;
  double gravity = 9.81;
  double tension = std::numeric_limits<double>::infinity();  // infinity: "sag", computed from it
  double bending_stiffness = 0.0;
  // Infinity in each of the next six numbers: "unknown".
  double diameter = std::numeric_limits<double>::infinity();
  double rated_strength = std::numeric_limits<double>::infinity();
  double outer_wire_diameter = std::numeric_limits<double>::infinity();
  double outer_wire_modulus = std::numeric_limits<double>::infinity();
  double layers = std::numeric_limits<double>::infinity();  // whole
  double thermal_expansion = std::numeric_limits<double>::infinity();
  std::string damping = "chosen";  // "chosen": a ratio for the string, Rayleigh for the cable
  std::array<double, 2> rayleigh_frequencies{2.0, 7.0};  // Hz
};

/// Temperature and tension or sag of stringing, from which the tension in other weather follows.
struct Stringing {
  double temperature = absent;  // °C
  double tension = absent;      // horizontal
  double sag = absent;          // alternative to the tension
  std::string state = "final";
  double ruling_span = std::numeric_limits<double>::infinity();  // infinity: "span", its own
};

/// Temperatures, ice and wind of a strung span.
struct Weather {
  double temperature = std::numeric_limits<double>::infinity();  // °C; infinity: "stringing"
  std::vector<double> temperatures;                              // °C, over a year
  std::vector<double> hours;                                     // per year, at each
  double ice = 0.0;                                              // radial thickness
  double ice_density = 900.0;
  double wind_pressure = 0.0;
  double load_temperature = 0.0;  // °C, under ice and wind
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
  double proportional_gain = 0.0;  // unused while tuned, see resolved_proportional_gain()
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
  double jitter = 0.0;                                                  // largest deviation
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
  std::string record;                            // file, relative to the working folder; "": none
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

/// A passive device clamped to the conductor. Its kind decides which members are used.
struct Device {
  std::string kind;
  double position = 0.0;            // m from the left support
  std::string to = "ground";        // body that it acts against: ground, or a mass on the conductor
  double damping = 0.0;             // N s/m
  double stiffness = 0.0;           // N/m; below 0 only for kind "stiffness"
  double inertance = 0.0;           // kg
  double mass = 0.0;                // kg, hung mass; of a stockbridge the sum of its weights
  double clamp_mass = 0.0;          // kg, moves with the conductor
  std::vector<double> frequencies;  // Hz; empty: `stiffness` is used
  std::vector<double> damping_ratios;  // of each frequency; empty: `damping` is used
  double mass_share = 0.5;             // of a stockbridge: share swinging at its first frequency
  std::string file;                    // of a measured device, relative to the working folder

  // Impedance table of `file`, read by CaseSource::attach_record(); null: not measured.
  std::shared_ptr<const ImpedanceTable> table;
};

/// Uncertainty of a number of the case.
struct Uncertain {
  enum class Form { interval, relative, absolute };

  std::string key;  // "conductor.tension"
  Form form;
  double below;  // interval: lowest value; else the decrease, relative or in the key's unit
  double above;  // interval: highest value; else the increase
};

/// Yearly wind statistics at the site of the line.
struct Site {
  std::vector<double> speeds;  // m/s, ascending; empty: Weibull's law, or unknown
  std::vector<double> hours;   // per year, at each
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

/// Content of a case file, in the units of case_keys(). load_case() returns a checked case.
struct Case {
  case_tables::Conductor conductor;
  case_tables::Stringing stringing;
  case_tables::Weather weather;
  case_tables::Absorber absorber;
  case_tables::Reduction reduction;
  case_tables::Plant plant;
  case_tables::Control control;
  case_tables::Backlash backlash;
  // With [wind] its amplitude and frequency are replaced: see effective_excitation().
  case_tables::Excitation excitation;
  std::optional<case_tables::Wind> wind;
  std::vector<case_tables::Device> devices;
  case_tables::Site site;
  case_tables::Initial initial;
  std::vector<case_tables::Uncertain> uncertain;

  // Force of the file excitation.record, read by CaseSource::attach_record(); null: no file.
  std::shared_ptr<const RecordedForce> force_record;

  // User-defined plant and controller; null: neither. CaseSource passes them to each case.
  std::shared_ptr<const OwnParts> own;

  // Place of each given key: "plant.absorber_mass" -> "my.toml:12" or "--set plant.model=string".
  std::map<std::string, std::string> places;
  bool is_given(const std::string& key) const { return places.count(key) > 0; }

  // Whether the case file describes its own cable or plant, so that no built-in value is used.
  bool stands_alone = false;
  // Whether the user gave a key of [plant] that the two masses depend on, and a key of [conductor],
  // [absorber], [reduction], [stringing] or [weather].
  bool plant_given = false;
  bool conductor_given = false;
  // Whether a frequency of [reduction] is computed from the conductor, not given.
  bool first_frequency_computed = false;
  bool second_frequency_computed = false;
};

/// Whether the span has an absorber with a computer. The built-in absorber belongs to another
/// cable: with [[device]] or conductor.name it counts only if the user gives a key of [absorber],
/// [control] or plant.absorber_*.
bool has_active_absorber(const Case& the_case);

/// Whether a user-defined plant replaces conductor and absorber.
bool has_own_plant(const Case& the_case);

/// Whether plant.model is "two_masses" and no user-defined plant replaces it.
bool is_two_masses(const Case& the_case);

/// Whether the case has a measurement filter or a drive of finite bandwidth.
bool has_hardware(const Case& the_case);

/// Whether the plant has an absorber: plant.absorber_mass above 0, or a user-defined plant.
bool has_absorber(const Case& the_case);

/// Whether [stringing] gives a temperature, a tension or a sag.
bool has_stringing(const Case& the_case);

/// Whether a key of [site] differs from its default.
bool has_site(const Case& the_case);

/// Names, for a message, of the features that the plain loop of two masses lacks; "" if none.
std::string modal_words(const Case& the_case);

/// Whether plant.model is "infinite_string", a string without ends.
bool is_infinite(const Case& the_case);

/// Whether plant.model is "cable", a hanging cable of finite elements.
bool is_cable(const Case& the_case);

/// Excitation of the conductor: [excitation] as given, or with amplitude and frequency from [wind]:
/// frequency = strouhal·speed/diameter (Hz), amplitude = ½·air_density·speed²·diameter·
/// effective_length·lift_coefficient (N).
case_tables::Excitation effective_excitation(const Case& the_case);

/// A wind whose vortices have the frequency of [excitation], for a case without [wind]. The
/// diameter is the conductor's or, if unknown, that of a strand of its area. The effective length
/// is half a wavelength, at most the span. Throws MissingKeys.
case_tables::Wind wind_for(const Case& the_case);

/// Warning about vortices outside the range of aeolian vibration, 3 to 150 Hz, with the
/// consequence; empty within this range, without [wind] or with an unknown sag.
std::string wind_warning(const Case& the_case);

/// The proportional gain P (N/m) that the loop uses: the number given, or for "tuned" by Eq. 6 of
/// Kollár 2022, P = k2 − m2 ω², with ω = 2π·frequency of effective_excitation().
double resolved_proportional_gain(const Case& the_case);

}  // namespace holdfast::program
