#include "scenegen/random_lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "scenegen/parts.h"
#include "scenegen/radiance_picture.h"

namespace crosslight::scenegen {
namespace {

using glm::dvec3;

// Around and above, now and then among the things.
dvec3 placeOf(Dice& dice) {
  const dvec3 at = dice.vector(-3.5, 3.5);
  return {at.x, std::abs(at.y) + 0.3, at.z};
}

void addKhr(GltfBuilder& gltf, Json light, const dvec3& at, const dvec3& target) {
  Json node = {{"name", light["name"]}, {"matrix", matrixOf(lookAt(at, target, {0.1, 1.0, 0.3}))}};
  node["extensions"]["KHR_lights_punctual"]["light"] = gltf.addLight(std::move(light));
  gltf.addRoot(std::move(node));
}

Json classicLight(Dice& dice, bool spot) {
  Json classic = {{"diffuse", listOf(dice.vector(0.0, 1.0))}, {"specular", listOf(dice.vector(0.0, 1.0))}};
  if (dice.oneIn(3)) classic["ambient"] = listOf(dice.vector(0.0, 0.3));
  if (dice.oneIn(2)) classic["attenuation"] = Json{dice.pick({0.0, 1.0}), dice.pick({0.0, 0.2}), dice.pick({0.0, 0.1})};
  if (!spot) return classic;
  classic["spotCutoff"] = dice.pick({20.0, 45.0, 90.0});
  classic["spotExponent"] = dice.pick({0.0, 4.0, 128.0});
  return classic;
}

void addPunctual(GltfBuilder& gltf, Dice& dice, const std::string& name) {
  const std::string type = dice.pick<const char*>({"point", "directional", "spot"});
  Json light = khrLight(name, type.c_str(), dice.vector(0.3, 1.0), 1.0);
  light["intensity"] = type == "directional" ? dice.between(0.5, 3.0) : dice.between(5.0, 60.0);
  if (type == "spot") {
    const double outer = dice.pick({0.3, 0.7, 1.5});
    light["spot"] = {{"innerConeAngle", dice.pick({0.0, 0.9}) * outer}, {"outerConeAngle", outer}};
  }
  if (type != "directional" && dice.oneIn(4)) light["range"] = dice.between(2.0, 9.0);
  if (type == "point" && dice.oneIn(4)) {
    light.erase("range");
    light["extensions"]["CROSSLIGHT_lights_area"]["radius"] = dice.between(0.05, 0.5);
  } else if (dice.oneIn(2)) {
    light["extensions"]["CROSSLIGHT_lights_classic"] = classicLight(dice, type == "spot");
  }
  const dvec3 at = placeOf(dice);
  addKhr(gltf, std::move(light), at, dice.vector(-0.5, 0.5));
}

void addArea(GltfBuilder& gltf, Dice& dice, const std::string& name) {
  const bool rectangle = dice.oneIn(2);
  Json light = {{"name", name}, {"type", rectangle ? "rect" : "disk"}};
  light["color"] = listOf(dice.vector(0.3, 1.0));
  light["intensity"] = dice.between(1.0, 8.0);
  light["size"] = dice.between(0.3, 2.0);
  if (rectangle) light["rect"]["aspect"] = dice.pick({0.3, 1.0, 2.5});
  const dvec3 at = placeOf(dice);
  Json node = {{"name", name}, {"matrix", matrixOf(lookAt(at, dice.vector(-0.5, 0.5), {0.1, 1.0, 0.3}))}};
  node["extensions"]["EXT_lights_area"]["light"] = gltf.addLight(std::move(light), "EXT_lights_area");
  gltf.addRoot(std::move(node));
}

Json fogOf(Dice& dice) {
  const std::string mode = dice.pick<const char*>({"linear", "exp", "exp2"});
  Json fog = {{"mode", mode}, {"color", listOf(dice.vector(0.0, 1.0))}};
  if (mode == "linear") {
    fog["start"] = dice.pick({0.0, 3.0});
    fog["end"] = dice.pick({6.0, 12.0});
  } else {
    fog["density"] = dice.pick({0.0, 0.05, 0.4});
  }
  return fog;
}

Json smokeOf(GltfBuilder& gltf, Dice& dice) {
  const std::string shape = dice.pick<const char*>({"everywhere", "box", "sphere"});
  Json smoke;
  smoke["shape"] = shape;
  smoke["center"] = listOf(dice.vector(-1.0, 1.0));
  smoke["size"] = listOf(dice.vector(0.5, 4.0));
  smoke["radius"] = dice.between(0.5, 2.5);
  smoke["absorption"] = listOf(dice.vector(0.0, 0.4));
  smoke["scattering"] = listOf(dice.oneIn(4) ? dvec3(0.0) : dice.vector(0.0, 0.5));
  smoke["anisotropy"] = dice.pick({-0.5, 0.0, 0.8});
  if (shape == "box" && dice.oneIn(2)) {
    std::vector<float> densities;
    for (int i = 0; i < 3 * 4 * 5; ++i) densities.push_back(static_cast<float>(dice.orEnd(0.0, 2.0)));
    smoke["grid"] = {{"cellsX", 3}, {"cellsY", 4}, {"cellsZ", 5}, {"densities", gltf.addScalars(densities)}};
  }
  return smoke;
}

}  // namespace

void addRandomLights(GltfBuilder& gltf, Dice& dice, bool many) {
  const int count = many ? 20 : dice.pick({0, 1, 1, 2, 2, 3});
  for (int i = 0; i < count; ++i) {
    const std::string name = "light " + std::to_string(i);
    dice.oneIn(4) ? addArea(gltf, dice, name) : addPunctual(gltf, dice, name);
  }
}

void addRandomAir(GltfBuilder& gltf, Dice& dice, const std::string& name) {
  Json air;
  air["ambient"] = listOf(dice.oneIn(4) ? dvec3(0.0) : dice.vector(0.0, 0.3));
  air["background"] = listOf(dice.vector(0.0, 0.5));
  if (dice.oneIn(6)) {
    const dvec3 up = dice.vector(0.2, 0.8), down = dice.vector(0.0, 0.3);
    gltf.addFile(name + "_sky.hdr", radiancePicture(16, 8, [&](int x, int y) {
                   return x == 5 && y == 2 ? dvec3(20.0) : y < 4 ? up : down;
                 }));
    air["environment"] = {{"uri", name + "_sky.hdr"}, {"intensity", dice.between(0.2, 1.5)}};
    if (dice.oneIn(2)) air["environment"]["rotation"] = dice.between(-3.0, 3.0);
  }
  if (dice.oneIn(3)) air["fog"] = fogOf(dice);
  if (dice.oneIn(5)) air["smoke"] = smokeOf(gltf, dice);
  gltf.setAtmosphere(std::move(air));
}

}  // namespace crosslight::scenegen
