#pragma once

namespace candela::app {

/// The option that makes a `candela bench` leave after its first frame.
inline constexpr const char* kFirstFrameOnly = "--first-frame-only";

/// Milliseconds from the start of a process to its first frame being done.
struct StartTimes {
    double cold_ms = 0.0;  ///< with empty caches: Candela's pipelines and the driver's own
    double warm_ms = 0.0;  ///< with what the cold start left there
};

/// Starts this process's own command line twice more, with kFirstFrameOnly, on a cache folder of its own that
/// is removed afterwards. Throws Error (Fault::machine) when a start fails.
[[nodiscard]] StartTimes measure_starts();

/// What such a start does when its frame is done.
void report_first_frame();

}  // namespace candela::app
