// SPDX-License-Identifier: MIT
#include "assets/generator/clips.h"
#include "assets/generator/demo_files.h"
#include "assets/generator/outfit.h"

namespace elbowroom::demo {

GlbFile make_mannequin() {
  const BodyShape shape;
  const Figure figure = make_figure();
  const Surface surface = cut_outfit(remesh(polygonize(shape, 0.0058), shape, 5), shape);
  const std::vector<VertexWeights> weights = skin_weights(surface, shape, figure);

  // Half the shape's own normal, half the mean of the triangles about: in the narrow corners
  // between fingers the first alone turns faster than the triangles do.
  std::vector<Vec3> normals(surface.positions.size(), Vec3(0.0));
  for (const auto& t : surface.triangles) {
    const Vec3 &a = surface.positions[t[0]], &b = surface.positions[t[1]],
               &c = surface.positions[t[2]];
    const Vec3 face = glm::normalize(glm::cross(b - a, c - a));
    for (const std::uint32_t v : t) normals[v] += face;
  }
  for (std::size_t i = 0; i < normals.size(); ++i)
    normals[i] = glm::normalize(glm::normalize(normals[i]) + shape.normal(surface.positions[i]));

  GlbFile file;
  file.generator_note = "elbowroom demo generator";
  file.materials = outfit_materials();

  // One primitive a material; vertices on a hem stand in both, alike to the bit.
  GlbMesh mesh{"Body", {}};
  for (std::size_t m = 0; m < file.materials.size(); ++m) {
    GlbPrimitive part;
    part.material = static_cast<int>(m);
    constexpr std::uint32_t kNone = ~0u;
    std::vector<std::uint32_t> index(surface.positions.size(), kNone);
    for (const auto& t : surface.triangles) {
      const Vec3 centre =
          (surface.positions[t[0]] + surface.positions[t[1]] + surface.positions[t[2]]) / 3.0;
      if (outfit_material(centre) != static_cast<int>(m)) continue;
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (index[t[k]] == kNone) {
          index[t[k]] = static_cast<std::uint32_t>(part.positions.size());
          part.positions.push_back(surface.positions[t[k]]);
          part.normals.push_back(normals[t[k]]);
          part.weights.push_back(weights[t[k]]);
        }
        corners[k] = index[t[k]];
      }
      part.triangles.push_back(corners);
    }
    mesh.primitives.push_back(std::move(part));
  }
  file.meshes.push_back(std::move(mesh));

  GlbNode root;
  root.name = "Mannequin";
  file.nodes.push_back(root);
  GlbSkin glb_skin{"Mannequin", {}, {}};
  for (std::size_t j = 0; j < figure.joints.size(); ++j) {
    const FigureJoint& joint = figure.joints[j];
    GlbNode node;
    node.name = joint.name;
    node.parent = joint.parent + 1;
    node.translation = figure.offset(static_cast<int>(j));
    node.rotation =
        joint.parent < 0
            ? joint.rotation
            : glm::conjugate(figure.joints[static_cast<std::size_t>(joint.parent)].rotation) *
                  joint.rotation;
    file.nodes.push_back(node);
    glb_skin.joints.push_back(static_cast<int>(j) + 1);
    Mat4 bind = glm::mat4_cast(joint.rotation);
    bind[3] = glm::dvec4(joint.position, 1.0);
    glb_skin.inverse_bind.push_back(glm::inverse(bind));
  }
  GlbNode body;
  body.name = "Body";
  body.mesh = 0;
  body.skinned = true;
  file.nodes.push_back(body);
  file.skins.push_back(std::move(glb_skin));

  for (const FigureClip& clip : make_clips(figure)) {
    GlbClip out{clip.name, clip.times, {}};
    GlbChannel hips{1, false, clip.hips, {}};
    out.channels.push_back(std::move(hips));
    for (std::size_t j = 0; j < figure.joints.size(); ++j)
      out.channels.push_back({static_cast<int>(j) + 1, true, {}, clip.rotations[j]});
    file.clips.push_back(std::move(out));
  }
  return file;
}

}  // namespace elbowroom::demo
