// The illumination models in double, each as its publication prints it: with angles, tangents and powers where the
// shaders avoid them. Light of unit intensity, cosine included.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/scene.h"

namespace crosslight::testing::twin {

using glm::dvec3;
inline constexpr double kPi = std::numbers::pi;
inline const dvec3 kNormal(0, 0, 1);

struct Directions {
  dvec3 wo, wi, h;
  double NoL, NoV, NoH, VoH;
  Directions(const glm::vec3& o, const glm::vec3& i) : wo(o), wi(i), h(glm::normalize(wo + wi)) {
    NoL = wi.z, NoV = wo.z, NoH = h.z, VoH = glm::dot(wo, h);
  }
};

inline double schlick(double c) { return std::pow(1.0 - std::clamp(c, 0.0, 1.0), 5.0); }

// By Snell's law and the amplitudes of both polarisations.
inline double dielectric(double c, double n) {
  const double t = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
  const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return 0.5 * (s * s + p * p);
}

// The same with a complex index.
inline double metal(double c, double n, double k) {
  const double s2 = 1 - c * c, a2 = n * n - k * k - s2;
  const double root = std::sqrt(a2 * a2 + 4 * n * n * k * k);
  const double p = std::sqrt(0.5 * (root + a2)), q2 = 0.5 * (root - a2);
  const double rs = ((p - c) * (p - c) + q2) / ((p + c) * (p + c) + q2);
  const double t = s2 / c;  // sin tan
  const double rp = rs * ((p - t) * (p - t) + q2) / ((p + t) * (p + t) + q2);
  return 0.5 * (rs + rp);
}

// Cook and Torrance's rise from F0 to 1.
inline double exactRise(double c, double F0) {
  const double n = (1 + std::sqrt(F0)) / (1 - std::sqrt(F0));
  return std::max(0.0, (dielectric(c, n) - F0) / (1 - F0));
}

inline double modifiedPhong(const Directions& d, double n) {
  if (d.NoL <= 0) return 0;
  const dvec3 r = 2 * d.NoL * kNormal - d.wi;
  return kPi * (n + 2) / (2 * kPi) * std::pow(std::max(0.0, glm::dot(r, d.wo)), n) * d.NoL;
}

inline double orenNayar(const Directions& d, double sigma) {
  if (d.NoL <= 0) return 0;
  const double ti = std::acos(d.NoL), to = std::acos(d.NoV);
  const double phi = std::atan2(d.wi.y, d.wi.x) - std::atan2(d.wo.y, d.wo.x);
  const double A = 1 - 0.5 * sigma * sigma / (sigma * sigma + 0.33), B = 0.45 * sigma * sigma / (sigma * sigma + 0.09);
  return d.NoL * (A + B * std::max(0.0, std::cos(phi)) * std::sin(std::max(ti, to)) * std::tan(std::min(ti, to)));
}

// Without F: pi D G / (pi N.V).
inline double facets1982(const Directions& d, double m) {
  if (d.NoL <= 0) return 0;
  const double alpha = std::acos(std::min(d.NoH, 1.0));
  const double D = std::exp(-std::pow(std::tan(alpha) / m, 2)) / (m * m * std::pow(std::cos(alpha), 4));
  const double G = std::min({1.0, 2 * d.NoH * d.NoV / d.VoH, 2 * d.NoH * d.NoL / d.VoH});
  return kPi * (D * G / (kPi * d.NoL * d.NoV)) * d.NoL;
}

// glTF 2.0, B.3: D and V of GGX with N.L.
inline double ggx(const Directions& d, double alpha) {
  if (d.NoL <= 0) return 0;
  const double a2 = alpha * alpha;
  const double D = a2 / (kPi * std::pow(d.NoH * d.NoH * (a2 - 1) + 1, 2));
  const double V =
      0.5 / (d.NoL * std::sqrt(d.NoV * d.NoV * (1 - a2) + a2) + d.NoV * std::sqrt(d.NoL * d.NoL * (1 - a2) + a2));
  return D * V * d.NoL;
}

// KHR_materials_anisotropy's implementation notes.
inline double ggxAnisotropic(const Directions& d, double at, double ab, const dvec3& t) {
  if (d.NoL <= 0) return 0;
  const dvec3 b = glm::cross(kNormal, t);
  const double a2 = at * ab;
  const dvec3 f(ab * glm::dot(t, d.h), at * glm::dot(b, d.h), a2 * d.NoH);
  const double w2 = a2 / glm::dot(f, f);
  const double lv = d.NoL * glm::length(dvec3(at * glm::dot(t, d.wo), ab * glm::dot(b, d.wo), d.NoV));
  const double ll = d.NoV * glm::length(dvec3(at * glm::dot(t, d.wi), ab * glm::dot(b, d.wi), d.NoL));
  return a2 * w2 * w2 / kPi * 0.5 / (lv + ll) * d.NoL;
}

// Portsmouth, Kutz, Hill 2024; the exact albedo (their Eq. 12) by the fit that they print.
inline double fon(double mu, double r) {
  const double x = 1 - mu;
  const double g =
      0.0571085289 * x + 0.491881867 * x * x - 0.332181442 * std::pow(x, 3) + 0.0714429953 * std::pow(x, 4);
  return (1 + r * g) / (1 + (0.5 - 2 / (3 * kPi)) * r);
}
inline double eon(const Directions& d, double rho, double r) {
  if (d.NoL <= 0) return 0;
  const double s = glm::dot(d.wi, d.wo) - d.NoL * d.NoV;
  const double t = s > 0 ? std::max(d.NoL, d.NoV) : 1;
  const double A = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
  const double single = rho / kPi * A * (1 + r * s / t);
  const double mean = A * (1 + r * (2.0 / 3 - 28 / (15 * kPi)));
  const double ms = rho * rho * mean / (1 - rho * (1 - mean)) / kPi;
  return (single + ms * (1 - fon(d.NoV, r)) * (1 - fon(d.NoL, r)) / (1 - mean)) * d.NoL;
}

// Estevez, Kulla 2017.
inline double charlie(const Directions& d, double alpha) {
  if (d.NoL <= 0) return 0;
  const auto mix = [&](double a, double b) {
    const double t = (1 - alpha) * (1 - alpha);
    return a * (1 - t) + b * t;
  };
  const auto l = [&](double x) {
    return mix(21.5473, 25.3245) / (1 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
           mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
  };
  const auto lambda = [&](double c) { return c < 0.5 ? std::exp(l(c)) : std::exp(2 * l(0.5) - l(1 - c)); };
  const double D = (2 + 1 / alpha) * std::pow(std::sqrt(1 - d.NoH * d.NoH), 1 / alpha) / (2 * kPi);
  return D / (1 + lambda(d.NoV) + lambda(d.NoL)) / (4 * d.NoV);
}

// KHR_materials_iridescence; interference in three rounds as the extension has it, one channel at a time.
inline dvec3 film(const dvec3& F0, double eta, double thickness, double c1) {
  const double c2 = std::sqrt(1 - (1 - c1 * c1) / (eta * eta));
  const auto normal = [](double a, double b) { return std::pow((a - b) / (a + b), 2); };
  const double R0 = normal(eta, 1), R12 = R0 + (1 - R0) * schlick(c1), T = 1 - R12;
  dvec3 C0(0), Cm(0), r(0), shift(0);
  for (int i = 0; i < 3; ++i) {
    const double q = std::sqrt(std::min(F0[i] + 1e-4, 0.9999)), base = (1 + q) / (1 - q);
    const double R1 = normal(base, eta), R23 = R1 + (1 - R1) * schlick(c2);
    const double R = std::clamp(R12 * R23, 1e-5, 0.9999), Rs = T * T * R23 / (1 - R);
    C0[i] = R12 + Rs, Cm[i] = Rs - T, r[i] = std::sqrt(R), shift[i] = kPi + (base < eta ? kPi : 0);
  }
  dvec3 I = C0;
  for (int m = 1; m <= 2; ++m) {
    const double phase = 2 * kPi * m * (2 * eta * thickness * c2) * 1e-9;
    const auto gauss = [&](double value, double position, double variance, double s) {
      return value * std::sqrt(2 * kPi * variance) * std::cos(position * phase + m * s) *
             std::exp(-variance * phase * phase);
    };
    const dvec3 xyz =
        dvec3(gauss(5.4856e-13, 1.6810e6, 4.3278e9, shift.x) + gauss(9.7470e-14, 2.2399e6, 4.5282e9, shift.x),
              gauss(4.4201e-13, 1.7953e6, 9.3046e9, shift.y), gauss(5.2481e-13, 2.2084e6, 6.6121e9, shift.z)) /
        1.0685e-7;
    Cm *= r;
    I += Cm * 2.0 *
         dvec3(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
               -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
               0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
  }
  return glm::max(I, dvec3(0));
}

}  // namespace crosslight::testing::twin
