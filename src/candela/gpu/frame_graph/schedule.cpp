#include "candela/gpu/frame_graph/schedule.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace candela::gpu {
namespace {

using Key = std::pair<std::uint32_t, std::uint32_t>;

Key key(const Contents& c) {
    return {c.resource, c.version};
}

[[noreturn]] void refuse(const std::string& what) {
    throw std::logic_error("frame graph: " + what);
}

class Order {
  public:
    Order(std::span<const PassAccesses> passes, std::span<const ResourceFacts> resources)
        : passes_(passes), resources_(resources) {
        for (std::uint32_t i = 0; i < passes.size(); ++i) {
            for (const Access& a : passes[i].accesses)
                if (a.writes) add_writer(i, a.contents);
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> of(std::span<const Contents> wanted) {
        need(wanted);
        connect();
        return sorted();
    }

  private:
    [[nodiscard]] const std::string& name(std::uint32_t resource) const { return resources_[resource].name; }

    void add_writer(std::uint32_t pass, const Contents& over) {
        const auto [at, fresh] = writer_.emplace(Key{over.resource, over.version + 1}, pass);
        if (!fresh && at->second != pass) {
            refuse("\"" + passes_[at->second].name + "\" and \"" + passes_[pass].name + "\" both write \"" +
                   name(over.resource) +
                   "\", in no order: the later one has to take what the earlier one returns");
        }
    }

    /// Marks the passes that lead to the wanted contents.
    void need(std::span<const Contents> wanted) {
        std::vector<std::pair<Contents, std::string>> open;
        for (const Contents& c : wanted) open.emplace_back(c, "the caller");
        while (!open.empty()) {
            const auto [contents, reader] = open.back();
            open.pop_back();
            const auto writer = writer_.find(key(contents));
            if (writer == writer_.end()) {
                if (contents.version == 0 && resources_[contents.resource].held_before) continue;
                refuse("nothing writes \"" + name(contents.resource) + "\" before \"" + reader +
                       "\" reads it");
            }
            if (!needed_.insert(writer->second).second) continue;
            const PassAccesses& pass = passes_[writer->second];
            for (const Access& a : pass.accesses)
                if (a.reads) open.emplace_back(a.contents, pass.name);
        }
    }

    void edge(std::uint32_t before, std::uint32_t after) {
        if (before != after) after_[before].insert(after);
    }

    void connect() {
        for (const std::uint32_t pass : needed_) {
            for (const Access& a : passes_[pass].accesses) {
                const auto writer = writer_.find(key(a.contents));
                // Also what is not read has to be there before it is written over.
                if (writer != writer_.end() && needed_.contains(writer->second)) edge(writer->second, pass);
                if (a.writes) continue;
                const auto next = writer_.find({a.contents.resource, a.contents.version + 1});
                if (next != writer_.end() && needed_.contains(next->second)) edge(pass, next->second);
            }
        }
    }

    [[nodiscard]] std::vector<std::uint32_t> sorted() const {
        std::map<std::uint32_t, std::uint32_t> waits;
        for (const std::uint32_t pass : needed_) waits[pass] = 0;
        for (const auto& [before, afters] : after_)
            for (const std::uint32_t after : afters) ++waits[after];
        std::set<std::uint32_t> ready;
        for (const auto& [pass, count] : waits)
            if (count == 0) ready.insert(pass);
        std::vector<std::uint32_t> order;
        while (!ready.empty()) {
            const std::uint32_t pass = *ready.begin();
            ready.erase(ready.begin());
            order.push_back(pass);
            const auto afters = after_.find(pass);
            if (afters == after_.end()) continue;
            for (const std::uint32_t after : afters->second)
                if (--waits[after] == 0) ready.insert(after);
        }
        if (order.size() < needed_.size()) refuse_cycle(order);
        return order;
    }

    /// Names the passes of one circle, in its order.
    [[noreturn]] void refuse_cycle(const std::vector<std::uint32_t>& done) const {
        std::set<std::uint32_t> left = needed_;
        for (const std::uint32_t pass : done) left.erase(pass);
        // Of what is left every pass waits for another one that is left: going back long enough ends in a
        // circle.
        const auto before = [&](std::uint32_t pass) {
            for (const std::uint32_t other : left) {
                const auto afters = after_.find(other);
                if (afters != after_.end() && afters->second.contains(pass)) return other;
            }
            return pass;
        };
        std::vector<std::uint32_t> way{*left.begin()};
        while (std::find(way.begin(), way.end() - 1, way.back()) == way.end() - 1)
            way.push_back(before(way.back()));
        const auto first = std::find(way.begin(), way.end(), way.back());
        std::string circle;
        for (auto at = way.end(); at-- != first;)
            circle += (circle.empty() ? "\"" : " -> \"") + passes_[*at].name + "\"";
        refuse("passes wait for each other: " + circle);
    }

    std::span<const PassAccesses> passes_;
    std::span<const ResourceFacts> resources_;
    std::map<Key, std::uint32_t> writer_;
    std::set<std::uint32_t> needed_;
    std::map<std::uint32_t, std::set<std::uint32_t>> after_;
};

}  // namespace

std::vector<std::uint32_t> schedule(std::span<const PassAccesses> passes,
                                    std::span<const ResourceFacts> resources,
                                    std::span<const Contents> wanted) {
    return Order(passes, resources).of(wanted);
}

}  // namespace candela::gpu
