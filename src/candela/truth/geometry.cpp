#include "candela/truth/geometry.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <string>

#include "candela/scene/error.hpp"

namespace candela::truth {

struct Geometry::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    std::map<const scene::Primitive*, RTCScene> shared;

    Embree() {
        device = rtcNewDevice("");
        if (!device) throw machine_error("Embree cannot start", {}, "it needs an x86-64 CPU with SSE2");
        scene = new_scene();
    }
    ~Embree() {
        for (const auto& [primitive, tree] : shared) rtcReleaseScene(tree);
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    [[nodiscard]] RTCScene new_scene() const {
        RTCScene out = rtcNewScene(device);
        rtcSetSceneFlags(out, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(out, RTC_BUILD_QUALITY_HIGH);
        return out;
    }

    /// Attaches the triangles of `p` as geometry `id` of `to`, each vertex at position(i).
    template <class Position>
    void attach_triangles(RTCScene to, const scene::Primitive& p, std::uint32_t id,
                          const Position& position) const {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at the last vertex of a shared buffer, which a vector of 12-byte elements
        // does not have: let it allocate.
        auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), p.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), p.indices.size() / 3));
        if (!vertices || !indices) {
            rtcReleaseGeometry(geometry);
            throw machine_error("out of memory while building the ray-tracing structure");
        }
        for (std::uint32_t i = 0; i < p.positions.size(); ++i) vertices[i] = position(i);
        std::memcpy(indices, p.indices.data(), p.indices.size() / 3 * 3 * sizeof(std::uint32_t));
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(to, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    void attach_copy(const Part& part, std::uint32_t id) const {
        attach_triangles(scene, *part.primitive, id, [&](std::uint32_t i) { return part.position(i); });
    }

    void attach_instance(const Part& part, std::uint32_t id) {
        const auto [entry, fresh] = shared.try_emplace(part.primitive, nullptr);
        if (fresh) {
            entry->second = new_scene();
            attach_triangles(entry->second, *part.primitive, 0,
                             [&](std::uint32_t i) { return part.primitive->positions[i]; });
            rtcCommitScene(entry->second);
        }
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, entry->second);
        rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &part.world[0][0]);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
        rtcReleaseGeometry(geometry);
    }

    void commit() const {
        rtcCommitScene(scene);
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) {
            throw machine_error("Embree failed with error " + std::to_string(static_cast<int>(error)), {},
                                "the scene may need more memory than there is");
        }
    }
};

namespace {

glm::mat3 cofactors(const glm::mat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

glm::vec3 unit(const glm::vec3& v) {
    return v * (1.0f / std::sqrt(std::max(glm::dot(v, v), 1e-30f)));
}

Part make_part(const scene::Primitive& p, const scene::Instance& instance, std::uint32_t index) {
    Part part;
    part.primitive = &p;
    part.material = p.material;
    part.instance = index;
    part.world = instance.world;
    const glm::mat3 linear(instance.world);
    part.mirrored = glm::determinant(linear) < 0.0f;
    part.to_normal = cofactors(linear);
    return part;
}

RTCRayHit embree_ray(const Ray& ray) {
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x;
    r.ray.org_y = ray.origin.y;
    r.ray.org_z = ray.origin.z;
    r.ray.dir_x = ray.direction.x;
    r.ray.dir_y = ray.direction.y;
    r.ray.dir_z = ray.direction.z;
    r.ray.tfar = ray.t_max;
    r.ray.mask = 0xffffffffu;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

}  // namespace

glm::vec3 Part::normal(std::uint32_t vertex) const {
    const float handedness = mirrored ? -1.0f : 1.0f;
    return unit(to_normal * primitive->normals[vertex] * handedness);
}

glm::vec4 Part::tangent(std::uint32_t vertex) const {
    const glm::vec4& t = primitive->tangents[vertex];
    return {unit(glm::mat3(world) * glm::vec3(t)), mirrored ? -t.w : t.w};
}

Geometry::Geometry(const scene::Scene& scene, std::size_t max_copied_triangles)
    : embree_(std::make_unique<Embree>()) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (p.indices.size() >= 3) parts_.push_back(make_part(p, instance, i));
        }
    }
    const std::set<const scene::Primitive*> shared = scene::shared_primitives(scene, max_copied_triangles);
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
        if (shared.contains(parts_[i].primitive))
            embree_->attach_instance(parts_[i], i);
        else
            embree_->attach_copy(parts_[i], i);
    }
    embree_->commit();
}

Geometry::~Geometry() = default;

bool Geometry::intersect(const Ray& ray, Hit& hit) const {
    RTCRayHit r = embree_ray(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    // Of an instance, the geometry of its own scene is its only one.
    const bool instanced = r.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    hit = {instanced ? r.hit.instID[0] : r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v, r.ray.tfar};
    return true;
}

bool Geometry::occluded(const Ray& ray) const {
    RTCRay r = embree_ray(ray).ray;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_->scene, &context, &r);
    return r.tfar < 0.0f;
}

void Geometry::corners(std::uint32_t part, std::uint32_t triangle, glm::vec3 (&out)[3]) const {
    const Part& p = parts_[part];
    const std::uint32_t* index = p.primitive->indices.data() + std::size_t{3} * triangle;
    out[0] = p.position(index[0]);
    out[1] = p.position(index[p.mirrored ? 2 : 1]);
    out[2] = p.position(index[p.mirrored ? 1 : 2]);
}

}  // namespace candela::truth
