// Owning handles over the C library of HDF5, and its errors as exceptions.
#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>
#include <utility>

namespace linkstudy::hdf5 {

// Throws StoreError with the library's own first reason.
[[noreturn]] void fail(std::string_view doing);

inline hid_t check(hid_t id, std::string_view doing) {
  if (id < 0) fail(doing);
  return id;
}

template <herr_t (*Close)(hid_t)>
class Handle {
 public:
  Handle(hid_t id, std::string_view doing) : id_(check(id, doing)) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) Close(id_);
  }

  operator hid_t() const { return id_; }

  // Closing a file completes it, so that its failure counts.
  void close(std::string_view doing) { check(Close(std::exchange(id_, -1)), doing); }

 private:
  hid_t id_;
};

using FileHandle = Handle<H5Fclose>;
using GroupHandle = Handle<H5Gclose>;
using DatasetHandle = Handle<H5Dclose>;
using SpaceHandle = Handle<H5Sclose>;
using TypeHandle = Handle<H5Tclose>;
using PropertyHandle = Handle<H5Pclose>;
using AttributeHandle = Handle<H5Aclose>;
using ObjectHandle = Handle<H5Oclose>;

// While it lives the library prints nothing: its reasons come with our exceptions.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// Variable-length UTF-8.
TypeHandle string_type();
// How files are opened: stored so that HDF5 1.8 reads them, and without file locks, which not every
// file system has and a file that is only ever replaced does not need.
PropertyHandle file_access();

}  // namespace linkstudy::hdf5
