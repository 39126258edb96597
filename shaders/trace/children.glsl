// Which rays follow a hit, with which weight: at most one mirrored and one transmitted.
#ifndef CROSSLIGHT_CHILDREN_GLSL
#define CROSSLIGHT_CHILDREN_GLSL

// A ray that is to follow, if its weight says so.
struct NewRay {
  vec3 direction;
  vec3 weight;
  uint kind;
  uint medium;
  float travelled;  // RayNode has it
  uvec4 media;      // with nestedMedia
  float path;       // RayNode has it
};

bool carriesLight(vec3 weight) { return any(greaterThan(weight, vec3(0.0))); }

// Nodes for the rays of all lanes with one atomic per counter: three counts of up to ten bits travel in one word.
// Returns this lane's first node.
uint allocateNodes(bool reflects, uint transmitted, bool bends) {
  uint wanted = (reflects ? 1u | 1u << 10u : 0u) + transmitted * (bends ? 1u | 1u << 20u : 1u);
  uint before = subgroupExclusiveAdd(wanted);
  uint all = subgroupAdd(wanted);
  uint count = all & 1023u, reflected = (all >> 10u) & 1023u, refracted = all >> 20u;
  uint first = 0u;
  if (subgroupElect() && count > 0u) {
    first = atomicAdd(counters[kCounterRayNodes], count);
    if (reflected > 0u) atomicAdd(counters[kCounterReflection], reflected);
    if (refracted > 0u) atomicAdd(counters[kCounterRefraction], refracted);
    if (count > reflected + refracted) atomicAdd(counters[kCounterPassThrough], count - reflected - refracted);
  }
  return subgroupBroadcastFirst(first) + (before & 1023u);
}

// kNoRayNode when the store is full (counted: the host starts again with fewer pixels).
uint storeRay(uint slot, RayRecord parent, HitSurface h, NewRay ray) {
  if (slot >= pushed.nodeCapacity) {
    atomicAdd(counters[kCounterOverflow], 1u);
    return kNoRayNode;
  }
  rays[slot] = RayRecord(leaveSurface(h, ray.direction), 0.0, ray.direction, kLargest, h.slot, ray.medium, ray.kind,
                         parent.depth + 1u);
  nodes[slot].weight = ray.weight;
  if (CL_HAS(fog)) nodes[slot].travelled = ray.travelled;
  if (CL_HAS(mipmaps)) nodes[slot].path = ray.path;
  if (CL_HAS(nestedMedia)) mediaOfNodes[slot] = ray.media;
  return slot;
}

Children addRays(RayRecord parent, HitSurface h, NewRay mirrored, NewRay onward) {
  bool reflects = carriesLight(mirrored.weight), transmits = carriesLight(onward.weight);
  uint first = allocateNodes(reflects, transmits ? 1u : 0u, onward.kind == kRayRefraction);
  Children children = Children(kNoRayNode, kNoRayNode, 1u);
  if (reflects) children.reflected = storeRay(first, parent, h, mirrored);
  if (transmits) children.transmitted = storeRay(first + (reflects ? 1u : 0u), parent, h, onward);
  return children;
}

// One ray for every channel that goes on.
Children addDispersedRays(RayRecord parent, HitSurface h, NewRay mirrored, NewRay onward, Dispersed dispersed) {
  bool reflects = carriesLight(mirrored.weight);
  uint count = 0u;
  for (int c = 0; c < 3; ++c) count += onward.weight[c] > 0.0 ? 1u : 0u;
  uint next = allocateNodes(reflects, count, true);
  Children children = Children(kNoRayNode, kNoRayNode, count);
  if (reflects) children.reflected = storeRay(next++, parent, h, mirrored);
  for (int c = 0; c < 3; ++c) {
    if (!(onward.weight[c] > 0.0)) continue;
    NewRay one = onward;
    one.weight = onlyChannel(onward.weight, c);
    one.direction = dispersed.direction[c];
    uint node = storeRay(next++, parent, h, one);
    if (children.transmitted == kNoRayNode) children.transmitted = node;
  }
  return children;
}

// `path`: length of the light's way from the camera to the hit. `passed` is set to the share of the ray that goes straight
// on: its fog is counted farther on.
Children spawnChildren(RayRecord ray, HitSurface h, SurfacePoint s, SegmentFog fog, float path, SurfaceMedia media,
                       out vec3 passed) {
  passed = vec3(0.0);
  if (ray.depth >= pushed.maxDepth) return Children(kNoRayNode, kNoRayNode, 1u);
  MaterialRecord m = materialOf(h.at.materialId);
  vec3 d = safeNormalize(ray.direction, vec3(0.0, 0.0, 1.0));
  bool fromOutside = h.at.frontFacing;
  vec3 ng = fromOutside ? h.at.geometricNormal : -h.at.geometricNormal;
  vec3 outward = safeNormalize(h.at.normal, h.at.geometricNormal);
  vec3 n = fromOutside == (dot(outward, h.at.geometricNormal) > 0.0) ? outward : -outward;
  n = dot(s.n, ng) > 0.0 ? s.n : n;  // the mapped normal where it is on the ray's side
  float cosI = clamp(-dot(d, n), 0.0, 1.0);

  bool classic = s.model != kModel_cookTorrance;
  bool bends = CL_HAS(refraction) && (m.flags & kMaterialRefracts) != 0u;
  bool thin = (m.flags & kMaterialThin) != 0u;
  float ior = max(m.indexOfRefraction, 1.0);
  float eta = thin || fromOutside ? 1.0 / ior : ior;
  if (CL_HAS(nestedMedia) && media.bounds) eta = iorOfMedium(media.at.before) / iorOfMedium(media.at.beyond);
  float F = fresnelDielectric(cosI, eta);
  vec3 refracted;
  bool passes = refractRay(d, n, eta, refracted);

  vec3 mirrorWeight = vec3(0.0);
  if (CL_HAS(reflection) && (m.flags & kMaterialMirror) != 0u) {
    mirrorWeight = mirrorShare(m, s, cosI);
  }
  vec3 throughWeight = CL_HAS(transparency) || bends ? (classic ? vec3(m.transmission) : s.transmissionColor) : vec3(0.0);
  if (!classic) throughWeight *= s.opacity;  // glass passes light where it covers
  bool inOpacity = classic && m.transmission > 0.0;
  bool blends = (m.flags & kMaterialAlphaBlend) != 0u;
  float behind = CL_HAS(transparency) && (blends || !inOpacity) ? 1.0 - s.opacity - (inOpacity ? m.transmission : 0.0) : 0.0;
  if (bends && !classic) {
    vec3 reflected = vec3(F);
    if (CL_HAS_TOO(specularLayer) && (m.flags & kMaterialSpecularLayer) != 0u) {
      float f0 = (ior - 1.0) * (ior - 1.0) / ((ior + 1.0) * (ior + 1.0));
      float weight = clamp((F - f0) / (1.0 - f0), 0.0, 1.0);
      reflected = s.dielectricColor + (s.dielectricF90 - s.dielectricColor) * weight;
      F = maxComponent(reflected);
    }
    mirrorWeight = CL_HAS(reflection) ? reflected : vec3(0.0);
    throughWeight *= 1.0 - F;
    if (CL_HAS(clearcoat) && CL_HAS(reflection)) mirrorWeight = mirroredWithCoat(m, s, mirrorWeight);
  }
  Dispersed dispersed;
  dispersed.spreads = false;
  if (CL_HAS(dispersion) && (frame.optics & kOpticsDispersion) != 0u && bends && !thin) {
    vec3 here = fromOutside ? vec3(1.0) : spread(ior, bodyOf(h.at.materialId).z);
    vec3 beyond = fromOutside ? spread(ior, bodyOf(h.at.materialId).z) : vec3(1.0);
    if (CL_HAS(nestedMedia) && media.bounds) {
      here = iorsOf(media.at.before);
      beyond = iorsOf(media.at.beyond);
    }
    dispersed = disperse(d, n, cosI, here / beyond);
  }
  vec3 onward = bends && !thin && passes ? refracted : d;
  if (bends && !thin && !passes) {  // total internal reflection takes what would have passed
    mirrorWeight = classic ? mirrorWeight + throughWeight : mirrorWeight;
    throughWeight = vec3(0.0);
  }
  if (CL_HAS(dispersion) && dispersed.spreads) {
    vec3 through = classic ? vec3(m.transmission) : s.transmissionColor * s.opacity;
    mirrorWeight = classic ? m.mirror * vec3(CL_HAS(reflection)) : dispersed.reflected * vec3(CL_HAS(reflection));
    if (classic) mirrorWeight += through * vec3(equal(dispersed.passes, vec3(0.0)));
    throughWeight = through * (classic ? vec3(notEqual(dispersed.passes, vec3(0.0))) : dispersed.passes);
  }
  throughWeight += vec3(behind);
  uint inside = fromOutside && (m.flags & kMaterialVolume) != 0u ? h.at.materialId : kNoRayNode;
  bool bent = bends && !thin;
  if (CL_HAS(nestedMedia)) {
    if (media.bounds) inside = media.at.beyond;
    if (isHidden(media)) {
      onward = d;
      throughWeight = vec3(1.0);
      mirrorWeight = vec3(0.0);
    }
    mirrorWeight *= media.cameraRayKept;
    throughWeight *= media.cameraRayKept;
  }
  if (CL_HAS(fog)) {
    mirrorWeight *= fog.fog.clear;
    if (bent) throughWeight *= fog.fog.clear;
    else passed = throughWeight;
  }
  bool bothSides = bent || (nestsMedia() && ray.medium != kNoRayNode);  // a body is met from inside
  uint straightOn = isSeenDirectly(ray.kind) ? kRayPassThrough : kRayOnward;
  NewRay through = NewRay(onward, throughWeight, bothSides ? kRayRefraction : straightOn, bent ? inside : ray.medium,
                          bent ? 0.0 : fog.distance, bent && media.bounds ? media.at.media : media.here, path);
  NewRay mirrored = NewRay(mirrorRay(d, n, ng), mirrorWeight, kRayReflection, ray.medium, 0.0, media.here, path);
  if (CL_HAS(dispersion) && (frame.optics & kOpticsDispersion) != 0u) {
    vec3 channels = channelsOf(ray, pushed.firstNode + shaded_);
    mirrored.weight *= channels;
    through.weight *= channels;
    passed *= channels;
    if (dispersed.spreads && !isHidden(media)) return addDispersedRays(ray, h, mirrored, through, dispersed);
  }
  return addRays(ray, h, mirrored, through);
}
#endif
