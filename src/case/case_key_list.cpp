#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

#include "case/case_keys.hpp"

namespace holdfast::program {
namespace {

using Words = std::vector<std::string>;

constexpr AdmissibleRange positive{0.0, std::numeric_limits<double>::infinity(), true};
constexpr AdmissibleRange not_negative{0.0};
constexpr AdmissibleRange clamp_masses{0.0, 1e4};
constexpr AdmissibleRange bending_stiffnesses{0.0, 1e12};
constexpr AdmissibleRange below_one{0.0, 1.0, false, true};
constexpr AdmissibleRange any_number{};
constexpr AdmissibleRange some_lines{1.0, 10000.0, false, false, true};
constexpr AdmissibleRange some_modes{1.0, 1000.0, false, false, true};
constexpr AdmissibleRange some_layers{1.0, 5.0, false, false, true};
constexpr AdmissibleRange up_to_one{0.0, 1.0};
constexpr AdmissibleRange wind_speeds{0.0, 150.0, true};  // the strongest gust on record had 113
constexpr AdmissibleRange temperatures{-273.15, 1000.0, true};
constexpr AdmissibleRange ruling_spans{1.0, 1e4};
constexpr AdmissibleRange ices{0.0, 0.2};
constexpr AdmissibleRange ice_densities{100.0, 1000.0};
constexpr AdmissibleRange wind_pressures{0.0, 2e4};  // 180 m/s
constexpr AdmissibleRange expansions{0.0, 1e-3};
constexpr AdmissibleRange hours_of_year{0.0, 8784.0};
/// Whole numbers that a double tells apart.
constexpr AdmissibleRange seed{0.0, 9007199254740992.0, false, false, true};

template <class Table>
struct KeysOf : Table {};
template <class Table>
struct KeysOf<std::optional<Table>> : Table {};

/// Where the member of a table lies in a case; null for [wind] where the case has none.
template <auto Table, auto Member>
ValuePlace where(Case& the_case) {
  auto& table = the_case.*Table;
  if constexpr (std::is_same_v<decltype(table), std::optional<case_tables::Wind>&>)
    return table ? &((*table).*Member) : nullptr;
  else
    return &(table.*Member);
}

/// The name of a key and where its value lies.
#define KEY(table, member) \
#table "." #member, where < &Case::table, &KeysOf < decltype(Case::table)> ::member>

using Place = ValuePlace (*)(Case&);

CaseKey key(ValueKind kind, const char* name, Place place, const char* unit,
            const AdmissibleRange& range, const char* description) {
  return {{name, unit, description, range, {}, kind}, place};
}

CaseKey number(const char* name, Place place, const char* unit, const AdmissibleRange& range,
               const char* description) {
  return key(ValueKind::number, name, place, unit, range, description);
}

CaseKey word(const char* name, Place place, Words words, const char* description) {
  return {{name, "", description, {}, std::move(words), ValueKind::word}, place};
}

/// A number that a word may stand for.
CaseKey or_word(const char* word, CaseKey key, bool* (*tuned)(Case&) = nullptr) {
  key.words = {word};
  key.tuned = tuned;
  return key;
}

CaseKey required(CaseKey key) {
  key.required = true;
  return key;
}

CaseKey beyond_two_masses(CaseKey key) {
  key.beyond_two_masses = true;
  return key;
}

CaseKey replaced_by_wind(CaseKey key) {
  key.replaced_by_wind = true;
  return key;
}

const std::vector<CaseKey> listed_keys = {
    beyond_two_masses(key(ValueKind::conductor, KEY(conductor, name), "", {},
                          "of a conductor whose data in the library stand where none are given")),
    number(KEY(conductor, mass_per_length), "kg/m", positive,
           "mass of the conductor per unit length"),
    number(KEY(conductor, span), "m", positive, "distance between the supports, which are level"),
    number(KEY(conductor, sag), "m", positive, "sag at mid-span, below half the span"),
    number(KEY(conductor, area), "m2", positive, "cross section"),
    number(KEY(conductor, youngs_modulus), "Pa", positive, "Young's modulus"),
    number(KEY(conductor, damping_ratio), "", below_one, "fraction of critical damping"),
    number(KEY(conductor, gravity), "m/s2", positive, "gravitational acceleration"),
    or_word("sag", number(KEY(conductor, tension), "N", positive,
                          "horizontal tension; \"sag\": the one that the sag leaves, "
                          "mass_per_length gravity span^2 / (8 sag)")),
    beyond_two_masses(number(KEY(conductor, bending_stiffness), "N m2", bending_stiffnesses,
                             "EI, which stiffens the modes of the string; of a named conductor the "
                             "least, its wires bending one by one")),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, diameter), "m", positive,
                                                "outside; wind.diameter where that is not given"))),
    beyond_two_masses(or_word(
        "unknown", number(KEY(conductor, rated_strength), "N", positive, "at which it breaks"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, outer_wire_diameter), "m", positive,
                                                "of the wires of the outermost layer"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, outer_wire_modulus), "Pa", positive,
                                                "Young's modulus of those wires"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, layers), "", some_layers,
                                                "of aluminium wires, which decide how many "
                                                "vibrations they bear"))),
    beyond_two_masses(
        or_word("unknown", number(KEY(conductor, thermal_expansion), "1/K", expansions,
                                  "of its length with the temperature; of a named "
                                  "conductor its wires tell it"))),
    beyond_two_masses(word(KEY(conductor, damping), {"chosen", "ratio", "rayleigh"},
                           "of the modes: damping_ratio of each, or Rayleigh's; \"chosen\": ratio "
                           "of the string, Rayleigh's of the cable")),
    beyond_two_masses(key(ValueKind::interval, KEY(conductor, rayleigh_frequencies), "Hz", positive,
                          "the two at which Rayleigh's damping is damping_ratio")),

    number(KEY(stringing, temperature), "degC", temperatures,
           "of the conductor when its tension or sag was read"),
    number(KEY(stringing, tension), "N", positive, "horizontal tension then"),
    number(KEY(stringing, sag), "m", positive, "or sag then, at mid-span"),
    word(
        KEY(stringing, state), {"final", "initial"},
        "whether it was read, and the span is, after years of creep and the heaviest load, or new"),
    or_word("span", number(KEY(stringing, ruling_span), "m", ruling_spans,
                           "of a line whose insulators swing, which the tension follows")),

    or_word("stringing", number(KEY(weather, temperature), "degC", temperatures,
                                "of the conductor for every job; \"stringing\": the one at which "
                                "it was strung")),
    key(ValueKind::numbers, KEY(weather, temperatures), "degC", temperatures,
        "of the conductor over a year"),
    number(KEY(weather, ice), "m", ices, "radial thickness of the ice that the span has borne"),
    number(KEY(weather, ice_density), "kg/m3", ice_densities, "of the ice"),
    number(KEY(weather, wind_pressure), "Pa", wind_pressures,
           "of the wind that comes with the ice, on conductor and ice"),
    number(KEY(weather, load_temperature), "degC", temperatures,
           "of the conductor under ice and wind"),

    number(KEY(absorber, mass), "kg", positive, "mass of the absorber"),
    number(KEY(absorber, position), "m", positive,
           "distance from the left support, inside the span"),
    beyond_two_masses(number(KEY(absorber, clamp_mass), "kg", clamp_masses,
                             "what of the absorber moves with the conductor, on its own modes")),
    beyond_two_masses(word(KEY(absorber, motion), {"vertical", "plane"},
                           "whether its mass moves up and down alone, or goes sideways with the "
                           "cable too")),

    number(KEY(reduction, first_frequency), "Hz", positive,
           "lower natural frequency that the plant shall have"),
    number(KEY(reduction, second_frequency), "Hz", positive,
           "higher natural frequency that the plant shall have"),
    word(KEY(reduction, stiffness_reading), {"tangent", "secant", "least_squares"},
         "how a straight line is laid through the static deflection"),
    number(KEY(reduction, reading_below), "m", not_negative,
           "how far below the equilibrium the line is laid"),
    number(KEY(reduction, reading_above), "m", not_negative,
           "how far above the equilibrium the line is laid"),

    number(KEY(plant, conductor_mass), "kg", positive, "m1"),
    number(KEY(plant, conductor_stiffness), "N/m", positive, "k1"),
    number(KEY(plant, conductor_damping), "N s/m", not_negative, "c1"),
    number(KEY(plant, absorber_mass), "kg", not_negative,
           "m2; 0: no absorber, the devices alone, with every plant.model but two_masses"),
    number(KEY(plant, absorber_stiffness), "N/m", positive, "k2"),
    number(KEY(plant, absorber_damping), "N s/m", not_negative, "c2"),
    beyond_two_masses(word(KEY(plant, model), {"two_masses", "string", "cable", "infinite_string"},
                           "what the absorber hangs on: one mass, or the conductor by its modes, "
                           "taut, hanging or without ends")),
    beyond_two_masses(or_word("chosen", number(KEY(plant, modes), "", some_modes,
                                               "how many modes of the conductor are kept; "
                                               "\"chosen\": by the sampling rate"))),

    or_word("tuned",
            number(KEY(control, proportional_gain), "N/m", any_number,
                   "P; \"tuned\" takes k2 - m2 (2 pi frequency)^2, Eq. 6"),
            [](Case& c) { return &c.control.proportional_gain_tuned; }),
    number(KEY(control, differential_gain), "N s/m", any_number, "D"),
    number(KEY(control, sampling_period), "s", positive, "time between samples"),
    number(KEY(control, processing_delay), "s", not_negative,
           "from taking a sample to applying its force, up to 100 periods"),
    number(KEY(control, displacement_quantum), "m", not_negative,
           "step of the measured displacement; 0: none"),
    number(KEY(control, velocity_quantum), "m/s", not_negative,
           "step of the measured velocity; 0: none"),
    word(KEY(control, velocity), {"measured", "difference"},
         "whether the velocity is measured or the difference of two displacements"),
    or_word("none", number(KEY(control, largest_force), "N", positive,
                           "of the drive, at which the command is cut off; \"none\": no limit")),
    or_word("none", number(KEY(control, measurement_filter), "Hz", positive,
                           "corner of the first-order filter before the computer reads "
                           "displacement and velocity; \"none\": no filter")),
    or_word("none", number(KEY(control, drive_bandwidth), "Hz", positive,
                           "at which the drive lags behind its command; \"none\": it does not")),
    or_word("first_order", number(KEY(control, drive_damping), "", positive,
                                  "damping ratio of a drive whose lag is of second order")),
    number(KEY(control, jitter), "s", not_negative,
           "largest deviation of a sampling instant from its place"),
    number(KEY(control, jitter_seed), "", seed, "of the random sampling instants"),

    number(KEY(backlash, width), "m", not_negative, "r0"),
    word(KEY(backlash, law), {"kollar", "immediate", "play", "dead_zone", "none"},
         "the rule by which the drive enters and leaves the gap"),
    number(KEY(backlash, contact_stiffness), "N/m", not_negative, "of the stops of a dead zone"),
    number(KEY(backlash, contact_damping), "N s/m", not_negative, "of the stops of a dead zone"),

    replaced_by_wind(number(KEY(excitation, amplitude), "N", not_negative,
                            "of the harmonic force on the conductor")),
    replaced_by_wind(number(KEY(excitation, frequency), "Hz", positive,
                            "of the harmonic force on the conductor")),
    word(KEY(excitation, hold), {"sampled", "exact"}, "whether the force is held over each sample"),
    key(ValueKind::harmonics, KEY(excitation, harmonics), "", {},
        "[amplitude (N), frequency (Hz), phase (rad)] of each further harmonic"),
    key(ValueKind::file, KEY(excitation, record), "", {},
        "CSV file of a further force, columns time_s and force_N"),
    word(KEY(excitation, record_interpolation), {"linear", "held"},
         "between the rows of the record"),
    number(KEY(excitation, noise_rms), "N", not_negative,
           "root mean square of a further random force; 0: none"),
    number(KEY(excitation, noise_lowest), "Hz", positive,
           "lower end of the band of the random force"),
    number(KEY(excitation, noise_highest), "Hz", positive,
           "upper end of the band of the random force"),
    number(KEY(excitation, noise_lines), "", some_lines,
           "number of harmonics that the random force is made of"),
    number(KEY(excitation, noise_seed), "", seed, "of the phases of the random force"),

    required(number(KEY(wind, speed), "m/s", positive, "speed across the conductor")),
    required(number(KEY(wind, diameter), "m", positive,
                    "of the conductor; that of [conductor] where it is known")),
    required(number(KEY(wind, effective_length), "m", positive,
                    "length over which vortices are shed in step, for instance half a wave")),
    number(KEY(wind, strouhal), "", positive, "Strouhal number"),
    number(KEY(wind, lift_coefficient), "", not_negative, "lift coefficient"),
    number(KEY(wind, air_density), "kg/m3", positive, "density of the air"),

    beyond_two_masses(key(ValueKind::numbers, KEY(site, speeds), "m/s", wind_speeds,
                          "of the wind across the line, ascending")),
    beyond_two_masses(key(ValueKind::numbers, KEY(site, hours), "h", hours_of_year,
                          "how long a year the wind has each speed")),
    beyond_two_masses(or_word("none", number(KEY(site, weibull_scale), "m/s", wind_speeds,
                                             "of Weibull's law, in place of speeds and hours"))),
    beyond_two_masses(
        number(KEY(site, weibull_shape), "", positive, "of Weibull's law; 2 is Rayleigh's")),
    beyond_two_masses(number(KEY(site, turbulence_intensity), "", up_to_one,
                             "standard deviation of the wind's speed over its mean")),
    beyond_two_masses(
        number(KEY(site, years), "years", positive, "service life that is asked for")),

    number(KEY(initial, z1), "m", any_number, "displacement of the conductor, downward"),
    number(KEY(initial, v1), "m/s", any_number, "velocity of the conductor"),
    number(KEY(initial, z2), "m", any_number, "displacement of the absorber, downward"),
    number(KEY(initial, v2), "m/s", any_number, "velocity of the absorber"),
};

#undef KEY

}  // namespace

const std::vector<CaseKey>& case_keys() { return listed_keys; }

}  // namespace holdfast::program
