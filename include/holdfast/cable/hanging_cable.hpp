#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "holdfast/cable/conductor.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast {

/// Horizontal and vertical extent of a segment of an elastic catenary, as functions of its
/// horizontal tension H (N) and of the upward force V (N) on its left end.
template <class Scalar>
struct CatenaryExtent {
  Scalar horizontal;             ///< horizontal extent (m)
  Scalar vertical;               ///< vertical extent (m), downward positive
  Matrix<Scalar, 2> derivative;  ///< derivative matrix ∂(horizontal, vertical)/∂(H, V) (m/N)
};

/// Horizontal extent x and downward extent y (m) of a segment of an elastic catenary. The tension
/// is T(s) = √(H² + (V − w s)²) at the coordinate s, the unstretched length from the left end:
///
///     x = H l/EA + (H/w) [asinh(V/H) − asinh((V − w l)/H)]
///     y = l (2V − w l)/(2EA) + [T(0) − T(l)]/w
///
/// The derivative of (x, y) by (H, V) is the Hessian of the complementary energy ∫ (T²/2EA + T) ds:
/// symmetric, positive definite for H > 0. Source: H. M. Irvine, Cable Structures, 1981, Sect. 1.4.
/// @param weight          weight w per unstretched length (N/m), > 0
/// @param stiffness       axial stiffness EA (N), > 0
/// @param tension         horizontal tension H (N), > 0
/// @param vertical_force  vertical force V (N) on the left end, upward positive
/// @param length          unstretched length l (m) of the segment, ≥ 0
template <class Scalar>
CatenaryExtent<Scalar> catenary_extent(const Scalar& weight, const Scalar& stiffness,
                                       const Scalar& tension, const Scalar& vertical_force,
                                       const Scalar& length) {
  using std::asinh;
  using std::sqrt;
  const Scalar end_force = vertical_force - weight * length;
  const Scalar first = sqrt(tension * tension + vertical_force * vertical_force);
  const Scalar last = sqrt(tension * tension + end_force * end_force);
  const Scalar turn = (asinh(vertical_force / tension) - asinh(end_force / tension)) / weight;
  const Scalar sines = (vertical_force / first - end_force / last) / weight;
  const Scalar coupling = tension / weight * (Scalar(1) / first - Scalar(1) / last);
  const Scalar stretch = length / stiffness;
  CatenaryExtent<Scalar> extent;
  extent.horizontal = tension * (stretch + turn);
  extent.vertical = stretch * (vertical_force + end_force) / Scalar(2) + (first - last) / weight;
  extent.derivative << stretch + turn - sines, coupling, coupling, stretch + sines;
  return extent;
}

/// Outcome of the search for the equilibrium of a cable of span L.
enum class EquilibriumOutcome {
  converged,  ///< bars: forces balanced to round-off; catenary: ends within 2·10⁻¹¹ L of supports
  not_converged,  ///< no equilibrium found: slack bars, or a load too large for the precision
};

/// Equilibrium of the whole cable under one vertical point load; forces are NaN if none is found.
template <class Scalar>
struct LoadedCable {
  Scalar tension;              ///< horizontal tension H (N), constant along the cable
  Scalar vertical_force;       ///< upward force V (N) of the left support on the cable
  EquilibriumOutcome outcome;  ///< whether the equilibrium was found
};

/// The exact statics of an elastic cable: two elastic catenaries, joined at the point load.
///
/// The bare cable carries its own weight only; its sag determines the unstretched length l₀. A
/// material point has the coordinate s (m), 0 … l₀: the unstretched length from the left support.
/// The load P (N, downward positive) acts at s_p, the parameter `place`. In equilibrium the right
/// end lies on its support (L, 0), and the strictly convex energy ∫ (T²/2EA + T) ds − H L is
/// stationary in (H, V). Every load has exactly one solution, found by Newton's method with
/// backtracking from any start. Source: H. M. Irvine, Cable Structures, 1981, Sect. 1.4.
template <class Scalar>
class HangingCable {
 public:
  /// Computes the bare cable. @param conductor  admissible conductor, see `validate`
  explicit HangingCable(const Conductor<Scalar>& conductor)
      : weight_(conductor.weight_per_length()),
        stiffness_(conductor.axial_stiffness()),
        span_(conductor.span) {
    settle_length(conductor);
  }

  /// Length l₀ (m) of the cable without tension.
  const Scalar& unstretched_length() const { return length_; }
  /// Horizontal tension H (N) of the bare cable.
  const Scalar& bare_tension() const { return bare_tension_; }
  /// Span L (m) between the two level supports.
  const Scalar& span() const { return span_; }
  /// Axial stiffness EA (N).
  const Scalar& axial_stiffness() const { return stiffness_; }
  /// Weight w = μ g (N per metre of unstretched length).
  const Scalar& weight_per_length() const { return weight_; }

  /// Equilibrium of the bare cable.
  LoadedCable<Scalar> bare() const {
    return {bare_tension_, weight_ * length_ / Scalar(2), bare_outcome_};
  }

  /// Coordinate s (m) of the material point that lies at x (m, 0 … L) in the bare cable.
  Scalar material_coordinate(const Scalar& x) const {
    using std::abs;
    Scalar below(0), above = length_, s = length_ * x / span_;
    for (int step = 0; step < 100; ++step) {
      const Scalar miss = extent(bare(), s).horizontal - x;
      (miss > Scalar(0) ? above : below) = s;
      const Scalar change = miss / horizontal_stretch(bare(), s);
      if (!(abs(change) > resolution() * length_)) break;
      const Scalar next = s - change;
      s = next > below && next < above ? next : (below + above) / Scalar(2);
    }
    return s;
  }

  /// Equilibrium under any load P (N) at the coordinate s_p = `place` (m), 0 < s_p < l₀.
  LoadedCable<Scalar> under_load(const Scalar& load, const Scalar& place) const {
    LoadedCable<Scalar> cable = bare();
    cable.vertical_force += load * (Scalar(1) - place / length_);
    const auto miss_of = [&](const CatenaryExtent<Scalar>& extent) {
      return Vector<Scalar, 2>(extent.horizontal - span_, extent.vertical);
    };
    auto spanned = whole(cable, load, place);
    Scalar miss = miss_of(spanned).norm();
    for (int step = 0; step < 200 && miss > resolution() * span_; ++step) {
      Vector<Scalar, 2> change =
          step_within(-(spanned.derivative.inverse() * miss_of(spanned)).eval(), cable.tension);
      bool closer = false;
      for (int halving = 0; halving < 40 && !closer; ++halving, change /= Scalar(2)) {
        const LoadedCable<Scalar> trial{cable.tension + change[0], cable.vertical_force + change[1],
                                        cable.outcome};
        const auto trial_spanned = whole(trial, load, place);
        const Scalar trial_miss = miss_of(trial_spanned).norm();
        closer = trial_miss < miss;
        if (!closer) continue;
        cable = trial;
        spanned = trial_spanned;
        miss = trial_miss;
      }
      if (!closer) break;
    }
    if (miss < largest_miss() * span_) {
      cable.outcome = EquilibriumOutcome::converged;
      return cable;
    }
    const Scalar none = std::numeric_limits<Scalar>::quiet_NaN();
    return {none, none, EquilibriumOutcome::not_converged};
  }

  /// Extent of the whole cable with the forces H and V of `cable` and a load P (N) at s_p (m).
  CatenaryExtent<Scalar> whole(const LoadedCable<Scalar>& cable, const Scalar& load,
                               const Scalar& place) const {
    const auto left = extent(cable, place);
    const auto right =
        catenary_extent<Scalar>(weight_, stiffness_, cable.tension,
                                cable.vertical_force - weight_ * place - load, length_ - place);
    return {left.horizontal + right.horizontal, left.vertical + right.vertical,
            left.derivative + right.derivative};
  }

  /// Extent from the left support to a material point s (m) left of the load, 0 ≤ s ≤ s_p.
  CatenaryExtent<Scalar> extent(const LoadedCable<Scalar>& cable, const Scalar& s) const {
    return catenary_extent<Scalar>(weight_, stiffness_, cable.tension, cable.vertical_force, s);
  }

  /// Position [x, y] (m), y downward, of the material point s (m), 0 … l₀, with a load P at s_p.
  Vector<Scalar, 2> point(const LoadedCable<Scalar>& cable, const Scalar& load, const Scalar& place,
                          const Scalar& s) const {
    const auto left = extent(cable, s < place ? s : place);
    if (!(s > place)) return {left.horizontal, left.vertical};
    const auto beyond =
        catenary_extent<Scalar>(weight_, stiffness_, cable.tension,
                                cable.vertical_force - weight_ * place - load, s - place);
    return {left.horizontal + beyond.horizontal, left.vertical + beyond.vertical};
  }

 private:
  /// Largest admissible error at the right support, relative to the span.
  static Scalar largest_miss() { return Scalar(1e5) * std::numeric_limits<Scalar>::epsilon(); }
  static Scalar resolution() { return Scalar(4) * std::numeric_limits<Scalar>::epsilon(); }

  /// The derivative dx/ds = H/EA + H/T at the unstretched coordinate s (m).
  Scalar horizontal_stretch(const LoadedCable<Scalar>& cable, const Scalar& s) const {
    using std::hypot;
    const Scalar vertical = cable.vertical_force - weight_ * s;
    return cable.tension / stiffness_ + cable.tension / hypot(cable.tension, vertical);
  }

  /// Finds H and l of half the bare cable by Newton's method: x(l) = L/2, y(l) = f, V = w l.
  void settle_length(const Conductor<Scalar>& conductor) {
    const Vector<Scalar, 2> target(span_ / Scalar(2), conductor.sag);
    Scalar tension = conductor.parabolic_tension(), half = conductor.effective_length() / Scalar(2);
    for (int step = 0; step < 100; ++step) {
      const Scalar support = weight_ * half;
      const auto extent = catenary_extent<Scalar>(weight_, stiffness_, tension, support, half);
      using std::hypot;
      const Scalar taut = hypot(tension, support);
      Matrix<Scalar, 2> jacobian;  // by H, and by l with V = w l
      jacobian.col(0) = extent.derivative.col(0);
      jacobian.col(1) << tension / stiffness_ + tension / taut,
          support / stiffness_ + support / taut;
      const Vector<Scalar, 2> miss(extent.horizontal - target[0], extent.vertical - target[1]);
      bare_outcome_ = miss.norm() < largest_miss() * span_ ? EquilibriumOutcome::converged
                                                           : EquilibriumOutcome::not_converged;
      const Vector<Scalar, 2> change = step_within(-(jacobian.inverse() * miss).eval(), tension);
      tension += change[0];
      half += change[1];
      if (!(change.cwiseAbs().cwiseQuotient(Vector<Scalar, 2>(tension, half)).maxCoeff() >
            resolution()))
        break;
    }
    bare_tension_ = tension;
    length_ = Scalar(2) * half;
  }

  /// A Newton step, shortened so that the tension remains at least a tenth of its present value.
  static Vector<Scalar, 2> step_within(const Vector<Scalar, 2>& newton, const Scalar& tension) {
    const Scalar floor = Scalar(-0.9) * tension;
    if (!(newton[0] < floor)) return newton;
    return newton * (floor / newton[0]);
  }

  Scalar weight_, stiffness_, span_;
  Scalar length_{}, bare_tension_{};
  EquilibriumOutcome bare_outcome_ = EquilibriumOutcome::not_converged;
};

/// Force–displacement relation of the loaded point of a cable by the exact statics of HangingCable.
/// The interface equals that of `IrvinePointLoad`. Load P and displacement w are downward positive;
/// w is measured from the cable without load. Results are NaN if no equilibrium is found.
template <class Scalar>
class CatenaryPointLoad {
 public:
  /// @param conductor  conductor of the cable, one that `validate` accepts
  /// @param position   horizontal distance x_p (m) of the loaded point from the left support in the
  ///                   cable without load, 0 < x_p < span
  CatenaryPointLoad(const Conductor<Scalar>& conductor, const Scalar& position)
      : cable_(conductor),
        place_(cable_.material_coordinate(position)),
        bare_drop_(cable_.extent(cable_.bare(), place_).vertical),
        lowest_load_(-conductor.weight() / Scalar(2)) {}

  /// The cable's exact statics, for any load at any point.
  const HangingCable<Scalar>& cable() const { return cable_; }
  /// Unstretched length s_p (m) of the cable from the left support to the loaded point.
  const Scalar& material_coordinate() const { return place_; }

  /// Horizontal tension H (N) under a load P (N).
  Scalar tension(const Scalar& load) const { return cable_.under_load(load, place_).tension; }

  /// Displacement (m) of the loaded point under a load P (N).
  Scalar displacement(const Scalar& load) const {
    return cable_.extent(cable_.under_load(load, place_), place_).vertical - bare_drop_;
  }

  /// Displacement (m), under a load P (N), of the point that lies at x (m, 0 … L) without load.
  Scalar deflection(const Scalar& x, const Scalar& load) const {
    const Scalar s = cable_.material_coordinate(x);
    const auto loaded = cable_.under_load(load, place_);
    return cable_.point(loaded, load, place_, s)[1] - cable_.extent(cable_.bare(), s).vertical;
  }

  /// Tangent stiffness dP/dw (N/m) of the loaded point at a load P (N), with both supports fixed.
  Scalar stiffness(const Scalar& load) const {
    const auto loaded = cable_.under_load(load, place_);
    const auto left = cable_.extent(loaded, place_).derivative;
    const auto whole = cable_.whole(loaded, load, place_).derivative;
    const Vector<Scalar, 2> right = whole.col(1) - left.col(1);
    const Vector<Scalar, 2> change = whole.inverse() * right;
    return Scalar(1) / left.row(1).dot(change);
  }

  /// Lower limit −μ g L/2 (N) of the load of `IrvinePointLoad`; this class itself has no limit.
  Scalar lowest_load() const { return lowest_load_; }

 private:
  HangingCable<Scalar> cable_;
  Scalar place_, bare_drop_, lowest_load_;
};

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template class HangingCable<double>;
extern template class CatenaryPointLoad<double>;
#endif

}  // namespace holdfast
