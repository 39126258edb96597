// Files are written whole or not at all, whatever happens in between.
#include "base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/interrupt.h"

namespace crosslight {
namespace {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
  FileTest() {
    std::string pattern = (fs::temp_directory_path() / "crosslight-test-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~FileTest() override {
    std::error_code ignored;
    fs::permissions(folder_, fs::perms::owner_all, ignored);
    fs::remove_all(folder_, ignored);
  }
  static std::string contentOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

std::string textOf(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(FileTest, ReadsBackWhatWasWritten) {
  const std::string text("a\0b\r\n\xff", 6);
  writeFileAtomically(folder_ / "a.txt", text);
  EXPECT_EQ(textOf(readFile(folder_ / "a.txt")), text);
  writeFileAtomically(folder_ / "a.txt", std::string());
  EXPECT_TRUE(readFile(folder_ / "a.txt").empty());
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, RefusesToReadWhatIsMissingAFolderOrTooLarge) {
  EXPECT_THROW(readFile(folder_ / "missing"), InputError);
  EXPECT_THROW(readFile(folder_), InputError);
  writeFileAtomically(folder_ / "a", std::string(100, 'x'));
  EXPECT_EQ(readFile(folder_ / "a", 100).size(), 100u);
  try {
    readFile(folder_ / "a", 99);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr((folder_ / "a").string()),
                                               ::testing::HasSubstr("100"), ::testing::HasSubstr("99")));
  }
}

TEST_F(FileTest, GivesTheWriterATemporaryFileOfTheSameKindInTheSameFolder) {
  const fs::path target = folder_ / "picture.exr";
  writeFileAtomically(target, [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), folder_);
    EXPECT_EQ(temporary.extension(), ".exr");
    EXPECT_NE(temporary, target);
    EXPECT_FALSE(fs::exists(target)) << "nothing is there before it is whole";
    std::ofstream(temporary) << "done";
  });
  EXPECT_EQ(contentOf(target), "done");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, KeepsTheOldFileWhenTheWriterThrows) {
  writeFileAtomically(folder_ / "a", std::string("old"));
  const auto write = [&](const fs::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(writeFileAtomically(folder_ / "a", write), std::runtime_error);
  EXPECT_EQ(contentOf(folder_ / "a"), "old");
  EXPECT_EQ(entries(), 1u) << "the temporary file was left";
}

TEST_F(FileTest, RefusesAFolderAsTargetAMissingFolderAndAWriterThatWritesNothing) {
  fs::create_directory(folder_ / "sub");
  EXPECT_THROW(writeFileAtomically(folder_ / "sub", std::string("x")), InputError);
  EXPECT_EQ(entries(), 1u);
  EXPECT_THROW(writeFileAtomically(folder_ / "missing" / "a", std::string("x")), InputError);
  EXPECT_THROW(writeFileAtomically(folder_ / "b", [](const fs::path&) {}), InputError);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(FileTest, RefusesAFolderThatMayNotBeWritten) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(writeFileAtomically(folder_ / "a", std::string("x")), InputError);
}

TEST_F(FileTest, WritesNothingAfterAnInterrupt) {
  writeFileAtomically(folder_ / "a", std::string("old"));
  const auto interrupted = [&] {
    installInterruptHandler();
    try {
      writeFileAtomically(folder_ / "a", [](const fs::path& temporary) {
        std::ofstream(temporary) << "new";
        std::raise(SIGINT);
      });
    } catch (const Interrupted&) {
      std::_Exit(contentOf(folder_ / "a") == "old" && entries() == 1 ? 0 : 1);
    }
    std::_Exit(2);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(0), "");
}

// A limit on file sizes fails like a full disk; in a process of its own, because it stays.
TEST_F(FileTest, ReportsAFullDiskAndKeepsTheOldFile) {
  writeFileAtomically(folder_ / "a", std::string("old"));
  const auto onFullDisk = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeFileAtomically(folder_ / "a", std::string(100000, 'x'));
    } catch (const InputError&) {
      std::_Exit(contentOf(folder_ / "a") == "old" && entries() == 1 ? 0 : 1);
    }
    std::_Exit(2);
  };
  EXPECT_EXIT(onFullDisk(), ::testing::ExitedWithCode(0), "");
}

TEST(CacheFolder, FollowsTheXdgSpecification) {
  const char* const home = std::getenv("HOME");
  const std::string oldHome = home == nullptr ? "" : home;
  setenv("HOME", "/home/someone", 1);
  setenv("XDG_CACHE_HOME", "/var/cache/someone", 1);
  EXPECT_EQ(cacheFolder(), "/var/cache/someone/crosslight");
  setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(cacheFolder(), "/home/someone/.cache/crosslight");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(cacheFolder(), "/home/someone/.cache/crosslight");
  unsetenv("HOME");
  EXPECT_EQ(cacheFolder(), "");
  if (home != nullptr) setenv("HOME", oldHome.c_str(), 1);
}

}  // namespace
}  // namespace crosslight
