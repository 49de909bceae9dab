#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/excitation/forcing.hpp"
#include "holdfast/math/enclosure/enclosed_angle.hpp"
#include "holdfast/math/enclosure/enclosed_exponential.hpp"
#include "holdfast/math/enclosure/enclosure.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/orbit/state_scale.hpp"

namespace holdfast {

/// The surfaces and instants that decide when the contact changes between the samples, with the
/// unit of the distance from them.
enum class ContactSurface {
  reversal,             ///< reversal of an engaged drive, Δż = 0 (m/s)
  gap_lower,            ///< Δz at the lower end of the gap (m)
  gap_upper,            ///< Δz at the upper end of the gap (m)
  free_acceleration,    ///< change from stick to gap: Δz̈ = 0 without drive force (m/s²)
  driven_acceleration,  ///< change from stick to engaged: Δz̈ = 0 under the command (m/s²)
  sampling_instant,     ///< next sample, or instant at which a delayed command takes effect (s)
};

namespace detail {

/// The indices of the entries of w, the plant's state with command, gap position, force and time,
///
///     w = [z₁, ż₁, z₂, ż₂, u acting, u pending, g, F, F_s, 1, t],   ẇ = A w in each mode
///
/// g is the Δz at the last reversal, t the time since the sample. F is the excitation and F_s its
/// quadrature: F + i F_s rotates with the excitation, or is constant if it is held.
struct FlowPlace {
  static constexpr Eigen::Index command = 4, pending = 5, gap = 6, force = 7, quadrature = 8,
                                one = 9, time = 10;
  static constexpr int size = 11;
};

/// A linear function of w (FlowPlace), as a row vector of coefficients.
template <class Number>
using FlowRow = RowVector<Number, FlowPlace::size>;

/// A guard of a contact mode: a linear function h w that is positive while the mode lasts.
template <class Number>
struct EnclosedGuard {
  ContactSurface surface;              ///< surface on which the guard is zero
  std::vector<FlowRow<Number>> terms;  ///< rows h Aᵏ/k!, k = 0 … EnclosedModes::terms; in SI units
};

/// The three contact modes of a drive with exact play (contact/contact.hpp) as linear systems ẇ = A
/// w in interval arithmetic, with their guards; z and u in plant_scaling() units.
template <class Number>
class EnclosedModes {
 public:
  using Rate = Matrix<Number, FlowPlace::size>;       ///< matrix A
  using State = Vector<Number, FlowPlace::size>;      ///< state w (FlowPlace)
  using Row = FlowRow<Number>;                        ///< linear function of w
  using Guards = std::vector<EnclosedGuard<Number>>;  ///< guards of a mode

  /// Terms of the longest Taylor series of e^{As}, ‖A‖ s ≤ 3; remainder below e³ 3³⁴/34! = 10⁻²¹.
  static constexpr int terms = 34;
  /// An upper bound of e³, the growth of e^{As} over the longest series.
  static constexpr double most_growth = 20.1;

  /// @param ratio  forcing frequency × sampling period, f τ = p/q
  EnclosedModes(const IdealLoop<Number>& loop, const Rational& ratio)
      : in_doubles_(plant_scaling(
            Matrix<double, 4>(loop.plant.state_matrix().template cast<double>()),
            Vector<double, 4>(loop.plant.excitation_input().template cast<double>()))),
        units_(in_doubles_.template cast<Number>()),
        parts_{loop.sampling.processing_delay,
               loop.sampling.processing_delay == loop.sampling.period
                   ? Number()
                   : loop.sampling.period - loop.sampling.processing_delay} {
    for (const Number& part : parts_)
      if (!(part.lower() > 0.0) && part.upper() > 0.0)
        throw InvalidParameter(
            "processing delay", part.middle(), "s",
            "0, the sampling period, or different from both by more than rounding");
    for (const ContactMode mode : {ContactMode::engaged, ContactMode::gap, ContactMode::stick}) {
      rates_[at(mode)] = Sparse(rate_of(loop, mode));
      norm_ = std::max(norm_, norm_bound(rate(mode)));
    }
    longest_ = (Number(3.0) / Number(norm_)).lower();
    const Number mass = loop.plant.conductor_mass + loop.plant.absorber_mass;
    common_velocity_[1] = loop.plant.conductor_mass / mass;
    common_velocity_[3] = loop.plant.absorber_mass / mass;
    command_[0] = loop.gains.proportional * units_[0] / units_[4];
    command_[1] = loop.gains.differential * units_[1] / units_[4];
    for (std::int64_t j = 0; j < ratio.denominator; ++j) {
      const auto turn = static_cast<double>(j * ratio.numerator % ratio.denominator);
      const Number angle =
          Number(2.0) * pi<Number> * Number(turn) / Number(static_cast<double>(ratio.denominator));
      forces_.push_back(
          {loop.excitation.amplitude * cos(angle), loop.excitation.amplitude * sin(angle)});
    }
    make_guards(loop.backlash_width);
    make_steps();
  }

  /// The matrix A of a mode.
  const Rate& rate(ContactMode mode) const { return rates_[at(mode)].matrix; }
  /// The product A w for each column w of `states`.
  template <int Columns>
  Matrix<Number, FlowPlace::size, Columns> moved(
      ContactMode mode, const Matrix<Number, FlowPlace::size, Columns>& states) const {
    return product<Columns>(rates_[at(mode)], states);
  }
  /// The product e^{As} w for each column w of `states` and all s in `length` (s).
  /// @param length  |s| ≤ longest()
  template <int Columns>
  Matrix<Number, FlowPlace::size, Columns> flowed(
      ContactMode mode, const Matrix<Number, FlowPlace::size, Columns>& states,
      const Number& length) const {
    const double middle = length.middle();
    return by_series<Columns>(mode, by_series<Columns>(mode, states, Number(middle)),
                              length - Number(middle));
  }

  /// The number of terms with which a Taylor series over a time `length` (s) is exact to rounding.
  int terms_for(double length) const {
    int count = 1;
    for (double rest = most_growth; rest > 1e-22 && count < terms; ++count)
      rest *= norm_ * length / count;
    return count;
  }
  /// The longest time (s) that one Taylor series covers, 3/‖A‖.
  double longest() const { return longest_; }
  /// The length (s) of a part of the sampling period: δ for part 0, τ − δ for part 1.
  const Number& part(std::size_t number) const { return parts_[number]; }
  /// The number of equal pieces, each ≤ longest(), into which a part is divided; 0 if it is empty.
  int pieces(std::size_t part) const { return pieces_[part]; }
  /// The product e^{As} w for each column w of `states`, s being piece(part).
  template <int Columns>
  Matrix<Number, FlowPlace::size, Columns> over_piece(
      ContactMode mode, std::size_t part,
      const Matrix<Number, FlowPlace::size, Columns>& states) const {
    return product<Columns>(steps_[part][at(mode)], states);
  }
  /// The length (s) of each of the pieces(part) equal pieces of a part.
  Number piece(std::size_t part) const { return parts_[part] / Number(double(pieces_[part])); }

  /// A mode's guards for a sign σ of Δż. Engaged: σ Δż. Gap: distances of Δz from the upper and
  /// lower end. Stick: σ a(0), then −σ a(u), with the relative acceleration a(s) under a force s.
  const Guards& guards(ContactMode mode, double sign) const {
    return guards_[at(mode)][sign > 0.0 ? 1 : 0];
  }
  /// The row whose product with w is Δz (m).
  Row displacement() const { return units_[2] * unit(2) - units_[0] * unit(0); }
  /// The row whose product with w is Δż (m/s).
  Row velocity() const { return units_[3] * unit(3) - units_[1] * unit(1); }
  /// The row whose product with w is a(0) (m/s²), the relative acceleration without drive force.
  Row free_acceleration() const { return velocity() * rate(ContactMode::gap); }
  /// The row whose product with w is (m₁ ż₁ + m₂ ż₂)/(m₁ + m₂), in the unit of ż.
  const Row& common_velocity() const { return common_velocity_; }
  /// The row whose product with w is the command P z₁ + D ż₁, in the unit of u.
  const Row& command() const { return command_; }
  /// The forces F and F_s (N) at a sample; they are constant up to the next sample if F is held.
  const std::pair<Number, Number>& force(std::size_t sample) const {
    return forces_[sample % forces_.size()];
  }
  /// The units of [z₁, ż₁, z₂, ż₂, u], from plant_scaling().
  const Vector<double, 5>& units() const { return in_doubles_; }

  /// The row whose product with w is one coordinate of w.
  static Row unit(Eigen::Index coordinate) {
    Row row = Row::Zero();
    row[coordinate] = Number(1.0);
    return row;
  }

 private:
  struct Sparse {
    Rate matrix = Rate::Zero();
    std::vector<std::pair<Eigen::Index, Eigen::Index>> entries = {};

    explicit Sparse(const Rate& dense = Rate::Zero()) : matrix(dense) {
      for (Eigen::Index i = 0; i < dense.rows(); ++i)
        for (Eigen::Index j = 0; j < dense.cols(); ++j)
          if (dense(i, j).magnitude() > 0.0) entries.emplace_back(i, j);
    }
  };
  template <int Columns>
  static Matrix<Number, FlowPlace::size, Columns> product(
      const Sparse& sparse, const Matrix<Number, FlowPlace::size, Columns>& states) {
    Matrix<Number, FlowPlace::size, Columns> result =
        Matrix<Number, FlowPlace::size, Columns>::Zero();
    for (const auto& [i, j] : sparse.entries) result.row(i) += sparse.matrix(i, j) * states.row(j);
    return result;
  }

  static std::size_t at(ContactMode mode) { return static_cast<std::size_t>(mode); }

  /// The product e^{As} w by one Taylor series. A wider `length` gives a wider enclosure.
  template <int Columns>
  Matrix<Number, FlowPlace::size, Columns> by_series(
      ContactMode mode, const Matrix<Number, FlowPlace::size, Columns>& states,
      const Number& length) const {
    Matrix<Number, FlowPlace::size, Columns> term = states, sum = states;
    const int count = terms_for(length.magnitude());
    for (int k = 1; k < count; ++k) {
      term = moved<Columns>(mode, term) * (length / Number(double(k)));
      sum += term;
    }
    // ‖e^X − Σ_{k<m} Xᵏ/k!‖ ≤ ‖X‖ᵐ/m! e^{‖X‖}.
    Number rest(most_growth);
    for (int k = 1; k <= count; ++k) rest *= Number(norm_) * length / Number(double(k));
    for (Eigen::Index column = 0; column < states.cols(); ++column) {
      double size = 0.0;
      for (Eigen::Index i = 0; i < states.rows(); ++i)
        size = std::max(size, states(i, column).magnitude());
      const double bound = (Number(rest.magnitude()) * Number(size)).upper();
      sum.col(column).array() += Number(-bound, bound);
    }
    return sum;
  }

  Rate rate_of(const IdealLoop<Number>& loop, ContactMode mode) const {
    Rate a = Rate::Zero();
    const TwoMass<Number>& plant = loop.plant;
    if (mode == ContactMode::stick) {
      const Number mass = plant.conductor_mass + plant.absorber_mass;
      a(0, 1) = a(2, 3) = Number(1.0);
      for (const Eigen::Index row : {1, 3}) {
        // Δż = 0: both masses have the acceleration of the conductor.
        a(row, 0) = -plant.conductor_stiffness / mass;
        a(row, 1) = -plant.conductor_damping / mass;
        a(row, FlowPlace::force) = Number(1.0) / mass;
      }
    } else {
      a.template topLeftCorner<4, 4>() = plant.state_matrix();
      a.col(FlowPlace::force).template head<4>() = plant.excitation_input();
      if (mode == ContactMode::engaged)
        a.col(FlowPlace::command).template head<4>() = plant.control_input();
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
      a.row(i) /= units_[i];
      a.template topRows<4>().col(i) *= units_[i];
    }
    a.col(FlowPlace::command).template head<4>() *= units_[4];
    a(FlowPlace::time, FlowPlace::one) = Number(1.0);
    if (loop.hold == ForceHold::exact) {
      const Number turns = loop.excitation.angular_frequency();
      a(FlowPlace::force, FlowPlace::quadrature) = -turns;
      a(FlowPlace::quadrature, FlowPlace::force) = turns;
    }
    return a;
  }

  EnclosedGuard<Number> guard(ContactMode mode, ContactSurface surface, const Row& row) const {
    EnclosedGuard<Number> result{surface, {row}};
    for (int k = 1; k <= terms; ++k)
      result.terms.push_back((result.terms.back() * rate(mode)).eval() / Number(double(k)));
    return result;
  }

  void make_guards(const Number& width) {
    if (!(width.upper() > 0.0)) return;  // a drive without backlash stays engaged
    const Row lower = displacement() - unit(FlowPlace::gap), upper = -lower,
              wide = width * unit(FlowPlace::one);
    const Row driven = velocity() * rate(ContactMode::engaged);
    for (const bool positive : {false, true}) {
      const Number sign(positive ? 1.0 : -1.0);
      const auto add = [&, k = positive ? 1U : 0U](ContactMode mode, ContactSurface surface,
                                                   const Row& row) {
        guards_[at(mode)][k].push_back(guard(mode, surface, row));
      };
      add(ContactMode::engaged, ContactSurface::reversal, sign * velocity());
      // The end of the gap at which the drive reversed is g.
      add(ContactMode::gap, ContactSurface::gap_upper, positive ? upper : Row(upper + wide));
      add(ContactMode::gap, ContactSurface::gap_lower, positive ? Row(lower + wide) : lower);
      add(ContactMode::stick, ContactSurface::free_acceleration, sign * free_acceleration());
      add(ContactMode::stick, ContactSurface::driven_acceleration, -sign * driven);
    }
  }

  void make_steps() {
    for (std::size_t part = 0; part < 2; ++part) {
      if (!parts_[part].is_positive()) continue;  // δ = 0, or δ = τ
      pieces_[part] = static_cast<int>(std::ceil(parts_[part].upper() / longest_));
      for (std::size_t mode = 0; mode < 3; ++mode)
        steps_[part][mode] = Sparse(exponential(Rate(rates_[mode].matrix * piece(part))));
    }
  }

  Vector<double, 5> in_doubles_;
  Vector<Number, 5> units_;
  std::array<Sparse, 3> rates_;
  Row command_ = Row::Zero(), common_velocity_ = Row::Zero();
  std::vector<std::pair<Number, Number>> forces_;
  double norm_ = 0.0, longest_ = 0.0;  // of all modes
  std::array<Number, 2> parts_;
  std::array<int, 2> pieces_{};
  std::array<std::array<Sparse, 3>, 2> steps_;
  std::array<std::array<Guards, 2>, 3> guards_;
};

}  // namespace detail
}  // namespace holdfast
