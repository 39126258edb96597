// Camera rays by their place in the list: nothing of them is stored. Tiles of 8 x 8 pixels, row by row, Morton order
// within: neighbors in the list are neighbors in the picture, so that packets of rays stay together.
#ifndef CROSSLIGHT_CAMERA_GLSL
#define CROSSLIGHT_CAMERA_GLSL

// Every other bit of a Morton index within a tile.
uint everyOther(uint bits) { return (bits & 1u) | ((bits >> 1u) & 2u) | ((bits >> 2u) & 4u); }

layout(set = 0, binding = kBindTileList) uniform usamplerBuffer tileList;

struct CameraPlace {
  uvec2 at;      // pixel within the band
  bool outside;  // of the image: its tile overhangs the edge
};

CameraPlace cameraPlace(uint ray) {
  uint inTiles = pushed.firstInTiles + ray;
  uint tilesAcross = (frame.resolution.x + kTileSize - 1u) / kTileSize;
  uint tile = inTiles / (kTileSize * kTileSize);
  if ((specVariant & kVariantTiles) != 0u) tile = texelFetch(tileList, int(tile)).x;
  uint within = inTiles % (kTileSize * kTileSize);
  uvec2 at = kTileSize * uvec2(tile % tilesAcross, tile / tilesAcross) + uvec2(everyOther(within), everyOther(within >> 1u));
  return CameraPlace(at, ray >= pushed.nodeCount || at.x >= frame.resolution.x || at.y >= pushed.bandRows);
}

uint pixelOf(CameraPlace place) { return place.outside ? kNoPixel : place.at.y * frame.resolution.x + place.at.x; }

// A ray beside the image meets nothing: it ends before it begins.
Ray cameraRay(CameraPlace place) {
  vec2 at = vec2(place.at.x, pushed.firstRow + place.at.y) + frame.sampleOffset;
  vec2 plane = (2.0 * at / vec2(frame.resolution) - 1.0) * vec2(1.0, -1.0) * frame.imagePlaneHalf;
  vec3 across = plane.x * frame.cameraRight + plane.y * frame.cameraUp;
  bool orthographic = frame.orthographic != 0u;
  return Ray(orthographic ? across : vec3(0.0), orthographic ? frame.cameraForward : frame.cameraForward + across,
             frame.zNear, place.outside ? -1.0 : frame.zFar, kNoHit);
}

// The ray of a node with its history: computed for the camera's, fetched for others.
RayRecord recordOf(Ray ray) {
  return RayRecord(ray.origin, ray.tMin, ray.direction, ray.tMax, ray.from, frame.cameraMedium, kRayPrimary, 0u);
}
RayRecord rayOfNode(uint node, CameraPlace place) {
  RayRecord camera = recordOf(cameraRay(place));
  if (!kBranches) return camera;
  RayRecord stored = rayRecordOf(node);
  bool first = pushed.firstNode == 0u;
  stored.origin = first ? camera.origin : stored.origin;
  stored.direction = first ? camera.direction : stored.direction;
  stored.tMin = first ? camera.tMin : stored.tMin;
  stored.tMax = first ? camera.tMax : stored.tMax;
  stored.from = first ? camera.from : stored.from;
  stored.medium = first ? camera.medium : stored.medium;
  stored.kind = first ? camera.kind : stored.kind;
  stored.depth = first ? camera.depth : stored.depth;
  return stored;
}
#endif
