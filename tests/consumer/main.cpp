// Loads a scene, draws 16x16 pixels with phong, writes a PNG, and reads it back: consumer SCENE OUT.png
#include <crosslight/crosslight.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const crosslight::Scene scene = crosslight::loadScene(argv[1]);
    crosslight::gpu::Device device = crosslight::gpu::Device::open();
    crosslight::RenderSettings settings;
    settings.method = crosslight::methodOf("phong");
    settings.width = settings.height = 16;
    const crosslight::RenderResult result = crosslight::render(device, scene, settings);
    crosslight::writeImage(argv[2], result.image);
    const crosslight::Image back = crosslight::readImage(argv[2]);
    std::printf("%ux%u %s\n", back.width, back.height, crosslight::nameOf(settings.method));
  } catch (const crosslight::Error& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return static_cast<int>(error.code());
  }
  // An exception of the library must be catchable by its type across the library's border.
  try {
    crosslight::loadScene("there is no such file.gltf");
  } catch (const crosslight::InputError&) {
    return 0;
  }
  return 1;
}
