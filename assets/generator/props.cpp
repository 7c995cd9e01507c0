// SPDX-License-Identifier: MIT
// The umbrella and the two posts: closed shells of revolution and sweeps.
#include <algorithm>

#include "assets/generator/demo_files.h"

namespace elbowroom::demo {

namespace {

constexpr double degrees = kPi / 180.0;

// Adds a closed grid of rows × columns points, columns wrapping round, the first and last row
// closed by a fan to their mean point. Seen from outside, columns run counter-clockwise about the
// direction in which rows advance.
void add_tube(GlbPrimitive& out, const std::vector<std::vector<Vec3>>& rows) {
  const auto base = static_cast<std::uint32_t>(out.positions.size());
  const std::size_t columns = rows.front().size();
  for (const auto& row : rows)
    for (const Vec3& p : row) out.positions.push_back(p);
  const auto at = [&](std::size_t r, std::size_t c) {
    return base + static_cast<std::uint32_t>(r * columns + c % columns);
  };
  for (std::size_t r = 0; r + 1 < rows.size(); ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      out.triangles.push_back({at(r, c), at(r, c + 1), at(r + 1, c + 1)});
      out.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r + 1, c)});
    }
  for (const bool last : {false, true}) {
    const std::size_t r = last ? rows.size() - 1 : 0;
    Vec3 centre(0.0);
    for (const Vec3& p : rows[r]) centre += p / static_cast<double>(columns);
    const auto middle = static_cast<std::uint32_t>(out.positions.size());
    out.positions.push_back(centre);
    for (std::size_t c = 0; c < columns; ++c) {
      if (last)
        out.triangles.push_back({middle, at(r, c), at(r, c + 1)});
      else
        out.triangles.push_back({middle, at(r, c + 1), at(r, c)});
    }
  }
}

// Circles about a curve given by points; radius by point. `side` is a direction never along it.
void add_sweep(GlbPrimitive& out, const std::vector<Vec3>& curve, const std::vector<double>& radius,
               int columns, const Vec3& side) {
  std::vector<std::vector<Vec3>> rows;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec3 before = curve[i > 0 ? i - 1 : i], after = curve[std::min(i + 1, curve.size() - 1)];
    const Vec3 along = glm::normalize(after - before);
    const Vec3 u = glm::normalize(side - glm::dot(side, along) * along);
    const Vec3 v = glm::cross(along, u);
    std::vector<Vec3> row;
    for (int c = 0; c < columns; ++c) {
      const double a = 2.0 * kPi * c / columns;
      row.push_back(curve[i] + radius[i] * (std::cos(a) * u + std::sin(a) * v));
    }
    rows.push_back(std::move(row));
  }
  add_tube(out, rows);
}

// Half-round ends for a sweep: points and radii that close it smoothly.
void append_dome(std::vector<Vec3>& curve, std::vector<double>& radius, const Vec3& along) {
  const Vec3 base = curve.back();
  const double r = radius.back();
  for (const double a : {30.0, 55.0, 75.0, 87.0}) {
    curve.push_back(base + r * std::sin(a * degrees) * along);
    radius.push_back(r * std::cos(a * degrees));
  }
}

// Splits vertices where neighbouring triangles meet at more than `crease` and gives every vertex
// the mean normal (by angle) of its smooth triangles.
GlbPrimitive with_normals(const GlbPrimitive& in, double crease) {
  const std::size_t n = in.triangles.size();
  std::vector<Vec3> normal(n);
  std::vector<std::vector<std::size_t>> around(in.positions.size());
  for (std::size_t i = 0; i < n; ++i) {
    const auto& t = in.triangles[i];
    normal[i] = glm::normalize(glm::cross(in.positions[t[1]] - in.positions[t[0]],
                                          in.positions[t[2]] - in.positions[t[0]]));
    for (const std::uint32_t v : t) around[v].push_back(i);
  }
  GlbPrimitive out;
  out.material = in.material;
  out.triangles.resize(n);
  const double limit = std::cos(crease);
  struct Corner {
    Vec3 normal;
    std::uint32_t index;
  };
  for (std::size_t v = 0; v < in.positions.size(); ++v) {
    std::vector<Corner> made;
    for (const std::size_t i : around[v]) {
      Vec3 sum(0.0);
      for (const std::size_t k : around[v]) {
        if (glm::dot(normal[i], normal[k]) < limit) continue;
        const auto& t = in.triangles[k];
        std::size_t c = 0;
        while (t[c] != v) ++c;
        const Vec3 a = glm::normalize(in.positions[t[(c + 1) % 3]] - in.positions[v]);
        const Vec3 b = glm::normalize(in.positions[t[(c + 2) % 3]] - in.positions[v]);
        sum += normal[k] * std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
      }
      const Vec3 smooth = glm::normalize(sum);
      auto same = std::find_if(made.begin(), made.end(), [&](const Corner& c) {
        return glm::dot(c.normal, smooth) > 1.0 - 1e-9;
      });
      if (same == made.end()) {
        made.push_back({smooth, static_cast<std::uint32_t>(out.positions.size())});
        out.positions.push_back(in.positions[v]);
        out.normals.push_back(smooth);
        same = made.end() - 1;
      }
      for (std::size_t c = 0; c < 3; ++c)
        if (in.triangles[i][c] == v) out.triangles[i][c] = same->index;
    }
  }
  return out;
}

// The umbrella stands with its shaft on the y axis, grip at the origin.
constexpr int kRibs = 8;
constexpr double kCanopyRadius = 0.46;
constexpr double kApex = 0.86;         // height of the canopy's top above the grip
constexpr double kCanopyDepth = 0.17;  // of a rib's tip below the top
constexpr double kCloth = 0.003;       // thickness: cloth and ribs in one closed shell

// Height of the cloth at a radius (fraction of the ribs' length) and a direction. Between ribs the
// cloth is stretched flat, so it lies lower and its hem runs in from rib tip to rib tip.
Vec3 cloth_point(double s, double angle) {
  const double panel = 2.0 * kPi / kRibs;
  const double in_panel = angle / panel - std::floor(angle / panel);  // 0 and 1 at the ribs
  const double between = 4.0 * in_panel * (1.0 - in_panel);           // 1 half-way
  const double hem = 1.0 - 0.075 * between * s * s;
  const double r = kCanopyRadius * s * hem;
  const double y = kApex - kCanopyDepth * (0.30 * s + 0.70 * s * s * s) -
                   0.012 * between * std::sin(kPi * std::min(s, 0.95));
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

GlbPrimitive canopy() {
  constexpr int kRows = 9, kColumns = kRibs * 6;
  std::vector<std::vector<Vec3>> rows;
  // Over the top from the shaft to the hem and back on the underside: columns run clockwise about
  // +y, and so about the way the rows advance on the whole, downwards, counter-clockwise.
  const auto ring = [&](double s, double lift) {
    std::vector<Vec3> row;
    for (int c = 0; c < kColumns; ++c) {
      const double a = 2.0 * kPi * c / kColumns;
      row.push_back(cloth_point(s, a) + Vec3(0, lift, 0));
    }
    return row;
  };
  for (int i = 0; i <= kRows; ++i) rows.push_back(ring(0.03 + 0.97 * i / kRows, kCloth));
  for (int i = kRows; i >= 0; --i) rows.push_back(ring(0.03 + 0.97 * i / kRows, 0.0));
  GlbPrimitive out;
  add_tube(out, rows);
  return out;
}

}  // namespace

GlbFile make_umbrella() {
  GlbFile file;
  file.generator_note = "elbowroom demo generator";
  file.materials = {{"Canopy", {0.80f, 0.115f, 0.085f}, 0.75f, 0.0f, false},
                    {"Shaft", {0.10f, 0.105f, 0.115f}, 0.40f, 0.0f, false},
                    {"Handle", {0.30f, 0.135f, 0.055f}, 0.50f, 0.0f, false}};

  GlbPrimitive cloth = canopy();

  GlbPrimitive shaft;
  {
    std::vector<Vec3> curve{{0, 0.055, 0}, {0, kApex + 0.004, 0}};
    std::vector<double> radius{0.0055, 0.0055};
    add_sweep(shaft, curve, radius, 12, {1, 0, 0});
    // Ferrule on top, runner and stretchers below the cloth.
    curve = {{0, kApex - 0.004, 0}, {0, kApex + 0.012, 0}, {0, kApex + 0.070, 0}};
    radius = {0.014, 0.010, 0.0045};
    append_dome(curve, radius, {0, 1, 0});
    add_sweep(shaft, curve, radius, 12, {1, 0, 0});
    const double runner = kApex - 0.27;
    curve = {{0, runner - 0.025, 0},
             {0, runner - 0.020, 0},
             {0, runner + 0.008, 0},
             {0, runner + 0.012, 0}};
    radius = {0.008, 0.011, 0.011, 0.008};
    add_sweep(shaft, curve, radius, 12, {1, 0, 0});
    for (int i = 0; i < kRibs; ++i) {
      const double a = 2.0 * kPi * i / kRibs;
      const Vec3 out(std::cos(a), 0, std::sin(a));
      const Vec3 foot = Vec3(0, runner, 0) + 0.010 * out;
      const Vec3 head = cloth_point(0.52, a) - Vec3(0, 0.0015, 0);
      add_sweep(shaft, {foot, head}, {0.0024, 0.0020}, 6, {-out.z, 0, out.x});
      // The rib under the seam, to its tip.
      std::vector<Vec3> rib;
      std::vector<double> thin;
      for (int k = 0; k <= 8; ++k) {
        rib.push_back(cloth_point(0.06 + 0.955 * k / 8, a) - Vec3(0, 0.0010, 0));
        thin.push_back(0.0022);
      }
      append_dome(rib, thin, glm::normalize(rib[8] - rib[7]));
      add_sweep(shaft, rib, thin, 6, {-out.z, 0, out.x});
    }
  }
  shaft.material = 1;

  // A straight grip that ends in a crook, open ahead (+z).
  GlbPrimitive handle;
  {
    std::vector<Vec3> curve{{0, 0.062, 0}, {0, 0.058, 0}, {0, 0.0, 0}, {0, -0.075, 0}};
    std::vector<double> radius{0.0090, 0.0115, 0.0115, 0.0115};
    constexpr double kCrook = 0.036;
    for (int i = 1; i <= 14; ++i) {
      const double a = 195.0 * degrees * i / 14;
      curve.push_back(Vec3(0, -0.075 - kCrook * std::sin(a), kCrook * (1.0 - std::cos(a))));
      radius.push_back(0.0115);
    }
    append_dome(curve, radius, glm::normalize(curve.back() - curve[curve.size() - 2]));
    // Downwards: side vector across the crook's plane.
    add_sweep(handle, curve, radius, 14, {1, 0, 0});
  }
  handle.material = 2;

  GlbMesh mesh{"Umbrella", {}};
  mesh.primitives.push_back(with_normals(cloth, 22.0 * degrees));
  mesh.primitives.push_back(with_normals(shaft, 50.0 * degrees));
  mesh.primitives.push_back(with_normals(handle, 60.0 * degrees));
  file.meshes.push_back(std::move(mesh));
  GlbNode node;
  node.name = "Umbrella";
  node.mesh = 0;
  file.nodes.push_back(node);
  return file;
}

GlbFile make_posts() {
  GlbFile file;
  file.generator_note = "elbowroom demo generator";
  file.materials = {{"Post", {0.19f, 0.225f, 0.27f}, 0.7f, 0.0f, false}};
  // Round posts with a foot plate and a rounded head; the space between them is 1.14 m.
  constexpr double kInner = 0.57, kRadius = 0.055, kHeight = 2.10;
  for (const double side : {1.0, -1.0}) {
    GlbPrimitive post;
    std::vector<Vec3> curve{{0, 0, 0}, {0, 0.020, 0}, {0, 0.026, 0}, {0, 0.026, 0}};
    std::vector<double> radius{0.105, 0.105, 0.099, kRadius + 0.001};
    constexpr int kSegments = 10;  // of its length, so that its triangles are no needles
    for (int i = 0; i <= kSegments; ++i) {
      curve.push_back({0, 0.027 + (kHeight - kRadius - 0.027) * i / kSegments, 0});
      radius.push_back(kRadius);
    }
    append_dome(curve, radius, {0, 1, 0});
    std::vector<std::vector<Vec3>> rows;
    constexpr int kColumns = 24;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      std::vector<Vec3> row;
      for (int c = 0; c < kColumns; ++c) {
        const double a = -2.0 * kPi * c / kColumns;  // counter-clockwise about +y
        row.push_back(curve[i] + radius[i] * Vec3(std::cos(a), 0, std::sin(a)));
      }
      rows.push_back(std::move(row));
    }
    add_tube(post, rows);
    GlbMesh mesh{side > 0 ? "LeftPost" : "RightPost", {with_normals(post, 40.0 * degrees)}};
    GlbNode node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(file.meshes.size());
    node.translation = Vec3(side * (kInner + kRadius), 0, 0);
    file.meshes.push_back(std::move(mesh));
    file.nodes.push_back(node);
  }
  return file;
}

}  // namespace elbowroom::demo
