#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "tests/shading/agreement_case.glsl"

namespace candela::shading {

/// One function, compiled as C++ here and under the same number in the kernel.
struct AgreementCase {
    const char* name;
    float tolerance;
    vec4 (*function)(const Numbers&);
};

#define AGREEMENT_ENTRY(function, tolerance) {#function, tolerance, function},

/// Runs the cases of a kernel on lavapipe (the processor: always there, always the same) and compares with
/// C++.
class Agreement {
  public:
    explicit Agreement(gpu::SpirV kernel)
        : device_(options()),
          pipeline_(gpu::create_compute_pipeline(
              device_, kernel,
              {{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}, sizeof(Push)})),
          numbers_(device_, kCount * sizeof(Numbers), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   gpu::MemoryKind::upload),
          results_(device_, kCount * sizeof(vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   gpu::MemoryKind::readback) {
        std::uint32_t state = 0x2545f491u;
        for (float& x : numbers_.mapped_as<float>()) {
            state ^= state << 13u;
            state ^= state >> 17u;
            state ^= state << 5u;
            x = float(state >> 8u) / 16777216.0f;
        }
    }

    void compare(std::span<const AgreementCase> cases) {
        for (std::size_t i = 0; i < cases.size(); ++i) compare(cases[i], int(i));
        EXPECT_TRUE(device_.validation_messages().empty()) << device_.validation_messages().front();
    }

  private:
    static constexpr std::uint32_t kCount = 4096;
    struct Push {
        std::uint32_t count;
        std::int32_t selected;
    };

    static gpu::DeviceOptions options() {
        gpu::DeviceOptions o;
        o.select = "cpu";
        o.validation = true;
        return o;
    }

    void run(int selected) {
        gpu::Commands commands(device_);
        commands.begin();
        commands.begin_pass("agreement");
        commands.use(numbers_, gpu::Use::storage_read);
        commands.use(results_, gpu::Use::storage_write);
        const std::array bindings{gpu::bind_buffer(numbers_), gpu::bind_buffer(results_)};
        commands.dispatch(pipeline_, bindings, gpu::push(Push{kCount, selected}), (kCount + 63) / 64);
        commands.submit_and_wait();
    }

    void compare(const AgreementCase& c, int selected) {
        run(selected);
        const auto inputs = numbers_.mapped_as<Numbers>();
        const auto device_results = results_.mapped_as<vec4>();
        float worst = 0.0f;
        std::size_t worst_at = 0;
        for (std::size_t i = 0; i < kCount; ++i) {
            const float error = relative_error(c.function(inputs[i]), device_results[i]);
            if (error <= worst) continue;
            worst = error;
            worst_at = i;
        }
        const vec4 here = c.function(inputs[worst_at]);
        const vec4 there = device_results[worst_at];
        EXPECT_LE(worst, c.tolerance)
            << c.name << " at input " << worst_at << ": C++ " << text(here) << ", GLSL " << text(there);
        ::testing::Test::RecordProperty(c.name, std::to_string(worst));
    }

    /// Infinite when one side is not a number or infinite and the other is not the same.
    static float relative_error(const vec4& a, const vec4& b) {
        const float scale = 0.25f * std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), std::abs(a.w)});
        float worst = 0.0f;
        for (int i = 0; i < 4; ++i) {
            if (a[i] == b[i]) continue;
            const float error = std::abs(a[i] - b[i]) / std::max(std::abs(a[i]), scale);
            worst = error >= 0.0f ? std::max(worst, error) : INFINITY;
        }
        return worst;
    }

    static std::string text(const vec4& v) {
        std::ostringstream s;
        s.precision(9);
        for (int i = 0; i < 4; ++i) s << v[i] << ' ';
        return s.str();
    }

    gpu::Device device_;
    gpu::ComputePipeline pipeline_;
    gpu::Buffer numbers_;
    gpu::Buffer results_;
};

}  // namespace candela::shading
