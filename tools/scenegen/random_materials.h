// Materials with random subsets of all that a material may have, and the textures that they use.
#pragma once

#include <vector>

#include "scenegen/dice.h"
#include "scenegen/gltf_builder.h"

namespace crosslight::scenegen {

class RandomMaterials {
 public:
  // Adds a few textures to the file.
  RandomMaterials(GltfBuilder& gltf, Dice& dice);
  // Adds a material; the answer is its index. `mayMove`: by a displacement texture.
  int add(bool mayMove);

 private:
  Json metallicRoughness();
  Json classic();
  void addTransmission(Json& material);
  void addLayers(Json& extensions);
  void addMaps(Json& material);
  Json color(double low, double high);
  Json texture();
  Json normalTexture();
  void maybeTexture(Json& owner, const char* key, int oneIn);

  GltfBuilder& gltf_;
  Dice& dice_;
  std::vector<int> pictures_;
  int normals_ = 0, heights_ = 0;
  int count_ = 0;
};

}  // namespace crosslight::scenegen
