#include "study/record/program_digest.h"

#include <fstream>
#include <string_view>
#include <vector>

#include "study/record/sha256.h"

namespace linkstudy {
namespace {

constexpr const char* kExecutable = "/proc/self/exe";

}  // namespace

std::string program_digest() {
  std::ifstream file(kExecutable, std::ios::binary);
  Sha256 hash;
  std::vector<char> block(std::size_t{1} << 20);
  bool is_read = false;
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    const auto count = static_cast<std::size_t>(file.gcount());
    hash.update(std::string_view(block.data(), count));
    is_read = is_read || count > 0;
  }
  return is_read && file.eof() ? hash.finish() : std::string();
}

}  // namespace linkstudy
