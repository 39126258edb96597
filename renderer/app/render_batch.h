// Many pictures in one process: the items of a file, with the command line's options where an item says nothing.
#pragma once

#include <string>
#include <vector>

#include "app/render_options.h"

namespace crosslight {

struct CommonOptions;

// The items of a batch file's text. InputError (the file, then the item and key) on what is unknown or cannot be meant.
std::vector<RenderOptions> batchItems(const std::string& text, const std::string& where, const RenderOptions& defaults);

// Draws all items; one that fails does not stop the others unless the options say so. Ends with the error of the first
// that failed.
void runBatch(const RenderOptions& options, const CommonOptions& common);

}  // namespace crosslight
