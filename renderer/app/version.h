// What was built: the project's version and the commit, for records, --version and the man page.
#pragma once

namespace crosslight {

const char* versionText();  // "0.1.0"
const char* commitText();   // full hash of the commit that was checked out, or "unknown" outside a repository

}  // namespace crosslight
