// The bits of the color's first channel, into a target of integers.
#version 460
layout(location = 0) in vec4 color;
layout(location = 0) out uint target;

void main() { target = floatBitsToUint(color.r); }
