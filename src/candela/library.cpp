#include "candela/version.hpp"

namespace candela {

const char* version() noexcept {
    return CANDELA_VERSION;
}

}  // namespace candela
