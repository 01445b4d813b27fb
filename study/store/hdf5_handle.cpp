#include "study/store/hdf5_handle.h"

#include <fmt/format.h>

#include "study/store/store_error.h"

namespace linkstudy::hdf5 {
namespace {

// The walk goes from the innermost error outwards; the first one is the reason.
herr_t keep_first(unsigned, const H5E_error2_t* error, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  if (text.empty() && error->desc != nullptr) text = error->desc;
  return 0;
}

}  // namespace

void fail(std::string_view doing) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  throw StoreError(fmt::format("cannot {}: {}", doing, reason.empty() ? "HDF5 error" : reason));
}

Quiet::Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

TypeHandle string_type() {
  TypeHandle type(H5Tcopy(H5T_C_S1), "make a string type");
  check(H5Tset_size(type, H5T_VARIABLE), "make a string type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "make a string type");
  return type;
}

PropertyHandle file_access() {
  PropertyHandle access(H5Pcreate(H5P_FILE_ACCESS), "set file access");
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "set file access");
  check(H5Pset_file_locking(access, false, true), "set file access");
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "set file access");
  return access;
}

}  // namespace linkstudy::hdf5
