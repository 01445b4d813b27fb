#include "core/codegen/written_code.h"

#include <sys/mman.h>

#include <cstring>

namespace linkstudy::codegen {

std::unique_ptr<WrittenCode> WrittenCode::place(std::span<const std::uint8_t> code,
                                                Protect protect) {
  if (code.empty()) return nullptr;
  void* pages =
      ::mmap(nullptr, code.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) return nullptr;
  std::unique_ptr<WrittenCode> placed(new WrittenCode(pages, code.size()));
  std::memcpy(pages, code.data(), code.size());
  if ((protect ? protect : ::mprotect)(pages, code.size(), PROT_READ | PROT_EXEC) != 0) {
    return nullptr;
  }
  return placed;
}

WrittenCode::~WrittenCode() {
  ::munmap(pages_, size_);
}

WrittenCode::Function WrittenCode::function() const {
  return reinterpret_cast<Function>(pages_);
}

}  // namespace linkstudy::codegen
