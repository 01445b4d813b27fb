#include "study/store/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/study/store/scratch.h"

namespace linkstudy::file_test {
namespace {

namespace fs = std::filesystem;

class Text_file : public Scratch {};

TEST_F(Text_file, Is_replaced_whole_and_leaves_no_other) {
  write_file_atomically(dir_ / "a", "old and long");
  write_file_atomically(dir_ / "a", "new");
  EXPECT_EQ(read_file(dir_ / "a"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(dir_), {}), 1);
}

TEST_F(Text_file, Behind_a_link_is_replaced_and_the_link_stays) {
  fs::create_directory(dir_ / "elsewhere");
  write_file_atomically(dir_ / "elsewhere/a", "old");
  fs::create_symlink("elsewhere/a", dir_ / "link");
  write_file_atomically(dir_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(dir_ / "link"));
  EXPECT_EQ(read_file(dir_ / "elsewhere/a"), "new");
}

// As root a rename would put a regular file in the place of a device.
TEST_F(Text_file, That_is_a_pipe_is_written_to_and_stays_a_pipe) {
  const fs::path pipe = dir_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);  // both ends: nobody waits
  ASSERT_GE(reader, 0);
  fs::create_symlink("pipe", dir_ / "link");  // as /dev/stdout is one
  write_file_atomically(dir_ / "link", "a,b");
  EXPECT_TRUE(fs::is_fifo(pipe));
  char seen[8] = {};
  EXPECT_EQ(::read(reader, seen, sizeof seen), 3);
  EXPECT_STREQ(seen, "a,b");
  ::close(reader);
}

}  // namespace
}  // namespace linkstudy::file_test
