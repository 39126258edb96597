// `crosslight sheet`: images side by side with captions in one picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/output.h"
#include "app/render_options.h"
#include "base/log.h"
#include "image/contact_sheet.h"
#include "image/image_io.h"

namespace crosslight {
namespace {

// The text scale is for people; a sheet a thousand pictures wide is no picture.
constexpr std::uint64_t kMostColumns = 64;
constexpr std::uint64_t kMostSide = 65536;
constexpr std::uint64_t kMostTextScale = 16;

struct Options {
  std::vector<std::string> images;
  std::string output;
  std::vector<std::string> captions;
  std::vector<std::string> notes;
  SheetOptions sheet;
  double exposureStops = 0;
  std::string toneMap = "clamp";
};

void checkCount(const std::string& option, const std::vector<std::string>& words, std::size_t images) {
  if (words.size() > images) {
    throw UsageError(fmt::format("{} is given {} times for {} images", option, words.size(), images));
  }
}

void run(const Options& options) {
  checkCount("--caption", options.captions, options.images.size());
  checkCount("--note", options.notes, options.images.size());
  imageFormatOf(options.output);
  checkOutputPlace(options.output);
  DisplayTransform display;
  display.toneMap = toneMapOf(options.toneMap);
  display.exposureStops = static_cast<float>(options.exposureStops);

  std::vector<Image> pictures;
  for (const std::string& file : options.images) pictures.push_back(readImage(file));
  std::vector<SheetEntry> entries(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    entries[i].picture = &pictures[i];
    entries[i].display = display;
    entries[i].caption =
        i < options.captions.size() ? options.captions[i] : std::filesystem::path(options.images[i]).stem().string();
    if (i < options.notes.size()) entries[i].note = options.notes[i];
  }
  // Every picture has gone through its own display transform already.
  writeImage(options.output, makeContactSheet(entries, options.sheet), DisplayTransform{});
  logInfo(fmt::format("{} ({} pictures)", options.output, pictures.size()));
}

}  // namespace

void addSheetCommand(CommandLine& line) {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  CLI::App& command = line.add("sheet", "Put images side by side with captions", "IMAGE... -o OUT.png [option...]",
                               "Captions and notes go to the images in their order; an image without a caption shows "
                               "its file's name.");
  line.declare(command.add_option("IMAGE", o.images, "Image files: png, exr, hdr or pfm")->required(), "IMAGE",
               {ValueKind::file, {}});
  line.text(command, "-o,--output", o.output, "OUT", "The sheet; .png, .exr, .hdr or .pfm", ValueKind::file)
      ->required()
      ->group("Output");
  line.list(command, "--caption", o.captions, "TEXT", "Caption of the next image", {})->group("Sheet");
  line.list(command, "--note", o.notes, "TEXT", "Second, paler line of the next image", {})->group("Sheet");
  line.text(command, "--title", o.sheet.title, "TEXT", "Above all images")->group("Sheet");
  line.whole(command, "--columns", o.sheet.columns, "N", 0, kMostColumns, "Images per row; 0 chooses")->group("Sheet");
  line.whole(command, "--max-side", o.sheet.maxPictureSide, "PIXELS", 0, kMostSide,
             "Average larger images down; 0 leaves all as they are")
      ->group("Sheet");
  line.whole(command, "--text-scale", o.sheet.textScale, "N", 1, kMostTextScale, "Pixels per dot of the font")
      ->group("Sheet");
  addDisplayOptions(line, command, o.exposureStops, o.toneMap);
  line.onRun(command, [options] { run(*options); });
}

}  // namespace crosslight
