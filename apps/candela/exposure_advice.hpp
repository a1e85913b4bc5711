#pragma once

#include "job.hpp"

namespace candela::app {

/// Warns where a manual exposure leaves nearly all of a picture black or clipped: by how many stops it is
/// off, and which EV100 the automatic exposure would take.
void advise_exposure(Job& job, const realtime::Still& still);

}  // namespace candela::app
