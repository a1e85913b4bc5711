#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "candela/measure/experiment.hpp"
#include "candela/measure/image_light.hpp"
#include "candela/measure/numerics.hpp"

/// Errors of techniques over image_lights(), a setting of the material and an angle.
namespace candela::measure {

/// Luminances that differ, over luminance.
class LightError {
  public:
    void add(const glm::vec3& value, const glm::vec3& truth) {
        difference_ += double(std::abs(shading::luminance(value) - shading::luminance(truth)));
        light_ += double(shading::luminance(truth));
    }
    [[nodiscard]] double percent() const { return 100.0 * difference_ / light_; }

  private:
    double difference_ = 0.0;
    double light_ = 0.0;
};

/// Of one technique. Lights are of equal weight, whatever their luminance.
class LightErrors {
  public:
    LightErrors(std::size_t settings, std::size_t angles)
        : lights_(image_lights().size()),
          settings_(lights_.size(), std::vector<LightError>(settings)),
          angles_(lights_.size(), std::vector<LightError>(angles)) {}

    void add(std::size_t light, std::size_t setting, std::size_t angle, const glm::vec3& value,
             const glm::vec3& truth) {
        lights_[light].add(value, truth);
        settings_[light][setting].add(value, truth);
        angles_[light][angle].add(value, truth);
    }

    [[nodiscard]] double of_light(std::size_t light) const { return lights_[light].percent(); }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (const LightError& e : lights_) sum += e.percent() / double(lights_.size());
        return sum;
    }
    /// Of one light and setting.
    [[nodiscard]] double largest() const {
        double out = 0.0;
        for (const auto& of_light : settings_)
            for (const LightError& e : of_light) out = std::max(out, e.percent());
        return out;
    }
    [[nodiscard]] double of_setting(std::size_t i) const { return over_lights(settings_, i); }
    [[nodiscard]] double of_angle(std::size_t i) const { return over_lights(angles_, i); }

  private:
    using PerLight = std::vector<std::vector<LightError>>;
    [[nodiscard]] static double over_lights(const PerLight& table, std::size_t i) {
        double sum = 0.0;
        for (const auto& of_light : table) sum += of_light[i].percent() / double(table.size());
        return sum;
    }

    std::vector<LightError> lights_;
    PerLight settings_;
    PerLight angles_;
};

/// A row a technique: % by light, and their mean.
[[nodiscard]] inline Table error_table(std::string title, const std::vector<std::string>& names,
                                       const std::vector<LightErrors>& errors) {
    Table out{std::move(title), {"technique"}, {}};
    for (const ImageLight& light : image_lights()) out.columns.push_back(light.name());
    out.columns.emplace_back("mean");
    for (std::size_t i = 0; i < names.size(); ++i) {
        out.rows.push_back({names[i]});
        for (std::size_t l = 0; l < image_lights().size(); ++l)
            out.rows.back().push_back(fixed(errors[i].of_light(l), 2));
        out.rows.back().push_back(fixed(errors[i].mean(), 2));
    }
    return out;
}

}  // namespace candela::measure
