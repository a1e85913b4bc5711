#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "candela/io/gltf_accessor.hpp"
#include "candela/io/gltf_pose.hpp"

namespace candela::io {
namespace {

Node read_node(const GltfDocument& document, std::uint32_t index) {
    const JsonView source = document.element("nodes", index);
    Node node;
    node.name = source["name"].string_or("");
    const JsonView children = source["children"];
    for (std::size_t i = 0; i < children.size(); ++i) {
        if (const auto child = children[i].index_below(document.count("nodes")))
            node.children.push_back(*child);
    }
    std::array<double, 3> three{};
    std::array<double, 4> four{};
    std::array<double, 16> sixteen{};
    if (source["translation"].doubles(three)) node.translation = {three[0], three[1], three[2]};
    if (source["scale"].doubles(three)) node.scale = {three[0], three[1], three[2]};
    if (source["rotation"].doubles(four)) {
        const glm::dquat q(four[3], four[0], four[1], four[2]);
        const double length = glm::length(q);
        node.rotation = length > 1e-12 ? q / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
    }
    if (source["matrix"].doubles(sixteen)) {
        glm::dmat4 m;
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = sixteen[static_cast<std::size_t>(i)];
        node.matrix = m;
    }
    node.weights.resize(source["weights"].size());
    source["weights"].floats(node.weights);
    return node;
}

/// Leaves each node one parent, the last that names it, and returns the parents. Throws Error for cycles.
std::vector<std::uint32_t> make_forest(const GltfDocument& document, std::vector<Node>& nodes) {
    std::vector<std::uint32_t> parents(nodes.size(), scene::no_index);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        for (const std::uint32_t child : nodes[i].children) {
            if (parents[child] != scene::no_index) {
                document.warnings().warn_at(
                    document.element("nodes", i)["children"].where(),
                    "node " + std::to_string(child) +
                        " is listed as a child more than once: the last parent counts");
            }
            parents[child] = i;
        }
    }
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        std::vector<std::uint32_t>& children = nodes[i].children;
        std::set<std::uint32_t> seen;
        std::erase_if(children, [&](std::uint32_t c) { return parents[c] != i || !seen.insert(c).second; });
    }
    // With one parent each, a cycle is what no root leads to: walking up must end.
    std::vector<std::uint8_t> done(nodes.size(), 0);
    for (std::uint32_t start = 0; start < nodes.size(); ++start) {
        std::vector<std::uint32_t> path;
        std::uint32_t at = start;
        while (at != scene::no_index && done[at] == 0) {
            done[at] = 1;
            path.push_back(at);
            at = parents[at];
        }
        if (at != scene::no_index && done[at] == 1)
            document.element("nodes", at).fail("is its own ancestor: the nodes form a cycle");
        for (const std::uint32_t i : path) done[i] = 2;
    }
    return parents;
}

glm::dmat4 local_matrix(const Node& node) {
    if (node.matrix) return *node.matrix;
    return glm::translate(glm::dmat4(1.0), node.translation) * glm::mat4_cast(node.rotation) *
           glm::scale(glm::dmat4(1.0), node.scale);
}

/// Of the scene, with all below it; what is below a node that is shown already is shown too.
void show(std::vector<Node>& nodes, std::uint32_t root) {
    std::vector<std::uint32_t> stack{root};
    while (!stack.empty()) {
        Node& node = nodes[stack.back()];
        stack.pop_back();
        if (node.reachable) continue;
        node.reachable = true;
        stack.insert(stack.end(), node.children.begin(), node.children.end());
    }
}

/// Explicit stack: a chain of a million nodes must not end in the machine's.
void place(std::vector<Node>& nodes, std::uint32_t root, bool reachable) {
    std::vector<std::pair<std::uint32_t, glm::dmat4>> stack{{root, glm::dmat4(1.0)}};
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        Node& node = nodes[index];
        node.placed = parent * local_matrix(node);
        node.world = glm::mat4(node.placed);
        node.reachable = reachable;
        for (const std::uint32_t child : node.children) stack.emplace_back(child, node.placed);
    }
}

}  // namespace

std::vector<Node> read_posed_nodes(const GltfDocument& document, const GltfOptions& options) {
    std::vector<Node> nodes;
    for (std::uint32_t i = 0; i < document.count("nodes"); ++i) nodes.push_back(read_node(document, i));
    const std::vector<std::uint32_t> parents = make_forest(document, nodes);
    animate(document, options, nodes);
    const bool has_scenes = document.count("scenes") > 0;
    // Nodes outside the scene are placed too: they may be joints.
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] == scene::no_index) place(nodes, i, !has_scenes);
    }
    if (!has_scenes) return nodes;
    const std::uint32_t scene = document.root()["scene"].index_below(document.count("scenes")).value_or(0);
    const JsonView roots = document.element("scenes", scene)["nodes"];
    std::vector<std::pair<std::uint32_t, JsonView>> listed_children;
    for (std::size_t r = 0; r < roots.size(); ++r) {
        const auto root = roots[r].index_below(nodes.size());
        if (!root) continue;
        if (parents[*root] != scene::no_index) {
            listed_children.emplace_back(*root, roots[r]);
        } else if (nodes[*root].reachable) {
            roots[r].repaired("the scene lists a node twice: drawn once");
        } else {
            show(nodes, *root);
        }
    }
    for (const auto& [child, where] : listed_children) {
        where.repaired("the scene lists a node that has a parent: drawn where its parent places it");
        show(nodes, child);
    }
    return nodes;
}

std::vector<glm::dmat4> joint_matrices(const GltfDocument& document, std::uint32_t skin,
                                       const std::vector<Node>& nodes) {
    const JsonView source = document.element("skins", skin);
    const JsonView joints = source["joints"];
    std::vector<glm::mat4> inverse_bind(joints.size(), glm::mat4(1.0f));
    if (const auto accessor = source["inverseBindMatrices"].index_below(document.count("accessors"))) {
        const auto read = as_mat4(read_accessor(document, *accessor), source["inverseBindMatrices"].where());
        if (read.size() < inverse_bind.size())
            source["inverseBindMatrices"].repaired(
                "has fewer matrices than the skin has joints: the others are 1");
        std::copy_n(read.begin(), std::min(read.size(), inverse_bind.size()), inverse_bind.begin());
    }
    std::vector<glm::dmat4> out;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        out.push_back(nodes[joints[j].required_index_below(nodes.size())].placed *
                      glm::dmat4(inverse_bind[j]));
    }
    if (out.empty()) joints.fail("a skin needs joints");
    return out;
}

}  // namespace candela::io
