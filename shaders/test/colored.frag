// The interpolated color; with kWritesPrimitive its red is the primitive's index.
#version 460
layout(constant_id = 0) const bool kWritesPrimitive = false;
layout(location = 0) in vec4 color;
layout(location = 0) out vec4 target;

void main() { target = kWritesPrimitive ? vec4(float(gl_PrimitiveID), color.gba) : color; }
