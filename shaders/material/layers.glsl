// What glTF's material extensions say about a point of a metallic-roughness surface.

// All their textures at the point, 1 where there is none, read in one loop: the code of one lookup stands for all.
struct LayerTexels {
  vec4 texel[kLayerTextures];
  uint present;  // bits
};

// Of the layers that the plan has.
const uint kLayersRead = 3u << kLayerSpecular & (0u - uint(CL_HAS_TOO(specularLayer))) |
                         7u << kLayerClearcoat & (0u - uint(CL_HAS(clearcoat))) |
                         3u << kLayerSheenColor & (0u - uint(CL_HAS(sheen))) |
                         1u << kLayerAnisotropy & (0u - uint(CL_HAS(anisotropy))) |
                         3u << kLayerIridescence & (0u - uint(CL_HAS(iridescence))) |
                         3u << kLayerTransmitted & (0u - uint(CL_HAS(diffuseTransmission))) |
                         1u << kLayerTransmission & (0u - uint(CL_HAS_TOO(transmissionTexture))) |
                         1u << kLayerDiffuseRoughness & (0u - uint(CL_HAS_TOO(diffuseRoughness)));

LayerTexels layerTexels(SurfaceInput at) {
  LayerTexels layers;
  layers.present = 0u;
  for (uint i = 0u; i < kLayerTextures; ++i) layers.texel[i] = vec4(1.0);
#ifndef CL_UNTEXTURED
  if (kLayersRead == 0u) return layers;
  for (uint i = 0u; i < kLayerTextures; ++i) {
    if ((kLayersRead >> i & 1u) == 0u) continue;
    TextureSlot slot = CL_LAYER_SLOT(at.materialId, i);
    if (!hasTexture(slot)) continue;
    layers.texel[i] = textureAt(slot, at);
    layers.present |= 1u << i;
  }
#endif
  return layers;
}

bool hasLayerTexture(LayerTexels layers, uint i) { return (layers.present & 1u << i) != 0u; }

// KHR_materials_specular: F0 = min(F0 of the index times color, 1) times factor, F90 = factor; metals keep theirs.
void setSpecularLayer(MaterialRecord m, LayerTexels layers, float metallic, inout SurfacePoint s) {
  float factor = m.specularFactor * layers.texel[kLayerSpecular].a;
  vec3 tint = m.specularTint * layers.texel[kLayerSpecularTint].rgb;
  s.dielectricColor = min(s.dielectricF0 * tint, vec3(1.0)) * factor;
  s.dielectricF0 = maxComponent(s.dielectricColor);
  s.dielectricF90 = factor;
  s.F90 = factor + (1.0 - factor) * metallic;
}

void setDiffuseTransmission(MaterialRecord m, LayerTexels layers, float share, inout SurfacePoint s) {
  s.diffuseTransmission = m.diffuseTransmission * layers.texel[kLayerTransmitted].a;
  s.diffuseTransmissionColor = m.diffuseTransmissionColor * layers.texel[kLayerTransmittedColor].rgb * share;
}

// Where a mesh has no tangents (and analytic shapes have none) the surface stays isotropic.
void setAnisotropy(MaterialRecord m, LayerTexels layers, SurfaceInput at, vec3 n, inout SurfacePoint s) {
  vec2 direction = m.anisotropyDirection;
  float strength = m.anisotropy;
  if (hasLayerTexture(layers, kLayerAnisotropy)) {
    vec3 texel = layers.texel[kLayerAnisotropy].rgb;
    vec3 unit = safeNormalize(vec3(2.0 * texel.rg - 1.0, 0.0), vec3(1.0, 0.0, 0.0));
    direction = vec2(direction.x * unit.x - direction.y * unit.y, direction.y * unit.x + direction.x * unit.y);
    strength *= texel.b;
  }
  vec3 t = safeNormalize(at.tangent.xyz - n * dot(n, at.tangent.xyz), vec3(0.0));
  vec3 b = cross(n, t) * at.tangent.w;
  s.along = safeNormalize(t * direction.x + b * direction.y, vec3(0.0));
  s.alphaAlong = at.tangent.w != 0.0 && strength > 0.0 ? s.alpha + (1.0 - s.alpha) * strength * strength : 0.0;
}

void setFilm(MaterialRecord m, LayerTexels layers, inout SurfacePoint s) {
  s.iridescence = m.iridescence * layers.texel[kLayerIridescence].r;
  s.filmIndex = m.filmIndex;
  float thick = m.filmThinnest + (m.filmThickest - m.filmThinnest) * layers.texel[kLayerFilmThickness].g;
  s.filmThickness = hasLayerTexture(layers, kLayerFilmThickness) ? thick : m.filmThickest;
}

void setSheen(MaterialRecord m, LayerTexels layers, inout SurfacePoint s) {
  s.sheenColor = m.sheenColor * layers.texel[kLayerSheenColor].rgb;
  s.sheenRoughness = m.sheenRoughness * layers.texel[kLayerSheenRoughness].a;
  // Sharper fibers than this reflect only along the surface.
  float alpha = max(s.sheenRoughness * s.sheenRoughness, kSmallestAlpha);
  s.sheenAlpha = maxComponent(s.sheenColor) > 0.0 ? alpha : 0.0;
}

// The coat lies over the mesh's own normal unless it has a map of its own.
void setCoat(MaterialRecord m, LayerTexels layers, SurfaceInput at, bool flip, inout SurfacePoint s) {
  s.clearcoat = m.clearcoat * layers.texel[kLayerClearcoat].r;
  float roughness = m.clearcoatRoughness * layers.texel[kLayerClearcoatRoughness].g;
  s.coatAlpha = max(roughness * roughness, kSmallestAlpha);
  vec3 n = safeNormalize(at.normal, at.geometricNormal);
  if (hasLayerTexture(layers, kLayerClearcoatNormal) && at.tangent.w != 0.0)
    n = mappedNormal(layers.texel[kLayerClearcoatNormal].xyz, m.clearcoatNormalScale, at, n);
  s.coatNormal = flip ? -n : n;
}

void setLayers(MaterialRecord m, LayerTexels layers, SurfaceInput at, bool flip, inout SurfacePoint s) {
  if (CL_HAS_TOO(diffuseRoughness)) s.diffuseRoughness = m.diffuseRoughness * layers.texel[kLayerDiffuseRoughness].r;
  if (CL_HAS(anisotropy)) setAnisotropy(m, layers, at, flip ? -s.n : s.n, s);
  if (CL_HAS(iridescence)) setFilm(m, layers, s);
  if (CL_HAS(sheen)) setSheen(m, layers, s);
  if (CL_HAS(clearcoat)) setCoat(m, layers, at, flip, s);
}
