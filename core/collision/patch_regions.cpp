// SPDX-License-Identifier: MIT
#include "core/collision/patch_regions.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

constexpr std::size_t kClasses = 64;

// How many triangles each patch has, up to the last that is used.
std::vector<std::size_t> patch_sizes(const std::uint16_t* patch_of, std::size_t triangles) {
  std::vector<std::size_t> sizes;
  for (std::size_t t = 0; t < triangles; ++t) {
    if (sizes.size() <= patch_of[t]) sizes.resize(std::size_t{patch_of[t]} + 1, 0);
    ++sizes[patch_of[t]];
  }
  return sizes;
}

std::vector<int> used(const std::vector<std::size_t>& sizes) {
  std::vector<int> patches;
  for (std::size_t p = 0; p < sizes.size(); ++p)
    if (sizes[p] > 0) patches.push_back(static_cast<int>(p));
  return patches;
}

// By box the union of its triangles' bits; returns that of all.
std::uint64_t gather(const BoxTree& tree, const std::vector<std::uint64_t>& of_patch,
                     const std::uint16_t* patch_of, std::vector<std::uint64_t>& of_box) {
  of_box.assign(tree.nodes.size() * BoxTree::kWidth, 0);
  std::uint64_t whole = 0;
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parents
    const BoxTree::Node& node = tree.nodes[n];
    whole = 0;
    for (int i = 0; i < node.count; ++i) {
      const BoxTree::Ref child = node.child[i];
      std::uint64_t bits = 0;
      if (BoxTree::is_triangle(child)) {
        bits = of_patch[patch_of[BoxTree::triangle_of(child)]];
      } else {
        const std::size_t first = static_cast<std::size_t>(child) * BoxTree::kWidth;
        for (std::size_t k = 0; k < BoxTree::kWidth; ++k) bits |= of_box[first + k];
      }
      of_box[n * BoxTree::kWidth + static_cast<std::size_t>(i)] = bits;
      whole |= bits;
    }
  }
  return whole;
}

}  // namespace

std::shared_ptr<const PatchRegions> patch_regions(const CollisionMesh& a, const CollisionMesh& b,
                                                  const PatchFilter& filter) {
  if (!filter.allowed) return nullptr;
  const CollisionMesh::Data &da = a.data(), &db = b.data();
  const auto sizes_a = patch_sizes(filter.patch_of_a, da.triangles.size());
  const auto sizes_b = patch_sizes(filter.patch_of_b, db.triangles.size());
  const std::vector<int> patches_a = used(sizes_a), patches_b = used(sizes_b);
  const auto allows = [&](int p, int q) {
    return (
        *filter.allowed)[static_cast<std::size_t>(p) * static_cast<std::size_t>(filter.patches_b) +
                         static_cast<std::size_t>(q)];
  };

  // Classes of b's patches, those with the most triangles first.
  std::map<std::vector<bool>, std::pair<std::size_t, std::vector<int>>> by_column;
  bool any = false;
  for (const int q : patches_b) {
    std::vector<bool> column;
    for (const int p : patches_a) {
      column.push_back(allows(p, q));
      any = any || column.back();
    }
    auto& [triangles, members] = by_column[std::move(column)];
    triangles += sizes_b[static_cast<std::size_t>(q)];
    members.push_back(q);
  }
  if (!any) return nullptr;
  std::vector<const decltype(by_column)::value_type*> classes;
  for (const auto& each : by_column) classes.push_back(&each);
  std::stable_sort(classes.begin(), classes.end(),
                   [](const auto* x, const auto* y) { return x->second.first > y->second.first; });

  std::vector<std::uint64_t> forbidden(sizes_a.size(), 0), own(sizes_b.size(), 0);
  for (std::size_t c = 0; c < classes.size(); ++c) {
    const std::uint64_t bit = std::uint64_t{1} << std::min(c, kClasses - 1);
    for (const int q : classes[c]->second.second) own[static_cast<std::size_t>(q)] |= bit;
    for (std::size_t i = 0; i < patches_a.size(); ++i)
      if (!classes[c]->first[i]) forbidden[static_cast<std::size_t>(patches_a[i])] |= bit;
  }
  auto regions = std::make_shared<PatchRegions>();
  regions->all_a = gather(da.tree, forbidden, filter.patch_of_a, regions->of_a);
  regions->all_b = gather(db.tree, own, filter.patch_of_b, regions->of_b);
  return regions;
}

}  // namespace elbowroom
