// SPDX-License-Identifier: MIT
// Into the shadow map.
layout(location = 0) in vec4 position_emphasis;
layout(location = 0) uniform mat4 clip_from_world;

void main() { gl_Position = clip_from_world * vec4(position_emphasis.xyz, 1.0); }
