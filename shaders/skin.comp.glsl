// SPDX-License-Identifier: MIT
// Linear blend skinning of a whole model: morph targets, then the weighted sum of its matrices.
layout(local_size_x = 64) in;

struct Vertex {
  vec4 position_u;
  vec4 normal_v;
};
struct PaletteEntry {
  vec4 row[3];
  vec4 emphasis;
};
struct Deformed {
  vec4 position_emphasis;
  vec4 normal;
};

layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
// influence begin, influence end, mesh, source vertex
layout(std430, binding = 1) readonly buffer Bindings { uvec4 bindings[]; };
// palette entry, bits of the weight
layout(std430, binding = 2) readonly buffer Influences { uvec2 influences[]; };
layout(std430, binding = 3) readonly buffer Palette { PaletteEntry palette[]; };
layout(std430, binding = 4) readonly buffer MeshMorphs { uvec2 mesh_morphs[]; };
layout(std430, binding = 5) readonly buffer ActiveMorphs { uvec2 active_morphs[]; };
layout(std430, binding = 6) readonly buffer MorphOffsets { float morph_offsets[]; };
layout(std430, binding = 7) writeonly buffer Output { Deformed deformed[]; };

layout(location = 0) uniform uint vertex_count;

void main() {
  uint v = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u +
           gl_LocalInvocationID.x;
  if (v >= vertex_count) return;
  uvec4 binding = bindings[v];
  vec3 position = vertices[v].position_u.xyz;
  vec3 normal = vertices[v].normal_v.xyz;

  uvec2 morphs = mesh_morphs[binding.z];
  for (uint m = morphs.x; m < morphs.y; ++m) {
    uint at = 3u * (active_morphs[m].x + binding.w);
    position += uintBitsToFloat(active_morphs[m].y) *
                vec3(morph_offsets[at], morph_offsets[at + 1u], morph_offsets[at + 2u]);
  }

  vec4 row0 = vec4(0.0), row1 = vec4(0.0), row2 = vec4(0.0);
  float emphasis = 0.0;
  for (uint i = binding.x; i < binding.y; ++i) {
    uint entry = influences[i].x;
    float weight = uintBitsToFloat(influences[i].y);
    row0 += weight * palette[entry].row[0];
    row1 += weight * palette[entry].row[1];
    row2 += weight * palette[entry].row[2];
    emphasis += weight * palette[entry].emphasis.x;
  }
  vec4 p = vec4(position, 1.0);
  // Normals go by the cofactor matrix: det · inverse transpose, so non-uniform scale and mirrors
  // come out right, and nothing is divided by a vanishing determinant.
  vec3 c0 = cross(row1.xyz, row2.xyz), c1 = cross(row2.xyz, row0.xyz),
       c2 = cross(row0.xyz, row1.xyz);
  vec3 n = vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
  n *= dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
  // Scaled first: the cofactors of a very small figure are its scale squared.
  float largest = max(max(abs(n.x), abs(n.y)), abs(n.z));
  deformed[v].position_emphasis = vec4(dot(row0, p), dot(row1, p), dot(row2, p), emphasis);
  deformed[v].normal = vec4(largest > 0.0 ? normalize(n / largest) : vec3(0.0, 1.0, 0.0), 0.0);
}
