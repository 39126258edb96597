#version 460
// Texels where a light sees nothing: infinitely far.
layout(location = 0) out uint outDistance;

void main() { outDistance = 0x7f800000u; }
