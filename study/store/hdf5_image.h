// HDF5 files made in memory. The library does not survive a full disk (closing the file fails, and
// the program crashes when it ends), and H5Fget_file_image of the versions before 2.0 gives a wrong
// checksum (HDFGroup/hdf5 pull request 5489). So the file is made in memory of ours, which still
// holds it, complete, when the library has closed it.
#pragma once

#include <functional>
#include <string>

#include "study/store/hdf5_handle.h"

namespace linkstudy::hdf5 {

// Bytes of a new file that `fill` has filled; `creation` are its creation properties.
std::string make_image(const PropertyHandle& creation, const std::function<void(hid_t)>& fill);

}  // namespace linkstudy::hdf5
