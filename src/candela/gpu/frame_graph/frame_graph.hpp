#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "candela/gpu/commands.hpp"
#include "candela/gpu/frame_graph/schedule.hpp"

namespace candela::gpu {

class FrameGraph;

/// Contents of an image or a buffer of a graph: what a pass returns when it has written, and what others
/// read.
struct ImageRef : Contents {};
struct BufferRef : Contents {};

/// What a pass is recorded with.
class PassContext {
  public:
    Commands& commands;

    [[nodiscard]] Image& image(const ImageRef& ref) const;
    [[nodiscard]] Buffer& buffer(const BufferRef& ref) const;
    /// Whether the frame before has left something in History::previous.
    [[nodiscard]] bool has_history(const ImageRef& previous) const;
    /// Begins rendering to the pass's colour targets, in the order in which they were declared, and its
    /// depth.
    void begin_rendering() const;

  private:
    friend class FrameGraph;
    PassContext(Commands& c, FrameGraph& graph, std::size_t pass)
        : commands(c), graph_(&graph), pass_(pass) {}
    FrameGraph* graph_;
    std::size_t pass_;
};

/// Declares what a pass does with which contents. Writing returns the new contents; what was there before is
/// kept where the pass reads it or `load` keeps it, and only then has to have been written.
class PassBuilder {
  public:
    void read(const ImageRef& image, Use use = Use::sampled);
    void read(const BufferRef& buffer, Use use = Use::storage_read);
    [[nodiscard]] ImageRef write(const ImageRef& image, Load load = Load::discard,
                                 Use use = Use::storage_write);
    [[nodiscard]] BufferRef write(const BufferRef& buffer, Load load = Load::discard,
                                  Use use = Use::storage_write);
    [[nodiscard]] ImageRef color(const ImageRef& image, Load load);
    [[nodiscard]] ImageRef depth(const ImageRef& image, Load load);
    /// What it does, when the graph is executed: barriers for all that was declared stand before.
    void record(std::function<void(PassContext&)> commands);
    /// It calls Commands::begin_pass() by itself, for parts with times of their own.
    void times_itself();

  private:
    friend class FrameGraph;
    PassBuilder(FrameGraph& graph, std::size_t pass) : graph_(&graph), pass_(pass) {}
    FrameGraph* graph_;
    std::size_t pass_;
};

/// An image that lives from frame to frame: what the frame before kept, and what this one keeps for the next.
struct History {
    ImageRef previous;
    ImageRef next;
};

/// A pass of the compiled graph and an image or buffer, for those who look at it.
struct PassNode {
    std::string name;
    std::vector<Access> accesses;
};
struct ResourceNode {
    std::string name;
    std::uint64_t bytes = 0;
    bool imported = false;
};

/// Blocks of device memory that graphs take in turn: what lives within a frame of one graph may lie where
/// that of another one lay, so graphs that share it are not executed at the same time.
class TransientMemory {
  public:
    /// A block that none of these graphs' own blocks is: `taken` counts those of the graph that asks.
    [[nodiscard]] VkDeviceMemory block(const Device& device, const VkMemoryRequirements& requirements,
                                       std::vector<VkDeviceMemory>& taken);

  private:
    struct Block {
        Owned<VkDeviceMemory> memory;
        VkMemoryRequirements requirements;
    };
    std::vector<Block> blocks_;
};

/// A frame as passes and what they read and write. compile() orders the passes, drops those whose outputs
/// nobody reads, creates images and buffers and lets those that do not live at the same time share memory;
/// execute() records barriers and passes, each timed under its name. Declared once, executed frame by frame.
/// The device must outlive it.
class FrameGraph {
  public:
    explicit FrameGraph(const Device& device,
                        std::shared_ptr<TransientMemory> memory = std::make_shared<TransientMemory>())
        : device_(&device), memory_(std::move(memory)) {}
    FrameGraph(const FrameGraph&) = delete;
    FrameGraph& operator=(const FrameGraph&) = delete;

    /// Something that others own, and that outlives the graph. It may be made anew between executions.
    [[nodiscard]] ImageRef import(std::string name, Image& image);
    [[nodiscard]] BufferRef import(std::string name, Buffer& buffer);
    /// Something that lives within the frame. Its usage flags follow from its uses.
    [[nodiscard]] ImageRef create(std::string name, const ImageDesc& desc);
    [[nodiscard]] BufferRef create(std::string name, std::size_t bytes);
    [[nodiscard]] History history(std::string name, const ImageDesc& desc);

    /// Throws std::logic_error when a pass of this name is there.
    [[nodiscard]] PassBuilder pass(std::string name);
    /// What the graph is for: its writers run, and it holds until the next execution.
    void keep(const ImageRef& image) { wanted_.push_back(image); }
    void keep(const BufferRef& buffer) { wanted_.push_back(buffer); }

    /// After all passes are declared; throws as schedule() does, and Error (Fault::machine) without memory.
    void compile();
    /// Between Commands::begin() and submit_and_wait().
    void execute(Commands& commands);

    /// After compile(): what a reference names.
    [[nodiscard]] Image& image(const ImageRef& ref);
    [[nodiscard]] Buffer& buffer(const BufferRef& ref);

    /// In the order of execution, and everything that they use.
    [[nodiscard]] std::vector<PassNode> passes() const;
    [[nodiscard]] std::vector<ResourceNode> resources() const;
    /// Bytes of what the graph made, and what they would be without sharing.
    [[nodiscard]] std::uint64_t memory_bytes() const noexcept { return memory_bytes_; }
    [[nodiscard]] std::uint64_t unshared_bytes() const noexcept { return unshared_bytes_; }

  private:
    friend class PassBuilder;
    friend class PassContext;

    enum class Kind : std::uint8_t { imported, created, history };
    struct Resource {
        std::string name;
        Kind kind = Kind::created;
        bool is_image = true;
        Image* outer_image = nullptr;
        Buffer* outer_buffer = nullptr;
        ImageDesc desc;
        std::size_t bytes = 0;
        VkBufferUsageFlags buffer_usage = 0;
        Image image;
        Buffer buffer;
        bool shares = false;
        std::uint32_t first = 0;  ///< place of the first pass that uses it
        std::uint32_t last = 0;
        bool kept = false;  ///< its memory is its own all the time
        bool used = false;
        std::uint32_t versions = 0;
        std::uint32_t next_of = ~0u;  ///< of a history's next: its previous
        bool filled = false;          ///< of a history's previous
    };
    struct UsedBy {
        std::uint32_t resource;
        Use use;
    };
    struct Pass {
        PassAccesses accesses;
        std::vector<UsedBy> uses;
        std::vector<std::pair<ImageRef, Load>> colors;
        std::vector<std::pair<ImageRef, Load>> depth;  ///< at most one
        std::function<void(PassContext&)> record;
        bool times_itself = false;
    };

    [[nodiscard]] std::uint32_t add(Resource resource);
    void access(std::size_t pass, const Contents& contents, bool reads, bool writes, Use use);
    void find_lifetimes();
    void allocate();
    template <class T>
    void allocate_together(const std::vector<std::uint32_t>& which, T Resource::*member);

    const Device* device_;
    std::shared_ptr<TransientMemory> memory_;  ///< outlives what lies in it
    std::vector<VkDeviceMemory> blocks_;       ///< of it, those in use here
    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
    std::vector<Contents> wanted_;
    std::vector<std::uint32_t> order_;
    std::uint64_t memory_bytes_ = 0;
    std::uint64_t unshared_bytes_ = 0;
};

/// The graph as a picture: passes in their order across, images and buffers down, each over the passes that
/// it lives for, with bytes and the milliseconds of each pass (empty: not measured).
[[nodiscard]] std::string graph_svg(const FrameGraph& graph, std::span<const PassTime> times);
/// The same for Graphviz: passes and contents as nodes.
[[nodiscard]] std::string graph_dot(const FrameGraph& graph, std::span<const PassTime> times);

}  // namespace candela::gpu
