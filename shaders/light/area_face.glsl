// A light with an area as a point sees it: a parallelogram, a triangle or a circle (a sphere is seen as the circle where
// its tangents touch it). What it brings without visibility is closed form, the horizon included.
#ifndef CROSSLIGHT_AREA_FACE_GLSL
#define CROSSLIGHT_AREA_FACE_GLSL
#include "math/numeric.glsl"

// The point is the origin, the largest coordinate is 1. edgeU x edgeV, or the circle's axis, points away from the point.
struct AreaFace {
  bool shines;     // the point is on a side that emits, and outside of the light
  bool circle;
  bool triangle;
  vec3 corner;     // a circle's center
  vec3 edgeU;      // of a circle: unit, towards the part of its plane that lies under the point
  vec3 edgeV;      // of a circle: unit
  vec3 axis;       // away from the point; of a circle: unit
  float radius;
};

vec3 anyPerpendicular(vec3 v) {
  vec3 a = abs(v);
  vec3 other = a.x <= a.y && a.x <= a.z ? vec3(1.0, 0.0, 0.0) : (a.y <= a.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
  return safeNormalize(cross(v, other), vec3(1.0, 0.0, 0.0));
}

AreaFace circleFace(vec3 center, vec3 axis, float radius, bool shines) {
  AreaFace f;
  vec3 away = dot(axis, center) < 0.0 ? -axis : axis;
  f.shines = shines;
  f.circle = true;
  f.triangle = false;
  f.corner = center;
  f.axis = away;
  vec3 sideways = safeNormalize(center - away * dot(away, center), anyPerpendicular(away));
  f.edgeU = safeNormalize(sideways - away * dot(away, sideways), anyPerpendicular(away));  // twice is enough
  f.edgeV = cross(away, f.edgeU);
  f.radius = radius;
  return f;
}

// sin^2 = r^2 / d^2 of the cone; the circle lies at cos^2 of the way.
AreaFace sphereFace(vec3 center, float radius) {
  float d = safeLength(center);
  vec3 towards = safeNormalize(center, vec3(0.0, 0.0, 1.0));
  float sine = radius / d;
  float cosine2 = (d - radius) / d * ((d + radius) / d);
  return circleFace(towards * cosine2, towards, sine * sqrt(greater(cosine2, 0.0)), cosine2 > 0.0);
}

// u x v points against the light that is emitted. Nearer to its plane than `inPlane` per axis the point is on the light
// itself, or beside it: rounding must not decide whether a surface that glows lights itself.
AreaFace polygonFace(vec3 corner, vec3 u, vec3 v, bool triangle, bool twoSided, float inPlane) {
  vec3 n = cross(u, v);
  float side = dot(n, corner);
  bool behind = side < 0.0;
  AreaFace f;
  f.shines = (twoSided ? abs(side) : side) > inPlane * dot(abs(n), vec3(1.0));
  f.circle = false;
  f.triangle = triangle;
  f.corner = corner;
  f.edgeU = behind ? v : u;
  f.edgeV = behind ? u : v;
  f.axis = behind ? -n : n;
  f.radius = 0.0;
  return f;
}

// Edges of a polygon in order; a triangle's last has no length.
struct FaceEdge {
  vec3 from;
  vec3 along;
};
FaceEdge faceEdge(AreaFace f, int k) {
  vec3 second = f.corner + f.edgeU;
  vec3 third = f.triangle ? f.corner + f.edgeV : second + f.edgeV;
  vec3 fourth = f.triangle ? f.corner : f.corner + f.edgeV;
  vec3 acrossV = f.triangle ? f.edgeV - f.edgeU : f.edgeV;
  vec3 backU = f.triangle ? -f.edgeV : -f.edgeU;
  vec3 lastV = f.triangle ? vec3(0.0) : -f.edgeV;
  vec3 from = k == 0 ? f.corner : (k == 1 ? second : (k == 2 ? third : fourth));
  vec3 along = k == 0 ? f.edgeU : (k == 1 ? acrossV : (k == 2 ? backU : lastV));
  return FaceEdge(from, along);
}

// The part of an edge above the horizon, and the points where the outline goes below it and comes up again.
struct ClippedEdge {
  FaceEdge edge;
  bool above;    // some of it is
  bool leaves;   // ends on the horizon
  bool returns;  // begins there
};
ClippedEdge clipEdge(FaceEdge e, vec3 n) {
  float ha = dot(n, e.from);
  float hb = dot(n, e.from + e.along);
  bool up = ha > 0.0;
  bool stays = hb > 0.0;
  float t = ha / (ha - hb);
  vec3 at = e.from + e.along * t;
  ClippedEdge c;
  c.above = up || stays;
  c.leaves = up && !stays;
  c.returns = !up && stays;
  c.edge.from = up ? e.from : at;
  c.edge.along = e.along * (up ? (stays ? 1.0 : t) : 1.0 - t);
  return c;
}

// The circle's arc above the horizon, from begin to end in radians around the axis; the whole circle is -pi to pi.
struct FaceArc {
  float begin;
  float end;
  bool above;  // some of it is
  bool cut;    // begins and ends on the horizon
};
vec3 onCircle(AreaFace f, float psi) { return f.corner + f.radius * (cos(psi) * f.edgeU + sin(psi) * f.edgeV); }

FaceArc arcAbove(AreaFace f, vec3 n) {
  float height = dot(n, f.corner);
  float u = dot(n, f.edgeU);
  float v = dot(n, f.edgeV);
  float reach = f.radius * sqrt(u * u + v * v);
  float middle = atan(v, u);
  float wide = atan(sqrt(greater((reach - height) * (reach + height), 0.0)), -height);
  FaceArc arc;
  arc.above = height > -reach;
  arc.cut = arc.above && height < reach;
  arc.begin = arc.cut ? middle - wide : -kPi;
  arc.end = arc.cut ? middle + wide : kPi;
  return arc;
}
#endif
