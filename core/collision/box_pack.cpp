// SPDX-License-Identifier: MIT
#include "core/collision/box_pack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/collision/box_pack.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace elbowroom {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

bool SphereNear(const BoxPack* packs, std::size_t count, const float* c, float radius) {
  const hn::CappedTag<float, BoxPack::kWidth> d;
  const auto zero = hn::Zero(d), x = hn::Set(d, c[0]), y = hn::Set(d, c[1]), z = hn::Set(d, c[2]);
  // Differences round by 2^-24 of the coordinates, a few times, squares by a few units of their
  // own.
  const auto size = hn::Set(
      d, 4e-6f * std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])}) + radius * (1 + 2e-6f));
  const auto more = hn::Set(d, 4e-6f);
  const int step = static_cast<int>(hn::Lanes(d));
  for (std::size_t i = 0; i < count; ++i) {
    const BoxPack& pack = packs[i];
    for (int first = 0; first < BoxPack::kWidth; first += step) {
      const auto cx = hn::Load(d, pack.center[0] + first), cy = hn::Load(d, pack.center[1] + first),
                 cz = hn::Load(d, pack.center[2] + first);
      const auto hx = hn::Load(d, pack.half[0] + first), hy = hn::Load(d, pack.half[1] + first),
                 hz = hn::Load(d, pack.half[2] + first);
      const auto ox = hn::Max(hn::Sub(hn::Abs(hn::Sub(cx, x)), hx), zero);
      const auto oy = hn::Max(hn::Sub(hn::Abs(hn::Sub(cy, y)), hy), zero);
      const auto oz = hn::Max(hn::Sub(hn::Abs(hn::Sub(cz, z)), hz), zero);
      const auto out2 = hn::Add(hn::Add(hn::Mul(ox, ox), hn::Mul(oy, oy)), hn::Mul(oz, oz));
      const auto span = hn::Add(hn::Add(hn::Abs(cx), hn::Abs(cy)),
                                hn::Add(hn::Abs(cz), hn::Abs(hn::Max(hx, hn::Max(hy, hz)))));
      const auto reach = hn::Add(size, hn::Mul(more, hn::Min(span, hn::Set(d, 1e15f))));
      if (!hn::AllTrue(d, hn::Gt(out2, hn::Mul(reach, reach)))) return true;
    }
  }
  return false;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace elbowroom
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace elbowroom {

HWY_EXPORT(SphereNear);

std::vector<BoxPack> pack_boxes(std::span<const std::pair<glm::vec3, glm::vec3>> corners,
                                const Vec3& origin) {
  const std::size_t width = BoxPack::kWidth;
  std::vector<BoxPack> packs((corners.size() + width - 1) / width);
  for (std::size_t i = 0; i < packs.size() * width; ++i) {
    BoxPack& pack = packs[i / width];
    const std::size_t slot = i % width;
    for (int k = 0; k < 3; ++k) {
      pack.center[k][slot] = 0;
      pack.half[k][slot] = -1e30f;
      if (i >= corners.size()) continue;
      const double low = static_cast<double>(corners[i].first[k]) - origin[k],
                   high = static_cast<double>(corners[i].second[k]) - origin[k];
      const auto center = static_cast<float>(0.5 * (low + high));
      const auto half = static_cast<float>(
          std::max(high - static_cast<double>(center), static_cast<double>(center) - low));
      pack.center[k][slot] = center;
      pack.half[k][slot] = half * (1 + 0x1p-22f) + std::numeric_limits<float>::min();
    }
  }
  return packs;
}

bool sphere_near_boxes(const BoxPack* packs, std::size_t count, const Vec3& centre, double radius) {
  const glm::vec3 c(centre);
  const float at[3] = {c.x, c.y, c.z};
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) return count > 0;
  return HWY_DYNAMIC_DISPATCH(SphereNear)(packs, count, at, static_cast<float>(radius));
}

}  // namespace elbowroom
#endif  // HWY_ONCE
