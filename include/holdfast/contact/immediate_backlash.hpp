#pragma once

#include "holdfast/contact/hysteresis.hpp"

namespace holdfast {

/// The backlash of Kollár 2022 read so that entry is tested at the exit sample too.
///
/// Rules 1 and 3 are those of `Backlash`. Rule 2 ends otherwise: a sample j that leaves the gap is
/// tested by rule 3 at once, so that with Δż_{j−1} ≠ 0 and Δż_{j−1} Δż_j ≤ 0 the drive passes from
/// its gap straight into the next one, [Δz_j − r₀, Δz_j] or [Δz_j, Δz_j + r₀], and transmits
/// nothing in between. From the same memory the two rules decide differently at those samples and
/// at no others.
///
/// Source: Kollár 2022, Eqs. (7)–(8), whose words leave both readings open; the switching instants
/// of its Fig. 8 exclude this one (docs/reading-the-paper.md).
template <class Scalar>
using ImmediateBacklash = Backlash<Scalar, EntryTest::at_exit>;

}  // namespace holdfast
