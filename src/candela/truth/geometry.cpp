#include "candela/truth/geometry.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "candela/scene/error.hpp"

namespace candela::truth {

struct Geometry::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    Embree() {
        device = rtcNewDevice("");
        if (!device) throw machine_error("Embree cannot start", {}, "it needs an x86-64 CPU with SSE2");
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    }
    ~Embree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    void attach(const Part& part, std::uint32_t id) const {
        const scene::Primitive& p = *part.primitive;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at the last vertex of a shared buffer, which a vector of 12-byte elements
        // does not have: let it allocate.
        auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                         RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                                                         part.positions.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    3 * sizeof(std::uint32_t), p.indices.size() / 3));
        if (!vertices || !indices) {
            rtcReleaseGeometry(geometry);
            throw machine_error("out of memory while building the ray-tracing structure");
        }
        std::memcpy(vertices, part.positions.data(), part.positions.size() * sizeof(glm::vec3));
        std::memcpy(indices, p.indices.data(), p.indices.size() / 3 * 3 * sizeof(std::uint32_t));
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

/// As realtime/shaders/mesh.vert.glsl does: normals by cofactors, handedness turned where the instance
/// mirrors.
Part make_part(const scene::Primitive& p, const scene::Instance& instance, std::uint32_t index) {
    Part part;
    part.primitive = &p;
    part.material = p.material;
    part.instance = index;
    const glm::mat3 linear(instance.world);
    part.mirrored = glm::determinant(linear) < 0.0f;
    const float handedness = part.mirrored ? -1.0f : 1.0f;
    const glm::mat3 to_normal = cofactors(linear);
    part.positions.reserve(p.positions.size());
    for (const glm::vec3& x : p.positions) part.positions.emplace_back(instance.world * glm::vec4(x, 1.0f));
    part.normals.reserve(p.normals.size());
    for (const glm::vec3& n : p.normals) part.normals.push_back(unit(to_normal * n * handedness));
    part.tangents.reserve(p.tangents.size());
    for (const glm::vec4& t : p.tangents) {
        part.tangents.emplace_back(unit(linear * glm::vec3(t)), t.w * handedness);
    }
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

Geometry::Geometry(const scene::Scene& scene) : embree_(std::make_unique<Embree>()) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const scene::Instance& instance = scene.instances[i];
        for (const scene::Primitive& p : scene.meshes[instance.mesh].primitives) {
            if (p.indices.size() >= 3) parts_.push_back(make_part(p, instance, i));
        }
    }
    for (std::uint32_t i = 0; i < parts_.size(); ++i) embree_->attach(parts_[i], i);
    embree_->commit();
}

Geometry::~Geometry() = default;

bool Geometry::intersect(const Ray& ray, Hit& hit) const {
    RTCRayHit r = embree_ray(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = {r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v, r.ray.tfar};
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
    out[0] = p.positions[index[0]];
    out[1] = p.positions[index[p.mirrored ? 2 : 1]];
    out[2] = p.positions[index[p.mirrored ? 1 : 2]];
}

}  // namespace candela::truth
