#pragma once

#include <complex>

#include "holdfast/stability/boundary/boundary.hpp"
#include "holdfast/stability/response/modal_response.hpp"

namespace holdfast {

namespace detail {

/// Stability boundary of a loop of any order: the gains P and D with a root e^{iθ}, for each θ.
template <class Scalar>
class CircleBoundary {
 public:
  CircleBoundary(const ModalResponse<Scalar>& response, const Interval<double>& range)
      : response_(response), range_(range), nearby_(response, Scalar(0)) {
    for (const std::complex<Scalar>& increment : response.pole_increments())
      if (increment.imag() > Scalar(0)) pole_angles_.push_back(std::arg(Scalar(1) + increment));
  }

  /// The gains with a root pair e^{±iθ}: P = Im G_v / Im(Ḡ_z G_v), D = −Im G_z / Im(Ḡ_z G_v).
  PdGains<Scalar> gains(const Scalar& angle) const {
    const CommandResponse<Scalar> g = nearby_.read(angle).first;
    const Scalar determinant = std::imag(std::conj(g.displacement) * g.velocity);
    return {g.velocity.imag() / determinant, -g.displacement.imag() / determinant};
  }

  static Scalar between(const Scalar& lower, const Scalar& upper) {
    return lower + (upper - lower) / Scalar(2);
  }
  static Scalar angle(const Scalar& angle) { return angle; }
  static BoundaryCurve pair_kind() { return BoundaryCurve::complex_pair; }

  /// Appends both ends, within the range of P, of the line of gains with the root λ = 1 or −1.
  void append_line(BoundaryCurve curve, std::vector<BoundaryPoint<Scalar>>& points) const {
    const Scalar angle = curve == BoundaryCurve::plus_one ? Scalar(0) : pi<Scalar>;
    const CommandResponse<Scalar> g = response_.at_angle(angle);
    const Scalar by_p = g.displacement.real(), by_d = g.velocity.real();
    const bool idle = !(std::abs(by_d) > Scalar(1e-9) * response_size());
    detail::append_line(
        points, BoundaryLine<Scalar>{curve, angle, Scalar(1), -by_p, idle ? Scalar(0) : -by_d},
        range_);
  }

  void append_curve(std::vector<BoundaryPoint<Scalar>>& points) const {
    const CurveTracer<Scalar, CircleBoundary> tracer(*this, range_, 14);
    std::vector<CurvePlace<Scalar>> places;
    for (const Scalar& angle : starting_angles()) places.push_back(tracer.at(angle));
    tracer.trace(places, points);
  }

 private:
  /// The largest |G_v| at θ = π/2 and the poles' angles; values below 1e−9 of it are round-off.
  Scalar response_size() const {
    Scalar largest = std::abs(response_.at_angle(pi<Scalar> / Scalar(2)).velocity);
    for (const Scalar& angle : pole_angles_)
      largest = std::max(largest, std::abs(response_.at_angle(angle).velocity));
    return largest;
  }

  /// The initial angles, dense near 0, π and the angle of each pole, where the curve changes fast.
  std::vector<Scalar> starting_angles() const {
    std::vector<Scalar> angles, centres = pole_angles_;
    centres.insert(centres.end(), {Scalar(0), pi<Scalar>});
    for (const Scalar& centre : centres)
      for (Scalar offset = Scalar(1e-6); offset < pi<Scalar>; offset *= Scalar(1.2))
        for (const Scalar angle : {centre - offset, centre + offset})
          if (angle > Scalar(0) && angle < pi<Scalar>) angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    return angles;
  }

  const ModalResponse<Scalar>& response_;
  Interval<double> range_;
  std::vector<Scalar> pole_angles_;
  mutable typename ModalResponse<Scalar>::Nearby nearby_;  // the angles asked for mostly ascend
};

}  // namespace detail

/// Points of the stability boundary of a loop of any order in the plane of P and D.
///
/// The curve of root pairs e^{±iθ} follows from 1 − P G_z(e^{iθ}) − D G_v(e^{iθ}) = 0, two real
/// linear equations for P and D. `circle_crossings` gives crossings with a line of constant P or D.
/// @param response  transfer functions G_z and G_v from the command to the measured displacement
///                  and velocity
/// @param range     range of P (N/m), its ends included
/// @return the two ends of each straight line (root λ = 1 or −1), then the points of the curve by
///         ascending angle, denser where the curve bends
/// @throws InvalidParameter unless range.lower < range.upper, both finite
template <class Scalar>
std::vector<BoundaryPoint<Scalar>> stability_boundary(const ModalResponse<Scalar>& response,
                                                      const Interval<double>& range) {
  validate_proportional(range);
  const detail::CircleBoundary<Scalar> boundary(response, range);
  std::vector<BoundaryPoint<Scalar>> points;
  boundary.append_line(BoundaryCurve::plus_one, points);
  boundary.append_line(BoundaryCurve::minus_one, points);
  boundary.append_curve(points);
  return points;
}

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template std::vector<BoundaryPoint<double>> stability_boundary(const ModalResponse<double>&,
                                                                      const Interval<double>&);
#endif

}  // namespace holdfast
