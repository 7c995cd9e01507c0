// SPDX-License-Identifier: MIT
#include "core/collision/ray_scene.h"

#if ELBOWROOM_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cmath>
#include <cstring>

namespace elbowroom {
namespace {

// Embree wants denormals flushed; exact predicates want them kept.
class FlushDenormals {
 public:
#if defined(__SSE__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
  ~FlushDenormals() { _mm_setcsr(before_); }

 private:
  unsigned before_;
#else
  FlushDenormals() {}
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

// Made at first use, never released: meshes may outlive every static object.
RTCDevice device() {
  static const RTCDevice the_device = rtcNewDevice("threads=1,set_affinity=0");
  return the_device;
}

#if ELBOWROOM_EMBREE_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
constexpr auto kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
using EmbreeContext = RTCIntersectContext;
constexpr auto kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

// Embree hands the filter its context; ours begins with it.
struct Context {
  EmbreeContext embree;
  std::vector<RayScene::Hit>* hits;
  bool go_on;  // refuse every hit, so that the ray goes on to the next
};

void on_hit(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const Context*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const float u = RTCHitN_u(args->hit, args->N, i), v = RTCHitN_v(args->hit, args->N, i);
    const glm::vec3 normal(RTCHitN_Ng_x(args->hit, args->N, i), RTCHitN_Ng_y(args->hit, args->N, i),
                           RTCHitN_Ng_z(args->hit, args->N, i));
    const glm::vec3 along(RTCRayN_dir_x(args->ray, args->N, i),
                          RTCRayN_dir_y(args->ray, args->N, i),
                          RTCRayN_dir_z(args->ray, args->N, i));
    // At the time of the call tfar is the distance of this hit.
    const float t = RTCRayN_tfar(args->ray, args->N, i);
    const float slant = std::abs(glm::dot(normal, along));
    constexpr float kEdge = 1e-3f;
    RayScene::Hit hit;
    hit.ray = RTCRayN_id(args->ray, args->N, i);
    hit.triangle = RTCHitN_primID(args->hit, args->N, i);
    hit.clear = u > kEdge && v > kEdge && u + v < 1.0f - kEdge && t > 1e-4f && t < 1.0f - 1e-4f &&
                slant > 1e-2f * glm::length(normal) * glm::length(along);
    context->hits->push_back(hit);
    if (context->go_on) args->valid[i] = 0;
  }
}

struct NearestContext {
  EmbreeContext embree;
  const RayScene::Accept* accept;
};

void on_nearest(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const NearestContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const float facing =
        RTCHitN_Ng_x(args->hit, args->N, i) * RTCRayN_dir_x(args->ray, args->N, i) +
        RTCHitN_Ng_y(args->hit, args->N, i) * RTCRayN_dir_y(args->ray, args->N, i) +
        RTCHitN_Ng_z(args->hit, args->N, i) * RTCRayN_dir_z(args->ray, args->N, i);
    if (!(*context->accept)(RTCHitN_primID(args->hit, args->N, i), facing)) args->valid[i] = 0;
  }
}

}  // namespace

struct RayScene::Data {
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  std::size_t positions = 0, triangles = 0;

  ~Data() {
    if (geometry) rtcReleaseGeometry(geometry);
    if (scene) rtcReleaseScene(scene);
  }

  void fire(std::span<const Ray> rays, std::vector<Hit>& hits, bool go_on) const;
};

RayScene::RayScene() : data_(std::make_unique<Data>()) {}
RayScene::~RayScene() = default;

void RayScene::set(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
  const FlushDenormals flush;
  Data& d = *data_;
  const bool is_new =
      !d.scene || d.positions != positions.size() || d.triangles != triangles.size();
  if (is_new) {
    if (d.geometry) rtcReleaseGeometry(d.geometry);
    if (d.scene) rtcReleaseScene(d.scene);
    d.scene = rtcNewScene(device());
    rtcSetSceneFlags(d.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | kFilterFlag));
    rtcSetSceneBuildQuality(d.scene, RTC_BUILD_QUALITY_MEDIUM);
    d.geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    d.positions = positions.size();
    d.triangles = triangles.size();
    // Embree owns the buffers, and pads them.
    void* vertices =
        rtcSetNewGeometryBuffer(d.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), positions.size());
    void* indices = rtcSetNewGeometryBuffer(d.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(glm::uvec3), triangles.size());
    if (!positions.empty()) std::memcpy(vertices, positions.data(), positions.size_bytes());
    if (!triangles.empty()) std::memcpy(indices, triangles.data(), triangles.size_bytes());
    rtcCommitGeometry(d.geometry);
    rtcAttachGeometry(d.scene, d.geometry);
  } else if (!positions.empty()) {
    void* vertices = rtcGetGeometryBufferData(d.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    std::memcpy(vertices, positions.data(), positions.size_bytes());
    rtcUpdateGeometryBuffer(d.geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(d.geometry);
  }
  rtcCommitScene(d.scene);
}

void RayScene::Data::fire(std::span<const Ray> rays, std::vector<Hit>& hits, bool go_on) const {
  if (!scene || triangles == 0 || rays.empty()) return;
  Context context;
  context.hits = &hits;
  context.go_on = go_on;
  RTCRay16 packet;
  alignas(64) int valid[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool used = i < rays.size();
    const Ray& ray = rays[used ? i : 0];
    valid[i] = used ? -1 : 0;
    packet.org_x[i] = ray.origin.x;
    packet.org_y[i] = ray.origin.y;
    packet.org_z[i] = ray.origin.z;
    packet.dir_x[i] = ray.direction.x;
    packet.dir_y[i] = ray.direction.y;
    packet.dir_z[i] = ray.direction.z;
    packet.tnear[i] = 0.0f;
    packet.tfar[i] = 1.0f;
    packet.time[i] = 0.0f;
    packet.mask[i] = ~0u;
    packet.id[i] = static_cast<unsigned>(i);
    packet.flags[i] = 0;
  }
  const FlushDenormals flush;
#if ELBOWROOM_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context.embree);
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  arguments.context = &context.embree;
  arguments.filter = on_hit;
  rtcOccluded16(valid, scene, &packet, &arguments);
#else
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = on_hit;
  rtcOccluded16(valid, scene, &context.embree, &packet);
#endif
}

void RayScene::all_hits(std::span<const Ray> rays, std::vector<Hit>& hits) const {
  data_->fire(rays, hits, true);
}

void RayScene::any_hits(std::span<const Ray> rays, std::vector<Hit>& hits) const {
  data_->fire(rays, hits, false);
}

std::optional<RayScene::Nearest> RayScene::nearest_hit(const Ray& ray, const Accept& accept) const {
  if (!data_->scene || data_->triangles == 0) return std::nullopt;
  NearestContext context;
  context.accept = &accept;
  RTCRayHit query;
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  query.ray.tnear = 0.0f;
  query.ray.tfar = 1.0f;
  query.ray.time = 0.0f;
  query.ray.mask = ~0u;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  const FlushDenormals flush;
#if ELBOWROOM_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context.embree);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  arguments.context = &context.embree;
  arguments.filter = on_nearest;
  rtcIntersect1(data_->scene, &query, &arguments);
#else
  rtcInitIntersectContext(&context.embree);
  context.embree.filter = on_nearest;
  rtcIntersect1(data_->scene, &context.embree, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Nearest{query.hit.primID, query.ray.tfar};
}

}  // namespace elbowroom
