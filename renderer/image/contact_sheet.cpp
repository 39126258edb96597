#include "image/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "image/codecs.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace crosslight {
namespace {

using Color = std::array<std::uint8_t, 3>;  // sRGB codes

constexpr Color kPaper{246, 246, 243}, kInk{34, 34, 38}, kPaleInk{112, 112, 118}, kFrame{200, 200, 196};
// Distances in dots of the font, so that they grow with the text.
constexpr std::uint32_t kLineDots = 12, kMarginDots = 16, kGapDots = 12, kCaptionDots = 5;

struct Canvas {
  std::uint32_t width = 0, height = 0;
  std::vector<Color> pixels;

  Canvas(std::uint32_t w, std::uint32_t h, const Color& color)
      : width(w), height(h), pixels(std::size_t{w} * h, color) {}
  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t w, std::uint32_t h, const Color& color) {
    for (std::uint32_t row = y; row < std::min(y + h, height); ++row) {
      for (std::uint32_t column = x; column < std::min(x + w, width); ++column)
        pixels[std::size_t{row} * width + column] = color;
    }
  }
  void draw(const Canvas& other, std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t row = 0; row < other.height; ++row) {
      std::copy_n(other.pixels.begin() + std::ptrdiff_t{row} * other.width, other.width,
                  pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{y + row} * width + x));
    }
  }
};

// The font has a glyph for every printable ASCII character and reads past its table for others.
std::string printable(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

std::uint32_t textWidth(std::string text, std::uint32_t scale) {
  return static_cast<std::uint32_t>(std::max(stb_easy_font_width(text.data()), 0)) * scale;
}

std::string fitted(const std::string& text, std::uint32_t width, std::uint32_t scale) {
  std::string whole = printable(text);
  if (textWidth(whole, scale) <= width) return whole;
  std::string cut = whole;
  while (!cut.empty() && textWidth(cut + "...", scale) > width) cut.pop_back();
  return cut + "...";
}

// The font comes as rectangles with whole coordinates: four corners of 16 bytes (x, y, z, color) each.
void print(Canvas& canvas, std::string text, std::uint32_t x, std::uint32_t y, std::uint32_t scale,
           const Color& color) {
  struct Corner {
    float x, y, z;
    std::uint32_t color;
  };
  constexpr std::size_t kCornersPerCharacter = 4 * 20;  // the densest glyph has 14 strokes
  std::vector<Corner> corners(kCornersPerCharacter * (text.size() + 1));
  const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(quads); ++i) {
    const Corner &a = corners[4 * i], &b = corners[4 * i + 2];
    const auto left = static_cast<std::uint32_t>(a.x), top = static_cast<std::uint32_t>(a.y);
    canvas.fill(x + left * scale, y + top * scale, static_cast<std::uint32_t>(b.x - a.x) * scale,
                static_cast<std::uint32_t>(b.y - a.y) * scale, color);
  }
}

// Display codes of the picture, averaged in linear light over blocks so that no side exceeds `maxSide`.
Canvas thumbnail(const SheetEntry& entry, std::uint32_t maxSide) {
  CL_CHECK(entry.picture != nullptr);
  DisplayTransform display = entry.display;
  display.withAlpha = false;
  const DisplayPicture shown = displayPicture(*entry.picture, display);
  const std::uint32_t longest = std::max(shown.width, shown.height);
  const std::uint32_t block = maxSide == 0 ? 1 : std::max(1u, (longest + maxSide - 1) / maxSide);
  Canvas result(std::max(1u, shown.width / block), std::max(1u, shown.height / block), kPaper);
  const auto codeAt = [&](std::uint32_t x, std::uint32_t y, std::size_t c) {
    return shown
        .codes[3 * (std::size_t{std::min(y, shown.height - 1)} * shown.width + std::min(x, shown.width - 1)) + c];
  };
  for (std::uint32_t y = 0; y < result.height; ++y) {
    for (std::uint32_t x = 0; x < result.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::uint32_t i = 0; i < block * block; ++i) {
          sum += double{
              linearFromSrgb(static_cast<float>(codeAt(x * block + i % block, y * block + i / block, c)) / 255.0f)};
        }
        const double mean = sum / (double{static_cast<double>(block)} * block);
        result.pixels[std::size_t{y} * result.width + x][c] = srgbCodeFromLinear(static_cast<float>(mean));
      }
    }
  }
  return result;
}

struct Layout {
  std::uint32_t columns = 1, rows = 1;
  std::uint32_t pictureWidth = 0, pictureHeight = 0;  // of the largest picture
  std::uint32_t cellHeight = 0, margin = 0, gap = 0, titleHeight = 0;

  std::uint32_t width() const { return 2 * margin + columns * pictureWidth + (columns - 1) * gap; }
  std::uint32_t height() const { return 2 * margin + titleHeight + rows * cellHeight + (rows - 1) * gap; }
};

// The number of columns that makes the sheet's sides about 16 : 10, with a penalty for places left empty.
void chooseColumns(Layout& layout, std::uint32_t count) {
  constexpr double kAspect = 1.6, kEmptyPenalty = 0.15;
  double least = INFINITY;
  Layout best = layout;
  for (std::uint32_t columns = 1; columns <= count; ++columns) {
    layout.columns = columns;
    layout.rows = (count + columns - 1) / columns;
    const double empty = layout.rows * columns - count;
    const double cost = std::abs(std::log(layout.width() / (kAspect * layout.height()))) + kEmptyPenalty * empty;
    if (cost < least) {
      least = cost;
      best = layout;
    }
  }
  layout = best;
}

Layout layoutOf(const std::vector<Canvas>& pictures, std::span<const SheetEntry> entries, const SheetOptions& options) {
  Layout layout;
  const std::uint32_t scale = options.textScale;
  for (const Canvas& picture : pictures) {
    layout.pictureWidth = std::max(layout.pictureWidth, picture.width);
    layout.pictureHeight = std::max(layout.pictureHeight, picture.height);
  }
  const bool notes = std::any_of(entries.begin(), entries.end(), [](const SheetEntry& e) { return !e.note.empty(); });
  layout.margin = kMarginDots * scale;
  layout.gap = kGapDots * scale;
  layout.cellHeight = layout.pictureHeight + (kCaptionDots + (notes ? 2 : 1) * kLineDots) * scale;
  layout.titleHeight = options.title.empty() ? 0 : 2 * kLineDots * (scale + 1);
  const auto count = static_cast<std::uint32_t>(entries.size());
  if (options.columns == 0) {
    chooseColumns(layout, count);
  } else {
    layout.columns = std::min(options.columns, count);
    layout.rows = (count + layout.columns - 1) / layout.columns;
  }
  return layout;
}

void drawCell(Canvas& sheet, const Canvas& picture, const SheetEntry& entry, const Layout& layout, std::uint32_t x,
              std::uint32_t y, std::uint32_t scale) {
  // Smaller pictures stand on the caption, in the middle.
  const std::uint32_t left = x + (layout.pictureWidth - picture.width) / 2,
                      top = y + layout.pictureHeight - picture.height;
  sheet.fill(left - 1, top - 1, picture.width + 2, picture.height + 2, kFrame);
  sheet.draw(picture, left, top);
  std::uint32_t line = y + layout.pictureHeight + kCaptionDots * scale;
  for (const bool isNote : {false, true}) {
    const std::string text = fitted(isNote ? entry.note : entry.caption, layout.pictureWidth, scale);
    const std::uint32_t width = std::min(textWidth(text, scale), layout.pictureWidth);
    print(sheet, text, x + (layout.pictureWidth - width) / 2, line, scale, isNote ? kPaleInk : kInk);
    line += kLineDots * scale;
  }
}

Image imageOf(const Canvas& canvas) {
  Image image;
  image.width = canvas.width;
  image.height = canvas.height;
  Layer& layer = addLayer(image, "", {"R", "G", "B"});
  for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      layer.samples[3 * i + c] = linearFromSrgb(static_cast<float>(canvas.pixels[i][c]) / 255.0f);
  }
  return image;
}

}  // namespace

Image makeContactSheet(std::span<const SheetEntry> entries, const SheetOptions& options) {
  CL_CHECK(!entries.empty());
  CL_CHECK_LE(1u, options.textScale);
  std::vector<Canvas> pictures;
  for (const SheetEntry& entry : entries) pictures.push_back(thumbnail(entry, options.maxPictureSide));
  const Layout layout = layoutOf(pictures, entries, options);
  codec::checkSides(layout.width(), layout.height(), "the contact sheet");
  Canvas sheet(layout.width(), layout.height(), kPaper);
  if (!options.title.empty()) {
    const std::uint32_t scale = options.textScale + 1;
    print(sheet, fitted(options.title, layout.width() - 2 * layout.margin, scale), layout.margin, layout.margin, scale,
          kInk);
  }
  for (std::uint32_t i = 0; i < pictures.size(); ++i) {
    const std::uint32_t x = layout.margin + i % layout.columns * (layout.pictureWidth + layout.gap);
    const std::uint32_t y = layout.margin + layout.titleHeight + i / layout.columns * (layout.cellHeight + layout.gap);
    drawCell(sheet, pictures[i], entries[i], layout, x, y, options.textScale);
  }
  return imageOf(sheet);
}

}  // namespace crosslight
