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
constexpr AdmissibleRange wind_speeds{0.0, 150.0, true};  // strongest gust on record: 113 m/s
constexpr AdmissibleRange temperatures{-273.15, 1000.0, true};
constexpr AdmissibleRange ruling_spans{1.0, 1e4};
constexpr AdmissibleRange ices{0.0, 0.2};
constexpr AdmissibleRange ice_densities{100.0, 1000.0};
constexpr AdmissibleRange wind_pressures{0.0, 2e4};  // as of a wind of 180 m/s
constexpr AdmissibleRange expansions{0.0, 1e-3};
constexpr AdmissibleRange hours_of_year{0.0, 8784.0};
/// Range of whole numbers that a double represents exactly.
constexpr AdmissibleRange seed{0.0, 9007199254740992.0, false, false, true};

template <class Table>
struct KeysOf : Table {};
template <class Table>
struct KeysOf<std::optional<Table>> : Table {};

/// Pointer to the member of a table of a case; null for [wind] in a case without it.
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

/// A key that admits a number or one word.
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
                          "conductor of the library, whose data are used for keys not given")),
    number(KEY(conductor, mass_per_length), "kg/m", positive, "mass per unit length"),
    number(KEY(conductor, span), "m", positive, "distance between the supports, which are level"),
    number(KEY(conductor, sag), "m", positive, "sag at mid-span, below half the span"),
    number(KEY(conductor, area), "m2", positive, "cross section of all metal"),
    number(KEY(conductor, youngs_modulus), "Pa", positive, "Young's modulus"),
    number(KEY(conductor, damping_ratio), "", below_one, "damping ratio of the conductor's modes"),
    number(KEY(conductor, gravity), "m/s2", positive, "gravitational acceleration"),
    or_word("sag", number(KEY(conductor, tension), "N", positive,
                          "horizontal tension; \"sag\": computed from conductor.sag, "
                          "mass_per_length gravity span^2 / (8 sag)")),
    beyond_two_masses(number(KEY(conductor, bending_stiffness), "N m2", bending_stiffnesses,
                             "bending stiffness EI of a string's modes; for a named conductor the "
                             "least value, each wire bending individually")),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, diameter), "m", positive,
                                                "outside diameter; default: wind.diameter"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, rated_strength), "N", positive,
                                                "tension at which the conductor breaks"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, outer_wire_diameter), "m", positive,
                                                "diameter of the outermost wires"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, outer_wire_modulus), "Pa", positive,
                                                "Young's modulus of the outermost wires"))),
    beyond_two_masses(or_word("unknown", number(KEY(conductor, layers), "", some_layers,
                                                "number of layers of aluminium wires, which "
                                                "selects the fatigue curve (one, or several)"))),
    beyond_two_masses(
        or_word("unknown", number(KEY(conductor, thermal_expansion), "1/K", expansions,
                                  "relative growth of the length per kelvin; for a named conductor "
                                  "computed from its wires"))),
    beyond_two_masses(word(KEY(conductor, damping), {"chosen", "ratio", "rayleigh"},
                           "damping of the modes: one ratio for all, or Rayleigh damping; "
                           "\"chosen\": one ratio for a string, Rayleigh damping for a cable")),
    beyond_two_masses(key(ValueKind::interval, KEY(conductor, rayleigh_frequencies), "Hz", positive,
                          "the two frequencies at which Rayleigh damping equals damping_ratio")),

    number(KEY(stringing, temperature), "degC", temperatures,
           "temperature of the conductor when its tension or sag was measured"),
    number(KEY(stringing, tension), "N", positive, "horizontal tension at stringing.temperature"),
    number(KEY(stringing, sag), "m", positive, "sag at mid-span at stringing.temperature"),
    word(KEY(stringing, state), {"final", "initial"},
         "state of the conductor, when measured and now; \"final\": after creep and the heaviest "
         "load; \"initial\": new"),
    or_word("span",
            number(KEY(stringing, ruling_span), "m", ruling_spans,
                   "ruling span of a line with swinging insulators; it determines the tension")),

    or_word("stringing", number(KEY(weather, temperature), "degC", temperatures,
                                "temperature of the conductor in every job; \"stringing\": "
                                "stringing.temperature")),
    key(ValueKind::numbers, KEY(weather, temperatures), "degC", temperatures,
        "temperatures of the conductor over a year"),
    key(ValueKind::numbers, KEY(weather, hours), "h", hours_of_year,
        "hours per year at each of weather.temperatures"),
    number(KEY(weather, ice), "m", ices, "radial thickness of the heaviest ice on the span"),
    number(KEY(weather, ice_density), "kg/m3", ice_densities, "density of the ice"),
    number(KEY(weather, wind_pressure), "Pa", wind_pressures,
           "pressure of the wind on the conductor with its ice"),
    number(KEY(weather, load_temperature), "degC", temperatures,
           "temperature of the conductor under ice and wind"),

    number(KEY(absorber, mass), "kg", positive, "mass of the absorber"),
    number(KEY(absorber, position), "m", positive,
           "distance from the left support, inside the span"),
    beyond_two_masses(number(KEY(absorber, clamp_mass), "kg", clamp_masses,
                             "part of the absorber's mass that moves with the conductor")),
    beyond_two_masses(word(KEY(absorber, motion), {"vertical", "plane"},
                           "motion of the absorber's mass; vertical: only up and down; plane: also "
                           "sideways with the cable")),

    number(KEY(reduction, first_frequency), "Hz", positive,
           "lower natural frequency that the reduced plant is to have"),
    number(KEY(reduction, second_frequency), "Hz", positive,
           "higher natural frequency that the reduced plant is to have"),
    word(KEY(reduction, stiffness_reading), {"tangent", "secant", "least_squares"},
         "fit of a straight line, with slope k1, to the static force over displacement"),
    number(KEY(reduction, reading_below), "m", not_negative,
           "lower end of the fitted line, distance below the equilibrium"),
    number(KEY(reduction, reading_above), "m", not_negative,
           "upper end of the fitted line, distance above the equilibrium"),

    number(KEY(plant, conductor_mass), "kg", positive, "mass m1 that represents the conductor"),
    number(KEY(plant, conductor_stiffness), "N/m", positive, "stiffness k1 of the conductor"),
    number(KEY(plant, conductor_damping), "N s/m", not_negative, "damping c1 of the conductor"),
    number(KEY(plant, absorber_mass), "kg", not_negative,
           "mass m2 of the absorber; 0: no absorber, not allowed with plant.model two_masses"),
    number(KEY(plant, absorber_stiffness), "N/m", positive, "stiffness k2 of the absorber"),
    number(KEY(plant, absorber_damping), "N s/m", not_negative, "damping c2 of the absorber"),
    beyond_two_masses(word(KEY(plant, model), {"two_masses", "string", "cable", "infinite_string"},
                           "model of the conductor: one mass, a taut string, a hanging cable, or a "
                           "string without ends")),
    beyond_two_masses(or_word("chosen", number(KEY(plant, modes), "", some_modes,
                                               "number of modes of the conductor in the model; "
                                               "\"chosen\": set by the sampling rate"))),

    or_word(
        "tuned",
        number(KEY(control, proportional_gain), "N/m", any_number,
               "proportional gain P; \"tuned\": P = k2 - m2 (2 pi frequency)^2, the paper's Eq. 6"),
        [](Case& c) { return &c.control.proportional_gain_tuned; }),
    number(KEY(control, differential_gain), "N s/m", any_number, "differential gain D"),
    number(KEY(control, sampling_period), "s", positive, "time between samples"),
    number(KEY(control, processing_delay), "s", not_negative,
           "time from a sample to the force computed from it, up to 100 sampling periods"),
    number(KEY(control, displacement_quantum), "m", not_negative,
           "resolution of the measured displacement; 0: not rounded"),
    number(KEY(control, velocity_quantum), "m/s", not_negative,
           "resolution of the measured velocity; 0: not rounded"),
    word(KEY(control, velocity), {"measured", "difference"},
         "source of the velocity: measurement, or difference of successive displacements"),
    or_word("none", number(KEY(control, largest_force), "N", positive,
                           "largest force of the drive; \"none\": no limit")),
    or_word("none", number(KEY(control, measurement_filter), "Hz", positive,
                           "corner frequency of a first-order filter on the measured "
                           "displacement and velocity; \"none\": no filter")),
    or_word("none", number(KEY(control, drive_bandwidth), "Hz", positive,
                           "bandwidth of a drive that lags behind its command; \"none\": no lag")),
    or_word("first_order", number(KEY(control, drive_damping), "", positive,
                                  "damping ratio of a drive with second-order lag")),
    number(KEY(control, jitter), "s", not_negative,
           "largest deviation of a sampling instant from its regular time"),
    number(KEY(control, jitter_seed), "", seed, "seed of the random sampling instants"),

    number(KEY(backlash, width), "m", not_negative, "width r0 of the gap, the play"),
    word(KEY(backlash, law), {"kollar", "immediate", "play", "dead_zone", "none"},
         "contact law: the rule by which the drive enters and leaves the gap"),
    number(KEY(backlash, contact_stiffness), "N/m", not_negative, "stiffness of dead-zone stops"),
    number(KEY(backlash, contact_damping), "N s/m", not_negative, "damping of dead-zone stops"),

    replaced_by_wind(number(KEY(excitation, amplitude), "N", not_negative,
                            "amplitude of the harmonic force on the conductor")),
    replaced_by_wind(number(KEY(excitation, frequency), "Hz", positive,
                            "frequency of the harmonic force on the conductor")),
    word(KEY(excitation, hold), {"sampled", "exact"},
         "force held over each sample, or integrated exactly"),
    key(ValueKind::harmonics, KEY(excitation, harmonics), "", {},
        "[amplitude (N), frequency (Hz), phase (rad)] of each additional harmonic"),
    key(ValueKind::file, KEY(excitation, record), "", {},
        "CSV file of an additional force, columns time_s and force_N"),
    word(KEY(excitation, record_interpolation), {"linear", "held"},
         "force between the rows of the record: linear or held"),
    number(KEY(excitation, noise_rms), "N", not_negative,
           "root mean square of an additional random force; 0: no random force"),
    number(KEY(excitation, noise_lowest), "Hz", positive, "lowest frequency of the random force"),
    number(KEY(excitation, noise_highest), "Hz", positive, "highest frequency of the random force"),
    number(KEY(excitation, noise_lines), "", some_lines,
           "number of harmonics that make up the random force"),
    number(KEY(excitation, noise_seed), "", seed, "seed of the random force"),

    required(number(KEY(wind, speed), "m/s", positive, "wind speed across the conductor")),
    required(number(KEY(wind, diameter), "m", positive,
                    "diameter of the conductor; default: conductor.diameter")),
    required(number(KEY(wind, effective_length), "m", positive,
                    "length over which vortices are shed in step, for example half a wavelength")),
    number(KEY(wind, strouhal), "", positive, "Strouhal number"),
    number(KEY(wind, lift_coefficient), "", not_negative, "lift coefficient"),
    number(KEY(wind, air_density), "kg/m3", positive, "density of the air"),

    beyond_two_masses(key(ValueKind::numbers, KEY(site, speeds), "m/s", wind_speeds,
                          "speeds of the wind across the line, ascending")),
    beyond_two_masses(key(ValueKind::numbers, KEY(site, hours), "h", hours_of_year,
                          "hours per year that the wind has each speed")),
    beyond_two_masses(or_word("none", number(KEY(site, weibull_scale), "m/s", wind_speeds,
                                             "scale of Weibull's law, in place of site.speeds"))),
    beyond_two_masses(number(KEY(site, weibull_shape), "", positive,
                             "shape of Weibull's law; 2: Rayleigh's law")),
    beyond_two_masses(number(KEY(site, turbulence_intensity), "", up_to_one,
                             "standard deviation of the wind speed divided by its mean")),
    beyond_two_masses(
        number(KEY(site, years), "years", positive, "desired service life of the line")),

    number(KEY(initial, z1), "m", any_number, "displacement of the conductor, downward"),
    number(KEY(initial, v1), "m/s", any_number, "velocity of the conductor, downward"),
    number(KEY(initial, z2), "m", any_number, "displacement of the absorber, downward"),
    number(KEY(initial, v2), "m/s", any_number, "velocity of the absorber, downward"),
};

#undef KEY

}  // namespace

const std::vector<CaseKey>& case_keys() { return listed_keys; }

}  // namespace holdfast::program
