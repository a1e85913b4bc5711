#include "candela/scene/light.hpp"

namespace candela::scene {

const char* name_of(LightType type) {
    switch (type) {
        case LightType::point:
            return "point";
        case LightType::spot:
            return "spot";
        case LightType::directional:
            return "directional";
        case LightType::frustum:
            return "frustum";
        case LightType::line:
            return "line";
        case LightType::sun:
            return "sun";
        case LightType::sphere:
            return "sphere";
        case LightType::disk:
            return "disk";
        case LightType::rectangle:
            return "rectangle";
        case LightType::tube:
            return "tube";
    }
    return "unknown";
}

}  // namespace candela::scene
