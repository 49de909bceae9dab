#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "holdfast/stability/chart/proved_chart.hpp"

namespace holdfast {

namespace detail {

/// Sets that are joined two at a time.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t representative(std::size_t of) {
    while (parent_[of] != of) of = parent_[of] = parent_[parent_[of]];
    return of;
  }
  void join(std::size_t one, std::size_t other) {
    parent_[representative(one)] = representative(other);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// A side of a box: where it stands, and from where to where it goes.
struct BoxSide {
  double at, from, to;
  std::size_t box;
};

/// Joins the boxes of each pair of sides, one of either list, that share a piece of some length.
inline void join_along(std::vector<BoxSide> ends, std::vector<BoxSide> begins, JoinedSets& sets) {
  const auto by_place = [](const BoxSide& a, const BoxSide& b) {
    return std::tie(a.at, a.from) < std::tie(b.at, b.from);
  };
  std::sort(ends.begin(), ends.end(), by_place);
  std::sort(begins.begin(), begins.end(), by_place);
  auto end = ends.begin();
  for (auto begin = begins.begin(); begin != begins.end() && end != ends.end();) {
    if (begin->at == end->at && begin->from < end->to && end->from < begin->to)
      sets.join(begin->box, end->box);
    if (std::tie(begin->at, begin->to) < std::tie(end->at, end->to))
      ++begin;
    else
      ++end;
  }
}

}  // namespace detail

/// For each of some boxes that do not overlap the number of one box of its region: boxes are of one
/// region where a way through them leads from one to the other across sides that they share.
/// @param boxes  whose sides meet where they are the same doubles
inline std::vector<std::size_t> joined_boxes(const std::vector<GainBox>& boxes) {
  std::vector<detail::BoxSide> left, right, lower, upper;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto [p0, p1, d0, d1] = boxes[k];
    left.push_back({p0, d0, d1, k});
    right.push_back({p1, d0, d1, k});
    lower.push_back({d0, p0, p1, k});
    upper.push_back({d1, p0, p1, k});
  }
  detail::JoinedSets sets(boxes.size());
  detail::join_along(std::move(right), std::move(left), sets);
  detail::join_along(std::move(upper), std::move(lower), sets);
  std::vector<std::size_t> regions(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) regions[k] = sets.representative(k);
  return regions;
}

}  // namespace holdfast
