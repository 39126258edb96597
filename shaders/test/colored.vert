// A position in clip space and a color, passed on.
#version 460
layout(location = 0) in vec4 clipPos;
layout(location = 1) in vec4 vertexColor;
layout(location = 0) out vec4 color;

void main() {
  gl_Position = clipPos;
  color = vertexColor;
}
