#include "study/store/hdf5_image.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "study/record/bytes.h"
#include "study/store/store_error.h"

namespace linkstudy::hdf5 {
namespace {

constexpr std::size_t kStep = 4 << 20;  // bytes by which the memory grows

struct Image {
  std::size_t size = 0;
  std::string bytes;  // copied when the file is closed
};

// The library's memory functions for its image. Exceptions must not pass through it.
void* allocate(size_t size, H5FD_file_image_op_t, void*) {
  return std::malloc(size);
}

void* copy(void* to, const void* from, size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}

void* reallocate(void* memory, size_t size, H5FD_file_image_op_t, void* image) {
  static_cast<Image*>(image)->size = size;
  return std::realloc(memory, size);
}

herr_t release(void* memory, H5FD_file_image_op_t operation, void* data) {
  auto* image = static_cast<Image*>(data);
  herr_t result = 0;
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE && memory != nullptr) {
    try {
      image->bytes.assign(static_cast<const char*>(memory), image->size);
    } catch (const std::bad_alloc&) {
      result = -1;
    }
  }
  std::free(memory);
  return result;
}

void* share(void* image) {
  return image;
}
herr_t leave(void*) {
  return 0;
}

// The memory grows in steps; where the file ends stands in its superblock (version 2: byte 28).
std::size_t file_size(std::string_view bytes) {
  constexpr std::size_t kVersionAt = 8;
  constexpr std::size_t kEndAt = 28;
  constexpr char kVersion = 2;
  if (bytes.size() < kEndAt + 8 || bytes[kVersionAt] != kVersion) {
    throw StoreError("HDF5 made a file of an unexpected version");
  }
  return from_bytes<std::uint64_t>(bytes.substr(kEndAt, 8));
}

}  // namespace

std::string make_image(const PropertyHandle& creation, const std::function<void(hid_t)>& fill) {
  Image image;
  H5FD_file_image_callbacks_t callbacks = {allocate, copy,  reallocate, release,
                                           share,    leave, &image};
  const PropertyHandle access = file_access();
  check(H5Pset_fapl_core(access, kStep, false), "set file access");
  check(H5Pset_file_image_callbacks(access, &callbacks), "set file access");
  {
    FileHandle file(H5Fcreate("image", H5F_ACC_TRUNC, creation, access), "create the file");
    fill(file);
    file.close("make the file");
  }
  image.bytes.resize(std::min(image.bytes.size(), file_size(image.bytes)));
  return std::move(image.bytes);
}

}  // namespace linkstudy::hdf5
