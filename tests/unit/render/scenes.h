// SPDX-License-Identifier: MIT
// Small worlds made in memory, whose pictures are known.
#pragma once

#include <memory>
#include <vector>

#include "core/scene/world.h"

namespace elbowroom::test {

// Adds a node; returns its index.
int add_node(Model& model, int parent, const Transform& rest);

// Closed shapes about the origin, without normals.
Mesh box_mesh(const glm::vec3& half);
Mesh sphere_mesh(float radius, int rings = 24, int segments = 48);
// Along +y from 0 to `height`, closed; every ring has its own vertices.
Mesh cylinder_mesh(float radius, float height, int rings, int segments = 24);

// Adds a mesh at a node as an object or, with skin ≥ 0, leaves it to the caller.
int add_mesh(Model& model, Mesh mesh, int node);
void add_object(Model& model, int mesh);

// A cylinder 1.5 high that bends: a chain of `joints` joints upwards, each vertex moved by
// `influences` of them with weights that fall off with distance. Character 0; skin 0.
std::shared_ptr<Model> bending_character(int joints, int influences);

// One actor that plays nothing.
Actor actor_of(std::shared_ptr<const Model> model, const Mat4& place = Mat4(1.0));

// A clip that bends every joint of bending_character about z, from 0 at 0 s to `angle` at 1 s.
std::shared_ptr<Clip> bending_clip(const Model& model, double angle);

}  // namespace elbowroom::test
