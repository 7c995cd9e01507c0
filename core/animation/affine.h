// SPDX-License-Identifier: MIT
// Products of affine matrices (last row 0 0 0 1), which is all that ever occurs in a skeleton:
// a little over half the work of the general product.
#pragma once

#include "core/animation/skeleton.h"

namespace elbowroom {

// a·b. Requires both affine.
inline Mat4 multiply_affine(const Mat4& a, const Mat4& b) {
  Mat4 m;
  for (int c = 0; c < 4; ++c) {
    const auto& column = b[c];
    for (int r = 0; r < 3; ++r) {
      const double sum = a[0][r] * column[0] + a[1][r] * column[1] + a[2][r] * column[2];
      m[c][r] = c == 3 ? sum + a[3][r] : sum;
    }
    m[c][3] = c == 3 ? 1.0 : 0.0;
  }
  return m;
}

// m·(p, 1). Requires m affine.
inline Vec3 transform_point(const Mat4& m, const Vec3& p) {
  return Vec3(m[0]) * p.x + Vec3(m[1]) * p.y + Vec3(m[2]) * p.z + Vec3(m[3]);
}

// Translation, rotation and scale whose product comes nearest to m: exact where m has no shear. A
// mirror becomes three negative scales (see rotation_of).
Transform decompose(const Mat4& m);

}  // namespace elbowroom
