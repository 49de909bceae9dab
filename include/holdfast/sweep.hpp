#pragma once

/// Umbrella header for metrics of many motions, such as peaks and contact changes, in sweeps.

#include "holdfast/sweep/event_metric_batch.hpp"
#include "holdfast/sweep/event_metrics.hpp"
#include "holdfast/sweep/metric_batch.hpp"
#include "holdfast/sweep/metric_group.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "holdfast/sweep/modal_metrics.hpp"
#include "holdfast/sweep/motion_metrics.hpp"
#include "holdfast/sweep/sweep_matrices.hpp"
#include "holdfast/sweep/sweep_motion.hpp"
