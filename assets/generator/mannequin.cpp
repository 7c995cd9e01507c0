// SPDX-License-Identifier: MIT
#include "assets/generator/clips.h"
#include "assets/generator/demo_files.h"

namespace elbowroom::demo {

GlbFile make_mannequin() {
  const BodyShape shape;
  const Figure figure = make_figure();
  const Surface surface = remesh(polygonize(shape, 0.005), shape, 5);
  const std::vector<VertexWeights> weights = skin_weights(surface, shape, figure);

  GlbFile file;
  file.generator_note = "elbowroom demo generator";
  file.materials = {{"Mannequin", {0.62f, 0.58f, 0.53f}, 0.65f, 0.0f, false}};

  GlbPrimitive skin;
  skin.positions = surface.positions;
  skin.triangles = surface.triangles;
  skin.weights = weights;
  for (const Vec3& p : surface.positions) skin.normals.push_back(shape.normal(p));
  file.meshes.push_back({"Body", {std::move(skin)}});

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
