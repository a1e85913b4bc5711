#include "candela/scene/environment_negative.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "shading/environment.glsl"

namespace candela::scene {
namespace {

/// A square of texels of one channel, clipped to the picture.
class Square {
  public:
    Square(Environment& e, const std::vector<double>& solid_angles, glm::uvec2 first, std::uint32_t side,
           int channel)
        : environment_(e),
          solid_angles_(solid_angles),
          first_(first),
          end_(std::min(first.x + side, e.width), std::min(first.y + side, e.height)),
          channel_(channel) {}

    /// True when nothing negative is left in it.
    bool settle() {
        double positive = 0.0, negative = 0.0;
        for_texels(
            [&](float& value, double sr) { (value > 0.0f ? positive : negative) += sr * double{value}; });
        if (negative == 0.0) return true;
        if (positive + negative < 0.0) return false;
        const double left = positive > 0.0 ? (positive + negative) / positive : 0.0;
        for_texels([&](float& value, double) {
            value = value > 0.0f ? static_cast<float>(double{value} * left) : 0.0f;
        });
        return true;
    }

  private:
    template <class Visit>
    void for_texels(Visit&& visit) {
        for (std::uint32_t y = first_.y; y < end_.y; ++y) {
            for (std::uint32_t x = first_.x; x < end_.x; ++x)
                visit(environment_.luminance_nit[std::size_t{y} * environment_.width + x][channel_],
                      solid_angles_[y]);
        }
    }

    Environment& environment_;
    const std::vector<double>& solid_angles_;
    glm::uvec2 first_;
    glm::uvec2 end_;
    int channel_;
};

void spread_channel(Environment& e, const std::vector<double>& solid_angles, int channel) {
    const std::uint32_t longest = std::max(e.width, e.height);
    bool settled = false;
    for (std::uint32_t side = 2; !settled; side *= 2) {
        settled = true;
        for (std::uint32_t y = 0; y < e.height; y += side) {
            for (std::uint32_t x = 0; x < e.width; x += side)
                settled = Square(e, solid_angles, {x, y}, side, channel).settle() && settled;
        }
        if (side >= longest) break;
    }
    if (settled) return;
    for (glm::vec3& texel : e.luminance_nit) texel[channel] = 0.0f;
}

}  // namespace

void clamp_negative(Environment& environment) {
    for (glm::vec3& texel : environment.luminance_nit) texel = glm::max(texel, glm::vec3(0.0f));
}

void spread_negative(Environment& environment) {
    std::vector<double> solid_angles;
    for (std::uint32_t y = 0; y < environment.height; ++y)
        solid_angles.push_back(
            double{shading::equirect_texel_solid_angle(y, environment.width, environment.height)});
    for (int channel = 0; channel < 3; ++channel) spread_channel(environment, solid_angles, channel);
}

}  // namespace candela::scene
