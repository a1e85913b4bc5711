#include <gtest/gtest.h>

#include "candela/gpu/commands.hpp"
#include "candela/scene/error.hpp"
#include "candela_shaders/square_comp.hpp"

using namespace candela;
using namespace candela::gpu;

namespace {

DeviceOptions validated() {
    DeviceOptions options;
    options.validation = true;
    return options;
}

}  // namespace

TEST(Device, ListsAtLeastOneUsableDeviceAndOpensIt) {
    const auto devices = list_devices();
    ASSERT_FALSE(devices.empty());
    const Device device{validated()};
    EXPECT_TRUE(device.info().usable);
    EXPECT_TRUE(device.validating()) << "the validation layer of packaging/debian.txt is not installed";
}

TEST(Device, AnUnknownNameIsAUsageError) {
    DeviceOptions options;
    options.select = "no such device";
    try {
        const Device device{options};
        FAIL() << "opened " << device.info().name;
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        EXPECT_NE(error.line().find("no such device"), std::string::npos);
    }
}

TEST(Commands, AComputeShaderSeesItsBuffersConstantsAndSpecialization) {
    const Device device{validated()};
    {
        Commands commands(device);
        constexpr std::uint32_t count = 1000;
        Buffer in(device, count * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::upload);
        Buffer out(device, count * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryKind::readback);
        for (std::uint32_t i = 0; i < count; ++i) in.mapped_as<float>()[i] = static_cast<float>(i);
        const LayoutDesc layout{{{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}}, 4};
        const ComputePipeline pipeline = create_compute_pipeline(device, shaders::square_comp, layout, {7});
        commands.begin();
        commands.begin_pass("square");
        commands.use(in, Use::storage_read);
        commands.use(out, Use::storage_write);
        const std::array bindings{bind_buffer(in), bind_buffer(out)};
        commands.dispatch(pipeline, bindings, push(count), (count + 63) / 64);
        commands.submit_and_wait();
        for (std::uint32_t i = 0; i < count; ++i) {
            ASSERT_EQ(out.mapped_as<float>()[i], static_cast<float>(i) * static_cast<float>(i) + 7.0f);
        }
        ASSERT_EQ(commands.pass_times().size(), 1u);
        EXPECT_EQ(commands.pass_times()[0].name, "square");
        EXPECT_GE(commands.pass_times()[0].milliseconds, 0.0);
        EXPECT_GE(device.peak_memory_bytes(), 2 * count * sizeof(float));
    }
    EXPECT_TRUE(device.validation_messages().empty()) << device.validation_messages().front();
}
