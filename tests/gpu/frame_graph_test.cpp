// The order of passes, what they are refused for, the memory that they share, and what they compute.
#include "candela/gpu/frame_graph/frame_graph.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "candela/gpu/frame_graph/memory_plan.hpp"
#include "candela_shaders/fill_comp.hpp"

using namespace candela::gpu;

namespace {

DeviceOptions validated() {
    DeviceOptions options;
    options.validation = true;
    return options;
}

PassAccesses pass(const std::string& name, std::vector<Access> accesses) {
    return {name, std::move(accesses)};
}
Access reads(std::uint32_t resource, std::uint32_t version) {
    return {{resource, version}, true, false};
}
Access writes(std::uint32_t resource, std::uint32_t version) {
    return {{resource, version}, false, true};
}
Access changes(std::uint32_t resource, std::uint32_t version) {
    return {{resource, version}, true, true};
}

const std::vector<ResourceFacts> kResources{{"depth"}, {"light"}, {"picture"}, {"file", true}};

std::string refusal(const std::vector<PassAccesses>& passes, const std::vector<Contents>& wanted) {
    try {
        (void)schedule(passes, kResources, wanted);
    } catch (const std::logic_error& e) {
        return e.what();
    }
    return "";
}

using Order = std::vector<std::uint32_t>;

}  // namespace

TEST(Schedule, WritersComeBeforeReadersWhateverTheirDeclaration) {
    const std::vector<PassAccesses> passes{
        pass("present", {reads(1, 2), writes(2, 0)}), pass("fog", {changes(1, 1), reads(0, 1)}),
        pass("lighting", {reads(0, 1), writes(1, 0)}), pass("gbuffer", {writes(0, 0)})};
    EXPECT_EQ(schedule(passes, kResources, std::vector<Contents>{{2, 1}}), (Order{3, 2, 1, 0}));
}

TEST(Schedule, ContentsAreReadBeforeTheyAreWrittenOver) {
    const std::vector<PassAccesses> passes{pass("lighting", {writes(1, 0)}), pass("fog", {changes(1, 1)}),
                                           pass("meter", {reads(1, 1), writes(0, 0)}),
                                           pass("present", {reads(1, 2), reads(0, 1), writes(2, 0)})};
    EXPECT_EQ(schedule(passes, kResources, std::vector<Contents>{{2, 1}}), (Order{0, 2, 1, 3}));
}

TEST(Schedule, WhatNobodyReadsIsDropped) {
    const std::vector<PassAccesses> passes{pass("gbuffer", {writes(0, 0)}),
                                           pass("occlusion", {reads(0, 1), writes(1, 0)}),
                                           pass("present", {reads(0, 1), reads(3, 0), writes(2, 0)})};
    EXPECT_EQ(schedule(passes, kResources, std::vector<Contents>{{2, 1}}), (Order{0, 2}));
}

TEST(Schedule, ReadingWhatNobodyWroteIsRefused) {
    const std::string line = refusal({pass("present", {reads(1, 0), writes(2, 0)})}, {{2, 1}});
    EXPECT_EQ(line, "frame graph: nothing writes \"light\" before \"present\" reads it");
    EXPECT_EQ(refusal({}, {{2, 0}}),
              "frame graph: nothing writes \"picture\" before \"the caller\" reads it");
}

TEST(Schedule, TwoWritersWithoutAnOrderAreRefused) {
    const std::string line = refusal({pass("fog", {writes(1, 0)}), pass("sky", {writes(1, 0)})}, {{1, 1}});
    EXPECT_NE(line.find("\"fog\" and \"sky\" both write \"light\""), std::string::npos) << line;
}

TEST(Schedule, PassesThatWaitForEachOtherAreRefused) {
    // Fog reads the light before it is lit over, and what is made of it afterwards.
    const std::string line =
        refusal({pass("lighting", {writes(1, 0)}), pass("fog", {reads(1, 1), reads(2, 1), writes(0, 0)}),
                 pass("glow", {changes(1, 1)}), pass("blur", {reads(1, 2), writes(2, 0)})},
                {{0, 1}});
    EXPECT_EQ(line, "frame graph: passes wait for each other: \"fog\" -> \"glow\" -> \"blur\" -> \"fog\"");
}

TEST(MemoryPlan, WhatLivesAtTheSameTimeDoesNotOverlap) {
    std::mt19937 random(2);
    std::uniform_int_distribution<std::uint64_t> bytes(1, 5000);
    std::uniform_int_distribution<std::uint32_t> place(0, 20);
    for (int round = 0; round < 20; ++round) {
        std::vector<Lifetime> all;
        for (int i = 0; i < 30; ++i) {
            const std::uint32_t first = place(random);
            all.push_back({bytes(random), 256, first, first + place(random) / 4});
        }
        const MemoryPlan plan = plan_memory(all);
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            sum += all[i].bytes;
            EXPECT_EQ(plan.offsets[i] % 256, 0u);
            EXPECT_LE(plan.offsets[i] + all[i].bytes, plan.bytes);
            for (std::size_t j = 0; j < i; ++j) {
                const bool overlap = plan.offsets[i] < plan.offsets[j] + all[j].bytes &&
                                     plan.offsets[j] < plan.offsets[i] + all[i].bytes;
                const bool together = all[i].first <= all[j].last && all[j].first <= all[i].last;
                EXPECT_FALSE(overlap && together) << i << ' ' << j;
                EXPECT_TRUE(!overlap || (plan.shares[i] && plan.shares[j]));
            }
        }
        EXPECT_LT(plan.bytes, sum);
    }
}

namespace {

constexpr ImageDesc kSmall{16, 16, VK_FORMAT_R32G32B32A32_SFLOAT, 0, 1};

struct FillBlock {
    float plus;
    std::int32_t has_previous;
};

class Graph : public ::testing::Test {
  protected:
    Device device{validated()};
    Commands commands{device};
    Owned<VkSampler> nearest = create_sampler(device, {VK_FILTER_NEAREST, VK_FILTER_NEAREST});
    ComputePipeline fill = create_compute_pipeline(
        device, candela::shaders::fill_comp,
        {{{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}}, sizeof(FillBlock)});

    /// A pass that writes `plus` and what `from` holds.
    ImageRef add(FrameGraph& graph, const std::string& name, const ImageRef& from, const ImageRef& to,
                 float plus, bool history = false) {
        PassBuilder builder = graph.pass(name);
        builder.read(from);
        const ImageRef out = builder.write(to);
        builder.record([this, from, out, plus, history](PassContext& c) {
            const std::array bindings{bind_sampled(c.image(from).view(), nearest.get()),
                                      bind_storage(c.image(out).view())};
            const FillBlock block{plus, !history || c.has_history(from)};
            c.commands.dispatch(fill, bindings, push(block), 2, 2);
        });
        return out;
    }

    float first_texel(Image& image) {
        Buffer read(device, 16 * 16 * 16, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback);
        commands.begin();
        commands.copy(image, read);
        commands.submit_and_wait();
        return read.mapped_as<float>()[16 * 5];
    }

    void run(FrameGraph& graph) {
        commands.begin();
        graph.execute(commands);
        commands.submit_and_wait();
    }

    void expect_silence() {
        const auto messages = device.validation_messages();
        EXPECT_TRUE(messages.empty()) << messages.front();
    }
};

}  // namespace

// Eight images in a chain: only two of them live at any time.
TEST_F(Graph, AChainComputesItsSumInTheMemoryOfTwoImages) {
    FrameGraph graph(device);
    PassBuilder clear = graph.pass("clear");
    ImageRef at = clear.color(graph.create("start", kSmall), Load::clear);
    clear.record([](PassContext& c) {
        c.begin_rendering();
        c.commands.end_rendering();
    });
    for (int i = 0; i < 8; ++i) {
        at = add(graph, "add " + std::to_string(i), at, graph.create("sum " + std::to_string(i), kSmall),
                 static_cast<float>(1 << i));
    }
    const ImageRef unread = add(graph, "unread", at, graph.create("unread", kSmall), 1.0f);
    EXPECT_EQ(unread.version, 1u);
    graph.keep(at);
    graph.compile();
    EXPECT_EQ(graph.passes().size(), 9u) << "the pass that nobody reads";
    EXPECT_LE(graph.memory_bytes(), graph.unshared_bytes() / 3 + 1);
    for (int frame = 0; frame < 3; ++frame) {
        run(graph);
        EXPECT_EQ(first_texel(graph.image(at)), 255.0f) << frame;
    }
    expect_silence();
}

TEST_F(Graph, HistoryIsWhatTheFrameBeforeKept) {
    FrameGraph graph(device);
    const History sum = graph.history("sum", kSmall);
    const ImageRef next = add(graph, "accumulate", sum.previous, sum.next, 2.0f, true);
    const ImageRef shown = add(graph, "show", next, graph.create("shown", kSmall), 100.0f);
    graph.keep(shown);
    graph.compile();
    for (int frame = 1; frame <= 4; ++frame) {
        run(graph);
        EXPECT_EQ(first_texel(graph.image(shown)), 100.0f + 2.0f * static_cast<float>(frame));
    }
    expect_silence();
}

TEST_F(Graph, NamesAreUniqueAndThePictureHasThemAll) {
    FrameGraph graph(device);
    const History sum = graph.history("sum", kSmall);
    const ImageRef next = add(graph, "accumulate", sum.previous, sum.next, 2.0f, true);
    EXPECT_THROW((void)graph.pass("accumulate"), std::logic_error);
    graph.keep(add(graph, "a < b", next, graph.create("shown", kSmall), 1.0f));
    graph.compile();
    run(graph);
    const std::string svg = graph_svg(graph, commands.pass_times());
    const std::string dot = graph_dot(graph, commands.pass_times());
    for (const char* name : {"accumulate", "a &lt; b", "shown", "sum of the frame before", " ms", "KiB"}) {
        EXPECT_NE(svg.find(name), std::string::npos) << name;
        EXPECT_NE(dot.find(name), std::string::npos) << name;
    }
}
