#pragma once

/// Umbrella header for the drive's backlash: contact laws at samples and in continuous time.

#include "holdfast/contact/contact.hpp"
#include "holdfast/contact/contact_guard.hpp"
#include "holdfast/contact/contact_law.hpp"
#include "holdfast/contact/contact_mode.hpp"
#include "holdfast/contact/dead_zone.hpp"
#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/contact/mode_dynamics.hpp"
#include "holdfast/contact/play.hpp"
