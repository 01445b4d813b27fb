#include "study/store/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "study/store/store_error.h"

namespace linkstudy {
namespace {

constexpr mode_t kMode = 0666;  // less the user's umask

[[noreturn]] void fail_at(const std::filesystem::path& path, std::string_view doing, int error) {
  std::string_view remedy = "";
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) {
    remedy = "; free some space and start again: the study continues where it stopped";
  } else if (error == EACCES || error == EPERM || error == EROFS) {
    remedy = "; choose a directory you may write to with -o";
  } else if (error == ENOLCK || error == ENOSYS || error == EOPNOTSUPP) {
    remedy = "; this file system has no locks: choose a directory on another one with -o";
  }
  throw StoreError(
      fmt::format("{}: cannot {}: {}{}", path.string(), doing, std::strerror(error), remedy));
}

// Repeats a system call that a signal interrupted.
template <class Call>
auto retried(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

struct flock whole_file(short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

File::File(std::filesystem::path path, int flags)
    : path_(std::move(path)),
      descriptor_(retried([&] { return ::open(path_.c_str(), flags | O_CLOEXEC, kMode); })) {
  if (descriptor_ < 0) fail("open");
}

File::File(File&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

File& File::operator=(File&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

File::~File() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void File::fail(std::string_view doing) const {
  fail_at(path_, doing, errno);
}

void File::write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        retried([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (written < 0) fail("write");
    if (written == 0) fail_at(path_, "write", ENOSPC);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void File::sync_data() {
  if (retried([&] { return ::fdatasync(descriptor_); }) < 0) fail("sync");
}

void File::sync() {
  if (retried([&] { return ::fsync(descriptor_); }) < 0) fail("sync");
}

void File::truncate(std::uint64_t size) {
  const auto offset = static_cast<off_t>(size);
  if (retried([&] { return ::ftruncate(descriptor_, offset); }) < 0) fail("truncate");
  if (::lseek(descriptor_, offset, SEEK_SET) < 0) fail("seek in");
}

std::string File::read_all() const {
  struct stat info = {};
  if (::fstat(descriptor_, &info) < 0) fail("read");
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = retried([&] {
      return ::pread(descriptor_, bytes.data() + filled, bytes.size() - filled,
                     static_cast<off_t>(filled));
    });
    if (got < 0) fail("read");
    if (got == 0) {
      break;  // the file became shorter meanwhile
    }
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

// Locks of the open file description: like flock(2) they end with the last descriptor and survive a
// fork, and unlike it they can be asked about without being taken, and work over NFS.
bool File::try_lock() {
  struct flock lock = whole_file(F_WRLCK);
  if (retried([&] { return ::fcntl(descriptor_, F_OFD_SETLK, &lock); }) == 0) return true;
  if (errno == EAGAIN || errno == EACCES) return false;
  fail("lock");
}

bool is_locked(const std::filesystem::path& path) {
  const File file(path, O_RDONLY);
  struct flock lock = whole_file(F_WRLCK);
  const int answer = retried([&] { return ::fcntl(file.descriptor(), F_OFD_GETLK, &lock); });
  return answer == 0 && lock.l_type != F_UNLCK;
}

std::string read_file(const std::filesystem::path& path) {
  return File(path, O_RDONLY).read_all();
}

void sync_directory(const std::filesystem::path& directory) {
  File(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY).sync();
}

void replace_file(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  File(temporary, O_RDONLY).sync();
  if (::rename(temporary.c_str(), path.c_str()) < 0) fail_at(path, "replace", errno);
  sync_directory(path.parent_path());
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  namespace fs = std::filesystem;
  if (fs::exists(path) && !fs::is_regular_file(path)) {
    File(path, O_WRONLY).write_all(text);
    return;
  }
  const fs::path target = fs::is_symlink(path) ? fs::weakly_canonical(path) : path;
  fs::path temporary = target;
  temporary += ".tmp";
  try {
    File(temporary, O_WRONLY | O_CREAT | O_TRUNC).write_all(text);
    replace_file(temporary, target);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace linkstudy
