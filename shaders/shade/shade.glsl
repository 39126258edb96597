// Illumination at one point: lights times model. Raster and rays call these same functions; whoever includes this
// defines lightVisibility() (1 in raster without shadows, the shadow rays' answer in the ray tracer).
#ifndef CROSSLIGHT_SHADE_GLSL
#define CROSSLIGHT_SHADE_GLSL
#include "material/surface.glsl"
#include "light/light.glsl"
#include "illum/illumination.glsl"
#include "shade/area_lobe.glsl"
#include "shade/seen.glsl"

// As CL_MATERIAL in surface.glsl.
#ifndef CL_LIGHT
#define CL_LIGHT(index) lightOf(index)
#endif

float lightVisibility(uint lightIndex);

// How much of the environment arrives; the argument is the number of lights in the batch.
#ifndef CL_ENVIRONMENT_VISIBILITY
#define CL_ENVIRONMENT_VISIBILITY(lightCount) vec3(1.0)
#endif

// What all lights of a batch bring to a point, before the surface's colors.
struct LightSums {
  vec3 ambient;   // the lights' own ambient intensities, attenuated
  vec3 diffuse;
  vec3 specular;
  vec3 fresnel;  // and whatever else no color of the surface multiplies
};

struct ShadedParts {
  vec3 ambient;
  vec3 diffuse;
  vec3 specular;
  vec3 emission;
};

#include "shade/environment.glsl"

// One light whose falloff is 1.
LightSums lobeSums(LightRecord light, Lobe lobe) {
  return LightSums(vec3(0.0), light.diffuse * lobe.diffuse, light.specular * lobe.specular, light.specular * lobe.fresnel);
}

void addEnvironment(SurfacePoint s, vec3 wo, vec3 visible, inout LightSums sums) {
  LightSums all = environmentSums(s, wo);
  sums.diffuse += visible * all.diffuse;
  sums.specular += visible * all.specular;
  sums.fresnel += visible * all.fresnel;
}

LightSums illuminate(SurfacePoint s, vec3 wo, uint firstLight, uint lightCount) {
  LightSums sums = LightSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  if (specLights == 0u && !CL_HAS(environment)) return sums;
  for (uint i = 0u; i < lightCount; ++i) {
    LightRecord light = CL_LIGHT(firstLight + i);
    LightSample at = sampleLight(light, s.position);
    float visible = lightVisibility(i) * at.falloff;
    Lobe lobe = evaluateModel(s, wo, at.wi);
    if (isAreaLight(light)) lobe = areaLobe(s, wo, faceOf(light, s.position));
    sums.ambient += light.ambient * at.falloff;
    sums.diffuse += light.diffuse * (visible * lobe.diffuse);
    sums.specular += light.specular * (visible * lobe.specular);
    sums.fresnel += light.specular * (visible * lobe.fresnel);
    if (CL_HAS(diffuseTransmission)) sums.fresnel += light.diffuse * (visible * lobe.transmitted);
  }
#ifndef CL_LIGHTS_ONLY
  if (hasEnvironment() && firstLight == 0u) addEnvironment(s, wo, CL_ENVIRONMENT_VISIBILITY(lightCount), sums);
#endif
  return sums;
}

ShadedParts compose(SurfacePoint s, LightSums sums, vec3 sceneAmbient) {
  ShadedParts parts;
  parts.ambient = s.ambientColor * (sceneAmbient + sums.ambient);
  parts.diffuse = s.diffuseColor * sums.diffuse;
  parts.specular = s.specularColor * sums.specular + sums.fresnel;
  parts.emission = s.emission;
  return parts;
}

vec3 sumOf(ShadedParts parts) { return parts.ambient + parts.diffuse + parts.specular + parts.emission; }

// Unit vector towards the viewer: the camera stands at the render space's origin. OpenGL's infinite viewer looks from
// the same side at every point; an orthographic camera does anyway.
vec3 viewDirection(vec3 renderPos) {
  bool fixedViewer = (frame.infiniteViewer | frame.orthographic) != 0u;
  vec3 ahead = -frame.cameraForward;
  vec3 towards = safeNormalize(-renderPos, ahead);
  return mix(towards, ahead, bvec3(fixedViewer));  // chosen, not branched on: see raster/draw.glsl
}
#endif
