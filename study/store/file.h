// Files with every error reported: a short write, a full disk and a failed sync are StoreErrors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace linkstudy {

// An owned file descriptor, closed on exec.
class File {
 public:
  File(std::filesystem::path path, int flags);  // flags of open(2)
  File(File&& other) noexcept;
  File& operator=(File&& other) noexcept;
  ~File();

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }

  void write_all(std::string_view bytes);
  void sync_data();
  void sync();
  // Cuts the file to `size` bytes and continues writing there.
  void truncate(std::uint64_t size);
  std::string read_all() const;
  // Advisory lock of the whole file, held until this object (and every forked copy) is gone.
  // False when somebody else holds it.
  bool try_lock();

 private:
  [[noreturn]] void fail(std::string_view doing) const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

// Whether a process holds the lock of a file; never takes it itself.
bool is_locked(const std::filesystem::path& path);

std::string read_file(const std::filesystem::path& path);

// Makes names in a directory (created, renamed) survive a power cut.
void sync_directory(const std::filesystem::path& directory);

// Puts `temporary` (closed, complete) in the place of `path`: readers see the old file or the new
// one, never a part.
void replace_file(const std::filesystem::path& temporary, const std::filesystem::path& path);

// The same for a text. A link stays and its target is replaced; a device or a pipe is written to.
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace linkstudy
