// Irradiance by a face of radiance 1: the integral of max(n.w, 0) over what is seen of it above the horizon.
#ifndef CROSSLIGHT_AREA_IRRADIANCE_GLSL
#define CROSSLIGHT_AREA_IRRADIANCE_GLSL
#include "light/area_face.glsl"

// Lambert 1760, "Photometria": an edge seen under an angle adds half of it along the normal of its plane through the
// point. Rearranged: the angle by atan2 of cross and dot product, and the plane from the edge itself, a x (b - a).
float edgeIrradiance(FaceEdge e, vec3 n) {
  vec3 c = cross(e.from, e.along);
  float sine = length(c);
  float angle = atan(sine, dot(e.from, e.from + e.along));
  return sine > 0.0 ? 0.5 * angle * dot(c, n) / sine : 0.0;
}

float outlineIrradiance(AreaFace f, vec3 n) {
  float sum = 0.0;
  vec3 leave = vec3(0.0);
  vec3 enter = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    ClippedEdge c = clipEdge(faceEdge(f, k), n);
    if (c.above) sum += edgeIrradiance(c.edge, n);
    if (c.leaves) leave = c.edge.from + c.edge.along;
    if (c.returns) enter = c.edge.from;
  }
  return greater(sum + edgeIrradiance(FaceEdge(leave, enter - leave), n), 0.0);
}

// Far from a small polygon the edges' terms cancel; Gauss's rule over its area does not. (Stroud 1971, "Approximate
// Calculation of Multiple Integrals": product rule of degree 5, and T2:5-1 for the triangle.)
const float kGauss3 = 0.774596669241483377;
float pointIrradiance(vec3 to, vec3 n, vec3 area) {
  float d2 = dot(to, to);
  return dot(n, to) * dot(area, to) / (d2 * d2);
}

float parallelogramFar(AreaFace f, vec3 n, vec3 area) {
  float sum = 0.0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      float weight = (i == 0 ? 8.0 : 5.0) * (j == 0 ? 8.0 : 5.0) / 324.0;
      vec3 to = f.corner + (0.5 + 0.5 * kGauss3 * float(i)) * f.edgeU + (0.5 + 0.5 * kGauss3 * float(j)) * f.edgeV;
      sum += weight * pointIrradiance(to, n, area);
    }
  }
  return sum;
}

float triangleFar(AreaFace f, vec3 n, vec3 area) {
  float sum = 0.1125 * pointIrradiance(f.corner + (f.edgeU + f.edgeV) / 3.0, n, area);
  for (int k = 0; k < 6; ++k) {
    bool inner = k < 3;
    float a = inner ? 0.470142064105115 : 0.101286507323456;
    float b = inner ? 0.059715871789770 : 0.797426985353087;
    float weight = inner ? 0.0661970763942531 : 0.0629695902724136;
    int which = inner ? k : k - 3;
    vec3 to = f.corner + (which == 0 ? b : a) * f.edgeU + (which == 1 ? b : a) * f.edgeV;
    sum += weight * pointIrradiance(to, n, area);
  }
  return sum;
}

float polygonIrradiance(AreaFace f, vec3 n) {
  float near = outlineIrradiance(f, n);
  // Rounding of the outline's terms grows as distance over size, the rule's error falls as its sixth power: both are
  // about 2e-6 of the value where the edges are an eighth of the distance.
  vec3 middle = f.corner + 0.5 * (f.edgeU + f.edgeV);
  vec3 sizes = greater(abs(f.edgeU), abs(f.edgeV));
  bool small = 8.0 * maxComponent(sizes) < maxComponent(abs(middle));
  float lowest = dot(n, f.corner) + smaller(dot(n, f.edgeU), 0.0) + smaller(dot(n, f.edgeV), 0.0);
  vec3 area = cross(f.edgeU, f.edgeV);
  float far = f.triangle ? triangleFar(f, n, area) : parallelogramFar(f, n, area);
  return small && lowest > 0.0 ? far : near;
}

// The vector of irradiance of a disk, half the integral of r x dr / |r|^2 around it: with the center q U + h N,
// |r|^2 = A + B cos(psi), A = q^2 + h^2 + R^2, B = 2 R q, and S^2 = A^2 - B^2, all integrals are elementary.
struct DiskTerms {
  float q, h;
  float a, b, s;
  float below;  // sqrt(A - B)
  float above;  // sqrt(A + B)
};
DiskTerms diskTerms(AreaFace f) {
  DiskTerms t;
  t.q = greater(dot(f.corner, f.edgeU), 0.0);
  t.h = greater(dot(f.corner, f.axis), 0.0);
  t.below = sqrt(t.h * t.h + (t.q - f.radius) * (t.q - f.radius));
  t.above = sqrt(t.h * t.h + (t.q + f.radius) * (t.q + f.radius));
  t.a = t.q * t.q + t.h * t.h + f.radius * f.radius;
  t.b = 2.0 * f.radius * t.q;
  t.s = t.below * t.above;
  return t;
}

float wholeDisk(AreaFace f, DiskTerms t, vec3 n) {
  float lean = t.h * t.h + f.radius * f.radius - t.q * t.q;
  float upright = lean > 0.0 ? t.s + lean : 4.0 * t.q * t.q * t.h * t.h / (t.s - lean);
  float along = upright * dot(f.axis, n) + 2.0 * t.h * t.q * dot(f.edgeU, n);
  return t.s > 0.0 ? kPi * (f.radius / t.s) * (f.radius / (t.s + t.a)) * along : 0.0;
}

// Integrals over an arc of 1, cos and sin over (A + B cos psi).
struct ArcIntegrals {
  float one, cosine, sine;
};
// Powers of -B/A cos: 1/32 to the fifth is 3e-8.
ArcIntegrals nearlyConstant(FaceArc arc, DiskTerms t) {
  float x = t.b / t.a;
  float c0 = cos(arc.begin), s0 = sin(arc.begin), c1 = cos(arc.end), s1 = sin(arc.end);
  float lower = arc.end - arc.begin;  // integral of cos^(k-2)
  float current = s1 - s0;            // of cos^(k-1)
  float p0 = 1.0, p1 = 1.0;           // cos^(k-1) at the ends
  float sign = 1.0;
  ArcIntegrals sum = ArcIntegrals(lower, 0.0, 0.0);
  for (int k = 1; k <= 5; ++k) {
    p0 *= c0;
    p1 *= c1;
    float n = float(k);
    sum.cosine += sign * current;
    sum.sine += sign * (p0 - p1) / n;
    sign *= -x;
    sum.one += sign * current;
    float next = (p1 * s1 - p0 * s0 + n * lower) / (n + 1.0);
    lower = current;
    current = next;
  }
  return ArcIntegrals(sum.one / t.a, sum.cosine / t.a, sum.sine / t.a);
}

ArcIntegrals arcIntegrals(FaceArc arc, DiskTerms t) {
  if (32.0 * t.b < t.a) return nearlyConstant(arc, t);
  float u0 = atan(t.below * sin(0.5 * arc.begin), t.above * cos(0.5 * arc.begin));
  float u1 = atan(t.below * sin(0.5 * arc.end), t.above * cos(0.5 * arc.end));
  float one = 2.0 * (u1 - u0) / t.s;
  float f0 = t.a + t.b * cos(arc.begin), f1 = t.a + t.b * cos(arc.end);
  return ArcIntegrals(one, (arc.end - arc.begin - t.a * one) / t.b, -log(f1 / f0) / t.b);
}

float cutDisk(AreaFace f, DiskTerms t, FaceArc arc, vec3 n) {
  ArcIntegrals i = arcIntegrals(arc, t);
  float round = 0.5 * f.radius * ((f.radius * i.one + t.q * i.cosine) * dot(f.axis, n) -
                                  t.h * (i.cosine * dot(f.edgeU, n) + i.sine * dot(f.edgeV, n)));
  vec3 leave = onCircle(f, arc.end);
  return greater(round + edgeIrradiance(FaceEdge(leave, onCircle(f, arc.begin) - leave), n), 0.0);
}

float circleIrradiance(AreaFace f, vec3 n) {
  DiskTerms t = diskTerms(f);
  FaceArc arc = arcAbove(f, n);
  float all = wholeDisk(f, t, n);
  float part = cutDisk(f, t, arc, n);
  return arc.above ? (arc.cut ? part : all) : 0.0;
}

float faceIrradiance(AreaFace f, vec3 n) {
  float round = 0.0, straight = 0.0;
  if (kHasRoundLights) round = circleIrradiance(f, n);
  if (kHasStraightLights) straight = polygonIrradiance(f, n);
  return f.shines ? (f.circle ? round : straight) : 0.0;
}
#endif
