// How the program's heap gets its memory from the system.
#pragma once

namespace crosslight {

// Has the heap of the main thread grow by large steps into large pages: pictures and scenes are touched once, and a
// page of 4 KiB costs as much as drawing some of its pixels. At the program's start, before other threads; a hint,
// where there are no large pages or no glibc.
void useLargePages();

}  // namespace crosslight
