// SPDX-License-Identifier: MIT
// Which triangle a pixel shows, and its depth.
layout(location = 0) out uvec4 id;
layout(location = 1) uniform uvec2 actor_mesh;  // actor + 1, mesh

void main() { id = uvec4(actor_mesh, uint(gl_PrimitiveID), floatBitsToUint(gl_FragCoord.z)); }
