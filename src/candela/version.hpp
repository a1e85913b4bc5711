#pragma once

namespace candela {

/// "MAJOR.MINOR.PATCH" of the library that is loaded.
[[nodiscard]] const char* version() noexcept;

}  // namespace candela
