#include "upload/environment_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <glm/geometric.hpp>
#include <numbers>
#include <thread>

namespace crosslight {

using namespace shared;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = kEnvironmentWidth, kHeight = kEnvironmentHeight;
constexpr std::uint32_t kLobeSamples = 128;   // of each prefiltered texel, from maps of their own size
constexpr std::uint32_t kTableSamples = 512;  // of each entry of the table
constexpr double kSmallestAlpha = 1e-3;       // as shaders/material/surface.glsl has it

using Rgb = glm::dvec3;

struct Grid {
  int width = 0, height = 0;
  std::vector<Rgb> texels;
  const Rgb& at(int x, int y) const {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

double rowSolidAngle(int width, int height, int row) {
  // cos(a) - cos(b) by their half sum and half difference
  const double middle = kPi * (row + 0.5) / height, half = 0.5 * kPi / height;
  return 2.0 * kPi / width * 2.0 * std::sin(middle) * std::sin(half);
}

// The least radiance of each channel: what is above it is convolved, so that a constant environment stays exact.
Rgb floorOf(const EnvironmentMap& map) {
  Rgb least(map.radiance.front());
  for (const glm::vec3& v : map.radiance) least = glm::min(least, Rgb(v));
  return least;
}

Grid above(const EnvironmentMap& map, const Rgb& least) {
  Grid grid{static_cast<int>(map.width), static_cast<int>(map.height), {}};
  grid.texels.reserve(map.radiance.size());
  for (const glm::vec3& v : map.radiance) grid.texels.push_back(Rgb(v) - least);
  return grid;
}

// Half as large each way, weighted by solid angle.
Grid halved(const Grid& g) {
  Grid half{std::max(1, g.width / 2), std::max(1, g.height / 2), {}};
  for (int y = 0; y < half.height; ++y) {
    const int y0 = y * g.height / half.height, y1 = (y + 1) * g.height / half.height;
    for (int x = 0; x < half.width; ++x) {
      const int x0 = x * g.width / half.width, x1 = (x + 1) * g.width / half.width;
      Rgb sum(0.0);
      double weights = 0;
      for (int v = y0; v < y1; ++v) {
        const double weight = rowSolidAngle(g.width, g.height, v);
        for (int u = x0; u < x1; ++u) sum += weight * g.at(u, v);
        weights += weight * (x1 - x0);
      }
      half.texels.push_back(sum / weights);
    }
  }
  return half;
}

// u and v in [0,1], as of EnvironmentMap; u may lie outside, v not. Rows end at the poles, columns go round.
Rgb bilinear(const Grid& g, double u, double v) {
  const double x = u * g.width - 0.5, y = v * g.height - 0.5;
  const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int x0 = (static_cast<int>(left) % g.width + g.width) % g.width, x1 = x0 + 1 == g.width ? 0 : x0 + 1;
  const int y0 = std::max(static_cast<int>(top), 0), y1 = std::min(static_cast<int>(top) + 1, g.height - 1);
  return (1 - fy) * ((1 - fx) * g.at(x0, y0) + fx * g.at(x1, y0)) + fy * ((1 - fx) * g.at(x0, y1) + fx * g.at(x1, y1));
}

// Rows of a picture in threads.
void forRows(int rows, const std::function<void(int)>& work) {
  const int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  std::vector<std::future<void>> running;
  for (int t = 0; t < threads; ++t) {
    running.push_back(std::async(std::launch::async, [=] {
      for (int row = t; row < rows; row += threads) work(row);
    }));
  }
  for (auto& thread : running) thread.get();
}

// What a cell of the map sends, as vectors: a normal that sees all of the cell receives exactly their part along it.
struct Cell {
  glm::dvec3 red{0.0}, green{0.0}, blue{0.0};
};
std::vector<Cell> cellsOf(const Grid& g) {
  const int columns = std::min(g.width, kWidth), rows = std::min(g.height, kHeight);
  std::vector<Cell> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      const int column = static_cast<int>(std::int64_t{x} * columns / g.width);
      const int row = static_cast<int>(std::int64_t{y} * rows / g.height);
      Cell& cell =
          cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
      const glm::dvec3 d =
          rowSolidAngle(g.width, g.height, y) * environmentDirection((x + 0.5) / g.width, (y + 0.5) / g.height);
      const Rgb& c = g.at(x, y);
      cell.red += c.r * d;
      cell.green += c.g * d;
      cell.blue += c.b * d;
    }
  }
  std::erase_if(cells, [](const Cell& c) { return c.red + c.green + c.blue == glm::dvec3(0.0); });
  return cells;
}

glm::vec4 texel(const Rgb& color) { return glm::vec4(glm::vec3(color), 0.0f); }

void addIrradiance(const Grid& g, const Rgb& least, glm::vec4* out) {
  const std::vector<Cell> cells = cellsOf(g);
  forRows(kHeight, [&](int y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 n = environmentDirection((x + 0.5) / kWidth, (y + 0.5) / kHeight);
      Rgb sum(0.0);
      for (const Cell& c : cells) {
        sum += glm::max(Rgb(glm::dot(n, c.red), glm::dot(n, c.green), glm::dot(n, c.blue)), Rgb(0.0));
      }
      out[y * kWidth + x] = texel(least + sum / kPi);
    }
  });
}

// Hammersley's points: van der Corput's in base 2 beside equal steps.
glm::dvec2 hammersley(std::uint32_t i, std::uint32_t count) {
  std::uint32_t bits = i;
  double radical = 0, digit = 0.5;
  for (; bits != 0; bits >>= 1u, digit *= 0.5) radical += digit * (bits & 1u);
  return {(i + 0.5) / count, radical + 0.5 / count};
}

// Half vector of the GGX distribution about +Z (Walter et al. 2007, Eq. 35 and 36).
glm::dvec3 halfVector(const glm::dvec2& u, double alpha) {
  const double tangent2 = alpha * alpha * u.x / (1.0 - u.x);
  const double c = 1.0 / std::sqrt(1.0 + tangent2), s = std::sqrt(tangent2) * c;
  return {s * std::cos(2 * kPi * u.y), s * std::sin(2 * kPi * u.y), c};
}

struct LobeSample {
  glm::dvec3 wi;  // about +Z, which is looked along as well
  double weight;
  double level;  // of the halved maps, whose texels are as large as what the sample stands for
};

// Karis 2013, "Real Shading in Unreal Engine 4": n = v = r, samples weighted by the cosine; Krivanek, Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling", for the level.
std::vector<LobeSample> lobeSamples(double alpha, const Grid& g) {
  std::vector<LobeSample> samples;
  const double texelAngle = 4 * kPi / (static_cast<double>(g.width) * g.height);
  for (std::uint32_t i = 0; i < kLobeSamples; ++i) {
    const glm::dvec3 h = halfVector(hammersley(i, kLobeSamples), alpha);
    const glm::dvec3 wi(2 * h.z * h.x, 2 * h.z * h.y, 2 * h.z * h.z - 1);
    if (!(wi.z > 0)) continue;
    const double a2 = alpha * alpha, q = h.z * h.z * (a2 - 1) + 1;
    const double pdf = a2 / (kPi * q * q) / 4;
    samples.push_back({wi, wi.z, std::max(0.0, 0.5 * std::log2(2.0 / (kLobeSamples * pdf * texelAngle)))});
  }
  return samples;
}

// A lobe sample as the texels of one row see it: turned about the vertical they are all alike.
struct RowSample {
  double du;  // to the texel's own u
  double v;
  double weight;
  std::size_t lower;  // of two levels
  double share;       // of the level above
};
std::vector<RowSample> samplesOfRow(const std::vector<LobeSample>& samples, double theta, std::size_t levels) {
  std::vector<RowSample> row;
  for (const LobeSample& s : samples) {
    // The normal leans by theta from the vertical towards -Z; the lobe's own X lies across that plane.
    const double up = s.wi.z * std::cos(theta) + s.wi.y * std::sin(theta);
    const double ahead = s.wi.z * std::sin(theta) - s.wi.y * std::cos(theta);
    const double level = std::min(s.level, static_cast<double>(levels - 1));
    const auto lower = static_cast<std::size_t>(level);
    row.push_back({std::atan2(s.wi.x, ahead) / (2 * kPi), std::atan2(std::hypot(s.wi.x, ahead), up) / kPi, s.weight,
                   lower, level - static_cast<double>(lower)});
  }
  return row;
}

void addLobes(const std::vector<Grid>& levels, const Rgb& least, double roughness, glm::vec4* out) {
  const std::vector<LobeSample> samples = lobeSamples(std::max(roughness * roughness, kSmallestAlpha), levels[0]);
  forRows(kHeight, [&](int y) {
    const std::vector<RowSample> row = samplesOfRow(samples, kPi * (y + 0.5) / kHeight, levels.size());
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x + 0.5) / kWidth;
      Rgb sum(0.0);
      double weights = 0;
      for (const RowSample& s : row) {
        sum += s.weight * (1 - s.share) * bilinear(levels[s.lower], u + s.du, s.v);
        if (s.share > 0) sum += s.weight * s.share * bilinear(levels[s.lower + 1], u + s.du, s.v);
        weights += s.weight;
      }
      out[y * kWidth + x] = texel(least + sum / weights);
    }
  });
}

double schlick(double c) { return std::pow(std::clamp(1.0 - c, 0.0, 1.0), 5.0); }

// The lobe of shaders/illum/cook_torrance.glsl over the hemisphere, by half vectors of its distribution.
glm::dvec2 lobeIntegral(double nv, double alpha) {
  const glm::dvec3 wo(std::sqrt(1 - nv * nv), 0, nv);
  glm::dvec2 sum(0.0);
  const double a2 = alpha * alpha;
  for (std::uint32_t i = 0; i < kTableSamples; ++i) {
    const glm::dvec3 h = halfVector(hammersley(i, kTableSamples), alpha);
    const double vh = glm::dot(wo, h);
    const double nl = 2 * vh * h.z - nv;
    if (!(nl > 0) || !(vh > 0)) continue;
    const double v = 0.5 / (nl * std::sqrt(nv * nv * (1 - a2) + a2) + nv * std::sqrt(nl * nl * (1 - a2) + a2));
    const double part = v * nl * 4 * vh / h.z / kTableSamples;
    sum += part * glm::dvec2(1 - schlick(vh), schlick(vh));
  }
  return sum;
}

double diffuseSchlick(double nv) {
  const glm::dvec3 wo(std::sqrt(1 - nv * nv), 0, nv);
  double sum = 0;
  for (std::uint32_t i = 0; i < kTableSamples; ++i) {
    const glm::dvec2 u = hammersley(i, kTableSamples);
    const double s = std::sqrt(u.x);
    const glm::dvec3 wi(s * std::cos(2 * kPi * u.y), s * std::sin(2 * kPi * u.y), std::sqrt(1 - u.x));
    sum += schlick(glm::dot(wo, glm::normalize(wo + wi))) / kTableSamples;
  }
  return sum;
}

std::vector<glm::vec4> lobeTable() {
  constexpr int kSize = kEnvironmentTable;
  std::vector<glm::vec4> table(std::size_t{kSize} * kSize);
  forRows(kSize, [&](int x) {
    const double nv = std::max(static_cast<double>(x) / (kSize - 1), 1e-4);
    const double mean = diffuseSchlick(nv);
    for (int y = 0; y < kSize; ++y) {
      const double roughness = static_cast<double>(y) / (kSize - 1);
      const glm::dvec2 lobe = lobeIntegral(nv, std::max(roughness * roughness, kSmallestAlpha));
      table[static_cast<std::size_t>(y * kSize + x)] = glm::vec4(lobe.x, lobe.y, mean, 0.0);
    }
  });
  return table;
}

// Running shares; the last one is 1 exactly, and where nothing shines all are alike.
void addShares(const EnvironmentMap& map, std::vector<glm::vec4>& texels) {
  const auto luminance = [](const glm::vec3& c) { return (double{c.r} + double{c.g} + double{c.b}) / 3.0; };
  std::vector<double> rows;
  double all = 0;
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const std::size_t first = std::size_t{y} * map.width;
    double row = 0;
    for (std::uint32_t x = 0; x < map.width; ++x) row += luminance(map.radiance[first + x]);
    double sofar = 0;
    for (std::uint32_t x = 0; x < map.width; ++x) {
      sofar += luminance(map.radiance[first + x]);
      const bool last = x + 1 == map.width;
      texels[first + x].w = static_cast<float>(last ? 1.0 : (row > 0 ? sofar / row : (x + 1.0) / map.width));
    }
    all += row * texelSolidAngle(map, y);
    rows.push_back(all);
  }
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const bool last = y + 1 == map.height;
    const double share = last ? 1.0 : (all > 0 ? rows[y] / all : (y + 1.0) / map.height);
    texels.emplace_back(static_cast<float>(share), 0.0f, 0.0f, 0.0f);
  }
}

}  // namespace

glm::dvec3 environmentDirection(double u, double v) {
  const double phi = 2 * kPi * (u - 0.5), theta = kPi * v;
  return {std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta)};
}

double texelSolidAngle(const EnvironmentMap& map, std::uint32_t row) {
  return rowSolidAngle(static_cast<int>(map.width), static_cast<int>(map.height), static_cast<int>(row));
}

glm::vec3 meanRadiance(const EnvironmentMap& map) {
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const double angle = texelSolidAngle(map, y);
    for (std::uint32_t x = 0; x < map.width; ++x)
      sum += angle * glm::dvec3(map.radiance[std::size_t{y} * map.width + x]);
    whole += angle * map.width;
  }
  return glm::vec3(sum / whole);
}

std::vector<glm::vec4> environmentTexels(const EnvironmentMap& map) {
  std::vector<glm::vec4> texels;
  for (const glm::vec3& v : map.radiance) texels.emplace_back(v, 0.0f);
  addShares(map, texels);
  const std::size_t maps = texels.size();
  constexpr std::size_t kSize = std::size_t{kEnvironmentWidth} * kEnvironmentHeight;
  texels.resize(maps + (1 + kEnvironmentLevels) * kSize + std::size_t{kEnvironmentTable} * kEnvironmentTable);
  const Rgb least = floorOf(map);
  std::vector<Grid> levels{above(map, least)};
  addIrradiance(levels[0], least, &texels[maps]);
  while (levels.back().width > 2 && levels.back().height > 1) levels.push_back(halved(levels.back()));
  for (std::uint32_t level = 1; level <= kEnvironmentLevels; ++level) {
    addLobes(levels, least, static_cast<double>(level) / kEnvironmentLevels, &texels[maps + level * kSize]);
  }
  static const std::vector<glm::vec4> table = lobeTable();  // of no scene: once is enough
  std::copy(table.begin(), table.end(), &texels[maps + (1 + kEnvironmentLevels) * kSize]);
  return texels;
}

}  // namespace crosslight
