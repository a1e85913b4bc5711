#include "candela/gpu/frame_graph/frame_graph.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "candela/gpu/frame_graph/memory_plan.hpp"

namespace candela::gpu {
namespace {

VkImageUsageFlags image_usage(Use use) {
    switch (use) {
        case Use::sampled:
            return VK_IMAGE_USAGE_SAMPLED_BIT;
        case Use::storage_read:
        case Use::storage_write:
            return VK_IMAGE_USAGE_STORAGE_BIT;
        case Use::color_target:
            return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        case Use::depth_target:
            return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
        default:
            return 0;
    }
}

VkBufferUsageFlags buffer_usage(Use use) {
    switch (use) {
        case Use::storage_read:
        case Use::storage_write:
            return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        case Use::sampled:
            return VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        case Use::vertex_input:
            return VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
        case Use::indirect_and_storage_read:
            return VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        default:
            return 0;
    }
}

}  // namespace

VkDeviceMemory TransientMemory::block(const Device& device, const VkMemoryRequirements& wanted,
                                      std::vector<VkDeviceMemory>& taken) {
    for (const Block& b : blocks_) {
        const bool used = std::find(taken.begin(), taken.end(), b.memory.get()) != taken.end();
        if (used || b.requirements.memoryTypeBits != wanted.memoryTypeBits ||
            b.requirements.size < wanted.size)
            continue;
        taken.push_back(b.memory.get());
        return taken.back();
    }
    blocks_.push_back({device.allocate(wanted, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT), wanted});
    taken.push_back(blocks_.back().memory.get());
    return taken.back();
}

Image& PassContext::image(const ImageRef& ref) const {
    return graph_->image(ref);
}

Buffer& PassContext::buffer(const BufferRef& ref) const {
    return graph_->buffer(ref);
}

bool PassContext::has_history(const ImageRef& previous) const {
    return graph_->resources_.at(previous.resource).filled;
}

void PassContext::begin_rendering() const {
    const FrameGraph::Pass& pass = graph_->passes_[pass_];
    std::vector<ColorTarget> colors;
    for (const auto& [ref, load] : pass.colors) colors.push_back({&image(ref), load});
    std::optional<DepthTarget> depth;
    if (!pass.depth.empty()) depth = DepthTarget{&image(pass.depth[0].first), pass.depth[0].second};
    commands.begin_rendering(colors, depth);
}

void PassBuilder::read(const ImageRef& image, Use use) {
    graph_->access(pass_, image, true, false, use);
}

void PassBuilder::read(const BufferRef& buffer, Use use) {
    graph_->access(pass_, buffer, true, false, use);
}

ImageRef PassBuilder::write(const ImageRef& image, Load load, Use use) {
    graph_->access(pass_, image, load == Load::keep, true, use);
    return {{image.resource, image.version + 1}};
}

BufferRef PassBuilder::write(const BufferRef& buffer, Load load, Use use) {
    graph_->access(pass_, buffer, load == Load::keep, true, use);
    return {{buffer.resource, buffer.version + 1}};
}

ImageRef PassBuilder::color(const ImageRef& image, Load load) {
    graph_->passes_[pass_].colors.emplace_back(image, load);
    return write(image, load, Use::color_target);
}

ImageRef PassBuilder::depth(const ImageRef& image, Load load) {
    graph_->passes_[pass_].depth.emplace_back(image, load);
    return write(image, load, Use::depth_target);
}

void PassBuilder::record(std::function<void(PassContext&)> commands) {
    graph_->passes_[pass_].record = std::move(commands);
}

void PassBuilder::times_itself() {
    graph_->passes_[pass_].times_itself = true;
}

std::uint32_t FrameGraph::add(Resource resource) {
    resources_.push_back(std::move(resource));
    return static_cast<std::uint32_t>(resources_.size() - 1);
}

ImageRef FrameGraph::import(std::string name, Image& image) {
    Resource r;
    r.name = std::move(name);
    r.kind = Kind::imported;
    r.outer_image = &image;
    return {{add(std::move(r)), 0}};
}

BufferRef FrameGraph::import(std::string name, Buffer& buffer) {
    Resource r;
    r.name = std::move(name);
    r.kind = Kind::imported;
    r.is_image = false;
    r.outer_buffer = &buffer;
    return {{add(std::move(r)), 0}};
}

ImageRef FrameGraph::create(std::string name, const ImageDesc& desc) {
    Resource r;
    r.name = std::move(name);
    r.desc = desc;
    return {{add(std::move(r)), 0}};
}

BufferRef FrameGraph::create(std::string name, std::size_t bytes) {
    Resource r;
    r.name = std::move(name);
    r.is_image = false;
    r.bytes = bytes;
    return {{add(std::move(r)), 0}};
}

History FrameGraph::history(std::string name, const ImageDesc& desc) {
    Resource previous;
    previous.name = name + " of the frame before";
    previous.kind = Kind::history;
    previous.desc = desc;
    Resource next;
    next.name = std::move(name);
    next.kind = Kind::history;
    next.desc = desc;
    History h;
    h.previous.resource = add(std::move(previous));
    next.next_of = h.previous.resource;
    h.next.resource = add(std::move(next));
    return h;
}

PassBuilder FrameGraph::pass(std::string name) {
    for (const Pass& p : passes_)
        if (p.accesses.name == name)
            throw std::logic_error("frame graph: two passes are called \"" + name + "\"");
    passes_.emplace_back();
    passes_.back().accesses.name = std::move(name);
    return {*this, passes_.size() - 1};
}

void FrameGraph::access(std::size_t pass, const Contents& contents, bool reads, bool writes, Use use) {
    Resource& r = resources_.at(contents.resource);
    passes_[pass].accesses.accesses.push_back({contents, reads, writes});
    passes_[pass].uses.push_back({contents.resource, use});
    r.desc.usage |= image_usage(use);
    r.buffer_usage |= buffer_usage(use);
    if (writes) r.versions = std::max(r.versions, contents.version + 1);
}

void FrameGraph::compile() {
    std::vector<PassAccesses> accesses;
    std::vector<ResourceFacts> facts;
    for (const Pass& p : passes_) accesses.push_back(p.accesses);
    for (const Resource& r : resources_)
        facts.push_back({r.name, r.kind == Kind::imported || (r.kind == Kind::history && r.next_of == ~0u)});
    std::vector<Contents> wanted = wanted_;
    for (std::uint32_t i = 0; i < resources_.size(); ++i) {
        const Resource& r = resources_[i];
        if (r.next_of != ~0u && r.versions > 0) wanted.push_back({i, r.versions});
    }
    order_ = schedule(accesses, facts, wanted);
    for (Resource& next : resources_) {
        if (next.next_of == ~0u) continue;
        // They change places after every frame.
        Resource& previous = resources_[next.next_of];
        next.desc.usage = previous.desc.usage = next.desc.usage | previous.desc.usage;
    }
    find_lifetimes();
    allocate();
}

void FrameGraph::find_lifetimes() {
    for (std::uint32_t place = 0; place < order_.size(); ++place) {
        for (const UsedBy& u : passes_[order_[place]].uses) {
            Resource& r = resources_[u.resource];
            if (!std::exchange(r.used, true)) r.first = place;
            r.last = place;
        }
    }
    for (const Contents& c : wanted_) resources_[c.resource].kept = true;
}

template <class T>
void FrameGraph::allocate_together(const std::vector<std::uint32_t>& which, T Resource::*member) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_type;
    for (const std::uint32_t i : which)
        by_type[(resources_[i].*member).requirements(*device_).memoryTypeBits].push_back(i);
    for (const auto& [bits, group] : by_type) {
        std::vector<Lifetime> lifetimes;
        VkMemoryRequirements block{};
        block.memoryTypeBits = bits;
        for (const std::uint32_t i : group) {
            const VkMemoryRequirements r = (resources_[i].*member).requirements(*device_);
            const Resource& of = resources_[i];
            lifetimes.push_back({r.size, r.alignment, of.kept ? 0 : of.first,
                                 of.kept ? static_cast<std::uint32_t>(order_.size()) : of.last});
            block.alignment = std::max(block.alignment, r.alignment);
            resources_[i].bytes = r.size;
            unshared_bytes_ += r.size;
        }
        const MemoryPlan plan = plan_memory(lifetimes);
        block.size = plan.bytes;
        memory_bytes_ += plan.bytes;
        const VkDeviceMemory memory = memory_->block(*device_, block, blocks_);
        for (std::size_t i = 0; i < group.size(); ++i) {
            Resource& r = resources_[group[i]];
            (r.*member).bind(*device_, memory, plan.offsets[i]);
            r.shares = plan.shares[i];
        }
    }
}

void FrameGraph::allocate() {
    std::vector<std::uint32_t> images;
    std::vector<std::uint32_t> buffers;
    for (std::uint32_t i = 0; i < resources_.size(); ++i) {
        Resource& r = resources_[i];
        if (!r.used || r.kind == Kind::imported) continue;
        if (r.kind == Kind::history) {
            r.image = Image(*device_, r.desc);
            r.bytes = r.image.requirements(*device_).size;
            memory_bytes_ += r.bytes;
            unshared_bytes_ += r.bytes;
        } else if (r.is_image) {
            r.image = Image::unbound(*device_, r.desc);
            images.push_back(i);
        } else {
            r.buffer = Buffer::unbound(*device_, r.bytes, r.buffer_usage);
            buffers.push_back(i);
        }
    }
    allocate_together(images, &Resource::image);
    allocate_together(buffers, &Resource::buffer);
}

void FrameGraph::execute(Commands& commands) {
    for (std::uint32_t place = 0; place < order_.size(); ++place) {
        const std::uint32_t index = order_[place];
        Pass& pass = passes_[index];
        if (!pass.times_itself) commands.begin_pass(pass.accesses.name);
        bool waited = false;
        for (const UsedBy& u : pass.uses) {
            Resource& r = resources_[u.resource];
            if (r.kind != Kind::created || r.first != place) continue;
            if (r.shares && !std::exchange(waited, true)) commands.full_barrier();
            r.image.state = r.buffer.state = {};
        }
        for (const UsedBy& u : pass.uses) {
            if (resources_[u.resource].is_image) {
                commands.use(image({{u.resource, 0}}), u.use);
            } else {
                commands.use(buffer({{u.resource, 0}}), u.use);
            }
        }
        PassContext context(commands, *this, index);
        if (pass.record) pass.record(context);
    }
    for (Resource& r : resources_) {
        if (r.next_of == ~0u || !r.used) continue;
        Resource& previous = resources_[r.next_of];
        // Nobody reads it: there is nothing to swap.
        if (!previous.used) continue;
        std::swap(r.image, previous.image);
        previous.filled = true;
    }
}

Image& FrameGraph::image(const ImageRef& ref) {
    Resource& r = resources_.at(ref.resource);
    return r.outer_image ? *r.outer_image : r.image;
}

Buffer& FrameGraph::buffer(const BufferRef& ref) {
    Resource& r = resources_.at(ref.resource);
    return r.outer_buffer ? *r.outer_buffer : r.buffer;
}

std::vector<PassNode> FrameGraph::passes() const {
    std::vector<PassNode> nodes;
    for (const std::uint32_t i : order_)
        nodes.push_back({passes_[i].accesses.name, passes_[i].accesses.accesses});
    return nodes;
}

std::vector<ResourceNode> FrameGraph::resources() const {
    std::vector<ResourceNode> nodes;
    for (const Resource& r : resources_) {
        std::uint64_t bytes = r.bytes;
        if (r.outer_buffer) bytes = r.outer_buffer->size();
        nodes.push_back({r.name, bytes, r.kind == Kind::imported});
    }
    return nodes;
}

}  // namespace candela::gpu
