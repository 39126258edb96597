// An illumination model integrated over a face: what a point's light multiplies by for a light with an area. Diffuse
// terms are the closed-form irradiance, times the mean of what the model makes of the cosine; glossy ones a quadrature
// in polar coordinates about the mirrored view, where lobes have their peak: exact in the outline, no samples to see.
#ifndef CROSSLIGHT_AREA_LOBE_GLSL
#define CROSSLIGHT_AREA_LOBE_GLSL
#include "light/area_irradiance.glsl"
#include "illum/illumination.glsl"

// Gauss, Legendre: nodes in (0, 1) and weights.
const int kAcross = 8;  // along an edge, and along half an arc
const float kAcrossNodes[8] = {0.019855071751231884, 0.101666761293186630, 0.237233795041835507, 0.408282678752175098,
                               0.591717321247824902, 0.762766204958164493, 0.898333238706813370, 0.980144928248768116};
const float kAcrossWeights[8] = {0.050614268145188130, 0.111190517226687235, 0.156853322938943644, 0.181341891689180991,
                                 0.181341891689180991, 0.156853322938943644, 0.111190517226687235, 0.050614268145188130};
const int kInward = 5;  // from the axis to the outline
const float kInwardNodes[5] = {0.046910077030668004, 0.230765344947158454, 0.5, 0.769234655052841546,
                               0.953089922969331996};
const float kInwardWeights[5] = {0.118463442528094544, 0.239314335249683234, 0.284444444444444444, 0.239314335249683234,
                                 0.118463442528094544};

Lobe noLobe() { return lobeOf(0.0, 0.0); }
// What colors do not multiply but `specular` would, alone: diffuse terms are not taken from here.
Lobe addLobe(Lobe sum, Lobe lobe, float weight) {
  return Lobe(vec3(0.0), sum.specular + weight * lobe.specular, sum.fresnel + weight * lobe.fresnel, vec3(0.0));
}

// How many of the kLobe* there may be: each lies about an axis of its own.
const uint kLobeParts = CL_HAS(sheen) ? 3u : (CL_HAS(clearcoat) ? 2u : 1u);

bool hasLobe(SurfacePoint s, uint part) {
  if (part == kLobeBase) return true;
  if (s.model != kModel_cookTorrance) return false;
  return part == kLobeCoat ? CL_HAS(clearcoat) && s.coatWeight > 0.0 : s.sheenAlpha > 0.0;
}

// About where 1 - cos to the lobe's axis halves the lobe; the sheen's is as wide as the hemisphere.
float lobeWidth(SurfacePoint s, uint part) {
  bool aboutR = s.model == kModel_phong || s.model == kModel_modifiedPhong;
  float width = (aboutR ? 1.5 : 6.0) / (s.shininess + 1.0);
  if (s.model == kModel_cookTorrance1982) width = 2.0 * s.roughnessAngle * s.roughnessAngle;
  if (s.model == kModel_cookTorrance) width = 2.0 * s.alpha * s.alpha;
  if (part == kLobeCoat) width = 2.0 * s.coatAlpha * s.coatAlpha;
  return part == kLobeSheen ? 1.0 : width;
}

struct LobeAxis {
  vec3 r;       // unit, above the horizon
  float width;  // of 1 - cos
};
LobeAxis lobeAxis(SurfacePoint s, vec3 wo, float width) {
  vec3 r = 2.0 * dot(s.n, wo) * s.n - wo;
  float below = dot(s.n, r);
  return LobeAxis(safeNormalize(below < 0.0 ? r - 2.0 * below * s.n : r, s.n), width);
}

struct Step {
  vec3 w;      // unit, on the outline
  float turn;  // what the step adds to the angle about the axis, times sin^2
};

// The lobe on the way from the axis to a step of the outline. With x = 1 - cos, nodes are spread as 1 / (x + width)^2.
Lobe lobeTowards(SurfacePoint s, vec3 wo, LobeAxis axis, Step onto) {
  vec3 d = onto.w - axis.r;
  float end = smaller(0.5 * dot(d, d), 1.999);
  vec3 sideways = safeNormalize(onto.w - (1.0 - end) * axis.r, anyPerpendicular(axis.r));
  float filled = end / (end + axis.width);
  Lobe sum = noLobe();
  for (int j = 0; j < kInward; ++j) {
    float left = 1.0 - filled * kInwardNodes[j];
    float x = axis.width * filled * kInwardNodes[j] / left;
    vec3 wi = (1.0 - x) * axis.r + sqrt(x * (2.0 - x)) * sideways;
    sum = addLobe(sum, evaluateModel(s, wo, wi), kInwardWeights[j] / (left * left));
  }
  return addLobe(noLobe(), sum, onto.turn * axis.width / ((2.0 - end) * (end + axis.width)));
}

// A piece of the outline and how it is stepped along, small steps where it passes the axis: an edge by t = D tan(u), t the
// angle from its nearest point, an arc by tan(step / 2) = k tan(v) about its nearest point.
struct Piece {
  int nodes;     // 0: it is not there
  bool arc;
  float begin;   // of u or v
  float end;
  float spread;  // D or k
  vec3 nearest;  // of an edge: unit; its plane's axes
  vec3 onwards;
  float lift;    // sine of the axis' angle to that plane
  float psi0;    // of an arc
};

Piece edgePiece(LobeAxis axis, FaceEdge e, bool exists) {
  vec3 c = cross(e.from, e.along);
  float sine = length(c);
  float angle = atan(sine, dot(e.from, e.from + e.along));  // undefined where both are zero
  vec3 normal = safeNormalize(c, axis.r);
  vec3 from = safeNormalize(e.from, axis.r);
  Piece p;
  p.arc = false;
  p.lift = dot(normal, axis.r);
  p.nearest = safeNormalize(axis.r - p.lift * normal, from);
  p.onwards = cross(normal, p.nearest);
  float t = atan(dot(from, p.onwards), dot(from, p.nearest));
  float gap = 2.0 * (1.0 - dot(axis.r, p.nearest));
  p.spread = sqrt(greater(gap, 0.0) + 2.0 * axis.width);
  p.begin = atan(t / p.spread);
  p.end = atan((t + angle) / p.spread);
  p.nodes = exists && sine > 0.0 ? kAcross : 0;
  p.psi0 = 0.0;
  return p;
}

// Where on the circle the axis is nearest, about.
float nearestOnCircle(AreaFace f, vec3 r) {
  float along = dot(r, f.axis);
  float reach = dot(f.corner, f.axis);
  bool ahead = along > 0.0 && along * 1e6 > reach;  // else parallel to the circle's plane, or away from it
  vec3 inPlane = ahead ? r * (reach / along) - f.corner : r;
  float u = dot(inPlane, f.edgeU), v = dot(inPlane, f.edgeV);
  return abs(u) + abs(v) > 0.0 ? atan(v, u) : 0.0;
}

// One half of an arc.
Piece arcPiece(LobeAxis axis, AreaFace f, FaceArc arc, bool second) {
  Piece p;
  p.arc = true;
  p.psi0 = nearestOnCircle(f, axis.r);
  vec3 place = onCircle(f, p.psi0);
  vec3 near = safeNormalize(place, axis.r);
  float d = sqrt(greater(2.0 * (1.0 - dot(near, axis.r)), 0.0) + 2.0 * axis.width);
  p.spread = smaller(d * length(place) / f.radius, 1.0);
  // A whole circle begins opposite of the nearest point; an arc lies within half a turn of its middle.
  float h0 = arc.cut ? 0.5 * (arc.begin - p.psi0) : -0.5 * kPi;
  float h1 = arc.cut ? 0.5 * (arc.end - p.psi0) : 0.5 * kPi;
  float turns = h0 < -0.5 * kPi && h1 <= 0.0 ? kPi : (h1 > 0.5 * kPi && h0 >= 0.0 ? -kPi : 0.0);
  h0 += turns;
  h1 += turns;
  float v0 = atan(sin(h0), p.spread * cos(h0));
  float v1 = atan(sin(h1), p.spread * cos(h1));
  p.begin = second ? 0.5 * (v0 + v1) : v0;
  p.end = second ? v1 : 0.5 * (v0 + v1);
  p.nodes = arc.above ? kAcross : 0;
  p.nearest = p.onwards = vec3(0.0);
  p.lift = 0.0;
  return p;
}

Step edgeStep(Piece p, int i) {
  float slope = tan(p.begin + (p.end - p.begin) * kAcrossNodes[i]);
  float t = p.spread * slope;
  float dt = p.spread * (1.0 + slope * slope) * (p.end - p.begin) * kAcrossWeights[i];
  return Step(cos(t) * p.nearest + sin(t) * p.onwards, p.lift * dt);
}
Step arcStep(Piece p, AreaFace f, vec3 r, int i) {
  float v = p.begin + (p.end - p.begin) * kAcrossNodes[i];
  float k = p.spread, cv = cos(v), sv = sin(v);
  float psi = p.psi0 + 2.0 * atan(k * sv, cv);
  float dpsi = 2.0 * k / (cv * cv + k * k * sv * sv) * (p.end - p.begin) * kAcrossWeights[i];
  vec3 place = onCircle(f, psi);
  vec3 along = f.radius * (cos(psi) * f.edgeV - sin(psi) * f.edgeU);
  return Step(safeNormalize(place, r), dot(r, cross(place, along)) / dot(place, place) * dpsi);
}

// A polygon has four edges, a circle's arc two halves; then what closes the outline along the horizon.
Lobe glossyLobe(SurfacePoint s, vec3 wo, LobeAxis axis, AreaFace f) {
  Lobe sum = noLobe();
  FaceArc arc = FaceArc(0.0, 0.0, false, false);
  if (kHasRoundLights) arc = arcAbove(f, s.n);
  vec3 leave = f.circle && arc.cut ? onCircle(f, arc.end) : vec3(0.0);
  vec3 enter = f.circle && arc.cut ? onCircle(f, arc.begin) : vec3(0.0);
  for (int k = 0; k < 5; ++k) {
    ClippedEdge c = clipEdge(faceEdge(f, min(k, 3)), s.n);
    bool straight = !f.circle && k < 4;
    if (straight && c.leaves) leave = c.edge.from + c.edge.along;
    if (straight && c.returns) enter = c.edge.from;
    FaceEdge e = c.edge;
    if (k == 4) e = FaceEdge(leave, enter - leave);
    Piece p = edgePiece(axis, e, k == 4 || (straight && c.above));
    if (kHasRoundLights && f.circle && k < 2) p = arcPiece(axis, f, arc, k == 1);
    for (int i = 0; i < p.nodes; ++i) {
      Step onto = edgeStep(p, i);
      if (kHasRoundLights && p.arc) onto = arcStep(p, f, axis.r, i);
      sum = addLobe(sum, lobeTowards(s, wo, axis, onto), 1.0);
    }
  }
  return sum;
}

// Of 16 places on the face: the model's diffuse terms over the cosine, on the viewer's side and through the surface.
// Where the model is Lambert's the ratio is 1.
const float kMeanNodes[4] = {0.069431844202973712, 0.330009478207571868, 0.669990521792428132, 0.930568155797026288};
const float kMeanWeights[4] = {0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};
struct FacePlace {
  vec3 wi;
  float seen;  // in proportion to the solid angle
};
FacePlace facePlace(AreaFace f, int i) {
  float a = kMeanNodes[i / 4], b = kMeanNodes[i % 4];
  float weight = kMeanWeights[i / 4] * kMeanWeights[i % 4];
  vec3 to = f.corner + a * f.edgeU + b * (f.triangle ? 1.0 - a : 1.0) * f.edgeV;
  if (f.triangle) weight *= 1.0 - a;
  if (f.circle) {  // four angles, of the four rings turned against each other
    float psi = 0.5 * kPi * (float(i % 4) + 0.25 * float(i / 4));
    float ring = f.radius * a;
    to = f.corner + ring * (cos(psi) * f.edgeU + sin(psi) * f.edgeV);
    weight = kMeanWeights[i / 4] * a;
  }
  float d = length(to);
  vec3 wi = to / d;
  return FacePlace(wi, weight * dot(wi, f.axis) / (d * d));
}

struct MeanDiffuse {
  vec3 here;
  vec3 through;
};
MeanDiffuse meanDiffuse(SurfacePoint s, vec3 wo, AreaFace f) {
  MeanDiffuse sum = MeanDiffuse(vec3(0.0), vec3(0.0));
  float above = 0.0, below = 0.0;
  for (int i = 0; i < 16; ++i) {
    FacePlace at = facePlace(f, i);
    Lobe lobe = evaluateModel(s, wo, at.wi);
    float cosine = dot(s.n, at.wi);
    sum.here += at.seen * lobe.diffuse;
    sum.through += at.seen * lobe.transmitted;
    above += at.seen * greater(cosine, 0.0);
    below += at.seen * greater(-cosine, 0.0);
  }
  return MeanDiffuse(above > 0.0 ? sum.here / above : vec3(0.0), below > 0.0 ? sum.through / below : vec3(0.0));
}

// The glossy parts one after the other: a loop, so that the code of the models stands here once. Seen at grazing angles
// a lobe is no longer round about the mirrored view; where the face is far from it the outline's terms then cancel to
// less than nothing.
Lobe glossyLobes(SurfacePoint s, vec3 wo, AreaFace f) {
  Lobe sum = noLobe();
  for (uint k = 0u; k < kLobeParts; ++k) {
    SurfacePoint part = s;
    part.lobes = 1u << k;
    if (!hasLobe(s, part.lobes)) continue;
    if (CL_HAS(clearcoat) && part.lobes == kLobeCoat) part.n = s.coatNormal;
    Lobe found = glossyLobe(part, wo, lobeAxis(part, wo, lobeWidth(s, part.lobes)), f);
    sum.specular += greater(found.specular, 0.0);
    sum.fresnel += greater(found.fresnel, vec3(0.0));
  }
  return sum;
}

const uint kMatteModels = 1u << kModel_lambert | 1u << kModel_orenNayar | 1u << kModel_unlit;
const bool kHasGlossyModels = (specModels & ~kMatteModels) != 0u;

// The integral of the model's lobe over what is above the horizon; times the face's radiance.
Lobe areaLobe(SurfacePoint s, vec3 wo, AreaFace f) {
  bool matte = (1u << s.model & kMatteModels) != 0u;
  bool plainDiffuse = s.model != kModel_cookTorrance && s.model != kModel_orenNayar;
  Lobe sum = noLobe();
  if (kHasGlossyModels && f.shines && !matte) sum = glossyLobes(s, wo, f);
  MeanDiffuse mean = MeanDiffuse(vec3(1.0), vec3(0.0));
  if (!plainDiffuse) mean = meanDiffuse(s, wo, f);
  sum.diffuse = faceIrradiance(f, s.n) * mean.here;
  if (CL_HAS(diffuseTransmission) && s.diffuseTransmission > 0.0) sum.transmitted = faceIrradiance(f, -s.n) * mean.through;
  return sum;
}
#endif
