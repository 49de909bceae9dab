#pragma once

/// Umbrella header for number types, SIMD lanes, axes, intervals and exceptions.

#include "holdfast/core/axis.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/core/interval_sets.hpp"
#include "holdfast/core/lanes.hpp"
#include "holdfast/core/log_axis.hpp"
#include "holdfast/core/rational.hpp"
#include "holdfast/core/select.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/core/version.hpp"
