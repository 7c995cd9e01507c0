// SPDX-License-Identifier: MIT
#include "core/collision/clip_touching.h"

#include <cstddef>

#include "core/collision/mesh_data.h"

namespace elbowroom {
namespace {

// Those of the part that share a corner with one of these.
std::vector<bool> with_neighbours(const CollisionBody& body, int part,
                                  const std::set<std::uint32_t>& triangles) {
  const auto& corners = body.mesh().triangles();
  const auto& welded = body.mesh().data().topology.welded;
  std::vector<bool> corner_touched(welded.size(), false), touched(corners.size(), false);
  for (const std::uint32_t t : triangles)
    for (int k = 0; k < 3; ++k) corner_touched[welded[corners[t][k]]] = true;
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (corner_touched[welded[corners[t][k]]] && body.triangles()[t].part == part)
        touched[t] = true;
  return touched;
}

void merge(std::vector<bool>& all, const std::vector<bool>& more) {
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] || more[i];
}

// Each triangle's patch, or where it is touched that and the number of patches.
std::vector<std::uint16_t> pieces_of(const CollisionBody& body, const std::vector<bool>& touched) {
  std::vector<std::uint16_t> pieces = body.patch_of();
  for (std::size_t t = 0; t < pieces.size(); ++t)
    if (touched[t]) pieces[t] = static_cast<std::uint16_t>(pieces[t] + body.patch_count());
  return pieces;
}

std::vector<std::uint16_t> pieces_where(const std::vector<std::uint16_t>& piece_of,
                                        const std::vector<bool>& touched) {
  std::set<std::uint16_t> pieces;
  for (std::size_t t = 0; t < piece_of.size(); ++t)
    if (touched[t]) pieces.insert(piece_of[t]);
  return {pieces.begin(), pieces.end()};
}

}  // namespace

ClipTouching::ClipTouching(const CollisionBody& a, const CollisionBody& b,
                           const std::vector<bool>& lasting, const std::vector<Parts>& touched) {
  if (touched.empty()) return;
  std::vector<std::vector<bool>> of_a, of_b;
  std::vector<bool> any_a(a.triangles().size(), false), any_b(b.triangles().size(), false);
  for (const Parts& parts : touched) {
    of_a.push_back(with_neighbours(a, parts.part_a, parts.a));
    of_b.push_back(with_neighbours(b, parts.part_b, parts.b));
    merge(any_a, of_a.back());
    merge(any_b, of_b.back());
  }
  piece_of_a_ = pieces_of(a, any_a);
  piece_of_b_ = pieces_of(b, any_b);
  pieces_b_ = 2 * b.patch_count();
  const auto rows = static_cast<std::size_t>(a.patch_count());
  const auto columns = static_cast<std::size_t>(b.patch_count());
  lasting_.assign(4 * rows * columns, false);
  for (std::size_t p = 0; p < 2 * rows; ++p)
    for (std::size_t q = 0; q < 2 * columns; ++q)
      lasting_[p * 2 * columns + q] = lasting[(p % rows) * columns + q % columns];
  allowed_ = lasting_;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    parts_.push_back({touched[i].part_a, touched[i].part_b, pieces_where(piece_of_a_, of_a[i]),
                      pieces_where(piece_of_b_, of_b[i])});
    allow(parts_.back(), allowed_);
  }
}

void ClipTouching::allow(const Pieces& pieces, std::vector<bool>& allowed) const {
  for (const std::uint16_t p : pieces.a)
    for (const std::uint16_t q : pieces.b)
      allowed[static_cast<std::size_t>(p) * static_cast<std::size_t>(pieces_b_) + q] = true;
}

std::vector<bool> ClipTouching::allowed_where(const std::vector<bool>& holds) const {
  std::vector<bool> allowed = lasting_;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (holds[i]) allow(parts_[i], allowed);
  return allowed;
}

}  // namespace elbowroom
