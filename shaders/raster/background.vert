#version 460
// One triangle over the whole target at depth 0, which is infinitely far or on the far plane.
void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.0, 1.0); }
