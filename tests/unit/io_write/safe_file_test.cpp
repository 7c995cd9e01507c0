// SPDX-License-Identifier: MIT
#include "core/io/safe_file.h"

#include <sys/stat.h>

#include "tests/unit/io_write/folder.h"

namespace elbowroom {
namespace {

namespace fs = std::filesystem;

class SafeFile : public test::InFolder {};

TEST_F(SafeFile, IsThereWholeOrNotAtAll) {
  const fs::path file = folder_ / "a.glb";
  {
    auto staged = StagedFile::stage(file, "new");
    ASSERT_TRUE(staged.ok());
    EXPECT_FALSE(fs::exists(file));
  }  // given up
  EXPECT_EQ(files_in(folder_), 0u);

  ASSERT_TRUE(write_file_safely(file, std::string("one\0two", 7)).ok());
  EXPECT_EQ(slurp(file), std::string("one\0two", 7));
  auto staged = StagedFile::stage(file, "three");
  ASSERT_TRUE(staged.ok());
  EXPECT_EQ(slurp(file), std::string("one\0two", 7));
  ASSERT_TRUE(staged->commit().ok());
  EXPECT_FALSE(staged->commit().ok());
  EXPECT_EQ(slurp(file), "three");
  EXPECT_EQ(files_in(folder_), 1u);
  EXPECT_EQ(*read_whole_file(file), "three");
}

TEST_F(SafeFile, KeepsPermissionsAndFollowsLinks) {
  const fs::path file = folder_ / "a.glb", link = folder_ / "link.glb";
  spill(file, "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink(file, link);
  ASSERT_TRUE(write_file_safely(link, "new").ok());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(slurp(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(SafeFile, RefusesWhatIsNoFile) {
  EXPECT_FALSE(write_file_safely(folder_, "x").ok());
  EXPECT_FALSE(write_file_safely(folder_ / "no such folder" / "a", "x").ok());
  EXPECT_FALSE(write_file_safely("/dev/null", "x").ok());
  EXPECT_FALSE(read_whole_file(folder_).ok());
  EXPECT_FALSE(read_whole_file(folder_ / "nothing").ok());
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(read_whole_file(folder_ / "pipe").ok());
  EXPECT_FALSE(write_file_safely(folder_ / "pipe", "x").ok());
  spill(folder_ / "big", "12345");
  EXPECT_FALSE(read_whole_file(folder_ / "big", 4).ok());
  EXPECT_TRUE(read_whole_file(folder_ / "big", 5).ok());
  const auto error = read_whole_file(folder_ / "nothing").error();
  EXPECT_NE(error.message().find("nothing"), std::string::npos);
}

TEST_F(SafeFile, Copies) {
  const fs::path from = folder_ / "from", to = folder_ / "to";
  spill(from, "bytes");
  ASSERT_TRUE(copy_file_safely(from, to).ok());
  EXPECT_EQ(slurp(to), "bytes");
  ASSERT_TRUE(copy_file_safely(from, from).ok());
  EXPECT_EQ(slurp(from), "bytes");
  EXPECT_FALSE(copy_file_safely(folder_ / "nothing", to).ok());
  EXPECT_EQ(slurp(to), "bytes");
}

}  // namespace
}  // namespace elbowroom
